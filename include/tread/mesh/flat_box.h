// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_mesh_flat_box_h
#define tread_mesh_flat_box_h

#include <tread/mesh/body.h>
#include <tread/mesh/fine_zone.h>

namespace tread
{
  /// The chart of a body under a running surface: x along the path, y across it, z = -depth below the surface
  /// (m). Symmetric to y = 0.
  struct FlatBox
  {
    double x_begin, x_end, half_width, depth;
  };

  /// Fills everything of the body but to_space: coarse cells about the fine zones, with the bottom held, the
  /// cut faces as ends, and the top in reach of the other body up to contact_half_width from the middle.
  /// @param coarsest upper bound of the coarse cells' edge (m).
  /// @throws std::invalid_argument for a box without volume.
  Body make_flat_box(const FlatBox   &box,
                     const double     coarsest,
                     const double     contact_half_width,
                     const FineZones &zones);
} // namespace tread

#endif
