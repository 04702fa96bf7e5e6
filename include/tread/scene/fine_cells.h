// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_fine_cells_h
#define tread_scene_fine_cells_h

#include <tread/scene/scene.h>

#include <string>
#include <vector>

namespace tread
{
  /// Of a patch under the static load, along and across: a load that doubles or triples makes it larger by
  /// its cube root.
  constexpr double room_for_dynamic_load = 1.35;

  /// Half width of the zone of finest cells, from the middle of the path: as prescribed, or as the patch
  /// requires, m.
  double fine_half_width(const Scene &scene);
  /// Smallest admissible half width of that zone, m.
  double needed_half_width(const Scene &scene);
  /// Lateral middle of the finely meshed path: the first contact, shifted by whole cells towards the middle
  /// of the patch, m.
  double path_y(const Scene &scene);

  /// How far from a patch's edge, along the path and across, the wheel touches what rises so much above the
  /// rail, m.
  Scene::Range reach_of(const Scene &scene, const double height);

  /// Whether cells of the path are longer than the finest ones but for a stretch of cubes.
  bool has_cubes(const Scene &scene);
  /// Where 'Mesh/Fine from (mm)' and 'Fine to (mm)' put the cubes of the finest cells, x in m.
  Scene::Range cubes(const Scene &scene);
  /// Whether all cells from begin to end have the finest size: among the cubes, or wherever nothing
  /// coarsens the path.
  bool is_finest(const Scene &scene, const double begin, const double end);

  /// Whether cells are fine only about the wheel, by 'Mesh/Window'.
  bool has_window(const Scene &scene);
  /// What needs a mesh that stays during the run; "": nothing does.
  std::string keeps_mesh(const Scene &scene);
  /// Way in one window, m: 'Mesh/Window length (mm)', or what is usual where that is 0.
  double usual_window(const Scene &scene);
  /// Where the wheel rolls in each window of fine cells, one after the other, x in m: the whole way
  /// without one. Borders lie where the first cubes come and the last ones go, others at equal distances
  /// between.
  std::vector<Scene::Range> windows(const Scene &scene);
  /// Length of the fine cells before and behind such a range, m.
  double window_margin(const Scene &scene);

  /// Of a wheel of which a sector or a ring is meshed, along the tread from where it is lowest at the
  /// start, m.
  Scene::Range meshed_arc(const Scene &scene);
  /// How much longer the way along the tread may be than that along the rail, m per m: the creepage that is
  /// given, or what rolling with traction takes.
  double largest_creepage(const Scene &scene);
  /// Way along the tread for which its cells are fine, m: that of the axle, and more where the creepage
  /// would use up what is fine behind it.
  double meshed_tread(const Scene &scene);
  /// Longest sector of a wheel that is not closed to a ring, m along the tread.
  double longest_sector(const Scene &scene);
  /// Whether a sector of the wheel would be longer, for a way of about a turn or more.
  bool wheel_is_ring(const Scene &scene);
} // namespace tread

#endif
