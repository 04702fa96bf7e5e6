// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_moving_bodies_h
#define tread_dynamics_moving_bodies_h

#include <tread/contact/contact.h>
#include <tread/dynamics/node_levels.h>
#include <tread/dynamics/part.h>
#include <tread/dynamics/parts.h>
#include <tread/dynamics/state.h>
#include <tread/mesh/mesh.h>
#include <tread/solid/matched_surface.h>
#include <tread/solid/solid.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tread
{
  /// What moves: the nodes of all bodies with their masses, their state and the time steps in which they
  /// move, what holds them, the parts that act on them or carry them, and the contact between them. How it
  /// moves is said by whoever advances it, as ExplicitDynamics in time, or Relaxation to the equilibrium.
  struct MovingBodies
  {
    MovingBodies(const Mesh &mesh, const Solid &solid, const DynamicsParameters &parameters);
    MovingBodies(const MovingBodies &)            = delete; // parts refer to what it has
    MovingBodies &operator=(const MovingBodies &) = delete;

    /// Make a part of this type and add it: it acts behind those that were added before. Collective.
    /// @param arguments of its constructor behind PartOf
    template <typename P, typename... Arguments>
    P &add(Arguments &&...arguments)
    {
      auto part = std::make_unique<P>(PartOf{mesh, solid, parameters, quanta, true_mass, added_mass, state},
                                      std::forward<Arguments>(arguments)...);
      P   &made = *part;
      append(std::move(part));
      return made;
    }

    /// Fix these nodes (of this rank) at their positions.
    void fix_nodes(const std::vector<unsigned int> &nodes);

    /// Prevent these nodes (of this rank) from moving in a direction (0 to 2).
    void guide_nodes(const std::vector<unsigned int> &nodes, const unsigned int direction);
    void hold_guided_nodes(NodalField &field) const;

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
    /// What ranks wait for one another: the largest cost of a rank's cells in a step over the mean of the
    /// ranks, both summed over 2^max_level steps, in each of which the ranks wait for the one whose cells of
    /// the levels in turn are dearest. 1: all are ready at once. @param cost of a cell in one step (of level
    /// 0), in any unit. Collective.
    double imbalance_of_cost(const Mesh::CellCost &cost) const;
    /// Steps with levels that update as many cells as this number of steps would without: what is done for
    /// all cells now and then takes the same share of the time.
    std::uint64_t steps_worth(const unsigned int steps_of_all_cells) const
    {
      return static_cast<std::uint64_t>(steps_of_all_cells * gain_of_levels);
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
    std::vector<double> free_inverse_masses() const; ///< scaled, 1/kg: 0 where motion is prescribed
    /// Mass of a body, kg, and what its fastest cells were given besides to slow them down.
    struct MassOfBody
    {
      double own = 0., added = 0.;
    };
    /// By body. Collective.
    std::vector<MassOfBody> masses_of_bodies() const;

    /// Number of the part that carries a node's body; -1: none.
    int carrier_of(const unsigned int node) const
    {
      return parts.carriers_of_bodies()[mesh.node_bodies[node]];
    }

    /// Of the hourglass modes of the uppermost layer of cells over their stiffness, s.
    double surface_damping_time() const
    {
      return solid.surface_damping() * state.time_step;
    }

    /// "at x = ..., y = ..., z = ... mm of the rail": place (m) and body of what is worst. The lowest of the
    /// ranks on which `is_worst` is set says where. Collective.
    std::string place_of_worst(const bool              is_worst,
                               const dealii::Point<3> &place,
                               const unsigned int      body) const;
    /// The same of a cell's centre before it was deformed.
    std::string place_of_worst_cell(const bool is_worst, const unsigned int cell) const;

    State                    state;
    const Mesh              &mesh;
    const Solid             &solid;
    MatchedSurface           matched_surface; ///< of the cells near the contact, as it was last searched
    const DynamicsParameters parameters;
    NodeLevels               levels;
    double                   gain_of_levels = 1.;
    std::vector<double> true_mass, inverse_mass; ///< by node, kg; 1/kg of scaled mass, 0 where prescribed
    std::vector<double> added_mass;              ///< @see PartOf
    std::vector<char>   fixed, carried;
    std::vector<std::pair<unsigned int, unsigned int>> guided; ///< node, direction
    Contact                                           *contact = nullptr;
    Parts                                              parts;
    Quanta                                             quanta;

  private:
    void append(std::unique_ptr<Part> part);
    void set_levels();
    /// Masses of the cells, each times a factor, by node: condensed and summed over the ranks, the same on
    /// any number of them, kg. Collective.
    std::vector<double> nodal_masses(const std::function<double(unsigned int)> &factor_of_cell) const;
  };
} // namespace tread

#endif
