// SPDX-License-Identifier: LGPL-2.1-or-later
// Where cells are fine: zones, windows, what of a wheel is meshed.
#include <tread/reference/hertz.h>
#include <tread/scene/fine_cells.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  double needed_half_width(const Scene &scene)
  {
    if (scene.shapes().is_between_planes())
      return scene.shapes().surfaces.half_width;
    return 1.1 *
             std::max(scene.shapes().patch.end - path_y(scene), path_y(scene) - scene.shapes().patch.begin) +
           scene.mesh.finest_cell;
  }


  double fine_half_width(const Scene &scene)
  {
    if (scene.mesh.fine_half_width > 0.)
      return scene.mesh.fine_half_width;
    // A wheel that is not round touches beside the patch.
    const double of_round =
      (scene.general.quasi_static ? 1. : room_for_dynamic_load) * needed_half_width(scene);
    if (scene.shapes().is_round())
      return of_round;
    constexpr double of_body = 0.75; // of its half width, beside which there must be room for coarser cells
    const double     widest =
      of_body * std::min(scene.rail_half_width(), scene.wheel.half_width()) - std::abs(path_y(scene));
    return std::max(of_round,
                    std::min(of_round + reach_of(scene, scene.shapes().largest_deviation).end, widest));
  }


  double path_y(const Scene &scene)
  {
    const double cell = scene.mesh.finest_cell, y = scene.shapes().first_contact.y;
    return y + cell * std::trunc((0.5 * (scene.shapes().patch.begin + scene.shapes().patch.end) - y) / cell);
  }


  double largest_creepage(const Scene &scene)
  {
    constexpr double with_traction = 0.01;
    if (scene.motion.angular_velocity)
      return std::max(with_traction,
                      *scene.motion.angular_velocity * scene.stance().rolling_radius() / scene.motion.speed -
                        1.);
    return std::max(with_traction, scene.motion.creepage.value_or(0.));
  }


  double meshed_tread(const Scene &scene)
  {
    // Cells are fine a quarter of a semi-axis before the patch.
    constexpr double spare = 0.25;
    const double     way   = scene.motion.meshed_distance();
    return way + std::max(0., largest_creepage(scene) * way -
                                spare * scene.stance().ellipse(scene.static_load()).semi_axis_x);
  }


  double longest_sector(const Scene &scene)
  {
    constexpr double of_a_turn = 0.95;
    return of_a_turn * 2. * dealii::numbers::PI * scene.wheel.radius;
  }


  bool wheel_is_ring(const Scene &scene)
  {
    return !scene.wheel.is_full() &&
           meshed_tread(scene) + 2. * scene.wheel.sector_margin > longest_sector(scene);
  }


  Scene::Range meshed_arc(const Scene &scene)
  {
    if (!wheel_is_ring(scene))
      return {-scene.wheel.sector_margin, meshed_tread(scene) + scene.wheel.sector_margin};
    const double half = dealii::numbers::PI * scene.wheel.radius;
    return {-half, half};
  }


  std::string keeps_mesh(const Scene &scene)
  {
    const auto yields = [](const MaterialSection &material) {
      return material.yield_stress > 0. || !material.plastic_zones.empty();
    };
    for (const auto &[what, is_there] : std::initializer_list<std::pair<const char *, bool>>{
           {"'Rail/Shape' slices", scene.rail.is_sliced()},
           {"several wheels", scene.n_wheels() > 1},
           {"several passages", scene.motion.passages > 1},
           {"'Motion/Longest distance (mm)'", scene.motion.longest_distance > 0.},
           {"a rail that is meshed in a file", bool(scene.shapes().rail_mesh)},
           {"steel that yields", yields(scene.rail.material) || yields(scene.wheel.material)},
           {"'Damage/Record'", scene.damage.record},
           {"section 'Peak stress'", scene.peak_stress.is_wanted()},
           {"'Output/Cells'", !scene.output.cells.empty()},
           {"'Scene/Reproducible'", scene.general.reproducible}})
      if (is_there)
        return what;
    return "";
  }


  bool has_window(const Scene &scene)
  {
    // Windows on supports are long, and a change costs as much as a seventh of one: from four on it pays.
    // Forces then differ by 0.1 to 0.2 % of their swing (doc/performance.md); of flats nobody has looked.
    constexpr double pays = 4.;
    return scene.mesh.window == WindowUse::always ||
           (scene.mesh.window == WindowUse::automatic && scene.track.has_supports() &&
            scene.shapes().is_round() && keeps_mesh(scene).empty() &&
            scene.motion.rolled_distance >= pays * usual_window(scene));
  }


  double usual_window(const Scene &scene)
  {
    // A change takes as long as three millimetres of rolling with the true density (0.63 mm, 25 000 cells),
    // and on a track of many spans as long as twenty. @see doc/performance.md
    const double semi_axes =
      (scene.track.has_supports() ? 12. : 2.5) * std::pow(scene.general.density_scale, 0.25);
    return scene.mesh.window_length > 0.
             ? scene.mesh.window_length
             : semi_axes * scene.stance().ellipse(scene.static_load()).semi_axis_x;
  }


  std::vector<Scene::Range> windows(const Scene &scene)
  {
    const double begin = scene.path_begin(), end = begin + scene.motion.rolled_distance;
    if (!has_window(scene))
      return {{begin, end}};
    const double        usual = usual_window(scene);
    std::vector<double> stretches{begin};
    if (has_cubes(scene))
      {
        // A window ends some steps behind its border, and then the tread of the next is a little further on.
        constexpr double least = 1. / 3.; // of a usual window, which a change is worth
        const double     away  = window_margin(scene) + scene.mesh.finest_cell;
        for (const double border : {cubes(scene).begin - away, cubes(scene).end + away})
          if (border >= stretches.back() + least * usual && border <= end - least * usual)
            stretches.push_back(border);
      }
    stretches.push_back(end);

    std::vector<Scene::Range> list;
    for (std::size_t k = 0; k + 1 < stretches.size(); ++k)
      {
        constexpr double   tiny = 1e-9; // of a window
        const double       from = stretches[k], length = stretches[k + 1] - from;
        const unsigned int n = std::max(1., scene.mesh.window_length > 0. ? std::ceil(length / usual - tiny)
                                                                          : std::round(length / usual));
        for (unsigned int i = 0; i < n; ++i)
          list.push_back({from + length * i / n, i + 1 < n ? from + length * (i + 1) / n : stretches[k + 1]});
      }
    return list;
  }


  double window_margin(const Scene &scene)
  {
    // Forces then differ by 0.06 % at most from those with all cells fine; with 3 semi-axes by 0.05 %.
    constexpr double semi_axes = 1.75, cells = 2.;
    return scene.mesh.window_margin > 0.
             ? scene.mesh.window_margin
             : semi_axes * scene.stance().ellipse(scene.static_load()).semi_axis_x +
                 cells * scene.mesh.finest_cell;
  }


  bool has_cubes(const Scene &scene)
  {
    return scene.mesh.fine_from < scene.mesh.fine_to && scene.mesh.path_cell > scene.mesh.finest_cell;
  }


  Scene::Range cubes(const Scene &scene)
  {
    return {scene.defect.position + scene.mesh.fine_from, scene.defect.position + scene.mesh.fine_to};
  }


  bool is_finest(const Scene &scene, const double begin, const double end)
  {
    return !has_cubes(scene) || (begin >= cubes(scene).begin && end <= cubes(scene).end);
  }


  Scene::Range reach_of(const Scene &scene, const double height)
  {
    if (!(height > 0.))
      return {0., 0.};
    // Along the path the wheel stands x^2 / 2R above the rail.
    const double along = std::sqrt(2. * scene.stance().rolling_radius() * height);
    return {along, scene.stance().reach_beside(height)};
  }
} // namespace tread
