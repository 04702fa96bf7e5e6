// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_explicit_dynamics_h
#define tread_dynamics_explicit_dynamics_h

#include <tread/base/archive.h>
#include <tread/base/reproducible_sum.h>
#include <tread/contact/contact.h>
#include <tread/dynamics/energy_ledger.h>
#include <tread/dynamics/node_levels.h>
#include <tread/dynamics/rail_beam.h>
#include <tread/mesh/mesh.h>
#include <tread/solid/matched_surface.h>
#include <tread/solid/solid.h>
#include <tread/track/rail_base.h>
#include <tread/track/supports.h>
#include <tread/track/wheel_hub.h>

#include <array>
#include <functional>
#include <memory>
#include <string>

namespace tread
{
  struct DynamicsParameters
  {
    /// Time step over the critical one.
    double courant_number = 0.9;
    /// Stiffness-proportional damping: internal forces are taken at x + beta v with
    /// beta = damping_steps time steps.
    double damping_steps = 0.1;
    /// Mass-proportional damping of the motion relative to the rigid motion, 1/s: for quasi-static scenes.
    double mass_damping  = 0.;
    double density_scale = 1.;
    double gravity       = 9.81; ///< m/s^2, along -z
    /// A cell with more strain (Green-Lagrange, Frobenius' norm) stops a run.
    double largest_strain = 0.5;
    /// A cell with less of its volume stops a run: where this is pressed so far, strains that are smaller
    /// than the largest allowed are large as well.
    double least_volume = 0.3;
    /// A node that moves faster is part of an instability, m/s. A wheel's rim moves at up to twice the speed
    /// of the train, 170 m/s at 300 km/h, and a pressure wave of 1000 m/s would carry a stress of rho c v =
    /// 46 GPa, a hundred times the strength of steel. An unstable motion grows exponentially, so that half or
    /// double the limit finds it a few steps earlier or later.
    double largest_speed = 1e3;
    /// Interval, in steps, at which the energy dissipated by stiffness damping and bulk viscosity is sampled,
    /// with two more force evaluations. It is assumed to vary linearly in between; with 1 it is counted
    /// exactly. The number is a prime, because a vibration whose period divides it would always be sampled in
    /// the same phase.
    unsigned int steps_between_damping_samples = 47;
  };

  /// Seconds that this rank spent since the start.
  struct StepTimes
  {
    double internal_forces = 0., contact = 0., search = 0., communication = 0., nodes = 0.;
  };

  /// Central differences for all bodies, the hubs of wheels and the contact between them.
  ///
  /// With levels of cells (SolidParameters::max_level) the cells of level l are evaluated every 2^l-th step
  /// only, and nodes move with the step of their fastest cell. Nodes between levels feel the slow cells'
  /// forces steadily, corrected by a push when these are evaluated: an asynchronous variational integrator
  /// (Lew, Marsden, Ortiz & West 2003) in which the steady part of the slow forces belongs to the fast ones.
  /// Needs some stiffness damping (0.1): without it these integrators resonate (Fong, Darve & Lew 2008).
  /// Nodes of the contact surfaces and of the hub and cells of plastic zones are of level 0.
  ///
  /// v^(n+1/2) = v^(n-1/2) + dt M^-1 (f_int(x^n + beta v^(n-1/2)) + f_ext + G^T P/dt),
  /// x^(n+1) = x^n + dt v^(n+1/2), with the impulses P such that gaps at n+1 are closed or open
  /// and Coulomb's law holds for v^(n+1/2).
  class ExplicitDynamics
  {
  public:
    ExplicitDynamics(const Mesh &mesh, const Solid &solid, const DynamicsParameters &parameters);

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

    /// Make a body a wheel: its support nodes are attached to a rigid hub. The centrifugal force of the
    /// density added by scaling, which does not exist in reality, is compensated on this body, at the given
    /// angular velocity until start() takes that of the hub. The body has not been made a wheel before.
    void attach_hub(WheelHub &hub, const unsigned int body, const double nominal_angular_velocity);

    /// Attach a body's support nodes to a base that moves.
    void attach_rail_base(RailBase &base, const unsigned int body);

    void attach_contact(Contact &contact);

    /// Damp the free nodes of a body by a force of -rate(p) m v, with a rate (1/s) that depends on their
    /// position in the reference configuration: absorbing ends. The energy dissipated counts as damping.
    void damp_nodes(const unsigned int body, const std::function<double(const dealii::Point<3> &)> &rate);

