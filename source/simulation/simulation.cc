// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/version.h>
#include <tread/scene/parts.h>
#include <tread/simulation/checkpoint.h>
#include <tread/simulation/simulation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <sstream>

namespace tread
{
  namespace
  {
    volatile std::sig_atomic_t signal_received = 0;

    /// Ctrl-C before anything was computed.
    class Interruption : public std::exception
    {
    };

    void on_signal(int number)
    {
      std::signal(number, SIG_DFL); // a second one ends the program at once
      signal_received = 1;
    }

    template <typename... T>
    std::string format(const char *pattern, const T... values)
    {
      char text[512];
      std::snprintf(text, sizeof text, pattern, values...);
      return text;
    }
  } // namespace


  Simulation::Simulation(const Scene &scene, const MPI_Comm comm)
    : scene(scene)
    , comm(comm)
    , mesh(comm, make_bodies(scene), scene.time_levels - 1, cell_cost(scene))
    , solid(mesh, materials(scene), solid_parameters(scene), plastic_zones(scene))
    , hub(hub_parameters(scene))
    , dynamics(mesh, solid, dynamics_parameters(scene))
    , contact(mesh, contact_parameters(scene), scene.friction_law())
    , end_position(scene.path_end() + 0.5e-3 * scene.finest_mm)
  {
    const double omega = scene.speed() / scene.rolling_radius();
    hub.place(scene.path_begin(), scene.axle_height());
    hub.motion.angular_velocity = omega;
    if (scene.has_supports())
      {
        supports = std::make_unique<Supports>(mesh, rail_body, scene.support_positions(), scene.track(),
                                              solid_sleepers(scene));
        for (const int number : scene.recorded_supports())
          supports->add_probe(mid_span_beside(scene, number));
        dynamics.attach_supports(*supports, scene.rail_material.si());
        dynamics.guide_nodes(dynamics.boundary_nodes(rail_body, Boundary::end), 0);
        if (const AbsorbingEnds ends = scene.absorbing_ends(); ends.length > 0.)
          dynamics.damp_nodes(rail_body, [&](const dealii::Point<3> &p) { return ends.rate(p[0]); });
        dynamics.guide_nodes(supports->guided_nodes(1), 1);
        for (const SolidSleeper &sleeper : supports->solid_sleepers)
          dynamics.guide_nodes(dynamics.boundary_nodes(sleeper.body, Boundary::end), 1);
        if (!supports->solid_sleepers.empty())
          dynamics.guide_nodes(supports->guided_nodes(0), 0);
      }
    else
      dynamics.fix_nodes(dynamics.support_nodes(rail_body));
    dynamics.attach_hub(hub, wheel_body, omega);
    dynamics.attach_contact(contact);

    if (scene.strip_half_width_mm > 0.)
      strip = std::make_unique<StressStrip>(mesh, rail_body, strip_extent(scene));
    if (const auto points = scene.recorded_cells(); !points.empty())
      try
        {
          probes = std::make_unique<CellProbes>(mesh, rail_body, points);
        }
      catch (const std::out_of_range &number)
        {
          throw SceneError("'Output/Cells': entry " + std::string(number.what()) + " lies outside the rail");
        }
  }


  std::uint64_t Simulation::remaining_steps() const
  {
    const double step =
      dynamics.time_step > 0. ? dynamics.time_step : scene.courant_number * dynamics.critical_time_step();
    const std::uint64_t together = std::uint64_t(1) << dynamics.max_level();
    return together * static_cast<std::uint64_t>(
                        std::ceil((end_position - position()) / (scene.speed() * step * together)));
  }


  bool Simulation::interval_ended(const double interval_mm) const
  {
    const auto number = [&](const double x) {
      return std::floor((x - scene.path_begin()) / (1e-3 * interval_mm));
    };
    return interval_mm > 0. && number(position()) > number(checked_position);
  }


  bool Simulation::interrupted() const
  {
    return dealii::Utilities::MPI::max(static_cast<int>(signal_received), comm) != 0;
  }


  double Simulation::memory_of_cells_and_nodes() const
  {
    const std::size_t on_this_rank =
      mesh.memory_consumption() + solid.memory_consumption() + dynamics.memory_consumption();
    return dealii::Utilities::MPI::sum(double(on_this_rank), comm);
  }


