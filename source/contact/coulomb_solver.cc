// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/contact/coulomb_solver.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  CoulombSolverResult solve_coulomb(const ContactProblem          &problem,
                                    const FrictionLaw             &friction,
                                    const CoulombSolverParameters &parameters,
                                    const std::vector<double>     &gap_rate,
                                    std::vector<Row>              &velocity,
                                    std::vector<Row>              &impulse)
  {
    const unsigned int n = problem.constraints.size();
    for (unsigned int j = 0; j < n; ++j)
      if (impulse[j][0] != 0. || impulse[j][1] != 0. || impulse[j][2] != 0.)
        problem.apply(problem.constraints[j], impulse[j], velocity);

    // Open constraints wait: they are looked at in the first sweep, and again before the end.
    std::vector<char>   waits(n, false);
    bool                all = true;
    CoulombSolverResult result{0, 0.};
    for (result.sweeps = 1; result.sweeps <= parameters.max_sweeps; ++result.sweeps)
      {
        double largest_change = 0., largest_impulse = 0.;
        for (unsigned int j = 0; j < n; ++j)
          {
            if (!all && waits[j])
              continue;
            const ContactProblem::Constraint &constraint  = problem.constraints[j];
            const Row                         u           = problem.combine(constraint, velocity);
            const Row                         old         = impulse[j];
            const double                      old_normal  = dot(old, constraint.normal);
            const double                      normal_rate = dot(u, constraint.normal) + gap_rate[j];
            const double new_normal = std::max(0., old_normal - normal_rate / constraint.compliance);
            waits[j]                = new_normal == 0. && old_normal == 0.;
            if (waits[j])
              continue;

            const Row slip       = u - dot(u, constraint.normal) * constraint.normal;
            Row       tangential = old - old_normal * constraint.normal - (1. / constraint.compliance) * slip;
            const double limit   = friction.coefficient(std::sqrt(dot(slip, slip))) * new_normal;
            const double size2   = dot(tangential, tangential);
            if (size2 > limit * limit)
              tangential *= limit / std::sqrt(size2);

            impulse[j]       = new_normal * constraint.normal + tangential;
            const Row change = impulse[j] - old;
            problem.apply(constraint, change, velocity);
            largest_change  = std::max(largest_change, dot(change, change));
            largest_impulse = std::max(largest_impulse, new_normal);
          }
        result.change = largest_impulse > 0. ? std::sqrt(largest_change) / largest_impulse : 0.;
        if (result.change <= parameters.tolerance)
          {
            if (all)
              break;
            all = true;
          }
        else
          all = false;
      }
    return result;
  }
} // namespace tread
