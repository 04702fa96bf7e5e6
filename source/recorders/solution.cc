// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/recorders/solution.h>

#include <cmath>

namespace tread
{
  Solution::Solution(Model &model)
    : model(model)
    , wheels(model.wheels.size())
  {
    make_room_for_patches();
  }


  void Solution::make_room_for_patches()
  {
    averages_of_patches.assign(model.wheelset.stance().n_separate_patches(), PatchAverage());
  }


  std::vector<std::vector<PatchNode>> Solution::patches() const
  {
    if (!taken)
      return model.patches_now();
    std::vector<std::vector<PatchNode>> patches;
    for (const OfWheel &wheel : wheels)
      patches.push_back(wheel.patch);
    return patches;
  }


  PatchMeasures Solution::measures(const RollingWheel &wheel, const std::vector<PatchNode> &patch) const
  {
    const PatchAverage &average = wheels[wheel.number].average;
    return average.n_steps() > 0 ? average.measures() : measure(patch);
  }


  void Solution::add_step()
  {
    const Scene &scene = model.scene;
    if (!(std::abs(model.position() - scene.path_end()) <= 0.5 * scene.mesh.finest_cell))
      return;
    const bool differs_from_start =
      scene.guidance.kind != Guidance::rigid || scene.wheelset.has_flexible_axle() ||
      scene.rail.is_sliced() || scene.motion.drive == Drive::torque || !scene.contact.friction_places.empty();
    if (differs_from_start && !averages_of_patches.empty() && !model.wheelset.has_moved())
      place_wheelset();
    const auto   states    = model.contact_states();
    const double time_step = model.dynamics.state.time_step;
    for (const RollingWheel &wheel : model.wheels)
      {
        const double x = wheel.hub.motion.x;
        wheels[wheel.number].average.add(states[wheel.number], x, time_step);
        if (wheel.number == 0)
          for (unsigned int k = 0; k < averages_of_patches.size(); ++k)
            averages_of_patches[k].add(model.wheelset.placed().of_patch(k, states[wheel.number], x), x,
                                       time_step);
      }
  }


  void Solution::place_wheelset()
  {
    // Means over a cell begin half of it before the end of the path: so far it goes on with its rates.
    const Scene &scene = model.scene;
    Placement    at    = model.placement_now();
    const double rest  = (scene.path_end() - model.position()) / scene.motion.speed;
    at.position.shift += rest * at.rates.across_speed;
    at.position.yaw += rest * at.rates.yaw_rate;
    at.position.roll += rest * at.rates.roll_rate;
    at.position.along = scene.position_at(scene.path_end()).along;
    model.wheelset.move_to(at);
    make_room_for_patches();
  }


  void Solution::take_solution(RunFolder &folder)
  {
    const auto patches = model.patches_now();
    for (const RollingWheel &wheel : model.wheels)
      {
        wheels[wheel.number].patch = patches[wheel.number];
        folder.write_table(RunFolder::table_of_wheel("patch", wheel.number), patch_columns(),
                           patches[wheel.number]);
      }
    taken = true;
  }


  void Solution::forget_solution()
  {
    taken = false;
    model.wheelset.forget();
    wheels.assign(wheels.size(), OfWheel());
    make_room_for_patches();
  }


  void Solution::finish(Report &report)
  {
    if (average().n_steps() > 0)
      for (const RollingWheel &wheel : model.wheels)
        report.folder.write_table(RunFolder::table_of_wheel("patch_averaged", wheel.number), patch_columns(),
                                  wheels[wheel.number].average.nodes());
  }


  void Solution::serialize(Archive &archive)
  {
    model.wheelset.serialize(archive);
    if (model.wheelset.has_moved())
      make_room_for_patches();
    for (OfWheel &wheel : wheels)
      {
        wheel.average.serialize(archive);
        archive.same(wheel.patch);
      }
    for (PatchAverage &of_patch : averages_of_patches)
      of_patch.serialize(archive);
    archive.same(taken);
  }
} // namespace tread