  void Simulation::estimate()
  {
    const double        step  = scene.courant_number * dynamics.critical_time_step();
    const std::uint64_t steps = remaining_steps();
    // A few force evaluations tell this machine's pace.
    NodalField       force(mesh.nodes.size(), Row{});
    const NodalField x     = dynamics.positions();
    const auto       start = MPI_Wtime();
    unsigned int     n     = 0;
    for (; n < 3 || MPI_Wtime() - start < 0.3; ++n)
      solid.add_internal_forces(x.data(), dynamics.v.data(), force.data());
    const double           seconds = dealii::Utilities::MPI::max((MPI_Wtime() - start) / n, comm);
    const double           memory = memory_of_cells_and_nodes(), gain = dynamics.ideal_gain_of_levels();
    constexpr unsigned int n_choices = 4; // of levels
    std::array<double, n_choices> gains;
    for (unsigned int level = 0; level < n_choices; ++level)
      gains[level] = dynamics.ideal_gain_of_levels(level);
    // Of the whole run over that of the internal forces, of which the start takes some.
    constexpr double all_over_forces = 2.2, relaxation_steps = 1200.;
    const auto       time = [&](const double density_scale, const double gain_of_levels) {
      return all_over_forces * seconds *
             (steps * std::sqrt(scene.density_scale / density_scale) / gain_of_levels + relaxation_steps);
    };
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      {
        std::printf("cells                %12llu\n", (unsigned long long)mesh.n_global_cells);
        std::printf("unknowns             %12llu\n",
                    3ull * (mesh.n_global_nodes - mesh.n_global_hanging_nodes));
        std::printf("time step            %12.4g s\n", step);
        if (dynamics.max_level() > 0)
          std::printf("levels of time steps %12u     cell updates fall to 1/%.2f\n", dynamics.max_level() + 1,
                      gain);
        std::printf("steps                %12llu\n", (unsigned long long)steps);
        std::printf("cells and nodes use  %12.0f MB\n", memory / 1e6);
        std::printf("inertia error        %12.2g   (speed / wave speed)^2 at density scale %g\n",
                    scene.inertia_error_estimate(), scene.density_scale);
        std::printf(
          "estimated time       %12.0f s on %u rank(s), about %.1f times that of the internal forces\n",
          time(scene.density_scale, gain), dealii::Utilities::MPI::n_mpi_processes(comm), all_over_forces);
        std::printf("with 'Levels'        %12s", "");
        for (unsigned int levels = 1; levels <= n_choices; ++levels)
          std::printf("%9u", levels);
        std::printf("   inertia error\n");
        std::vector<double> scales{scene.density_scale};
        if (scene.quasi_static)
          scales.insert(scales.end(), {1., 4., 9., 25.});
        std::sort(scales.begin(), scales.end());
        scales.erase(std::unique(scales.begin(), scales.end()), scales.end());
        for (const double scale : scales)
          {
            std::printf("'Density scale' %4g: s            ", scale);
            for (const double gain_of_levels : gains)
              std::printf("%9.0f", time(scale, gain_of_levels));
            std::printf("   %.2g\n", scene.inertia_error_estimate() * scale / scene.density_scale);
          }
      }
  }


