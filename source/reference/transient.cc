// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/half_space.h>
#include <tread/reference/transient.h>

#include "require.h"
#include "rolling_solve.h"

#include <algorithm>
#include <cmath>

namespace tread::reference
{
  namespace
  {
    void check(const TransientCase &transient)
    {
      const RollingCase &c = transient.rolling;
      require(combine(c.wheel, c.rail).coupling == 0., "transient rolling of unlike bodies",
              combine(c.wheel, c.rail).coupling, "a difference parameter K of 0");
      require_positive("friction", c.friction, "");
      require_positive("distance", transient.distance, "m");
      require(transient.step >= 0. && std::isfinite(transient.step), "step", transient.step, ">= 0 m");
      require(transient.order == 1 || transient.order == 2, "order", transient.order, "1 or 2");
      require(std::abs(transient.start_traction_coefficient) < c.friction, "start_traction_coefficient",
              transient.start_traction_coefficient, "less in magnitude than the friction coefficient");
    }

    void record(TransientResult          &result,
                const double              distance,
                const TangentialSolution &s,
                const double              load)
    {
      result.distance.push_back(distance);
      result.traction_coefficient.push_back(s.longitudinal_force / load);
      result.lateral_coefficient.push_back(s.lateral_force / load);
      result.creepage.push_back(s.longitudinal);
    }
  } // namespace

  TransientResult solve_transient(const TransientCase &transient)
  {
    check(transient);
    const RollingCase &c    = transient.rolling;
    const ElasticPair  pair = combine(c.wheel, c.rail);

    // Grid and pressure are those of steady rolling without tractions.
    RollingCase pressed          = c;
    pressed.friction             = 0.;
    pressed.prescribe_force      = true;
    pressed.traction_coefficient = 0.;
    // The elements that the normal problem finds in contact are the right ones for a shift, where tractions
    // are large at all edges: with all that Hertz's ellipse touches its stiffness would be 3 % too high.
    Edges               edges;
    const RollingResult normal = solve_rolling(pressed, 1, edges);
    const Grid          grid   = normal.grid;

    if (!c.gap)
      edges = ellipse_edges(grid, normal.hertz.semi_axis_x, normal.hertz.semi_axis_y);

    TransientResult result;
    result.n_x      = grid.n_x;
    result.n_y      = grid.n_y;
    result.x        = normal.x;
    result.y        = normal.y;
    result.pressure = normal.pressure;

    TangentialProblem problem;
    problem.friction = c.friction;
    TangentialSolution now;
    now.shear_x.assign(grid.size(), 0.);
    now.shear_y.assign(grid.size(), 0.);
    const auto shift_to = [&](const double traction_coefficient) {
      if (traction_coefficient * c.normal_force == now.longitudinal_force)
        return;
      TangentialProblem shift            = problem;
      shift.motion                       = Motion::shift;
      shift.previous_shear_x             = now.shear_x;
      shift.previous_shear_y             = now.shear_y;
      shift.prescribe_longitudinal_force = true;
      shift.longitudinal_force           = traction_coefficient * c.normal_force;
      now                                = solve_tangential(grid, pair, normal.pressure, shift);
      result.start_shift += now.longitudinal;
      now.longitudinal_force = shift.longitudinal_force;
    };
    shift_to(transient.start_traction_coefficient);
    // A given force acts from the first moment on: where it is not that of the start, the wheel shifts.
    if (c.prescribe_force)
      shift_to(c.traction_coefficient);
    now.longitudinal = c.prescribe_force ? 0. : c.creepage;
    record(result, 0., now, c.normal_force);

    const double wanted  = transient.step > 0. ? transient.step : c.element_size;
    const auto   n_steps = static_cast<unsigned int>(std::ceil(transient.distance / wanted - 1e-9));
    problem.motion       = Motion::transient;
    problem.step         = transient.distance / n_steps;
    problem.lateral      = c.lateral_creepage;
    problem.spin         = c.spin;
    problem.prescribe_longitudinal_force = c.prescribe_force;
    problem.longitudinal_force           = c.traction_coefficient * c.normal_force;
    problem.leading_edge                 = edges.lead;
    if (c.radius_change)
      problem.more_slip = [&c](const double x, const double y) -> std::array<double, 2> {
        const double h = 0.5 * c.element_size;
        return {-c.radius_change(y), x * (c.radius_change(y + h) - c.radius_change(y - h)) / (2. * h)};
      };

    std::size_t next_field = 0;
    for (unsigned int step = 1; step <= n_steps; ++step)
      {
        // The first step knows one state before it only. What it is wrong by is of second order, as it is one
        // step.
        problem.order            = step == 1 ? 1 : transient.order;
        problem.before_shear_x   = std::move(problem.previous_shear_x);
        problem.before_shear_y   = std::move(problem.previous_shear_y);
        problem.previous_shear_x = now.shear_x;
        problem.previous_shear_y = now.shear_y;
        problem.initial_shear_x  = now.shear_x;
        problem.initial_shear_y  = now.shear_y;
        problem.longitudinal     = now.longitudinal;
        now                      = solve_tangential(grid, pair, normal.pressure, problem);
        const double distance    = step * problem.step;
        record(result, distance, now, c.normal_force);
        if (next_field < transient.fields_at.size() &&
            distance >= transient.fields_at[next_field] - 1e-9 * problem.step)
          {
            result.fields.push_back({distance, now.shear_x, now.shear_y, now.slip_x, now.slip_y, now.state});
            ++next_field;
          }
      }
    return result;
  }
} // namespace tread::reference
