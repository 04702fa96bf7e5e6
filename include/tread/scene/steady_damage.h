// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_steady_damage_h
#define tread_scene_steady_damage_h

#include <tread/analysis/contact_patch.h>
#include <tread/analysis/surface_damage.h>
#include <tread/output/run_folder.h>
#include <tread/output/summary.h>
#include <tread/scene/scene.h>

#include <vector>

namespace tread
{
  /// What one passage in steady rolling does to each line of a surface along the path, from the elements of a
  /// half-space solution: each element of a row acts for as long as the surface takes to pass it.
  /// @param elements in rows along x, each with tractions and slip in the surface's plane
  /// @param speed of the surface through the patch, m/s; @param heat_share, effusivity of its body
  std::vector<SurfacePlace> steady_damage(const std::vector<PatchNode> &elements,
                                          double                        speed,
                                          const WearLaw                *wear,
                                          double                        heat_share,
                                          double                        effusivity);

  /// The tables of both surfaces and the largest temperature, where 'Damage/Record' asks for them.
  /// @param wheel_speed of the tread through the patch, m/s
  void write_steady_damage(const Scene                  &scene,
                           const std::vector<PatchNode> &elements,
                           double                        wheel_speed,
                           const RunFolder              &folder,
                           Summary                      &summary);
} // namespace tread

#endif
