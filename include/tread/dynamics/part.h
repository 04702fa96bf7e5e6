// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_part_h
#define tread_dynamics_part_h

#include <tread/base/archive.h>
#include <tread/dynamics/dynamics_parameters.h>
#include <tread/dynamics/energy_ledger.h>
#include <tread/dynamics/node_levels.h>
#include <tread/dynamics/state.h>
#include <tread/mesh/mesh.h>
#include <tread/solid/solid.h>

#include <cstring>
#include <functional>
#include <type_traits>
#include <vector>

namespace tread
{
  /// What is rounded before sums over nodes or ranks, so that they do not depend on the ranks; 0: nothing.
  template <typename Q>
  struct QuantaOf
  {
    Q force;     ///< on a node, N
    Q on_hubs;   ///< forces and moments that add up to those on a rigid part, N and N m
    Q moments;   ///< of masses of nodes that turn with it, kg m and kg m^2
    Q loss;      ///< of one node in one step, J
    Q stiffness; ///< of which masses of the relaxation are made, N/m
  };
  using Quanta = QuantaOf<Quantum>;

  /// What a part is made of besides its own data; all of it lives as long as the integrator.
  struct PartOf
  {
    const Mesh                &mesh;
    const Solid               &solid;
    const DynamicsParameters  &parameters;
    const Quanta              &quanta;
    const std::vector<double> &true_mass; ///< of nodes, condensed and summed: kg; 0: it hangs
    /// Of the same nodes what the fastest cells were given to slow them down, kg; empty: none was
    const std::vector<double> &added_mass;
    const State               &state; ///< as it is at present
  };

  /// What a part is told of the step in which it acts.
  struct Step
  {
    State                     &state;
    const std::vector<double> &inverse_mass; ///< by node, 1/kg of scaled mass, 0 where motion is prescribed
    const NodeLevels          &levels;
    unsigned int               due;    ///< nodes up to this level move
    LedgerTotals              &totals; ///< this rank's shares
  };

  /// A load that moves along the rail.
  struct MovingLoad
  {
    double x, velocity_x; ///< m, m/s
    double force;         ///< upwards, N
  };

  /// A body that is far softer as a whole than in relative motions of its cells. @see SoftMotions
  struct SoftBody
  {
    enum class Shape
    {
      line,  ///< along x, on springs
      ring,  ///< around the y axis through its middle, on what holds it inside
      piece, ///< on springs
    };
    unsigned int              number;
    Shape                     shape;
    Vector3                   middle{}; ///< of a ring, m
    std::vector<unsigned int> held{};   ///< nodes of a ring that do not move with it, of this rank
  };

  /// Something that acts on nodes, or carries them: supports, a wheel's hub, absorbing ends. The integrator,
  /// its ledger, its start and its checkpoints ask all parts in the order in which they were added and know
  /// none of them by name. A part is called some ten times in a step, never for each node.
  ///
  /// All functions are called by all ranks alike. Fields have a row for each node of this rank.
  class Part
  {
  public:
    virtual ~Part() = default;

    /// Nodes of this rank whose motion the part prescribes.
    virtual std::vector<unsigned int> carried_nodes() const
    {
      return {};
    }
    /// Nodes of this rank that have to move in every step.
    virtual std::vector<unsigned int> nodes_of_every_step() const
    {
      return carried_nodes();
    }

    // A step, in this order.

    /// Forces that only this rank knows, before they are summed over the ranks.
    virtual void add_forces(NodalField &)
    {
    }
    /// Forces that each rank with a copy of a node knows, on the nodes that move in this step.
    virtual void add_loads(Step &)
    {
    }
    /// Numbers that the part sums over the ranks in each step: @see PartWithSums.
    virtual std::size_t n_sums() const
    {
      return 0;
    }
    /// This rank's shares of these numbers, when all forces but the contact's are known.
    virtual void set_sums(const State &, const std::vector<double> &, double *) const
    {
    }
    /// Move what the part has of its own, when all forces are known, and count the work of its forces.
    /// @param sums over the ranks
    virtual void advance(Step &, const double *)
    {
    }
    /// Move the nodes that the part carries, when all others have been moved.
    virtual void place_nodes(State &) const
    {
    }

    // The critical time step.

    /// Sums of the rows of stiffness (in [0], N/m) and of damping (in [1], N s/m) on the nodes of this rank.
    virtual void add_row_sums(NodalField &) const
    {
    }
    /// The largest of what the part moves itself, over its masses: 1/s^2 and 1/s.
    struct OwnRates
    {
      double stiffness = 0., damping = 0.;
    };
    virtual OwnRates own_rates(const NodeLevels &) const
    {
      return {};
    }

    // Energies of all ranks, J. Velocities are those of half a step back.

    /// Forces that have a potential, of this rank alone.
    virtual void add_spring_forces(NodalField &) const
    {
    }
    virtual double kinetic_energy(const double /*time_step*/) const
    {
      return 0.;
    }
    virtual double spring_energy() const
    {
      return 0.;
    }
    /// Of weight, half a step back.
    virtual double potential(const double /*time_step*/) const
    {
      return 0.;
    }
    virtual double dissipated() const ///< so far
    {
      return 0.;
    }
    virtual double external_work() const ///< so far
    {
      return 0.;
    }
    virtual double gross_work() const ///< sum of its absolute amounts
    {
      return 0.;
    }

    // The start.

    /// Loads at rest on nodes that are this rank's own.
    virtual void add_static_loads(NodalField &) const
    {
    }
    /// Take the present positions as a state of rest. @pre state.damping_time is 0: they are x_damped
    virtual void set_at_rest(const State &)
    {
    }
    /// The equilibrium is found.
    virtual void balance()
    {
    }
    /// Bodies that are to be balanced as a whole too. Collective.
    virtual std::vector<SoftBody> soft_bodies(const State &) const
    {
      return {};
    }
    /// Set velocities to those with which the part's deflection follows loads that move. @param constrain to
    /// be called for velocities of nodes that have been set. @returns how fast what presses at the place of
    /// each load goes up, m/s; nothing: this part does not bend
    virtual std::vector<double> follow(State &,
                                       const std::vector<MovingLoad> &,
                                       const std::function<void(NodalField &)> & /*constrain*/)
    {
      return {};
    }
    /// The motion begins.
    virtual void start()
    {
    }

    /// Store or restore the state. Collective.
    virtual void serialize(Archive &)
    {
    }
  };

  /// A part that sums a structure of numbers over the ranks in each step. @tparam Sums of double alone
  template <typename Sums>
  class PartWithSums : public Part
  {
    static_assert(std::is_trivially_copyable_v<Sums> && sizeof(Sums) % sizeof(double) == 0);

  public:
    std::size_t n_sums() const final
    {
      return sizeof(Sums) / sizeof(double);
    }
    void set_sums(const State &state, const std::vector<double> &, double *numbers) const final
    {
      const Sums sums = sums_of_rank(state);
      std::memcpy(numbers, &sums, sizeof(Sums));
    }
    void advance(Step &step, const double *numbers) final
    {
      advance_with(step, from(numbers));
    }

  protected:
    virtual Sums sums_of_rank(const State &state) const             = 0;
    virtual void advance_with(Step &step, const Sums &of_all_ranks) = 0;

    static Sums from(const double *numbers)
    {
      Sums sums;
      std::memcpy(&sums, numbers, sizeof(Sums));
      return sums;
    }
  };
} // namespace tread

#endif
