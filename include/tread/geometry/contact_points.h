// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_contact_points_h
#define tread_geometry_contact_points_h

#include <tread/geometry/wheel_on_rail.h>

#include <vector>

namespace tread
{
  /// Where a rigid wheel touches its rail, in the axes of its own side (m).
  struct TouchingWheel
  {
    double x, y;           ///< in the track
    double wheel_y;        ///< in the wheel's profile
    double angle;          ///< of the rail, rad
    double rolling_radius; ///< distance from the axle
  };

  /// Both wheels of a wheelset on their rails: the roll and the height at which both touch.
  struct TouchingWheelset
  {
    WheelsetPosition position;
    TouchingWheel    own, other;
    double           radius_difference() const
    {
      return own.rolling_radius - other.rolling_radius;
    }
  };

  /// @param position of which the roll and the height are found. @throws std::runtime_error, one line, where
  /// a wheel meets no rail, or meets it with the edge of its profile only.
  TouchingWheelset touching_wheelset(const WheelOnRail &surfaces, WheelsetPosition position);

  /// The inclination of the cone that has, under a lateral motion of the amplitude, the same rolling radius
  /// difference in the mean: integral of dr(a sin t) sin t over a turn, over 2 pi a (harmonic linearisation).
  /// @param shifts ascending (m); @param differences own less other (m); @param amplitude a (m), within the
  /// shifts at both sides
  double equivalent_conicity(const std::vector<double> &shifts,
                             const std::vector<double> &differences,
                             double                     amplitude);
} // namespace tread

#endif