  void Simulation::prepare_start(Progress &progress)
  {
    const double             began = progress.seconds();
    reference::RollingResult half_space;
    bool                     predicts_tractions = scene.start_tractions == "predicted";
    if (scene.predicts_creepage())
      {
        const reference::RollingEstimate estimate = reference::estimate_rolling(half_space_case(scene));
        half_space                                = estimate.fields;
        target_creepage                           = -estimate.creepage.value;
      }
    else
      target_creepage = std::stod(scene.creepage);
    if (predicts_tractions && !scene.predicts_creepage())
      try
        {
          reference::RollingCase c = half_space_case(scene);
          c.prescribe_force        = false;
          c.creepage               = -target_creepage;
          half_space               = reference::estimate_rolling(c).fields;
        }
      catch (const std::exception &error)
        {
          predicts_tractions = false;
          progress.say(std::string("start without tractions: ") + error.what());
        }

    const auto measure_free_rolling = [&]() {
      contact.complete_state();
      free_creepage = contact.free_rolling_creepage(dynamics.positions().data()) - half_space_stretch(scene);
    };
    bool         free_rolling_known = false;
    unsigned int unloaded           = 0; // measurements in a row

    const auto after_each_measurement = [&](const unsigned int iteration, const double share) {
      if (interrupted())
        throw Interruption();
      unloaded = contact.total_impulse()[2] > 0. ? 0 : unloaded + 1;
      if (unloaded > 100)
        throw std::runtime_error(
          "the wheel finds no rail under it at the start: it sinks past what is meshed "
          "for contact; change 'Wheel/Lateral position (mm)' or 'Wheel/Tread profile'");
      if (predicts_tractions && !free_rolling_known && share <= std::max(scene.start_tolerance, 3e-4))
        {
          measure_free_rolling();
          free_rolling_known = true;
          // On a track those to the side, of spin, are left to build up: an iteration takes long to bend the
          // rail that way.
          contact.give_tractions([half_space, to_the_side = !supports, x = hub.motion.x,
                                  y = scene.first_contact().y](const Row place) {
            const Row ratio = traction_over_pressure(half_space, place[0] - x, place[1] - y);
            return Row{ratio[0], to_the_side ? ratio[1] : 0., 0., 0.};
          });
        }
      if (progress.due())
        progress.show(format("start: iteration %u, force balance %.1e of the load", iteration, share));
    };
    relaxation_iterations =
      dynamics.relax(scene.start_tolerance, scene.start_iterations, after_each_measurement);
    if (!free_rolling_known)
      measure_free_rolling();
    relaxation_seconds = progress.seconds() - began;
    check_rim();
    // Cells deformed by earlier wheels may have become slower or faster.
    if (!passages.empty())
      dynamics.renew_critical_time_step();
    progress.say(
      format("start: equilibrium after %.0f iterations, %.1f s; normal force %.2f kN; free rolling at %.2e",
             relaxation_iterations, relaxation_seconds, 1e-3 * contact.total_impulse()[2], free_creepage));

    contact.give_tractions({});
    hub.drive             = Drive::creepage;
    hub.motion.velocity_x = scene.speed();
    hub.motion.angular_velocity =
      scene.speed() / scene.rolling_radius() * (1. + target_creepage + free_creepage);
    if (supports)
      dynamics.set_track_velocities();
    dynamics.set_wheel_velocities();
    contact.scale_impulses(scene.courant_number * dynamics.critical_time_step());
    dynamics.start();
    interval_start_time  = dynamics.time;
    interval_start_speed = hub.motion.velocity_z;
  }


  void Simulation::set_drive()
  {
    if (scene.drive == "torque" && !torque_released &&
        position() >= scene.path_begin() + 1e-3 * scene.hold_mm)
      {
        hub.drive        = Drive::torque;
        hub.drive_torque = scene.traction_coefficient * scene.static_load() *
                           (hub.motion.z + scene.rolling_radius() - scene.axle_height());
        torque_released = true;
      }
  }


  void Simulation::add_to_interval()
  {
    const Row force = (1. / dynamics.time_step) * contact.total_impulse();
    interval_force += force;
    ++interval_steps;
    if (position() <= scene.path_end() && position() >= scene.path_end() - 10e-3)
      {
        last_force_sum += force;
        last_force_low  = std::min(last_force_low, force[2]);
        last_force_high = std::max(last_force_high, force[2]);
        ++last_steps;
      }
    if (std::abs(position() - scene.path_end()) <= 0.5e-3 * scene.finest_mm)
      average.add(contact.active_nodes(), position(), dynamics.time_step);
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
    row.time     = dynamics.time;
    row.position = position();
    row.force    = (1. / interval_steps) * interval_force;
    row.creepage = hub.motion.angular_velocity * scene.rolling_radius() / scene.speed() - 1. - free_creepage;
    row.patch    = measure(patch_now());
    row.energy   = dynamics.ledger();
    row.axle_box_acceleration =
      (hub.motion.velocity_z - interval_start_speed) / (dynamics.time - interval_start_time);
    row.supports = support_records();
    if (probes)
      row.cells = probes->record(dynamics);
    if (strip)
      strip->sample(dynamics, position());
    folder.append(row);
    interval_start_time  = dynamics.time;
    interval_start_speed = hub.motion.velocity_z;
    interval_force       = Row{};
    interval_steps       = 0;
  }


