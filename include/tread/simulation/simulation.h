// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_simulation_simulation_h
#define tread_simulation_simulation_h

#include <tread/base/archive.h>
#include <tread/model/model.h>
#include <tread/output/progress.h>
#include <tread/output/quality.h>
#include <tread/output/run_folder.h>
#include <tread/recorders/end_of_way.h>
#include <tread/recorders/history.h>
#include <tread/recorders/passages.h>
#include <tread/recorders/pictures.h>
#include <tread/recorders/recorder.h>
#include <tread/recorders/solution.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/scene.h>
#include <tread/simulation/comparison.h>

#include <mpi.h>

#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>


namespace tread
{
  class Checkpoint;

  /// @throws InputError, before a mesh is made, if not even the finest cells of the paths fit into the
  /// memory. Collective.
  void require_memory(const Scene &scene, const MPI_Comm comm);

  /// Print what is known of the cost of a run whose mesh would take more than a few seconds to make. @returns
  /// whether this is such a run
  bool estimate_without_mesh(const Scene &scene, const MPI_Comm comm);

  /// Print the cost of a run without running it or writing anything. Collective.
  void estimate(const Scene &scene, const MPI_Comm comm);

  /// Roll a scene to its end, one simulation after the other where a window of fine cells moves with the
  /// wheel. @param folder of the results; @param resume from its last checkpoint.
  /// @returns false when interrupted by a signal. Collective.
  bool run(const Scene &scene, const MPI_Comm comm, const std::string &folder, const bool resume);

  /// Wheels rolling over one rail, from equilibrium at the start to the solution instant: a model, what is
  /// recorded of it, and the loop over the steps.
  class Simulation
  {
  public:
    Simulation(const Scene &scene, const MPI_Comm comm, const WindowPlace &window = {});

    /// Store the state between two steps, or restore it in a simulation that was just made. Collective.
    void serialize(Archive &archive);

    /// Where its cells are fine.
    const WindowPlace window;

  private:
    friend class Run;

    /// How a run ends.
    enum class End
    {
      complete,
      interrupted,      ///< by a signal
      between_passages, ///< by a signal; the checkpoint of the last passage's end is kept
      left_surface,     ///< contact was about to leave the faces meshed for it
      of_window         ///< the next one is due
    };
    /// How fast steps are taken since the loop began, and when the last checkpoint was written.
    struct Pace
    {
      double        began; ///< wall time, s
      std::uint64_t first_step;
      double        last_checkpoint; ///< wall time, s
      double        updates_of_step; ///< of cells of all ranks
    };

    template <typename R, typename... Arguments>
    R &record(Arguments &&...arguments)
    {
      auto recorder = std::make_unique<R>(std::forward<Arguments>(arguments)...);
      R   &added    = *recorder;
      recorders.push_back(std::move(recorder));
      return added;
    }
    void add_recorders();

    /// What has no nodes or cells of the mesh.
    void serialize_records(Archive &archive);
    /// Where the next window begins.
    WindowPlace next_window() const;
    /// Whether the first wheel has come to the end of the window. @returns false in the last one
    bool at_end_of_window() const;
    /// Take over the motion and all that is recorded. @see ExplicitDynamics::go_on_from
    void go_on_from(Simulation &before);

    void prepare_start(Progress &progress);
    /// Traction on the wheel over the pressure [-] at a place whose x is from the wheel's; none: not known.
    using Tractions = std::function<Vector3(const Vector3 &)>;
    /// Half-space theory's rolling for a wheel's start, from which its creepage is taken if it is to be
    /// predicted. @returns its tractions, none where they are not wanted.
    Tractions predict_rolling(RollingWheel &wheel, Progress &progress) const;
    void      set_drive();

    void announce(Progress &progress) const;
    void announce_steps(Progress &progress) const;
    End  roll(RunFolder &folder, Checkpoint &checkpoint, Progress &progress, Pace &pace);
    void write_what_is_due(RunFolder &folder);
    void end_interval(RunFolder &folder);
    /// @throws WentWrong if too much energy is not accounted for.
    void watch(const EnergyLedger &energy) const;
    void forget_solution();
    void next_passage(Progress &progress);
    /// Begin the next passage, or a later one where some are left out. @returns false when interrupted by a
    /// signal.
    bool change_wheels(Checkpoint &checkpoint, Progress &progress);
    bool begin_next_passage(Progress &progress);
    void keep_checkpoint(Checkpoint &checkpoint, const Progress &progress, Pace &pace);
    /// Not collective: only rank 0 has something to show.
    void show_pace(Progress &progress, const Pace &pace, const std::uint64_t steps_left) const;
    bool interrupted() const;

    void finish(RunFolder &folder, const End end);
    /// Distance rolled since the start, or since a torque acts, in lengths of the patch.
    struct Rolled
    {
      double patch_lengths, lengths_to_be_steady;
      bool   long_enough() const
      {
        return patch_lengths >= lengths_to_be_steady;
      }
    };
    Rolled  add_size(Summary &summary, const double normal_force) const;
    void    add_cost(Summary &summary) const;
    Quality quality(const EnergyLedger &energy) const;
    void    add_warnings(Report &report, const EnergyLedger &energy, const Rolled &rolled) const;
    /// run.h5 and the summary.
    void write_last(const Report &report) const;
    /// On the screen, on rank 0. @param below lines below the table of the answer
    void show(const Report &report, const Compared &compared, const std::string &below, const End end) const;

    const Scene                    &scene;
    const std::vector<Scene::Range> windows; ///< of the whole run
    MPI_Comm                        comm;
    Model                           model;
    AddedMass                       added_mass; ///< the largest of all windows so far

    std::vector<std::unique_ptr<Recorder>> recorders; ///< in the order in which they are asked
    EndOfWay                              &end_of_way;
    Solution                              &solution;
    History                               &history;
    Pictures                              *pictures = nullptr;
    Passages                              *passages = nullptr; ///< null: one passage

    double went_on_at = std::numeric_limits<double>::lowest(); ///< x where it was resumed for a longer way, m
    double checked_position      = 0.; ///< of the first wheel when recorders were last asked what is due, m
    bool   torque_released       = false;
    bool   starts_with_tractions = false; ///< those that half-space theory predicts
    bool   next_wheel_due        = false; ///< a passage has ended, the next wheel has not begun

    double relaxation_seconds = 0., relaxation_iterations = 0.;
    double wall_seconds   = 0.; ///< including the parts before resuming
    double seconds_before = 0.; ///< those parts
  };
} // namespace tread

#endif
