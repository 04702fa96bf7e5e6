// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_track_hub_motion_h
#define tread_track_hub_motion_h

#include <tread/base/simd.h>
#include <tread/track/flexible_axle.h>

#include <cmath>

namespace tread
{
  /// Where the rigid part of a wheel is, and how it moves. SI units.
  struct HubMotion
  {
    double x = 0., z = 0., angle = 0.;
    double velocity_x = 0., velocity_z = 0., angular_velocity = 0.;
    double sprung_z = 0., sprung_velocity = 0.; ///< sprung mass from its equilibrium
    double y = 0., velocity_y = 0.;             ///< across, from the start
    double yaw = 0., roll = 0., yaw_rate = 0., roll_rate = 0.;
  };

  /// Unit vectors of a wheelset in the track: x, along the axle to the own side, and z.
  struct WheelsetAxes
  {
    Vector3 x{1., 0., 0., 0.}, y{0., 1., 0., 0.}, z{0., 0., 1., 0.};

    /// A roll about x, then a yaw about the rolled vertical axis (rad).
    static WheelsetAxes of(const double yaw, const double roll)
    {
      const double c = std::cos(yaw), s = std::sin(yaw), cr = std::cos(roll), sr = std::sin(roll);
      return {Vector3{c, cr * s, -sr * s, 0.}, Vector3{-s, cr * c, -sr * c, 0.}, Vector3{0., sr, cr, 0.}};
    }
    /// A tilt of a wheel or its rate as a vector, and back.
    Vector3 vector(const FlexibleAxle::Tilt tilt) const
    {
      return tilt.x * x + tilt.z * z;
    }
    FlexibleAxle::Tilt tilt(const Vector3 v) const
    {
      return {dot(v, x), dot(v, z)};
    }
  };

  /// Cosine and sine of the angle by which a wheel has turned.
  struct HubTurn
  {
    explicit HubTurn(const double angle)
      : cosine(std::cos(angle))
      , sine(std::sin(angle))
    {
    }
    double cosine, sine;
  };
} // namespace tread

#endif
