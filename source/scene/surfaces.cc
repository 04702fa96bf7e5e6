// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/geometry/profile_names.h>
#include <tread/geometry/slice_list.h>
#include <tread/geometry/wheel_deviation.h>
#include <tread/geometry/wheel_tread.h>
#include <tread/mesh/rail_body.h>
#include <tread/reference/half_space.h>
#include <tread/reference/hertz.h>
#include <tread/scene/doubts.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/scene.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace tread
{
  namespace
  {
    /// A measured head must reach this far at each side, m.
    constexpr double least_half_head = 12e-3;

    /// Beside the measured part the difference from the nominal profile fades out over this length, m.
    constexpr double fading_length = 5e-3;
  } // namespace


  void Scene::note_files()
  {
    std::error_code cannot_tell;
    for (const auto &[name, file] :
         {std::pair("Wheel/Tread profile", wheel.tread_profile),
          std::pair("Wheel/Deviation", wheel.deviation), std::pair("Rail/Measured head", rail.measured_head),
          std::pair("Rail/Slices", rail.slices), std::pair("Rail/Mesh file", rail.mesh_file),
          std::pair("Defect/Profile file", defect.profile_file), std::pair("Guidance/File", guidance.file),
          std::pair("Track/Support file", track.support_file), std::pair("Track/Beam file", track.beam_file)})
      if (const std::string path = input.located(file);
          !file.empty() && std::filesystem::is_regular_file(path, cannot_tell))
        {
          input.note(name, path);
          // A slice may stand in a list more than once.
          const std::vector<std::string> named = slices_named_in(path);
          for (const std::string &slice : std::set<std::string>(named.begin(), named.end()))
            input.note(std::string(name) + ": " + slice,
                       (std::filesystem::path(path).parent_path() / slice).string());
        }
  }


  std::shared_ptr<Scene::Shapes> Scene::make_path() const
  {
    auto         made   = std::make_shared<Shapes>();
    const double begin  = motion.start.value_or(-motion.meshed_distance()),
                 behind = distance_behind(last_wheel()),
                 margin =
                   rail.length > 0. ? 0.5 * (rail.length - motion.meshed_distance() - behind) : rail.margin;
    made->path_begin = begin;
    made->path_end   = begin + motion.rolled_distance;
    made->rail_begin = rail.begin.value_or(begin - behind - margin);
    return made;
  }


  void Scene::make_shapes()
  {
    const auto made = make_path();
    made->defect    = defect.make(input.located(defect.profile_file));
    shape_wheel(*made);
    rail.is_meshed() ? shape_mesh_rail(*made) : shape_rail(*made);
    made->contact           = tread::first_contact(made->surfaces, made->path_begin);
    shapes                  = made;
    made->patch             = patch_under_load(made->islands);
    made->largest_deviation = deviation_on_the_way();
  }


  bool Scene::has_narrow_head() const
  {
    return !rail.measured_head.empty() && surfaces().half_width < running_half_width;
  }


  std::string Scene::defect_in_words() const
  {
    const Defect     *made     = made_defect();
    const std::string wheel_is = is_round() ? "" : "the wheel is not round: " + shapes->deviation;
    if (!made)
      return wheel_is;
    return (is_round() ? "" : wheel_is + "; ") +
           format("defect: x = %.2f to %.2f mm, %.3f mm deep%s", 1e3 * made->begin,
                  1e3 * (made->begin + made->length), 1e3 * made->depth,
                  made->is_a_bump() ? "; it rises ABOVE the rail more than it lies below" : "") +
           (made->repeated_at.empty()
              ? ""
              : format("; %u more like it", static_cast<unsigned int>(made->repeated_at.size()))) +
           (misses_defect(*this) ? "; the contact does NOT reach it" : "");
  }


  void Scene::shape_wheel(Shapes &made) const
  {
    RunningSurfaces &surfaces = made.surfaces;
    surfaces.radius           = wheel.radius;
    try
      {
        if (const auto offset =
              tread_offset(input.located(wheel.tread_profile),
                           running_half_width + std::abs(wheel.lateral_position), wheel.profile_placement))
          surfaces.tread_offset = [offset, y_circle = wheel.lateral_position](const double y) {
            return offset(y - y_circle);
          };
      }
    catch (const std::runtime_error &error)
      {
        throw InputError("'Wheel/Tread profile': " + refused_tread(wheel.tread_profile, error.what()));
      }
    if (wheel.deviation.empty())
      return;
    require(!wheel.deviation.ends_with(".slcw") ||
              (!wheel.profile_placement.is_mirrored && wheel.profile_placement.shift == 0.),
            "'Wheel/Deviation' " + wheel.deviation +
              " has sections in the axes of the wheel: 'Tread profile mirrored' and 'Tread profile shift "
              "(mm)', which "
              "move the profile alone, must be false and 0");
    const auto round = [&] {
      return wheel_curve(input.located(wheel.tread_profile), wheel.profile_placement);
    };
    try
      {
        const auto more =
          wheel_deviation(input.located(wheel.deviation), round, wheel.radius, wheel.deviation_smoothing);
        made.deviation     = more->in_words();
        surfaces.deviation = [more, pitch = wheel.deviation_pitch,
                              y_circle = wheel.lateral_position](const double angle, const double y) {
          return more->at(angle - pitch, y - y_circle).dz;
        };
      }
    catch (const std::runtime_error &error)
      {
        throw InputError(std::string("'Wheel/Deviation': ") + error.what());
      }
  }


  void Scene::shape_rail(Shapes &made) const
  {
    RunningSurfaces &surfaces = made.surfaces;
    surfaces.half_width       = running_half_width;
    std::function<double(double)> height; // over the profile, along its own vertical
    if (rail.is_block())
      {
        surfaces.half_width = std::min(running_half_width, 0.499 * rail.block_width);
        surfaces.rail_top   = [radius = rail.crown_radius](const double y) {
          return crown_height(y, radius);
        };
      }
    else
      {
        const RailProfile profile = rail.standard_profile();
        const double      edge    = 0.999 * profile.head_half_width();
        const auto        nominal = [profile, edge](const double y) {
          const double on_head = std::clamp(y, -edge, edge);
          return profile.z_top(on_head) - std::abs(y - on_head);
        };
        if (!rail.measured_head.empty())
          try
            {
              const MeasuredLine line = read_rail_head(input.located(rail.measured_head), running_half_width,
                                                       least_half_head, rail.head_placement);
              surfaces.half_width     = std::min({running_half_width, -line.begin(), line.end()});
              height                  = [line, nominal, edge](const double y) {
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
        if (const double angle = rail.angle(); angle == 0.)
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


  Scene::PatchExtent Scene::patch_under_load(std::vector<Island> &islands) const
  {
    const double y = first_contact().y, load = static_load();
    if (load <= 0.)
      return {y, y};
    if (is_between_planes())
      return {-surfaces().half_width, surfaces().half_width};
    const reference::RollingCase  touching = half_space_case(*this, load, 0.);
    const reference::ElasticPair  pair     = reference::combine(touching.wheel, touching.rail);
    const reference::HertzEllipse hertz    = tread::hertz(touching);
    const double                  radius   = rolling_radius();

    // The range extends to each side as far as the running surfaces are known, unless the ellipse is small.
    const double       half_width = surfaces().half_width;
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
          problem.gap.push_back(0.5 * grid.x(i) * grid.x(i) / radius + surfaces().gap(y + grid.y(j)) -
                                surfaces().gap(y));
          problem.initial_pressure.push_back(hertz.pressure(grid.x(i), grid.y(j)));
          if (!std::isfinite(problem.gap.back()))
            return {y, y}; // check() says what is wrong with the shape
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


  double Scene::deviation_on_the_way() const
  {
    if (is_round())
      return 0.;
    constexpr double step   = 0.5e-3; // m
    const double     a      = static_load() > 0. ? hertz(*this, static_load()).semi_axis_x : 0.,
                 half_width = surfaces().half_width;
    double largest          = 0.;
    for (double way = -a; way <= motion.meshed_distance() + a; way += step)
      for (double y = -half_width; y <= half_width; y += step)
        largest = std::max(largest, std::abs(surfaces().deviation(way / wheel.radius, y)));
    return largest;
  }


  double Scene::rail_end() const
  {
    if (rail_mesh())
      return rail_mesh()->surface.along().end;
    return rail.length > 0. ? rail_begin() + rail.length : meshed_end() + rail.margin;
  }


  double Scene::rail_half_width() const
  {
    return rail.is_meshed() ? surfaces().half_width : rail.half_width();
  }


  double Scene::rail_thickness() const
  {
    return rail_mesh() ? rail_mesh()->thickness(path_begin(), first_contact().y) : rail.thickness();
  }


  dealii::Point<3> Scene::in_rail_axes(const dealii::Point<3> &p) const
  {
    const double c = std::cos(rail.angle()), s = std::sin(rail.angle());
    return {p[0], c * p[1] + s * p[2], -s * p[1] + c * p[2]};
  }


  double Scene::rolling_radius() const
  {
    return stance().rolling_radius();
  }


  double Scene::lateral_radius() const
  {
    if (!has_fitted_lateral_radius())
      return rail.is_block() ? rail.crown_radius : rail.standard_profile().crown_radius();
    return std::min(first_contact().lateral_radius, largest_lateral_radius);
  }


  bool Scene::has_fitted_lateral_radius() const
  {
    return surfaces().tread_offset || rail.angle() != 0. || !rail.measured_head.empty() || rail.is_meshed();
  }
} // namespace tread
