// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/half_space.h>

#include "require.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tread::reference
{
  namespace
  {
    void check(const Grid &grid, const NormalProblem &problem)
    {
      require(problem.gap.size() == grid.size(), "size of gap", static_cast<double>(problem.gap.size()),
              "the number of grid elements");
      for (const double h : problem.gap)
        require_finite("gap", h);
      require(problem.initial_pressure.empty() || problem.initial_pressure.size() == grid.size(),
              "size of initial_pressure", static_cast<double>(problem.initial_pressure.size()),
              "0 or the number of grid elements");
      require_positive("tolerance", problem.tolerance, "");
      if (problem.prescribe_force)
        require_positive("normal force", problem.force, "N (no contact otherwise)");
      else
        {
          const double smallest = *std::min_element(problem.gap.begin(), problem.gap.end());
          require(problem.approach > smallest, "approach", problem.approach,
                  "more than the smallest gap: no contact otherwise");
        }
    }

    void touches_border(const Grid &grid, NormalSolution &solution)
    {
      for (const unsigned int e : solution.contact)
        {
          const unsigned int i = e % grid.n_x, j = e / grid.n_x;
          if ((grid.n_x > 1 && (i == 0 || i == grid.n_x - 1)) ||
              (grid.n_y > 1 && (j == 0 || j == grid.n_y - 1)))
            solution.cut = true;
        }
    }

    /// Pressure to start from: the given one, or else the same everywhere in what is likely to touch, scaled
    /// to the given force or approach.
    std::vector<double> starting_pressure(const Grid           &grid,
                                          const NormalOperator &op,
                                          const NormalProblem  &problem)
    {
      const auto         &h = problem.gap;
      std::vector<double> p = problem.initial_pressure;
      if (p.empty())
        // Without a guess: everything, or everything that interpenetrates, carries load.
        {
          p.assign(grid.size(), 0.);
          const double h_min = *std::min_element(h.begin(), h.end());
          const double range = *std::max_element(h.begin(), h.end()) - h_min;
          const double depth = problem.prescribe_force ? 0.5 * range : problem.approach - h_min;
          for (std::size_t e = 0; e < grid.size(); ++e)
            p[e] = (h[e] - h_min <= depth) ? 1. : 0.;
        }
      double sum = 0.;
      for (double &v : p)
        sum += (v = std::max(v, 0.));
      if (problem.prescribe_force)
        {
          require(sum > 0., "sum of initial_pressure", sum, "positive");
          for (double &v : p)
            v *= problem.force / (sum * grid.element_area());
        }
      else if (problem.initial_pressure.empty())
        {
          // scale so that the mean displacement is that wanted
          std::vector<double> displacement(grid.size());
          op.apply(p.data(), displacement.data());
          double work = 0., wanted = 0.;
          for (std::size_t e = 0; e < grid.size(); ++e)
            work += p[e] * displacement[e], wanted += p[e] * (problem.approach - h[e]);
          for (double &v : p)
            v *= std::max(wanted / work, 1e-12);
        }
      return p;
    }

    /// The iteration of Polonsky & Keer (1999), with their letters for the fields.
    struct ConjugateGradients
    {
      const NormalOperator &op;
      const NormalProblem  &problem;
      const double          area; ///< of an element [m^2]
      std::vector<double>   p;    ///< pressure
      std::vector<double>   g;    ///< deformed gap, wanted to be 0 where there is pressure
      std::vector<double>   t;    ///< direction in which the pressure is changed
      std::vector<double>   r;    ///< displacement by t
      double                approach;
      std::size_t           n_contact   = 0;     ///< elements with pressure
      double                norm        = 0.;    ///< sum of g^2 in contact
      double                norm_before = 0.;    ///< the same one iteration earlier
      bool                  conjugate   = false; ///< to the last direction: no element has come into contact

      ConjugateGradients(const Grid &grid, const NormalOperator &op, const NormalProblem &problem)
        : op(op)
        , problem(problem)
        , area(grid.element_area())
        , p(starting_pressure(grid, op, problem))
        , g(grid.size())
        , t(grid.size(), 0.)
        , r(grid.size())
        , approach(problem.approach)
      {
      }

      /// The gap under the present pressure; the approach, unless it is given, makes its mean in contact 0.
      /// Returns the largest |g| in contact or -g outside [m].
      double update_gap()
      {
        op.apply(p.data(), g.data());
        double mean = 0.;
        n_contact   = 0;
        for (std::size_t e = 0; e < p.size(); ++e)
          {
            g[e] += problem.gap[e];
            if (p[e] > 0.)
              mean += g[e], ++n_contact;
          }
        if (problem.prescribe_force)
          approach = mean / static_cast<double>(n_contact);
        double worst = 0.;
        norm_before  = norm;
        norm         = 0.;
        for (std::size_t e = 0; e < p.size(); ++e)
          {
            g[e] -= approach;
            if (p[e] > 0.)
              {
                norm += g[e] * g[e];
                worst = std::max(worst, std::abs(g[e]));
              }
            else
              worst = std::max(worst, -g[e]);
          }
        return worst;
      }

      /// The next direction. Returns how far to go along it.
      double update_direction()
      {
        const double beta = conjugate && norm_before > 0. ? norm / norm_before : 0.;
        for (std::size_t e = 0; e < p.size(); ++e)
          t[e] = p[e] > 0. ? g[e] + beta * t[e] : 0.;
        op.apply(t.data(), r.data());
        double r_mean = 0.;
        if (problem.prescribe_force)
          {
            for (std::size_t e = 0; e < p.size(); ++e)
              r_mean += p[e] > 0. ? r[e] : 0.;
            r_mean /= static_cast<double>(n_contact);
          }
        double gt = 0., rt = 0.;
        for (std::size_t e = 0; e < p.size(); ++e)
          if (p[e] > 0.)
            gt += g[e] * t[e], rt += (r[e] - r_mean) * t[e];
        // one element in contact has no direction left under a given force: only the active set can change
        return rt > 0. ? gt / rt : 0.;
      }

      /// Change the pressure, and press where surfaces interpenetrate; it sums up to the given force.
      void update_pressure(const double length)
      {
        const double push = length > 0. ? length : 1. / op.self_influence;
        double       sum  = 0.;
        conjugate         = true;
        for (std::size_t e = 0; e < p.size(); ++e)
          {
            if (p[e] > 0.)
              p[e] = std::max(p[e] - length * t[e], 0.);
            else if (g[e] < 0.)
              {
                p[e] -= push * g[e];
                conjugate = false;
              }
            sum += p[e];
          }
        if (problem.prescribe_force && sum > 0.)
          for (double &v : p)
            v *= problem.force / (sum * area);
      }
    };
  } // namespace

  NormalSolution solve_normal(const FourierGrid    &fourier,
                              const NormalOperator &op,
                              const NormalProblem  &problem)
  {
    const Grid &grid = fourier.grid;
    check(grid, problem);
    const double       h_min = *std::min_element(problem.gap.begin(), problem.gap.end());
    NormalSolution     solution;
    ConjugateGradients iteration(grid, op, problem);
    for (solution.iterations = 1;; ++solution.iterations)
      {
        solution.residual = iteration.update_gap() / (iteration.approach - h_min);
        if (solution.residual <= problem.tolerance && iteration.approach > h_min)
          break;
        if (solution.iterations >= problem.max_iterations)
          throw std::runtime_error("normal contact: the conjugate gradients reached " +
                                   std::to_string(solution.residual) + " in place of the tolerance " +
                                   std::to_string(problem.tolerance));
        iteration.update_pressure(iteration.update_direction());
      }

    double sum = 0.;
    for (std::size_t e = 0; e < grid.size(); ++e)
      if (iteration.p[e] > 0.)
        {
          solution.contact.push_back(static_cast<unsigned int>(e));
          sum += iteration.p[e];
        }
    solution.force    = sum * grid.element_area();
    solution.approach = iteration.approach;
    solution.pressure = std::move(iteration.p);
    solution.gap      = std::move(iteration.g);
    touches_border(grid, solution);
    return solution;
  }
} // namespace tread::reference
