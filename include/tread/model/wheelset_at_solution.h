// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_model_wheelset_at_solution_h
#define tread_model_wheelset_at_solution_h

#include <tread/analysis/wheelset_contact.h>
#include <tread/base/archive.h>
#include <tread/scene/scene.h>

#include <memory>
#include <optional>
#include <string>

namespace tread
{
  /// Where a wheelset stands in its track, and how it moves.
  struct Placement
  {
    WheelsetPosition position;
    WheelsetRates    rates;
  };

  /// A wheelset where half-space theory is compared with it: at the start, or where it has moved to when
  /// averaging for the solution instant begins.
  class WheelsetAtSolution
  {
  public:
    explicit WheelsetAtSolution(const Scene &scene)
      : scene(scene)
    {
    }

    /// @pre scene.is_positioned()
    const PlacedWheel &placed() const;
    /// The same, or an upright wheel, which stays one.
    const WheelStance &stance() const;

    bool has_moved() const
    {
      return placement.has_value();
    }
    /// Solve for where it has moved to; there may be no answer.
    void move_to(const Placement &now);
    void forget();

    /// Where it has moved to, if it has.
    const std::optional<Placement> &moved_to() const
    {
      return placement;
    }
    /// Why there is no half-space answer there; empty: there is one.
    const std::string &problem() const
    {
      return no_half_space;
    }

    void serialize(Archive &archive);

  private:
    void solve();

    const Scene                       &scene;
    std::optional<Placement>           placement;
    std::shared_ptr<const PlacedWheel> there;
    std::string                        no_half_space;
  };
} // namespace tread

#endif
