// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_motion_h
#define tread_scene_sections_motion_h

#include <tread/base/section.h>
#include <tread/track/wheel_hub.h>

#include <algorithm>

namespace tread
{
  template <>
  const std::vector<Choice<Drive>> &choices();

  /// Section `Motion`. SI units.
  struct MotionSection
  {
    double                speed = 140. / 3.6;
    std::optional<double> start; ///< x of the wheel; none: automatic
    double                rolled_distance      = 0.06;
    double                longest_distance     = 0.; ///< 0: as rolled
    Drive                 drive                = Drive::creepage;
    double                traction_coefficient = 0.3;
    std::optional<double> creepage;                 ///< none: predicted by half-space theory
    double                lateral_creepage = 0.;    ///< of the wheel over the rail
    double                spin             = 0.;    ///< of the wheel over the rail about z, 1/m
    double                hold_distance    = 0.015; ///< before a torque acts
    std::optional<double> angular_velocity; ///< magnitude, positive rolling forward, rad/s; none: by drive
    unsigned int          passages = 1;

    void declare(ParameterTable &table);
    /// @throws InputError
    void check() const;

    /// Way for which rail and wheel are meshed, m.
    double meshed_distance() const
    {
      return std::max(rolled_distance, longest_distance);
    }
    /// Whether a run that has ended may be resumed for a longer way.
    bool may_go_on() const
    {
      return longest_distance > rolled_distance;
    }
  };
} // namespace tread

#endif
