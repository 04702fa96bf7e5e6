// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/parts.h>
#include <tread/scene/steady_damage_tables.h>

#include <algorithm>

namespace tread
{
  std::string doubt_of_temperature(const Scene &scene, const double rise)
  {
    constexpr double hot = 1000.; // K, where steel has lost its strength, and friction with it
    // Above that of a room, where it is known.
    const double before = scene.contact.temperatures.empty() ? 0. : temperature_before_friction(scene) - 20.;
    return rise + before > hot
             ? format(
                 "a flash temperature of %.0f K is none that steel stands: friction falls before, and heat "
                 "changes steel from some 700 K on",
                 rise + before)
             : "";
  }


  void write_steady_damage(const Scene                    &scene,
                           const std::vector<PassedPatch> &patches,
                           const RunFolder                &folder,
                           Summary                        &summary,
                           std::vector<std::string>       &warnings)
  {
    if (!scene.damage.record)
      return;
    const SurfaceDamageParameters p = surface_damage_parameters(scene);
    std::vector<SurfacePlace>     rail, wheel;
    const auto add = [](std::vector<SurfacePlace> &surface, const std::vector<SurfacePlace> &of_patch) {
      surface.insert(surface.end(), of_patch.begin(), of_patch.end());
    };
    for (const PassedPatch &patch : patches)
      {
        require(patch.wheel_speed > 0.,
                "'Damage/Record' needs a wheel whose surface passes the patch, which it does "
                "not with the angular velocity or creepage of 'Motion'");
        add(rail, steady_damage(patch.elements, scene.motion.speed, p.wear.get(), 1. - p.master_share,
                                p.slave_effusivity));
        add(wheel, steady_damage(patch.elements, patch.wheel_speed, p.wear.get(), p.master_share,
                                 p.master_effusivity));
      }
    folder.write_table("rail_surface_damage.csv", surface_damage_columns(false), rail);
    folder.write_table("wheel_surface_damage.csv", surface_damage_columns(true), wheel);
    const double hottest = std::max(max_temperature(rail), max_temperature(wheel));
    summary.set("max_flash_temperature_K", hottest);
    if (const std::string doubt = doubt_of_temperature(scene, hottest); !doubt.empty())
      warnings.push_back(doubt);
  }
} // namespace tread
