// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/input_error.h>
#include <tread/model/wheelset_at_solution.h>
#include <tread/scene/wheelset_case.h>

namespace tread
{
  const PlacedWheel &WheelsetAtSolution::placed() const
  {
    return there ? *there : scene.placed_wheel();
  }


  const WheelStance &WheelsetAtSolution::stance() const
  {
    return there ? *there : scene.stance();
  }


  void WheelsetAtSolution::move_to(const Placement &now)
  {
    placement = now;
    solve();
  }


  void WheelsetAtSolution::solve()
  {
    WheelRolling rolling                  = wheel_rolling(scene, scene.path_end());
    static_cast<WheelsetRates &>(rolling) = placement->rates;
    try
      {
        there = std::make_shared<const PlacedWheel>(scene, placement->position, rolling);
      }
    catch (const InputError &error)
      {
        no_half_space = error.what();
      }
  }


  void WheelsetAtSolution::forget()
  {
    placement.reset();
    there.reset();
    no_half_space.clear();
  }


  void WheelsetAtSolution::serialize(Archive &archive)
  {
    archive.same(placement);
    if (placement && !there && no_half_space.empty())
      solve();
  }
} // namespace tread
