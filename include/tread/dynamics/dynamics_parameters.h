// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_dynamics_parameters_h
#define tread_dynamics_dynamics_parameters_h

namespace tread
{
  /// From where on a motion is not that of steel any more.
  struct MotionLimits
  {
    /// A cell with more strain (Green-Lagrange, Frobenius' norm) stops a run.
    double strain = 0.5;
    /// A cell with less of its volume stops a run: where this is pressed so far, strains that are smaller
    /// than the largest allowed are large as well.
    double volume = 0.3;
    /// A node that moves faster is part of an instability, m/s. A wheel's rim moves at up to twice the speed
    /// of the train, 170 m/s at 300 km/h, and a pressure wave of 1000 m/s would carry a stress of rho c v =
    /// 46 GPa, a hundred times the strength of steel. An unstable motion grows exponentially, so that half or
    /// double the limit finds it a few steps earlier or later.
    double node_speed = 1e3;
  };

  struct DynamicsParameters
  {
    /// Some meshes resonate with steps of unlike length at 0.95; 0.93 was enough for all that did. Mass
    /// damping mostly prevents that on one mesh, and not on all of the many that a window takes.
    static constexpr double largest_courant_with_levels = 0.9;

    /// Time step over the critical one.
    double courant_number = largest_courant_with_levels;
    /// Stiffness-proportional damping: internal forces are taken at x + beta v with
    /// beta = damping_steps time steps.
    double damping_steps = 0.1;
    /// Mass-proportional damping of the motion relative to the rigid motion, 1/s: for quasi-static scenes.
    double       mass_damping  = 0.;
    double       density_scale = 1.;
    double       gravity       = 9.81; ///< m/s^2, along -z
    MotionLimits stop_at;
    /// Interval, in steps of all cells, at which the energy dissipated by stiffness damping and bulk
    /// viscosity is sampled, with two more force evaluations. With levels, whose steps update fewer cells, it
    /// is as many times longer, in whole steps of the longest level. Power is assumed to vary linearly in
    /// between; with 1 and without levels it is counted exactly. The number is a prime, because without
    /// levels a vibration whose period divides it would always be sampled in the same phase.
    unsigned int steps_between_damping_samples = 47;
  };
} // namespace tread

#endif
