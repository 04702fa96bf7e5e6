// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_model_model_h
#define tread_model_model_h

#include <tread/contact/contact.h>
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/mesh/mesh.h>
#include <tread/model/rolling_wheel.h>
#include <tread/model/wheelset_at_solution.h>
#include <tread/scene/scene.h>
#include <tread/solid/solid.h>

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace tread
{
  class RailBase;
  class RailOnBeam;
  class Supports;

  /// Where the cells of a model are fine: the number of the window, and what touched in its middle when it
  /// began, arc length on the tread (m).
  struct WindowPlace
  {
    unsigned int number = 0;
    double       tread  = 0.;
  };

  /// Mass that 'Time stepping/Least step (us)' adds to the fastest cells: kg, its share of that of the
  /// bodies' cells, and an estimate of what it does to the contact force.
  struct AddedMass
  {
    double rail = 0., rail_share = 0., wheels = 0., wheels_share = 0.;
    /// Force that the added mass takes at 1 kHz to follow the approach that an equal force makes in the
    /// contact.
    double error_estimate = 0.;
    /// A first mesh with more is refused.
    static constexpr double largest_error = 0.1;

    /// The larger of both.
    void raise_to(const AddedMass &other);
  };

  /// The same for a mass (kg) at a wheel and at the rail under it. @see AddedMass
  double added_mass_error_estimate(const Scene &scene, const double mass);

  /// What rolls: wheels and rail with their mesh, contact, and all that acts on nodes, made from a scene.
  /// What is asked of it here is asked between two steps.
  struct Model
  {
    /// Collective.
    Model(const Scene &scene, const MPI_Comm comm, const WindowPlace &window);
    ~Model();

    double position() const ///< of the first wheel, m
    {
      return wheels.front().hub.motion.x;
    }
    /// Where the run ends: half a cell beyond the solution instant, around which means are taken, m.
    double end_position() const
    {
      return scene.path_end() + 0.5 * scene.mesh.finest_cell;
    }
    /// Steps from here to there: with the step that is taken, or before the first one with that which will
    /// be.
    std::uint64_t remaining_steps() const;
    /// Force on a wheel in the last step, N.
    Vector3 force_on(const RollingWheel &wheel) const
    {
      return (1. / dynamics.state.time_step) * contact.total_impulse_on(wheel.body);
    }
    /// On the other wheel of the wheelset in the last step, N. @pre scene.wheelset.both_wheels
    Vector3 force_on_other() const
    {
      // The middle of the track lies between the rails.
      return (1. / dynamics.state.time_step) *
             contact.total_impulse_below(-scene.placed_wheel().surfaces.rail_origin_y());
    }
    /// Nodes in contact with each wheel; of a wheelset in a given position with forces, normal and slip in
    /// the contact axes of their patches. Collective.
    std::vector<std::vector<ContactNodeState>> contact_states() const;
    /// The patch of each wheel. Collective.
    std::vector<std::vector<PatchNode>> patches_now() const;
    /// Where the first wheelset stands and how it moves. @pre scene.is_positioned()
    Placement placement_now() const
    {
      return {wheels.front().position(scene), wheels.front().rates(scene)};
    }
    /// Find the equilibrium at rest from which wheels roll, to section `Start`. @param after_measurement is
    /// told the iteration and what is not balanced over the load @returns the number of iterations.
    /// Collective. @see tread::relax
    unsigned int find_equilibrium(const std::function<void(unsigned int, double)> &after_measurement);
    /// Of all ranks, bytes. Collective.
    double    memory_of_cells_and_nodes() const;
    AddedMass added_mass() const; ///< Collective.
    /// @throws std::runtime_error if contact is about to leave the faces meshed for it. Collective.
    void check_rim() const;

    const Scene                &scene;
    const MPI_Comm              comm;
    Mesh                        mesh;
    Solid                       solid;
    std::vector<RollingWheel>   wheels; ///< of fixed number
    ExplicitDynamics            dynamics;
    Contact                     contact;
    std::unique_ptr<Supports>   supports;               ///< none: the rail's bottom stays in shape
    std::unique_ptr<RailBase>   rail_base;              ///< of one that runs along with the wheel
    RailOnBeam                 *rail_on_beam = nullptr; ///< null: it is on none
    WheelsetAtSolution          wheelset;       ///< with which that of the finite elements is compared
    const std::optional<double> between_pieces; ///< of a rail of slices, y (m)

  private:
    /// @throws InputError if mass was added to more than the few finest cells. Collective.
    void check_added_mass() const;
  };
} // namespace tread

#endif
