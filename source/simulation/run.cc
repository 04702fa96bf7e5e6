// SPDX-License-Identifier: LGPL-2.1-or-later
// From an empty folder, or a checkpoint, to the tables.
#include <tread/base/format.h>
#include <tread/base/stop_signal.h>
#include <tread/base/went_wrong.h>
#include <tread/scene/measured_profiles.h>
#include <tread/simulation/checkpoint.h>
#include <tread/simulation/simulation.h>

#include <deal.II/base/mpi.h>

#include "interruption.h"

namespace tread
{
  /// A run with its folder: one simulation, or one after the other as the window of fine cells moves.
  class Run
  {
  public:
    Run(const Scene &scene, const MPI_Comm comm, const std::string &path)
      : scene(scene)
      , comm(comm)
      , progress(dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      , folder(path, comm, scene.output.pictures)
      , checkpoint(folder, scene, comm)
    {
    }

    /// @returns false when interrupted by a signal.
    bool execute(const bool resume)
    {
      watch_stop_signals();
      if (resume && folder.is_complete() && !checkpoint.run_may_go_on())
        {
          checkpoint.require_parameters_of_run();
          progress.say("the run in '" + folder.path("") +
                       "' is complete: nothing to resume; without --resume it starts anew");
          return true;
        }
      simulation = std::make_unique<Simulation>(scene, comm, resume ? checkpoint.window() : WindowPlace());
      if (resume)
        go_on_from_checkpoint();
      simulation->seconds_before = simulation->wall_seconds;

      simulation->announce(progress);
      if (resume)
        progress.say(format("resumed at %.2f mm, step %llu", 1e3 * simulation->model.position(),
                            (unsigned long long)simulation->model.dynamics.state.n_steps));
      else if (!start())
        return false;
      open_tables(resume);
      simulation->checked_position = simulation->model.position();
      if (simulation->next_wheel_due && !simulation->begin_next_passage(progress))
        return false;
      return end_with(roll());
    }

  private:
    using End = Simulation::End;

    void go_on_from_checkpoint()
    {
      checkpoint.read(*simulation);
      // The patch is averaged over a cell at the end.
      const double position = simulation->model.position();
      if (simulation->went_on_at == position)
        require(position <= scene.path_end() - 0.5 * scene.mesh.finest_cell,
                "--resume: the wheel has rolled " + text_in_mm(position - scene.path_begin()) +
                  " mm already; 'Motion/Rolled distance (mm)' " + text_in_mm(scene.motion.rolled_distance) +
                  " is shorter, or longer by less than a cell");
    }

    /// @returns false when interrupted by a signal.
    bool start()
    {
      try
        {
          simulation->prepare_start(progress);
        }
      catch (const Interruption &)
        {
          progress.say("INTERRUPTED before the wheel rolled: there is nothing to go on from");
          return false;
        }
      folder.remove_results();
      return true;
    }

    void open_tables(const bool resume)
    {
      for (const auto &recorder : simulation->recorders)
        recorder->open(folder);
      // Nothing is refused any more.
      if (resume && folder.is_complete())
        folder.remove_solution();
      folder.write("parameters.prm", scene.parameters().of_run());
      MeasuredProfiles(scene).write(folder);
    }

    End roll()
    {
      End              end = End::of_window;
      Simulation::Pace pace{progress.seconds(), simulation->model.dynamics.state.n_steps, progress.seconds(),
                            simulation->model.mesh.n_global_cells /
                              simulation->model.dynamics.ideal_gain_of_levels()};
      simulation->announce_steps(progress);
      MPI_Pcontrol(1); // for profilers: here the steps begin
      try
        {
          while ((end = simulation->roll(folder, checkpoint, progress, pace)) == End::of_window)
            move_window();
          MPI_Pcontrol(0); // and here they end
          if (end == End::complete || end == End::left_surface)
            {
              if (simulation->history.has_begun())
                simulation->end_interval(folder);
              if (end == End::complete && scene.motion.may_go_on())
                checkpoint.write(*simulation);
            }
        }
      catch (const WentWrong &wrong)
        {
          simulation->pictures->write_volume(folder);
          throw WentWrong(wrong.what() + ("; " + folder.list_of_pictures("volume")) +
                          " ends with the bodies as they were then");
        }
      return end;
    }

    void move_window()
    {
      auto next = std::make_unique<Simulation>(scene, comm, simulation->next_window());
      next->go_on_from(*simulation);
      simulation = std::move(next);
    }

    /// @returns false when interrupted by a signal.
    bool end_with(const End end)
    {
      if (end == End::between_passages)
        return false;
      simulation->wall_seconds = simulation->seconds_before + progress.seconds();
      std::exception_ptr no_checkpoint;
      if (end == End::interrupted)
        try
          {
            checkpoint.write(*simulation);
          }
        catch (const std::exception &)
          {
            no_checkpoint = std::current_exception(); // what was computed is kept all the same
          }
      simulation->finish(folder, end);
      simulation->model.check_rim();
      if (no_checkpoint)
        std::rethrow_exception(no_checkpoint);
      return end == End::complete;
    }

    const Scene                &scene;
    const MPI_Comm              comm;
    Progress                    progress;
    RunFolder                   folder;
    Checkpoint                  checkpoint;
    std::unique_ptr<Simulation> simulation;
  };


  bool run(const Scene &scene, const MPI_Comm comm, const std::string &folder, const bool resume)
  {
    return Run(scene, comm, folder).execute(resume);
  }
} // namespace tread
