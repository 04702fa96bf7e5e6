// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/parts.h>
#include <tread/scene/wheelset_case.h>
#include <tread/simulation/rolling_wheel.h>

#include <algorithm>

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
    forget_records(scene);
  }


  void RollingWheel::forget_records(const Scene &scene)
  {
    average = PatchAverage();
    averages_of_patches.assign(scene.is_positioned() ? scene.placed_wheel().patches().size() : 0,
                               PatchAverage());
    last_force_sum  = Vector3{};
    last_force_low  = 1e300;
    last_force_high = -1e300;
    solution_patch.clear();
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


  void RollingWheel::add_to_last_force(const Vector3 force)
  {
    last_force_sum += force;
    last_force_low  = std::min(last_force_low, force[2]);
    last_force_high = std::max(last_force_high, force[2]);
  }


  double RollingWheel::ripple(const double mean) const
  {
    return mean > 0. ? std::max(last_force_high - mean, mean - last_force_low) / mean : 0.;
  }


  WheelRecord RollingWheel::end_interval(const Scene                  &scene,
                                         const std::vector<PatchNode> &now,
                                         const unsigned int            n_steps,
                                         const double                  seconds)
  {
    WheelRecord record{(1. / n_steps) * interval_force,
                       creepage(scene),
                       measure(now),
                       (hub.motion.velocity_z - interval_start_speed) / seconds,
                       hub.motion.y + scene.wheelset.position().shift,
                       hub.motion.yaw,
                       hub.guidance_force(),
                       hub.motion.roll,
                       (1. / n_steps) * interval_other_force,
                       interval_inner_force / n_steps,
                       scene.is_positioned() ? position(scene).height : 0.};
    if (const FlexibleAxle *axle = hub.flexible_axle())
      {
        record.twist    = 2. * axle->twist(FlexibleAxle::own);
        const auto tilt = [&](const FlexibleAxle::Side side) {
          return WheelRecord::Tilt{-axle->tilt(side).x, axle->tilt(side).z};
        };
        record.own_tilt   = tilt(FlexibleAxle::own);
        record.other_tilt = tilt(FlexibleAxle::other);
      }
    interval_force = interval_other_force = Vector3{};
    interval_inner_force                  = 0.;
    interval_start_speed                  = hub.motion.velocity_z;
    return record;
  }


  void RollingWheel::serialize(Archive &archive)
  {
    average.serialize(archive);
    for (PatchAverage &of_patch : averages_of_patches)
      of_patch.serialize(archive);
    archive.same(target_creepage, free_creepage, solution_patch, interval_force, interval_other_force,
                 interval_inner_force, interval_start_speed, last_force_sum, last_force_low, last_force_high);
  }
} // namespace tread
