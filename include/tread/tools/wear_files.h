// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tools_wear_files_h
#define tread_tools_wear_files_h

#include <tread/output/columns.h>
#include <tread/scene/scene.h>

#include <mpi.h>

#include <string>
#include <vector>

namespace tread
{
  /// Those that write_profile_wear() leaves.
  std::vector<TableDescription> tables_of_profile_wear();

  /// Wear the profiles of a wheelset's wheel and rail by half-space theory (`tread wear`, @see ProfileWear):
  /// writes summary.json, parameters.prm, wear_steps.csv, rail_wear.csv, wheel_wear.csv, wear_patches.csv,
  /// and after the last passage the profiles worn_rail.csv and worn_wheel.csv with the scene worn.prm that
  /// has them.
  ///
  /// @param contacts a table with a row for each contact: any of the columns weight, shift_mm, yaw_mrad,
  ///                 roll_mrad, load_kN, creepage, lateral_creepage, friction; what it has not is the scene's
  /// @param path     folder of the results
  /// @param goes_on  from what an interrupted run has left there
  /// @returns false after Ctrl-C, from which it can go on
  /// @throws InputError, also if what is there is of another scene; std::runtime_error where a contact has no
  /// answer
  bool write_profile_wear(const Scene       &scene,
                          const std::string &contacts,
                          const std::string &path,
                          bool               goes_on,
                          MPI_Comm           comm);

  /// Print how long a step of this takes; write nothing. @throws as above
  void estimate_profile_wear(const Scene &scene, const std::string &contacts, MPI_Comm comm);
} // namespace tread

#endif
