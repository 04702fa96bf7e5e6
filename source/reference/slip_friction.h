// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_source_reference_slip_friction_h
#define tread_source_reference_slip_friction_h

#include <tread/reference/friction.h>
#include <tread/reference/half_space.h>

namespace tread::reference
{
  /// Steady rolling with friction that falls with the slip speed: the friction bound of each element is found
  /// in turn with the slip, from that of the static coefficient down, until no coefficient changes by more
  /// than 1e-5 of it. Where a law falls so steeply that there are several answers, this is the one with the
  /// least slip that the turns find.
  /// Friction that depends on the pressure or the place is known with it; with the temperature it is found in
  /// the same way.
  /// @param speed of rolling [m/s]
  /// @pre !friction.is_coulomb() Throws FrictionTooSteep if the turns do not settle.
  TangentialSolution solve_with_friction(const Grid                &grid,
                                         const ElasticPair         &pair,
                                         const std::vector<double> &pressure,
                                         TangentialProblem          problem,
                                         const Friction            &friction,
                                         double                     speed);

  /// Throws std::invalid_argument where friction makes no sense, or has no answer for this pair.
  void check_friction(const Friction &friction, const ElasticPair &pair);
} // namespace tread::reference

#endif
