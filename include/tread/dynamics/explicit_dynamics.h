// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_explicit_dynamics_h
#define tread_dynamics_explicit_dynamics_h

#include <tread/base/archive.h>
#include <tread/dynamics/carries_body.h>
#include <tread/dynamics/critical_step.h>
#include <tread/dynamics/energy_books.h>
#include <tread/dynamics/moving_bodies.h>
#include <tread/dynamics/relaxation.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace tread
{
  /// Seconds that this rank spent since the start.
  struct StepTimes
  {
    double internal_forces = 0., contact = 0., search = 0., communication = 0., nodes = 0.;
  };

  /// Central differences for all bodies, the parts that act on them or carry them, and the contact between
  /// them.
  ///
  /// With levels of cells (SolidParameters::max_level) the cells of level l are evaluated every 2^l-th step
  /// only, and nodes move with the step of their fastest cell. Nodes between levels feel the slow cells'
  /// forces steadily, corrected by a push when these are evaluated: an asynchronous variational integrator
  /// (Lew, Marsden, Ortiz & West 2003) in which the steady part of the slow forces belongs to the fast ones.
  /// Needs some stiffness damping (0.1): without it these integrators resonate (Fong, Darve & Lew 2008).
  /// Nodes of the contact surfaces and those that parts need in every step and cells of plastic zones are of
  /// level 0.
  ///
  /// v^(n+1/2) = v^(n-1/2) + dt M^-1 (f_int(x^n + beta v^(n-1/2)) + f_ext + G^T P/dt),
  /// x^(n+1) = x^n + dt v^(n+1/2), with the impulses P such that gaps at n+1 are closed or open
  /// and Coulomb's law holds for v^(n+1/2).
  class ExplicitDynamics : protected MovingBodies
  {
  public:
    ExplicitDynamics(const Mesh &mesh, const Solid &solid, const DynamicsParameters &parameters);

    using MovingBodies::add;
    using MovingBodies::attach_contact;
    using MovingBodies::boundary_nodes;
    using MovingBodies::fix_nodes;
    using MovingBodies::guide_nodes;
    using MovingBodies::ideal_gain_of_levels;
    using MovingBodies::imbalance_of_cost;
    using MovingBodies::inverse_masses;
    using MovingBodies::MassOfBody;
    using MovingBodies::masses_of_bodies;
    using MovingBodies::max_level;
    using MovingBodies::mesh;
    using MovingBodies::solid;
    using MovingBodies::state;
    using MovingBodies::steps_worth;
    using MovingBodies::support_nodes;
    using MovingBodies::synchronised;
    using MovingBodies::true_masses;

    /// Set the velocities of parts that bend under loads which move, such as a rail and its sleepers (half a
    /// step back), and those of what presses on them, to what the motion of the deflection needs. All loads
    /// run equally fast. To be called before set_rigid_velocities().
    void set_bending_velocities();

    /// The largest stable time step, which start() uses; all supports must be set before it is first asked.
    CriticalStep &critical_step()
    {
      return critical;
    }
    const CriticalStep &critical_step() const
    {
      return critical;
    }

    /// Set the velocities of carried bodies' nodes to those of their carriers' rigid motion half a step ago.
    void set_rigid_velocities();

    /// Set inertia and time step and reset the ledger; call after everything is attached and set.
    void start();

    void step();

    /// Find the equilibrium at rest. @see tread::relax
    unsigned int relax(const double                                     tolerance,
                       const unsigned int                               max_iterations,
                       const std::function<void(unsigned int, double)> &after_measurement)
    {
      return tread::relax(*this, tolerance, max_iterations, after_measurement);
    }

    /// Present energies, when nodes must be synchronised. Collective; costs about two steps.
    EnergyLedger ledger() const
    {
      return books.ledger();
    }

    /// Store the state, or restore it once all is attached and set: that of hub, supports and contact too.
    /// External forces are not part of it. Collective.
    void serialize(Archive &archive);

    /// The same of the parts alone. Collective.
    void serialize_parts(Archive &archive)
    {
      parts.serialize(archive);
    }

    /// Go on where the motion of the same bodies on another mesh is, which refines the same coarse cells
    /// otherwise. Instead of start(), once all is attached and the state of the parts is that of `before`.
    /// What energy the change takes is booked as the window's loss. Collective. @pre before.synchronised(),
    /// and no cells of plastic zones
    void go_on_from(ExplicitDynamics &before);

    /// @throws WentWrong if nodes move faster than is possible in steel. Collective.
    void check_stability() const;

    const StepTimes &times() const
    {
      return spent;
    }

    /// Memory of this rank's nodes in this object, bytes.
    std::size_t memory_consumption() const
    {
      std::size_t shares = 0; // those of one level at once
      for (const SlowShares &of_level : levels.slow_shares)
        shares = std::max(shares, of_level.nodes.size());
      return state.v.size() * (3 * sizeof(Vector3) + 2 * sizeof(double) + 3) + levels.memory_consumption() +
             shares * sizeof(Vector3) + loads_of_shared.size() * sizeof(LoadOfShared);
    }

  private:
    /// Set the time step, the inverse masses and the pairs in contact.
    void set_inertia();
    /// Energy of mass that comes and goes as chords become arcs, J: that of density scaling has the rigid
    /// motion of carried bodies and the potential by which its centrifugal force is compensated, and all mass
    /// has its height. Collective.
    double energy_of_changing_mass() const;
    /// Take over the motion of the nodes. @see go_on_from
    void take_nodes(ExplicitDynamics &before);
    /// Change of a node's velocity by the rigid turning of its body in half of its step, m/s. @param
    /// time_step of level 0, s
    Vector3      turning_in_half_a_step(const unsigned int node,
                                        const Vector3     &velocity,
                                        const double       time_step) const;
    void         prepare_step();    ///< the state that step() leaves for the next one
    unsigned int level_due() const; ///< the highest level whose cells are evaluated in this step
    /// Move the hanging nodes that are needed now by cells due in this step, by contact or (when nodes are
    /// synchronised) from outside.
    void place_hanging_nodes();
    /// What the step tells the parts.
    Step step_with(const unsigned int due)
    {
      return {state, inverse_mass, levels, due, books.totals};
    }

    /// Forces of the cells that are due in this step, times 2^level, with an update of their state.
    void add_forces_due(const unsigned int due);
    /// Where slow shares do not depend on the ranks: give what the cells of this level have added to the
    /// forces since force_before to the ranks that own the nodes. Collective.
    void give_to_owners(const SlowShares &shares);

    using Run = NodeLevels::Run;

    /// Load that is left out of the initial force on a node with copies on other ranks, and added after their
    /// sum.
    struct LoadOfShared
    {
      unsigned int node, level;
      Vector3      load; ///< N, times 2^level
    };

    /// Sums of the loads on bodies over this rank's own nodes, by the number of the carrier.
    struct BodyLoads
    {
      explicit BodyLoads(const std::size_t n_carriers = 0)
        : of_carrier(n_carriers)
      {
      }

      std::vector<LoadsOnBody> of_carrier;
      Vector3                  loss{}; ///< by mass damping in a step, J: its parts along x, y and z
    };

    /// Mass of a node that is free to move, times factor, kg.
    double free_mass(const unsigned int i, const double factor) const
    {
      return inverse_mass[i] > 0. ? factor * true_mass[i] : 0.;
    }

    Vector3 weight(const unsigned int i, const double factor) const ///< times factor, N
    {
      return Vector3{0., 0., -parameters.gravity * free_mass(i, factor), 0.};
    }

    /// Call loop(load) for a run, where load(i) is the present body load on a node, times factor (N), which
    /// is added to the sums. It is zero if there are no loads.
    template <typename Loop>
    void with_body_loads(const bool   has_loads,
                         const Run   &run,
                         const double factor,
                         BodyLoads   &sums,
                         const Loop  &loop) const;

    /// The same for a run that has loads. @param quanta what they are rounded to
    template <typename Rounding, typename Loop>
    void with_rounded_loads(const Rounding quanta,
                            const Run     &run,
                            const double   factor,
                            BodyLoads     &sums,
                            const Loop    &loop) const;

    bool has_body_loads(const Run &run) const
    {
      return parameters.mass_damping > 0. ||
             (run.carrier >= 0 && parts.motions()[run.carrier].compensation != 0.);
    }

    // What step() does, in this order, to nodes up to the level that is due.
    void sum_forces(const unsigned int due); ///< over the ranks
    void add_loads(const unsigned int due);  ///< forces from outside
    void add_contact_forces();
    void advance_nodes(const unsigned int due);

    /// Save, for shared nodes up to this level, the load with which their forces begin.
    void keep_loads_of_shared(const unsigned int due);

    CriticalStep              critical;
    EnergyBooks               books;
    NodalField                force_before;    ///< of the cells of a level, on nodes that share them
    NodalField                given_to_owners; ///< of these forces, what is one rank's alone
    std::vector<LoadOfShared> loads_of_shared;
    BodyLoads                 next_loads; ///< of level 0 in its next step
    StepTimes                 spent;
  };
} // namespace tread

#endif
