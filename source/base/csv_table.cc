// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/csv_table.h>
#include <tread/base/input_error.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>

namespace tread
{
  namespace
  {
    std::string_view without_blanks(std::string_view text)
    {
      const auto first = text.find_first_not_of(" \t\r");
      return first == text.npos ? std::string_view()
                                : text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
    }

    std::vector<std::string_view> split(const std::string_view line)
    {
      std::vector<std::string_view> parts;
      for (std::size_t begin = 0; begin <= line.size();)
        {
          const std::size_t end = std::min(line.find(',', begin), line.size());
          parts.push_back(without_blanks(line.substr(begin, end - begin)));
          begin = end + 1;
        }
      return parts;
    }

    /// The same in any locale.
    std::optional<double> number(std::string_view text)
    {
      if (text.size() > 1 && text.front() == '+' && text[1] != '-')
        text.remove_prefix(1);
      double     value  = 0.;
      const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
      if (result.ec != std::errc() || result.ptr != text.data() + text.size())
        return {};
      return value;
    }
  } // namespace


  CsvTable::CsvTable(const std::string                              &file,
                     const std::function<bool(const std::string &)> &wanted,
                     const std::string                              &unreadable,
                     const std::function<bool(const std::string &)> &is_word)
    : file(file)
  {
    std::ifstream stream(file);
    std::string   line;
    if (!std::getline(stream, line))
      throw InputError(stream.is_open() && stream.eof() ? "'" + file + "' is empty" : unreadable);
    if (line.compare(0, 3, "\xef\xbb\xbf") == 0) // byte order mark
      line.erase(0, 3);
    const std::vector<std::string_view> all = split(line);
    std::vector<std::size_t>            place;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (const std::string name(all[i]); wanted(name))
        {
          if (has(name))
            throw InputError("'" + file + "' has two columns '" + name + "'");
          place.push_back(i);
          read_names.push_back(name);
        }
    const std::size_t n_columns = all.size();
    values.resize(place.size());
    texts.resize(place.size());
    while (std::getline(stream, line))
      {
        if (without_blanks(line).empty())
          continue;
        const std::string where = "'" + file + "', row " + std::to_string(++rows) + ": ";
        const auto        parts = split(line);
        if (parts.size() != n_columns)
          throw InputError(where + std::to_string(parts.size()) + " entries for " +
                           std::to_string(n_columns) + " columns");
        for (std::size_t i = 0; i < place.size(); ++i)
          {
            if (is_word && is_word(read_names[i]))
              {
                texts[i].emplace_back(parts[place[i]]);
                continue;
              }
            const auto value = number(parts[place[i]]);
            if (!value)
              fail(rows, i, std::string(parts[place[i]]));
            values[i].push_back(*value);
          }
      }
  }


  bool CsvTable::has(const std::string &name) const
  {
    return std::find(read_names.begin(), read_names.end(), name) != read_names.end();
  }


  std::size_t CsvTable::place_of(const std::string &name) const
  {
    const auto at = std::find(read_names.begin(), read_names.end(), name);
    if (at == read_names.end())
      throw InputError("'" + file + "' has no column '" + name + "'");
    return at - read_names.begin();
  }


  void CsvTable::fail(const std::size_t row, const std::size_t place, const std::string &text) const
  {
    throw InputError("'" + file + "', row " + std::to_string(row) + ": '" + read_names[place] + "' is '" +
                     text + "', which is no number");
  }


  const std::vector<double> &CsvTable::column(const std::string &name) const
  {
    const std::size_t place = place_of(name);
    for (std::size_t row = 0; row < rows; ++row)
      if (!std::isfinite(values[place][row]))
        fail(row + 1, place, std::isnan(values[place][row]) ? "nan" : "inf");
    return values[place];
  }


  const std::vector<double> &CsvTable::column_as_it_is(const std::string &name) const
  {
    return values[place_of(name)];
  }


  const std::vector<std::string> &CsvTable::words(const std::string &name) const
  {
    return texts[place_of(name)];
  }
} // namespace tread
