// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_mesh_rail_body_h
#define tread_mesh_rail_body_h

#include <tread/geometry/rail_profile.h>
#include <tread/mesh/body.h>
#include <tread/mesh/fine_zone.h>

#include <functional>
#include <limits>

namespace tread
{
  /// Deviations of the top of a rail from its profile, and the inclination of the rail.
  struct RailTop
  {
    /// Height over the profile at (x, y), along the rail's own vertical (m); null: none. It fades linearly to
    /// zero at the bottom of block or head.
    std::function<double(double, double)> height;

    /// Turn about the line x along the rail top, towards -y: the top leans to the gauge side (rad).
    double inclination = 0.;
  };

  /// Adds the top's height, fading over `depth`, and the inclination to a map from the chart (x, y or s,
  /// -depth) (m).
  std::function<dealii::Point<3>(const dealii::Point<3> &)> shape_top(
    std::function<dealii::Point<3>(const dealii::Point<3> &)> to_space,
    const RailTop                                            &top,
    const double                                              depth);

  /// A block with a cylindrical top (axis along x, crown at y = z = 0), flat sides and bottom.
  struct RailBlock
  {
    double x_begin            = -0.12;                                   ///< (m)
    double x_end              = 0.12;                                    ///< (m)
    double width              = 0.2;                                     ///< (m)
    double height             = 0.12;                                    ///< at y = 0 (m)
    double crown_radius       = std::numeric_limits<double>::infinity(); ///< (m); infinite: flat top
    double coarsest_cell_size = 0.025; ///< upper bound of the coarse cells' edge (m)
    double contact_half_width = std::numeric_limits<double>::infinity(); ///< top faces with |y| up to this
                                                                         ///< are in reach of the wheel (m)
    RailTop top;
  };

  /// The head of a rail, cut off level with the lower end of its flanks.
  struct RailHead
  {
    double x_begin            = -0.12;  ///< (m)
    double x_end              = 0.12;   ///< (m)
    double coarsest_cell_size = 0.0125; ///< upper bound of the coarse cells' edge (m)
    double contact_half_width =
      0.0245; ///< top faces with arc length up to this from the crown are in reach of the wheel (m)
    RailTop top;
  };

  /// The block as coarse cells of 2^k finest_cell_size. Chart: (x, y, -depth) of a flat box. to_space keeps x
  /// and y and sets z = -depth + z_crown(y) (1 - depth/height): top on the crown, bottom flat.
  Body make_rail_block(const RailBlock &block, const FineZones &zones);

  /// The rail head by a transfinite map. Chart: (x, s, -depth) with s the arc length along the top outline
  /// from the crown, |s| <= profile.shoulder_length() (the middle of the gauge corner arc), depth from 0 to
  /// profile.head_depth(); near the crown depth is vertical. The chart's vertical sides are the rest of the
  /// gauge corner and the flank.
  Body make_rail_head(const RailProfile &profile, const RailHead &head, const FineZones &zones);
} // namespace tread

#endif
