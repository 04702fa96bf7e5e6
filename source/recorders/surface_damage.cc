// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/summary_keys.h>
#include <tread/recorders/surface_damage.h>
#include <tread/scene/parts.h>
#include <tread/scene/steady_damage_tables.h>
#include <tread/scene/surface_laws.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace tread
{
  namespace
  {
    const bool keys_of_surface_damage_are_known =
      know_summary_keys(SummaryGroup::damage,
                        {{"wear_volume_m3", "Volume that the rail has lost by 'Damage/Wear law', in all "
                                            "passages; in each the wheels together lose as much"}});
  } // namespace


  SurfaceDamageRecorder::SurfaceDamageRecorder(Model &model)
    : model(model)
    , damage(model.contact, rail_body, surface_damage_parameters(model.scene))
  {
    if (!model.scene.contact.temperatures.empty())
      damage.vary_friction(factor_by_rise(model.scene));
  }


  void SurfaceDamageRecorder::finish(Report &report)
  {
    const std::vector<SurfacePlace> rail = damage.places(rail_body, [](const Vector3 &p) { return p[0]; });
    report.folder.write_table("rail_surface_damage.csv", surface_damage_columns(false), rail);
    double hottest = max_temperature(rail);
    for (const RollingWheel &wheel : model.wheels)
      {
        const Vector3                   axle   = wheel.hub.start();
        const std::vector<SurfacePlace> places = damage.places(
          wheel.body, [&](const Vector3 &p) { return std::atan2(p[0] - axle[0], axle[2] - p[2]); });
        report.folder.write_table(RunFolder::table_of_wheel("wheel_surface_damage", wheel.number),
                                  surface_damage_columns(true), places);
        hottest = std::max(hottest, max_temperature(places));
      }
    report.summary.set("max_flash_temperature_K", hottest);
    if (const std::string doubt = doubt_of_temperature(model.scene, hottest); !doubt.empty())
      report.warnings.push_back(doubt);
    if (!wear_law(model.scene))
      return;
    double volume = 0.;
    for (const SurfacePlace &place : rail)
      volume += place.area * place.wear_depth;
    report.summary.set("wear_volume_m3", volume);
  }
} // namespace tread
