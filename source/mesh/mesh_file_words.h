// SPDX-License-Identifier: LGPL-2.1-or-later
// What the readers of mesh files share: words of a line as numbers.
#ifndef tread_mesh_mesh_file_words_h
#define tread_mesh_mesh_file_words_h

#include <tread/base/text_file.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace tread::mesh_words
{
  inline constexpr const char *make_hexahedra =
    "only hexahedra with 8 nodes are read; divide the volumes into blocks of them (Gmsh: transfinite or "
    "extruded surfaces with Recombine)";
  inline constexpr const char *make_first_order =
    "only hexahedra with 8 nodes are read; mesh with first order (Gmsh: Mesh.ElementOrder = 1)";

  inline constexpr const char *one_steel =
    "both have the steel of section 'Rail' or one and the same of "
    "'Rail/Materials'; give what is of another one there, or leave it out";

  inline std::string trimmed(const std::string &text)
  {
    const auto begin = text.find_first_not_of(" \t\r"), end = text.find_last_not_of(" \t\r");
    return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
  }

  inline std::string lower(std::string text)
  {
    for (char &c : text)
      if (c >= 'A' && c <= 'Z')
        c += 'a' - 'A';
    return text;
  }

  /// @throws TextError with the line
  inline double value(const std::string &word, const unsigned int line)
  {
    const auto number = number_in(word);
    if (!number || !std::isfinite(*number))
      throw TextError(line, "'" + word + "' is no number");
    return *number;
  }

  inline long whole(const std::string &word, const unsigned int line)
  {
    constexpr double most   = 1e15; // exact in a double
    const double     number = value(word, line);
    if (number != std::floor(number) || std::abs(number) > most)
      throw TextError(line, "'" + word + "' is no whole number");
    return static_cast<long>(number);
  }

  template <std::size_t n>
  std::array<long, n> numbers(const std::vector<std::string> &words, const unsigned int line)
  {
    std::array<long, n> list;
    for (std::size_t i = 0; i < n; ++i)
      list[i] = whole(words[i], line);
    return list;
  }

  /// Boundaries that are numbered and have no name: deal.II's and the program's own numbers.
  inline std::string name_of_number(const long number)
  {
    static const std::array<const char *, 5> names{{"free", "contact", "support", "end", "symmetry"}};
    return number >= 0 && number < static_cast<long>(names.size()) ? names[number] : std::to_string(number);
  }
} // namespace tread::mesh_words

#endif
