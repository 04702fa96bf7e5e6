// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_simulation_rolling_wheel_h
#define tread_simulation_rolling_wheel_h

#include <tread/analysis/contact_patch.h>
#include <tread/analysis/wheelset_contact.h>
#include <tread/base/archive.h>
#include <tread/output/records.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/scene.h>
#include <tread/track/wheel_hub.h>

#include <cstdint>
#include <vector>

namespace tread
{
  /// One wheel on its way over the rail: its body and hub, how it is driven, and what is recorded of it.
  class RollingWheel
  {
  public:
    /// @param number of the wheel in the scene; 0 runs ahead of the others.
    RollingWheel(const Scene &scene, const unsigned int number);

    /// Put the wheel where its path begins, at rest but for its nominal angular velocity, and forget what was
    /// recorded.
    void place(const Scene &scene);
    /// Forget what was recorded about the solution instant.
    void forget_records(const Scene &scene);

    /// Angular velocity x rolling radius over speed, - 1, counted from free rolling.
    double creepage(const Scene &scene) const;

    /// Where the wheelset stands in the track at present. @pre scene.is_positioned()
    WheelsetPosition position(const Scene &scene) const;
    /// How the wheelset turns and moves across the track at present. @pre scene.is_positioned()
    WheelsetRates rates(const Scene &scene) const;

    /// Add the force of a step (N) to the mean over the end of the way.
    void add_to_last_force(const Vector3 force);

    /// Mean force over the end of the way, N. @param n_steps so many were added
    Vector3 mean_last_force(const std::uint64_t n_steps) const
    {
      return (1. / n_steps) * last_force_sum;
    }

    /// Largest deviation of the normal force from its mean over the end of the way, over the mean. @param
    /// mean normal force, N
    double ripple(const double mean) const;

    /// Measures averaged while the wheel rolls over one cell around the solution instant; without them, those
    /// of one patch.
    PatchMeasures averaged_measures(const std::vector<PatchNode> &patch) const
    {
      return average.n_steps() > 0 ? average.measures() : measure(patch);
    }

    /// The row of the history since the last one, which begins anew. @param n_steps in it; @param seconds
    WheelRecord end_interval(const Scene                  &scene,
                             const std::vector<PatchNode> &now,
                             const unsigned int            n_steps,
                             const double                  seconds);

    /// Store or restore all but the hub, which belongs to the dynamics.
    void serialize(Archive &archive);

    unsigned int number, body;
    WheelHub     hub;
    double       target_creepage = 0., free_creepage = 0.;

    Vector3 interval_force{};          ///< sum since the last row of the history, N
    Vector3 interval_other_force{};    ///< the same of the other wheel of the wheelset
    double  interval_inner_force = 0.; ///< vertical, of the inner one of two pieces of a rail of slices
    double  interval_start_speed = 0.; ///< of the hub, vertical, m/s

    PatchAverage average; ///< while the wheel rolls over one cell around the solution instant
    /// The same for each patch of a wheelset in a given position, in its contact axes.
    std::vector<PatchAverage> averages_of_patches;
    std::vector<PatchNode>    solution_patch;

  private:
    Vector3 last_force_sum{};
    double  last_force_low = 1e300, last_force_high = -1e300;
  };
} // namespace tread

#endif