  std::vector<PatchNode> Simulation::patch_now() const
  {
    return patch_nodes(contact.active_nodes(), position(), dynamics.time_step);
  }


  void Simulation::take_solution(RunFolder &folder)
  {
    solution_patch = patch_now();
    solution_taken = true;
    folder.write_patch("patch.csv", solution_patch);
    if (scene.table_depth_mm > 0.)
      folder.write_rail_tables(dynamics, rail_body, 1e-3 * scene.table_depth_mm);
    folder.write_surface(dynamics, contact, rail_body);
    if (scene.write_volume)
      folder.write_volume(dynamics, hub, wheel_body);
  }


  void Simulation::next_wheel(Progress &progress)
  {
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == wheel_body)
        dynamics.set_position(i, Row{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.});
    solid.plastic().forget(wheel_body, dynamics.history);
    hub.motion = WheelHub::Motion();
    hub.place(scene.path_begin(), scene.axle_height());
    hub.motion.angular_velocity = scene.speed() / scene.rolling_radius();
    contact.scale_impulses(0.);
    torque_released = solution_taken = false;
    checked_position                 = position();
    average                          = PatchAverage();
    last_force_sum                   = Row{};
    last_force_low                   = 1e300;
    last_force_high                  = -1e300;
    last_steps                       = 0;
    prepare_start(progress);
  }


  bool Simulation::run(const std::string &path, const bool resume)
  {
    Progress   progress(dealii::Utilities::MPI::this_mpi_process(comm) == 0);
    RunFolder  folder(path, comm);
    Checkpoint checkpoint(folder, comm);
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);

    if (resume && folder.is_complete())
      {
        progress.say("the run in '" + path +
                     "' is complete: nothing to resume; without --resume it starts anew");
        return true;
      }
    if (resume)
      checkpoint.read(*this);
    const double seconds_before = wall_seconds;

    std::ostringstream effective;
    scene.print(effective, true);
    folder.write("parameters.prm", effective.str());
    progress.say("tread " + version() + (scene.title.empty() ? "" : ": " + scene.title));
    progress.say(format("%llu cells, %llu unknowns, %u rank(s), %u lanes",
                        (unsigned long long)mesh.n_global_cells,
                        3ull * (mesh.n_global_nodes - mesh.n_global_hanging_nodes),
                        dealii::Utilities::MPI::n_mpi_processes(comm), n_lanes));
    for (const std::string &assumption : scene.assumptions())
      progress.say("assumed: " + assumption);
    const double gain = dynamics.ideal_gain_of_levels(), updates_of_step = mesh.n_global_cells / gain;
    if (gain > 1.)
      progress.say(
        format("time steps in %u levels: 1/%.2f of the cell updates", dynamics.max_level() + 1, gain));

    if (resume)
      progress.say(
        format("resumed at %.2f mm, step %llu", 1e3 * position(), (unsigned long long)dynamics.n_steps));
    else
      {
        try
          {
            prepare_start(progress);
          }
        catch (const Interruption &)
          {
            progress.say("INTERRUPTED before the wheel rolled: there is nothing to go on from");
            return false;
          }
        folder.remove_results();
      }
    // Times are written with twelve digits.
    folder.open_histories(resume, dynamics.time + 0.5 * dynamics.time_step, scene.recorded_supports(),
                          probes ? probes->centres().size() : 0);
    checked_position = position();

    std::uint64_t       n_steps    = dynamics.n_steps + remaining_steps();
    const std::uint64_t first_step = dynamics.n_steps;
    progress.say(format("time step %.4g ns, %llu steps to roll %.1f mm", 1e9 * dynamics.time_step,
                        (unsigned long long)(n_steps - first_step), 1e3 * (end_position - position())));
    const double loop_began   = progress.seconds();
    double       last_written = loop_began;
    // mpirun gives its ranks a second to end after Ctrl-C.
    constexpr unsigned int steps_between_checks = 100, steps_between_signals = 10, steps_between_looks = 200;
    std::uint64_t next_check = dynamics.n_steps + steps_between_checks, next_signal = dynamics.n_steps,
                  next_look = dynamics.n_steps + steps_between_looks; // at the cells
    End end                 = End::complete;
    while (dynamics.n_steps < n_steps)
      {
        set_drive();
        dynamics.step();
        add_to_interval();
        if (!dynamics.synchronised())
          continue;
        if (contact.contact_at_rim())
          {
            dynamics.check_stability();
            end = End::left_surface;
            break;
          }

        if (!solution_taken && position() >= scene.path_end())
          take_solution(folder);
        if (interval_ended(scene.history_mm))
          end_interval(folder);
        if (interval_ended(scene.surface_mm))
          folder.write_surface(dynamics, contact, rail_body);
        if (scene.write_volume && interval_ended(scene.volume_mm))
          folder.write_volume(dynamics, hub, wheel_body);
        checked_position = position();

        if (dynamics.n_steps >= next_look || dynamics.n_steps == n_steps)
          {
            next_look = dynamics.n_steps + steps_between_looks;
            dynamics.check_cells();
          }

        // Before any checkpoint, so that none is made of a wheel at its end.
        if (dynamics.n_steps == n_steps && passages.size() + 1 < scene.passages)
          {
            if (interval_steps > 0)
              end_interval(folder);
            end_passage(folder);
            progress.say(format("passage %u of %u: settlement %.2f um, largest plastic strain %.3f %%",
                                unsigned(passages.size()), scene.passages, 1e6 * passages.back().settlement,
                                100. * passages.back().plastic_strain));
            try
              {
                next_wheel(progress);
              }
            catch (const Interruption &)
              {
                progress.say("INTERRUPTED between two passages: --resume goes on from the last checkpoint");
                return false;
              }
            n_steps = dynamics.n_steps + remaining_steps();
          }

        if (dynamics.n_steps >= next_signal)
          {
            next_signal = dynamics.n_steps + steps_between_signals;
            if (interrupted())
              {
                end = End::interrupted;
                break;
              }
          }
        if (dynamics.n_steps >= next_check)
          {
            next_check = dynamics.n_steps + steps_between_checks;
            dynamics.check_stability();
            const double now       = progress.seconds();
            const bool   write_now = dealii::Utilities::MPI::max(
                scene.checkpoint_minutes > 0. && now - last_written > 60. * scene.checkpoint_minutes ? 1 : 0,
              comm);
            if (write_now)
              {
                wall_seconds = seconds_before + now;
                checkpoint.write(*this);
                last_written = now;
              }
            if (progress.due())
              {
                const Row    force = (1. / dynamics.time_step) * contact.total_impulse();
                const double spent = now - loop_began, done = dynamics.n_steps - first_step;
                progress.show(
                  format("x %8.2f mm  N %7.2f kN  T/N %+.4f  %5.1f ns/update/rank  %5.0f s left",
                         1e3 * position(), 1e-3 * force[2], force[0] / force[2],
                         1e9 * spent / done / updates_of_step * dealii::Utilities::MPI::n_mpi_processes(comm),
                         spent / done * (n_steps - dynamics.n_steps)));
              }
          }
      }
    wall_seconds = seconds_before + progress.seconds();
    std::exception_ptr no_checkpoint;
    if (end == End::interrupted)
      try
        {
          checkpoint.write(*this);
        }
      catch (const std::exception &)
        {
          no_checkpoint = std::current_exception(); // what was computed is kept all the same
        }
    else
      {
        if (interval_steps > 0)
          end_interval(folder);
        if (scene.passages > 1 && end == End::complete)
          end_passage(folder);
      }
    finish(folder, end);
    check_rim();
    if (no_checkpoint)
      std::rethrow_exception(no_checkpoint);
    return end == End::complete;
  }


  void Simulation::check_rim() const
  {
    if (const auto place = contact.contact_at_rim())
      throw std::runtime_error(format(
        "contact leaves what is meshed for it at x = %.2f mm, y = %.2f mm: raise 'Mesh/Fine half width "
        "(mm)' or change 'Wheel/Lateral position (mm)'",
        1e3 * (*place)[0], 1e3 * (*place)[1]));
  }
} // namespace tread
