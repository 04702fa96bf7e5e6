// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/half_space.h>

#include "edges.h"
#include "newton.h"
#include "require.h"

#include <algorithm>
#include <cmath>

namespace tread::reference
{
  namespace
  {
    using Vector = std::vector<double>;

    // Up to this number of elements in a row no coarser grid is asked for a first guess: Newton's method
    // moves a wrong border of adhesion and slip by about one element per step.
    constexpr unsigned int coarsest = 14;

    double step_of(const Grid &grid, const TangentialProblem &problem)
    {
      return problem.motion == Motion::shift ? 1. : problem.step > 0. ? problem.step : grid.dx;
    }

    double friction_at(const TangentialProblem &problem, const std::size_t e)
    {
      return problem.friction * (problem.friction_share.empty() ? 1. : problem.friction_share[e]);
    }

    void check(const Grid &grid, const Vector &pressure, const TangentialProblem &problem)
    {
      check_grid(grid);
      const auto sized = [&](const std::string &name, const Vector &field, const bool may_be_empty) {
        require(field.size() == grid.size() || (may_be_empty && field.empty()), "size of " + name,
                static_cast<double>(field.size()), "the number of grid elements");
      };
      sized("pressure", pressure, false);
      sized("previous_shear_x", problem.previous_shear_x, true);
      sized("previous_shear_y", problem.previous_shear_y, true);
      sized("before_shear_x", problem.before_shear_x, true);
      sized("before_shear_y", problem.before_shear_y, true);
      sized("previous_pressure", problem.previous_pressure, true);
      sized("friction_share", problem.friction_share, true);
      sized("initial_shear_x", problem.initial_shear_x, true);
      sized("initial_shear_y", problem.initial_shear_y, true);
      require(problem.order == 1 || (problem.order == 2 && problem.motion != Motion::shift), "order",
              problem.order, "1, or 2 if rolling");
      require(problem.leading_edge.empty() || problem.leading_edge.size() == grid.n_y, "size of leading_edge",
              static_cast<double>(problem.leading_edge.size()), "the number of rows");
      require_positive("friction", problem.friction, "");
      require(problem.step >= 0. && std::isfinite(problem.step), "step", problem.step, ">= 0 m");
      require_finite("longitudinal creepage", problem.longitudinal);
      require_finite("lateral creepage", problem.lateral);
      require_finite("spin", problem.spin);
      require_positive("tolerance", problem.tolerance, "");

      double force = 0.;
      for (const double p : pressure)
        force += std::max(p, 0.) * grid.element_area();
      require(force > 0., "sum of the pressure", force, "positive: no contact otherwise");
      const double f_x   = problem.prescribe_longitudinal_force ? problem.longitudinal_force : 0.;
      const double f_y   = problem.prescribe_lateral_force ? problem.lateral_force : 0.;
      const double bound = problem.friction * force;
      require(std::hypot(f_x, f_y) < bound, "prescribed tangential force [N]", std::hypot(f_x, f_y),
              "less than friction times normal force, " + std::to_string(bound));
    }

    std::vector<unsigned int> elements_in_contact(const Vector &pressure)
    {
      std::vector<unsigned int> contact;
      for (std::size_t e = 0; e < pressure.size(); ++e)
        if (pressure[e] > 0.)
          contact.push_back(static_cast<unsigned int>(e));
      return contact;
    }

