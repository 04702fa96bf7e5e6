// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_recorders_solution_h
#define tread_recorders_solution_h

#include <tread/analysis/contact_patch.h>
#include <tread/model/model.h>
#include <tread/recorders/recorder.h>

#include <vector>

namespace tread
{
  /// The patches at the solution instant, and their means while a wheel rolls over one cell around it.
  class Solution : public Recorder
  {
  public:
    explicit Solution(Model &model);

    /// Whether that instant was reached.
    bool is_taken() const
    {
      return taken;
    }
    /// The patches then, or at present if it has not been reached. Collective.
    std::vector<std::vector<PatchNode>> patches() const;

    /// Means of the first wheel.
    const PatchAverage &average() const
    {
      return wheels.front().average;
    }
    /// Means of one of the patches of a wheelset in a given position, in its contact axes.
    const PatchAverage &average_of_patch(const unsigned int patch) const
    {
      return averages_of_patches[patch];
    }
    /// Measures of the means; without them, those of one patch.
    PatchMeasures measures(const RollingWheel &wheel, const std::vector<PatchNode> &patch) const;

    void add_step() override;
    void take_solution(RunFolder &folder) override;
    void forget_solution() override;
    void finish(Report &report) override;
    void serialize(Archive &archive) override;

  private:
    void place_wheelset();
    void make_room_for_patches();

    struct OfWheel
    {
      PatchAverage           average;
      std::vector<PatchNode> patch; ///< at the solution instant
    };

    Model                    &model;
    std::vector<OfWheel>      wheels;
    std::vector<PatchAverage> averages_of_patches; ///< of the first wheel, if it is in a given position
    bool                      taken = false;
  };
} // namespace tread

#endif
