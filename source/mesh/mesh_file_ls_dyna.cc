// SPDX-License-Identifier: LGPL-2.1-or-later
// Meshes in files of LS-DYNA (.k).
#include <tread/base/text_file.h>
#include <tread/mesh/mesh_file.h>

#include "mesh_file_foreign.h"
#include "mesh_file_keywords.h"
#include "mesh_file_words.h"

#include <map>
#include <string>
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

    /// Fields of a line of LS-DYNA: of fixed widths, or separated by commas. Empty ones at the end are left
    /// out.
    Entries fields_of(const std::string &text, const std::vector<unsigned int> &widths)
    {
      Entries words;
      if (text.find(',') != std::string::npos)
        words = entries_of(text, ',');
      else
        for (std::size_t at = 0, i = 0; i < widths.size() && at < text.size(); at += widths[i++])
          words.push_back(mesh_words::trimmed(text.substr(at, widths[i])));
      while (!words.empty() && words.back().empty())
        words.pop_back();
      return words;
    }

    class LsDynaReader
    {
    public:
      MeshInput read(const std::vector<std::string> &lines)
      {
        for (const std::string &text : lines)
          {
            ++line;
            if (text[0] == '$' || (text.find_first_not_of(" \t\r") == std::string::npos && !awaits_title))
              continue;
            if (text[0] != '*')
              take(text);
            else if (in_capitals(text).compare(0, 4, "*END") == 0)
              break;
            else
              begin(keyword_in(text));
          }
        if (!first_half.empty())
          throw TextError(line, "ends within an element: the file is cut off");
        check_numbered_sets();
        for (const auto &[part, quadrilateral] : shells)
          {
            const auto title = titles.find(part);
            mesh
              .named(title != titles.end() ? title->second.first : "part " + std::to_string(part),
                     title != titles.end() ? title->second.second : quadrilateral.line)
              .faces.push_back(quadrilateral);
          }
        for (const auto &[part, cells] : cells_of_part)
          {
            const auto        title = titles.find(part);
            const std::string volume =
              title != titles.end() ? title->second.first : "part " + std::to_string(part);
            std::vector<unsigned int> &all = mesh.volume(volume).cells;
            all.insert(all.end(), cells.begin(), cells.end());
            if (const auto given = materials.find(part); given != materials.end() && given->second.first != 0)
              mesh.give_material(volume, std::to_string(given->second.first), given->second.second);
          }
        return std::move(mesh);
      }

    private:
      void begin(const KeywordLine &now)
      {
        if (!first_half.empty())
          throw TextError(line, "begins within an element: the file is cut off");
        keyword      = now.name;
        awaits_title = awaits_number = false;
        name.clear();
        if (keyword.find("LONG=Y") != keyword.npos || in_capitals(now.parameter("LONG")) == "Y" ||
            keyword.find("I10=Y") != keyword.npos || in_capitals(now.parameter("I10")) == "Y" ||
            (!keyword.empty() && (keyword.back() == '+' || keyword.back() == '%')))
          refuse_keyword(line, keyword, "write fields of the usual width, or commas");
        if (!is_read())
          return refuse_or_pass_over();
        const bool is_set =
          keyword.compare(0, 8, "SET_NODE") == 0 || keyword.compare(0, 11, "SET_SEGMENT") == 0;
        constexpr const char *title     = "_TITLE";
        const auto            at        = keyword.rfind(title);
        const bool            has_title = is_set && at != std::string::npos;
        if (has_title)
          keyword = keyword.substr(0, at);
        if (is_set && keyword != "SET_NODE_LIST" && keyword != "SET_NODE" && keyword != "SET_SEGMENT")
          refuse_keyword(line, keyword,
                         "list the nodes or segments: *SET_NODE_LIST_TITLE, *SET_SEGMENT_TITLE");
        awaits_title  = has_title || keyword == "PART";
        awaits_number = is_set || keyword == "PART";
      }

      bool is_read() const
      {
        for (const char *whole : {"NODE", "ELEMENT_SOLID", "ELEMENT_SHELL", "PART"})
          if (keyword == whole)
            return true;
        for (const char *begin : {"KEYWORD", "TITLE", "SET_NODE", "SET_SEGMENT"})
          if (mesh_foreign::begins_with(keyword, begin))
            return true;
        return false;
      }

      void refuse_or_pass_over()
      {
        if (const char *instead =
              mesh_foreign::instead_of(keyword, mesh_foreign::refused_of_ls_dyna(), false))
          refuse_keyword(line, keyword, instead);
        if (mesh_foreign::begins_with(keyword, "CONTACT") && keyword.find("TIE") != keyword.npos)
          refuse_keyword(line, keyword, mesh_foreign::join_nodes);
        for (const std::string &begin : mesh_foreign::passed_over_of_ls_dyna())
          if (mesh_foreign::begins_with(keyword, begin))
            return mesh.pass_over("*" + keyword, line);
        refuse_keyword(line, keyword, mesh_foreign::unknown);
      }

      /// Without titles the numbers 1 to 4 mean boundaries; beside sets with titles they may mean anything.
      void check_numbered_sets()
      {
        if (numbered.empty())
          return;
        if (!titled.empty())
          throw TextError(numbered.front().second,
                          "has a set " + std::to_string(numbered.front().first) +
                            " without a title beside '" + titled + "', which has one: is it the boundary '" +
                            mesh_words::name_of_number(numbered.front().first) +
                            "'? Give all sets titles (*SET_SEGMENT_TITLE), or remove it");
        std::string meanings;
        for (const auto &[number, at] : numbered)
          meanings += (meanings.empty() ? "" : ", ") + std::to_string(number) + " as '" +
                      mesh_words::name_of_number(number) + "'";
        mesh.doubts.push_back("has sets without titles, which are taken by their numbers: " + meanings);
      }

      void take(const std::string &text)
      {
        if (awaits_title)
          {
            name         = mesh_words::trimmed(text);
            awaits_title = false;
          }
        else if (awaits_number)
          take_number(text);
        else if (keyword == "NODE")
          take_node(fields_of(text, {8, 16, 16, 16, 8, 8}));
        else if (keyword == "ELEMENT_SOLID")
          take_solid(text);
        else if (keyword == "ELEMENT_SHELL")
          {
            const Entries words = fields_of(text, {8, 8, 8, 8, 8, 8});
            require_entries(words, 6, "an element");
            shells.push_back({mesh_words::whole(words[1], line),
                              {mesh_words::numbers<4>({words.begin() + 2, words.end()}, line), line}});
          }
        else if (keyword == "SET_NODE_LIST" || keyword == "SET_NODE")
          for (const std::string &word : fields_of(text, std::vector<unsigned int>(8, 10)))
            {
              if (const long number = mesh_words::whole(word, line); number != 0)
                mesh.named(name, line).nodes.push_back(number);
            }
        else if (keyword == "SET_SEGMENT")
          {
            const Entries words = fields_of(text, std::vector<unsigned int>(4, 10));
            require_entries(words, 4, "a segment");
            mesh.named(name, line).faces.push_back({mesh_words::numbers<4>(words, line), line});
          }
      }

      void require_entries(const Entries &words, const std::size_t n, const std::string &what) const
      {
        if (words.size() < n)
          throw TextError(line, "has " + std::to_string(words.size()) + " entries; " + what + " has " +
                                  std::to_string(n));
      }

      /// The number of a set or of a part, on the line behind its title.
      void take_number(const std::string &text)
      {
        const Entries words = fields_of(text, {10, 10, 10});
        require_entries(words, 1, "a set or a part");
        const long number = mesh_words::whole(words[0], line);
        awaits_number     = keyword == "PART";
        if (keyword == "PART")
          {
            titles[number] = {name.empty() ? std::to_string(number) : name, line};
            if (words.size() > 2 && !words[2].empty())
              materials[number] = {mesh_words::whole(words[2], line), line};
            awaits_title = true; // parts may follow each other
          }
        else
          {
            if (name.empty())
              numbered.emplace_back(number, line);
            else
              titled = name;
            name = name.empty() ? mesh_words::name_of_number(number) : name;
            mesh.named(name, line);
          }
      }

      void take_node(const Entries &words)
      {
        require_entries(words, 4, "a node");
        mesh.add_node(mesh_words::whole(words[0], line),
                      {mesh_words::value(words[1], line), mesh_words::value(words[2], line),
                       mesh_words::value(words[3], line)},
                      line);
        for (std::size_t i = 4; i < words.size(); ++i)
          if (!words[i].empty() && mesh_words::value(words[i], line) != 0.)
            mesh.pass_over("constraints of nodes", line);
      }

      /// All on one line, or the nodes on a second one.
      void take_solid(const std::string &text)
      {
        Entries words = fields_of(text, std::vector<unsigned int>(10, 8));
        if (first_half.empty() && words.size() == 2)
          {
            first_half = words;
            return;
          }
        words.insert(words.begin(), first_half.begin(), first_half.end());
        first_half.clear();
        require_entries(words, 10, "an element");
        const long number = mesh_words::whole(words[0], line), part = mesh_words::whole(words[1], line);
        elements.check_free(number, line);
        elements.hexahedra[number] = mesh.hexahedra.size();
        cells_of_part[part].push_back(mesh.hexahedra.size());
        mesh.hexahedra.push_back({mesh_words::numbers<8>({words.begin() + 2, words.end()}, line), line});
      }

      MeshInput                                              mesh;
      ElementsByNumber                                       elements;
      std::vector<std::pair<long, MeshInput::Quadrilateral>> shells; // and their parts
      std::map<long, std::vector<unsigned int>>              cells_of_part;
      std::map<long, std::pair<std::string, unsigned int>>   titles;    // of parts, and their lines
      std::map<long, std::pair<long, unsigned int>>          materials; // of parts, and their lines
      std::vector<std::pair<long, unsigned int>> numbered; // sets without a title, and their lines
      std::string                                titled;   // a set with one
      std::string                                keyword, name;
      Entries                                    first_half; // number and part of a solid
      bool                                       awaits_title = false, awaits_number = false;
      unsigned int                               line = 0;
    };
  } // namespace


  MeshInput read_ls_dyna(const std::vector<std::string> &lines)
  {
    return LsDynaReader().read(lines);
  }
} // namespace tread
