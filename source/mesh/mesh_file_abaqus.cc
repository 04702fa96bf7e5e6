// SPDX-License-Identifier: LGPL-2.1-or-later
// Meshes in files of Abaqus (.inp).
#include <tread/base/text_file.h>
#include <tread/mesh/mesh_file.h>

#include "mesh_file_foreign.h"
#include "mesh_file_keywords.h"
#include "mesh_file_words.h"

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace tread
{
  namespace
  {
    using mesh_keywords::ElementsByNumber;
    using mesh_keywords::Entries;
    using mesh_keywords::in_capitals;
    using mesh_keywords::keyword_in;
    using mesh_keywords::KeywordLine;
    using mesh_keywords::refuse_keyword;

    class AbaqusReader
    {
    public:
      MeshInput read(const std::vector<std::string> &lines)
      {
        most_members = 1000 + 100 * lines.size();
        n_lines      = lines.size();
        for (const std::string &text : lines)
          {
            ++line;
            if (text.compare(0, 2, "**") == 0 || text.find_first_not_of(" \t\r") == std::string::npos)
              continue;
            if (text[0] == '*')
              {
                if (text.find_last_not_of(" \t\r") == text.rfind(','))
                  throw TextError(line, "is a keyword that goes on in the next line: write it in one");
                begin(keyword_in(text));
              }
            else
              take(text);
          }
        check_complete();
        for (const Surface &surface : surfaces)
          add_surface(surface);
        for (const auto &[name, set] : elements_of)
          add_set(name, set);
        for (const Section &section : sections)
          {
            if (elements_of.count(section.set) == 0)
              throw TextError(section.line,
                              "gives a material to a set '" + section.set + "' that is not there");
            mesh.give_material(section.set, section.material, section.line);
          }
        return std::move(mesh);
      }

    private:
      struct Set
      {
        unsigned int      line;
        bool              is_named; ///< by a set of its own, and not only where its elements are listed
        std::vector<long> members;
      };
      /// Faces by their number S1 to S6 of an element, or of a set of them.
      struct Surface
      {
        std::string                                                     name;
        unsigned int                                                    line;
        std::vector<std::tuple<std::string, std::string, unsigned int>> faces;
      };

      /// A material that a set of elements has.
      struct Section
      {
        std::string  set, material;
        unsigned int line;
      };

      void check_complete() const
      {
        if (!pending.empty())
          throw TextError(line, "ends within an element: the file is cut off");
      }

      void begin(const KeywordLine &now)
      {
        check_complete();
        keyword = now;
        if (const char *instead = mesh_foreign::instead_of(now.name, mesh_foreign::refused_of_abaqus(), true))
          refuse_keyword(line, now.name, instead);
        if (now.name == "CONTACT PAIR" && now.parameters.count("TIED") > 0)
          refuse_keyword(line, now.name + " with TIED", mesh_foreign::join_nodes);
        if (!is_read(now.name))
          return pass_over(now);
        is_in_block = false;
        if (now.parameters.count("INPUT") > 0)
          refuse_keyword(line, now.name + " with INPUT", "write all in one file");
        if (const std::string system = in_capitals(now.parameter("SYSTEM"));
            now.name == "NODE" && !system.empty() && system != "R")
          refuse_keyword(line, "NODE with SYSTEM=" + system, "write x, y and z");
        if (now.name == "INSTANCE" && n_instances++ > 0)
          refuse_keyword(line, now.name,
                         "write one mesh of all parts, with numbers of its own ('flat' input)");
        if (now.name == "ELEMENT")
          check_type(in_capitals(now.parameter("TYPE")));
        if (now.name == "SURFACE")
          {
            if (const std::string kind = in_capitals(now.parameter("TYPE"));
                !kind.empty() && kind != "ELEMENT")
              refuse_keyword(line, "SURFACE of the type " + kind,
                             "name faces of elements, S1 to S6, or a set of nodes");
            surfaces.push_back({now.parameter("NAME"), line, {}});
          }
        if (now.name == "NSET")
          mesh.named(now.parameter("NSET"), line);
        if (now.name == "ELSET")
          set_of(now.parameter("ELSET"), true);
      }

      static bool is_read(const std::string &name)
      {
        static const std::vector<std::string> list{"HEADING",  "NODE",         "ELEMENT",  "NSET",
                                                   "ELSET",    "SURFACE",      "PART",     "END PART",
                                                   "ASSEMBLY", "END ASSEMBLY", "INSTANCE", "END INSTANCE"};
        return std::find(list.begin(), list.end(), name) != list.end();
      }

      /// Steps and what stands below a material or the properties of a surface are named by their beginning.
      void pass_over(const KeywordLine &now)
      {
        const auto &list = mesh_foreign::passed_over_of_abaqus();
        if (is_in_step)
          return;
        if (std::find(list.begin(), list.end(), now.name) != list.end())
          {
            is_in_block = now.name == "MATERIAL" || now.name == "SURFACE INTERACTION";
            is_in_step  = now.name == "STEP";
            mesh.pass_over("*" + now.name, line);
            if (now.name == "SOLID SECTION")
              sections.push_back({mesh_words::lower(now.parameter("ELSET")),
                                  mesh_words::lower(now.parameter("MATERIAL")), line});
          }
        else if (!is_in_block)
          refuse_keyword(line, now.name, mesh_foreign::unknown);
      }

      void check_type(const std::string &type)
      {
        const auto begins = [&](const std::string &text) {
          return type.compare(0, text.size(), text) == 0;
        };
        const auto is_one_of = [&](const std::vector<std::string> &list) {
          return std::find(list.begin(), list.end(), type) != list.end();
        };
        is_hexahedron    = begins("C3D8");
        is_quadrilateral = is_one_of({"S4", "S4R", "S4RS", "CPS4", "CPS4R", "CPE4", "CPE4R", "M3D4", "M3D4R",
                                      "SFM3D4", "SFM3D4R", "R3D4"});
        if (is_hexahedron || is_quadrilateral)
          return;
        if (is_one_of({"T3D2", "B31", "MASS"})) // lines and points of Gmsh
          return mesh.pass_over("elements of the type " + type, line);
        const bool second = begins("C3D20") || begins("C3D27") || begins("C3D10") || begins("C3D15") ||
                            begins("S8") || begins("CPS8");
        throw TextError(line,
                        "has elements of the type '" + type + "'" +
                          (begins("C3D4") || begins("C3D10")   ? ", which are tetrahedra"
                           : begins("C3D6") || begins("C3D15") ? ", which are prisms"
                                                               : "") +
                          ": " +
                          (second && !begins("C3D10") && !begins("C3D15") ? mesh_words::make_first_order
                                                                          : mesh_words::make_hexahedra));
      }

      Set &set_of(const std::string &name, const bool is_named)
      {
        Set &set = elements_of.try_emplace(mesh_words::lower(name), Set{line, is_named, {}}).first->second;
        set.is_named = set.is_named || is_named;
        return set;
      }

      /// A line of data below the keyword.
      void take(const std::string &text)
      {
        if (keyword.name == "NODE")
          take_node(entries_of(text, ','));
        else if (keyword.name == "ELEMENT" && (is_hexahedron || is_quadrilateral))
          take_element(entries_of(text, ','));
        else if (keyword.name == "NSET")
          take_members(entries_of(text, ','), mesh.named(keyword.parameter("NSET"), line).nodes,
                       [&](const std::string &name) -> std::vector<long> {
                         throw TextError(line, "names the set '" + name +
                                                 "' in a set of nodes: write the numbers of its nodes");
                       });
        else if (keyword.name == "ELSET")
          take_members(
            entries_of(text, ','), set_of(keyword.parameter("ELSET"), true).members,
            [&](const std::string &name) {
              const auto found = elements_of.find(mesh_words::lower(name));
              if (found == elements_of.end() || found->first == mesh_words::lower(keyword.parameter("ELSET")))
                throw TextError(line, "names the set '" + name + "', which is " +
                                        (found == elements_of.end() ? "not there yet" : "the same"));
              return found->second.members;
            });
        else if (keyword.name == "INSTANCE")
          throw TextError(line,
                          "moves an instance, which is not read: write one mesh of all parts, with places "
                          "and numbers of its own ('flat' input)");
        else if (keyword.name == "SURFACE")
          take_faces(entries_of(text, ','));
      }

      void take_node(const Entries &words)
      {
        if (words.size() < 4)
          throw TextError(line, "has " + std::to_string(words.size()) +
                                  " entries; a node has a number, x, y and z");
        mesh.add_node(mesh_words::whole(words[0], line),
                      {mesh_words::value(words[1], line), mesh_words::value(words[2], line),
                       mesh_words::value(words[3], line)},
                      line);
        if (const std::string name = keyword.parameter("NSET"); is_known_boundary(name))
          mesh.named(name, line).nodes.push_back(mesh_words::whole(words[0], line));
      }

      /// An element may go on, on the next line.
      void take_element(const Entries &words)
      {
        for (const std::string &word : words)
          if (!word.empty())
            pending.push_back(word);
        const std::size_t n = is_hexahedron ? 9 : 5;
        if (pending.size() < n)
          return;
        if (pending.size() > n)
          throw TextError(line, "has " + std::to_string(pending.size()) +
                                  " entries in place of an element's " + std::to_string(n));
        const long number = mesh_words::whole(pending[0], line);
        elements.check_free(number, line);
        const Entries nodes(pending.begin() + 1, pending.end());
        pending.clear();
        if (is_hexahedron)
          {
            elements.hexahedra[number] = mesh.hexahedra.size();
            mesh.hexahedra.push_back({mesh_words::numbers<8>(nodes, line), line});
          }
        else
          elements.quadrilaterals[number] = {mesh_words::numbers<4>(nodes, line), line};
        if (const std::string name = keyword.parameter("ELSET"); !name.empty())
          set_of(name, false).members.push_back(number);
      }

      /// Numbers, names of other sets, or first, last and step.
      void take_members(const Entries                                               &words,
                        std::vector<long>                                           &members,
                        const std::function<std::vector<long>(const std::string &)> &of_set)
      {
        if (keyword.parameters.count("GENERATE") > 0)
          {
            if (words.size() < 2)
              throw TextError(line, "has no first and last number of a set");
            const long first = mesh_words::whole(words[0], line), last = mesh_words::whole(words[1], line),
                       step = words.size() > 2 && !words[2].empty() ? mesh_words::whole(words[2], line) : 1;
            if (step < 1 || last < first)
              throw TextError(line, "'" + words[0] + "' to '" + words[1] + "' is no range of numbers");
            if ((last - first) / step >= static_cast<long>(n_lines))
              throw TextError(line,
                              "'" + words[0] + "' to '" + words[1] +
                                "' is a range of more numbers than the file has lines: write the first, "
                                "the last and the step of those that are there");
            for (long number = first; number <= last; number += step)
              take_member(number, members);
            return;
          }
        for (const std::string &word : words)
          if (!word.empty())
            {
              if (number_in(word))
                take_member(mesh_words::whole(word, line), members);
              else
                for (const long number : of_set(word))
                  take_member(number, members);
            }
      }

      /// Sets of sets may grow beyond all memory.
      void take_member(const long number, std::vector<long> &members)
      {
        count_member(line);
        members.push_back(number);
      }

      void count_member(const unsigned int at)
      {
        if (++n_members > most_members)
          throw TextError(
            at, "has sets that name more than a hundred times as many numbers as the file has lines: "
                "write each number once in a set");
      }

      void take_faces(const Entries &words)
      {
        if (words.empty() || words[0].empty())
          throw TextError(line, "names no element and no set of a surface");
        surfaces.back().faces.emplace_back(words[0], words.size() > 1 ? in_capitals(words[1]) : "", line);
      }

      static bool is_known_boundary(const std::string &name)
      {
        for (long number = 1; number <= 4; ++number)
          if (mesh_words::lower(name) == mesh_words::name_of_number(number))
            return true;
        return false;
      }

      void add_surface(const Surface &surface)
      {
        MeshInput::Named &named = mesh.named(surface.name, surface.line);
        for (const auto &[of, face, at] : surface.faces)
          {
            std::vector<long> members;
            if (number_in(of))
              members.push_back(mesh_words::whole(of, at));
            else if (const auto set = elements_of.find(mesh_words::lower(of)); set != elements_of.end())
              members = set->second.members;
            else
              throw TextError(at, "there is no set '" + of + "'");
            for (const long number : members)
              {
                count_member(at);
                add_face(named, number, face, at);
              }
          }
      }

      void add_face(MeshInput::Named  &named,
                    const long         number,
                    const std::string &face,
                    const unsigned int at)
      {
        if (const auto found = elements.quadrilaterals.find(number); found != elements.quadrilaterals.end())
          return named.faces.push_back(found->second);
        const auto found = elements.hexahedra.find(number);
        if (found == elements.hexahedra.end())
          throw TextError(at,
                          "there is no element " + std::to_string(number) + " of which faces can be named");
        if (face.size() != 2 || face[0] != 'S' || face[1] < '1' || face[1] > '6')
          throw TextError(at, "'" + face + "' is no face of a hexahedron; S1 to S6 are");
        MeshInput::Quadrilateral quadrilateral{{}, at};
        for (unsigned int v = 0; v < 4; ++v)
          quadrilateral.nodes[v] = mesh.hexahedra[found->second].nodes[faces_of_hexahedron[face[1] - '1'][v]];
        named.faces.push_back(quadrilateral);
      }

      /// Sets of quadrilaterals are boundaries, those of hexahedra volumes.
      void add_set(const std::string &name, const Set &set)
      {
        const bool has_volume = std::any_of(set.members.begin(), set.members.end(), [&](const long number) {
          return elements.hexahedra.count(number) > 0;
        });
        if (has_volume && is_known_boundary(name))
          throw TextError(set.line, "the set '" + name +
                                      "' has hexahedra, and its name is that of a boundary: name faces, by "
                                      "*SURFACE, a set of nodes or of quadrilaterals");
        if (has_volume)
          {
            std::vector<unsigned int> &cells = mesh.volume(name).cells;
            for (const long number : set.members)
              if (const auto found = elements.hexahedra.find(number); found != elements.hexahedra.end())
                cells.push_back(found->second);
            return;
          }
        if (!set.is_named && !is_known_boundary(name))
          return;
        for (const long number : set.members)
          if (const auto found = elements.quadrilaterals.find(number); found != elements.quadrilaterals.end())
            mesh.named(name, set.line).faces.push_back(found->second);
      }

      MeshInput                  mesh;
      ElementsByNumber           elements;
      std::map<std::string, Set> elements_of;
      std::vector<Surface>       surfaces;
      std::vector<Section>       sections;
      KeywordLine                keyword;
      Entries                    pending; ///< entries of an element that goes on
      bool                       is_hexahedron = false, is_quadrilateral = false;
      bool                       is_in_block = false, is_in_step = false; ///< what is passed over
      unsigned int               n_instances = 0, line = 0;
      std::size_t                n_lines = 0, n_members = 0, most_members = 0; ///< of all sets
    };
  } // namespace


  MeshInput read_abaqus(const std::vector<std::string> &lines)
  {
    return AbaqusReader().read(lines);
  }
} // namespace tread
