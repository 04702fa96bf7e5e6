// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/errors.h>
#include <tread/reference/uneven_way.h>

#include "require.h"
#include "slip_friction.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tread::reference
{
  namespace
  {
    void check(const UnevenWay &way)
    {
      const PlanarCase &c = way.contact;
      check_grid(c.grid);
      const ElasticPair pair = combine(c.wheel, c.rail);
      require(pair.coupling == 0., "rolling over an uneven way of unlike bodies", pair.coupling,
              "a difference parameter K of 0");
      check_friction(c, pair);
      require_positive("friction", c.friction, "");
      if (!c.is_coulomb())
        throw std::invalid_argument("rolling over an uneven way needs Coulomb's friction");
      const double offset = c.grid.x_first / c.grid.dx;
      require(std::abs(offset - std::round(offset)) < 1e-6 && offset < 0.5 && offset + c.grid.n_x > 0.5,
              "x_first", c.grid.x_first, "a place from which elements have a centre at x = 0");
      if (way.heights.empty() || way.normal_force.size() != way.heights.size() ||
          way.longitudinal.size() != way.heights.size())
        throw std::invalid_argument("heights, normal_force and longitudinal need a number for each step");
      for (std::size_t k = 0; k < way.heights.size(); ++k)
        {
          require(std::isfinite(way.heights[k]), "heights", way.heights[k], "a number");
          require(std::isfinite(way.longitudinal[k]), "longitudinal", way.longitudinal[k], "a number");
          require_positive("normal_force", way.normal_force[k], "N");
        }
    }

    /// Element of the way under column i of the grid in step k; it may lie beyond the ends.
    class Places
    {
    public:
      explicit Places(const Grid &grid)
        : first(std::lround(grid.x_first / grid.dx))
      {
      }
      long at(const std::size_t step, const unsigned int i) const
      {
        return static_cast<long>(step) + first + i;
      }

    private:
      const long first;
    };
  } // namespace

  UnevenResult roll_over(const UnevenWay &way)
  {
    check(way);
    const PlanarCase    &c    = way.contact;
    const Grid          &grid = c.grid;
    const ElasticPair    pair = combine(c.wheel, c.rail);
    const FourierGrid    fourier(grid);
    const NormalOperator compliance(fourier, pair);
    const Places         places(grid);
    const auto           n_steps = way.heights.size();

    std::vector<double> even(grid.size());
    for (std::size_t e = 0; e < grid.size(); ++e)
      even[e] = c.gap(grid.x(e % grid.n_x), grid.y(e / grid.n_x));

    UnevenResult result;
    result.work.assign(n_steps * grid.n_y, 0.);
    NormalProblem     normal;
    TangentialProblem problem;
    problem.friction  = c.friction;
    problem.lateral   = c.lateral;
    problem.spin      = c.spin;
    problem.more_slip = c.more_slip;
    problem.step      = grid.dx;
    TangentialSolution now;
    for (std::size_t k = 0; k < n_steps; ++k)
      {
        normal.force = way.normal_force[k];
        normal.gap   = even;
        for (std::size_t e = 0; e < grid.size(); ++e)
          normal.gap[e] -= way.heights[std::clamp<long>(places.at(k, e % grid.n_x), 0, n_steps - 1)];
        const NormalSolution pressed = solve_normal(fourier, compliance, normal);
        if (pressed.cut)
          throw ReachesBorder();
        normal.initial_pressure = pressed.pressure;

        problem.longitudinal = way.longitudinal[k];
        problem.motion       = k == 0 ? Motion::steady : Motion::transient;
        // After steady rolling the particles of two steps ago had the same tractions.
        problem.order            = c.order;
        problem.before_shear_x   = k == 1 ? now.shear_x : std::move(problem.previous_shear_x);
        problem.before_shear_y   = k == 1 ? now.shear_y : std::move(problem.previous_shear_y);
        problem.previous_shear_x = problem.initial_shear_x = now.shear_x;
        problem.previous_shear_y = problem.initial_shear_y = now.shear_y;
        now = solve_tangential(grid, pair, pressed.pressure, problem);

        result.approach.push_back(pressed.approach);
        result.longitudinal_force.push_back(now.longitudinal_force);
        for (std::size_t e = 0; e < grid.size(); ++e)
          if (const long place = places.at(k, e % grid.n_x); place >= 0 && place < static_cast<long>(n_steps))
            result.work[(e / grid.n_x) * n_steps + place] +=
              std::hypot(now.shear_x[e], now.shear_y[e]) * std::hypot(now.slip_x[e], now.slip_y[e]) * grid.dx;
      }
    return result;
  }
} // namespace tread::reference
