// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_mesh_sleeper_body_h
#define tread_mesh_sleeper_body_h

#include <tread/mesh/body.h>

namespace tread
{
  /// Half a sleeper as a box, lengths in m: the end at y_begin is cut by the plane of symmetry in the middle
  /// of the track.
  struct SleeperBox
  {
    double x                  = 0.; ///< its middle
    double width              = 0.25;
    double y_begin            = -0.75;
    double y_end              = 0.51;
    double top                = -0.18; ///< z
    double height             = 0.18;
    double coarsest_cell_size = 0.06; ///< upper bound of the cells' edges
  };

  /// Boundaries: the bottom (support) and the cut (end); the rest is free.
  Body make_sleeper(const SleeperBox &box);
} // namespace tread

#endif
