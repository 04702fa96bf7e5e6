// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_smoothing_spline_h
#define tread_geometry_smoothing_spline_h

#include <deal.II/base/point.h>

#include <vector>

namespace tread
{
  /// Points of a plane curve, in their order, moved onto its cubic smoothing spline over the length of the
  /// chords (Reinsch 1967): of waves of this length (m) half is left, of waves twice as long 94 %, of waves
  /// half as long 6 %. At its ends the curve is continued by a parabola, so that it keeps its curvature
  /// there.
  /// @throws std::runtime_error where a point coincides with the one before
  std::vector<dealii::Point<2>> smoothed(const std::vector<dealii::Point<2>> &points, const double length);
} // namespace tread

#endif
