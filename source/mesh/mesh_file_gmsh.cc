// SPDX-License-Identifier: LGPL-2.1-or-later
// Meshes as Gmsh writes them in ASCII: MSH 2.2 and 4.1 (Gmsh's reference manual, chapter on file formats).
#include <tread/base/text_file.h>
#include <tread/mesh/mesh_file.h>

#include "mesh_file_words.h"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <utility>

namespace tread
{
  namespace
  {
    /// Gmsh's numbers of the element types that are met.
    enum GmshType
    {
      line     = 1,
      triangle = 2,
      quad     = 3,
      hex      = 5,
      point    = 15
    };

    /// Of the types that a mesh of volumes may have and that cannot be used.
    std::string type_in_words(const long type)
    {
      switch (type)
        {
        case 4:
        case 11:
          return "a tetrahedron";
        case 6:
        case 13:
        case 18:
          return "a prism";
        case 7:
        case 14:
        case 19:
          return "a pyramid";
        case 12:
        case 17:
          return "a hexahedron of second order";
        case 8:
        case 9:
        case 10:
        case 16:
          return "an element of second order";
        default:
          return "of Gmsh's type " + std::to_string(type);
        }
    }

    std::string remedy_for(const long type)
    {
      return type == 12 || type == 17 || (type >= 8 && type <= 10) || type == 16
               ? mesh_words::make_first_order
               : mesh_words::make_hexahedra;
    }

    /// Numbers on the lines of a section, one line after the other.
    class GmshLines
    {
    public:
      explicit GmshLines(const std::vector<std::string> &lines)
        : lines(lines)
      {
      }
      /// The next line that is not empty; false at the end of the file.
      bool next()
      {
        while (at < lines.size() && lines[at].find_first_not_of(" \t\r") == std::string::npos)
          ++at;
        if (at == lines.size())
          return false;
        text = mesh_words::trimmed(lines[at++]);
        return true;
      }
      /// The next line's words, of which there must be so many. @param section for messages
      std::vector<std::string> words(const std::size_t least, const std::string &section)
      {
        if (!next() || text[0] == '$')
          throw TextError(at, "$" + section +
                                " ends too early: the file is cut off, or its numbers of lines are wrong");
        std::vector<std::string> found = entries_of(text, ' ');
        if (found.size() < least)
          throw TextError(at, "has " + std::to_string(found.size()) + " entries in $" + section +
                                "; at least " + std::to_string(least) + " are needed");
        return found;
      }
      /// The next line that is not empty stays the next one.
      bool next_is(const std::string &wanted)
      {
        const std::size_t before = at;
        const bool        found  = next() && text == wanted;
        at                       = before;
        return found;
      }
      unsigned int number() const
      {
        return at;
      }
      std::string text;

    private:
      const std::vector<std::string> &lines;
      std::size_t                     at = 0;
    };

    /// Dimension and number of a physical group.
    using PhysicalGroup = std::pair<long, long>;

    class GmshReader
    {
    public:
      explicit GmshReader(const std::vector<std::string> &text)
        : in(text)
      {
      }

      MeshInput read()
      {
        static const std::set<std::string> counted{"$PhysicalNames", "$Entities", "$Nodes", "$Elements"};
        std::set<std::string>              seen;
        while (in.next())
          {
            const std::string section = in.text;
            n_expected.clear();
            if (section[0] != '$')
              throw TextError(in.number(), "a section's name, such as $Nodes, is missing");
            if (section == "$MeshFormat")
              read_version();
            else if (section == "$PhysicalNames")
              read_names();
            else if (section == "$Entities")
              read_entities();
            else if (section == "$Nodes")
              is_new ? read_new_nodes() : read_old_nodes();
            else if (section == "$Elements")
              is_new ? read_new_elements() : read_old_elements();
            else if (section != "$Comments")
              mesh.pass_over(section, in.number());
            end_of(section.substr(1));
            if (!seen.insert(section).second && counted.count(section) > 0)
              throw TextError(in.number(), "is the end of a second " + section + ": write one of them");
          }
        for (const std::string section : {"$MeshFormat", "$Nodes", "$Elements"})
          if (seen.count(section) == 0)
            throw TextError(0, "has no " + section + ": it is no mesh of Gmsh, or it is cut off");
        return std::move(mesh);
      }

