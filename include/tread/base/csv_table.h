// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_csv_table_h
#define tread_base_csv_table_h

#include <tread/base/text_file.h>

#include <functional>
#include <string>
#include <vector>

namespace tread
{
  /// The lines of a table that are not empty, those of comments before its names left out. @throws TextError
  std::vector<NumberedLine> csv_lines(const std::string &file);

  /// Columns of numbers from a file: names in its first line; commas, semicolons or tabs between entries, as
  /// in that line. Numbers may have decimal commas where commas do not separate, and may stand in quotes.
  class CsvTable
  {
  public:
    /// @param wanted     whether a column is read, by its name; entries of others may be anything
    /// @param unreadable what an InputError says if the file cannot be read
    /// @param is_word    whether a column that is read has words and no numbers
    /// @throws InputError with file and row also if a row has too few or too many entries, or one that is no
    /// number
    CsvTable(const std::string                              &file,
             const std::function<bool(const std::string &)> &wanted,
             const std::string                              &unreadable,
             const std::function<bool(const std::string &)> &is_word = {});

    const std::string file;

    /// Of the columns that were read, as they follow in the file.
    const std::vector<std::string> &names() const
    {
      return read_names;
    }
    bool has(const std::string &name) const;
    /// @throws InputError if there is none, or if it has a nan
    const std::vector<double> &column(const std::string &name) const;
    /// May have nan.
    const std::vector<double> &column_as_it_is(const std::string &name) const;
    /// Of one with words. @throws InputError if there is none
    const std::vector<std::string> &words(const std::string &name) const;
    std::size_t                     n_rows() const
    {
      return rows;
    }
    const TableGrammar &grammar() const
    {
      return grammar_of_rows;
    }

  private:
    std::vector<std::string>              read_names;
    std::vector<std::vector<double>>      values; // empty for words
    std::vector<std::vector<std::string>> texts;  // empty for numbers
    std::size_t                           place_of(const std::string &name) const;
    [[noreturn]] void fail(std::size_t row, std::size_t place, const std::string &text) const;
    std::size_t       rows = 0;
    TableGrammar      grammar_of_rows;
  };
} // namespace tread

#endif
