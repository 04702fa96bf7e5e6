// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_solid_surface_lattice_h
#define tread_solid_surface_lattice_h

#include <tread/material/elastic.h>

#include <array>
#include <complex>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace tread
{
  /// Factors on the hourglass stiffness of a box cell, by mode (that which varies in the directions other
  /// than 0, 1 or 2; last, that which varies in all three) and direction of the displacement. Directions 0
  /// and 1 are the cell's edges in the surface, 2 is the normal.
  using HourglassWeights = std::array<std::array<double, 3>, 4>;

  /// All factors 1: the stiffness of cells below the surface.
  HourglassWeights unit_weights();

  /// Stiffness matrix of a cell in units of the shear modulus times an edge; row 3 a + i: node a in
  /// lexicographic order, direction i.
  using CellMatrix = std::array<std::array<double, 24>, 24>;

  /// That of a one-point box (Flanagan & Belytschko 1981). @param edges over the first of them. @param
  /// coefficient of the hourglass stiffness (@see hourglass_stiffness).
  CellMatrix one_point_box(const std::array<double, 3> &edges,
                           const double                 poisson_ratio,
                           const double                 coefficient,
                           const HourglassWeights      &weights = unit_weights());

  /// A half-space of equal box cells: how its surface nodes yield to forces, exactly, by waves along the
  /// surface. The page doc/rolling-error.md derives what is computed here.
  class SurfaceLattice
  {
  public:
    using Matrix = std::array<std::array<std::complex<double>, 3>, 3>;

    /// How far ahead of the pressure's edge a mesh puts that of the surface shear stress, in rows of nodes:
    /// with the edge across direction 0 (of the box), tractions along it and across; the same for direction
    /// 1; and for an edge along the diagonal of the surface's cells. All are 0 on a continuum.
    using EdgeOffsets = std::array<double, 6>;

    /// @param cell of all layers but the uppermost.
    SurfaceLattice(const std::array<double, 3> &edges, const double poisson_ratio, const CellMatrix &cell);

    /// Displacement of the surface nodes under a wave of nodal forces exp(i (t0 m + t1 n)), over force: in
    /// units of one over shear modulus and first edge. @param uppermost cell.
    Matrix compliance(const double t0, const double t1, const CellMatrix &uppermost) const;

    EdgeOffsets edge_offsets(const CellMatrix &uppermost) const;

  private:
    /// Layer of cells under a wave: couplings of its upper nodes, of upper with lower ones, of the lower
    /// ones.
    struct Layer
    {
      Matrix upper, across, lower;
    };
    static Layer  layer(const CellMatrix &cell, const double t0, const double t1);
    static Matrix half_space(const CellMatrix &cell, const double t0, const double t1);
    static Matrix compliance(const Matrix     &half_space,
                             const double      t0,
                             const double      t1,
                             const CellMatrix &uppermost);

    /// A wave at which the offsets look, and the stiffness of the half-space under the uppermost layer.
    struct Wave
    {
      double t0, t1, weight; ///< of the quadrature, over the square of sin(t/2)
      Matrix half_space;
    };

    std::array<double, 3>            edges;
    double                           poisson_ratio;
    CellMatrix                       cell;
    std::array<std::vector<Wave>, 3> waves; ///< across direction 0, across 1, along the diagonal
  };


  /// Weights with which the uppermost layer of one-point cells gives the surface the tangential compliance
  /// that belongs to its normal one: all edge offsets vanish. They depend on the cell's shape, on Poisson's
  /// ratio and on the hourglass coefficient alone.
  class SurfaceWeights
  {
  public:
    SurfaceWeights(const double poisson_ratio, const double hourglass_coefficient)
      : poisson_ratio(poisson_ratio)
      , coefficient(hourglass_coefficient)
    {
    }

    /// For a box with these edges, m, the last along the normal: interpolated between shapes that are solved
    /// when they are first asked for, a few milliseconds each, so that cells whose shapes differ by round-off
    /// have weights that do. None: no positive weights were found for a shape that far from a cube.
    std::optional<HourglassWeights> of_box(const std::array<double, 3> &edges);

  private:
    /// In the surface: modes that vary along the normal and one edge, in the direction of that edge (along)
    /// and of the other one (across), by edge; the mode that varies in all directions; that of the surface.
    /// Logarithms.
    struct Unknowns
    {
      enum
      {
        along_0,
        across_0,
        along_1,
        across_1,
        all,
        in_surface,
        n
      };
      std::array<double, n> value;
    };
    static HourglassWeights weights_of(const Unknowns &logarithms);

    /// @param shape logarithms of the second and third edge over the first, in steps.
    const std::optional<Unknowns> &solved(const std::pair<int, int> &shape);

    double                                                 poisson_ratio, coefficient;
    std::map<std::pair<int, int>, std::optional<Unknowns>> of_shapes;
  };
} // namespace tread

#endif