    /// Tangential displacements at the patch's elements (two blocks) by tractions and pressure anywhere on
    /// the grid.
    Vector displacement(const Grid                               &grid,
                        const ElasticPair                        &pair,
                        const Patch                              &patch,
                        const Vector                             &shear_x,
                        const Vector                             &shear_y,
                        const Vector                             &pressure,
                        const std::vector<std::array<double, 2>> &stencil)
    {
      const auto is_loaded = [&](const std::size_t e) {
        return (!shear_x.empty() && shear_x[e] != 0.) || (!shear_y.empty() && shear_y[e] != 0.) ||
               (pair.coupling != 0. && !pressure.empty() && pressure[e] > 0.);
      };
      std::vector<unsigned int> all;
      std::vector<std::size_t>  position(patch.size());
      std::size_t               next = 0;
      for (unsigned int e = 0; e < grid.size(); ++e)
        {
          const bool here = next < patch.size() && patch.outer[next] == e;
          if (here)
            position[next++] = all.size();
          if (here || is_loaded(e))
            all.push_back(e);
        }
      const Patch       both(grid, all);
      const std::size_t m = all.size(), n = patch.size();
      FourierGrid       fourier(both.grid);
      fourier.select(both.inner);

      Vector     load(2 * m), u(2 * m, 0.), result(2 * n, 0.);
      const auto add = [&] {
        for (std::size_t k = 0; k < n; ++k)
          {
            result[k] += u[position[k]];
            result[n + k] += u[m + position[k]];
          }
      };
      if (!shear_x.empty() || !shear_y.empty())
        {
          for (std::size_t k = 0; k < m; ++k)
            {
              load[k]     = shear_x.empty() ? 0. : shear_x[all[k]];
              load[m + k] = shear_y.empty() ? 0. : shear_y[all[k]];
            }
          TangentialOperator(fourier, pair, stencil).apply(load.data(), u.data());
          add();
        }
      if (pair.coupling != 0. && !pressure.empty())
        {
          for (std::size_t k = 0; k < m; ++k)
            load[k] = pressure[all[k]];
          CouplingOperator(fourier, pair, stencil).tangential_by_pressure(load.data(), u.data());
          add();
        }
      return result;
    }

    using Stencil = std::vector<std::array<double, 2>>;

    /// Slip from displacements: weights and places ahead.
    Stencil slip_stencil(const unsigned int order, const double step)
    {
      if (order == 2)
        return {{1.5 / step, 0.}, {-2. / step, step}, {0.5 / step, 2. * step}};
      return {{1. / step, 0.}, {-1. / step, step}};
    }

    /// Slip of an element in a long strip across x by the strip's own unit traction, in x and in y.
    std::array<double, 2> strip_compliance(const Grid &grid, const ElasticPair &pair)
    {
      std::array<double, 2> sum{};
      for (const auto &[weight, offset] : slip_stencil(2, grid.dx))
        {
          sum[0] += weight * influence_coefficient(Influence::xx, pair, grid.dx, 1e3 * grid.dx, offset, 0.);
          sum[1] += weight * influence_coefficient(Influence::yy, pair, grid.dx, 1e3 * grid.dx, offset, 0.);
        }
      return sum;
    }

