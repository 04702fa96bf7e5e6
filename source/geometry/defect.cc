// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/defect.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tread
{
  namespace
  {
    /// max(p, 0) with its kink replaced by a parabola between -half and half.
    double rounded_ramp(const double p, const double half)
    {
      if (p >= half)
        return p;
      if (p <= -half)
        return 0.;
      return (p + half) * (p + half) / (4. * half);
    }
  } // namespace


  bool Defect::is_a_bump() const
  {
    constexpr unsigned int n      = 200; // places along and across
    double                 lowest = 0., highest = 0.;
    for (unsigned int i = 0; i <= n; ++i)
      for (unsigned int j = 0; j <= n; ++j)
        {
          const double height = -shape(double(i) / n, 2. * j / n - 1.);
          lowest              = std::min(lowest, height);
          highest             = std::max(highest, height);
        }
    return highest > -lowest;
  }


  std::function<double(double, double)> dip(const double leading_rounding, const double trailing_rounding)
  {
    return [=](const double u, const double v) {
      if (std::abs(v) >= 1.)
        return 0.;
      // At the edge r^2 grows by 4 per length of path in the middle, to the sides by the cosine of that:
      // there a path leaves the dip more and more slowly, and where it runs along the edge there is no kink.
      const double x = 2. * u - 1., r_squared = x * x + v * v,
                   cosine = r_squared > 0. ? std::abs(x) / std::sqrt(r_squared) : 0.;
      const double half   = 2. * cosine * (u < 0.5 ? leading_rounding : trailing_rounding);
      // Long roundings would reach beyond the width: near it they are held below what is left of it.
      const double share = half * v * v / (1. - v * v);
      return rounded_ramp(1. - r_squared, half / std::sqrt(std::sqrt(1. + share * share * share * share)));
    };
  }


  Defect defect_along(const MeasuredLine &line, const bool reversed)
  {
    const double from = line.begin(), length = line.end() - line.begin();
    const double z_begin = line(line.begin()), z_end = line(line.end());
    const auto   below = [=](const double u) {
      return (1. - u) * z_begin + u * z_end - line(from + u * length);
    };
    double             deepest = 0.;
    const unsigned int n       = 10000;
    for (unsigned int i = 0; i <= n; ++i)
      deepest = std::max(deepest, below(double(i) / n));
    if (!(deepest > 0.))
      throw std::runtime_error("a defect's profile must lie below the line between its ends");

    Defect defect;
    defect.length = length;
    defect.depth  = deepest;
    defect.shape  = [=](const double u, const double v) {
      return u <= 0. || u >= 1. || std::abs(v) >= 1. ? 0.
                                                      : below(reversed ? 1. - u : u) / deepest * (1. - v * v);
    };
    return defect;
  }
} // namespace tread
