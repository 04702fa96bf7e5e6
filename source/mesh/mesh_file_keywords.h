// SPDX-License-Identifier: LGPL-2.1-or-later
// What the readers of files of keywords share, Abaqus (.inp) and LS-DYNA (.k): a line with a keyword, and
// elements by their numbers. What is no mesh and cannot change the answer, such as steps and output, is
// passed over and named; what would change it is refused (mesh_file_foreign.h).
#ifndef tread_mesh_mesh_file_keywords_h
#define tread_mesh_mesh_file_keywords_h

#include <tread/base/text_file.h>
#include <tread/mesh/mesh_file.h>

#include "mesh_file_words.h"

#include <map>
#include <string>
#include <vector>

namespace tread::mesh_keywords
{
  using Entries = std::vector<std::string>;

  /// Elements by their numbers, of which sets are made.
  struct ElementsByNumber
  {
    std::map<long, std::size_t>              hexahedra; // place in the mesh
    std::map<long, MeshInput::Quadrilateral> quadrilaterals;

    void check_free(const long number, const unsigned int line) const
    {
      if (hexahedra.count(number) + quadrilaterals.count(number) > 0)
        throw TextError(line, "element " + std::to_string(number) + " is there already");
    }
  };

  /// A line with a keyword: its name in capitals, and parameters by their names in capitals.
  struct KeywordLine
  {
    std::string                        name;
    std::map<std::string, std::string> parameters;

    std::string parameter(const std::string &wanted) const
    {
      const auto found = parameters.find(wanted);
      return found == parameters.end() ? "" : found->second;
    }
  };

  inline std::string in_capitals(std::string text)
  {
    for (char &c : text)
      if (c >= 'a' && c <= 'z')
        c -= 'a' - 'A';
    return text;
  }

  /// Parts of a line between commas that stand in no quotation marks, which are kept.
  inline Entries parts_between_commas(const std::string &line)
  {
    Entries parts(1);
    bool    is_quoted = false;
    for (const char c : line)
      {
        is_quoted = is_quoted != (c == '"');
        if (c == ',' && !is_quoted)
          parts.emplace_back();
        else
          parts.back() += c;
      }
    return parts;
  }

  /// Names may stand in quotation marks.
  inline std::string without_quotes(std::string text)
  {
    text = mesh_words::trimmed(text);
    return text.size() > 1 && text.front() == '"' && text.back() == '"'
             ? mesh_words::trimmed(text.substr(1, text.size() - 2))
             : text;
  }

  inline KeywordLine keyword_in(const std::string &line)
  {
    const Entries words = parts_between_commas(line);
    KeywordLine   keyword;
    for (const std::string &word : entries_of(in_capitals(mesh_words::trimmed(words[0])).substr(1), ' '))
      keyword.name += (keyword.name.empty() ? "" : " ") + word;
    for (std::size_t i = 1; i < words.size(); ++i)
      {
        const auto equals = words[i].find('=');
        keyword.parameters[in_capitals(mesh_words::trimmed(words[i].substr(0, equals)))] =
          equals == std::string::npos ? "" : without_quotes(words[i].substr(equals + 1));
      }
    return keyword;
  }

  inline void refuse_keyword(const unsigned int line, const std::string &keyword, const std::string &instead)
  {
    throw TextError(line, "*" + keyword + " is not read: " + instead);
  }
} // namespace tread::mesh_keywords

#endif
