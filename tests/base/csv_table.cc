// SPDX-License-Identifier: LGPL-2.1-or-later
// Tables as programs and people write them: signs, blanks, line ends of Windows, byte order marks, words.
#include <tread/base/csv_table.h>
#include <tread/base/input_error.h>

#include "check.h"

#include <cstdio>
#include <fstream>

using namespace tread;

namespace base_csv_table
{
  const std::string file = "base_csv_table.csv";

  CsvTable read(const std::string &text)
  {
    std::ofstream(file, std::ios::binary) << text;
    return CsvTable(
      file, [](const std::string &name) { return name != "remark"; }, "cannot be read",
      [](const std::string &name) { return name == "name"; });
  }
} // namespace base_csv_table


TREAD_TEST(base_csv_table)(tests::Check &check, const tests::Arguments &)
{
  const CsvTable table = read("\xef\xbb\xbfx, y ,name,remark\r\n1.5,+2.5e-1, a b ,-\r\n\r\n -3 ,+4,c,+\r\n");
  check.that("names of columns", table.names() == std::vector<std::string>{"x", "y", "name"});
  check.that("numbers, with blanks and with line ends of Windows",
             table.column("x") == std::vector<double>{1.5, -3.});
  check.that("numbers with a plus", table.column("y") == std::vector<double>{.25, 4.});
  check.that("words", table.words("name") == std::vector<std::string>{"a b", "c"});
  // As spreadsheets of other countries, and other systems, write them.
  const std::vector<double> x{-1.5, 1e3}, y{2., .25};
  for (const auto &[what, text] : std::vector<std::pair<std::string, std::string>>{
         {"semicolons, decimal commas", "x;y\r\n-1,5;2\r\n1e3;0,25\r\n"},
         {"semicolons that end lines", "x;y;\n-1,5;2;\n1e3;0,25;\n"},
         {"tabs, carriage returns", "x\ty\r-1,5\t2\r1e3\t0,25\r"},
         {"quotes", "\"x\",\"y\"\n\"-1.5\",\"2\"\n\"1e3\",\"0.25\"\n"},
         {"quotes around decimal commas", "\"x\";\"y\"\n\"-1,5\";\"2\"\n\"1e3\";\"0,25\"\n"},
         {"a minus sign of Unicode, a comment before the names", "# made\nx,y\n\xe2\x88\x92"
                                                                 "1.5,2\n1D+3,0.25\n"},
         {"UTF-16", std::string("\xff\xfex\0,\0y\0\n\0-\0"
                                "1\0.\0"
                                "5\0,\0"
                                "2\0\n\0"
                                "1\0e\0"
                                "3\0,\0.\0"
                                "2\0"
                                "5\0",
                                38)}})
    {
      const CsvTable other = read(text);
      check.that(what, other.column("x") == x && other.column("y") == y);
    }
  const auto refuses = [&](const std::string &what, const std::string &words, const std::string &text) {
    const std::string said = tests::complaint<InputError>([&] { read(text); });
    check.that(what + ": \"" + said + "\"", said.find(words) != said.npos && said.find('\n') == said.npos);
  };
  refuses("two signs", "row 1", "x\n+-1\n");
  refuses("a decimal comma", "row 2", "x,y\n1,2\n1,5,2\n");
  refuses("a decimal comma among decimal points", "line 3: decimal points, where line 2 has decimal commas",
          "x;y\n1,5;2\n1.5;2\n");
  refuses("a matrix", "names of the columns", "0.1,0.2\n0.3,0.4\n");
  refuses("a spreadsheet", "export its table as text", "PK\x03\x04");
  refuses("a word for a number", "row 1", "x\none\n");
  refuses("two columns of one name", "two columns 'x'", "x,x\n1,2\n");
  std::remove(file.c_str());
}
