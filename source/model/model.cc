// SPDX-License-Identifier: LGPL-2.1-or-later
// From a scene to what rolls.
#include <tread/base/format.h>
#include <tread/dynamics/parts/rail_base.h>
#include <tread/dynamics/parts/rail_on_beam.h>
#include <tread/dynamics/parts/supports.h>
#include <tread/model/model.h>
#include <tread/model/parts.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/parts.h>
#include <tread/scene/surface_laws.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tread
{
  Model::Model(const Scene &scene, const MPI_Comm comm, const WindowPlace &window)
    : scene(scene)
    , comm(comm)
    , mesh(comm,
           scene.stance().make_bodies(fine_window(scene, window.number, window.tread)),
           scene.time_stepping.levels - 1,
           cell_cost(scene),
           has_window(scene))
    , solid(mesh, materials(scene), solid_parameters(scene), plastic_zones(scene))
    , dynamics(mesh, solid, dynamics_parameters(scene))
    , contact(mesh, contact_parameters(scene), friction_law(scene))
    , wheelset(scene)
    , between_pieces(scene.rail.is_sliced() ? scene.placed_wheel().between_pieces() : std::nullopt)
  {
    for (unsigned int number = 0; number < scene.n_wheels(); ++number)
      wheels.emplace_back(scene, number);
    for (const auto add : model_parts())
      add(*this);
    dynamics.attach_contact(contact);
    if (window.number == 0)
      check_added_mass();
  }


  Model::~Model() = default;


  void AddedMass::raise_to(const AddedMass &other)
  {
    for (double AddedMass::*const value : {&AddedMass::rail, &AddedMass::rail_share, &AddedMass::wheels,
                                           &AddedMass::wheels_share, &AddedMass::error_estimate})
      this->*value = std::max(this->*value, other.*value);
  }


  double added_mass_error_estimate(const Scene &scene, const double mass)
  {
    constexpr double omega = 2. * dealii::numbers::PI * 1e3; // rad/s
    return mass * omega * omega / scene.stance().ellipse(scene.static_load()).stiffness;
  }


  AddedMass Model::added_mass() const
  {
    AddedMass result;
    if (!solid.may_add_mass())
      return result;
    const auto masses    = dynamics.masses_of_bodies();
    double     of_wheels = 0.;
    for (const RollingWheel &wheel : wheels)
      {
        of_wheels += masses[wheel.body].own;
        result.wheels += masses[wheel.body].added;
      }
    result.rail         = masses[rail_body].added;
    result.rail_share   = result.rail / masses[rail_body].own;
    result.wheels_share = result.wheels / of_wheels;
    result.error_estimate =
      added_mass_error_estimate(scene, (result.rail + result.wheels) / scene.n_wheels());
    return result;
  }


  void Model::check_added_mass() const
  {
    const AddedMass added = added_mass();
    require(added.error_estimate <= AddedMass::largest_error,
            format("'Time stepping/Least step (us)' %g adds %.3g kg to the rail's cells and %.3g kg to the "
                   "wheel's: its inertia is about %.3g %% of the contact force at 1 kHz; at most %g %% is "
                   "allowed (without it --dry-run prints what several steps add)",
                   1e6 * scene.time_stepping.least_step, added.rail, added.wheels,
                   100. * added.error_estimate, 100. * AddedMass::largest_error));
  }


  unsigned int Model::find_equilibrium(const std::function<void(unsigned int, double)> &after_measurement)
  {
    return dynamics.relax(scene.start.tolerance, scene.start.max_iterations, after_measurement);
  }


  std::vector<std::vector<ContactNodeState>> Model::contact_states() const
  {
    std::vector<std::vector<ContactNodeState>> of_wheels(wheels.size());
    for (const ContactNodeState &state : contact.active_nodes())
      for (const RollingWheel &wheel : wheels)
        if (state.master_body == wheel.body)
          of_wheels[wheel.number].push_back(wheelset.stance().in_contact_axes(state, wheel.hub.motion.x));
    return of_wheels;
  }


  std::vector<std::vector<PatchNode>> Model::patches_now() const
  {
    std::vector<std::vector<PatchNode>> patches;
    const auto                          states = contact_states();
    for (const RollingWheel &wheel : wheels)
      patches.push_back(patch_nodes(states[wheel.number], wheel.hub.motion.x, dynamics.state.time_step));
    return patches;
  }


  std::uint64_t Model::remaining_steps() const
  {
    const double        step     = dynamics.state.time_step > 0.
                                     ? dynamics.state.time_step
                                     : scene.time_stepping.courant_number * dynamics.critical_step().seconds();
    const std::uint64_t together = std::uint64_t(1) << dynamics.max_level();
    return together * static_cast<std::uint64_t>(
                        std::ceil((end_position() - position()) / (scene.motion.speed * step * together)));
  }


  double Model::memory_of_cells_and_nodes() const
  {
    const std::size_t on_this_rank =
      mesh.memory_consumption() + solid.memory_consumption() + dynamics.memory_consumption();
    return dealii::Utilities::MPI::sum(double(on_this_rank), comm);
  }


  void Model::check_rim() const
  {
    if (const auto place = contact.contact_at_rim())
      {
        dynamics.check_stability(); // nodes that fly apart leave it first
        throw std::runtime_error(
          format("contact leaves what is meshed for it at x = %.2f mm, y = %.2f mm, z = %.2f mm: raise "
                 "'Mesh/Fine half width (mm)' or change %s",
                 1e3 * (*place)[0], 1e3 * (*place)[1], 1e3 * (*place)[2],
                 (scene.guidance.kind != Guidance::rigid ? "where section 'Guidance' lets the wheelset go"
                                                         : scene.stance().words().across_parameter)
                   .c_str()));
      }
  }
} // namespace tread
