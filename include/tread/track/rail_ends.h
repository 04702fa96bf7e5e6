// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_track_rail_ends_h
#define tread_track_rail_ends_h

#include <algorithm>

namespace tread
{
  /// Ends of a rail that absorb waves: over a length at each end, damping in proportion to the mass grows
  /// with the square of the distance from where it begins, so that waves find no place to be reflected from
  /// (a sponge layer, Israeli & Orszag 1981). What is left of a wave of speed c that runs into it, is
  /// reflected at the plane of symmetry behind it and comes back is exp(-strength c_s/(3 c)) of its
  /// amplitude, with the speed of shear waves c_s: 14 % of a shear wave. Loads at rest do not feel it.
  struct AbsorbingEnds
  {
    double begin, end;  ///< x of the rail's ends, m
    double length;      ///< of the absorbing part at each end, m
    double shear_speed; ///< m/s

    /// Largest rate times length over c_s. Beams on the supports of doc/track.md are nearest to an endless
    /// one, over 100 to 2000 Hz, between 4 and 8; half as much absorbs less above 1200 Hz, twice as much
    /// reflects at the beginning of the layer.
    static constexpr double strength = 6.;

    /// Force over mass and velocity, 1/s.
    double rate(const double x) const
    {
      const double depth = length - std::min(x - begin, end - x);
      return depth > 0. ? strength * shear_speed / length * (depth / length) * (depth / length) : 0.;
    }
  };
} // namespace tread

#endif
