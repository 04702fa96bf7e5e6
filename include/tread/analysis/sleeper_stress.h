// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_sleeper_stress_h
#define tread_analysis_sleeper_stress_h

#include <deal.II/base/point.h>

#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

namespace tread
{
  /// A cross-section of a sleeper: a trapezoid that is symmetric about the sleeper's axis, lengths in m.
  struct SleeperStation
  {
    double from_middle; ///< of the track, along the sleeper
    double bottom_width, top_width, height;
  };

  /// Half a sleeper from the middle of the track to its end. Between stations widths and height change
  /// linearly; the bottom is flat.
  struct SleeperShape
  {
    std::vector<SleeperStation> stations;    ///< from the middle of the track outwards
    double                      seat = 0.75; ///< middle of the rail seat, from the middle of the track, m

    /// @returns the section at a distance (m) from the middle of the track.
    SleeperStation at(const double from_middle) const;
    double         volume() const;      ///< m^3
    double         bottom_area() const; ///< m^2

    /// A pre-stressed concrete sleeper of 2.52 m and 280 kg with a rail seat inclined 1:40. The mass and the
    /// density are those of the NS90; its sections, of which no drawing was at hand, are a choice that has
    /// its mass and the usual proportions.
    static SleeperShape ns90();
  };

  /// Pressure on equal rectangular parts of a pad: n_along of them along the rail and n_across across it.
  struct SeatPressures
  {
    unsigned int        n_along, n_across;
    double              pad_length, pad_width; ///< along and across the rail, m
    std::vector<double> pressure;              ///< Pa; part i along and j across is i * n_across + j

    double force() const; ///< N
    /// Moments about x and y through the middle of the seat, N m: integrals of -y p and x p.
    double moment_x() const;
    double moment_y() const;
  };

  struct SleeperStressParameters
  {
    double       young_modulus = 38.4e9; ///< Pa
    double       poisson_ratio = 0.2;
    double       cell_size     = 0.02; ///< upper bound of the cells' edges, m
    unsigned int degree        = 2;    ///< of the shape functions: 1 or 2
    /// Vertical stiffness under the half sleeper, N/m, spread evenly over its bottom, which then slides
    /// freely; without it the bottom is fixed in all directions.
    std::optional<double> ballast_stiffness = {};
    double                tolerance         = 1e-12; ///< residual over that of no displacement
  };

  /// Places are counted from the middle of the rail seat on the sleeper's top: x along the rail, y outwards
  /// along the sleeper, z upwards.
  struct SleeperStress
  {
    double           max_von_mises; ///< Pa
    dealii::Point<3> place;         ///< of the largest von Mises stress, m
    double           max_tension;   ///< largest principal stress, Pa
    dealii::Point<3> tension_place;
    double           largest_settlement;               ///< m
    double           mean_seat_settlement;             ///< of the loaded area, m
    double           force, moment_x, moment_y;        ///< of the nodal forces, N and N m
    double           bottom_force;                     ///< upwards, N
    double           bottom_moment_x, bottom_moment_y; ///< N m
    double           least_bottom_pressure;            ///< Pa; negative in tension; 0 when fixed
    double           largest_bottom_pressure;          ///< Pa; 0 when fixed
    double           volume;                           ///< of the mesh, m^3
    unsigned int     iterations;
    std::size_t      cells, unknowns;
    double           seat_cell_along, seat_cell_across; ///< edges of a cell under the pad, m
  };

  /// Linear static stress of half a sleeper under the pressures on its rail seat, which act vertically.
  /// Symmetry holds in the middle of the track. Solved by conjugate gradients with algebraic multigrid,
  /// whose near null space are the six motions of a rigid body. Collective.
  /// @param picture file for ParaView with displacement and stress; empty: none
  /// @throws std::invalid_argument if the pad does not fit on the sleeper
  SleeperStress sleeper_stress(const SleeperShape            &shape,
                               const SeatPressures           &seat,
                               const SleeperStressParameters &parameters,
                               const MPI_Comm                 comm,
                               const std::string             &picture = "");
} // namespace tread

#endif
