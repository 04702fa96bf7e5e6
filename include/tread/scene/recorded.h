// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_recorded_h
#define tread_scene_recorded_h

#include <tread/scene/scene.h>

#include <vector>

namespace tread
{
  /// Where the largest stresses are looked for, x in m. @throws InputError if nothing says where the defect
  /// ends.
  Scene::Range peak_range(const Scene &scene);
  /// And to each side of the first contact, m.
  double peak_half_width(const Scene &scene);

  /// Positions in the rail (reference configuration, m) whose cells are written to cells.csv. @throws
  /// InputError
  std::vector<dealii::Point<3>> recorded_cells(const Scene &scene);
} // namespace tread

#endif