    /// @param bound pressure that limits the traction; @param softness of border elements, empty: none
    FrictionEquations make_equations(const Grid              &grid,
                                     const ElasticPair       &pair,
                                     const Patch             &patch,
                                     const Vector            &pressure,
                                     const Vector            &bound,
                                     const Vector            &softness,
                                     const TangentialProblem &problem)
    {
      const std::size_t n    = patch.size();
      const double      step = step_of(grid, problem);
      FrictionEquations equations;
      equations.patch       = &patch;
      equations.pair        = pair;
      const Stencil stencil = slip_stencil(problem.order, step);
      equations.stencil     = stencil;
      if (problem.motion != Motion::steady)
        equations.stencil.resize(1);
      equations.prescribed[0] = problem.prescribe_longitudinal_force;
      equations.prescribed[1] = problem.prescribe_lateral_force;
      equations.force[0]      = problem.longitudinal_force;
      equations.force[1]      = problem.lateral_force;

      equations.bound.resize(n);
      equations.fixed.resize(2 * n);
      for (std::size_t k = 0; k < n; ++k)
        {
          const unsigned int e   = patch.outer[k];
          equations.bound[k]     = friction_at(problem, e) * bound[e];
          const auto uneven      = problem.uneven_slip(grid.x(e % grid.n_x), grid.y(e / grid.n_x));
          equations.fixed[k]     = (equations.prescribed[0] ? 0. : problem.longitudinal) + uneven[0];
          equations.fixed[n + k] = (equations.prescribed[1] ? 0. : problem.lateral) + uneven[1];
        }
      const auto add = [&](const Vector &u) {
        for (std::size_t k = 0; k < 2 * n; ++k)
          equations.fixed[k] += u[k];
      };
      if (!softness.empty())
        {
          const std::array<double, 2> own = strip_compliance(grid, pair);
          equations.compliance.resize(2 * n);
          for (std::size_t k = 0; k < 2 * n; ++k)
            equations.compliance[k] = own[k / n] * softness[patch.outer[k % n]];
        }
      if (pair.coupling != 0.)
        add(displacement(grid, pair, patch, {}, {}, pressure, equations.stencil));
      if (problem.motion != Motion::steady)
        {
          const bool    rolls = problem.motion == Motion::transient;
          const Vector &previous =
            problem.previous_pressure.empty() && rolls ? pressure : problem.previous_pressure;
          if (!problem.previous_shear_x.empty() || !problem.previous_shear_y.empty() ||
              (pair.coupling != 0. && !previous.empty()))
            add(displacement(grid, pair, patch, problem.previous_shear_x, problem.previous_shear_y, previous,
                             {{stencil[1][0], rolls ? step : 0.}}));
          if (problem.order == 2)
            add(displacement(grid, pair, patch, problem.before_shear_x, problem.before_shear_y, previous,
                             {stencil[2]}));
        }
      return equations;
    }

    /// The same problem with elements twice as large.
    struct CoarseProblem
    {
      Grid              grid;
      Vector            pressure;
      TangentialProblem problem;
      unsigned int      factor_y;

      unsigned int parent(const Grid &fine, const unsigned int e) const
      {
        return e / fine.n_x / factor_y * grid.n_x + e % fine.n_x / 2;
      }
    };

    CoarseProblem coarsen(const Grid &fine, const Vector &pressure, const TangentialProblem &problem)
    {
      CoarseProblem coarse;
      coarse.factor_y    = fine.n_y > 1 ? 2 : 1;
      coarse.grid        = Grid{(fine.n_x + 1) / 2,
                         (fine.n_y + coarse.factor_y - 1) / coarse.factor_y,
                         2. * fine.dx,
                         coarse.factor_y * fine.dy,
                         fine.x_first + 0.5 * fine.dx,
                         fine.y_first + 0.5 * (coarse.factor_y - 1) * fine.dy};
      const auto average = [&](const Vector &field) {
        Vector result(field.empty() ? 0 : coarse.grid.size(), 0.);
        for (unsigned int e = 0; e < field.size(); ++e)
          result[coarse.parent(fine, e)] += field[e] / (2. * coarse.factor_y);
        return result;
      };
      coarse.pressure                  = average(pressure);
      coarse.problem                   = problem;
      coarse.problem.previous_shear_x  = average(problem.previous_shear_x);
      coarse.problem.previous_shear_y  = average(problem.previous_shear_y);
      coarse.problem.before_shear_x    = average(problem.before_shear_x);
      coarse.problem.before_shear_y    = average(problem.before_shear_y);
      coarse.problem.previous_pressure = average(problem.previous_pressure);
      if (!problem.friction_share.empty())
        {
          // The mean friction bound of the elements, over the mean pressure.
          Vector bound(pressure);
          for (std::size_t e = 0; e < bound.size(); ++e)
            bound[e] *= problem.friction_share[e];
          coarse.problem.friction_share = average(bound);
          for (std::size_t e = 0; e < coarse.pressure.size(); ++e)
            coarse.problem.friction_share[e] =
              coarse.pressure[e] > 0. ? coarse.problem.friction_share[e] / coarse.pressure[e] : 1.;
        }
      coarse.problem.leading_edge.clear();
      // Rolling steps of an element are kept one element long; a transient step must remain the step asked
      // for.
      if (problem.motion == Motion::steady)
        coarse.problem.step = 2. * problem.step;
      else if (problem.motion == Motion::transient)
        coarse.problem.step = step_of(fine, problem);
      return coarse;
    }

