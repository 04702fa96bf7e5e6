// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_wheel_tread_h
#define tread_geometry_wheel_tread_h

#include <tread/geometry/measured_line.h>

#include <functional>
#include <string>

namespace tread
{
  /// Radius of the S1002 tread over the running radius at the lateral coordinate y, the flange at y < 0:
  /// polynomials and arcs of EN 13715 (m). -70 mm <= y <= 60 mm.
  double s1002_offset(const double y);

  /// Radius of a tread relative to the running radius as a function of y (m), the flange at y < 0. Null: a
  /// cylinder. Where the flange becomes steeper than 1:1 the tread is continued horizontally: no flange is
  /// meshed.
  /// @param tread "cylinder", "cone 1:40", "cone 1:20", "S1002", or a file (read_wheel_tread).
  /// @param half_width that a file must cover (m). @throws std::runtime_error, one line.
  std::function<double(double)> tread_offset(const std::string      &tread,
                                             const double            half_width,
                                             const ProfilePlacement &placement = {});
} // namespace tread

#endif
