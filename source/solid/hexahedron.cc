// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/solid/hexahedron.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace tread
{
  namespace
  {
    /// Upper bound of the largest eigenvalue of a symmetric positive semi-definite matrix by
    /// repeated squaring: lambda_max <= (trace A^p)^(1/p), p = 64, at most n^(1/64) too large.
    template <unsigned int n>
    double largest_eigenvalue_bound(std::array<std::array<double, n>, n> a)
    {
      double log_scale = 0., power = 1.;
      for (unsigned int squaring = 0; squaring < 6; ++squaring)
        {
          double trace = 0.;
          for (unsigned int i = 0; i < n; ++i)
            trace += a[i][i];
          if (trace <= 0.)
            return 0.;
          log_scale += std::log(trace) / power;
          std::array<std::array<double, n>, n> b{};
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int k = 0; k < n; ++k)
              for (unsigned int j = 0; j < n; ++j)
                b[i][j] += a[i][k] * a[k][j] / (trace * trace);
          a = b;
          power *= 2.;
        }
      double trace = 0.;
      for (unsigned int i = 0; i < n; ++i)
        trace += a[i][i];
      return std::exp(log_scale + std::log(trace) / power);
    }

    /// Gram matrix of the strain modes: C^(1/2) (sum_a b_a b_a^T / m_a) C^(1/2) V.
    void add_strain_gram(std::array<std::array<double, 6>, 6>       &gram,
                         const std::array<std::array<double, 3>, 8> &gradient,
                         const double                                volume,
                         const std::array<double, 8>                &mass,
                         const ElasticMaterial                      &material)
    {
      const double mu = material.shear_modulus(), bulk = 2. * mu + 3. * material.lame();
      const double diagonal = std::sqrt(2. * mu), coupling = (std::sqrt(bulk) - diagonal) / 3.;
      for (unsigned int a = 0; a < 8; ++a)
        {
          const auto &g = gradient[a];
          // Rows of C^(1/2) b_a, engineering shear.
          double rows[6][3] = {{g[0], 0., 0.},   {0., g[1], 0.},   {0., 0., g[2]},
                               {g[1], g[0], 0.}, {0., g[2], g[1]}, {g[2], 0., g[0]}};
          double scaled[6][3];
          for (unsigned int d = 0; d < 3; ++d)
            {
              const double sum = rows[0][d] + rows[1][d] + rows[2][d];
              for (unsigned int i = 0; i < 3; ++i)
                scaled[i][d] = diagonal * rows[i][d] + coupling * sum;
              for (unsigned int i = 3; i < 6; ++i)
                scaled[i][d] = std::sqrt(mu) * rows[i][d];
            }
          for (unsigned int i = 0; i < 6; ++i)
            for (unsigned int j = 0; j < 6; ++j)
              for (unsigned int d = 0; d < 3; ++d)
                gram[i][j] += volume * scaled[i][d] * scaled[j][d] / mass[a];
        }
    }

    /// Scaled, kg.
    std::array<double, 8> node_masses(const HexahedronIntegrals &cell,
                                      const ElasticMaterial     &material,
                                      const double               density_scale)
    {
      std::array<double, 8> mass;
      for (unsigned int a = 0; a < 8; ++a)
        mass[a] = density_scale * material.density * cell.node_volume[a];
      return mass;
    }

    std::array<std::array<double, 3>, 4> hourglass_moments(const std::array<dealii::Point<3>, 8> &nodes)
    {
      std::array<std::array<double, 3>, 4> moments{};
      for (unsigned int m = 0; m < 4; ++m)
        for (unsigned int a = 0; a < 8; ++a)
          for (unsigned int i = 0; i < 3; ++i)
            moments[m][i] += hourglass_pattern(m, a) * nodes[a][i];
      return moments;
    }
  } // namespace


  HexahedronIntegrals::HexahedronIntegrals(const std::array<dealii::Point<3>, 8> &nodes)
    : volume(0.)
    , gradient{}
    , node_volume{}
  {
    const double gauss = 1. / std::sqrt(3.);
    // Two Gauss points a direction integrate det J, N det J and cof J dN exactly.
    for (unsigned int q = 0; q < 8; ++q)
      {
        const double         xi[3] = {gauss * linear_pattern(0, q), gauss * linear_pattern(1, q),
                                      gauss * linear_pattern(2, q)};
        double               N[8], dN[8][3];
        dealii::Tensor<2, 3> jacobian;
        for (unsigned int a = 0; a < 8; ++a)
          {
            const double f[3] = {1. + linear_pattern(0, a) * xi[0], 1. + linear_pattern(1, a) * xi[1],
                                 1. + linear_pattern(2, a) * xi[2]};
            N[a]              = f[0] * f[1] * f[2] / 8.;
            dN[a][0]          = linear_pattern(0, a) * f[1] * f[2] / 8.;
            dN[a][1]          = linear_pattern(1, a) * f[0] * f[2] / 8.;
            dN[a][2]          = linear_pattern(2, a) * f[0] * f[1] / 8.;
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                jacobian[i][j] += nodes[a][i] * dN[a][j];
          }
        const double weight = determinant(jacobian);
        if (!(weight > 0.))
          throw std::runtime_error(
            "mesh: a cell near x = " + text_in_mm(nodes[0][0]) + ", y = " + text_in_mm(nodes[0][1]) +
            ", z = " + text_in_mm(nodes[0][2]) +
            " mm is turned inside out: the surface there is steeper or rougher than its "
            "cells can follow. Look at what is measured ('Rail/Measured head', 'Wheel/Tread "
            "profile', 'Defect/Profile file'), or give a rail's flanks to a wheelset in its "
            "track ('Wheelset/Lateral shift (mm)')");
        const dealii::Tensor<2, 3> inverse = invert(jacobian);
        point_volume[q]                    = weight;
        volume += weight;
        for (unsigned int a = 0; a < 8; ++a)
          {
            node_volume[a] += N[a] * weight;
            for (unsigned int i = 0; i < 3; ++i)
              {
                double g = 0.;
                for (unsigned int j = 0; j < 3; ++j)
                  g += dN[a][j] * inverse[j][i];
                point_gradient[q][a][i] = g;
                gradient[a][i] += g * weight;
              }
          }
      }
    for (auto &g : gradient)
      for (double &component : g)
        component /= volume;

    moment = hourglass_moments(nodes);
    for (unsigned int m = 0; m < 4; ++m)
      for (unsigned int a = 0; a < 8; ++a)
        hourglass[m][a] = hourglass_pattern(m, a) - moment[m][0] * gradient[a][0] -
                          moment[m][1] * gradient[a][1] - moment[m][2] * gradient[a][2];
  }


  bool is_parallelepiped(const std::array<dealii::Point<3>, 8> &corners)
  {
    double largest = 0.;
    for (const auto &vector : hourglass_moments(corners))
      for (const double component : vector)
        largest = std::max(largest, std::abs(component));
    return largest < 1e-10 * corners[0].distance(corners[7]) / std::sqrt(3.);
  }


  double hourglass_stiffness(const HexahedronIntegrals &cell,
                             const ElasticMaterial     &material,
                             const double               coefficient)
  {
    // The direction with the smallest gradients is the longest edge: bending along it is what the
    // modes must not stiffen. It is a principal one of their squares, wherever the axes point.
    dealii::SymmetricTensor<2, 3> squares;
    for (const auto &g : cell.gradient)
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          squares[i][j] += g[i] * g[j];
    const double smallest =
      eigenvectors(squares, dealii::SymmetricTensorEigenvectorMethod::jacobi)[2].first; // sorted
    const double plate_modulus =
      material.young_modulus / (1. - material.poisson_ratio * material.poisson_ratio);
    return coefficient * plate_modulus * cell.volume * smallest / 24.;
  }


  double fully_integrated_frequency_bound(const HexahedronIntegrals &cell,
                                          const ElasticMaterial     &material,
                                          const double               density_scale)
  {
    const std::array<double, 8> mass = node_masses(cell, material, density_scale);
    // The modes of different Gauss points are coupled by the nodes: the bound of the whole
    // 48 x 48 Gram matrix follows from the stiffness matrix itself, 24 x 24.
    std::array<std::array<double, 24>, 24> k{};
    const double                           mu = material.shear_modulus(), lambda = material.lame();
    for (unsigned int q = 0; q < 8; ++q)
      for (unsigned int a = 0; a < 8; ++a)
        for (unsigned int b = 0; b < 8; ++b)
          {
            const auto  &ga = cell.point_gradient[q][a], &gb = cell.point_gradient[q][b];
            const double product = ga[0] * gb[0] + ga[1] * gb[1] + ga[2] * gb[2];
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                k[3 * a + i][3 * b + j] +=
                  cell.point_volume[q] / std::sqrt(mass[a] * mass[b]) *
                  (lambda * ga[i] * gb[j] + mu * ga[j] * gb[i] + (i == j ? mu * product : 0.));
          }
    return std::sqrt(largest_eigenvalue_bound<24>(k));
  }


  double one_point_frequency_bound(const HexahedronIntegrals &cell,
                                   const ElasticMaterial     &material,
                                   const double               hourglass_stiffness,
                                   const double               density_scale)
  {
    const std::array<double, 8>          mass = node_masses(cell, material, density_scale);
    std::array<std::array<double, 6>, 6> strain_gram{};
    add_strain_gram(strain_gram, cell.gradient, cell.volume, mass, material);
    std::array<std::array<double, 4>, 4> hourglass_gram{};
    double                               coupling = 0.;
    const double                         modulus  = 2. * material.shear_modulus() + 3. * material.lame();
    for (unsigned int m = 0; m < 4; ++m)
      {
        for (unsigned int n = 0; n < 4; ++n)
          for (unsigned int a = 0; a < 8; ++a)
            hourglass_gram[m][n] +=
              hourglass_stiffness * cell.hourglass[m][a] * cell.hourglass[n][a] / mass[a];
        for (unsigned int i = 0; i < 3; ++i)
          {
            double product = 0.;
            for (unsigned int a = 0; a < 8; ++a)
              product += cell.hourglass[m][a] * cell.gradient[a][i] / mass[a];
            coupling += product * product * hourglass_stiffness * modulus * cell.volume;
          }
      }
    // Largest eigenvalue of [[A, C], [C^T, D]] from those of A and D and the norm of C.
    const double a = largest_eigenvalue_bound<6>(strain_gram),
                 d = largest_eigenvalue_bound<4>(hourglass_gram);
    return std::sqrt(0.5 * (a + d) + std::sqrt(0.25 * (a - d) * (a - d) + coupling));
  }
} // namespace tread
