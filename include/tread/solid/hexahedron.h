// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_solid_hexahedron_h
#define tread_solid_hexahedron_h

#include <tread/material/elastic.h>

#include <deal.II/base/point.h>

#include <array>

namespace tread
{
  /// Integrals over one trilinear hexahedron in its reference position.
  struct HexahedronIntegrals
  {
    double volume; ///< m^3
    std::array<std::array<double, 3>, 8>
      gradient; ///< mean of dN_a/dX, 1/m (Flanagan & Belytschko 1981, eq. 15)
    std::array<std::array<double, 8>, 4>
      hourglass; ///< gamma: orthogonal to every linear field (same, eq. 35)
    std::array<std::array<double, 3>, 4>
      moment; ///< sums of the positions times the hourglass patterns: 0 in a parallelepiped, m
    std::array<double, 8>                               node_volume;    ///< integral of N_a, m^3
    std::array<std::array<std::array<double, 3>, 8>, 8> point_gradient; ///< dN_a/dX at the Gauss points
    std::array<double, 8>                               point_volume;

    /// @throws std::runtime_error if the Jacobian is not positive at a Gauss point.
    explicit HexahedronIntegrals(const std::array<dealii::Point<3>, 8> &nodes);
  };

  /// Mean of a cell's corners.
  inline dealii::Point<3> centre_of(const std::array<dealii::Point<3>, 8> &corners)
  {
    dealii::Point<3> centre;
    for (const dealii::Point<3> &p : corners)
      centre += p / 8.;
    return centre;
  }

  /// Whether a cell with these corners is a box, sheared or turned: the sums of the positions times the
  /// hourglass patterns are below 1e-10 of its size, which is round-off of positions.
  bool is_parallelepiped(const std::array<dealii::Point<3>, 8> &corners);

  /// Linear mode xi, eta or zeta at a node of a cell in lexicographic order: 1 or -1.
  constexpr double linear_pattern(const unsigned int direction, const unsigned int node)
  {
    return ((node >> direction) & 1) ? 1. : -1.;
  }

  /// Hourglass mode eta zeta, zeta xi, xi eta or xi eta zeta at a node: 1 or -1.
  constexpr double hourglass_pattern(const unsigned int mode, const unsigned int node)
  {
    double product = 1.;
    for (unsigned int d = 0; d < 3; ++d)
      if (d != mode)
        product *= linear_pattern(d, node);
    return product;
  }

  /// Stiffness of the hourglass amplitudes gamma.x of a cell, N/m; 1 as coefficient gives a box that of a
  /// plate bent along its longest edge: E/(1 - nu^2) V/24 times the smallest eigenvalue of sum_a B_a B_a^T.
  double hourglass_stiffness(const HexahedronIntegrals &cell,
                             const ElasticMaterial     &material,
                             const double               coefficient);

  /// Upper bound of the highest angular frequency of one free cell, rad/s, with the nodal masses
  /// density_scale * density * node_volume: with one strain and this stiffness of the hourglass amplitudes,
  /// or with 2 x 2 x 2 Gauss points.
  double one_point_frequency_bound(const HexahedronIntegrals &cell,
                                   const ElasticMaterial     &material,
                                   const double               hourglass_stiffness,
                                   const double               density_scale);
  double fully_integrated_frequency_bound(const HexahedronIntegrals &cell,
                                          const ElasticMaterial     &material,
                                          const double               density_scale);
} // namespace tread

#endif
