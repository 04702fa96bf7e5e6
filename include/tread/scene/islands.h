// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_islands_h
#define tread_scene_islands_h

#include <tread/reference/half_space.h>

#include <vector>

namespace tread
{
  /// A part of a contact patch around which nothing touches: outer edges of its elements (m) and its normal
  /// force (N).
  struct Island
  {
    double x_begin, x_end, y_begin, y_end, force;
  };

  /// The parts of a patch whose elements with a pressure hang together, over their edges or corners.
  /// @param pressure of each element, Pa
  std::vector<Island> islands_of(const reference::Grid &grid, const std::vector<double> &pressure);

  /// Lagrange's cubic through values at -1, 0, 1 and 2.
  inline double cubic_between(const double (&v)[4], const double s)
  {
    return -s * (s - 1.) * (s - 2.) / 6. * v[0] + (s + 1.) * (s - 1.) * (s - 2.) / 2. * v[1] -
           (s + 1.) * s * (s - 2.) / 2. * v[2] + (s + 1.) * s * (s - 1.) / 6. * v[3];
  }
} // namespace tread

#endif
