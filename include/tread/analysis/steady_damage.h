// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_steady_damage_h
#define tread_analysis_steady_damage_h

#include <tread/analysis/contact_patch.h>
#include <tread/analysis/surface_damage.h>

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
} // namespace tread

#endif
