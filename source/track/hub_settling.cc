// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/track/hub_settling.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tread
{
  double SettlingOfHub::mass() const
  {
    const double per_radian = time / (2. * std::numbers::pi);
    return std::max(stiffness * per_radian * per_radian, carried_mass);
  }


  double SettlingOfHub::damping() const
  {
    return std::sqrt(stiffness * (mass() + cell_mass));
  }


  double SettlingOfHub::companion_mass() const
  {
    return 4. * (mass() + cell_mass);
  }


  std::optional<double> HubSettling::mass() const
  {
    return settling ? std::make_optional(settling->mass()) : std::nullopt;
  }


  double HubSettling::roll_inertia() const
  {
    return per_roll() * settling->mass();
  }


  void HubSettling::count(const double carried, const double cells)
  {
    if (!settling)
      return;
    settling->carried_mass = carried;
    settling->cell_mass    = cells;
  }


  void HubSettling::place()
  {
    companions = Companions();
  }


  void HubSettling::begin(HubMotion &motion, const double speed)
  {
    companions = {speed, motion.roll_rate};
    if (settling && curvature_of_way) // the suspension carries the load, and nothing else
      motion.sprung_velocity = speed;
  }


  double HubSettling::damper(const double velocity,
                             double      &companion,
                             const double scale,
                             const double time_step) const
  {
    const double force = scale * settling->damping() * (companion - velocity);
    companion -= time_step * force / (scale * settling->companion_mass());
    return force;
  }


  double HubSettling::lift(const HubMotion &motion, const double time_step)
  {
    return settling ? damper(motion.velocity_z, companions.up, 1., time_step) : 0.;
  }


  double HubSettling::roll(const HubMotion &motion, const double time_step)
  {
    return settling ? damper(motion.roll_rate, companions.roll, per_roll(), time_step) : 0.;
  }


  double HubSettling::carry(HubMotion &motion, const double time_step)
  {
    if (!settling || !curvature_of_way)
      return 0.;
    const double acceleration = curvature_of_way(motion.x) * motion.velocity_x * motion.velocity_x;
    companions.up += time_step * acceleration;
    motion.sprung_velocity += time_step * acceleration;
    return (settling->mass() + settling->cell_mass) * acceleration;
  }


  void HubSettling::serialize(Archive &archive)
  {
    archive.same(companions);
  }
} // namespace tread
