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
  } // namespace

  NormalSolution solve_normal(const FourierGrid    &fourier,
                              const NormalOperator &op,
                              const NormalProblem  &problem)
  {
    const Grid &grid = fourier.grid;
    check(grid, problem);
    const std::size_t n     = grid.size();
    const double      area  = grid.element_area();
    const auto       &h     = problem.gap;
    const double      h_min = *std::min_element(h.begin(), h.end());

    NormalSolution      solution;
    std::vector<double> p = problem.initial_pressure, g(n), t(n, 0.), r(n);

    if (p.empty())
      // Without a guess: everything, or everything that interpenetrates, carries load.
      {
        p.assign(n, 0.);
        const double range = *std::max_element(h.begin(), h.end()) - h_min;
        const double depth = problem.prescribe_force ? 0.5 * range : problem.approach - h_min;
        for (std::size_t e = 0; e < n; ++e)
          p[e] = (h[e] - h_min <= depth) ? 1. : 0.;
      }
    double sum = 0.;
    for (double &v : p)
      sum += (v = std::max(v, 0.));
    if (problem.prescribe_force)
      {
        require(sum > 0., "sum of initial_pressure", sum, "positive");
        for (double &v : p)
          v *= problem.force / (sum * area);
      }
    else if (problem.initial_pressure.empty())
      {
        // scale so that the mean displacement is that wanted
        op.apply(p.data(), g.data());
        double work = 0., wanted = 0.;
        for (std::size_t e = 0; e < n; ++e)
          work += p[e] * g[e], wanted += p[e] * (problem.approach - h[e]);
        for (double &v : p)
          v *= std::max(wanted / work, 1e-12);
      }

    double norm_old  = 1.;
    bool   conjugate = false;
    double approach  = problem.approach;
    for (unsigned int iteration = 1;; ++iteration)
      {
        op.apply(p.data(), g.data());
        double      mean  = 0.;
        std::size_t count = 0;
        for (std::size_t e = 0; e < n; ++e)
          {
            g[e] += h[e];
            if (p[e] > 0.)
              mean += g[e], ++count;
          }
        if (problem.prescribe_force)
          approach = mean / static_cast<double>(count);
        double norm = 0., worst = 0.;
        for (std::size_t e = 0; e < n; ++e)
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
        solution.residual   = worst / (approach - h_min);
        solution.iterations = iteration;
        if (solution.residual <= problem.tolerance && approach > h_min)
          break;
        if (iteration >= problem.max_iterations)
          throw std::runtime_error("normal contact: the conjugate gradients reached " +
                                   std::to_string(solution.residual) + " in place of the tolerance " +
                                   std::to_string(problem.tolerance));

        const double beta = conjugate && norm_old > 0. ? norm / norm_old : 0.;
        norm_old          = norm;
        for (std::size_t e = 0; e < n; ++e)
          t[e] = p[e] > 0. ? g[e] + beta * t[e] : 0.;
        op.apply(t.data(), r.data());
        double r_mean = 0.;
        if (problem.prescribe_force)
          {
            for (std::size_t e = 0; e < n; ++e)
              r_mean += p[e] > 0. ? r[e] : 0.;
            r_mean /= static_cast<double>(count);
          }
        double gt = 0., rt = 0.;
        for (std::size_t e = 0; e < n; ++e)
          if (p[e] > 0.)
            gt += g[e] * t[e], rt += (r[e] - r_mean) * t[e];
        // one element in contact has no direction left under a given force: only the active set can change
        const double length = rt > 0. ? gt / rt : 0.;
        const double push   = length > 0. ? length : 1. / op.self_influence;

        conjugate = true;
        sum       = 0.;
        for (std::size_t e = 0; e < n; ++e)
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
        if (problem.prescribe_force)
          {
            if (sum > 0.)
              for (double &v : p)
                v *= problem.force / (sum * area);
          }
      }

    sum = 0.;
    for (std::size_t e = 0; e < n; ++e)
      if (p[e] > 0.)
        {
          solution.contact.push_back(static_cast<unsigned int>(e));
          sum += p[e];
        }
    solution.force    = sum * area;
    solution.approach = approach;
    solution.pressure = std::move(p);
    solution.gap      = std::move(g);
    touches_border(grid, solution);
    return solution;
  }
} // namespace tread::reference
