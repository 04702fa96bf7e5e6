// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/defect.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace tread
{
  namespace
  {
    using std::numbers::pi;

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


  std::pair<double, double> extremes_of(const std::function<double(double u, double v)> &shape)
  {
    constexpr unsigned int n = 2000, n_across = 200; // places along and across
    double                 least = 0., largest = 0.;
    for (unsigned int i = 0; i <= n; ++i)
      for (unsigned int j = 0; j <= n_across; ++j)
        {
          const double depth = shape(double(i) / n, 2. * j / n_across - 1.);
          least              = std::min(least, depth);
          largest            = std::max(largest, depth);
        }
    return {least, largest};
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


  std::function<double(double, double)> corrugation(const double wavelength)
  {
    return [=](const double u, const double v) {
      return u <= 0. || u >= 1. || std::abs(v) >= 1. ? 0. : 0.5 * (1. - std::cos(2. * pi * u / wavelength));
    };
  }


  std::function<double(double, double)> with_ramps(std::function<double(double, double)> shape,
                                                   const double                          ramp)
  {
    return [=](const double u, const double v) {
      const double from_end = std::min(u, 1. - u);
      return from_end <= 0.     ? 0.
             : from_end >= ramp ? shape(u, v)
                                : shape(u, v) * 0.5 * (1. - std::cos(pi * from_end / ramp));
    };
  }


  std::function<double(double, double)> with_parabola(std::function<double(double, double)> shape)
  {
    return [=](const double u, const double v) {
      return shape(u, v) * (1. - v * v);
    };
  }


  Defect defect_along(const MeasuredLine &line, const LineDatum datum, const bool reversed)
  {
    const double       from = line.begin(), length = line.end() - line.begin();
    const unsigned int n       = 10000; // places along it
    double             z_begin = line(line.begin()), z_end = line(line.end());
    if (datum == LineDatum::fitted)
      {
        // Mean and slope are orthogonal about the middle.
        double sum = 0., moment = 0., squares = 0.;
        for (unsigned int i = 0; i <= n; ++i)
          {
            const double u = double(i) / n - 0.5, z = line(from + double(i) / n * length);
            sum += z;
            moment += u * z;
            squares += u * u;
          }
        const double mean = sum / (n + 1), slope = moment / squares;
        z_begin = mean - 0.5 * slope;
        z_end   = mean + 0.5 * slope;
      }
    const auto below = [=](const double u) {
      return (1. - u) * z_begin + u * z_end - line(from + u * length);
    };
    double deepest = 0.;
    for (unsigned int i = 0; i <= n; ++i)
      {
        const double depth = below(double(i) / n);
        deepest            = std::max(deepest, datum == LineDatum::fitted ? std::abs(depth) : depth);
      }
    if (!(deepest > 0.))
      throw std::runtime_error(
        datum == LineDatum::fitted
          ? "the profile is straight"
          : "the profile lies above the line between its ends, and a defect of 'Shape' profile lies "
            "below it: if its depth is counted downwards, change the sign of z; a raised "
            "weld is given by 'Shape' map");

    Defect defect;
    defect.length = length;
    defect.depth  = deepest;
    defect.shape  = [=](const double u, const double v) {
      return u <= 0. || u >= 1. || std::abs(v) >= 1. ? 0. : below(reversed ? 1. - u : u) / deepest;
    };
    return defect;
  }
} // namespace tread
