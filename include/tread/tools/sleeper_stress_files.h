// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tools_sleeper_stress_files_h
#define tread_tools_sleeper_stress_files_h

#include <mpi.h>

#include <string>

namespace tread
{
  /// Options of `tread sleeper-stress RUN`.
  struct SleeperStressRequest
  {
    std::string run;              ///< folder
    std::string output;           ///< folder; empty: that of the run
    std::string support;          ///< number; empty: that with the largest force in its pad
    std::string cell_size_mm;     ///< empty: 20
    std::string bottom = "fixed"; ///< or ballast
  };

  /// Read rail_seats.csv of a run, write sleeper_stress.json and sleeper_stress.vtu, and print the stress.
  /// Collective.
  /// @throws InputError with one line for errors that the user can correct
  void write_sleeper_stress(const SleeperStressRequest &request, const MPI_Comm comm);
} // namespace tread

#endif
