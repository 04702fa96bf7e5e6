// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_coulomb_solver_h
#define tread_contact_coulomb_solver_h

#include <tread/contact/friction_law.h>
#include <tread/contact/strips.h>

#include <functional>
#include <vector>

namespace tread
{
  struct CoulombSolverParameters
  {
    /// Sweeps end when no impulse changes by more than this share of the largest one.
    double       tolerance  = 1e-7;
    unsigned int max_sweeps = 200;
  };

  struct CoulombSolverResult
  {
    unsigned int sweeps;
    double       change; ///< of the last sweep, share of the largest impulse
  };

  /// Friction of single constraints, beside the law that all have.
  struct PairFriction
  {
    std::vector<double> coefficient; ///< in this step, of a law with a memory; empty: that of the law
    std::vector<double> factor;      ///< of the law's coefficient, by the place; empty: 1
    /// Another factor, by the pressure (Pa), which is the normal impulse over area and time step; empty: 1.
    std::function<double(double)> of_pressure;
  };

  /// Block Gauss-Seidel on the impulses (Moreau 1988; Jean 1999): each block is solved exactly,
  /// as the compliance of one constraint is the same in all directions:
  /// P_n >= 0, gap >= 0 at the step's end, P_n gap = 0; u_t = 0 where |P_t| <= f(0) P_n allows it, else
  /// P_t = -f(|u_t|) P_n u_t/|u_t| with the coefficient f at the slip speed that this block then has itself.
  ///
  /// Collective: each rank changes the impulses of its strip.
  /// @param offset one a constraint, m/s: what adds to the relative velocity of its nodes. Along the normal
  /// the gap now over the time step, along the surface the sliding that is imposed.
  /// @param velocity compact nodes; holds the predictions with the impulses' effect on return, for the nodes
  /// of the strip.
  /// @param impulse one a constraint, N s; the warm start, whose effect is not yet in velocity. What acts on
  /// the nodes of the strip has to be there.
  /// @param slips one a constraint: whether those of the strip with an impulse slip now; others adhere.
  /// @param pairs what friction has of its own at each constraint.
  /// @param time_step s, of pairs.of_pressure
  /// @param given one a constraint: P_t over P_n where it is not for the friction law to find; or empty.
  CoulombSolverResult solve_coulomb(const ContactProblem          &problem,
                                    const FrictionLaw             &friction,
                                    const CoulombSolverParameters &parameters,
                                    Strips                        &strips,
                                    const std::vector<Vector3>    &offset,
                                    std::vector<Vector3>          &velocity,
                                    std::vector<Vector3>          &impulse,
                                    std::vector<char>             &slips,
                                    const std::vector<Vector3>    &given     = {},
                                    const PairFriction            &pairs     = {},
                                    const double                   time_step = 0.);
} // namespace tread

#endif
