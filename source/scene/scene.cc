// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/scene.h>

namespace tread
{
  Scene::Scene()
  {
    // In this order the parameters are printed.
    general.declare(input.table());
    wheel.declare(input.table());
    wheelset.declare(input.table());
    guidance.declare(input.table());
    rail.declare(input.table());
    defect.declare(input.table());
    mesh.declare(input.table());
    solid.declare(input.table());
    contact.declare(input.table());
    track.declare(input.table());
    vehicle.declare(input.table());
    motion.declare(input.table());
    further_wheels.declare(input.table());
    time_stepping.declare(input.table());
    start.declare(input.table());
    output.declare(input.table());
    peak_stress.declare(input.table());
    ratcheting.declare(input.table());
    damage.declare(input.table());
    profile_wear.declare(input.table());
    watchdogs.declare(input.table());
  }


  double Scene::traction_coefficient(const unsigned int number) const
  {
    return number == 0 || further_wheels.traction_coefficients.empty()
             ? motion.traction_coefficient
             : further_wheels.traction_coefficients[number - 1];
  }


  double Scene::rail_begin() const
  {
    if (made_shapes.rail_mesh)
      return made_shapes.rail_mesh->surface.along().begin;
    const double behind = distance_behind(last_wheel()),
                 margin =
                   rail.length > 0. ? 0.5 * (rail.length - motion.meshed_distance() - behind) : rail.margin;
    return rail.begin.value_or(path_begin() - behind - margin);
  }


  double Scene::rail_end() const
  {
    if (made_shapes.rail_mesh)
      return made_shapes.rail_mesh->surface.along().end;
    return rail.length > 0. ? rail_begin() + rail.length : meshed_end() + rail.margin;
  }


  double Scene::rail_half_width() const
  {
    return rail.is_meshed() ? made_shapes.surfaces.half_width : rail.half_width();
  }


  double Scene::rail_thickness() const
  {
    return made_shapes.rail_mesh ? made_shapes.rail_mesh->thickness(path_begin(), made_shapes.first_contact.y)
                                 : rail.thickness();
  }
} // namespace tread
