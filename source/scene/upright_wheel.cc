// SPDX-License-Identifier: LGPL-2.1-or-later
// make_bodies() is in bodies.cc, ellipse() in half_space_case.cc.
#include <tread/scene/fine_cells.h>
#include <tread/scene/parts.h>
#include <tread/scene/upright_wheel.h>

#include <cmath>

namespace tread
{
  double UprightWheel::rolling_radius() const
  {
    const auto &offset = scene.shapes().surfaces.tread_offset;
    return scene.wheel.radius + (offset ? offset(scene.shapes().first_contact.y) : 0.);
  }


  double UprightWheel::patch_y() const
  {
    return scene.shapes().first_contact.y;
  }


  void UprightWheel::place(WheelHub &hub, const unsigned int number) const
  {
    hub.place(Vector3{scene.path_begin(number), 0., scene.axle_height(), 0.});
    hub.motion.angular_velocity = scene.motion.speed / rolling_radius();
  }


  std::vector<WheelStance::Place> UprightWheel::places_under(const dealii::Point<3> &p,
                                                             const unsigned int      body) const
  {
    const double beside = p[1] - path_y(scene);
    if (body == rail_body)
      return {{p[0], beside, scene.shapes().rail_mesh ? depth_in_rail(p) : -scene.rail.in_own_axes(p)[2]}};
    const double dx = p[0] - scene.path_begin(body - wheel_body(0)), dz = p[2] - scene.axle_height();
    return {{scene.wheel.radius * std::atan2(dx, -dz), beside, scene.wheel.radius - std::hypot(dx, dz)}};
  }


  double UprightWheel::depth_in_rail(const dealii::Point<3> &p) const
  {
    const auto &height = scene.shapes().surfaces.defect;
    return scene.shapes().surfaces.rail_top(p[1]) + (height ? height(p[0], p[1]) : 0.) - p[2];
  }


  std::vector<WheelStance::Path> UprightWheel::paths() const
  {
    const double half_cell = 0.5 * scene.mesh.finest_cell;
    return {{nullptr, "", scene.path_begin(), scene.path_end() + half_cell, 0., 0.}};
  }


  WheelStance::Strip UprightWheel::strip(const unsigned int body, const double, const double) const
  {
    const Strip::Measure beside = [y = patch_y()](const dealii::Point<3> &p) {
      return p[1] - y;
    };
    if (body == rail_body)
      return {paths().front(), [](const dealii::Point<3> &p) { return p[0]; }, beside,
              [this](const dealii::Point<3> &p) {
                return depth_in_rail(p);
              }};
    const double begin = scene.path_begin(), height = scene.axle_height();
    return {paths().front(),
            [begin, height, radius = rolling_radius()](const dealii::Point<3> &p) {
              return begin + radius * std::atan2(p[0] - begin, height - p[2]);
            },
            beside,
            [this, begin, height](const dealii::Point<3> &p) {
              const double ahead = p[0] - begin, down = height - p[2];
              return scene.shapes().surfaces.wheel_radius(std::atan2(ahead, down), p[1]) -
                     std::hypot(ahead, down);
            }};
  }


  bool UprightWheel::is_on_path(const dealii::Point<3> &p, const double cell) const
  {
    return std::abs(p[1] - path_y(scene)) <= 0.5 * cell * (1. + 1e-6);
  }


  double UprightWheel::factor_across(const Vector3 &place) const
  {
    constexpr double step = 50e-6; // m
    const auto      &top  = scene.shapes().surfaces.rail_top;
    return scene.contact.factor_across(place[1],
                                       std::atan2(top(place[1] + step) - top(place[1] - step), 2. * step));
  }


  std::vector<std::pair<double, double>> UprightWheel::loaded_lines() const
  {
    // Hertz's pressure, summed along the rail.
    constexpr int                          n     = 50;
    const PatchExtent                     &patch = scene.shapes().patch;
    std::vector<std::pair<double, double>> lines;
    for (int k = -n; k <= n; ++k)
      {
        const double part = (k + 0.) / (n + 1);
        lines.emplace_back(0.5 * ((1. - part) * patch.begin + (1. + part) * patch.end), 1. - part * part);
      }
    return lines;
  }


  std::vector<WheelStance::Footprint> UprightWheel::footprints() const
  {
    const double a = scene.static_load() > 0. ? ellipse(scene.static_load()).semi_axis_x : 0.;
    return {{-a, a, scene.shapes().patch.begin, scene.shapes().patch.end}};
  }


  std::vector<WheelStance::Footprint> UprightWheel::treads() const
  {
    std::vector<Footprint> all = footprints();
    all.front().x_end += scene.motion.meshed_distance();
    return all;
  }


  double UprightWheel::reach_beside(const double height) const
  {
    constexpr double       step     = 0.1e-3; // m
    const RunningSurfaces &surfaces = scene.shapes().surfaces;
    const PatchExtent     &patch    = scene.shapes().patch;
    const double           least    = surfaces.gap(scene.shapes().first_contact.y);
    double                 reach    = 0.;
    for (const double side : {-1., 1.})
      {
        const double edge = side > 0. ? patch.end : patch.begin;
        for (double beside = 0.; std::abs(edge + side * beside) <= surfaces.half_width; beside += step)
          if (const double gap = surfaces.gap(edge + side * beside) - least;
              std::isfinite(gap) && gap <= height)
            reach = std::max(reach, beside + step);
      }
    return reach;
  }


  std::vector<std::pair<std::string, std::vector<Island>>> UprightWheel::parts_of_patches() const
  {
    if (scene.shapes().is_between_planes()) // whose patch goes on as its own image
      return {};
    return {{"the patch", scene.shapes().islands}};
  }
} // namespace tread
