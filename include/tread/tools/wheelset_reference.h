// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tools_wheelset_reference_h
#define tread_tools_wheelset_reference_h

#include <tread/scene/scene.h>

#include <mpi.h>

#include <string>

namespace tread
{
  /// The half-space answer for a wheelset in a given position: prints a table by patch and writes
  /// summary.json and patch.csv. @pre scene.is_positioned(). @throws InputError where wheel and rail do not
  /// meet, or no height carries the load.
  void run_wheelset_reference(const Scene &scene, const std::string &path, MPI_Comm comm);
} // namespace tread

#endif