    /// @param rail_material material of the supported rail: a beam of it is used to find the equilibrium at
    /// the start.
    void attach_supports(Supports &supports, const ElasticMaterial &rail_material);

    /// Set the velocities of rail and sleepers (half a step back) to those with which the deflection of a
    /// beam under the hubs' loads follows the hubs, and those of the hubs to their motion along this path.
    /// All hubs run equally fast. To be called before set_wheel_velocities().
    void set_track_velocities();

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

    /// Set the velocities of the wheels' nodes to those of their hubs' rigid motion half a step ago.
    void set_wheel_velocities();

    /// Set inertia and time step and reset the ledger; call after everything is attached and set.
    void start();

    void step();

    /// Whether all nodes are at the same instant, which only levels of time steps can prevent.
    bool synchronised() const
    {
      return n_steps % (std::uint64_t(1) << max_level()) == 0;
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
      return ideal_gain_of_levels(max_level());
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

    /// @throws WentWrong if nodes move faster than is possible in steel. Collective.
    void check_stability() const;

    /// Position of a node, m.
    Vector3 position(const unsigned int node) const
    {
      return x_damped[node] - damping_time * v[node];
    }
    NodalField positions() const;
    void       set_position(const unsigned int node, const Vector3 place)
    {
      x_damped[node] = place + damping_time * v[node];
    }

    /// Velocities, half a step back, m/s. They may be set from outside only between relax() and start(),
    /// where positions do not depend on them.
    NodalField v;
    NodalField external_force; ///< N, by node; empty if none
    /// History of the cells of plastic zones, at x + beta v of the last step.
    PlasticHistory history;
    double         time = 0., time_step = 0.;
    std::uint64_t  n_steps = 0;
    StepTimes      times;

    /// Memory of this rank's nodes in this object, bytes.
    std::size_t memory_consumption() const
    {
      return v.size() * (3 * sizeof(Vector3) + 2 * sizeof(double) + 3) + levels.memory_consumption() +
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

    /// Set the time step, the inverse masses and the pairs in contact.
    void set_inertia();
    void prepare_step(); ///< the state that step() leaves for the next one
    /// Of the hourglass modes of the uppermost layer of cells over their stiffness, s.
    double surface_damping_time() const
    {
      return solid.surface_damping() * time_step;
    }
    void                set_damping_time(const double beta); ///< positions stay
    std::vector<double> free_inverse_masses() const;         ///< 0 where motion is prescribed
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
    void           set_hub_sums(std::vector<double> &sums) const;
    std::size_t    n_sums_of_hubs() const
    {
      return n_hub_sums * wheels.size() + (rail_base ? n_base_sums : 0);
    }
    void size_rank_sums();
    /// Work from outside on all hubs and the rail's base, and the sum of its absolute amounts, J.
    std::array<double, 2> work_on_hubs() const;
    void                  hold_guided_nodes(NodalField &field) const;
    void                  move_hub_nodes(); ///< and those of the rail's base
    /// Kinetic energy from the velocities half a step back and the change that the cells' forces cause in
    /// half a step.
    double       kinetic_energy(NodalField cell_forces) const;
    double       body_potential() const;
    StrainEnergy strain_energy() const;
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

    /// A body on a rigid hub.
    struct Wheel
    {
      WheelHub                 *hub;
      unsigned int              body;
      double                    nominal_angular_velocity; ///< rad/s
      std::vector<unsigned int> nodes{};                  ///< that the hub carries
      std::vector<Vector3>      reference{};              ///< of these nodes, relative to the axle
    };

    /// The wheel that a node is on; -1: none.
    int wheel_of(const unsigned int node) const
    {
      return wheel_of_body[mesh.node_bodies[node]];
    }

    /// A node with damping of its own.
    struct DampedNode
    {
      unsigned int node;
      double       rate; ///< 1/s
      Vector3      load; ///< the force on it in the present step, times 2^level, N
    };

    /// Add to the forces on damped nodes that move in this step.
    void add_local_damping(const unsigned int due);
    /// Count the work of these forces when all forces of the step are known.
    void count_local_damping(const unsigned int due);

    /// Mass damping relative to the rigid motion, and compensation of the centrifugal force of the density
    /// added by scaling: sums over this rank's own nodes, weighted with their scaled masses.
    struct BodyLoads
    {
      struct OfWheel
      {
        Vector3 arms{};     ///< from the axle to the wheel's nodes, at right angles to it, kg m
        Vector3 drag{};     ///< of mass damping on the wheel's nodes, N
        Vector3 products{}; ///< of these arms with the places along the axle, kg m^2
        Vector3 moments{};  ///< of that drag about the wheel's middle, N m

        void operator+=(const OfWheel &other)
        {
          arms += other.arms;
          products += other.products;
          drag += other.drag;
          moments += other.moments;
        }
      };

      explicit BodyLoads(const std::size_t n_wheels = 0)
        : wheels(n_wheels)
      {
      }

      std::vector<OfWheel> wheels;
      Vector3              loss{}; ///< by this drag in a step, J: its parts along x, y and z
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
    template <typename Quanta, typename Loop>
    void with_rounded_loads(const Quanta quanta,
                            const Run   &run,
                            const double factor,
                            BodyLoads   &sums,
                            const Loop  &loop) const;

    bool has_body_loads(const Run &run) const
    {
      return parameters.mass_damping > 0. || (run.wheel >= 0 && compensation(wheels[run.wheel]) != 0.);
    }

    /// Centripetal acceleration per radius that compensates the density added by scaling, 1/s^2.
    double compensation(const Wheel &wheel) const
    {
      return (1. - 1. / parameters.density_scale) * wheel.nominal_angular_velocity *
             wheel.nominal_angular_velocity;
    }

    // What step() does, in this order, to nodes up to the level that is due.
    void      sum_forces(const unsigned int due); ///< over the ranks
    BodyLoads add_loads(const unsigned int due);  ///< forces from outside. @returns sums for the hubs
    void      set_rank_sums(const BodyLoads &loads);
    void      add_contact_forces();
    void      advance_hubs();
    void      advance_nodes(const unsigned int due);

    /// Save, for shared nodes up to this level, the load with which their forces begin.
    void keep_loads_of_shared(const unsigned int due);

    /// Store or restore positions and velocities of the nodes.
    void serialize_nodes(Archive &archive);

    DynamicsParameters  parameters;
    NodeLevels          levels;
    NodalField          force_before;    ///< of the cells of a level, on nodes that share them
    NodalField          given_to_owners; ///< of these forces, what is one rank's alone
    NodalField          force;
    NodalField          x_damped;                ///< x + beta v: all that a step needs of positions
    double              damping_time = 0.;       ///< beta, s: set by start(), 0 at rest
    std::vector<double> true_mass, inverse_mass; ///< by node, kg; 1/kg of scaled mass, 0 where prescribed
    std::vector<LoadOfShared>                          loads_of_shared;
    BodyLoads                                          next_loads; ///< of level 0 in its next step
    std::vector<char>                                  fixed, carried;
    std::vector<std::pair<unsigned int, unsigned int>> guided; ///< node, direction
    std::vector<DampedNode>                            damped_nodes;
    std::vector<Wheel>                                 wheels;
    std::vector<int>                                   wheel_of_body; ///< number in wheels, -1: none
    Contact                                           *contact  = nullptr;
    Supports                                          *supports = nullptr;
    std::unique_ptr<RailBeam>                          rail_beam;
    RailBase                                          *rail_base = nullptr;
    std::vector<unsigned int>                          base_nodes;
    /// Sums over the ranks in a step: of each wheel force and moment on the hub, moments of the
    /// compensated loads, and moments on both wheels of a flexible axle; then the force on the rail's base;
    /// then those of the supports.
    std::vector<double>           rank_sums;
    static constexpr unsigned int n_hub_sums = 18, n_base_sums = 3;

    /// What is rounded before sums over nodes or ranks, so that they do not depend on the ranks; 0: nothing.
    template <typename Q>
    struct QuantaOf
    {
      Q force;     ///< on a node, N
      Q on_hubs;   ///< forces and moments that add up to those of hubs, N and N m
      Q moments;   ///< of masses of a wheel's nodes, kg m and kg m^2
      Q loss;      ///< of one node in one step, J
      Q stiffness; ///< of which masses of the relaxation are made, N/m
    };
    QuantaOf<Quantum> quanta;

    /// Accumulated by step(), J: this rank's shares of what the ledger has by these names.
    struct Totals
    {
      ReproducibleSum<double> external_work, gross_work, friction, contact, damping, plastic,
        contact_on_nodes;
    };
    Totals                totals;
    double                start_kinetic = 0., start_potential = 0.;
    StrainEnergy          start_strain;
    std::array<double, 2> start_hub_work{}; ///< @see work_on_hubs
    double                start_springs = 0., start_dissipated = 0.;
    double                last_damping_power = 0.;
    std::uint64_t         last_damping_step  = 0;
    bool                  damping_is_sampled = false; ///< since start()
  };
} // namespace tread

#endif
