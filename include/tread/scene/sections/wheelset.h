// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_wheelset_h
#define tread_scene_sections_wheelset_h

#include <tread/base/section.h>
#include <tread/geometry/wheel_on_rail.h>

namespace tread
{
  /// What the rigid slip over a patch is taken from.
  enum class SlipOverPatch
  {
    surface, ///< from the wheel's surface
    plane    ///< linear from the reference point on
  };

  template <>
  const std::vector<Choice<SlipOverPatch>> &choices();

  /// Section `Wheelset`. SI units.
  struct WheelsetSection
  {
    std::optional<double> shift; ///< y of the wheelset's middle in the track; none: see is_positioned()
    double                yaw = 0., roll = 0.;
    bool                  both_wheels = false; ///< on one axle; then the roll is found
    std::optional<double> axle_torsion;        ///< stiffness between both wheels, N m/rad; none: rigid
    std::optional<double> axle_bending;        ///< E I, N m^2; none: rigid
    double                axle_damping = 0.;   ///< time, s
    TrackGauge            track;
    SlipOverPatch         slip_over_patch = SlipOverPatch::surface;
    double patch_distance = 8e-3; ///< along the surface, from which on half-spaces do not feel each other

    /// Whether the wheel stands in a position of a wheelset in its track; otherwise it is upright, and its
    /// place over the rail follows from `Wheel/Lateral position (mm)`.
    bool is_positioned() const
    {
      return shift || yaw != 0. || roll != 0.;
    }
    /// In the track, at the height 0.
    WheelsetPosition position() const
    {
      return {shift.value_or(0.), yaw, roll, 0.};
    }
    bool has_flexible_axle() const
    {
      return axle_torsion || axle_bending;
    }
    unsigned int n_wheels() const
    {
      return both_wheels ? 2 : 1;
    }

    void declare(ParameterTable &table);
    /// That the wheel stands in a position, or turns as one does. @see Scene::is_positioned()
    static Need in_a_position();
    /// @throws InputError
    void check() const;
  };
} // namespace tread

#endif
