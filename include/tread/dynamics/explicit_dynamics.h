// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_explicit_dynamics_h
#define tread_dynamics_explicit_dynamics_h

#include <tread/base/archive.h>
#include <tread/base/reproducible_sum.h>
#include <tread/contact/contact.h>
#include <tread/dynamics/energy_ledger.h>
#include <tread/dynamics/node_levels.h>
#include <tread/dynamics/part.h>
#include <tread/dynamics/state.h>
#include <tread/mesh/mesh.h>
#include <tread/solid/matched_surface.h>
#include <tread/solid/solid.h>

#include <array>
#include <functional>
#include <memory>
#include <string>

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
  class ExplicitDynamics
  {
  public:
    ExplicitDynamics(const Mesh &mesh, const Solid &solid, const DynamicsParameters &parameters);
    ExplicitDynamics(const ExplicitDynamics &)            = delete; // parts refer to what it has
    ExplicitDynamics &operator=(const ExplicitDynamics &) = delete;

    /// Make a part of this type and add it: it acts behind those that were added before. Collective.
    /// @param arguments of its constructor behind PartOf
    template <typename P, typename... Arguments>
    P &add(Arguments &&...arguments)
    {
      auto part = std::make_unique<P>(PartOf{mesh, solid, parameters, quanta, true_mass, added_mass, state},
                                      std::forward<Arguments>(arguments)...);
      P   &made = *part;
      add(std::move(part));
      return made;
    }

    /// Fix these nodes (of this rank) at their positions.
    void fix_nodes(const std::vector<unsigned int> &nodes);

    /// Prevent these nodes (of this rank) from moving in a direction (0 to 2).
    void guide_nodes(const std::vector<unsigned int> &nodes, const unsigned int direction);

    /// The nodes of a part of a body's boundary on this rank.
    std::vector<unsigned int> boundary_nodes(const unsigned int body, const Boundary boundary) const
    {
      return mesh.boundary_nodes(body, boundary);
    }
    std::vector<unsigned int> support_nodes(const unsigned int body) const
    {
      return boundary_nodes(body, Boundary::support);
    }

    void attach_contact(Contact &contact);

    /// Set the velocities of parts that bend under loads which move, such as a rail and its sleepers (half a
    /// step back), and those of what presses on them, to what the motion of the deflection needs. All loads
    /// run equally fast. To be called before set_rigid_velocities().
    void set_bending_velocities();

    /// Largest stable time step of level 0 with the prescribed damping, s, from the highest frequencies of
    /// the cells of each level and above. Collective; the first call costs about 30 force evaluations per
    /// level and requires that all supports are set.
    double critical_time_step() const;

    /// Time step that the cells alone allow over the critical one, which springs and dampers shorten.
    double slowed_by_supports() const;

    /// Determine the critical time step for the cells as they are deformed at present; start() uses it. Cells
    /// that are yielding at present count with their softer tangent. Collective; about 30 force evaluations
    /// per level.
    void renew_critical_time_step();

    /// @throws WentWrong if a cell has been turned inside out or strained too much, or if the cells have
    /// deformed so much that the time step is no longer stable. Collective; costs about one force evaluation,
    /// or 30 per level if a bound from the cells' stretches is not sufficient.
    void check_cells();

    /// Set the velocities of carried bodies' nodes to those of their carriers' rigid motion half a step ago.
    void set_rigid_velocities();

    /// Set inertia and time step and reset the ledger; call after everything is attached and set.
    void start();

    void step();

    /// Whether all nodes are at the same instant, which only levels of time steps can prevent.
    bool synchronised() const
    {
      return state.n_steps % (std::uint64_t(1) << max_level()) == 0;
    }

    unsigned int max_level() const
    {
      return levels.max_level();
    }

    /// Number of cell updates in 2^max_level steps without levels over that with levels, of all ranks.
    /// Collective.
    double ideal_gain_of_levels(const unsigned int largest_level) const;
    double ideal_gain_of_levels() const
    {
      return gain_of_levels;
    }
    /// Steps with levels that update as many cells as this number of steps would without: what is done for
    /// all cells now and then takes the same share of the time.
    std::uint64_t steps_worth(const unsigned int steps_of_all_cells) const
    {
      return static_cast<std::uint64_t>(steps_of_all_cells * gain_of_levels);
    }

    /// Find the equilibrium at rest under weight, the hubs' static forces and the centrifugal force of the
    /// true density at the nominal angular velocity, by dynamic relaxation (Underwood 1983) with masses that
    /// give every cell the same frequency. Contact is frictionless here, or has given tractions. Cells of
    /// plastic zones yield in one step, from their initial history to the equilibrium; intermediate states of
    /// the iteration leave no trace.
    /// @param tolerance of the force balance, share of the largest force.
    /// @param after_measurement is called with the number of the iteration and the balance reached, and may
    /// prescribe the contact tractions.
    /// @returns the number of iterations. @throws std::runtime_error if max_iterations are not sufficient.
    unsigned int relax(const double                                     tolerance,
                       const unsigned int                               max_iterations,
                       const std::function<void(unsigned int, double)> &after_measurement);

    /// Present energies, when nodes must be synchronised. Collective; costs about two steps.
    EnergyLedger ledger() const;

    /// Store the state, or restore it once all is attached and set: that of hub, supports and contact too.
    /// External forces are not part of it. Collective.
    void serialize(Archive &archive);

    /// The same of the parts alone. Collective.
    void serialize_parts(Archive &archive);

    /// Go on where the motion of the same bodies on another mesh is, which refines the same coarse cells
    /// otherwise. Instead of start(), once all is attached and the state of the parts is that of `before`.
    /// What energy the change takes is booked as the window's loss. Collective. @pre before.synchronised(),
    /// and no cells of plastic zones
    void go_on_from(ExplicitDynamics &before);

    /// @throws WentWrong if nodes move faster than is possible in steel. Collective.
    void check_stability() const;

    State state;

    const StepTimes &times() const
    {
      return spent;
    }

    /// Memory of this rank's nodes in this object, bytes.
    std::size_t memory_consumption() const
    {
      return state.v.size() * (3 * sizeof(Vector3) + 2 * sizeof(double) + 3) + levels.memory_consumption() +
             force_before.size() * sizeof(Vector3) + loads_of_shared.size() * sizeof(LoadOfShared);
    }

    const std::vector<double> &inverse_masses() const
    {
      return inverse_mass;
    }
    /// True nodal masses (kg), condensed and summed.
    const std::vector<double> &true_masses() const
    {
      return true_mass;
    }
    /// Mass of a body, kg, and what its fastest cells were given besides to slow them down.
    struct MassOfBody
    {
      double own = 0., added = 0.;
    };
    /// By body. Collective.
    std::vector<MassOfBody> masses_of_bodies() const;

    const Mesh    &mesh;
    const Solid   &solid;
    MatchedSurface matched_surface; ///< of the cells near the contact, as it was last searched

  private:
    class Relaxation; ///< of relax()

    /// "at x = ..., y = ..., z = ... mm of the rail": place (m) and body of what is worst. The lowest of the
    /// ranks on which `is_worst` is set says where. Collective.
    std::string place_of_worst(const bool              is_worst,
                               const dealii::Point<3> &place,
                               const unsigned int      body) const;
    /// The same of a cell's centre before it was deformed.
    std::string place_of_worst_cell(const bool is_worst, const unsigned int cell) const;

    /// Masses of the cells, each times a factor, by node: condensed and summed over the ranks, the same on
    /// any number of them, kg. Collective.
    std::vector<double> nodal_masses(const std::function<double(unsigned int)> &factor_of_cell) const;
    /// Set the time step, the inverse masses and the pairs in contact.
    void set_inertia();
    /// Energy that the mass added by density scaling has by the rigid motion of carried bodies, and the
    /// potential by which its centrifugal force is compensated, J. Collective.
    double energy_of_added_mass() const;
    /// Take over the motion of the nodes. @see go_on_from
    void take_nodes(ExplicitDynamics &before);
    /// Change of a node's velocity by the rigid turning of its body in half of its step, m/s. @param
    /// time_step of level 0, s
    Vector3 turning_in_half_a_step(const unsigned int node,
                                   const Vector3     &velocity,
                                   const double       time_step) const;
    void    prepare_step(); ///< the state that step() leaves for the next one
    /// Of the hourglass modes of the uppermost layer of cells over their stiffness, s.
    double surface_damping_time() const
    {
      return solid.surface_damping() * state.time_step;
    }
    std::vector<double> free_inverse_masses() const; ///< 0 where motion is prescribed
    /// Highest frequency of the cells of this and higher levels with nodes at x, rad/s.
    double highest_frequency(const unsigned int    first_level,
                             const NodalField     &x,
                             const PlasticHistory &memory) const;
    /// The largest of these frequencies times 2^level, which the steps of level 0 must resolve, rad/s.
    double       highest_of_levels(const NodalField &x, const PlasticHistory &memory) const;
    double       critical_time_step_of(double highest_of_levels) const; ///< s; also stores that frequency
    void         set_node_levels();
    unsigned int level_due() const; ///< the highest level whose cells are evaluated in this step
    /// Move the hanging nodes that are needed now by cells due in this step, by contact or (when nodes are
    /// synchronised) from outside.
    void           place_hanging_nodes();
    mutable double critical_step = 0., highest_of_step = 0.; ///< s, and the frequency that it is for, rad/s
    mutable double bound_found_stable = 0.; ///< times the Courant number: no check is needed below it, rad/s
    void           add(std::unique_ptr<Part> part);
    /// What the step tells the parts.
    Step step_with(const unsigned int due)
    {
      return {state, inverse_mass, levels, due, totals};
    }
    /// This rank's shares of the sums of all parts.
    void set_part_sums();
    /// The sums of the carrier of this number.
    const double *sums_of_carrier(const std::size_t number) const
    {
      return rank_sums.data() + first_sum[part_of_carrier[number]];
    }
    /// Sum of an energy over the parts, J.
    template <typename Energy>
    double sum_of_parts(const Energy &energy) const
    {
      double sum = 0.;
      for (const auto &part : parts)
        sum += energy(*part);
      return sum;
    }
    std::vector<MovingLoad> loads_of_carriers() const;
    /// Ask the carriers where they are.
    void find_motions();
    void hold_guided_nodes(NodalField &field) const;
    /// Kinetic energy from the velocities half a step back and the change that the cells' forces cause in
    /// half a step.
    ReproducibleSum<double> kinetic_energy_of_nodes(NodalField cell_forces) const; ///< of this rank's own
    ReproducibleSum<double> potential_of_nodes() const;                            ///< of this rank's own
    StrainEnergySums        strain_energy_sums() const;                            ///< of this rank's cells
    /// What the energies of nodes, cells and parts are at present, J. Collective.
    struct Energies
    {
      double       kinetic, potential;
      StrainEnergy strain;
      LedgerSums   totals;
    };
    Energies energies(const NodalField &cell_forces) const;
    /// Forces of the cells, before hanging nodes pass theirs to their parents.
    NodalField cell_forces() const;
    /// Contribution of damping to the forces of the cells of all ranks on nodes that do not hang, N. @param
    /// forces the present cell_forces(). @returns the dissipated power with the velocities of half a step
    /// back, of all ranks, W. Collective.
    double damping_forces(const NodalField &forces, NodalField &damping) const;
    /// That the forces on this rank's own nodes take with the present velocities, summed over all ranks, W.
    /// Collective.
    double power_of(const NodalField &forces) const;
    /// Energy dissipated from the step of the last sample to the previous step, if the power is this much at
    /// present, J.
    double damping_since_sample(const double power) const;
    /// What damping does in a step that samples it.
    struct DampingSample
    {
      NodalField force; ///< N
      double     power; ///< that it takes with the velocities before the step, W
    };
    DampingSample begin_damping_sample() const;           ///< before a step
    void end_damping_sample(const DampingSample &sample); ///< when the velocities of the step are known

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

    /// Number of the part that carries a node's body; -1: none.
    int carrier_of(const unsigned int node) const
    {
      return carrier_of_body[mesh.node_bodies[node]];
    }

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
      return parameters.mass_damping > 0. || (run.carrier >= 0 && motions[run.carrier].compensation != 0.);
    }

    // What step() does, in this order, to nodes up to the level that is due.
    void sum_forces(const unsigned int due); ///< over the ranks
    void add_loads(const unsigned int due);  ///< forces from outside
    void add_contact_forces();
    void advance_nodes(const unsigned int due);

    /// Save, for shared nodes up to this level, the load with which their forces begin.
    void keep_loads_of_shared(const unsigned int due);

    DynamicsParameters  parameters;
    NodeLevels          levels;
    double              gain_of_levels = 1.;
    NodalField          force_before;            ///< of the cells of a level, on nodes that share them
    NodalField          given_to_owners;         ///< of these forces, what is one rank's alone
    std::vector<double> true_mass, inverse_mass; ///< by node, kg; 1/kg of scaled mass, 0 where prescribed
    std::vector<double> added_mass;              ///< @see PartOf
    std::vector<LoadOfShared>                          loads_of_shared;
    BodyLoads                                          next_loads; ///< of level 0 in its next step
    std::vector<char>                                  fixed, carried;
    std::vector<std::pair<unsigned int, unsigned int>> guided; ///< node, direction
    Contact                                           *contact = nullptr;
    std::vector<std::unique_ptr<Part>>                 parts;
    std::vector<std::size_t>                           first_sum; ///< of each part in rank_sums
    std::vector<double>                                rank_sums; ///< what parts sum over the ranks in a step
    std::vector<CarriesBody *>                         carriers;
    std::vector<std::size_t>                           part_of_carrier; ///< its number among the parts
    std::vector<int>                                   carrier_of_body; ///< -1: none
    std::vector<RigidMotion>                           motions;         ///< of carriers at present
    Quanta                                             quanta;

    StepTimes     spent;
    LedgerTotals  totals; ///< accumulated by step()
    double        start_kinetic = 0., start_potential = 0.;
    StrainEnergy  start_strain;
    double        start_external_work = 0., start_gross_work = 0.; ///< of the parts
    double        start_springs = 0., start_dissipated = 0.;
    double        last_damping_power = 0.;
    std::uint64_t last_damping_step  = 0;
    bool          damping_is_sampled = false; ///< since start()
  };
} // namespace tread

#endif
