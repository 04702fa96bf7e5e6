// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tools_contact_points_files_h
#define tread_tools_contact_points_files_h

#include <tread/output/columns.h>
#include <tread/scene/scene.h>

#include <mpi.h>

#include <string>
#include <vector>

namespace tread
{
  /// What the user asks `tread contact-points` for.
  struct ContactPointsRequest
  {
    double to_mm         = 10.;   ///< largest lateral shift to both sides
    double step_mm       = 0.25;  ///< between shifts
    bool   is_over_shift = false; ///< one of these, or the other side, is asked for
    /// Scene whose wheel and rail stand on the other side; empty: those of the scene, mirrored.
    std::string other_side;
  };

  /// Those that write_contact_points() leaves.
  std::vector<TableDescription> tables_of_contact_points();

  /// Where the rigid wheels of a wheelset touch their rails over the lateral shift, with the rolling radii
  /// and the equivalent conicity: contact_points.csv; and the profiles as they are taken, the wheel's where
  /// it stands nearest to the middle of the track: rail_profile.csv, wheel_profile.csv. @throws InputError
  void write_contact_points(const Scene                &scene,
                            const ContactPointsRequest &request,
                            const std::string          &path,
                            MPI_Comm                    comm);
} // namespace tread

#endif
