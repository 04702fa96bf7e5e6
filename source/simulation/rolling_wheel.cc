// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/parts.h>
#include <tread/scene/wheelset_case.h>
#include <tread/simulation/rolling_wheel.h>

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
    hub.motion          = WheelHub::Motion();
    const Vector3 start = Vector3{scene.path_begin(number), 0., 0., 0.};
    if (scene.is_positioned())
      {
        const WheelsetPosition &position = scene.placed_wheel().contact.position;
        hub.place(start + scene.placed_wheel().middle(), position.yaw, position.roll);
        if (scene.guidance.kind == Guidance::file)
          hub.follow([&scene](const double time) { return scene.across(time); });
        else if (scene.guidance.kind == Guidance::springs)
          hub.release(scene.guidance.springs);
        if (scene.rail.is_sliced())
          hub.ride([&scene](const double x) { return scene.placed_wheel().way().curvature(x); });
        hub.motion.angular_velocity = given_angular_velocity(scene);
      }
    else
      {
        hub.place(start + Vector3{0., 0., scene.axle_height(), 0.});
        hub.motion.angular_velocity = scene.motion.speed / scene.rolling_radius();
      }
  }


  double RollingWheel::creepage(const Scene &scene) const
  {
    return hub.motion.angular_velocity * scene.rolling_radius() / scene.motion.speed - 1. - free_creepage;
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
      motion.angular_velocity - free_creepage * scene.motion.speed / scene.rolling_radius();
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
