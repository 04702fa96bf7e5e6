// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tools_contact_way_files_h
#define tread_tools_contact_way_files_h

#include <tread/output/columns.h>
#include <tread/scene/scene.h>

#include <mpi.h>

#include <string>

namespace tread
{
  /// That of write_contact_way().
  TableDescription table_of_contact_way();

  /// Where a wheel touches a rail of slices on the way of a scene, with the load that each piece carries and
  /// the height of the wheelset, by half-space theory without friction: contact_way.csv. @pre
  /// scene.rail.is_sliced() @throws InputError
  void write_contact_way(const Scene &scene, const std::string &path, MPI_Comm comm);
} // namespace tread

#endif
