// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/assumptions.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/parts.h>
#include <tread/scene/recorded.h>
#include <tread/scene/surface_laws.h>
#include <tread/scene/track_parts.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  std::vector<ElasticMaterial> materials(const Scene &scene)
  {
    std::vector<ElasticMaterial> list{scene.rail.material.elastic()};
    list.insert(list.end(), scene.n_wheels(), scene.wheel.material.elastic());
    if (scene.track.has_solid_sleepers())
      list.insert(
        list.end(), support_positions(scene).size(),
        {scene.track.sleeper_young_modulus, scene.track.sleeper_poisson_ratio, scene.track.sleeper_density});
    for (const auto &other : scene.rail.volume_materials())
      list.push_back(other.material);
    return list;
  }


  std::vector<SolidSleeper> solid_sleepers(const Scene &scene)
  {
    std::vector<SolidSleeper> list;
    const double              middle = -0.5 * scene.track.rail_distance;
    if (scene.track.has_solid_sleepers())
      for (unsigned int i = 0; i < support_positions(scene).size(); ++i)
        list.push_back({sleeper_body(scene, i), middle, middle + 0.5 * scene.track.sleeper_length,
                        scene.track.sleeper_width});
    return list;
  }


  double highest_frequency_for(const Scene &scene, const double time_step)
  {
    // dt = courant 2 / (omega sqrt(1 + 2 beta / dt)), and frequencies are rounded up by 1 % at most.
    constexpr double rounding = 1.01;
    return 2. * scene.time_stepping.courant_number /
           (rounding * time_step * std::sqrt(1. + 2. * scene.solid.stiffness_damping));
  }


  SolidParameters solid_parameters(const Scene &scene)
  {
    SolidParameters p{scene.solid};
    if (!p.matched_surface)
      p.surface_damping = 0.;
    p.density_scale = scene.general.density_scale;
    p.max_level     = scene.time_stepping.levels - 1;
    p.reproducible  = scene.general.reproducible;
    if (scene.time_stepping.least_step > 0.)
      p.highest_frequency = highest_frequency_for(scene, scene.time_stepping.least_step);
    return p;
  }


  std::vector<PlasticZone> plastic_zones(const Scene &scene)
  {
    std::vector<PlasticZone> zones;
    const double             rolled = scene.motion.meshed_distance();
    // Cells yield this far, in semi-axes, ahead of and behind the path, and as far again as they do below it.
    constexpr double beyond_path = 1.4;
    const double     patch       = beyond_path * scene.stance().ellipse(scene.static_load()).semi_axis_x;
    for (unsigned int body = rail_body; body <= wheel_body(scene.n_wheels() - 1); ++body)
      {
        const bool             wheel      = body != rail_body;
        const MaterialSection &material   = wheel ? scene.wheel.material : scene.rail.material;
        const double           half_width = material.plastic_half_width;
        // Distance along the path and below the surface; of a wheel along its tread, from the lowest point in
        // the reference position.
        const auto yields = [=, &scene](const dealii::Point<3> &p, const double begin, const double end,
                                        const double depth) {
          const std::vector<WheelStance::Place> places = scene.stance().places_under(p, body);
          return std::any_of(places.begin(), places.end(), [&](const WheelStance::Place &place) {
            return place.along >= begin && place.along <= end && place.below <= depth &&
                   std::abs(place.beside) <= half_width;
          });
        };
        const auto add = [&](const double begin, const double end, const double depth, const double yield,
                             const double tangent) {
          zones.push_back({body, material.plastic(yield, tangent), [=](const dealii::Point<3> &p) {
                             return yields(p, begin, end, depth);
                           }});
        };
        const double depth = material.plastic_depth, beyond = patch + depth;
        if (material.yield_stress > 0.)
          {
            if (wheel)
              add(-beyond, rolled + beyond, depth, material.yield_stress, material.tangent_modulus);
            else if (scene.ratcheting.uniform)
              add(scene.rail_begin(), scene.rail_end(), depth, material.yield_stress,
                  material.tangent_modulus);
            else
              for (unsigned int k = 0; k < scene.n_wheels(); ++k)
                add(scene.path_begin(k) - beyond, scene.meshed_end(k) + beyond, depth, material.yield_stress,
                    material.tangent_modulus);
          }
        for (const MaterialSection::Zone &zone : material.zones(wheel ? "Wheel" : "Rail"))
          add(zone.begin, zone.end, zone.depth, zone.yield_stress, zone.tangent_modulus);
      }
    return zones;
  }


  Mesh::CellCost cell_cost(const Scene &scene)
  {
    const double wave_speed =
      scene.rail.material.elastic().pressure_wave_speed() / std::sqrt(scene.general.density_scale);
    // Number of steps from the travel time of waves through the smallest cells; the factor accounts for
    // damping and Courant number.
    constexpr double steps_over_travel_time = 1.2;
    const double     steps = steps_over_travel_time * scene.motion.meshed_distance() / scene.motion.speed *
                         wave_speed / scene.mesh.finest_cell;
    const SolidParameters parameters = solid_parameters(scene);
    return
      [steps, element = element_named(parameters.element).make(parameters),
       zones = plastic_zones(scene)](const unsigned int body, const auto &corners, const unsigned int level) {
        dealii::Point<3> centre;
        for (const dealii::Point<3> &corner : corners)
          centre += corner / 8.;
        const bool   is_plastic = zone_at(zones, body, centre) >= 0;
        const double of_a_step  = is_plastic ? PlasticCells::relative_cost : element->relative_cost(corners);
        return steps * std::ldexp(of_a_step, is_plastic ? 0 : -static_cast<int>(level));
      };
  }


  StripExtent strip_extent(const Scene &scene, const unsigned int window)
  {
    const double patch = scene.stance().ellipse(scene.static_load()).semi_axis_x;
    // Of a window what its finest cells feel of the wheel, which its neighbours feel too at the borders.
    const Scene::Range stretch = windows(scene).at(window);
    // On slices patches go from piece to piece, others stay as far ahead of the axle, or behind it.
    const double ahead =
      scene.rail.is_sliced() ? 0. : scene.stance().paths().front().begin - scene.path_begin();
    return {stretch.begin + ahead - patch,
            (has_window(scene) ? stretch.end : scene.meshed_end()) + ahead + patch,
            scene.stance().patch_y(),
            scene.output.strip_half_width,
            patch,
            [&scene](const dealii::Point<3> &p) {
              return scene.stance().depth_in_rail(p);
            }};
  }


  SurfaceDamageParameters surface_damage_parameters(const Scene &scene)
  {
    constexpr double looks_in_a_cell = 4.;
    const auto       effusivity      = [&](const MaterialSection &steel) {
      return std::sqrt(scene.damage.conductivity * steel.density * scene.damage.heat_capacity);
    };
    SurfaceDamageParameters p;
    p.interval          = scene.mesh.finest_cell / (looks_in_a_cell * scene.motion.speed);
    p.wear              = wear_law(scene);
    p.slave_effusivity  = effusivity(scene.rail.material);
    p.master_effusivity = effusivity(scene.wheel.material);
    p.master_share =
      scene.damage.wheel_share.value_or(p.master_effusivity / (p.master_effusivity + p.slave_effusivity));
    return p;
  }


  double temperature_before_friction(const Scene &scene)
  {
    const SurfaceDamageParameters p = surface_damage_parameters(scene);
    return (p.slave_effusivity * scene.damage.rail_temperature +
            p.master_effusivity * scene.damage.wheel_temperature) /
           (p.slave_effusivity + p.master_effusivity);
  }


  std::function<double(double)> factor_by_rise(const Scene &scene)
  {
    return [contact = scene.contact, before = temperature_before_friction(scene)](const double rise) {
      return contact.temperature_factor(before + rise);
    };
  }


  PeakRegion peak_region(const Scene &scene, const unsigned int body)
  {
    // This far from the middle of a patch, half a semi-axis from its edge, no stress is as large as under it.
    constexpr double              semi_axes = 1.5;
    const reference::HertzEllipse ellipse   = scene.stance().ellipse(scene.static_load());
    const Scene::Range            range     = peak_range(scene);
    const PeakStressSection      &section   = scene.peak_stress;
    PeakRegion                    region;
    region.x_begin                 = range.begin;
    region.x_end                   = range.end;
    region.half_width              = peak_half_width(scene);
    region.depth                   = section.depth;
    region.finest_cell             = scene.mesh.finest_cell;
    region.reach                   = semi_axes * ellipse.semi_axis_x;
    const WheelStance::Strip strip = scene.stance().strip(body, range.begin, range.end);
    region.reach += strip.path.ahead;
    if (section.half_width == 0. && strip.path.half_width > 0.)
      region.half_width = strip.path.half_width;
    region.along    = strip.along;
    region.beside   = strip.beside;
    region.depth_of = strip.below;
    return region;
  }


  WheelHubParameters hub_parameters(const Scene &scene)
  {
    WheelHubParameters p;
    const double       n_wheels = scene.wheelset.n_wheels();
    p.mass                      = n_wheels * scene.wheel.mass;
    p.moment_of_inertia         = n_wheels * scene.wheel.moment_of_inertia;
    p.sprung_mass               = n_wheels * scene.vehicle.sprung_mass;
    p.suspension_stiffness      = n_wheels * scene.vehicle.suspension_stiffness;
    p.suspension_damping        = n_wheels * scene.vehicle.suspension_damping;
    p.gravity                   = scene.vehicle.gravity;
    p.yaw_inertia               = scene.guidance.yaw_inertia;
    p.roll_inertia              = scene.wheelset.both_wheels ? p.yaw_inertia : 0.;
    if (settles(scene))
      {
        const reference::HertzEllipse ellipse = scene.stance().ellipse(scene.static_load());
        p.settling = {n_wheels * ellipse.stiffness, ellipse.semi_axis_x / scene.motion.speed,
                      scene.wheelset.both_wheels ? scene.wheelset.track.wheel_origin() : 0.};
      }
    if (scene.wheelset.has_flexible_axle())
      p.axle = {scene.wheelset.axle_torsion, scene.wheelset.axle_bending, scene.wheelset.axle_damping,
                scene.wheelset.track.wheel_origin()};
    return p;
  }


  DynamicsParameters dynamics_parameters(const Scene &scene)
  {
    DynamicsParameters p;
    p.courant_number = scene.time_stepping.courant_number;
    p.damping_steps  = scene.solid.stiffness_damping;
    p.stop_at        = scene.watchdogs.stop_at;
    p.mass_damping   = scene.solid.mass_damping;
    p.density_scale  = scene.general.density_scale;
    p.gravity        = scene.vehicle.gravity;
    return p;
  }


  double mid_span_beside(const Scene &scene, const int number)
  {
    return std::min(scene.track.support_0 + (number + 0.5) * scene.track.sleeper_spacing, scene.rail_end());
  }


  ContactParameters contact_parameters(const Scene &scene)
  {
    ContactParameters p;
    p.solver       = scene.contact.solver;
    p.reproducible = scene.general.reproducible;
    return p;
  }
} // namespace tread
