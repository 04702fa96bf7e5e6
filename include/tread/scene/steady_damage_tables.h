// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_steady_damage_tables_h
#define tread_scene_steady_damage_tables_h

#include <tread/analysis/steady_damage.h>
#include <tread/output/run_folder.h>
#include <tread/output/summary.h>
#include <tread/scene/scene.h>

#include <vector>

namespace tread
{
  /// A patch of a half-space solution, and how fast the wheel's surface passes it (m/s).
  struct PassedPatch
  {
    std::vector<PatchNode> elements;
    double                 wheel_speed;
  };

  /// The tables of both surfaces and the largest temperature, where 'Damage/Record' asks for them. @param
  /// warnings that are added to @throws InputError if the wheel does not turn
  void write_steady_damage(const Scene                    &scene,
                           const std::vector<PassedPatch> &patches,
                           const RunFolder                &folder,
                           Summary                        &summary,
                           std::vector<std::string>       &warnings);

  /// What makes a flash temperature (K) doubtful; empty: nothing.
  std::string doubt_of_temperature(const Scene &scene, double rise);
} // namespace tread

#endif
