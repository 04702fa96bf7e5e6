// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/profile_names.h>
#include <tread/geometry/wheel_deviation.h>
#include <tread/geometry/wheel_tread.h>
#include <tread/mesh/rail_body.h>
#include <tread/reference/half_space.h>
#include <tread/reference/hertz.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/scene.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
    /// A measured head must reach this far at each side, m.
    constexpr double least_half_head = 12e-3;

    /// Beside the measured part the difference from the nominal profile fades out over this length, m.
    constexpr double fading_length = 5e-3;

    void shape_wheel(SceneShapes &made, const Scene &scene)
    {
      RunningSurfaces &surfaces = made.surfaces;
      surfaces.radius           = scene.wheel.radius;
      try
        {
          if (const auto offset = tread_offset(scene.parameters().located(scene.wheel.tread_profile),
                                               running_half_width + std::abs(scene.wheel.lateral_position),
                                               scene.wheel.profile_placement))
            surfaces.tread_offset = [offset, y_circle = scene.wheel.lateral_position](const double y) {
              return offset(y - y_circle);
            };
        }
      catch (const std::runtime_error &error)
        {
          throw InputError("'Wheel/Tread profile': " +
                           refused_tread(scene.wheel.tread_profile, error.what()));
        }
      shape_deviation(made, scene);
    }

    void shape_rail(SceneShapes &made, const Scene &scene)
    {
      RunningSurfaces &surfaces = made.surfaces;
      surfaces.half_width       = running_half_width;
      std::function<double(double)> height; // over the profile, along its own vertical
      if (scene.rail.is_block())
        {
          surfaces.half_width = std::min(running_half_width, 0.499 * scene.rail.block_width);
          surfaces.rail_top   = [radius = scene.rail.crown_radius](const double y) {
            return crown_height(y, radius);
          };
        }
      else
        {
          const RailProfile profile = scene.rail.standard_profile();
          const double      edge    = 0.999 * profile.head_half_width();
          const auto        nominal = [profile, edge](const double y) {
            const double on_head = std::clamp(y, -edge, edge);
            return profile.z_top(on_head) - std::abs(y - on_head);
          };
          if (!scene.rail.measured_head.empty())
            try
              {
                const MeasuredLine line =
                  read_rail_head(scene.parameters().located(scene.rail.measured_head), running_half_width,
                                 least_half_head, scene.rail.head_placement);
                surfaces.half_width = std::min({running_half_width, -line.begin(), line.end()});
                height              = [line, nominal, edge](const double y) {
                  const double measured =
                    std::clamp(y, std::max(line.begin(), -edge), std::min(line.end(), edge));
                  // A narrow head goes on with the difference at its end, so that no step rises beside it.
                  const double beside =
                    std::abs(y - measured) - std::max(0., running_half_width - std::abs(measured));
                  const double fade = std::clamp(1. - beside / fading_length, 0., 1.);
                  return fade * (line(measured) - nominal(measured));
                };
              }
            catch (const std::runtime_error &error)
              {
                throw InputError("'Rail/Measured head': " + std::string(error.what()));
              }
          const auto own = [nominal, height](const double y) {
            return nominal(y) + (height ? height(y) : 0.);
          };
          if (const double angle = scene.rail.angle(); angle == 0.)
            surfaces.rail_top = own;
          else
            surfaces.rail_top = [own, angle](const double y) {
              return turned_line(own, angle, y);
            };
        }

      if (made.defect)
        surfaces.defect = [defect = *made.defect](const double x, const double y) {
          return defect.height(x, y);
        };
      if (height || made.defect)
        made.rail_height = [height, defect = surfaces.defect](const double x, const double y) {
          return (height ? height(y) : 0.) + (defect ? defect(x, y) : 0.);
        };
    }

    /// @param islands of the patch, found with it
    PatchExtent patch_under_load(const Scene &scene, std::vector<Island> &islands)
    {
      const double           y = scene.shapes().first_contact.y, load = scene.static_load();
      const RunningSurfaces &surfaces = scene.shapes().surfaces;
      if (load <= 0.)
        return {y, y};
      if (scene.shapes().is_between_planes())
        return {-surfaces.half_width, surfaces.half_width};
      const reference::RollingCase  touching = half_space_case(scene, load, 0.);
      const reference::ElasticPair  pair     = reference::combine(touching.wheel, touching.rail);
      const reference::HertzEllipse hertz    = tread::hertz(touching);
      const double                  radius   = scene.stance().rolling_radius();

      // The range extends to each side as far as the running surfaces are known, unless the ellipse is small.
      const double       half_width = surfaces.half_width;
      const double       most       = 4. * std::max(hertz.semi_axis_x, hertz.semi_axis_y);
      const unsigned int n_x        = 12;
      reference::Grid    grid;
      grid.dx                   = 1.5 * hertz.semi_axis_x / n_x;
      grid.dy                   = 0.1 * std::min(hertz.semi_axis_y, half_width);
      const unsigned int n_low  = std::min(most, half_width + y) / grid.dy,
                         n_high = std::min(most, half_width - y) / grid.dy;
      grid.n_x                  = 2 * n_x + 1;
      grid.n_y                  = n_low + n_high + 1;
      grid.x_first              = -grid.dx * n_x;
      grid.y_first              = -grid.dy * n_low;
      reference::NormalProblem problem;
      problem.force     = load;
      problem.tolerance = 1e-4;
      for (unsigned int j = 0; j < grid.n_y; ++j)
        for (unsigned int i = 0; i < grid.n_x; ++i)
          {
            problem.gap.push_back(0.5 * grid.x(i) * grid.x(i) / radius + surfaces.gap(y + grid.y(j)) -
                                  surfaces.gap(y));
            problem.initial_pressure.push_back(hertz.pressure(grid.x(i), grid.y(j)));
            if (!std::isfinite(problem.gap.back()))
              return {y, y}; // check_sections() says what is wrong with the shape
          }
      const reference::FourierGrid    fourier(grid);
      const reference::NormalSolution solution =
        reference::solve_normal(fourier, reference::NormalOperator(fourier, pair), problem);
      islands = islands_of(grid, solution.pressure);
      for (Island &island : islands)
        {
          island.y_begin += y;
          island.y_end += y;
        }
      PatchExtent patch{y, y};
      for (const unsigned int e : solution.contact)
        {
          patch.begin = std::min(patch.begin, y + grid.y(e / grid.n_x));
          patch.end   = std::max(patch.end, y + grid.y(e / grid.n_x));
        }
      return patch;
    }

    /// Of the wheel from round, inwards or outwards, that comes to the rail on the way that is meshed (m).
    double deviation_on_the_way(const Scene &scene)
    {
      if (scene.shapes().is_round())
        return 0.;
      constexpr double step = 0.5e-3; // m
      const double     a =
                     scene.static_load() > 0. ? scene.stance().ellipse(scene.static_load()).semi_axis_x : 0.,
                   half_width = scene.shapes().surfaces.half_width;
      double largest          = 0.;
      for (double way = -a; way <= scene.motion.meshed_distance() + a; way += step)
        for (double y = -half_width; y <= half_width; y += step)
          largest =
            std::max(largest, std::abs(scene.shapes().surfaces.deviation(way / scene.wheel.radius, y)));
      return largest;
    }
  } // namespace


  void shape_deviation(SceneShapes &made, const Scene &scene)
  {
    if (scene.wheel.deviation.empty())
      return;
    require(!scene.wheel.deviation.ends_with(".slcw") ||
              (!scene.wheel.profile_placement.is_mirrored && scene.wheel.profile_placement.shift == 0.),
            "'Wheel/Deviation' " + scene.wheel.deviation +
              " has sections in the axes of the wheel: 'Tread profile mirrored' and 'Tread profile shift "
              "(mm)', which "
              "move the profile alone, must be false and 0");
    const auto round = [&] {
      return wheel_curve(scene.parameters().located(scene.wheel.tread_profile),
                         scene.wheel.profile_placement);
    };
    try
      {
        const auto more         = wheel_deviation(scene.parameters().located(scene.wheel.deviation), round,
                                                  scene.wheel.radius, scene.wheel.deviation_smoothing);
        made.wheel_deviation    = more->in_words();
        made.surfaces.deviation = [more, pitch = scene.wheel.deviation_pitch,
                                   y_circle = scene.wheel.lateral_position](const double angle,
                                                                            const double y) {
          return more->at(angle - pitch, y - y_circle).dz;
        };
      }
    catch (const std::runtime_error &error)
      {
        throw InputError(std::string("'Wheel/Deviation': ") + error.what());
      }
  }


  SceneShapes make_shapes(const Scene &scene, const std::shared_ptr<const Defect> &defect)
  {
    SceneShapes made;
    made.defect = defect;
    shape_wheel(made, scene);
    scene.rail.is_meshed() ? shape_mesh_rail(made, scene) : shape_rail(made, scene);
    made.first_contact = first_contact(made.surfaces, scene.path_begin());
    return made;
  }


  void add_patch(SceneShapes &shapes, const Scene &scene)
  {
    shapes.patch             = patch_under_load(scene, shapes.islands);
    shapes.largest_deviation = deviation_on_the_way(scene);
  }
} // namespace tread
