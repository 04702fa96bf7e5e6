// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_defect_h
#define tread_geometry_defect_h

#include <tread/geometry/measured_line.h>

#include <functional>
#include <utility>
#include <vector>

namespace tread
{
  /// Least (negative: above the surface) and largest depth of a shape of defect, at places so near to each
  /// other that those between them are hardly more.
  std::pair<double, double> extremes_of(const std::function<double(double u, double v)> &shape);


  /// A defect of the running surface as a height z(x, y) over it, in the rail's own axes, zero outside.
  /// Lengths in m.
  struct Defect
  {
    double              begin    = 0.;   ///< x of its leading edge
    double              length   = 0.02; ///< along x
    double              width    = 0.02; ///< lateral; infinite: the whole head alike
    double              y_middle = 0.;
    double              depth    = 1e-4; ///< of its deepest point
    std::vector<double> repeated_at;     ///< x of the leading edges of others like it

    /// Depth over the largest depth, from u = 0 at the leading edge to 1 at the trailing edge and from v = -1
    /// to 1 across; zero outside.
    std::function<double(double u, double v)> shape;

    /// Whether it rises above the surface by more than it lies below.
    bool is_a_bump() const
    {
      const auto [least, largest] = extremes_of(shape);
      return -least > largest;
    }

    double height(const double x, const double y) const
    {
      const double v   = 2. * (y - y_middle) / width;
      double       sum = shape((x - begin) / length, v);
      for (const double other : repeated_at)
        sum += shape((x - other) / length, v);
      return -depth * sum;
    }
  };

  /// Shape of a dip: 1 - r^2 at the distance r from its middle, with r = 1 at the edge; a sphere's cap where
  /// length and width are equal (apart from a share of (depth/length)^2). A kink at the edge is rounded over
  /// so much of the path, half of it on each side, to the sides of the dip by the cosine of that and less
  /// where it would reach beyond the width; 0: sharp.
  /// @param leading_rounding, trailing_rounding over the length
  std::function<double(double, double)> dip(const double leading_rounding, const double trailing_rounding);

  /// Shape of corrugation across the whole width: waves of depth (1 - cos)/2, so that crests lie in the
  /// surface and troughs as deep as the defect; it begins at a crest. @param wavelength over the length
  std::function<double(double, double)> corrugation(const double wavelength);

  /// A shape whose heights grow from 0 at its ends, by half a cosine. @param ramp over the length, 0: none
  std::function<double(double, double)> with_ramps(std::function<double(double, double)> shape,
                                                   const double                          ramp);

  /// A shape of the whole width with the lateral law 1 - v^2 (thesis, section 4.3.2.2).
  std::function<double(double, double)> with_parabola(std::function<double(double, double)> shape);

  /// What a measured line's depth is counted from.
  enum class LineDatum
  {
    chord, ///< the straight line between its ends
    fitted ///< the straight line that fits it best
  };

  /// The depth of a measured line as a defect with its length and its largest depth (height, where that is
  /// larger and depth is counted from the fitted line), alike across the whole width. @param reversed rolled
  /// over from the other end. @throws std::runtime_error where the line is nowhere below its chord, or
  /// straight.
  Defect defect_along(const MeasuredLine &line, const LineDatum datum, const bool reversed);
} // namespace tread

#endif
