// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tools_reference_only_h
#define tread_tools_reference_only_h

#include <tread/scene/scene.h>

#include <mpi.h>

#include <string>

namespace tread
{
  /// Compute the half-space solution of a scene, print it and write it in the formats of a run: summary.json,
  /// patch.csv, surface.pvd, parameters.prm; and subsurface.csv. No mesh is made.
  /// @param folder of the results
  /// @throws InputError if the scene has no such solution; std::runtime_error if a file cannot be written
  void run_reference_only(const Scene &scene, const std::string &folder, const MPI_Comm comm);
} // namespace tread

#endif
