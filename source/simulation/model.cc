// SPDX-License-Identifier: LGPL-2.1-or-later
// From a scene to what rolls.
#include <tread/analysis/seat_modes.h>
#include <tread/base/format.h>
#include <tread/dynamics/parts/added_mass.h>
#include <tread/dynamics/parts/nodes.h>
#include <tread/dynamics/parts/rail_base.h>
#include <tread/dynamics/parts/rail_on_beam.h>
#include <tread/dynamics/parts/supports.h>
#include <tread/dynamics/parts/track_beyond.h>
#include <tread/dynamics/parts/wheel.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/parts.h>
#include <tread/scene/surface_laws.h>
#include <tread/scene/track_parts.h>
#include <tread/scene/wheelset_case.h>
#include <tread/simulation/model.h>
#include <tread/track/rail_ends.h>
#include <tread/track/track_beam.h>

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
           make_bodies(scene, fine_window(scene, window.number, window.tread)),
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
    if (scene.track.has_supports())
      add_supports();
    else if (!scene.track.has_moving_base())
      dynamics.fix_nodes(dynamics.support_nodes(rail_body));
    if (scene.rail_mesh())
      {
        dynamics.guide_nodes(dynamics.boundary_nodes(rail_body, Boundary::end), 0);
        dynamics.guide_nodes(dynamics.boundary_nodes(rail_body, Boundary::side), 1);
      }
    for (RollingWheel &wheel : wheels)
      {
        dynamics.guide_nodes(dynamics.boundary_nodes(wheel.body, Boundary::side), 1);
        const CarriesBody &carrier =
          dynamics.add<WheelOnHub>(wheel.hub, wheel.body, wheel.hub.motion.angular_velocity);
        if (solid.may_add_mass())
          dynamics.add<AddedMassOnWheel>(carrier);
      }
    if (scene.track.runs_along())
      {
        rail_base = std::make_unique<RailBase>(scene.track.co_running);
        dynamics.add<RailOnBase>(*rail_base, rail_body);
      }
    if (scene.track.is_beam())
      rail_on_beam = &dynamics.add<RailOnBeam>(beam_under_rail(scene), rail_body);
    dynamics.attach_contact(contact);
    if (window.number == 0)
      check_added_mass();
    add_friction_that_varies();
    if (scene.motion.lateral_creepage != 0. || scene.motion.spin != 0.)
      contact.prescribed.impose_sliding([this](const Vector3 place, const unsigned int body) {
        const auto wheel =
          std::find_if(wheels.begin(), wheels.end(), [&](const RollingWheel &w) { return w.body == body; });
        // The sliding is a velocity, at the middle of the step: there the hub will be half a step further.
        const WheelHub::Motion &hub = wheel->hub.motion;
        const double            x   = place[0] - (hub.x + 0.5 * dynamics.state.time_step * hub.velocity_x),
                     y              = place[1] - this->scene.first_contact().y;
        const MotionSection &motion = this->scene.motion;
        return motion.speed * Vector3{-motion.spin * y, motion.lateral_creepage + motion.spin * x, 0., 0.};
      });
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
    return mass * omega * omega / hertz(scene, scene.static_load()).stiffness;
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


  void Model::add_supports()
  {
    supports = std::make_unique<Supports>(mesh, rail_body, support_positions(scene), track_parameters(scene),
                                          solid_sleepers(scene));
    for (const int number : recorded_supports(scene))
      supports->add_probe(mid_span_beside(scene, number));
    auto beyond = track_beyond(scene);
    if (beyond && scene.track.has_solid_sleepers())
      {
        TrackParameters alike = track_parameters(scene);
        alike.exceptions.clear();
        (*beyond)[0].sleeper = (*beyond)[1].sleeper =
          modes_at_seat(mesh, rail_body, supports->solid_sleepers.front(), support_positions(scene).front(),
                        alike, materials(scene), solid_parameters(scene));
      }
    dynamics.add<RailOnSupports>(*supports, scene.rail.material.elastic(), beyond);
    if (beyond)
      dynamics.add<RailOnTrackBeyond>(rail_body, scene.rail.material.elastic(), *beyond);
    else
      dynamics.guide_nodes(dynamics.boundary_nodes(rail_body, Boundary::end), 0);
    if (const AbsorbingEnds ends = absorbing_ends(scene); ends.length > 0.)
      dynamics.add<DampedNodes>(rail_body, [&](const dealii::Point<3> &p) { return ends.rate(p[0]); });
    dynamics.guide_nodes(supports->guided_nodes(1), 1);
    for (const SolidSleeper &sleeper : supports->solid_sleepers)
      dynamics.guide_nodes(dynamics.boundary_nodes(sleeper.body, Boundary::end), 1);
    if (!supports->solid_sleepers.empty())
      dynamics.guide_nodes(supports->guided_nodes(0), 0);
  }


  void Model::add_friction_that_varies()
  {
    const ContactSection &section = scene.contact;
    if (!section.friction_places.empty() || section.varies_across())
      contact.prescribed.vary_friction([this](const Vector3 place) {
        const Scene &of = this->scene;
        return of.contact.friction_factor(place[0]) *
               (of.contact.varies_across() ? factor_across(of, place) : 1.);
      });
    if (!section.friction_pressures.empty())
      contact.vary_friction_with_pressure(
        [this](const double pressure) { return this->scene.contact.pressure_factor(pressure); });
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
                                                         : scene.stance().across_parameter())
                   .c_str()));
      }
  }
} // namespace tread
