// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tools_position_files_h
#define tread_tools_position_files_h

#include <mpi.h>

#include <string>

namespace tread
{
  /// Half-space contact of a wheel in many positions over a rail that changes along the way.
  /// @param positions a table with a row for each position; doc/crossing.md lists its columns
  /// @param output    the table that is written, a row for each patch, in the order of the positions
  /// @throws InputError; std::runtime_error with the first cause where positions were not solved, after the
  /// table is written, in which they have nan
  void write_positions(const std::string &positions, const std::string &output, MPI_Comm comm);
} // namespace tread

#endif
