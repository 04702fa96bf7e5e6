// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/model/rolling_wheel.h>
#include <tread/scene/parts.h>
#include <tread/scene/wheelset_case.h>

#include <utility>

namespace tread
{
  RollingWheel::RollingWheel(const Scene &scene, const unsigned int number)
    : number(number)
    , body(wheel_body(number))
    , hub(hub_parameters(scene))
  {
    place(scene);
  }


  void RollingWheel::place(const Scene &scene)
  {
    hub.motion = WheelHub::Motion();
    scene.stance().place(hub, number);
  }


  double RollingWheel::creepage(const Scene &scene) const
  {
    return hub.motion.angular_velocity * scene.stance().rolling_radius() / scene.motion.speed - 1. -
           free_creepage;
  }


  WheelsetPosition RollingWheel::position(const Scene &scene) const
  {
    return {scene.wheelset.position().shift + hub.motion.y, hub.motion.yaw, hub.motion.roll,
            scene.placed_wheel().contact.position.height + hub.motion.z - hub.start()[2],
            scene.position_at(hub.motion.x).along};
  }


  WheelsetRates RollingWheel::rates(const Scene &scene) const
  {
    const WheelHub::Motion &motion = hub.motion;
    WheelsetRates           rates;
    rates.angular_velocity =
      motion.angular_velocity - free_creepage * scene.motion.speed / scene.stance().rolling_radius();
    rates.across_speed = motion.velocity_y;
    rates.yaw_rate     = motion.yaw_rate;
    rates.roll_rate    = motion.roll_rate;
    if (const FlexibleAxle *axle = hub.flexible_axle())
      for (const auto &[side, wheel] :
           {std::pair(FlexibleAxle::own, &rates.own), {FlexibleAxle::other, &rates.other}})
        *wheel = {axle->twist_rate(side), axle->tilt(side).x, axle->tilt(side).z, axle->tilt_rate(side).x,
                  axle->tilt_rate(side).z};
    return rates;
  }


  void RollingWheel::serialize(Archive &archive)
  {
    archive.same(target_creepage, free_creepage);
  }
} // namespace tread
