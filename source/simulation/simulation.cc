// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/stop_signal.h>
#include <tread/base/version.h>
#include <tread/base/went_wrong.h>
#include <tread/recorders/on_demand.h>
#include <tread/recorders/surface_damage.h>
#include <tread/scene/assumptions.h>
#include <tread/scene/doubts.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/measured_profiles.h>
#include <tread/simulation/checkpoint.h>
#include <tread/simulation/doubts.h>
#include <tread/simulation/simulation.h>

#include <deal.II/base/mpi.h>

#include "interruption.h"

#include <algorithm>
#include <cmath>
#include <typeinfo>

namespace tread
{
  namespace
  {
    /// Something that is done after so many steps at the latest.
    struct EverySoManySteps
    {
      std::uint64_t steps, next;

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
    , windows(tread::windows(scene))
    , comm(comm)
    , model(scene, comm, window)
    , added_mass(model.added_mass())
    , end_of_way(record<EndOfWay>(model))
    , solution(record<Solution>(model))
    , history(record<History>(model))
  {
    add_recorders();
  }


  void Simulation::add_recorders()
  {
    SurfaceDamageRecorder *const damage =
      scene.damage.record ? &record<SurfaceDamageRecorder>(model) : nullptr;
    for (const auto make : recorders_on_demand())
      if (auto recorder = make(model, window))
        recorders.push_back(std::move(recorder));
    if (scene.motion.passages > 1)
      passages = &record<Passages>(model, end_of_way, solution);
    pictures = &record<Pictures>(model, damage);
  }


  void Simulation::serialize(Archive &archive)
  {
    model.dynamics.serialize(archive); // and hubs, supports and contact, which are attached to it
    serialize_records(archive);
  }


  void Simulation::serialize_records(Archive &archive)
  {
    for (const auto &kept : recorders)
      {
        Recorder &recorder = *kept;
        archive.kind(typeid(recorder));
        recorder.serialize(archive);
      }
    for (RollingWheel &wheel : model.wheels)
      wheel.serialize(archive);
    archive.same(torque_released, starts_with_tractions, next_wheel_due);
    archive.same(relaxation_seconds, relaxation_iterations, wall_seconds);
    double end = model.end_position();
    archive.same(end);
    archive.same(went_on_at);
    AddedMass largest = added_mass; // of all windows so far
    archive.same(largest.rail, largest.rail_share, largest.wheels, largest.wheels_share,
                 largest.error_estimate);
    added_mass.raise_to(largest);
    if (end != model.end_position()) // resumed for a longer way
      {
        forget_solution();
        went_on_at = model.position();
      }
  }


  void Simulation::forget_solution()
  {
    for (const auto &recorder : recorders)
      recorder->forget_solution();
  }


  bool Simulation::at_end_of_window() const
  {
    // The next mesh may have cells with longer steps than any of this one: they are due as well.
    const std::uint64_t together = std::uint64_t(1) << (scene.time_stepping.levels - 1);
    return window.number + 1 < windows.size() && model.dynamics.state.n_steps % together == 0 &&
           model.position() >= windows[window.number].end;
  }


  WindowPlace Simulation::next_window() const
  {
    return {window.number + 1, scene.wheel.radius * model.wheels.front().hub.motion.angle};
  }


  void Simulation::go_on_from(Simulation &before)
  {
    Archive kept(comm);
    before.model.dynamics.serialize_parts(kept);
    before.serialize_records(kept);
    Archive found(comm, kept.stored_by_all());
    model.dynamics.serialize_parts(found);
    serialize_records(found);
    for (std::size_t k = 0; k < recorders.size(); ++k)
      recorders[k]->take_over(*before.recorders[k]);
    model.dynamics.go_on_from(before.model.dynamics);
    checked_position = before.checked_position;
    seconds_before   = before.seconds_before;
  }


  bool Simulation::interrupted() const
  {
    return dealii::Utilities::MPI::max(static_cast<int>(stop_was_asked()), comm) != 0;
  }


  void Simulation::set_drive()
  {
    if (scene.motion.drive == Drive::torque && !torque_released &&
        model.position() >= scene.path_begin() + scene.motion.hold_distance)
      {
        for (RollingWheel &wheel : model.wheels)
          {
            wheel.hub.drive = Drive::torque;
            wheel.hub.drive_torque =
              scene.traction_coefficient(wheel.number) * scene.wheelset.n_wheels() * scene.static_load() *
              (scene.stance().rolling_radius() + wheel.hub.motion.z - wheel.hub.start()[2]);
          }
        torque_released = true;
      }
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
        energy.residual(), 1e3 * model.position(), (unsigned long long)model.dynamics.state.n_steps,
        energy.dissipated(), energy.stored_strain + energy.stored_hourglass, limit));
  }


  void Simulation::end_interval(RunFolder &folder)
  {
    const HistoryRow row     = history.row();
    const double     seconds = history.interval_seconds();
    for (const auto &recorder : recorders)
      recorder->add_row(row, seconds, folder);
    watch(row.energy);
  }


