// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_csv_table_h
#define tread_base_csv_table_h

#include <functional>
#include <string>
#include <vector>

namespace tread
{
  /// Columns of finite numbers from a file: names in its first line, commas between entries.
  class CsvTable
  {
  public:
    /// @param wanted     whether a column is read, by its name; entries of others may be anything
    /// @param unreadable what an InputError says if the file cannot be read
    /// @throws InputError with file and row also if a row has too few or too many entries, or one that is no
    /// finite number
    CsvTable(const std::string                              &file,
             const std::function<bool(const std::string &)> &wanted,
             const std::string                              &unreadable);

    const std::string file;

    /// Of the columns that were read, as they follow in the file.
    const std::vector<std::string> &names() const
    {
      return read_names;
    }
    bool has(const std::string &name) const;
    /// @throws InputError if there is none
    const std::vector<double> &column(const std::string &name) const;
    std::size_t                n_rows() const
    {
      return rows;
    }

  private:
    std::vector<std::string>         read_names;
    std::vector<std::vector<double>> values;
    std::size_t                      rows = 0;
  };
} // namespace tread

#endif
