// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_natural_spline_h
#define tread_geometry_natural_spline_h

#include <cstddef>
#include <vector>

namespace tread
{
  /// Second derivatives at the knots of the natural cubic spline through values at places that increase.
  inline std::vector<double> natural_spline(const std::vector<double> &at, const std::vector<double> &values)
  {
    const std::size_t   n = at.size();
    std::vector<double> upper(n, 0.), bend(n, 0.);
    for (std::size_t i = 1; i + 1 < n; ++i)
      {
        const double before = at[i] - at[i - 1], behind = at[i + 1] - at[i];
        const double right =
          6. * ((values[i + 1] - values[i]) / behind - (values[i] - values[i - 1]) / before);
        const double pivot = 2. * (before + behind) - before * upper[i - 1];
        upper[i]           = behind / pivot;
        bend[i]            = (right - before * bend[i - 1]) / pivot;
      }
    for (std::size_t i = n - 1; i-- > 1;)
      bend[i] -= upper[i] * bend[i + 1];
    return bend;
  }


  /// Shares of the ends of a piece of a cubic spline in its value and in its slope.
  struct SplinePiece
  {
    /// @param length of the piece, @param share of it up to the place
    SplinePiece(const double length, const double share)
      : a(1. - share)
      , b(share)
      , h(length)
    {
    }

    /// @param low, high values at the ends, @param bend_low, bend_high second derivatives there
    double value(const double low, const double high, const double bend_low, const double bend_high) const
    {
      return a * low + b * high + ((a * a * a - a) * bend_low + (b * b * b - b) * bend_high) * h * h / 6.;
    }
    double slope(const double low, const double high, const double bend_low, const double bend_high) const
    {
      return (high - low) / h + ((1. - 3. * a * a) * bend_low + (3. * b * b - 1.) * bend_high) * h / 6.;
    }

  private:
    double a, b, h;
  };
} // namespace tread

#endif
