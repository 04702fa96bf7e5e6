// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/smoothing_spline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace tread
{
  namespace
  {
    using Point = dealii::Point<2>;

    /// Minimum over g of the sum of w_i (z_i - g_i)^2 + lambda times the integral of g''^2, g a natural cubic
    /// spline with knots s: (R + lambda Q' W^-1 Q) c = Q' z, g = z - lambda W^-1 Q c (Reinsch 1967). Weights
    /// are the lengths for which points stand.
    std::vector<double> natural_smoothing(const std::vector<double> &s,
                                          const std::vector<double> &z,
                                          const double               lambda)
    {
      const std::size_t   n = s.size();
      std::vector<double> h(n - 1), inverse_weight(n);
      for (std::size_t i = 0; i + 1 < n; ++i)
        h[i] = s[i + 1] - s[i];
      for (std::size_t i = 0; i < n; ++i)
        inverse_weight[i] = 2. / ((i > 0 ? h[i - 1] : h[i]) + (i + 1 < n ? h[i] : h[i - 1]));
      // Column k of Q, for the second derivative at knot k + 1, has three entries.
      const std::size_t                  m = n - 2;
      std::vector<std::array<double, 3>> q(m);
      for (std::size_t k = 0; k < m; ++k)
        q[k] = {1. / h[k], -1. / h[k] - 1. / h[k + 1], 1. / h[k + 1]};
      // Bands of the matrix: its diagonal and two above it; then L D L' in place.
      std::vector<std::array<double, 3>> a(m);
      std::vector<double>                c(m);
      for (std::size_t k = 0; k < m; ++k)
        {
          for (std::size_t d = 0; d < 3; ++d)
            {
              a[k][d] = 0.;
              if (k + d < m)
                for (std::size_t i = d; i < 3; ++i)
                  a[k][d] += lambda * q[k][i] * inverse_weight[k + i] * q[k + d][i - d];
            }
          a[k][0] += (h[k] + h[k + 1]) / 3.;
          a[k][1] += k + 1 < m ? h[k + 1] / 6. : 0.;
          c[k] = q[k][0] * z[k] + q[k][1] * z[k + 1] + q[k][2] * z[k + 2];
        }
      for (std::size_t k = 0; k < m; ++k)
        {
          const double one = a[k][1] / a[k][0], two = a[k][2] / a[k][0];
          if (k + 1 < m)
            {
              a[k + 1][0] -= one * a[k][1];
              a[k + 1][1] -= one * a[k][2];
              c[k + 1] -= one * c[k];
            }
          if (k + 2 < m)
            {
              a[k + 2][0] -= two * a[k][2];
              c[k + 2] -= two * c[k];
            }
        }
      for (std::size_t k = m; k-- > 0;)
        c[k] =
          (c[k] - (k + 1 < m ? a[k][1] * c[k + 1] : 0.) - (k + 2 < m ? a[k][2] * c[k + 2] : 0.)) / a[k][0];
      std::vector<double> g = z;
      for (std::size_t k = 0; k < m; ++k)
        for (std::size_t i = 0; i < 3; ++i)
          g[k + i] -= lambda * inverse_weight[k + i] * q[k][i] * c[k];
      return g;
    }

    /// The parabola of best fit through z(s) of the points [begin, end), about s_0: value, slope and
    /// curvature.
    std::array<double, 3> parabola(const std::vector<double> &s,
                                   const std::vector<double> &z,
                                   const std::size_t          begin,
                                   const std::size_t          end,
                                   const double               s_0,
                                   const double               scale)
    {
      double m[3][4] = {};
      for (std::size_t i = begin; i < end; ++i)
        {
          const double u = (s[i] - s_0) / scale, powers[] = {1., u, u * u};
          for (unsigned int r = 0; r < 3; ++r)
            {
              for (unsigned int k = 0; k < 3; ++k)
                m[r][k] += powers[r] * powers[k];
              m[r][3] += powers[r] * z[i];
            }
        }
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int r = k + 1; r < 3; ++r)
          {
            const double factor = m[r][k] / m[k][k];
            for (unsigned int i = k; i < 4; ++i)
              m[r][i] -= factor * m[k][i];
          }
      std::array<double, 3> p{};
      for (unsigned int k = 3; k-- > 0;)
        {
          double rest = m[k][3];
          for (unsigned int i = k + 1; i < 3; ++i)
            rest -= m[k][i] * p[i];
          p[k] = rest / m[k][k];
        }
      return p;
    }
  } // namespace


  std::vector<Point> smoothed(const std::vector<Point> &points, const double length)
  {
    const std::size_t n = points.size();
    if (n < 4)
      return points;
    std::vector<double> s(n, 0.);
    for (std::size_t i = 1; i < n; ++i)
      {
        s[i] = s[i - 1] + points[i].distance(points[i - 1]);
        if (!(s[i] > s[i - 1]))
          throw std::runtime_error("points coincide");
      }
    // What continues the curve: as many points as the spline feels, at the usual distance.
    const double       reach = 2. * length;
    const std::size_t  n_end = std::min<std::size_t>(n, 5);
    const double       usual = std::max(s.back() / (n - 1), reach / 100.);
    const std::size_t  extra = static_cast<std::size_t>(std::ceil(reach / usual));
    std::vector<Point> result(n);
    const double       lambda = std::pow(0.5 * length / std::numbers::pi, 4);
    std::size_t        first = n_end, last = n - n_end; // of the ends by which the parabolas are fitted
    while (first < n && s[first] - s[0] < length)
      ++first;
    while (last > 0 && s[n - 1] - s[last - 1] < length)
      --last;
    for (unsigned int d = 0; d < 2; ++d)
      {
        std::vector<double> z(n), along, values;
        for (std::size_t i = 0; i < n; ++i)
          z[i] = points[i][d];
        const double scale_first = s[first - 1] - s[0], scale_last = s[n - 1] - s[last];
        const auto   before = parabola(s, z, 0, first, s[0], scale_first),
                   behind   = parabola(s, z, last, n, s[n - 1], scale_last);
        for (std::size_t i = extra; i > 0; --i)
          {
            const double u = -(i * usual) / scale_first;
            along.push_back(s[0] - i * usual);
            values.push_back(before[0] + u * (before[1] + u * before[2]));
          }
        along.insert(along.end(), s.begin(), s.end());
        values.insert(values.end(), z.begin(), z.end());
        for (std::size_t i = 1; i <= extra; ++i)
          {
            const double u = i * usual / scale_last;
            along.push_back(s[n - 1] + i * usual);
            values.push_back(behind[0] + u * (behind[1] + u * behind[2]));
          }
        const std::vector<double> g = natural_smoothing(along, values, lambda);
        for (std::size_t i = 0; i < n; ++i)
          result[i][d] = g[extra + i];
      }
    return result;
  }
} // namespace tread
