// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_parts_h
#define tread_scene_parts_h

#include <tread/analysis/rail_stress.h>
#include <tread/contact/contact.h>
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/mesh/body.h>
#include <tread/scene/scene.h>
#include <tread/solid/solid.h>
#include <tread/track/supports.h>
#include <tread/track/wheel_hub.h>

#include <vector>


namespace tread
{
  // What a scene says to the parts of a simulation.

  /// Rail, wheel and solid sleepers, in this order; materials likewise.
  std::vector<Body>            make_bodies(const Scene &scene);
  std::vector<ElasticMaterial> materials(const Scene &scene);
  std::vector<SolidSleeper>    solid_sleepers(const Scene &scene);
  SolidParameters              solid_parameters(const Scene &scene);
  /// Cells under the contact path that may yield, on both bodies.
  std::vector<PlasticZone> plastic_zones(const Scene &scene);
  /// By the work of the element asked for, the time step that a cell needs and the distance rolled.
  Mesh::CellCost cell_cost(const Scene &scene);
  /// Cells of the rail whose largest stress is kept, down to where shear stress has passed its largest value.
  StripExtent        strip_extent(const Scene &scene);
  WheelHubParameters hub_parameters(const Scene &scene);
  DynamicsParameters dynamics_parameters(const Scene &scene);
  ContactParameters  contact_parameters(const Scene &scene);
  /// x half a spacing ahead of a support; where the rail ends before it, its end.
  double mid_span_beside(const Scene &scene, const int number);
} // namespace tread

#endif
