// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_rotation_h
#define tread_geometry_rotation_h

#include <tread/geometry/wheel_on_rail.h>

#include <cmath>

namespace tread
{
  /// The columns of the matrix that turns a vector of the wheelset into the track: roll of yaw.
  struct Rotation
  {
    Vector3d x, y, z;

    explicit Rotation(const WheelsetPosition &p)
    {
      const double c = std::cos(p.yaw), s = std::sin(p.yaw), cr = std::cos(p.roll), sr = std::sin(p.roll);
      x = {c, cr * s, -sr * s};
      y = {-s, cr * c, -sr * c};
      z = {0., sr, cr};
    }
    Vector3d operator()(const double a, const double b, const double c) const
    {
      return {a * x[0] + b * y[0] + c * z[0], a * x[1] + b * y[1] + c * z[1], a * x[2] + b * y[2] + c * z[2]};
    }
  };
} // namespace tread

#endif
