// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/solid/hexahedron.h>
#include <tread/solid/surface_lattice.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
    using Complex = std::complex<double>;
    using Matrix  = SurfaceLattice::Matrix;

    constexpr double pi = 3.14159265358979323846;

    Matrix operator*(const Matrix &a, const Matrix &b)
    {
      Matrix c{};
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int j = 0; j < 3; ++j)
            c[i][j] += a[i][k] * b[k][j];
      return c;
    }

    Matrix operator+(Matrix a, const Matrix &b)
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          a[i][j] += b[i][j];
      return a;
    }

    Matrix operator-(Matrix a, const Matrix &b)
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          a[i][j] -= b[i][j];
      return a;
    }

    Matrix adjoint(const Matrix &a)
    {
      Matrix b;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          b[i][j] = std::conj(a[j][i]);
      return b;
    }

    Matrix inverse(const Matrix &a)
    {
      const auto cofactor = [&](const unsigned int i, const unsigned int j) {
        const unsigned int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        return a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1];
      };
      const Complex determinant =
        a[0][0] * cofactor(0, 0) + a[0][1] * cofactor(0, 1) + a[0][2] * cofactor(0, 2);
      Matrix b;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          b[i][j] = cofactor(j, i) / determinant;
      return b;
    }

    double largest(const Matrix &a)
    {
      double size = 0.;
      for (const auto &row : a)
        for (const Complex &entry : row)
          size = std::max(size, std::abs(entry));
      return size;
    }

    /// Points of the quadrature over half a period: 12 and 24 give the same weights to 1e-4.
    constexpr unsigned int n_waves = 16;
  } // namespace


  HourglassWeights unit_weights()
  {
    HourglassWeights weights;
    for (auto &mode : weights)
      mode.fill(1.);
    return weights;
  }


  CellMatrix one_point_box(const std::array<double, 3> &edges,
                           const double                 poisson_ratio,
                           const double                 coefficient,
                           const HourglassWeights      &weights)
  {
    const double lambda = 2. * poisson_ratio / (1. - 2. * poisson_ratio),
                 volume = edges[0] * edges[1] * edges[2], longest = std::max({edges[0], edges[1], edges[2]}),
                 plate_modulus = 2. / (1. - poisson_ratio),
                 hourglass     = coefficient * plate_modulus * volume / (48. * longest * longest);
    CellMatrix K{};
    for (unsigned int a = 0; a < 8; ++a)
      for (unsigned int b = 0; b < 8; ++b)
        {
          double ga[3], gb[3], product = 0.;
          for (unsigned int i = 0; i < 3; ++i)
            {
              ga[i] = linear_pattern(i, a) / (4. * edges[i]);
              gb[i] = linear_pattern(i, b) / (4. * edges[i]);
              product += ga[i] * gb[i];
            }
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              K[3 * a + i][3 * b + j] =
                volume * (lambda * ga[i] * gb[j] + ga[j] * gb[i] + (i == j ? product : 0.));
          for (unsigned int m = 0; m < 4; ++m)
            for (unsigned int i = 0; i < 3; ++i)
              K[3 * a + i][3 * b + i] +=
                hourglass * weights[m][i] * hourglass_pattern(m, a) * hourglass_pattern(m, b);
        }
    return K;
  }


  SurfaceLattice::SurfaceLattice(const std::array<double, 3> &edges,
                                 const double                 poisson_ratio,
                                 const CellMatrix            &cell)
    : edges(edges)
    , poisson_ratio(poisson_ratio)
    , cell(cell)
  {
    const dealii::QGauss<1> quadrature(n_waves);
    for (unsigned int line = 0; line < 3; ++line)
      for (unsigned int q = 0; q < n_waves; ++q)
        {
          const double t = pi * quadrature.point(q)[0], half = std::sin(0.5 * t);
          const double t0 = line == 1 ? 0. : t, t1 = line == 0 ? 0. : t;
          waves[line].push_back(
            {t0, t1, quadrature.weight(q) / (4. * half * half), half_space(cell, t0, t1)});
        }
  }


  SurfaceLattice::Layer SurfaceLattice::layer(const CellMatrix &cell, const double t0, const double t1)
  {
    Complex phase[4];
    for (unsigned int a = 0; a < 4; ++a)
      phase[a] = std::exp(Complex(0., t0 * (a & 1) + t1 * (a >> 1)));
    const auto coupling = [&](const unsigned int first, const unsigned int second) {
      Matrix sum{};
      for (unsigned int a = 0; a < 4; ++a)
        for (unsigned int b = 0; b < 4; ++b)
          {
            const Complex factor = std::conj(phase[a]) * phase[b];
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                sum[i][j] += factor * cell[3 * (first + a) + i][3 * (second + b) + j];
          }
      return sum;
    };
    return {coupling(4, 4), coupling(4, 0), coupling(0, 0)};
  }


  SurfaceLattice::Matrix SurfaceLattice::half_space(const CellMatrix &cell, const double t0, const double t1)
  {
    // Cyclic reduction: each pass doubles the number of layers.
    auto [upper, across, lower] = layer(cell, t0, t1);
    for (unsigned int pass = 0; pass < 60; ++pass)
      {
        const Matrix middle = inverse(lower + upper), down = across * middle;
        const Matrix change = down * adjoint(across);
        lower               = lower - adjoint(across) * middle * across;
        across              = Matrix{} - down * across;
        upper               = upper - change;
        if (largest(change) < 1e-15 * largest(upper))
          break;
      }
    return upper;
  }


  SurfaceLattice::Matrix SurfaceLattice::compliance(const Matrix     &half_space,
                                                    const double      t0,
                                                    const double      t1,
                                                    const CellMatrix &uppermost)
  {
    const auto [upper, across, lower] = layer(uppermost, t0, t1);
    return inverse(upper - across * inverse(lower + half_space) * adjoint(across));
  }


  SurfaceLattice::Matrix SurfaceLattice::compliance(const double      t0,
                                                    const double      t1,
                                                    const CellMatrix &uppermost) const
  {
    return compliance(half_space(cell, t0, t1), t0, t1, uppermost);
  }


  SurfaceLattice::EdgeOffsets SurfaceLattice::edge_offsets(const CellMatrix &uppermost) const
  {
    EdgeOffsets offsets{};
    for (unsigned int line = 0; line < 3; ++line)
      {
        // The edge lies along a row of nodes; the waves go along its normal.
        double       normal[2] = {line == 1 ? 0. : 1. / edges[0], line == 0 ? 0. : 1. / edges[1]};
        const double size      = std::hypot(normal[0], normal[1]);
        normal[0] /= size;
        normal[1] /= size;
        for (const Wave &wave : waves[line])
          {
            const Matrix C      = compliance(wave.half_space, wave.t0, wave.t1, uppermost);
            const auto   in_dir = [&](const double n0, const double n1) {
              return n0 * n0 * C[0][0].real() + n1 * n1 * C[1][1].real() +
                     n0 * n1 * (C[0][1] + C[1][0]).real();
            };
            const double along  = in_dir(normal[0], normal[1]),
                         across = in_dir(-normal[1], normal[0]) * (1. - poisson_ratio);
            offsets[2 * line] -= wave.weight * std::log(along / C[2][2].real());
            offsets[2 * line + 1] -= wave.weight * std::log(across / C[2][2].real());
          }
      }
    return offsets;
  }


  HourglassWeights SurfaceWeights::weights_of(const Unknowns &logarithms)
  {
    const auto value = [&](const unsigned int k) {
      return std::exp(logarithms.value[k]);
    };
    HourglassWeights weights = unit_weights();
    weights[1]               = {{value(Unknowns::along_0), value(Unknowns::across_0), 1.}};
    weights[0]               = {{value(Unknowns::across_1), value(Unknowns::along_1), 1.}};
    weights[2]               = {{value(Unknowns::in_surface), value(Unknowns::in_surface), 1.}};
    weights[3]               = {{value(Unknowns::all), value(Unknowns::all), 1.}};
    return weights;
  }


  namespace
  {
    /// Shapes are solved at these steps of the logarithms of their edges' ratios.
    constexpr double step_of_shapes = 0.1;
  } // namespace


  const std::optional<SurfaceWeights::Unknowns> &SurfaceWeights::solved(const std::pair<int, int> &shape)
  {
    if (const auto known = of_shapes.find(shape); known != of_shapes.end())
      return known->second;
    constexpr unsigned int n      = Unknowns::n;
    constexpr double       enough = 1e-5, difference = 1e-4, largest_change = 0.7, largest_weight = 3.;

    const std::array<double, 3> edges{
      {1., std::exp(step_of_shapes * shape.first), std::exp(step_of_shapes * shape.second)}};
    const SurfaceLattice lattice(edges, poisson_ratio, one_point_box(edges, poisson_ratio, coefficient));
    const auto           offsets = [&](const Unknowns &at) {
      return lattice.edge_offsets(one_point_box(edges, poisson_ratio, coefficient, weights_of(at)));
    };
    const auto size = [](const SurfaceLattice::EdgeOffsets &r) {
      double sum = 0.;
      for (const double value : r)
        sum += value * value;
      return std::sqrt(sum);
    };
    // Newton's method, from the weights of a cube with Poisson's ratio 0.3, with shorter steps where it gains
    // nothing.
    Unknowns now{{{std::log(0.162), std::log(0.443), std::log(0.162), std::log(0.443), std::log(0.765),
                   std::log(1.095)}}};
    auto     residual = offsets(now);
    for (unsigned int iteration = 0; iteration < 30 && size(residual) > enough; ++iteration)
      {
        dealii::FullMatrix<double> jacobian(n, n);
        for (unsigned int k = 0; k < n; ++k)
          {
            Unknowns beside = now;
            beside.value[k] += difference;
            const auto there = offsets(beside);
            for (unsigned int i = 0; i < n; ++i)
              jacobian(i, k) = (there[i] - residual[i]) / difference;
          }
        dealii::Vector<double> right(n), change(n);
        for (unsigned int i = 0; i < n; ++i)
          right[i] = -residual[i];
        jacobian.gauss_jordan();
        jacobian.vmult(change, right);
        double share = std::min(1., largest_change / std::max(1e-300, change.linfty_norm()));
        bool   gains = false;
        for (unsigned int halving = 0; halving < 6 && !gains; ++halving, share *= 0.5)
          {
            Unknowns next = now;
            for (unsigned int k = 0; k < n; ++k)
              next.value[k] += share * change[k];
            if (const auto there = offsets(next); size(there) < size(residual))
              {
                now      = next;
                residual = there;
                gains    = true;
              }
          }
        if (!gains)
          break;
      }
    std::optional<Unknowns> found;
    if (size(residual) <= enough &&
        *std::max_element(now.value.begin(), now.value.end()) <= std::log(largest_weight))
      found = now;
    return of_shapes.emplace(shape, found).first->second;
  }


  std::optional<HourglassWeights> SurfaceWeights::of_box(const std::array<double, 3> &edges)
  {
    const double ratio[2] = {std::log(edges[1] / edges[0]) / step_of_shapes,
                             std::log(edges[2] / edges[0]) / step_of_shapes};
    // Beyond this nothing is found, or what is found is of no use.
    if (std::max(std::abs(ratio[0]), std::abs(ratio[1])) > 1.5 / step_of_shapes)
      return {};
    const int first[2] = {static_cast<int>(std::floor(ratio[0])), static_cast<int>(std::floor(ratio[1]))};
    Unknowns  mean{};
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        {
          const double along = ratio[0] - first[0], down = ratio[1] - first[1],
                       share = (i == 1 ? along : 1. - along) * (j == 1 ? down : 1. - down);
          // Round-off next to a shape that is solved must not ask for its neighbour.
          if (share < 1e-9)
            continue;
          const std::optional<Unknowns> &corner = solved({first[0] + i, first[1] + j});
          if (!corner)
            return {};
          for (unsigned int k = 0; k < Unknowns::n; ++k)
            mean.value[k] += share * corner->value[k];
        }
    return weights_of(mean);
  }
} // namespace tread
