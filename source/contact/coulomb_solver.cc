// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/contact/coulomb_solver.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  CoulombSolverResult solve_coulomb(const ContactProblem          &problem,
                                    const FrictionLaw             &friction,
                                    const CoulombSolverParameters &parameters,
                                    Strips                        &strips,
                                    const std::vector<Vector3>    &offset,
                                    std::vector<Vector3>          &velocity,
                                    std::vector<Vector3>          &impulse,
                                    std::vector<char>             &slips,
                                    const std::vector<Vector3>    &given,
                                    const PairFriction            &pairs,
                                    const double                   time_step)
  {
    for (unsigned int j = strips.first_acting; j < strips.end_acting; ++j)
      if (impulse[j][0] != 0. || impulse[j][1] != 0. || impulse[j][2] != 0.)
        problem.apply(problem.constraints[j], impulse[j], velocity);

    const double static_coefficient = friction.coefficient(0.);
    // The bound then is that of adhesion.
    const bool bound_is_known = friction.is_constant() || !pairs.coefficient.empty();

    // Open constraints wait: they are looked at in the first sweep, and again before the end.
    slips.assign(problem.constraints.size(), false);
    std::vector<char>   waits(problem.constraints.size(), false);
    bool                all = true;
    CoulombSolverResult result{0, 0.};
    double              largest[2]; // change squared, normal impulse
    const auto          sweep = [&](const unsigned int begin, const unsigned int end) {
      for (unsigned int j = begin; j < end; ++j)
        {
          if (!all && waits[j])
            continue;
          const ContactProblem::Constraint &constraint = problem.constraints[j];
          const Vector3                     u   = problem.combine(constraint, velocity) + offset[j];
          const Vector3                     old = impulse[j];
          const double                      old_normal  = dot(old, constraint.normal);
          const double                      normal_rate = dot(u, constraint.normal);
          const double new_normal = std::max(0., old_normal - normal_rate / constraint.compliance);
          waits[j]                = new_normal == 0. && old_normal == 0.;
          if (waits[j])
            continue;

          Vector3 tangential;
          if (given.empty())
            {
              const Vector3 slip = u - normal_rate * constraint.normal;
              tangential = old - old_normal * constraint.normal - (1. / constraint.compliance) * slip;
              double factor = pairs.factor.empty() ? 1. : pairs.factor[j];
              if (pairs.of_pressure)
                factor *= pairs.of_pressure(new_normal / (constraint.area * time_step));
              const double at_rest = pairs.coefficient.empty() ? static_coefficient : pairs.coefficient[j];
              const double bound = factor * at_rest * new_normal; // of adhesion
              const double size2 = dot(tangential, tangential);
              slips[j]           = !(size2 < bound * bound);
              if (size2 > bound * bound)
                {
                  const double size = std::sqrt(size2);
                  if (bound_is_known)
                    tangential *= bound / size;
                  else
                    {
                      const double speed =
                        friction.slip(constraint.compliance * size, // at the end of the step
                                               constraint.compliance * factor * new_normal);
                      tangential *= friction.coefficient(speed) * factor * new_normal / size;
                    }
                }
            }
          else
            {
              tangential = new_normal * (given[j] - dot(given[j], constraint.normal) * constraint.normal);
              slips[j] = true;
            }

          impulse[j]           = new_normal * constraint.normal + tangential;
          const Vector3 change = impulse[j] - old;
          problem.apply(constraint, change, velocity);
          largest[0] = std::max(largest[0], dot(change, change));
          largest[1] = std::max(largest[1], new_normal);
        }
    };
    for (result.sweeps = 1; strips.sweeps() && result.sweeps <= parameters.max_sweeps; ++result.sweeps)
      {
        largest[0] = largest[1] = 0.;
        sweep(strips.begin, strips.end_lower);
        strips.send(strips.lower, velocity);
        sweep(strips.end_lower, strips.begin_upper);
        strips.receive(strips.upper, velocity);
        sweep(strips.begin_upper, strips.end);
        strips.send(strips.upper, velocity);
        strips.largest(largest);
        strips.receive(strips.lower, velocity);
        result.change = largest[1] > 0. ? std::sqrt(largest[0]) / largest[1] : 0.;
        if (result.change <= parameters.tolerance)
          {
            if (all)
              break;
            all = true;
          }
        else
          all = false;
      }
    strips.wait(strips.lower);
    strips.wait(strips.upper);
    return result;
  }
} // namespace tread
