// SPDX-License-Identifier: LGPL-2.1-or-later
#include "slip_friction.h"

#include <tread/reference/errors.h>
#include <tread/reference/surface_heat.h>

#include "require.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tread::reference
{
  namespace
  {
    /// What is left of the static coefficient at each element, for slip speeds (m/s) on the full grid.
    /// Particles enter at the leading edge, the largest x of a row.
    std::vector<double> shares(const Grid                   &grid,
                               const std::vector<double>    &pressure,
                               const std::vector<double>    &slip,
                               const Friction::SlipFriction &law,
                               const double                  friction,
                               const double                  speed)
    {
      std::vector<double> share(grid.size(), 1.);
      for (unsigned int j = 0; j < grid.n_y; ++j)
        {
          double before = 1.; // of the element ahead
          for (unsigned int i = grid.n_x; i-- > 0;)
            {
              const std::size_t e = std::size_t(j) * grid.n_x + i;
              if (!(pressure[e] > 0.))
                {
                  before = 1.;
                  continue;
                }
              const double in_the_long_run = law.coefficient(slip[e]) / friction;
              const double left =
                law.memory_distance > 0.
                  ? std::exp(-std::max(slip[e], law.memory_speed) / law.memory_distance * grid.dx / speed)
                  : 0.;
              share[e] = before = in_the_long_run + left * (before - in_the_long_run);
            }
        }
      return share;
    }

    /// What is left of the coefficient at each element by the temperature of the surface that passes it, for
    /// shear stresses (Pa) and slip speeds (m/s) on the full grid. It enters cold at the leading edge.
    std::vector<double> shares(const Grid                   &grid,
                               const std::vector<double>    &shear,
                               const std::vector<double>    &slip,
                               const Friction::HeatFriction &law,
                               const double                  speed)
    {
      const SurfaceHeat   heat(grid.dx / speed);
      std::vector<double> share(grid.size());
      for (unsigned int j = 0; j < grid.n_y; ++j)
        {
          SurfaceHeat::Memory memory{};
          double              before = 0.; // rise where it enters an element
          for (unsigned int i = grid.n_x; i-- > 0;)
            {
              const std::size_t e = std::size_t(j) * grid.n_x + i;
              const double rise   = heat.flow(memory, law.heat_share * shear[e] * slip[e]) / law.effusivity;
              share[e]            = law.factor(0.5 * (before + rise));
              before              = rise;
            }
        }
      return share;
    }

    /// How much the slip of an element changes friction, over the change of friction that this slip follows
    /// from: far above 1 a patch of such elements sticks and slips in turns and has no steady state. Slip of
    /// an element grows by about its shear stress over the shear modulus.
    double steepness(const Grid                   &grid,
                     const double                  shear_modulus,
                     const double                  max_pressure,
                     const Friction::SlipFriction &law,
                     const double                  speed)
    {
      constexpr double slowest = 1e-9, fastest = 100., ratio = 1.1; // m/s
      double           largest = 0., before = law.coefficient(slowest);
      for (double slip = slowest; slip < fastest; slip *= ratio)
        {
          const double next  = law.coefficient(slip * ratio);
          const double slope = (before - next) / (slip * (ratio - 1.));
          // A memory lets friction follow by so much over one element.
          const double follows =
            law.memory_distance > 0.
              ? 1. - std::exp(-std::max(slip, law.memory_speed) / law.memory_distance * grid.dx / speed)
              : 1.;
          largest = std::max(largest, slope * follows);
          before  = next;
        }
      return largest * max_pressure * speed / shear_modulus;
    }
  } // namespace

  TangentialSolution solve_with_friction(const Grid                &grid,
                                         const ElasticPair         &pair,
                                         const std::vector<double> &pressure,
                                         TangentialProblem          problem,
                                         const Friction            &friction,
                                         const double               speed)
  {
    // By place and pressure, which are known.
    constexpr double    least_share = 1e-4; // the solver divides by the bound
    std::vector<double> known(grid.size(), 1.);
    if (!friction.slip_friction)
      for (std::size_t e = 0; e < known.size(); ++e)
        known[e] = std::max(
          least_share, friction.friction_factor(grid.x(e % grid.n_x), grid.y(e / grid.n_x), pressure[e]));
    problem.friction_share = known;
    if (!friction.slip_friction && !friction.heat_friction)
      return solve_tangential(grid, pair, pressure, problem);
    constexpr double       tolerance  = 1e-5;
    constexpr unsigned int most_turns = 200;
    // From 1 on the turns need small steps, and they lead nowhere from 3 on
    // (tests/reference/slip_friction.cc).
    constexpr double too_steep = 30.;
    if (friction.slip_friction)
      if (const double found =
            steepness(grid, pair.shear, *std::max_element(pressure.begin(), pressure.end()),
                      *friction.slip_friction, speed);
          found > too_steep)
        throw FrictionTooSteep("it falls " + std::to_string(std::lround(found)) +
                               " times as steeply as the bodies can follow");
    // What does not come nearer by a half in so many turns needs more of them than there are.
    constexpr unsigned int patience = 30;
    constexpr double       nearer   = 0.5;
    double                 least    = 1.;
    unsigned int           at_least = 0;
    // Halved when the turns go to and fro, as they do where a law is steep.
    double followed = 1., last_change = 1.;
    for (unsigned int turn = 0; turn < most_turns; ++turn)
      {
        const TangentialSolution solution = solve_tangential(grid, pair, pressure, problem);
        std::vector<double>      slip(grid.size()), shear(grid.size());
        for (std::size_t e = 0; e < grid.size(); ++e)
          {
            slip[e]  = speed * std::hypot(solution.slip_x[e], solution.slip_y[e]);
            shear[e] = std::hypot(solution.shear_x[e], solution.shear_y[e]);
          }
        std::vector<double> wanted =
          friction.slip_friction
            ? shares(grid, pressure, slip, *friction.slip_friction, problem.friction, speed)
            : shares(grid, shear, slip, *friction.heat_friction, speed);
        double change = 0.;
        for (std::size_t e = 0; e < grid.size(); ++e)
          {
            wanted[e] = std::max(least_share, known[e] * wanted[e]);
            change    = std::max(change, std::abs(wanted[e] - problem.friction_share[e]));
          }
        if (change <= tolerance)
          return solution;
        if (change < nearer * least)
          {
            least    = change;
            at_least = turn;
          }
        if (turn - at_least > patience)
          break;
        if (change > 0.8 * last_change)
          followed = std::max(0.5 * followed, 0.05);
        last_change = change;
        for (std::size_t e = 0; e < grid.size(); ++e)
          problem.friction_share[e] += followed * (wanted[e] - problem.friction_share[e]);
        problem.initial_shear_x = solution.shear_x;
        problem.initial_shear_y = solution.shear_y;
        if (problem.prescribe_longitudinal_force)
          problem.longitudinal = solution.longitudinal;
        if (problem.prescribe_lateral_force)
          problem.lateral = solution.lateral;
      }
    if (friction.slip_friction)
      throw FrictionTooSteep("friction and slip do not settle");
    throw std::runtime_error(
      "friction and temperature do not settle: the coefficient changes by too much over "
      "too few degrees");
  }


  void check_friction(const Friction &friction, const ElasticPair &pair)
  {
    require(std::isfinite(friction.friction) && friction.friction >= 0., "friction", friction.friction,
            "a number >= 0");
    require(friction.is_coulomb() || pair.coupling == 0.,
            "slip_friction, pressure_factor, place_factor or heat_friction with coupling", pair.coupling,
            "that of like bodies, 0");
    require(!friction.slip_friction ||
              (!friction.pressure_factor && !friction.place_factor && !friction.heat_friction),
            "pressure_factor, place_factor or heat_friction", 1., "none with slip_friction");
    if (const auto &heat = friction.heat_friction)
      {
        require(heat->heat_share >= 0. && heat->heat_share <= 1., "heat_share", heat->heat_share,
                "from 0 to 1");
        require_positive("effusivity", heat->effusivity, "J/(m^2 K sqrt(s))");
      }
  }
} // namespace tread::reference