    /// Tractions from the coarse grid: the share of the friction bound that is used, interpolated bilinearly.
    Vector prolongate(const Grid          &fine,
                      const Patch         &patch,
                      const Vector        &bound,
                      const CoarseProblem &coarse,
                      const Vector        &shear_x,
                      const Vector        &shear_y)
    {
      const std::size_t n = patch.size();
      Vector            result(2 * n, 0.);
      const int         c_x = static_cast<int>(coarse.grid.n_x), c_y = static_cast<int>(coarse.grid.n_y);
      for (std::size_t k = 0; k < n; ++k)
        {
          const unsigned int i = patch.outer[k] % fine.n_x, j = patch.outer[k] / fine.n_x;
          const int          i0 = static_cast<int>(i / 2), i1 = i0 + (i % 2 == 0 ? -1 : 1);
          const int          j0 = static_cast<int>(j / coarse.factor_y),
                    j1          = coarse.factor_y == 1 ? j0 : j0 + (j % 2 == 0 ? -1 : 1);
          double sum = 0., x = 0., y = 0.;
          for (const auto &[ii, jj, w] :
               {std::tuple<int, int, double>{i0, j0, 9.}, {i1, j0, 3.}, {i0, j1, 3.}, {i1, j1, 1.}})
            if (ii >= 0 && ii < c_x && jj >= 0 && jj < c_y)
              {
                const std::size_t e = static_cast<std::size_t>(jj) * c_x + ii;
                if (coarse.pressure[e] > 0.)
                  {
                    const double share = w / (friction_at(coarse.problem, e) * coarse.pressure[e]);
                    sum += w;
                    x += share * shear_x[e];
                    y += share * shear_y[e];
                  }
              }
          if (sum > 0.)
            {
              result[k]     = bound[k] * x / sum;
              result[n + k] = bound[k] * y / sum;
            }
        }
      return result;
    }

    struct Level
    {
      FrictionNewton::State state;
      Vector                shear_x, shear_y; // full grid
    };

    void scatter(const Grid &grid, const Patch &patch, Level &level)
    {
      level.shear_x.assign(grid.size(), 0.);
      level.shear_y.assign(grid.size(), 0.);
      for (std::size_t k = 0; k < patch.size(); ++k)
        {
          level.shear_x[patch.outer[k]] = level.state.shear[k];
          level.shear_y[patch.outer[k]] = level.state.shear[patch.size() + k];
        }
    }

    /// Roll over twice the patch's length in transient steps: each is a convex problem if no force is
    /// prescribed, and the end is close to steady rolling.
    unsigned int march(const Grid        &grid,
                       const ElasticPair &pair,
                       const Patch       &patch,
                       const Vector      &pressure,
                       const Vector      &bound,
                       TangentialProblem  problem,
                       Level             &level)
    {
      problem.motion             = Motion::transient;
      problem.order              = 1;
      problem.step               = step_of(grid, problem);
      const unsigned int n_steps = 2 * patch.grid.n_x;
      for (unsigned int s = 0; s < n_steps; ++s)
        {
          scatter(grid, patch, level);
          problem.previous_shear_x          = level.shear_x;
          problem.previous_shear_y          = level.shear_y;
          const FrictionEquations equations = make_equations(grid, pair, patch, pressure, bound, {}, problem);
          FrictionNewton          newton(equations);
          newton.iterate(level.state, 1e-3, 15);
        }
      return n_steps;
    }

