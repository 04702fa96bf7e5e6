// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/scene.h>

namespace tread
{
  Scene::Scene()
  {
    // In this order the parameters are printed.
    general.declare(input.entries());
    wheel.declare(input.entries());
    wheelset.declare(input.entries());
    guidance.declare(input.entries());
    rail.declare(input.entries());
    defect.declare(input.entries());
    mesh.declare(input.entries());
    solid.declare(input.entries());
    contact.declare(input.entries());
    track.declare(input.entries());
    vehicle.declare(input.entries());
    motion.declare(input.entries());
    further_wheels.declare(input.entries());
    time_stepping.declare(input.entries());
    start.declare(input.entries());
    output.declare(input.entries());
    peak_stress.declare(input.entries());
    ratcheting.declare(input.entries());
    damage.declare(input.entries());
    profile_wear.declare(input.entries());
    watchdogs.declare(input.entries());
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
