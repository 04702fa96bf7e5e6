// SPDX-License-Identifier: LGPL-2.1-or-later
// The bodies of a scene: rail, wheel and solid sleepers.
#include <tread/mesh/rail_body.h>
#include <tread/mesh/sleeper_body.h>
#include <tread/mesh/wheel_body.h>
#include <tread/mesh/whole_rail.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/parts.h>
#include <tread/scene/track_parts.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
    /// Between foot and sleeper in pictures; the pads' springs have no length.
    constexpr double pad_thickness = 0.01;

    /// Coarse cells of a rail's profile, whose head has a shoulder of 13 mm radius to follow, m.
    constexpr double coarsest_of_a_profile = 12.5e-3;

    /// Of finest cells ahead of and behind the path: the patch, a quarter of a semi-axis and two cells, m.
    double beyond_path(const Scene &scene, const reference::HertzEllipse &ellipse)
    {
      return 1.25 * ellipse.semi_axis_x + 2. * scene.mesh.finest_cell;
    }


    /// The zone of a wheel's path.
    FineZone zone_on_rail(const Scene                   &scene,
                          const unsigned int             wheel,
                          const reference::HertzEllipse &ellipse,
                          const FineWindow              &window)
    {
      FineZone on_rail;
      on_rail.finest_cell_size = scene.mesh.finest_cell;
      on_rail.x_begin          = scene.path_begin(wheel) - beyond_path(scene, ellipse);
      on_rail.x_end            = scene.meshed_end(wheel) + beyond_path(scene, ellipse);
      on_rail.half_width       = fine_half_width(scene);
      on_rail.depth            = scene.mesh.fine_layers * on_rail.finest_cell_size;
      on_rail.cells_per_level  = scene.mesh.cells_per_level;
      on_rail.level_depth  = scene.mesh.level_depth * std::sqrt(ellipse.semi_axis_x * ellipse.semi_axis_y);
      on_rail.y_middle     = path_y(scene);
      on_rail.window_begin = window.rail_begin;
      on_rail.window_end   = window.rail_end;
      if (has_cubes(scene))
        {
          on_rail.cubes_begin = cubes(scene).begin;
          on_rail.cubes_end   = cubes(scene).end;
          on_rail.path_level  = std::floor(std::log2(scene.mesh.path_cell / scene.mesh.finest_cell) + 1e-9);
          on_rail.path_stretch =
            std::ldexp(scene.mesh.path_cell / scene.mesh.finest_cell, -on_rail.path_level);
        }
      return on_rail;
    }


    /// Those of all paths, in the order of x. Paths that follow each other closely have one zone.
    FineZones zones_on_rail(const Scene                   &scene,
                            const reference::HertzEllipse &ellipse,
                            const FineWindow              &window)
    {
      std::vector<FineZone> zones;
      for (unsigned int wheel = scene.n_wheels(); wheel-- > 0;)
        {
          const FineZone zone = zone_on_rail(scene, wheel, ellipse, window);
          // Between two boxes there is room for all sizes of cells to grow and shrink again.
          if (!zones.empty() && zone.x_begin - zones.back().x_end < 4. * scene.mesh.coarsest_cell)
            zones.back().x_end = zone.x_end;
          else
            zones.push_back(zone);
        }
      return FineZones(zones);
    }


    /// The zone of a wheel's path laid along the tread, from where it touches at the start.
    FineZone zone_on_wheel(const Scene                   &scene,
                           const unsigned int             wheel,
                           const reference::HertzEllipse &ellipse,
                           const FineWindow              &window)
    {
      FineZone on_wheel     = zone_on_rail(scene, wheel, ellipse, window);
      on_wheel.window_begin = window.tread_begin;
      on_wheel.window_end   = window.tread_end;
      on_wheel.cubes_begin -= scene.path_begin(wheel);
      on_wheel.cubes_end -= scene.path_begin(wheel);
      on_wheel.x_begin = -beyond_path(scene, ellipse);
      on_wheel.x_end   = meshed_tread(scene) + beyond_path(scene, ellipse);
      return on_wheel;
    }


    Body make_rail(const Scene &scene, const FineZones &zones)
    {
      if (scene.shapes().rail_mesh)
        return make_mesh_rail(scene.shapes().rail_mesh, zones);
      const RailTop top{scene.shapes().rail_height, scene.rail.angle()};
      if (scene.rail.is_block())
        {
          RailBlock block;
          block.x_begin            = scene.rail_begin();
          block.x_end              = scene.rail_end();
          block.top                = top;
          block.width              = scene.rail.block_width;
          block.height             = scene.rail.block_height;
          block.crown_radius       = scene.rail.crown_radius;
          block.coarsest_cell_size = scene.mesh.coarsest_cell;
          return make_rail_block(block, zones);
        }
      if (scene.rail.shape == RailShape::full_section)
        {
          WholeRail rail;
          rail.x_begin            = scene.rail_begin();
          rail.x_end              = scene.rail_end();
          rail.coarsest_cell_size = std::min(scene.mesh.coarsest_cell, coarsest_of_a_profile);
          rail.longest_row        = scene.mesh.longest_row;
          rail.top                = top;
          return make_whole_rail(scene.rail.standard_profile(), rail, zones);
        }
      RailHead head;
      head.x_begin            = scene.rail_begin();
      head.x_end              = scene.rail_end();
      head.top                = top;
      head.coarsest_cell_size = std::min(scene.mesh.coarsest_cell, coarsest_of_a_profile);
      return make_rail_head(scene.rail.standard_profile(), head, zones);
    }


    Body make_wheel(const Scene &scene, const unsigned int number, const FineZone &zone)
    {
      if (!scene.wheel.is_full())
        {
          WheelSector sector;
          sector.center_x           = scene.path_begin(number);
          sector.lift               = scene.shapes().first_contact.lift;
          sector.tread_offset       = scene.shapes().surfaces.tread_offset;
          sector.deviation          = scene.shapes().surfaces.deviation;
          sector.radius             = scene.wheel.radius;
          sector.thickness          = scene.wheel.sector_thickness;
          sector.width              = scene.wheel.sector_width;
          const Scene::Range arc    = meshed_arc(scene);
          sector.arc_begin          = arc.begin;
          sector.arc_end            = arc.end;
          sector.coarsest_cell_size = scene.mesh.coarsest_cell;
          sector.between_planes     = scene.shapes().is_between_planes();
          try
            {
              return make_wheel_sector(sector, zone);
            }
          catch (const std::invalid_argument &error)
            {
              throw InputError("'Wheel/Sector width (mm)' " + text_in_mm(sector.width) +
                               ", 'Wheel/Sector thickness (mm)' " + text_in_mm(sector.thickness) + ": " +
                               error.what());
            }
        }
      FullWheel wheel;
      wheel.center_x           = scene.path_begin(number);
      wheel.lift               = scene.shapes().first_contact.lift;
      wheel.tread_offset       = scene.shapes().surfaces.tread_offset;
      wheel.deviation          = scene.shapes().surfaces.deviation;
      wheel.radius             = scene.wheel.radius;
      wheel.rim_inner_radius   = scene.wheel.rim_inner_radius;
      wheel.rim_width          = scene.wheel.rim_width;
      wheel.web_thickness      = scene.wheel.web_thickness;
      wheel.hub_outer_radius   = scene.wheel.hub_outer_radius;
      wheel.hub_length         = scene.wheel.hub_length;
      wheel.bore_radius        = scene.wheel.bore_radius;
      wheel.coarsest_cell_size = scene.mesh.coarsest_cell;
      return make_full_wheel(wheel, zone);
    }


    Body make_sleeper(const Scene &scene, const double x)
    {
      // Three cells over the height, and no larger than 60 mm.
      SleeperBox box;
      box.x                  = x;
      box.width              = scene.track.sleeper_width;
      box.y_begin            = -0.5 * scene.track.rail_distance;
      box.y_end              = box.y_begin + 0.5 * scene.track.sleeper_length;
      box.top                = base_middle(scene)[2] - pad_thickness;
      box.height             = scene.track.solid_sleeper_height();
      box.coarsest_cell_size = std::min(box.height / 3., 0.06);
      return tread::make_sleeper(box);
    }
  } // namespace


  FineWindow fine_window(const Scene &scene, const unsigned int number, const double tread)
  {
    if (!has_window(scene))
      return {};
    const Scene::Range stretch = windows(scene).at(number);
    const double       margin  = window_margin(scene),
                 rolling       = (1. + largest_creepage(scene)) * (stretch.end - stretch.begin);
    return {stretch.begin - margin, stretch.end + margin, tread - margin, tread + rolling + margin};
  }


  std::vector<Body> UprightWheel::make_bodies(const FineWindow &window) const
  {
    const reference::HertzEllipse ellipse = this->ellipse(scene.static_load());
    std::vector<Body>             bodies;
    bodies.push_back(make_rail(scene, zones_on_rail(scene, ellipse, window)));
    bodies.back().name = "rail";
    for (unsigned int k = 0; k < scene.n_wheels(); ++k)
      {
        bodies.push_back(make_wheel(scene, k, zone_on_wheel(scene, k, ellipse, window)));
        bodies.back().name = k == 0 ? "wheel" : "wheel " + std::to_string(k + 1);
      }
    if (scene.track.has_solid_sleepers())
      for (const double x : support_positions(scene))
        bodies.push_back(make_sleeper(scene, x));
    return bodies;
  }
} // namespace tread
