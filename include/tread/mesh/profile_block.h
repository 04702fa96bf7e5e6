// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_mesh_profile_block_h
#define tread_mesh_profile_block_h

#include <tread/geometry/profile_curve.h>
#include <tread/mesh/body.h>
#include <tread/mesh/fine_zone.h>

#include <functional>
#include <vector>

namespace tread
{
  /// Section of a block whose running surface is a piece of a profile, at any inclination. Straight lines
  /// lead from the surface, where they are evenly spaced along it, to points evenly spaced on a straight base
  /// `depth` behind the piece's middle; those at both ends are at right angles to it. Where the profile ends,
  /// or turns away from that direction by more than the lines bear, the surface goes on along its tangent.
  /// (m)
  class ProfileSection
  {
  public:
    enum class Side
    {
      below, ///< of the curve: a rail
      above  ///< a wheel
    };

    /// @param s_middle parameter of the profile at the middle of the piece
    /// @param inclination of the base: it runs along (cos, sin) of this angle (rad)
    /// @throws std::invalid_argument where the profile turns away at the middle.
    ProfileSection(const ProfileCurve &profile,
                   const double        s_middle,
                   const double        inclination,
                   const Side          side,
                   const double        depth,
                   const double        half_width);

    /// y, z in the profile's axes, at the distance `along` the surface from the middle, -half_width ..
    /// half_width, and behind it, 0 .. depth.
    dealii::Point<2> point(const double along, const double behind) const;

    /// Whether the surface stands over the base by a good part of the depth there: where it falls away, cells
    /// would else be turned over.
    bool is_above_base(const double along) const;

    /// The distances along the surface between which it is the profile.
    double begin() const
    {
      return first;
    }
    double end() const
    {
      return last;
    }

    double depth, half_width;

  private:
    dealii::Point<2> surface(const double along) const;

    ProfileCurve         profile;
    double               s_middle, first, last;
    dealii::Point<2>     base_middle;
    dealii::Tensor<1, 2> base_direction;
    double               base_spacing[2]; ///< over that on the surface, on the side of low and of high s
  };

  /// The chart of a block behind a running surface, (x, y, -behind) with y = along, or -along where
  /// `mirrored`: a chart that would else be left-handed. (m)
  struct ProfileBlock
  {
    double x_begin, x_end;
    double half_width, depth;
    bool   mirrored;
    /// The reference position at x, `along` the surface across the way from its middle, and `behind` it.
    std::function<dealii::Point<3>(double x, double along, double behind)> place;
  };

  /// Cells are finest in any of the zones, which lie side by side. The surface is in reach of the other body
  /// there and a little beside, the base is held.
  Body make_profile_block(const ProfileBlock          &block,
                          const double                 coarsest,
                          const std::vector<FineZone> &zones);
} // namespace tread

#endif
