// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_track_wheel_hub_parameters_h
#define tread_track_wheel_hub_parameters_h

#include <tread/track/flexible_axle.h>
#include <tread/track/hub_settling.h>

#include <optional>

namespace tread
{
  /// How the axle is driven.
  enum class Drive
  {
    creepage,        ///< the angular velocity is prescribed by the creepage
    torque,          ///< a torque acts on the axle
    angular_velocity ///< it is prescribed as such, of a wheelset in a given position
  };

  struct WheelHubParameters
  {
    double mass = 0.; ///< of the wheel, kg; the share of the cells is subtracted when they are attached
    double moment_of_inertia    = 0.;   ///< of the wheel about the axle, kg m^2
    double sprung_mass          = 0.;   ///< kg
    double suspension_stiffness = 0.;   ///< N/m
    double suspension_damping   = 0.;   ///< N s/m
    double gravity              = 9.81; ///< m/s^2
    double yaw_inertia          = 0.;   ///< of the wheelset without the cells, about the vertical, kg m^2
    double roll_inertia = 0.; ///< likewise, about x, where both wheels carry it; 0: roll is prescribed
    /// Between both wheels, which then are alike; none: rigid.
    std::optional<FlexibleAxleParameters> axle{};
    /// As it begins, without the masses that it is told; none: it has its own inertia.
    std::optional<SettlingOfHub> settling{};
  };
} // namespace tread

#endif
