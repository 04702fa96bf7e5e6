// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tools_contact_points_files_h
#define tread_tools_contact_points_files_h

#include <tread/output/columns.h>
#include <tread/scene/scene.h>

#include <mpi.h>

#include <string>

namespace tread
{
  /// What the user asks `--contact-points` for.
  struct ContactPointsRequest
  {
    bool   wanted  = false;
    double to_mm   = 10.;  ///< largest lateral shift to both sides
    double step_mm = 0.25; ///< between shifts
  };

  /// That which write_contact_points() leaves.
  TableDescription table_of_contact_points();

  /// Where the rigid wheels of a wheelset touch their rails over the lateral shift, with the rolling radii
  /// and the equivalent conicity: contact_points.csv. @throws InputError
  void write_contact_points(const Scene                &scene,
                            const ContactPointsRequest &request,
                            const std::string          &path,
                            MPI_Comm                    comm);
} // namespace tread

#endif