    Level solve_level(const Grid              &grid,
                      const ElasticPair       &pair,
                      const Vector            &pressure,
                      const TangentialProblem &problem,
                      const double             tolerance,
                      TangentialSolution      &solution,
                      const bool               finest,
                      const bool               started)
    {
      // Within elements only the answer's own grid knows of edges; a first guess needs none.
      LeadingEdge edge{pressure, {}};
      if (finest && problem.order == 2)
        edge = leading_edge(grid, pressure,
                            problem.leading_edge.empty() ? pressure_edges(grid, pressure).lead
                                                         : problem.leading_edge);
      const std::vector<unsigned int> contact = elements_in_contact(edge.bound);
      const Patch                     patch(grid, contact);
      const std::size_t               n = patch.size();
      const FrictionEquations         equations =
        make_equations(grid, pair, patch, pressure, edge.bound, edge.compliance, problem);

      Level level;
      level.state.shear.assign(2 * n, 0.);
      // Without tractions to start from, the creepages of prescribed forces start at zero: the first, linear
      // step finds better ones than most guesses, while one beyond full slip leads nowhere.
      if (started)
        {
          level.state.creepage[0] = problem.longitudinal;
          level.state.creepage[1] = problem.lateral;
          for (std::size_t k = 0; k < n; ++k)
            {
              level.state.shear[k] =
                problem.initial_shear_x.empty() ? 0. : problem.initial_shear_x[contact[k]];
              level.state.shear[n + k] =
                problem.initial_shear_y.empty() ? 0. : problem.initial_shear_y[contact[k]];
            }
        }
      else if (patch.grid.n_x > coarsest)
        {
          // the coarse grid's own violation of the fine equations is some per cent: no need to solve it well
          const CoarseProblem coarse = coarsen(grid, pressure, problem);
          const Level         guess  = solve_level(coarse.grid, pair, coarse.pressure, coarse.problem,
                                                   std::max(tolerance, 1e-3), solution, false, false);
          level.state.shear = prolongate(grid, patch, equations.bound, coarse, guess.shear_x, guess.shear_y);
          std::copy_n(guess.state.creepage, 2, level.state.creepage);
        }

      FrictionNewton newton(equations);
      bool           converged = newton.iterate(level.state, tolerance, problem.max_iterations);
      if (!converged && started)
        return solve_level(grid, pair, pressure, problem, tolerance, solution, finest, false);
      if (!converged && problem.motion == Motion::steady)
        {
          solution.fallback_steps += march(grid, pair, patch, pressure, edge.bound, problem, level);
          converged = newton.iterate(level.state, tolerance, problem.max_iterations);
        }
      scatter(grid, patch, level);
      if (!finest)
        return level;

      if (!converged)
        throw std::runtime_error("tangential contact: Newton's method reached a violation of " +
                                 std::to_string(newton.violation) + " f p_max, the tolerance is " +
                                 std::to_string(tolerance));
      solution.iterations        = newton.iterations;
      solution.linear_iterations = newton.linear_iterations;
      solution.residual          = newton.violation;
      solution.longitudinal      = equations.prescribed[0] ? level.state.creepage[0] : problem.longitudinal;
      solution.lateral           = equations.prescribed[1] ? level.state.creepage[1] : problem.lateral;
      solution.spin              = problem.spin;
      for (Vector *field :
           {&solution.slip_x, &solution.slip_y, &solution.displacement_x, &solution.displacement_y})
        field->assign(grid.size(), 0.);
      solution.state.assign(grid.size(), ElementState::exterior);
      const Vector slip = newton.slip();
      const Vector u    = displacement(grid, pair, patch, level.shear_x, level.shear_y, pressure, {{1., 0.}});
      for (std::size_t k = 0; k < n; ++k)
        {
          const unsigned int e       = contact[k];
          solution.displacement_x[e] = u[k];
          solution.displacement_y[e] = u[n + k];
          solution.state[e]          = newton.slips(k) ? ElementState::slip : ElementState::adhesion;
          if (newton.slips(k))
            {
              solution.slip_x[e] = slip[k];
              solution.slip_y[e] = slip[n + k];
            }
          const double area = grid.element_area();
          solution.longitudinal_force += level.shear_x[e] * area;
          solution.lateral_force += level.shear_y[e] * area;
          solution.spin_moment +=
            (grid.x(e % grid.n_x) * level.shear_y[e] - grid.y(e / grid.n_x) * level.shear_x[e]) * area;
        }
      return level;
    }
  } // namespace

