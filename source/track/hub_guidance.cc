// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/track/hub_guidance.h>

namespace tread
{
  void HubGuidance::follow(const std::function<Across(double)> &given)
  {
    kind   = Guidance::file;
    time   = 0.;
    across = given;
  }


  void HubGuidance::release(const GuidanceSprings &on, const double yaw)
  {
    kind         = Guidance::springs;
    time         = 0.;
    springs      = on;
    released_yaw = yaw;
  }


  void HubGuidance::begin(HubMotion &motion, const double time_step, const bool rolls) const
  {
    const Across now = across(0.), next = across(time_step);
    motion.velocity_y = (next.y - now.y) / time_step;
    motion.yaw_rate   = (next.yaw - now.yaw) / time_step;
    if (!rolls)
      motion.roll_rate = (next.roll - now.roll) / time_step;
  }


  double HubGuidance::advance(HubMotion       &motion,
                              const HubMotion &before,
                              const FreeHub   &hub,
                              const double     time_step)
  {
    if (kind == Guidance::rigid)
      {
        lateral = -hub.lateral;
        return 0.;
      }
    double yaw_support = 0.; // moment of guidance
    if (kind == Guidance::file)
      {
        const Across next = across(time + time_step);
        motion.velocity_y = (next.y - motion.y) / time_step;
        motion.yaw_rate   = (next.yaw - motion.yaw) / time_step;
        if (!hub.rolls)
          motion.roll_rate = (next.roll - motion.roll) / time_step;
        lateral     = hub.mass * (motion.velocity_y - before.velocity_y) / time_step - hub.lateral;
        yaw_support = hub.yaw_inertia * (motion.yaw_rate - before.yaw_rate) / time_step - hub.yaw_moment;
        // Free rolling may lie beside what theory takes for it.
        if (next.angular_velocity)
          motion.angular_velocity += *next.angular_velocity - *across(time).angular_velocity;
      }
    else
      {
        if (!springs.force)
          springs.force = -hub.lateral;
        if (!springs.moment)
          springs.moment = -hub.yaw_moment;
        lateral     = *springs.force - springs.stiffness * motion.y - springs.damping * motion.velocity_y;
        yaw_support = *springs.moment - springs.yaw_stiffness * (motion.yaw - released_yaw) -
                      springs.yaw_damping * motion.yaw_rate;
        motion.velocity_y += time_step * (hub.lateral + lateral) / hub.mass;
        if (hub.yaw_inertia > 0.)
          motion.yaw_rate += time_step * (hub.yaw_moment + yaw_support) / hub.yaw_inertia;
      }
    time += time_step;
    motion.y += time_step * motion.velocity_y;
    motion.yaw += time_step * motion.yaw_rate;
    if (!hub.rolls)
      motion.roll += time_step * motion.roll_rate;
    const double roll_support = hub.rolls ? 0. : hub.roll_moment; // about -x, against that of the cells
    return 0.5 * time_step *
           (lateral * (before.velocity_y + motion.velocity_y) +
            yaw_support * (before.yaw_rate + motion.yaw_rate) +
            roll_support * (before.roll_rate + motion.roll_rate));
  }


  void HubGuidance::serialize(Archive &archive)
  {
    archive.same(kind, time, lateral, springs, released_yaw);
  }
} // namespace tread
