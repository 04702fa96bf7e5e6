// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_relaxation_h
#define tread_dynamics_relaxation_h

#include <tread/dynamics/moving_bodies.h>

#include <functional>

namespace tread
{
  /// Find the equilibrium at rest under weight, the hubs' static forces and the centrifugal force of the
  /// true density at the nominal angular velocity, by dynamic relaxation (Underwood 1983) with masses that
  /// give every cell the same frequency. Contact is frictionless here, or has given tractions. Cells of
  /// plastic zones yield in one step, from their initial history to the equilibrium; intermediate states of
  /// the iteration leave no trace.
  /// @param tolerance of the force balance, share of the largest force.
  /// @param after_measurement is called with the number of the iteration and the balance reached, and may
  /// prescribe the contact tractions.
  /// @returns the number of iterations. @throws std::runtime_error if max_iterations are not sufficient.
  unsigned int relax(MovingBodies                                    &moving,
                     const double                                     tolerance,
                     const unsigned int                               max_iterations,
                     const std::function<void(unsigned int, double)> &after_measurement);
} // namespace tread

#endif
