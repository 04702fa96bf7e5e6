// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_text_file_h
#define tread_base_text_file_h

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tread
{
  /// What is wrong with a file of text: one line without the file's name.
  class TextError : public std::runtime_error
  {
  public:
    /// @param line number of the line in the file; 0: the file as a whole
    TextError(const unsigned int line, const std::string &what)
      : std::runtime_error(line > 0 ? "line " + std::to_string(line) + ": " + what : what)
    {
    }
  };

  /// The lines of a file, whatever program wrote it: UTF-8 or UTF-16, with or without a byte order mark,
  /// lines that end as those of Unix, of Windows or of old Macs (a carriage return alone). Blanks that do not
  /// break are blanks, and the minus sign of Unicode is one.
  /// @throws TextError where the file cannot be read, is a folder, is compressed, a spreadsheet, or no text
  std::vector<std::string> read_lines(const std::string &file);

  /// A line of numbers, and where it stands in its file.
  struct NumberedLine
  {
    unsigned int number;
    std::string  text;
  };

  /// How a table separates its columns, and which sign stands before its decimals.
  struct TableGrammar
  {
    char separator = ' '; ///< a blank stands for any number of blanks and tabs
    char decimal   = '.';
  };

  /// The grammar of a table without names: a comma is a decimal comma where columns are separated by
  /// something else, and it separates columns where it alone can do so.
  /// @throws TextError with the line where both readings are possible, or where lines contradict each other
  TableGrammar grammar_of(const std::vector<NumberedLine> &rows);

  /// The grammar of a table whose first line has the names of its columns.
  /// @param rows the lines below it
  TableGrammar grammar_below(const std::string &names, const std::vector<NumberedLine> &rows);

  /// Entries without the blanks and the quotes around them. Separators in quotes do not separate.
  /// Behind a separator at the end of the line there is an empty entry.
  std::vector<std::string> entries_of(const std::string &line, const char separator);

  /// The number that an entry is, the same in any locale; Fortran's exponents (1.0D-3) too. None if it is no
  /// number, or if it has another decimal sign. May be nan or infinite.
  std::optional<double> number_in(std::string_view entry, const char decimal = '.');

  /// The line up to the first word that begins with a letter: remarks may follow numbers. nan and inf are no
  /// words.
  std::string without_remark(const std::string &line);
} // namespace tread

#endif
