// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_simulation_simulation_h
#define tread_simulation_simulation_h

#include <tread/analysis/contact_patch.h>
#include <tread/analysis/rail_stress.h>
#include <tread/base/archive.h>
#include <tread/contact/contact.h>
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/mesh/mesh.h>
#include <tread/output/progress.h>
#include <tread/output/run_folder.h>
#include <tread/output/summary.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/scene.h>
#include <tread/solid/solid.h>
#include <tread/track/wheel_hub.h>

#include <mpi.h>

#include <memory>
#include <vector>


namespace tread
{
  class Checkpoint;

  /// One wheel rolling over one rail, from equilibrium at the start to the solution instant.
  class Simulation
  {
  public:
    Simulation(const Scene &scene, const MPI_Comm comm);

    /// Print the cost of a run without running it or writing anything.
    void estimate();

    /// @param folder of the results; @param resume from its last checkpoint.
    /// @returns false when interrupted by a signal.
    bool run(const std::string &folder, const bool resume);

    /// Store the state between two steps, or restore it in a simulation that was just made. Collective.
    void serialize(Archive &archive);

  private:
    void                       prepare_start(Progress &progress);
    void                       set_drive();
    std::vector<SupportRecord> support_records() const;
    void                       add_to_interval();
    void                       end_interval(RunFolder &folder);
    std::vector<PatchNode>     patch_now() const;
    /// Measures of the patch at the solution instant, or at present if it has not been reached.
    PatchMeasures measures_of_solution() const;
    void          take_solution(RunFolder &folder);
    void          end_passage(RunFolder &folder);
    void          next_wheel(Progress &progress);
    /// How a run ends.
    enum class End
    {
      complete,
      interrupted,      ///< by a signal
      between_passages, ///< by a signal, with nothing to keep
      left_surface      ///< contact was about to leave the faces meshed for it
    };
    /// How fast steps are taken since the loop began, and when the last checkpoint was written.
    struct Pace
    {
      double        began; ///< wall time, s
      std::uint64_t first_step;
      double        last_checkpoint; ///< wall time, s
      double        updates_of_step; ///< of cells of all ranks
    };
    void announce(Progress &progress) const;
    End  roll(RunFolder &folder, Checkpoint &checkpoint, Progress &progress);
    void write_what_is_due(RunFolder &folder);
    /// @returns false when interrupted by a signal.
    bool change_wheels(RunFolder &folder, Progress &progress);
    void keep_checkpoint(Checkpoint &checkpoint, const Progress &progress, Pace &pace);
    /// Not collective: only rank 0 has something to show.
    void show_pace(Progress &progress, const Pace &pace, const std::uint64_t steps_left) const;
    void finish(RunFolder &folder, const End end);
    /// Compare the answer with Kalker's solution for the forces that act. If (nearly) the whole patch slips,
    /// the forces say little about the creepage, and the solution is that for the creepage. @returns the
    /// half-space patch.
    std::vector<PatchNode> compare_with_half_space(Summary &summary, const ContactAnswer &answer) const;
    /// Distance rolled since the start, or since a torque acts, in lengths of the patch.
    struct Rolled
    {
      double patch_lengths, lengths_to_be_steady;
      bool   long_enough() const
      {
        return patch_lengths >= lengths_to_be_steady;
      }
    };
    Rolled add_size(Summary &summary, const double normal_force) const;
    void   add_cost(Summary &summary) const;
    void   add_recorded(Summary &summary, RunFolder &folder) const;
    /// @throws std::runtime_error if contact is about to leave the faces meshed for it.
    void   check_rim() const;
    bool   interrupted() const;
    double position() const
    {
      return hub.motion.x;
    }
    std::uint64_t remaining_steps() const;
    /// Whether the wheel has passed, since checked_position, the end of one of the intervals into which the
    /// path is divided; never for an interval of 0. No sums are used, so that a resumed run finds the same.
    bool   interval_ended(const double interval) const;
    double memory_of_cells_and_nodes() const; // bytes, of all ranks

    static constexpr unsigned int rail_body = 0, wheel_body = 1;

    const Scene                 &scene;
    MPI_Comm                     comm;
    Mesh                         mesh;
    Solid                        solid;
    WheelHub                     hub;
    ExplicitDynamics             dynamics;
    Contact                      contact;
    std::unique_ptr<Supports>    supports; ///< none: the rail's bottom is held
    std::unique_ptr<StressStrip> strip;    ///< none: no table
    std::unique_ptr<CellProbes>  probes;   ///< none: no table

    double target_creepage = 0., free_creepage = 0., end_position;
    bool   torque_released = false, solution_taken = false;

    // Sums since the last row of the history.
    Row          interval_force{};
    unsigned int interval_steps      = 0;
    double       interval_start_time = 0., interval_start_speed = 0.; ///< of the hub, vertical: m/s
    double       checked_position = 0.; ///< of the wheel when the ends of intervals were last checked, m

    PatchAverage           average; ///< while the wheel rolls over one cell around the solution instant
    std::vector<PatchNode> solution_patch;
    Row                    last_force_sum{}; ///< over the last 10 mm before the solution instant
    double                 last_force_low = 1e300, last_force_high = -1e300;
    std::uint64_t          last_steps = 0;
    std::vector<Passage>   passages;
    double                 relaxation_seconds = 0., relaxation_iterations = 0.;
    double                 wall_seconds   = 0.; ///< including the parts before resuming
    double                 seconds_before = 0.; ///< those parts
  };
} // namespace tread

#endif
