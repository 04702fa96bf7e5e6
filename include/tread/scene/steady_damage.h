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
  /// half-space solution: each element of a row acts for as long as the surface takes to pass it. The area of
  /// a line is that on a metre of way (m^2).
  /// @param elements of one patch in rows along x, each with tractions and slip in the surface's plane
  /// @param speed of the surface through the patch, m/s; @param heat_share, effusivity of its body
  std::vector<SurfacePlace> steady_damage(const std::vector<PatchNode> &elements,
                                          double                        speed,
                                          const WearLaw                *wear,
                                          double                        heat_share,
                                          double                        effusivity);

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
  std::string doubt_of_temperature(double rise);
} // namespace tread

#endif
