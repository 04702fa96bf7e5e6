// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tools_answer_table_h
#define tread_tools_answer_table_h

#include <mpi.h>

#include <functional>
#include <ostream>
#include <string>

namespace tread
{
  /// What all options share that read a table and write another with its answers.
  /// @throws InputError, one line, if the option is started on several ranks, or the output is missing, a
  /// folder or the table itself
  void check_answer_table(const std::string &option,
                          const std::string &table,
                          const std::string &output,
                          const MPI_Comm     comm);

  /// Never a half-written table under its own name, but devices and pipes are written to as they are.
  /// @throws std::runtime_error, one line, if it can't be written
  void write_answer_table(const std::string &output, const std::function<void(std::ostream &)> &write);
} // namespace tread

#endif
