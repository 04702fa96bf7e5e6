// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_track_rail_ends_h
#define tread_track_rail_ends_h

#include <algorithm>

namespace tread
{
  /// Ends of a rail that absorb waves. Over a length at each end, damping in proportion to the mass grows
  /// with the square of the distance from the beginning of the layer, so that waves find no interface at
  /// which they are reflected (a sponge layer, Israeli & Orszag 1981). A wave of speed c that enters the
  /// layer, is reflected at the plane of symmetry behind it and comes back retains exp(-strength c_s/(3 c))
  /// of its amplitude, with the shear wave speed c_s: 14 % for a shear wave. Static loads are not affected.
  struct AbsorbingEnds
  {
    double begin, end;  ///< x of the rail's ends, m
    double length;      ///< of the absorbing part at each end, m
    double shear_speed; ///< m/s

    /// Largest rate times length over c_s. From 100 to 2000 Hz beams on the supports of doc/track.md are
    /// closest to an endless beam between 4 and 8. Half as much absorbs less above 1200 Hz, twice as much
    /// reflects at the beginning of the layer.
    static constexpr double strength = 6.;

    /// Damping force over mass and velocity, 1/s.
    double rate(const double x) const
    {
      const double depth = length - std::min(x - begin, end - x);
      return depth > 0. ? strength * shear_speed / length * (depth / length) * (depth / length) : 0.;
    }
  };
} // namespace tread

#endif
