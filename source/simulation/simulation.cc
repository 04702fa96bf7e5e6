// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/stop_signal.h>
#include <tread/base/version.h>
#include <tread/base/went_wrong.h>
#include <tread/dynamics/parts/nodes.h>
#include <tread/dynamics/parts/rail_base.h>
#include <tread/dynamics/parts/supports.h>
#include <tread/dynamics/parts/track_beyond.h>
#include <tread/dynamics/parts/wheel.h>
#include <tread/scene/measured_profiles.h>
#include <tread/scene/parts.h>
#include <tread/scene/wheelset_case.h>
#include <tread/simulation/checkpoint.h>
#include <tread/simulation/simulation.h>
#include <tread/track/rail_ends.h>

#include <deal.II/base/mpi.h>

#include "interruption.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tread
{
  namespace
  {
    /// Something that is done after so many steps at the latest.
    struct EverySoManySteps
    {
      unsigned int  steps;
      std::uint64_t next;

      bool due(const std::uint64_t step)
      {
        if (step < next)
          return false;
        next = step + steps;
        return true;
      }
    };
  } // namespace


  Simulation::Simulation(const Scene &scene, const MPI_Comm comm, const WindowPlace &window)
    : window(window)
    , scene(scene)
    , comm(comm)
    , mesh(comm,
           make_bodies(scene, fine_window(scene, window.number, window.tread)),
           scene.time_stepping.levels - 1,
           cell_cost(scene),
           scene.mesh.window)
    , solid(mesh, materials(scene), solid_parameters(scene), plastic_zones(scene))
    , dynamics(mesh, solid, dynamics_parameters(scene))
    , contact(mesh, contact_parameters(scene), scene.friction_law())
    , between_pieces(scene.rail.is_sliced() ? scene.placed_wheel().between_pieces() : std::nullopt)
    , end_position(scene.path_end() + 0.5 * scene.mesh.finest_cell)
  {
    for (unsigned int number = 0; number < scene.n_wheels(); ++number)
      wheels.emplace_back(scene, number);
    if (scene.track.has_supports())
      {
        supports = std::make_unique<Supports>(mesh, rail_body, scene.support_positions(),
                                              scene.track_parameters(), solid_sleepers(scene));
        for (const int number : scene.recorded_supports())
          supports->add_probe(mid_span_beside(scene, number));
        if (!scene.recorded_supports().empty())
          seats = std::make_unique<RailSeats>(*supports, scene.recorded_supports(), scene.first_support());
        const auto beyond = scene.track_beyond();
        dynamics.add<RailOnSupports>(*supports, scene.rail.material.elastic(), beyond);
        if (beyond)
          dynamics.add<RailOnTrackBeyond>(rail_body, scene.rail.material.elastic(), *beyond);
        else
          dynamics.guide_nodes(dynamics.boundary_nodes(rail_body, Boundary::end), 0);
        if (const AbsorbingEnds ends = scene.absorbing_ends(); ends.length > 0.)
          dynamics.add<DampedNodes>(rail_body, [&](const dealii::Point<3> &p) { return ends.rate(p[0]); });
        dynamics.guide_nodes(supports->guided_nodes(1), 1);
        for (const SolidSleeper &sleeper : supports->solid_sleepers)
          dynamics.guide_nodes(dynamics.boundary_nodes(sleeper.body, Boundary::end), 1);
        if (!supports->solid_sleepers.empty())
          dynamics.guide_nodes(supports->guided_nodes(0), 0);
      }
    else if (!scene.track.runs_along())
      dynamics.fix_nodes(dynamics.support_nodes(rail_body));
    if (scene.rail_mesh())
      {
        dynamics.guide_nodes(dynamics.boundary_nodes(rail_body, Boundary::end), 0);
        dynamics.guide_nodes(dynamics.boundary_nodes(rail_body, Boundary::side), 1);
      }
    for (RollingWheel &wheel : wheels)
      dynamics.add<WheelOnHub>(wheel.hub, wheel.body, wheel.hub.motion.angular_velocity);
    if (scene.track.runs_along())
      {
        rail_base = std::make_unique<RailBase>(scene.rail_base_parameters());
        dynamics.add<RailOnBase>(*rail_base, rail_body);
      }
    dynamics.attach_contact(contact);
    if (!scene.contact.friction_places.empty() || scene.contact.varies_across())
      contact.vary_friction([this](const Vector3 place) {
        const Scene &of = this->scene;
        return of.contact.friction_factor(place[0]) *
               (of.contact.varies_across() ? of.factor_across(place) : 1.);
      });
    if (!scene.contact.friction_pressures.empty())
      contact.vary_friction_with_pressure(
        [this](const double pressure) { return this->scene.contact.pressure_factor(pressure); });
    if (scene.motion.lateral_creepage != 0. || scene.motion.spin != 0.)
      contact.impose_sliding([this](const Vector3 place, const unsigned int body) {
        const auto wheel =
          std::find_if(wheels.begin(), wheels.end(), [&](const RollingWheel &w) { return w.body == body; });
        // The sliding is a velocity, at the middle of the step: there the hub will be half a step further.
        const WheelHub::Motion &hub = wheel->hub.motion;
        const double            x   = place[0] - (hub.x + 0.5 * dynamics.state.time_step * hub.velocity_x),
                     y              = place[1] - this->scene.first_contact().y;
        const MotionSection &motion = this->scene.motion;
        return motion.speed * Vector3{-motion.spin * y, motion.lateral_creepage + motion.spin * x, 0., 0.};
      });

    if (scene.output.strip_half_width > 0. && !scene.mesh.window)
      strip = std::make_unique<StressStrip>(mesh, solid, &contact.surfaces, rail_body,
                                            materials(scene)[rail_body], strip_extent(scene));
    if (scene.peak_stress.is_wanted())
      {
        const auto record = [&](const bool is_slave, const unsigned int body) {
          return std::make_unique<StressPeaks>(dynamics, &contact, is_slave, body, materials(scene)[body],
                                               peak_region(scene, body));
        };
        rail_peaks  = record(true, rail_body);
        wheel_peaks = record(false, wheels.front().body);
      }
    if (scene.motion.passages > 1)
      make_growth();
    if (scene.damage.record)
      damage = std::make_unique<SurfaceDamage>(contact, rail_body, surface_damage_parameters(scene));
    if (!scene.contact.temperatures.empty())
      damage->vary_friction(factor_by_rise(scene));
    if (const auto points = scene.recorded_cells(); !points.empty())
      try
        {
          probes = std::make_unique<CellProbes>(mesh, rail_body, points);
        }
      catch (const std::out_of_range &number)
        {
          throw InputError("'Output/Cells': entry " + std::string(number.what()) + " lies outside the rail");
        }
  }


  void Simulation::serialize(Archive &archive)
  {
    dynamics.serialize(archive); // and hubs, supports and contact, which are attached to it
    serialize_records(archive);
  }


  void Simulation::serialize_records(Archive &archive)
  {
    if (seats)
      seats->serialize(archive);
    if (strip)
      strip->serialize(archive);
    impacts.serialize(archive);
    ripple.serialize(archive);
    for (StressPeaks *peaks : {rail_peaks.get(), wheel_peaks.get()})
      if (peaks)
        peaks->serialize(archive);
    if (damage)
      damage->serialize(archive);
    if (growth)
      growth->serialize(archive);
    archive.same(placement_at_solution);
    if (placement_at_solution && !placed_at_solution && no_half_space.empty())
      place_at_solution();
    for (RollingWheel &wheel : wheels)
      wheel.serialize(archive);
    archive.same(torque_released, solution_taken, starts_with_tractions, passages, next_wheel_due,
                 interval_steps, interval_start_time, last_steps, skipped);
    archive.same(relaxation_seconds, relaxation_iterations, wall_seconds);
    double end = end_position;
    archive.same(end);
    archive.same(went_on_at);
    if (end != end_position) // resumed for a longer way
      {
        forget_solution();
        went_on_at = position();
      }
  }


  void Simulation::forget_solution()
  {
    solution_taken = false;
    ripple         = ForceRipple();
    last_steps     = 0;
    placement_at_solution.reset();
    placed_at_solution.reset();
    no_half_space.clear();
    for (RollingWheel &wheel : wheels)
      wheel.forget_records(scene);
  }


  std::uint64_t Simulation::remaining_steps() const
  {
    const double        step     = dynamics.state.time_step > 0.
                                     ? dynamics.state.time_step
                                     : scene.time_stepping.courant_number * dynamics.critical_time_step();
    const std::uint64_t together = std::uint64_t(1) << dynamics.max_level();
    return together * static_cast<std::uint64_t>(
                        std::ceil((end_position - position()) / (scene.motion.speed * step * together)));
  }


  bool Simulation::at_end_of_window() const
  {
    return scene.mesh.window && window.number + 1 < scene.n_windows() &&
           position() >= scene.path_begin() + (window.number + 1) * scene.window_length();
  }


  WindowPlace Simulation::next_window() const
  {
    return {window.number + 1, scene.wheel.radius * wheels.front().hub.motion.angle};
  }


  void Simulation::go_on_from(Simulation &before)
  {
    Archive kept(comm);
    before.dynamics.serialize_parts(kept);
    before.serialize_records(kept);
    Archive found(comm, kept.stored_by_all());
    dynamics.serialize_parts(found);
    serialize_records(found);
    dynamics.go_on_from(before.dynamics);
    checked_position = before.checked_position;
    seconds_before   = before.seconds_before;
  }


  bool Simulation::interval_ended(const double interval) const
  {
    const auto number = [&](const double x) {
      return std::floor((x - scene.path_begin()) / interval);
    };
    return interval > 0. && number(position()) > number(checked_position);
  }


  bool Simulation::interrupted() const
  {
    return dealii::Utilities::MPI::max(static_cast<int>(stop_was_asked()), comm) != 0;
  }


  double Simulation::memory_of_cells_and_nodes() const
  {
    const std::size_t on_this_rank =
      mesh.memory_consumption() + solid.memory_consumption() + dynamics.memory_consumption();
    return dealii::Utilities::MPI::sum(double(on_this_rank), comm);
  }


  void Simulation::set_drive()
  {
    if (scene.motion.drive == Drive::torque && !torque_released &&
        position() >= scene.path_begin() + scene.motion.hold_distance)
      {
        for (RollingWheel &wheel : wheels)
          {
            wheel.hub.drive        = Drive::torque;
            wheel.hub.drive_torque = scene.traction_coefficient(wheel.number) * scene.static_load() *
                                     (wheel.hub.motion.z + scene.rolling_radius() - scene.axle_height());
          }
        torque_released = true;
      }
  }


  void Simulation::add_to_interval()
  {
    const bool is_last = position() <= scene.path_end() && position() >= scene.path_end() - last_way;
    for (RollingWheel &wheel : wheels)
      {
        const Vector3 force = force_on(wheel);
        wheel.interval_force += force;
        if (scene.wheelset.both_wheels)
          wheel.interval_other_force += force_on_other();
        if (between_pieces)
          wheel.interval_inner_force +=
            contact.total_impulse_below(*between_pieces)[2] / dynamics.state.time_step;
        if (is_last)
          wheel.add_to_last_force(force);
      }
    if (is_last)
      ripple.add(position(), force_on(wheels.front()));
    ++interval_steps;
    last_steps += is_last;
    if (std::abs(position() - scene.path_end()) <= 0.5 * scene.mesh.finest_cell)
      {
        const bool differs_from_start = scene.guidance.kind != Guidance::rigid ||
                                        scene.wheelset.has_flexible_axle() || scene.rail.is_sliced() ||
                                        !scene.contact.friction_places.empty();
        if (differs_from_start && scene.is_positioned() && !placement_at_solution)
          {
            // Means over a cell begin half of it before the end of the path: so far it goes on with its
            // rates.
            Placement   &at   = placement_at_solution.emplace(placement_now());
            const double rest = (scene.path_end() - position()) / scene.motion.speed;
            at.position.shift += rest * at.rates.across_speed;
            at.position.yaw += rest * at.rates.yaw_rate;
            at.position.roll += rest * at.rates.roll_rate;
            at.position.along = scene.position_at(scene.path_end()).along;
            place_at_solution();
          }
        const auto states = contact_states();
        for (RollingWheel &wheel : wheels)
          {
            wheel.average.add(states[wheel.number], wheel.hub.motion.x, dynamics.state.time_step);
            for (unsigned int k = 0; k < wheel.averages_of_patches.size(); ++k)
              wheel.averages_of_patches[k].add(placed().of_patch(k, states[wheel.number], wheel.hub.motion.x),
                                               wheel.hub.motion.x, dynamics.state.time_step);
          }
      }
  }


  void Simulation::look_for_peaks()
  {
    if (!rail_peaks)
      return;
    const auto near = std::find_if(wheels.begin(), wheels.end(), [&](const RollingWheel &wheel) {
      return rail_peaks->concerns(wheel.hub.motion.x);
    });
    if (near == wheels.end())
      return;
    const std::vector<Vector3> impulses = contact.surface_impulses();
    rail_peaks->sample(dynamics, contact.active_nodes(), impulses, near->hub.motion.x);
    if (near == wheels.begin())
      wheel_peaks->sample(dynamics, {}, impulses, position());
  }


  Vector3 Simulation::last_force_on(const RollingWheel &wheel) const
  {
    return last_steps > 0 ? wheel.mean_last_force(last_steps) : force_on(wheel);
  }


  std::vector<SupportRecord> Simulation::support_records() const
  {
    std::vector<SupportRecord> records;
    for (const int number : scene.recorded_supports())
      {
        const unsigned int s                  = number - scene.first_support();
        const auto [least_pressure, pressure] = supports->pad_pressures(s);
        records.push_back({supports->force(s, Supports::pad), supports->force(s, Supports::ballast), pressure,
                           least_pressure, supports->rail_displacement(s),
                           supports->probe_displacement(records.size())});
      }
    return records;
  }


  void Simulation::end_interval(RunFolder &folder)
  {
    HistoryRow row;
    row.time           = dynamics.state.time;
    row.position       = position();
    const auto patches = patches_now();
    for (RollingWheel &wheel : wheels)
      row.wheels.push_back(wheel.end_interval(scene, patches[wheel.number], interval_steps,
                                              dynamics.state.time - interval_start_time));
    row.energy   = dynamics.ledger();
    row.supports = support_records();
    if (rail_base)
      row.rail_base = rail_base->displacement();
    if (probes)
      row.cells = probes->record(dynamics);
    if (strip)
      strip->sample(dynamics, contact.surface_impulses(), position());
    impacts.add(row, dynamics.state.time - interval_start_time, scene.recorded_supports());
    folder.append(row);
    watch(row.energy);
    interval_start_time = dynamics.state.time;
    interval_steps      = 0;
  }


  void Simulation::watch(const EnergyLedger &energy) const
  {
    const double limit = scene.watchdogs.stop_at_residual,
                 scale = std::max(energy.dissipated(), energy.stored_strain + energy.stored_hourglass);
    if (!(std::abs(energy.residual()) <= limit * scale)) // so is NaN
      throw WentWrong(format(
        "%.4g J of energy are not accounted for at %.2f mm, after %llu steps, beside %.4g J dissipated "
        "and %.4g J stored as strain ('Watchdogs/Stop at energy residual' %g): the step is unstable, "
        "or what the scene asks for is beyond its mesh; lower 'Time stepping/Courant number' or use one "
        "level",
        energy.residual(), 1e3 * position(), (unsigned long long)dynamics.state.n_steps, energy.dissipated(),
        energy.stored_strain + energy.stored_hourglass, limit));
  }


  void Simulation::take_solution(RunFolder &folder)
  {
    const auto patches = patches_now();
    for (RollingWheel &wheel : wheels)
      {
        wheel.solution_patch = patches[wheel.number];
        folder.write_patch(RunFolder::table_of_wheel("patch", wheel.number), wheel.solution_patch);
      }
    solution_taken = true;
    if (scene.output.table_depth > 0.)
      folder.write_rail_tables(dynamics, nodal_stresses().at_present(), rail_body, scene.output.table_depth);
    write_surface(folder);
    if (scene.output.write_volume)
      write_volume(folder);
  }


  void Simulation::write_volume(RunFolder &folder) const
  {
    std::map<unsigned int, const WheelHub *> hubs;
    for (const RollingWheel &wheel : wheels)
      hubs[wheel.body] = &wheel.hub;
    folder.write_volume(dynamics, nodal_stresses().at_present(), hubs);
  }


  void Simulation::write_surface(RunFolder &folder) const
  {
    folder.write_surface(dynamics, contact, nodal_stresses().at_present(),
                         damage ? damage->by_node() : std::vector<SurfacePlace>(), rail_body);
  }


  NodalStresses &Simulation::nodal_stresses() const
  {
    if (!stresses_at_nodes)
      {
        const std::vector<ElasticMaterial> of_bodies = materials(scene);
        std::vector<RecoveredBody> bodies{{rail_body, of_bodies[rail_body], depth_in(scene, rail_body)}};
        for (const RollingWheel &wheel : wheels)
          bodies.push_back(
            {wheel.body, of_bodies[wheel.body], [axle = wheel.hub.start()](const dealii::Point<3> &p) {
               return -std::hypot(p[0] - axle[0], p[2] - axle[2]);
             }});
        stresses_at_nodes = std::make_unique<NodalStresses>(dynamics, &contact, bodies);
      }
    return *stresses_at_nodes;
  }


  void Simulation::announce(Progress &progress) const
  {
    progress.say("tread " + version() + (scene.general.title.empty() ? "" : ": " + scene.general.title));
    progress.say(format("%llu cells, %llu unknowns, %u rank(s), %u lanes",
                        (unsigned long long)mesh.n_global_cells,
                        3ull * (mesh.n_global_nodes - mesh.n_global_hanging_nodes),
                        dealii::Utilities::MPI::n_mpi_processes(comm), n_lanes));
    for (const std::string &assumption : scene.assumptions())
      progress.say("assumed: " + assumption);
    for (const std::string &unused : scene.unused_parameters())
      progress.say("WARNING: " + unused);
    if (const std::string defect = scene.defect_in_words(); !defect.empty())
      progress.say(defect);
    for (const std::string &line : MeasuredProfiles(scene).smoothing())
      progress.say(line);
    if (const double gain = dynamics.ideal_gain_of_levels(); gain > 1.)
      progress.say(
        format("time steps in %u levels: 1/%.2f of the cell updates", dynamics.max_level() + 1, gain));
  }


  void Simulation::announce_steps(Progress &progress) const
  {
    progress.say(format("time step %.4g ns, %llu steps to roll %.1f mm", 1e9 * dynamics.state.time_step,
                        (unsigned long long)remaining_steps(), 1e3 * (end_position - position())));
    for (const std::string &doubt : doubts_at_start())
      progress.say("WARNING: " + doubt);
  }


  Simulation::End Simulation::roll(RunFolder &folder, Checkpoint &checkpoint, Progress &progress, Pace &pace)
  {
    std::uint64_t n_steps = dynamics.state.n_steps + remaining_steps();
    // mpirun gives its ranks a second to end after Ctrl-C.
    EverySoManySteps look_at_signals{10, dynamics.state.n_steps}, check{100, dynamics.state.n_steps + 100};
    while (dynamics.state.n_steps < n_steps)
      {
        set_drive();
        dynamics.step();
        add_to_interval();
        look_for_peaks();
        if (damage)
          damage->add_step(dynamics.state.time_step);
        if (seats)
          seats->record(dynamics.state.time, position());
        if (!dynamics.synchronised())
          continue;
        if (contact.contact_at_rim())
          {
            dynamics.check_stability();
            return End::left_surface;
          }
        write_what_is_due(folder);

        const bool at_end = dynamics.state.n_steps == n_steps, checks = check.due(dynamics.state.n_steps);
        if (checks || at_end)
          {
            dynamics.check_stability();
            dynamics.check_cells();
          }

        // Before any other checkpoint, so that none is made of a wheel at its end that does not know it.
        if (at_end && scene.motion.passages > 1)
          {
            end_passage(folder, progress);
            if (passages.back().number >= scene.motion.passages || growth->has_failed())
              return End::complete;
            if (!change_wheels(checkpoint, progress))
              return End::between_passages;
            n_steps = dynamics.state.n_steps + remaining_steps();
          }
        if (look_at_signals.due(dynamics.state.n_steps) && interrupted())
          return End::interrupted;
        if (at_end_of_window())
          {
            dynamics.check_stability();
            dynamics.check_cells();
            return End::of_window;
          }
        if (checks)
          {
            keep_checkpoint(checkpoint, progress, pace);
            if (progress.due())
              show_pace(progress, pace, n_steps - dynamics.state.n_steps);
          }
      }
    return End::complete;
  }


  void Simulation::write_what_is_due(RunFolder &folder)
  {
    if (!solution_taken && position() >= scene.path_end())
      take_solution(folder);
    if (interval_ended(scene.output.history_interval))
      end_interval(folder);
    if (interval_ended(scene.output.surface_interval))
      write_surface(folder);
    if (interval_ended(scene.output.interval_of_patches()))
      {
        const auto patches = patches_now();
        for (const RollingWheel &wheel : wheels)
          folder.append_patch(wheel.number, dynamics.state.time, wheel.hub.motion.x, patches[wheel.number]);
      }
    if (scene.output.write_volume && interval_ended(scene.output.volume_interval))
      write_volume(folder);
    checked_position = position();
  }


  bool Simulation::change_wheels(Checkpoint &checkpoint, Progress &progress)
  {
    skipped =
      growth->passages_to_skip(scene.motion.passages - static_cast<unsigned int>(passages.back().number));
    if (skipped > 0)
      progress.say(
        format("%u passages are left out, in each of which the net plastic strain grows by %.3g %%", skipped,
               100. * growth->rate()));
    growth->begin_next(skipped);
    next_wheel_due = true;
    checkpoint.write(*this); // the start of the next wheel may take long, and cannot be kept
    return begin_next_passage(progress);
  }


  bool Simulation::begin_next_passage(Progress &progress)
  {
    try
      {
        next_passage(progress);
      }
    catch (const Interruption &)
      {
        progress.say("INTERRUPTED between two passages; go on with --resume");
        return false;
      }
    next_wheel_due = false;
    return true;
  }


  void Simulation::keep_checkpoint(Checkpoint &checkpoint, const Progress &progress, Pace &pace)
  {
    const double now = progress.seconds(), interval = scene.output.checkpoint_interval;
    // A start that took long is not lost with what comes after it.
    constexpr double long_start = 60.; // s
    const bool       is_first   = pace.last_checkpoint == pace.began;
    const bool       due =
      interval > 0. && (now - pace.last_checkpoint > interval || (is_first && pace.began > long_start));
    if (!dealii::Utilities::MPI::max(due ? 1 : 0, comm))
      return;
    watch(dynamics.ledger()); // nothing is kept to go on from that has gone wrong
    wall_seconds = seconds_before + now;
    checkpoint.write(*this);
    pace.last_checkpoint = now;
  }


  void Simulation::show_pace(Progress &progress, const Pace &pace, const std::uint64_t steps_left) const
  {
    const Vector3 force = force_on(wheels.front());
    const double  spent = progress.seconds() - pace.began, done = dynamics.state.n_steps - pace.first_step;
    progress.show(
      format("x %8.2f mm  N %7.2f kN  T/N %+.4f  %5.1f ns/update/rank  %5.0f s left", 1e3 * position(),
             1e-3 * force[2], force[2] > 0. ? force[0] / force[2] : 0.,
             1e9 * spent / done / pace.updates_of_step * dealii::Utilities::MPI::n_mpi_processes(comm),
             spent / done * steps_left));
  }


  void Simulation::check_rim() const
  {
    if (const auto place = contact.contact_at_rim())
      {
        dynamics.check_stability(); // nodes that fly apart leave it first
        throw std::runtime_error(
          format("contact leaves what is meshed for it at x = %.2f mm, y = %.2f mm, z = %.2f mm: raise "
                 "'Mesh/Fine half width (mm)' or change %s",
                 1e3 * (*place)[0], 1e3 * (*place)[1], 1e3 * (*place)[2],
                 scene.guidance.kind != Guidance::rigid ? "where section 'Guidance' lets the wheelset go"
                 : scene.is_positioned()                ? "'Wheelset/Lateral shift (mm)'"
                                                        : "'Wheel/Lateral position (mm)'"));
      }
  }
} // namespace tread
