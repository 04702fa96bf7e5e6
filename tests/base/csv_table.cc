// SPDX-License-Identifier: LGPL-2.1-or-later
// Tables as programs and people write them: signs, blanks, line ends of Windows, byte order marks, words.
#include <tread/base/csv_table.h>
#include <tread/base/input_error.h>

#include "check.h"

#include <cstdio>
#include <fstream>

using namespace tread;

namespace
{
  const std::string file = "base_csv_table.csv";

  CsvTable read(const std::string &text)
  {
    std::ofstream(file, std::ios::binary) << text;
    return CsvTable(
      file, [](const std::string &name) { return name != "remark"; }, "cannot be read",
      [](const std::string &name) { return name == "name"; });
  }
} // namespace


void run_test(tests::Check &check, const tests::Arguments &)
{
  const CsvTable table = read("\xef\xbb\xbfx, y ,name,remark\r\n1.5,+2.5e-1, a b ,-\r\n\r\n -3 ,+4,c,+\r\n");
  check.that("names of columns", table.names() == std::vector<std::string>{"x", "y", "name"});
  check.that("numbers, with blanks and with line ends of Windows",
             table.column("x") == std::vector<double>{1.5, -3.});
  check.that("numbers with a plus", table.column("y") == std::vector<double>{.25, 4.});
  check.that("words", table.words("name") == std::vector<std::string>{"a b", "c"});
  const auto refuses = [&](const std::string &what, const std::string &words, const std::string &text) {
    const std::string said = tests::complaint<InputError>([&] { read(text); });
    check.that(what + ": \"" + said + "\"", said.find(words) != said.npos && said.find('\n') == said.npos);
  };
  refuses("two signs", "row 1", "x\n+-1\n");
  refuses("a decimal comma", "row 2", "x,y\n1,2\n1,5,2\n");
  refuses("a word for a number", "row 1", "x\none\n");
  refuses("two columns of one name", "two columns 'x'", "x,x\n1,2\n");
  std::remove(file.c_str());
}