  TangentialSolution solve_tangential(const Grid              &grid,
                                      const ElasticPair       &pair,
                                      const Vector            &pressure,
                                      const TangentialProblem &problem)
  {
    check(grid, pressure, problem);
    TangentialSolution solution;
    const bool         started = !problem.initial_shear_x.empty() || !problem.initial_shear_y.empty();
    Level level      = solve_level(grid, pair, pressure, problem, problem.tolerance, solution, true, started);
    solution.shear_x = std::move(level.shear_x);
    solution.shear_y = std::move(level.shear_y);
    return solution;
  }

  ContactSolution solve_contact(const Grid              &grid,
                                const ElasticPair       &pair,
                                const NormalProblem     &normal,
                                const TangentialProblem &tangential)
  {
    FourierGrid     fourier(grid);
    NormalOperator  op(fourier, pair);
    ContactSolution solution;
    solution.normal     = solve_normal(fourier, op, normal);
    solution.tangential = solve_tangential(grid, pair, solution.normal.pressure, tangential);
    if (pair.coupling == 0.)
      return solution;

    const CouplingOperator coupling(fourier, pair, {{1., 0.}});
    NormalProblem          changed_normal     = normal;
    TangentialProblem      changed_tangential = tangential;
    Vector                 traction(2 * grid.size()), lift(grid.size());
    for (solution.outer_iterations = 1; solution.outer_iterations < 50;)
      {
        ++solution.outer_iterations;
        std::copy(solution.tangential.shear_x.begin(), solution.tangential.shear_x.end(), traction.begin());
        std::copy(solution.tangential.shear_y.begin(), solution.tangential.shear_y.end(),
                  traction.begin() + grid.size());
        coupling.normal_by_traction(traction.data(), lift.data());
        for (std::size_t e = 0; e < grid.size(); ++e)
          changed_normal.gap[e] = normal.gap[e] + lift[e];
        changed_normal.initial_pressure = solution.normal.pressure;
        const Vector old                = solution.normal.pressure;
        solution.normal                 = solve_normal(fourier, op, changed_normal);
        // Edges that stay where they are from then on: an element that comes and goes would keep the turns
        // from settling.
        if (tangential.order == 2 && tangential.leading_edge.empty() && solution.outer_iterations <= 4)
          changed_tangential.leading_edge = pressure_edges(grid, solution.normal.pressure).lead;

        changed_tangential.initial_shear_x = solution.tangential.shear_x;
        changed_tangential.initial_shear_y = solution.tangential.shear_y;
        changed_tangential.longitudinal    = solution.tangential.longitudinal;
        changed_tangential.lateral         = solution.tangential.lateral;
        solution.tangential = solve_tangential(grid, pair, solution.normal.pressure, changed_tangential);
        double change = 0., p_max = 0.;
        for (std::size_t e = 0; e < grid.size(); ++e)
          {
            change = std::max(change, std::abs(solution.normal.pressure[e] - old[e]));
            p_max  = std::max(p_max, solution.normal.pressure[e]);
          }
        if (change <= 1e-7 * p_max)
          return solution;
      }
    throw std::runtime_error(
      "contact of unlike bodies: normal and tangential problem did not settle in 50 turns");
  }
} // namespace tread::reference
