// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/wheelset_case.h>

#include <cmath>
#include <filesystem>

namespace tread
{
  WheelOnRail Scene::wheel_on_rail() const
  {
    const auto wheel_profile = [&] {
      try
        {
          return wheel_curve(located(wheel.tread_profile));
        }
      catch (const std::runtime_error &error)
        {
          throw InputError("'Wheel/Tread profile': " + std::string(error.what()) +
                           "; allowed: cylinder, cone 1:40, cone 1:20, S1002 or a file");
        }
    };
    const auto rail_profile = [&] {
      if (rail.measured_head.empty())
        return rail_curve(rail.standard_profile());
      try
        {
          return measured_rail_curve(located(rail.measured_head));
        }
      catch (const std::runtime_error &error)
        {
          throw InputError("'Rail/Measured head': " + std::string(error.what()));
        }
    };
    require(!rail.is_block(),
            "a wheelset in its track needs a rail with a gauge face: 'Rail/Shape' cannot be block");
    try
      {
        return WheelOnRail(wheel_profile(), rail_profile().turned(rail.angle()), wheel.radius,
                           wheelset.track);
      }
    catch (const InputError &)
      {
        throw;
      }
    catch (const std::runtime_error &error)
      {
        throw InputError("wheelset in its track: " + std::string(error.what()));
      }
  }


  void Scene::check_wheelset() const
  {
    wheelset.check();
    motion.check();
    rail.check();
    wheel.check();
    require(static_load() > 0., "'Vehicle/Gravity (m per s2)' must be above 0: nothing loads the contact");
    require(
      wheel.lateral_position == 0.,
      "'Wheel/Lateral position (mm)' is for an upright wheel; in a track 'Wheelset/Lateral shift (mm)' takes "
      "its place");
    require(defect.shape == "none", "'Defect/Shape' must be none: half-space theory rolls over smooth rails");
    require(
      further_wheels.distances.empty(),
      "'Further wheels/Distances (mm)' must be empty where 'Wheelset' has a position: one wheel is solved");
    require(motion.angular_velocity || (motion.drive == Drive::creepage && motion.creepage),
            "a wheelset in a given position needs 'Motion/Angular velocity (rad per s)', or a number for "
            "'Motion/Creepage'");
    friction_law();
  }


  WheelRolling wheel_rolling(const Scene &scene)
  {
    WheelRolling rolling;
    const auto   elastic = [](const MaterialSection &material) -> reference::Elastic {
      return {material.elastic().young_modulus, material.elastic().poisson_ratio};
    };
    rolling.wheel                = elastic(scene.wheel.material);
    rolling.rail                 = elastic(scene.rail.material);
    rolling.friction             = scene.friction_law()->coefficient(0.);
    rolling.speed                = scene.motion.speed;
    rolling.angular_velocity     = scene.motion.angular_velocity
                                     ? *scene.motion.angular_velocity
                                     : (1. + *scene.motion.creepage) * scene.motion.speed / scene.wheel.radius;
    rolling.slip_follows_surface = scene.wheelset.slip_over_patch == SlipOverPatch::surface;
    return rolling;
  }
} // namespace tread
