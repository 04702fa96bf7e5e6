// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_contact_h
#define tread_contact_contact_h

#include <tread/base/archive.h>
#include <tread/contact/contact_arrays.h>
#include <tread/contact/contact_records.h>
#include <tread/contact/contact_surfaces.h>
#include <tread/contact/mortar.h>
#include <tread/contact/prescribed_contact.h>
#include <tread/contact/strips.h>
#include <tread/contact/until_refresh.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace tread
{
  /// Contact between the surface of one body and those of others, each of which touches it in a place of its
  /// own: search, mortar coupling and impulses of each step.
  ///
  /// All ranks know the same small problem: each is sent the predicted velocities that its strip needs and
  /// finds the strip's impulses, these are gathered, and each rank applies those on its own nodes.
  class Contact
  {
    UntilRefresh until_refresh; ///< stands before what refers to it

  public:
    Contact(const Mesh                        &mesh,
            const ContactParameters           &parameters,
            std::shared_ptr<const FrictionLaw> friction);

    /// Nodal inverse masses (1/kg; 0 where motion is prescribed), by node of this rank. Collective.
    void set_inverse_masses(const std::vector<double> &inverse_masses);

    /// @returns the law until now, for who must restore it.
    std::shared_ptr<const FrictionLaw> set_friction(std::shared_ptr<const FrictionLaw> law)
    {
      return std::exchange(friction, std::move(law));
    }

    /// Ask for the friction factors of places and nodes anew.
    void renew_friction();

    /// Friction depends on the pressure (Pa): another factor of the law's coefficient. Not while the
    /// equilibrium at the start is found, whose steps have no unit of time.
    void vary_friction_with_pressure(std::function<double(double)> factor)
    {
      pair_friction.of_pressure = std::move(factor);
    }

    /// Distribute to all ranks the data that only the rank of a constraint or node has. Collective.
    void complete_state();

    /// Multiply the impulses that start the next step, e.g. by the ratio of two time steps.
    void scale_impulses(const double factor);

    /// Find the pairs that may touch and integrate their coupling. Collective. To be called when
    /// refresh_due() says so and whenever positions were set from outside.
    /// @param x, v positions and velocities of this rank's nodes; @param time_step s.
    void refresh(const Vector3 *x, const Vector3 *v, const double time_step);

    bool refresh_due() const
    {
      return until_refresh.is_due();
    }

    /// Sum extra (n numbers) over the ranks in their order, and give each rank the predicted velocities of
    /// its strip's nodes: v + time_step * force / m. Collective.
    void predict(const Vector3 *v, const Vector3 *force, const double time_step, std::vector<double> &extra);

    /// Solve for the impulses and add them, divided by time_step, to the forces on this rank's nodes.
    /// Nodes with inverse mass 0 keep their velocity. Collective.
    CoulombSolverResult solve(const double time_step, Vector3 *force);

    /// Total impulse on the master surfaces in the last step, N s.
    Vector3 total_impulse() const;

    /// Total impulse on the given body in the last step, N s.
    Vector3 total_impulse_on(const unsigned int body) const;
    /// Total impulse on the master surfaces from slave nodes whose reference position is at smaller y, N s.
    Vector3 total_impulse_below(const double y) const;

    /// This rank's share, J.
    const ContactWork &last_work() const
    {
      return work;
    }

    /// Creepage omega R / V - 1 at which the loaded surfaces roll without mean slip: the difference of their
    /// stretch along x, weighted with the load. In half-space theory it is zero for like bodies; for wheels
    /// and rails of finite size it is about 1e-5. Collective; x: nodal positions of this rank.
    double free_rolling_creepage(const Vector3 *x, const unsigned int master_body) const;

    /// Slave nodes that carry an impulse after the last step, ordered by number. Collective.
    std::vector<ContactNodeState> active_nodes() const;

    /// Impulse on each surface node, of slave and masters, in the last step, by its number, N s. All ranks
    /// know all of them.
    std::vector<Vector3> surface_impulses() const;

    /// Sum what pairs do from now on, and hand it over before they change. Each pair is counted on one rank.
    void record_pairs(std::function<void(const PairRecord &)> take)
    {
      take_record = std::move(take);
      pairs.totals.assign(problem.constraints.size(), {});
    }
    /// To be called after each step that counts. @pre record_pairs()
    void add_step_to_record(double time_step);
    /// Hand over what there is now.
    void hand_over_record();

    /// Distribute to all ranks the normals of pairs, each of which only some follow. Collective.
    void complete_normals();

    /// The impulse of the last step on each surface node of this rank's own that is pressed: its part along
    /// the pairs' normals into the body, positive, and the length of the rest, N s. @pre complete_normals()
    void visit_impulses(
      const std::function<void(unsigned int node, double normal, double tangential)> &visit) const;

    /// How many ranks share the sweeps over the patch.
    unsigned int n_sweeping_ranks() const
    {
      return strips.n_strips();
    }

    /// Nodes of this rank on both surfaces that touched at the last refresh, or will have begun to touch
    /// before the next one at the speed that they had.
    std::vector<unsigned int> nodes_near() const;

    /// Position of a node at the rim of the contact faces of either body that was loaded in the last step
    /// (m): beyond the rim contact would be missed.
    std::optional<Vector3> contact_at_rim() const;

    /// Begin the next refresh from what pairs of another mesh of the same bodies have, whose slave nodes are
    /// known by their places: impulses and, of friction with a memory, coefficients. Collective.
    void go_on_from(Contact &before);

    /// Store or restore the state, after set_inverse_masses(): all but friction law, what is prescribed and
    /// what a step finds of velocities. Collective.
    void serialize(Archive &archive);

    const ContactSurfaces surfaces;
    PrescribedContact     prescribed; ///< tractions, sliding and friction factors from place to place
    /// Number of steps in which the sweeps ended before the tolerance was reached, without those of the
    /// start.
    std::uint64_t n_unconverged_steps = 0;

  private:
    /// What a pair that touched nothing in the last step slips in this one before it touches, over the step:
    /// the share of the step that its gap still takes to close, at the slip of the last step. Gap and slip
    /// still to come both fall with the same power of the distance from the edge of contact, so the share is
    /// linear in the gap. A node would adhere from the beginning of the step else, as if it entered half a
    /// step earlier. @param gap_over_step m/s.
    Vector3 slip_before_entry(const ContactProblem::Constraint &constraint,
                              const double                      gap_over_step,
                              const Vector3                     sliding) const;
    /// Let the coefficients of the strip's pairs follow their slip in this step.
    void age_friction(const double time_step);
    /// Of the present pairs.
    MemoryOfNodes memory_of_nodes();
    /// Work of the strip's pairs in this step, from their impulses and the mean velocities of their nodes.
    void add_work_of_pairs();
    /// Largest speeds of this rank's own slave and master nodes, m/s.
    std::array<double, 2> largest_speeds(const Vector3 *v) const;
    /// Rotate the normals with the slave faces between two refreshes.
    void update_normals();
    /// Complete values by constraint that each rank has for its strip only. Collective.
    template <typename Values>
    void gather_strips(Values &values) const;
    void compact(const MortarCoupling            &coupling,
                 const std::vector<unsigned int> &chosen,
                 const std::vector<Vector3>      &impulse_of_node,
                 const std::vector<Vector3>      &x);
    /// Whether this rank counts what all of its strip's pairs do: where all ranks sweep all pairs only one
    /// does.
    bool counts_pairs() const;
    /// Whether pairs, nodes and strips that were restored belong together.
    bool is_consistent(const std::vector<unsigned int> &begin_of_strip) const;
    /// Allocate the arrays used in each step for the present pairs and involved nodes.
    /// @param begin_of_strip division into strips, for the same pairs and number of ranks; if empty, new
    /// strips are made.
    void make_room(const std::vector<unsigned int> &begin_of_strip = {});

    MPI_Comm                                  comm;
    ContactParameters                         parameters;
    std::shared_ptr<const FrictionLaw>        friction;
    std::vector<double>                       inverse_mass; ///< by surface node
    double                                    face_size;
    ContactProblem                            problem;
    std::unique_ptr<FirstRanks>               first_ranks;
    Strips                                    strips;
    std::vector<unsigned int>                 involved;         ///< surface nodes, by compact number
    std::vector<unsigned int>                 near_contact;     ///< surface nodes (@see nodes_near)
    std::vector<ContactSurfaces::HangingNode> involved_hanging; ///< compact numbers
    std::vector<unsigned int> swept_nodes; ///< compact numbers of those that the strip's sweeps move

    ContactNodes nodes;
    ContactPairs pairs;
    PairFriction pair_friction; ///< coefficients by constraint of the strip, factors of all
    std::function<void(const PairRecord &)> take_record; ///< none: pairs are not recorded
    PredictionExchange                      exchange;
    EffectsOfPairs                          effects;
    std::vector<unsigned int>               rim_nodes;   ///< compact numbers
    std::vector<std::vector<unsigned int>>  slave_faces; ///< of each surface node: numbers of its slave faces
    /// Compact numbers of the corners of the slave faces around each constraint, four a face.
    std::vector<std::vector<unsigned int>> corners_around;
    unsigned int                           steps_since_normals = 0;
    std::vector<unsigned int>    own_nodes[2]; ///< local numbers of this rank's own slave and master nodes
    ContactWork                  work;
    std::optional<MemoryOfNodes> from_other_mesh; ///< for the next refresh
  };
} // namespace tread

#endif
