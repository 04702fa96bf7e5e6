// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_simulation_simulation_h
#define tread_simulation_simulation_h

#include <tread/analysis/contact_patch.h>
#include <tread/analysis/rail_stress.h>
#include <tread/analysis/stress_peaks.h>
#include <tread/analysis/surface_damage.h>
#include <tread/base/archive.h>
#include <tread/contact/contact.h>
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/mesh/mesh.h>
#include <tread/output/progress.h>
#include <tread/output/run_folder.h>
#include <tread/output/summary.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/scene.h>
#include <tread/simulation/force_ripple.h>
#include <tread/simulation/impact_record.h>
#include <tread/simulation/passage_growth.h>
#include <tread/simulation/rolling_wheel.h>
#include <tread/solid/solid.h>
#include <tread/track/rail_seats.h>

#include <mpi.h>

#include <limits>
#include <memory>
#include <optional>
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

  /// Where the cells of a simulation are fine: the number of the window, and what touched in its middle when
  /// it began, arc length on the tread (m).
  struct WindowPlace
  {
    unsigned int number = 0;
    double       tread  = 0.;
  };

  /// Roll a scene to its end, one simulation after the other where a window of fine cells moves with the
  /// wheel. @param folder of the results; @param resume from its last checkpoint.
  /// @returns false when interrupted by a signal. Collective.
  bool run(const Scene &scene, const MPI_Comm comm, const std::string &folder, const bool resume);

  /// Wheels rolling over one rail, from equilibrium at the start to the solution instant.
  class Simulation
  {
  public:
    Simulation(const Scene &scene, const MPI_Comm comm, const WindowPlace &window = {});

    /// Print the cost of a run without running it or writing anything.
    void estimate();

    /// Store the state between two steps, or restore it in a simulation that was just made. Collective.
    void serialize(Archive &archive);

    /// Where its cells are fine.
    const WindowPlace window;

  private:
    friend class Run;

    /// What has no nodes or cells of the mesh.
    void serialize_records(Archive &archive);
    /// Where the next window begins.
    WindowPlace next_window() const;
    /// Whether the first wheel has come to the end of the window. @returns false in the last one
    bool at_end_of_window() const;
    /// Take over the motion and all that is recorded. @see ExplicitDynamics::go_on_from
    void go_on_from(Simulation &before);

    /// Forces of the summary are means over this end of the way before the solution instant, m: a dozen rows
    /// of cells of a millimetre, over which what single nodes do as they enter the patch has cancelled.
    static constexpr double last_way = 10e-3;

    void prepare_start(Progress &progress);
    /// Half-space theory's rolling for a wheel's start, from which its creepage is taken if it is to be
    /// predicted; nothing where tractions are not. @returns the fields of its tractions.
    std::optional<reference::RollingResult> predict_rolling(RollingWheel &wheel, Progress &progress) const;
    void                                    set_drive();
    std::vector<SupportRecord>              support_records() const;
    void                                    add_to_interval();
    void                                    look_for_peaks();
    void                                    end_interval(RunFolder &folder);
    /// @throws WentWrong if too much energy is not accounted for.
    void watch(const EnergyLedger &energy) const;
    /// The patch of each wheel. Collective.
    std::vector<std::vector<PatchNode>> patches_now() const;
    /// The patches at the solution instant, or at present if it has not been reached. Collective.
    std::vector<std::vector<PatchNode>> solution_patches() const;
    /// Nodes in contact with each wheel; of a wheelset in a given position with forces, normal and slip in
    /// the contact axes of their patches. Collective.
    std::vector<std::vector<ContactNodeState>> contact_states() const;
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
    /// Mean force on a wheel over the end of the way, or the present one if that has not begun, N.
    Vector3 last_force_on(const RollingWheel &wheel) const;
    /// The wheelset where half-space theory is compared with it: at the start, or where it has moved to. @pre
    /// scene.is_positioned()
    const PlacedWheel &placed() const;
    /// Where a wheelset stands in its track, and how it moves.
    struct Placement
    {
      WheelsetPosition position;
      WheelsetRates    rates;
    };
    /// @pre scene.is_positioned()
    Placement placement_now() const
    {
      return {wheels.front().position(scene), wheels.front().rates(scene)};
    }
    /// Solve for placement_at_solution.
    void place_at_solution();
    void take_solution(RunFolder &folder);
    /// Forget what was recorded about the solution instant, which is yet to come.
    void forget_solution();
    void write_volume(RunFolder &folder) const;
    void write_surface(RunFolder &folder) const;
    /// Made when it is first asked for. Collective.
    NodalStresses &nodal_stresses() const;
    /// Whether a place of the reference configuration is where passages are compared, in the middle of the
    /// path.
    bool is_in_middle(const dealii::Point<3> &p) const;
    void make_growth();
    void end_passage(RunFolder &folder, Progress &progress);
    void next_passage(Progress &progress);
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
    void announce(Progress &progress) const;
    void announce_steps(Progress &progress) const;
    End  roll(RunFolder &folder, Checkpoint &checkpoint, Progress &progress, Pace &pace);
    void write_what_is_due(RunFolder &folder);
    /// Begin the next passage, or a later one where some are left out. @returns false when interrupted by a
    /// signal.
    bool change_wheels(Checkpoint &checkpoint, Progress &progress);
    bool begin_next_passage(Progress &progress);
    void keep_checkpoint(Checkpoint &checkpoint, const Progress &progress, Pace &pace);
    /// Not collective: only rank 0 has something to show.
    void show_pace(Progress &progress, const Pace &pace, const std::uint64_t steps_left) const;
    void finish(RunFolder &folder, const End end);
    /// Compare the answer with Kalker's solution for the forces that act. If (nearly) the whole patch slips,
    /// or friction depends on slip, the forces say little about the creepage, and the solution is that for
    /// the creepage. @returns the half-space patch.
    std::vector<PatchNode> compare_with_half_space(Summary &summary, const ContactAnswer &answer) const;
    /// In words, that friction changes where a patch under this force (N) ends, or on the way there; or
    /// nothing.
    std::string friction_varies_at_end(const double normal_force) const;
    /// The same where half-space theory knows steady rolling. @param patch of the half-space; @returns why
    /// nothing is compared, or nothing
    std::string compare_with_steady_rolling(Summary                &summary,
                                            const ContactAnswer    &answer,
                                            std::vector<PatchNode> &patch) const;
    /// The first entries of the summary of a wheelset in a given position, beside the half-space's. @returns
    /// a table of its patches for the screen, and what the half-space cannot tell of them.
    std::string add_wheelset(Summary &summary, const bool completed) const;
    /// The patches of a wheelset in a given position in the half-space solver's terms: means while the wheel
    /// rolls over a cell.
    std::vector<WheelPatch> computed_patches() const;
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
    /// @returns a line for each on the screen.
    std::string add_further_wheels(Summary                                   &summary,
                                   const std::vector<std::vector<PatchNode>> &patches) const;
    void        add_cost(Summary &summary) const;
    /// A line if springs, dampers and masses make the time step much shorter than the cells do; else none.
    std::string slow_step() const;
    /// A warning where profiles have detail that the mesh does not see; empty: none.
    std::string unseen_detail() const;
    /// Those of the two that there are, for the screen at the start and for the summary.
    std::vector<std::string> doubts_at_start() const;
    /// Add why the answer is perhaps not that of steady rolling.
    void add_doubts(std::vector<std::string> &warnings) const;
    /// @returns lines about the largest stresses for the screen.
    std::string add_recorded(Summary &summary, RunFolder &folder) const;
    /// What several passages left in the steel. @returns a line of text, or none.
    std::string add_growth(Summary &summary, std::vector<std::string> &warnings) const;
    /// Tables and figures of what friction did to the surfaces.
    void        add_damage(Summary &summary, RunFolder &folder, std::vector<std::string> &warnings) const;
    std::string add_peaks(Summary &summary, RunFolder &folder, std::vector<std::string> &warnings) const;
    /// @throws std::runtime_error if contact is about to leave the faces meshed for it.
    void   check_rim() const;
    bool   interrupted() const;
    double position() const ///< of the first wheel, m
    {
      return wheels.front().hub.motion.x;
    }
    std::uint64_t remaining_steps() const;
    /// Whether the wheel has passed, since checked_position, the end of one of the intervals into which the
    /// path is divided; never for an interval of 0. No sums are used, so that a resumed run finds the same.
    bool   interval_ended(const double interval) const;
    double memory_of_cells_and_nodes() const; // bytes, of all ranks

    const Scene                   &scene;
    MPI_Comm                       comm;
    Mesh                           mesh;
    Solid                          solid;
    std::vector<RollingWheel>      wheels; ///< of fixed number
    ExplicitDynamics               dynamics;
    Contact                        contact;
    std::unique_ptr<Supports>      supports;                ///< none: the rail's bottom stays in shape
    std::unique_ptr<RailBase>      rail_base;               ///< none: without supports that is held
    std::unique_ptr<RailSeats>     seats;                   ///< none: no supports are recorded
    std::unique_ptr<StressStrip>   strip;                   ///< none: no table
    std::unique_ptr<CellProbes>    probes;                  ///< none: no table
    std::unique_ptr<StressPeaks>   rail_peaks, wheel_peaks; ///< none: no tables
    std::unique_ptr<SurfaceDamage> damage;                  ///< none: no tables

    const std::optional<double> between_pieces; ///< of a rail of slices, y (m)

    double end_position;                                       ///< of the first wheel, m
    double went_on_at = std::numeric_limits<double>::lowest(); ///< x where it was resumed for a longer way, m
    bool   torque_released = false, solution_taken = false;
    bool   starts_with_tractions = false; ///< those that half-space theory predicts

    ImpactRecord impacts;
    ForceRipple  ripple; ///< of the first wheel over the last way

    // Sums since the last row of the history.
    unsigned int interval_steps      = 0;
    double       interval_start_time = 0.;
    double checked_position = 0.; ///< of the first wheel when the ends of intervals were last checked, m

    /// Of a wheelset that does not stay as it starts, when averaging begins.
    std::optional<Placement>           placement_at_solution;
    std::shared_ptr<const PlacedWheel> placed_at_solution;
    std::string                        no_half_space; ///< why there is none there

    std::uint64_t                  last_steps = 0; ///< in the end of the way before the solution instant
    std::vector<Passage>           passages;
    std::unique_ptr<PassageGrowth> growth;          ///< none: one passage
    unsigned int                   skipped = 0;     ///< passages before the one that rolls
    bool   next_wheel_due                  = false; ///< a passage has ended, the next wheel has not begun
    double relaxation_seconds = 0., relaxation_iterations = 0.;
    double wall_seconds   = 0.; ///< including the parts before resuming
    double seconds_before = 0.; ///< those parts

    mutable std::unique_ptr<NodalStresses>
      stresses_at_nodes; ///< for pictures and tables; made when asked for
  };
} // namespace tread

#endif
