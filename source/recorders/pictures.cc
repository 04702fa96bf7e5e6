// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/recorders/pictures.h>
#include <tread/scene/parts.h>
#include <tread/scene/recorded.h>

#include <cmath>
#include <map>
#include <vector>

namespace tread
{
  void Pictures::open(RunFolder &folder)
  {
    if (model.scene.output.interval_of_patches() > 0.)
      for (const RollingWheel &wheel : model.wheels)
        folder.open_table(RunFolder::table_of_wheel("patches", wheel.number), patches_columns());
  }


  void Pictures::pass(const WayPassed &way, RunFolder &folder)
  {
    const OutputSection &output = model.scene.output;
    if (way.has_end_of(output.surface_interval))
      write_surface(folder);
    if (way.has_end_of(output.interval_of_patches()))
      {
        const auto patches = model.patches_now();
        for (const RollingWheel &wheel : model.wheels)
          {
            std::vector<PatchesRow> rows;
            for (const PatchNode &node : patches[wheel.number])
              rows.push_back({model.dynamics.state.time, wheel.hub.motion.x, node});
            folder.append(RunFolder::table_of_wheel("patches", wheel.number), patches_columns(), rows);
          }
      }
    if (output.write_volume && way.has_end_of(output.volume_interval))
      write_volume(folder);
  }


  void Pictures::take_solution(RunFolder &folder)
  {
    const OutputSection &output = model.scene.output;
    if (output.table_depth > 0.)
      folder.write_rail_tables(model.dynamics, stresses().at_present(), rail_body, output.table_depth);
    write_surface(folder);
    if (output.write_volume)
      write_volume(folder);
  }


  void Pictures::write_volume(RunFolder &folder)
  {
    std::map<unsigned int, const WheelHub *> hubs;
    for (const RollingWheel &wheel : model.wheels)
      hubs[wheel.body] = &wheel.hub;
    folder.write_volume(model.dynamics, stresses().at_present(), hubs);
  }


  void Pictures::write_surface(RunFolder &folder)
  {
    folder.write_surface(model.dynamics, model.contact, stresses().at_present(),
                         damage ? damage->by_node() : std::vector<SurfacePlace>(), rail_body);
  }


  NodalStresses &Pictures::stresses()
  {
    if (!at_nodes)
      {
        const std::vector<ElasticMaterial> of_bodies = materials(model.scene);
        std::vector<RecoveredBody>         bodies{
          {rail_body, of_bodies[rail_body], [&scene = model.scene](const dealii::Point<3> &p) {
             return scene.stance().depth_in_rail(p);
           }}};
        for (const RollingWheel &wheel : model.wheels)
          bodies.push_back(
            {wheel.body, of_bodies[wheel.body], [axle = wheel.hub.start()](const dealii::Point<3> &p) {
               return -std::hypot(p[0] - axle[0], p[2] - axle[2]);
             }});
        at_nodes = std::make_unique<NodalStresses>(model.dynamics, &model.contact, bodies);
      }
    return *at_nodes;
  }
} // namespace tread
