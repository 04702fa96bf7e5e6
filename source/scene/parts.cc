// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/mesh/rail_body.h>
#include <tread/mesh/sleeper_body.h>
#include <tread/mesh/wheel_body.h>
#include <tread/mesh/whole_rail.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/parts.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
    /// Between foot and sleeper in pictures; the pads' springs have no length.
    constexpr double pad_thickness = 0.01;
  } // namespace


  std::vector<Body> make_bodies(const Scene &scene)
  {
    const double rolled = 1e-3 * scene.rolled_mm, begin = scene.path_begin(), end = scene.path_end();
    const reference::HertzEllipse ellipse = hertz(scene, scene.static_load());
    const double                  patch   = 1.25 * ellipse.semi_axis_x + 2e-3 * scene.finest_mm;

    FineZone on_rail;
    on_rail.finest_cell_size = 1e-3 * scene.finest_mm;
    on_rail.x_begin          = begin - patch;
    on_rail.x_end            = end + patch;
    on_rail.half_width       = scene.fine_half_width();
    on_rail.depth            = scene.fine_layers * on_rail.finest_cell_size;
    on_rail.cells_per_level  = scene.cells_per_level;
    on_rail.level_depth      = scene.level_depth * std::sqrt(ellipse.semi_axis_x * ellipse.semi_axis_y);
    on_rail.y_middle         = scene.path_y();
    if (scene.fine_from_mm < scene.fine_to_mm && scene.path_cell_mm > scene.finest_mm)
      {
        on_rail.cubes_begin  = 1e-3 * (scene.defect_position_mm + scene.fine_from_mm);
        on_rail.cubes_end    = 1e-3 * (scene.defect_position_mm + scene.fine_to_mm);
        on_rail.path_level   = std::floor(std::log2(scene.path_cell_mm / scene.finest_mm) + 1e-9);
        on_rail.path_stretch = std::ldexp(scene.path_cell_mm / scene.finest_mm, -on_rail.path_level);
      }
    FineZone on_wheel = on_rail;
    on_wheel.cubes_begin -= begin;
    on_wheel.cubes_end -= begin;
    on_wheel.x_begin = -patch;
    on_wheel.x_end   = rolled + patch;

    std::vector<Body> bodies;
    const RailTop     top{scene.rail_height(), scene.inclination()};
    if (scene.rail_shape == "block")
      {
        RailBlock block;
        block.x_begin            = scene.rail_begin();
        block.x_end              = scene.rail_end();
        block.top                = top;
        block.width              = 1e-3 * scene.block_width_mm;
        block.height             = 1e-3 * scene.block_height_mm;
        block.crown_radius       = 1e-3 * scene.crown_radius_mm;
        block.coarsest_cell_size = 1e-3 * scene.coarsest_mm;
        bodies.push_back(make_rail_block(block, on_rail));
      }
    else if (scene.rail_shape == "full section")
      {
        WholeRail rail;
        rail.x_begin            = scene.rail_begin();
        rail.x_end              = scene.rail_end();
        rail.coarsest_cell_size = 1e-3 * std::min(scene.coarsest_mm, 12.5);
        rail.longest_row        = 1e-3 * scene.longest_row_mm;
        rail.top                = top;
        bodies.push_back(make_whole_rail(scene.rail_profile(), rail, on_rail));
      }
    else
      {
        RailHead head;
        head.x_begin            = scene.rail_begin();
        head.x_end              = scene.rail_end();
        head.top                = top;
        head.coarsest_cell_size = 1e-3 * std::min(scene.coarsest_mm, 12.5);
        bodies.push_back(make_rail_head(scene.rail_profile(), head, on_rail));
      }
    bodies.back().name = "rail";
    if (scene.wheel_shape == "sector")
      {
        WheelSector sector;
        sector.center_x           = begin;
        sector.lift               = scene.first_contact().lift;
        sector.tread_offset       = scene.surfaces().tread_offset;
        sector.radius             = 1e-3 * scene.radius_mm;
        sector.thickness          = 1e-3 * scene.sector_thickness_mm;
        sector.width              = 1e-3 * scene.sector_width_mm;
        sector.arc_begin          = -1e-3 * scene.sector_margin_mm;
        sector.arc_end            = rolled + 1e-3 * scene.sector_margin_mm;
        sector.coarsest_cell_size = 1e-3 * scene.coarsest_mm;
        bodies.push_back(make_wheel_sector(sector, on_wheel));
      }
    else
      {
        FullWheel wheel;
        wheel.center_x           = begin;
        wheel.lift               = scene.first_contact().lift;
        wheel.tread_offset       = scene.surfaces().tread_offset;
        wheel.radius             = 1e-3 * scene.radius_mm;
        wheel.rim_inner_radius   = 1e-3 * scene.rim_inner_radius_mm;
        wheel.rim_width          = 1e-3 * scene.rim_width_mm;
        wheel.web_thickness      = 1e-3 * scene.web_thickness_mm;
        wheel.hub_outer_radius   = 1e-3 * scene.hub_outer_radius_mm;
        wheel.hub_length         = 1e-3 * scene.hub_length_mm;
        wheel.bore_radius        = 1e-3 * scene.bore_radius_mm;
        wheel.coarsest_cell_size = 1e-3 * scene.coarsest_mm;
        bodies.push_back(make_full_wheel(wheel, on_wheel));
      }
    bodies.back().name = "wheel";
    if (scene.has_solid_sleepers())
      for (const double x : scene.support_positions())
        {
          SleeperBox box;
          box.x                  = x;
          box.width              = 1e-3 * scene.sleeper_width_mm;
          box.y_begin            = -0.5e-3 * scene.rail_distance_mm;
          box.y_end              = box.y_begin + 0.5 * scene.sleeper_length_m;
          box.top                = scene.base_middle()[2] - pad_thickness;
          box.height             = scene.solid_sleeper_height();
          box.coarsest_cell_size = std::min(box.height / 3., 0.06);
          bodies.push_back(make_sleeper(box));
        }
    return bodies;
  }


  std::vector<ElasticMaterial> materials(const Scene &scene)
  {
    std::vector<ElasticMaterial> list{scene.rail_material.si(), scene.wheel_material.si()};
    if (scene.has_solid_sleepers())
      list.insert(
        list.end(), scene.support_positions().size(),
        {1e9 * scene.sleeper_young_modulus_GPa, scene.sleeper_poisson_ratio, scene.sleeper_density});
    return list;
  }


  std::vector<SolidSleeper> solid_sleepers(const Scene &scene)
  {
    std::vector<SolidSleeper> list;
    const double              middle = -0.5e-3 * scene.rail_distance_mm;
    if (scene.has_solid_sleepers())
      for (unsigned int i = 0; i < scene.support_positions().size(); ++i)
        list.push_back({2 + i, middle, middle + 0.5 * scene.sleeper_length_m, 1e-3 * scene.sleeper_width_mm});
    return list;
  }


  SolidParameters solid_parameters(const Scene &scene)
  {
    SolidParameters p;
    p.element_type = scene.element == "one-point" ? ElementType::one_point : ElementType::fully_integrated;
    p.hourglass_coefficient    = scene.hourglass_coefficient;
    p.linear_bulk_viscosity    = scene.linear_bulk_viscosity;
    p.quadratic_bulk_viscosity = scene.quadratic_bulk_viscosity;
    p.density_scale            = scene.density_scale;
    p.max_level                = scene.time_levels - 1;
    return p;
  }


  std::vector<PlasticZone> plastic_zones(const Scene &scene)
  {
    std::vector<PlasticZone> zones;
    const double             rolled = 1e-3 * scene.rolled_mm, radius = 1e-3 * scene.radius_mm;
    const double             patch = 1.4 * hertz(scene, scene.static_load()).semi_axis_x;
    for (const bool wheel : {false, true})
      {
        const Scene::Material &material   = wheel ? scene.wheel_material : scene.rail_material;
        const double           half_width = 1e-3 * material.plastic_half_width_mm;
        // Distance along the path and below the surface; of the wheel along its tread, from the lowest
        // point in the reference position.
        const auto add = [&](const double begin, const double end, const double depth, const double yield_MPa,
                             const double tangent_GPa) {
          zones.push_back({wheel ? 1u : 0u, material.plastic(yield_MPa, tangent_GPa),
                           [=, &scene](const dealii::Point<3> &p) {
                             const double dx = p[0] - scene.path_begin(), dz = p[2] - scene.axle_height();
                             const double along = wheel ? radius * std::atan2(dx, -dz) : p[0];
                             const double below =
                               wheel ? radius - std::hypot(dx, dz) : -scene.in_rail_axes(p)[2];
                             return along >= begin && along <= end && below <= depth &&
                                    std::abs(p[1] - scene.path_y()) <= half_width;
                           }});
        };
        const double depth = 1e-3 * material.plastic_depth_mm;
        const double begin = (wheel ? 0. : scene.path_begin()) - patch - depth,
                     end   = (wheel ? rolled : scene.path_end()) + patch + depth;
        if (material.yield_stress_MPa > 0.)
          add(begin, end, depth, material.yield_stress_MPa, material.tangent_modulus_GPa);
        for (const Scene::Material::Zone &zone : material.zones())
          add(1e-3 * zone.begin_mm, 1e-3 * zone.end_mm, 1e-3 * zone.depth_mm, zone.yield_stress_MPa,
              zone.tangent_modulus_GPa);
      }
    return zones;
  }


  Mesh::CellCost cell_cost(const Scene &scene)
  {
    const double wave_speed = scene.rail_material.si().pressure_wave_speed() / std::sqrt(scene.density_scale);
    // Number of steps from the travel time of waves through the smallest cells; the factor accounts for
    // damping and Courant number.
    const double steps = 1.2 * scene.rolled_mm / scene.speed() * wave_speed / scene.finest_mm;
    return [steps, type = solid_parameters(scene).element_type, zones = plastic_zones(scene)](
             const unsigned int body, const auto &corners, const unsigned int level) {
      dealii::Point<3> centre;
      for (const dealii::Point<3> &corner : corners)
        centre += corner / 8.;
      const bool   is_plastic = zone_at(zones, body, centre) >= 0;
      const double of_a_step  = Solid::relative_cost(corners, type, is_plastic);
      return steps * std::ldexp(of_a_step, is_plastic ? 0 : -static_cast<int>(level));
    };
  }


  StripExtent strip_extent(const Scene &scene)
  {
    const double patch = hertz(scene, scene.static_load()).semi_axis_x;
    return {scene.path_begin() - patch,
            scene.path_end() + patch,
            scene.first_contact().y,
            1e-3 * scene.strip_half_width_mm,
            patch,
            [&scene](const dealii::Point<3> &p) {
              return scene.depth_in_rail(p);
            }};
  }


  WheelHubParameters hub_parameters(const Scene &scene)
  {
    WheelHubParameters p;
    p.mass                 = scene.wheel_mass;
    p.moment_of_inertia    = scene.wheel_inertia;
    p.sprung_mass          = scene.sprung_mass;
    p.suspension_stiffness = 1e3 * scene.suspension_stiffness_kN_m;
    p.suspension_damping   = scene.suspension_damping;
    p.gravity              = scene.gravity;
    return p;
  }


  DynamicsParameters dynamics_parameters(const Scene &scene)
  {
    DynamicsParameters p;
    p.courant_number = scene.courant_number;
    p.damping_steps  = scene.damping_steps;
    p.mass_damping   = scene.mass_damping;
    p.density_scale  = scene.density_scale;
    p.gravity        = scene.gravity;
    return p;
  }


  double mid_span_beside(const Scene &scene, const int number)
  {
    return std::min(1e-3 * scene.support_0_mm + (number + 0.5) * scene.sleeper_spacing_m, scene.rail_end());
  }


  ContactParameters contact_parameters(const Scene &scene)
  {
    ContactParameters p;
    p.solver.tolerance  = scene.contact_tolerance;
    p.solver.max_sweeps = scene.max_sweeps;
    return p;
  }
} // namespace tread
