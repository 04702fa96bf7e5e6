// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/csv_table.h>
#include <tread/base/input_error.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
    bool is_empty(const std::string &line)
    {
      return line.find_first_not_of(" \t\r") == line.npos;
    }

    bool is_number(const std::string &entry)
    {
      return number_in(entry, '.') || number_in(entry, ',');
    }
  } // namespace


  std::vector<NumberedLine> csv_lines(const std::string &file)
  {
    std::vector<NumberedLine> lines;
    unsigned int              number = 0;
    for (std::string &line : read_lines(file))
      {
        ++number;
        // Comments may stand before the names.
        if (!is_empty(line) && !(lines.empty() && (line.front() == '#' || line.front() == '%')))
          lines.push_back({number, std::move(line)});
      }
    return lines;
  }


  CsvTable::CsvTable(const std::string                              &file,
                     const std::function<bool(const std::string &)> &wanted,
                     const std::string                              &unreadable,
                     const std::function<bool(const std::string &)> &is_word)
    : file(file)
  {
    const std::vector<NumberedLine> lines = [&] {
      try
        {
          return csv_lines(file);
        }
      catch (const TextError &error)
        {
          const std::string what = error.what();
          throw InputError(unreadable + (what == "cannot be read" ? "" : ": it " + what));
        }
    }();
    if (lines.empty())
      throw InputError("'" + file + "' is empty");
    const std::vector<NumberedLine> below(lines.begin() + 1, lines.end());
    try
      {
        grammar_of_rows = grammar_below(lines.front().text, below);
      }
    catch (const TextError &error)
      {
        throw InputError("'" + file + "', " + error.what());
      }
    const char               separator = grammar_of_rows.separator, decimal = grammar_of_rows.decimal;
    std::vector<std::string> all = entries_of(lines.front().text, separator);
    if (all.size() > 1 && all.back().empty()) // a separator that ends the line
      all.pop_back();
    if (std::all_of(all.begin(), all.end(), is_number))
      throw InputError("'" + file +
                       "' begins with numbers, where the names of the columns must stand: a matrix, "
                       "or a table without its first line, cannot be read");
    std::vector<std::size_t> place;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (const std::string &name = all[i]; wanted(name))
        {
          if (has(name))
            throw InputError("'" + file + "' has two columns '" + name + "'");
          place.push_back(i);
          read_names.push_back(name);
        }
    const std::size_t n_columns = all.size();
    values.resize(place.size());
    texts.resize(place.size());
    for (const NumberedLine &line : below)
      {
        // What stands behind numbers as a comment; words may have its sign in them.
        const std::string text  = is_word ? line.text : line.text.substr(0, line.text.find('#'));
        auto              parts = entries_of(text, separator);
        if (is_empty(text))
          continue;
        if (parts.size() == n_columns + 1 && parts.back().empty())
          parts.pop_back();
        const std::string where = "'" + file + "', row " + std::to_string(++rows) + ": ";
        if (parts.size() != n_columns)
          throw InputError(where + std::to_string(parts.size()) + " entries for " +
                           std::to_string(n_columns) + " columns" +
                           (separator == ',' && parts.size() > n_columns
                              ? ": numbers with decimal commas need semicolons between the columns"
                              : ""));
        for (std::size_t i = 0; i < place.size(); ++i)
          {
            if (is_word && is_word(read_names[i]))
              {
                texts[i].push_back(parts[place[i]]);
                continue;
              }
            const auto value = number_in(parts[place[i]], decimal);
            if (!value)
              fail(rows, i, parts[place[i]]);
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
