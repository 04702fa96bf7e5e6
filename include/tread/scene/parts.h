// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_parts_h
#define tread_scene_parts_h

#include <tread/analysis/rail_stress.h>
#include <tread/analysis/stress_peaks.h>
#include <tread/analysis/surface_damage.h>
#include <tread/contact/contact.h>
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/mesh/body.h>
#include <tread/scene/scene.h>
#include <tread/solid/solid.h>
#include <tread/track/supports.h>
#include <tread/track/wheel_hub.h>

#include <functional>
#include <vector>


namespace tread
{
  // Inputs of the parts of a simulation, derived from a scene.

  // Numbers of the bodies: the rail, the wheels in their order, solid sleepers.
  constexpr unsigned int rail_body = 0;
  inline unsigned int    wheel_body(const unsigned int number)
  {
    return rail_body + 1 + number;
  }
  inline unsigned int sleeper_body(const Scene &scene, const unsigned int number)
  {
    return wheel_body(scene.n_wheels()) + number;
  }

  /// Where cells are fine while the wheel rolls on from a place in the window of this number. Everywhere if
  /// the scene has no window. @param tread the place on the tread that touches there, arc length from where
  /// it touched at the start, m
  FineWindow fine_window(const Scene &scene, const unsigned int number, const double tread);

  /// In the order of the bodies' numbers.
  std::vector<ElasticMaterial> materials(const Scene &scene);
  std::vector<SolidSleeper>    solid_sleepers(const Scene &scene);
  SolidParameters              solid_parameters(const Scene &scene);
  /// Highest frequency of a free cell, rad/s, with which a time step (s) is stable.
  double highest_frequency_for(const Scene &scene, const double time_step);
  /// Cells under the contact paths that may yield, on rail and wheels.
  std::vector<PlasticZone> plastic_zones(const Scene &scene);
  /// Cost of a cell from the work of the selected element, the time step that the cell needs and the distance
  /// rolled.
  Mesh::CellCost cell_cost(const Scene &scene);
  /// The cells of the rail whose largest stress is recorded, down to a depth below the maximum of the shear
  /// stress.
  StripExtent strip_extent(const Scene &scene, const unsigned int window);

  /// Where the largest stresses of the rail, or of the tread of the first wheel, are looked for.
  PeakRegion              peak_region(const Scene &scene, const unsigned int body);
  SurfaceDamageParameters surface_damage_parameters(const Scene &scene);
  /// Temperature (degrees C) that surfaces have at once where they meet, by their own temperatures and
  /// effusivities (Carslaw and Jaeger 1959, section 2.15).
  double temperature_before_friction(const Scene &scene);
  /// Factor of the friction coefficient at a rise of temperature (K) by friction over that.
  std::function<double(double)> factor_by_rise(const Scene &scene);
  WheelHubParameters            hub_parameters(const Scene &scene);
  DynamicsParameters            dynamics_parameters(const Scene &scene);
  ContactParameters             contact_parameters(const Scene &scene);
  /// Coordinate x half a spacing ahead of a support, or the end of the rail if it comes first.
  double mid_span_beside(const Scene &scene, const int number);
} // namespace tread

#endif