    private:
      /// To the end of a section. One of which the lines are counted must end here.
      void end_of(const std::string &section)
      {
        if (!n_expected.empty() && !in.next_is("$End" + section) && in.next() && in.text[0] != '$')
          throw TextError(in.number(), "goes on with '" + shortened(in.text) + "' where $" + section +
                                         " should end, which has " + n_expected +
                                         ": the count is wrong, or the file is damaged");
        while (in.next())
          if (in.text == "$End" + section)
            return;
        throw TextError(0, "ends within $" + section + ": the file is cut off");
      }

      static std::string shortened(const std::string &text)
      {
        constexpr std::size_t most = 40;
        return text.size() > most ? text.substr(0, most) + "..." : text;
      }

      /// A number of lines or blocks at the head of a section or of a block. @param of what is counted
      long count(const std::string &word, const std::string &of)
      {
        const long n = whole(word);
        if (n < 0)
          throw TextError(in.number(), "'" + word + "' is no number of " + of);
        n_expected = word + " " + of;
        return n;
      }

      long whole(const std::string &word)
      {
        return mesh_words::whole(word, in.number());
      }
      double value(const std::string &word)
      {
        return mesh_words::value(word, in.number());
      }

      void read_version()
      {
        const auto words = in.words(3, "MeshFormat");
        if (words[0] != "2.2" && words[0] != "2" && words[0] != "2.1" && words[0] != "4.1")
          throw TextError(in.number(), "has the version " + words[0] +
                                         "; 2.2 and 4.1 are read (Mesh.MshFileVersion = 4.1)");
        is_new = words[0] == "4.1";
      }

      void read_names()
      {
        const long n = count(in.words(1, "PhysicalNames")[0], "names");
        for (long i = 0; i < n; ++i)
          {
            const auto words = in.words(3, "PhysicalNames");
            const auto begin = in.text.find('"'), end = in.text.rfind('"');
            if (begin == std::string::npos || end == begin)
              throw TextError(in.number(), "has no name in quotation marks");
            names[{whole(words[0]), std::abs(whole(words[1]))}] = {in.text.substr(begin + 1, end - begin - 1),
                                                                   in.number()};
          }
      }

      /// Surfaces and volumes have a box, physical groups, and what bounds them.
      void read_entities()
      {
        const auto            counts          = in.words(4, "Entities");
        constexpr std::size_t before_groups[] = {4, 7, 7, 7};
        for (unsigned int dimension = 0; dimension < 4; ++dimension)
          for (long i = 0, n = count(counts[dimension], dimension == 3 ? "volumes" : "entities"); i < n; ++i)
            {
              const auto words    = in.words(before_groups[dimension] + 1, "Entities");
              const long n_groups = whole(words[before_groups[dimension]]);
              if (n_groups < 0 || before_groups[dimension] + n_groups >= words.size())
                throw TextError(in.number(), "has fewer physical groups than it says");
              for (long k = 1; k <= n_groups; ++k)
                groups_of[{dimension, whole(words[0])}].push_back(
                  std::abs(whole(words[before_groups[dimension] + k]))); // negative: turned over
            }
      }

      void read_old_nodes()
      {
        for (long i = 0, n = count(in.words(1, "Nodes")[0], "nodes"); i < n; ++i)
          {
            const auto words = in.words(4, "Nodes");
            mesh.add_node(whole(words[0]), {value(words[1]), value(words[2]), value(words[3])}, in.number());
          }
      }

