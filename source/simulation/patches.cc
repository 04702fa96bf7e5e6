// SPDX-License-Identifier: LGPL-2.1-or-later
// The patches of a run: nodes in contact by wheel, and the wheelset with whose patches they are compared.
#include <tread/scene/wheelset_case.h>
#include <tread/simulation/simulation.h>

namespace tread
{
  const PlacedWheel &Simulation::placed() const
  {
    return placed_at_solution ? *placed_at_solution : scene.placed_wheel();
  }


  void Simulation::place_at_solution()
  {
    WheelRolling rolling                  = wheel_rolling(scene, scene.path_end());
    static_cast<WheelsetRates &>(rolling) = placement_at_solution->rates;
    try
      {
        placed_at_solution =
          std::make_shared<const PlacedWheel>(scene, placement_at_solution->position, rolling);
        wheels.front().averages_of_patches.assign(placed_at_solution->patches().size(), PatchAverage());
      }
    catch (const InputError &error)
      {
        no_half_space = error.what();
      }
  }


  std::vector<std::vector<ContactNodeState>> Simulation::contact_states() const
  {
    std::vector<std::vector<ContactNodeState>> of_wheels(wheels.size());
    for (const ContactNodeState &state : contact.active_nodes())
      for (const RollingWheel &wheel : wheels)
        if (state.master_body == wheel.body)
          of_wheels[wheel.number].push_back(
            scene.is_positioned() ? placed().in_contact_axes(state, wheel.hub.motion.x) : state);
    return of_wheels;
  }


  std::vector<std::vector<PatchNode>> Simulation::patches_now() const
  {
    std::vector<std::vector<PatchNode>> patches;
    const auto                          states = contact_states();
    for (const RollingWheel &wheel : wheels)
      patches.push_back(patch_nodes(states[wheel.number], wheel.hub.motion.x, dynamics.state.time_step));
    return patches;
  }


  std::vector<std::vector<PatchNode>> Simulation::solution_patches() const
  {
    if (!solution_taken)
      return patches_now();
    std::vector<std::vector<PatchNode>> patches;
    for (const RollingWheel &wheel : wheels)
      patches.push_back(wheel.solution_patch);
    return patches;
  }
} // namespace tread
