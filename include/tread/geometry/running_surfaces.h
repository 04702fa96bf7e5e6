// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_running_surfaces_h
#define tread_geometry_running_surfaces_h

#include <functional>
#include <limits>

namespace tread
{
  /// Contact of an upright wheel is looked for, and a measured tread is needed, up to here on each side (m).
  constexpr double running_half_width = 25e-3;

  /// Tread and running surface of an upright wheel over a rail, y = 0 on the rail top's middle line and on
  /// the tread's running circle. Lengths in m.
  struct RunningSurfaces
  {
    double                                radius     = 0.46; ///< of the wheel at y = 0
    double                                half_width = 0.03; ///< contact is looked for in |y| up to this
    std::function<double(double)>         tread_offset;      ///< radius at y over the radius; null: 0
    std::function<double(double, double)> deviation; ///< more radius at the angle from the bottom, positive
                                                     ///< towards +x, and at y; null: the wheel is round
    std::function<double(double)>         rail_top;  ///< height z(y) of the smooth rail, inclined
    std::function<double(double, double)> defect;    ///< height z(x, y) over it; null: none

    /// Of the wheel at the angle from the bottom and at y.
    double wheel_radius(const double angle, const double y) const
    {
      return radius + (tread_offset ? tread_offset(y) : 0.) + (deviation ? deviation(angle, y) : 0.);
    }

    /// How far apart the smooth surfaces are at y below the axle, when the axle is at the height `radius`:
    /// negative where they overlap.
    double gap(const double y) const;
  };

  /// Point at which an unloaded wheel first touches.
  struct FirstContact
  {
    double y;              ///< lateral position on the smooth rail (m)
    double lift;           ///< height of the axle over the radius, where nothing overlaps (m)
    double lateral_radius; ///< of the gap, fitted over 5 mm at both sides (m); infinite: none or concave
  };

  /// @param center_x where the wheel stands; a defect there, or what the wheel is not round by, lets it down
  /// or lifts it, but leaves y.
  FirstContact first_contact(const RunningSurfaces &surfaces, const double center_x);

  /// Lateral radius of the gap over `half` at both sides of y, by least squares of its second differences, m;
  /// infinite: concave.
  double fitted_lateral_radius(const RunningSurfaces &surfaces, const double y, const double half);

  /// Height at y of a line z(y) that was turned about the origin by `angle` from y to z (rad), for angles up
  /// to 0.1 and slopes below 5.
  double turned_line(const std::function<double(double)> &line, const double angle, const double y);
} // namespace tread

#endif
