// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_recorders_end_of_way_h
#define tread_recorders_end_of_way_h

#include <tread/model/model.h>
#include <tread/recorders/force_ripple.h>
#include <tread/recorders/recorder.h>

#include <cstdint>
#include <vector>

namespace tread
{
  /// Mean, least and largest of a force over steps.
  class MeanForce
  {
  public:
    void add(const Vector3 force); ///< N

    /// @pre something was added
    Vector3 mean() const
    {
      return (1. / n) * sum;
    }
    bool is_empty() const
    {
      return n == 0;
    }
    /// Largest deviation of the normal force from its mean, over the mean; 0 where that is not positive.
    double ripple() const;

    void serialize(Archive &archive)
    {
      archive.same(n, sum, low, high);
    }

  private:
    std::uint64_t n = 0;
    Vector3       sum{};
    double        low = 1e300, high = -1e300; ///< of the normal force
  };

  /// The forces of the summary: means over the last piece of the way before the solution instant.
  class EndOfWay : public Recorder
  {
  public:
    /// A dozen rows of cells of a millimetre, over which what single nodes do as they enter the patch has
    /// cancelled, m.
    static constexpr double length = 10e-3;

    explicit EndOfWay(const Model &model);

    /// Mean force on a wheel, or the present one if its last piece has not begun, N.
    Vector3 force_on(const RollingWheel &wheel) const;
    /// @see MeanForce::ripple
    double normal_ripple() const
    {
      return forces.front().ripple();
    }
    /// Of the first wheel.
    const ForceRipple &ripple() const
    {
      return tangential;
    }

    void add_step() override;
    void forget_solution() override;
    void finish(Report &report) override;
    void serialize(Archive &archive) override;

  private:
    const Model           &model;
    std::vector<MeanForce> forces; ///< by wheel
    ForceRipple            tangential;
  };
} // namespace tread

#endif
