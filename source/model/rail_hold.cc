// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/model/rail_hold.h>
#include <tread/scene/parts.h>
#include <tread/scene/track_parts.h>

namespace tread
{
  std::unique_ptr<Supports> make_supports(const Scene &scene, const Mesh &mesh)
  {
    if (!scene.track.has_supports())
      return nullptr;
    return std::make_unique<Supports>(mesh, rail_body, support_positions(scene), track_parameters(scene),
                                      solid_sleepers(scene));
  }


  void hold_rail(const Scene &scene, const Mesh &mesh, const Supports *supports, const RailHold &hold)
  {
    if (!supports && !scene.track.has_moving_base())
      hold.fix(mesh.boundary_nodes(rail_body, Boundary::support));
    if (scene.shapes().rail_mesh)
      {
        hold.guide(mesh.boundary_nodes(rail_body, Boundary::end), 0);
        hold.guide(mesh.boundary_nodes(rail_body, Boundary::side), 1);
      }
    if (!supports)
      return;
    if (!track_beyond(scene))
      hold.guide(mesh.boundary_nodes(rail_body, Boundary::end), 0);
    if (const AbsorbingEnds ends = absorbing_ends(scene); ends.length > 0.)
      hold.damp([&](const dealii::Point<3> &p) { return ends.rate(p[0]); });
    hold.guide(supports->guided_nodes(1), 1);
    for (const SolidSleeper &sleeper : supports->solid_sleepers)
      hold.guide(mesh.boundary_nodes(sleeper.body, Boundary::end), 1);
    if (!supports->solid_sleepers.empty())
      hold.guide(supports->guided_nodes(0), 0);
  }
} // namespace tread
