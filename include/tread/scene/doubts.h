// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_doubts_h
#define tread_scene_doubts_h

#include <tread/scene/scene.h>

#include <string>
#include <vector>

namespace tread
{
  /// What makes the answer of finite elements doubtful before anything rolls, one line each: values that
  /// are hardly meant, a defect that no wheel meets, detail that cells do not see, parts of the patch that
  /// are narrow for them.
  std::vector<std::string> doubts(const Scene &scene);

  /// The values among these. @param stands_in_track also where the wheelset has no position of its own, as
  /// in a table over its lateral shift
  std::vector<std::string> implausible_values(const Scene &scene, const bool stands_in_track = false);

  /// What of a scene half-space theory does not see, a line each.
  std::vector<std::string> left_out_by_half_space(const Scene &scene);

  /// How far the gap between wheel and rail, across the patch, differs between nodes of finest cells from
  /// the cubics through the nearest four of them, root of the mean square (m): detail of profiles that the
  /// mesh does not see. 0 of a wheelset's positions, where cells follow the patch.
  double detail_within_cells(const Scene &scene);
  /// The same along the path, of a defect from a file: the largest root of the mean square over a patch's
  /// half length.
  double detail_along(const Scene &scene);

  /// Whether no wheel's patch comes to the defect, nor to any other like it, on all of the way that is
  /// meshed; false where that is not sure. @pre scene.shapes().defect
  bool misses_defect(const Scene &scene);
  /// Where the defect lies and how deep, and what the wheel is not round by, one line; empty: neither.
  std::string defect_in_words(const Scene &scene);
} // namespace tread

#endif