  void Simulation::announce(Progress &progress) const
  {
    progress.say("tread " + version() + (scene.general.title.empty() ? "" : ": " + scene.general.title));
    progress.say(format("%llu cells, %llu unknowns, %u rank(s), %u lanes",
                        (unsigned long long)model.mesh.n_global_cells,
                        3ull * (model.mesh.n_global_nodes - model.mesh.n_global_hanging_nodes),
                        dealii::Utilities::MPI::n_mpi_processes(comm), n_lanes));
    for (const std::string &assumption : assumptions(scene))
      progress.say("assumed: " + assumption);
    for (const std::string &unused : scene.unused_parameters())
      progress.say("WARNING: " + unused);
    if (const std::string defect = defect_in_words(scene); !defect.empty())
      progress.say(defect);
    for (const std::string &line : MeasuredProfiles(scene).smoothing())
      progress.say(line);
    if (const double gain = model.dynamics.ideal_gain_of_levels(); gain > 1.)
      progress.say(
        format("time steps in %u levels: 1/%.2f of the cell updates", model.dynamics.max_level() + 1, gain));
  }


  void Simulation::announce_steps(Progress &progress) const
  {
    progress.say(format("time step %.4g ns, %llu steps to roll %.1f mm", 1e9 * model.dynamics.state.time_step,
                        (unsigned long long)model.remaining_steps(),
                        1e3 * (model.end_position() - model.position())));
    for (const std::string &doubt : doubts_at_start(model))
      progress.say("WARNING: " + doubt);
  }


  Simulation::End Simulation::roll(RunFolder &folder, Checkpoint &checkpoint, Progress &progress, Pace &pace)
  {
    std::uint64_t n_steps = model.dynamics.state.n_steps + model.remaining_steps();
    // mpirun gives its ranks a second to end after Ctrl-C.
    EverySoManySteps    look_at_signals{10, model.dynamics.state.n_steps};
    const std::uint64_t between_checks = model.dynamics.steps_worth(100);
    EverySoManySteps    check{between_checks, model.dynamics.state.n_steps + between_checks};
    while (model.dynamics.state.n_steps < n_steps)
      {
        set_drive();
        model.dynamics.step();
        for (const auto &recorder : recorders)
          recorder->add_step();
        if (!model.dynamics.synchronised())
          continue;
        if (model.contact.contact_at_rim())
          {
            model.dynamics.check_stability();
            return End::left_surface;
          }
        write_what_is_due(folder);

        const bool at_end = model.dynamics.state.n_steps == n_steps, at_border = at_end_of_window(),
                   checks = check.due(model.dynamics.state.n_steps) || at_border;
        if (checks || at_end)
          {
            model.dynamics.check_stability();
            model.dynamics.critical_step().check_cells();
          }

        // Before any other checkpoint, so that none is made of a wheel at its end that does not know it.
        if (at_end && passages)
          {
            if (history.has_begun())
              end_interval(folder);
            passages->end(folder, progress);
            if (passages->is_last())
              return End::complete;
            if (!change_wheels(checkpoint, progress))
              return End::between_passages;
            n_steps = model.dynamics.state.n_steps + model.remaining_steps();
          }
        if (look_at_signals.due(model.dynamics.state.n_steps) && interrupted())
          return End::interrupted;
        if (checks)
          {
            keep_checkpoint(checkpoint, progress, pace);
            if (progress.due())
              show_pace(progress, pace, n_steps - model.dynamics.state.n_steps);
          }
        if (at_border)
          return End::of_window;
      }
    return End::complete;
  }


  void Simulation::write_what_is_due(RunFolder &folder)
  {
    const WayPassed way{scene.path_begin(), checked_position, model.position()};
    if (!solution.is_taken() && way.to >= scene.path_end())
      for (const auto &recorder : recorders)
        recorder->take_solution(folder);
    if (way.has_end_of(scene.output.history_interval))
      end_interval(folder);
    for (const auto &recorder : recorders)
      recorder->pass(way, folder);
    checked_position = way.to;
  }


  bool Simulation::change_wheels(Checkpoint &checkpoint, Progress &progress)
  {
    passages->begin_next(progress);
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
    watch(model.dynamics.ledger()); // nothing is kept to go on from that has gone wrong
    wall_seconds = seconds_before + now;
    checkpoint.write(*this);
    pace.last_checkpoint = now;
  }


  void Simulation::show_pace(Progress &progress, const Pace &pace, const std::uint64_t steps_left) const
  {
    const Vector3 force = model.force_on(model.wheels.front());
    const double  spent = progress.seconds() - pace.began,
                 done   = model.dynamics.state.n_steps - pace.first_step;
    progress.show(
      format("x %8.2f mm  N %7.2f kN  T/N %+.4f  %5.1f ns/update/rank  %5.0f s left", 1e3 * model.position(),
             1e-3 * force[2], force[2] > 0. ? force[0] / force[2] : 0.,
             1e9 * spent / done / pace.updates_of_step * dealii::Utilities::MPI::n_mpi_processes(comm),
             spent / done * steps_left));
  }
} // namespace tread
