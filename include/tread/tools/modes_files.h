// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tools_modes_files_h
#define tread_tools_modes_files_h

#include <tread/output/columns.h>
#include <tread/scene/scene.h>

#include <mpi.h>

#include <string>
#include <vector>

namespace tread
{
  /// What a user asks of the modes of a scene.
  struct ModesRequest
  {
    double up_to = 2000.; ///< Hz
  };

  /// Those that write_modes() leaves.
  std::vector<TableDescription> tables_of_modes();

  /// Compute the eigenmodes of the first wheel, free in space and under its suspension, and of the track, on
  /// the meshes of a run, and the receptances of wheel and rail where they touch. Writes modes.csv,
  /// receptance.csv, the shapes for ParaView (modes.pvd) and parameters.prm.
  /// @param folder of the results. Collective. @throws InputError
  void write_modes(const Scene        &scene,
                   const ModesRequest &request,
                   const std::string  &folder,
                   const MPI_Comm      comm);
} // namespace tread

#endif
