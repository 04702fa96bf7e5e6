// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tools_dynamic_force_files_h
#define tread_tools_dynamic_force_files_h

#include <mpi.h>

#include <string>

namespace tread
{
  /// Options of `tread dynamic-force RUN --smooth-twin TWIN`.
  struct DynamicForceRequest
  {
    std::string run, smooth_twin;       ///< folders
    std::string output;                 ///< folder; empty: that of the run
    std::string window = "rectangular"; ///< or Hann
    std::string from_mm, to_mm;         ///< section of the position; empty: all that both runs have
  };

  /// Write dynamic.csv, spectrum.csv and dynamic.json, and print peaks and vibrations. Collective.
  /// @throws InputError with one line for errors that the user can correct
  void write_dynamic_force(const DynamicForceRequest &request, const MPI_Comm comm);
} // namespace tread

#endif