      void read_new_nodes()
      {
        const long n_blocks = count(in.words(4, "Nodes")[0], "blocks");
        for (long block = 0; block < n_blocks; ++block)
          {
            std::vector<long> numbers;
            for (long i = 0, n = count(in.words(4, "Nodes")[3], "nodes in its last block"); i < n; ++i)
              numbers.push_back(whole(in.words(1, "Nodes")[0]));
            for (const long number : numbers)
              {
                const auto words = in.words(3, "Nodes");
                mesh.add_node(number, {value(words[0]), value(words[1]), value(words[2])}, in.number());
              }
          }
      }

      void read_old_elements()
      {
        for (long i = 0, n = count(in.words(1, "Elements")[0], "elements"); i < n; ++i)
          {
            const auto words = in.words(4, "Elements");
            const long type = whole(words[1]), n_tags = whole(words[2]);
            if (n_tags < 1 || n_tags + 3 >= static_cast<long>(words.size()))
              throw TextError(in.number(), "has fewer entries than its number of tags says");
            const long group = std::abs(whole(words[3])); // negative: turned over
            add(type, {words.begin() + 3 + n_tags, words.end()},
                group == 0 ? std::vector<long>() : std::vector<long>{group});
          }
      }

      void read_new_elements()
      {
        const long n_blocks = count(in.words(4, "Elements")[0], "blocks");
        for (long block = 0; block < n_blocks; ++block)
          {
            const auto words  = in.words(4, "Elements");
            const long type   = whole(words[2]);
            const auto groups = groups_of[{whole(words[0]), whole(words[1])}];
            for (long i = 0, n = count(words[3], "elements in its last block"); i < n; ++i)
              {
                const auto entries = in.words(2, "Elements");
                add(type, {entries.begin() + 1, entries.end()}, groups);
              }
          }
      }

      /// @param words numbers of its nodes
      void add(const long type, const std::vector<std::string> &words, const std::vector<long> &groups)
      {
        if (type == point || type == line)
          return;
        if (type != hex && type != quad)
          {
            if (type == triangle)
              throw TextError(in.number(), std::string("is a triangle: ") + mesh_words::make_hexahedra);
            throw TextError(in.number(), "is " + type_in_words(type) + ": " + remedy_for(type));
          }
        const std::size_t n_nodes = type == hex ? 8 : 4;
        if (words.size() != n_nodes)
          throw TextError(in.number(), "has " + std::to_string(words.size()) + " nodes in place of " +
                                         std::to_string(n_nodes));
        if (type == hex)
          {
            mesh.hexahedra.push_back({mesh_words::numbers<8>(words, in.number()), in.number()});
            for (const long group : groups)
              volume(group).cells.push_back(mesh.hexahedra.size() - 1);
            return;
          }
        for (const long group : groups)
          {
            const auto name = names.find({2, group});
            if (name == names.end() && has_named_surfaces())
              throw TextError(in.number(),
                              "has a physical surface " + std::to_string(group) +
                                " without a name beside others that have one: name it, or remove it");
            mesh
              .named(name != names.end() ? name->second.first : mesh_words::name_of_number(group),
                     name != names.end() ? name->second.second : in.number())
              .faces.push_back({mesh_words::numbers<4>(words, in.number()), in.number()});
          }
      }

      /// Without names the numbers 1 to 4 mean boundaries; beside names they may mean anything.
      bool has_named_surfaces() const
      {
        return std::any_of(names.begin(), names.end(),
                           [](const auto &name) { return name.first.first == 2; });
      }

      MeshVolume &volume(const long group)
      {
        const auto found = names.find({3, group});
        return mesh.volume(found != names.end() ? found->second.first : std::to_string(group));
      }

      GmshLines   in;
      MeshInput   mesh;
      bool        is_new = false;
      std::string n_expected; // what the section says that it has; empty: its lines are not counted
      std::map<PhysicalGroup, std::pair<std::string, unsigned int>> names; // and their lines
      std::map<PhysicalGroup, std::vector<long>> groups_of; // of an entity by dimension and number
    };
  } // namespace


  MeshInput read_gmsh(const std::vector<std::string> &lines)
  {
    return GmshReader(lines).read();
  }
} // namespace tread
