// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_references_h
#define tread_references_h

#include <tread/analysis/contact_patch.h>
#include <tread/reference/hertz.h>
#include <tread/reference/rolling_case.h>
#include <tread/scene.h>

#include <vector>

namespace tread
{
  /// The scene as the half-space solver sees it: traction coefficient prescribed.
  /// @param normal_force N, > 0
  /// @param traction_coefficient longitudinal over normal force on the wheel, below the friction coefficient
  reference::RollingCase half_space_case(const Scene &scene,
                                         double       normal_force,
                                         double       traction_coefficient);

  /// Hertz's patch of the scene's wheel and rail. @param normal_force N, > 0
  reference::HertzEllipse hertz(const Scene &scene, double normal_force);

  /// The elements in contact of a half-space answer, as nodes of a patch table.
  std::vector<PatchNode> patch_nodes(const reference::RollingResult &half_space);
} // namespace tread

#endif
