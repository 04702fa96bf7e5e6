// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_defect_h
#define tread_geometry_defect_h

#include <tread/geometry/measured_line.h>

#include <functional>
#include <limits>

namespace tread
{
  /// A defect of the running surface as a height z(x, y) over it, in the rail's own axes, zero outside.
  /// Lengths in m.
  struct Defect
  {
    double begin    = 0.;   ///< x of its leading edge
    double length   = 0.02; ///< along x
    double width    = 0.02; ///< lateral; infinite: the whole head alike
    double y_middle = 0.;
    double depth    = 1e-4; ///< of its deepest point

    /// A kink at the edge is rounded over so much of the path, half of it on each side; 0: sharp.
    double leading_rounding  = 0.;
    double trailing_rounding = 0.;

    /// Depth over the largest depth along the path, from 0 at the leading edge to 1 at the trailing edge;
    /// null: a dip.
    std::function<double(double)> profile;

    /// Depth of a dip, at the distance r from its middle: d (1 - r^2) with r = 1 at the edge, a sphere's cap
    /// where length and width are equal (apart from a share of (d/length)^2). A profile has the lateral law
    /// 1 - (2y/width)^2 (thesis, section 4.3.2.2).
    double height(const double x, const double y) const;
  };

  /// The depth of a measured line over its chord as the profile of a defect, with its length and its largest
  /// depth. @param reversed rolled over from the other end.
  /// @throws std::runtime_error where the line is nowhere below its chord.
  Defect defect_along(const MeasuredLine &line, const bool reversed);
} // namespace tread

#endif
