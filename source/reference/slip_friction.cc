// SPDX-License-Identifier: LGPL-2.1-or-later
#include "slip_friction.h"

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
  } // namespace

  TangentialSolution solve_with_friction(const Grid                &grid,
                                         const ElasticPair         &pair,
                                         const std::vector<double> &pressure,
                                         TangentialProblem          problem,
                                         const Friction            &friction,
                                         const double               speed)
  {
    if (friction.pressure_factor)
      {
        problem.friction_share.clear();
        constexpr double least = 1e-4; // the solver divides by the bound
        for (const double p : pressure)
          problem.friction_share.push_back(std::max(least, friction.pressure_factor(p)));
        return solve_tangential(grid, pair, pressure, problem);
      }
    constexpr double       tolerance  = 1e-5;
    constexpr unsigned int most_turns = 200;
    // Halved when the turns go to and fro, as they do where a law is steep.
    double followed = 1., last_change = 1.;
    problem.friction_share.assign(grid.size(), 1.);
    for (unsigned int turn = 0; turn < most_turns; ++turn)
      {
        const TangentialSolution solution = solve_tangential(grid, pair, pressure, problem);
        std::vector<double>      slip(grid.size());
        for (std::size_t e = 0; e < grid.size(); ++e)
          slip[e] = speed * std::hypot(solution.slip_x[e], solution.slip_y[e]);
        const std::vector<double> wanted =
          shares(grid, pressure, slip, *friction.slip_friction, problem.friction, speed);
        double change = 0.;
        for (std::size_t e = 0; e < grid.size(); ++e)
          change = std::max(change, std::abs(wanted[e] - problem.friction_share[e]));
        if (change <= tolerance)
          return solution;
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
    throw std::runtime_error(
      "tangential contact: friction and slip did not settle in " + std::to_string(most_turns) +
      " turns; the law falls steeply for these elements: a longer memory or larger elements help");
  }


  void check_friction(const Friction &friction, const ElasticPair &pair)
  {
    require(std::isfinite(friction.friction) && friction.friction >= 0., "friction", friction.friction,
            "a number >= 0");
    require(friction.is_coulomb() || pair.coupling == 0., "slip_friction or pressure_factor with coupling",
            pair.coupling, "that of like bodies, 0");
    require(!friction.pressure_factor || !friction.slip_friction, "pressure_factor", 1.,
            "none with slip_friction");
  }
} // namespace tread::reference
