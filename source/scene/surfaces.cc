// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/geometry/profile_names.h>
#include <tread/geometry/slice_list.h>
#include <tread/geometry/wheel_deviation.h>
#include <tread/geometry/wheel_tread.h>
#include <tread/mesh/rail_body.h>
#include <tread/reference/half_space.h>
#include <tread/reference/hertz.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/scene.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

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


  std::string Scene::located(const std::string &file) const
  {
    std::error_code cannot_tell; // of a name that no file can have
    return !std::filesystem::exists(file, cannot_tell) && std::filesystem::exists(folder / file, cannot_tell)
             ? (folder / file).string()
             : file;
  }


  void Scene::note_files()
  {
    std::error_code cannot_tell;
    for (const auto &[name, file] :
         {std::pair("Wheel/Tread profile", wheel.tread_profile),
          std::pair("Wheel/Deviation", wheel.deviation), std::pair("Rail/Measured head", rail.measured_head),
          std::pair("Rail/Slices", rail.slices), std::pair("Rail/Mesh file", rail.mesh_file),
          std::pair("Defect/Profile file", defect.profile_file), std::pair("Guidance/File", guidance.file),
          std::pair("Track/Support file", track.support_file), std::pair("Track/Beam file", track.beam_file)})
      if (const std::string path = located(file);
          !file.empty() && std::filesystem::is_regular_file(path, cannot_tell))
        {
          read_files.push_back(file_read(name, path));
          // A slice may stand in a list more than once.
          const std::vector<std::string> named = slices_named_in(path);
          for (const std::string &slice : std::set<std::string>(named.begin(), named.end()))
            read_files.push_back(file_read(std::string(name) + ": " + slice,
                                           (std::filesystem::path(path).parent_path() / slice).string()));
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
    made->defect    = defect.make(located(defect.profile_file));
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


  bool Scene::misses_defect() const
  {
    const Defect &made = *made_defect();
    // A wheelset may move across its rails.
    if (is_positioned() || static_load() <= 0.)
      return false;
    const Range beyond = reach_of(-extremes_of(made.shape).first * made.depth);
    // As wide as the zone of fine cells would be, for what inertia adds to the load.
    constexpr double room = 1.35;
    const double     a    = room * hertz(*this, static_load()).semi_axis_x + mesh.finest_cell + beyond.begin,
                 middle   = 0.5 * (patch_extent().begin + patch_extent().end),
                 half_width =
                   room * 0.5 * (patch_extent().end - patch_extent().begin) + mesh.finest_cell + beyond.end;
    if (std::abs(made.y_middle - middle) > half_width + 0.5 * made.width)
      return true;
    std::vector<double> begins(made.repeated_at);
    begins.push_back(made.begin);
    return std::none_of(begins.begin(), begins.end(), [&](const double begin) {
      for (unsigned int number = 0; number < n_wheels(); ++number)
        if (begin < path_begin(number) + motion.meshed_distance() + a &&
            begin + made.length > path_begin(number) - a)
          return true;
      return false;
    });
  }


  Scene::Range Scene::reach_of(const double height) const
  {
    if (!(height > 0.))
      return {0., 0.};
    // Along the path the wheel stands x^2 / 2R above the rail.
    const double along = std::sqrt(2. * rolling_radius() * height);
    // Across, where the gap is larger than the height from here on.
    constexpr double step   = 0.1e-3; // m
    const double     least  = surfaces().gap(first_contact().y);
    double           across = 0.;
    for (const double side : {-1., 1.})
      {
        const double edge    = side > 0. ? patch_extent().end : patch_extent().begin;
        double       touched = 0.;
        for (double beside = 0.; std::abs(edge + side * beside) <= surfaces().half_width; beside += step)
          if (const double gap = surfaces().gap(edge + side * beside) - least;
              std::isfinite(gap) && gap <= height)
            touched = beside + step;
        across = std::max(across, touched);
      }
    return {along, across};
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
           (misses_defect() ? "; the contact does NOT reach it" : "");
  }


  void Scene::shape_wheel(Shapes &made) const
  {
    RunningSurfaces &surfaces = made.surfaces;
    surfaces.radius           = wheel.radius;
    try
      {
        if (const auto offset =
              tread_offset(located(wheel.tread_profile),
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
      return wheel_curve(located(wheel.tread_profile), wheel.profile_placement);
    };
    try
      {
        const auto more =
          wheel_deviation(located(wheel.deviation), round, wheel.radius, wheel.deviation_smoothing);
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
              const MeasuredLine line = read_rail_head(located(rail.measured_head), running_half_width,
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


  double Scene::needed_half_width() const
  {
    if (is_between_planes())
      return surfaces().half_width;
    return 1.1 * std::max(patch_extent().end - path_y(), path_y() - patch_extent().begin) + mesh.finest_cell;
  }


  double Scene::detail_within_cells() const
  {
    if (is_positioned())
      return 0.;
    constexpr unsigned int n_between = 8; // places from node to node
    const double           cell      = mesh.finest_cell;
    double                 sum       = 0.;
    unsigned int           n         = 0;
    for (double y = patch_extent().begin + cell; y + 2. * cell <= patch_extent().end; y += cell)
      {
        double of_node[4]; // around the second of three cells
        for (unsigned int i = 0; i < 4; ++i)
          of_node[i] = surfaces().gap(y + (i - 1.) * cell);
        for (unsigned int k = 1; k < n_between; ++k)
          {
            const double s = double(k) / n_between; // Lagrange's cubic
            const double of_nodes =
              -s * (s - 1.) * (s - 2.) / 6. * of_node[0] + (s + 1.) * (s - 1.) * (s - 2.) / 2. * of_node[1] -
              (s + 1.) * s * (s - 2.) / 2. * of_node[2] + (s + 1.) * s * (s - 1.) / 6. * of_node[3];
            if (const double off = surfaces().gap(y + s * cell) - of_nodes; std::isfinite(off))
              {
                sum += off * off;
                ++n;
              }
          }
      }
    return n > 0 ? std::sqrt(sum / n) : 0.;
  }


  double Scene::fine_half_width() const
  {
    if (mesh.fine_half_width > 0.)
      return mesh.fine_half_width;
    // A load that doubles or triples makes the patch wider by its cube root; a wheel that is not round
    // touches beside it.
    constexpr double room_for_dynamic_load = 1.35;
    const double     of_round = (general.quasi_static ? 1. : room_for_dynamic_load) * needed_half_width();
    if (is_round())
      return of_round;
    constexpr double of_body = 0.75; // of its half width, beside which there must be room for coarser cells
    const double     widest  = of_body * std::min(rail_half_width(), wheel.half_width()) - std::abs(path_y());
    return std::max(of_round, std::min(of_round + reach_of(largest_deviation()).end, widest));
  }


  double Scene::largest_creepage() const
  {
    constexpr double with_traction = 0.01;
    if (motion.angular_velocity)
      return std::max(with_traction, *motion.angular_velocity * rolling_radius() / motion.speed - 1.);
    return std::max(with_traction, motion.creepage.value_or(0.));
  }


  double Scene::meshed_tread() const
  {
    // Cells are fine a quarter of a semi-axis before the patch.
    constexpr double spare = 0.25;
    const double     way   = motion.meshed_distance();
    return way + std::max(0., largest_creepage() * way - spare * hertz(*this, static_load()).semi_axis_x);
  }


  double Scene::longest_sector() const
  {
    constexpr double of_a_turn = 0.95;
    return of_a_turn * 2. * dealii::numbers::PI * wheel.radius;
  }


  bool Scene::wheel_is_ring() const
  {
    return !wheel.is_full() && meshed_tread() + 2. * wheel.sector_margin > longest_sector();
  }


  Scene::Range Scene::meshed_arc() const
  {
    if (!wheel_is_ring())
      return {-wheel.sector_margin, meshed_tread() + wheel.sector_margin};
    const double half = dealii::numbers::PI * wheel.radius;
    return {-half, half};
  }


  bool Scene::has_window() const
  {
    // Windows on supports are long, and a change costs as much as a seventh of one: from four on it pays.
    // Forces then differ by 0.1 to 0.2 % of their swing (doc/performance.md); of flats nobody has looked.
    constexpr double pays = 4.;
    return mesh.window == WindowUse::always ||
           (mesh.window == WindowUse::automatic && track.has_supports() && is_round() &&
            keeps_mesh().empty() && motion.rolled_distance >= pays * usual_window());
  }


  double Scene::usual_window() const
  {
    // A change takes as long as three millimetres of rolling with the true density (0.63 mm, 25 000 cells),
    // and on a track of many spans as long as twenty. @see doc/performance.md
    const double semi_axes = (track.has_supports() ? 12. : 2.5) * std::pow(general.density_scale, 0.25);
    return mesh.window_length > 0. ? mesh.window_length : semi_axes * hertz(*this, static_load()).semi_axis_x;
  }


  std::vector<Scene::Range> Scene::windows() const
  {
    const double begin = path_begin(), end = begin + motion.rolled_distance;
    if (!has_window())
      return {{begin, end}};
    const double        usual = usual_window();
    std::vector<double> stretches{begin};
    if (has_cubes())
      {
        // A window ends some steps behind its border, and then the tread of the next is a little further on.
        constexpr double least = 1. / 3.; // of a usual window, which a change is worth
        const double     away  = window_margin() + mesh.finest_cell;
        for (const double border : {cubes().begin - away, cubes().end + away})
          if (border >= stretches.back() + least * usual && border <= end - least * usual)
            stretches.push_back(border);
      }
    stretches.push_back(end);

    std::vector<Range> list;
    for (std::size_t k = 0; k + 1 < stretches.size(); ++k)
      {
        constexpr double   tiny = 1e-9; // of a window
        const double       from = stretches[k], length = stretches[k + 1] - from;
        const unsigned int n = std::max(1., mesh.window_length > 0. ? std::ceil(length / usual - tiny)
                                                                    : std::round(length / usual));
        for (unsigned int i = 0; i < n; ++i)
          list.push_back({from + length * i / n, i + 1 < n ? from + length * (i + 1) / n : stretches[k + 1]});
      }
    return list;
  }


  double Scene::window_margin() const
  {
    // Forces then differ by 0.06 % at most from those with all cells fine; with 3 semi-axes by 0.05 %.
    constexpr double semi_axes = 1.75, cells = 2.;
    return mesh.window_margin > 0.
             ? mesh.window_margin
             : semi_axes * hertz(*this, static_load()).semi_axis_x + cells * mesh.finest_cell;
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


  double Scene::path_y() const
  {
    const double cell = mesh.finest_cell, y = first_contact().y;
    return y + cell * std::trunc((0.5 * (patch_extent().begin + patch_extent().end) - y) / cell);
  }


  Scene::Range Scene::peak_range() const
  {
    if (peak_stress.place == PeakPlace::range)
      return {peak_stress.from, peak_stress.to};
    const double length = shapes->defect ? shapes->defect->length : defect.length;
    require(length > 0.,
            "'Peak stress/Region' trailing edge needs a defect, or its 'Defect/Length (mm)' where "
            "'Defect/Shape' is none");
    const double edge = defect.position + length;
    return {edge - 0.5 * length, edge + hertz(*this, static_load()).semi_axis_x};
  }


  double Scene::peak_half_width() const
  {
    if (peak_stress.half_width > 0.)
      return peak_stress.half_width;
    const double of_patch = hertz(*this, static_load()).semi_axis_y;
    if (peak_stress.place != PeakPlace::trailing_edge || (shapes->defect && defect.shape != "dip"))
      return of_patch;
    // To where the edge of a round defect runs along the path as much as across. Beyond, it is rounded over
    // less and less of its own direction: at the sides it is sharp, and elasticity has no limit there.
    const double width = defect.width > 0. ? defect.width : defect.length;
    return std::min(of_patch, 0.5 * width * std::sqrt(0.5));
  }


  double Scene::factor_across(const Vector3 &place) const
  {
    constexpr double step = 50e-6; // m
    if (!is_positioned())
      {
        const auto &top = surfaces().rail_top;
        return contact.factor_across(place[1],
                                     std::atan2(top(place[1] + step) - top(place[1] - step), 2. * step));
      }
    const WheelOnRail &in_track = placed_wheel().surfaces;
    const auto        &rail     = in_track.rail();
    const double       y        = std::clamp(place[1] + in_track.rail_origin_y(), rail.begin(), rail.end());
    return contact.factor_across(y - in_track.rail_origin_y(), std::atan(rail.slope(y)));
  }


  double Scene::mean_factor_across() const
  {
    double     sum = 0., weights = 0.;
    const auto add = [&](const double y, const double weight) {
      sum += weight * factor_across(Vector3{0., y, 0., 0.});
      weights += weight;
    };
    if (is_positioned())
      for (const WheelPatch &patch : placed_wheel().patches())
        for (const PatchNode &node : elements_in_contact(patch))
          add(patch.region.reference[1] + std::cos(patch.angle()) * node.position[1] -
                placed_wheel().surfaces.rail_origin_y(),
              node.pressure);
    else
      {
        // Hertz's pressure, summed along the rail.
        constexpr int n = 50;
        for (int k = -n; k <= n; ++k)
          {
            const double part = (k + 0.) / (n + 1);
            add(0.5 * ((1. - part) * patch_extent().begin + (1. + part) * patch_extent().end),
                1. - part * part);
          }
      }
    return sum / weights;
  }


  double Scene::depth_in_rail(const dealii::Point<3> &p) const
  {
    if (is_positioned())
      return placed_wheel().place_in_rail(p).below;
    const auto &height = surfaces().defect;
    return surfaces().rail_top(p[1]) + (height ? height(p[0], p[1]) : 0.) - p[2];
  }


  std::vector<dealii::Point<3>> Scene::recorded_cells() const
  {
    std::vector<dealii::Point<3>> points;
    for (const std::string &text : dealii::Utilities::split_string_list(output.cells, ';'))
      {
        std::vector<double> values;
        try
          {
            values = dealii::Utilities::string_to_double(dealii::Utilities::split_string_list(text));
          }
        catch (const dealii::ExceptionBase &)
          {
            values.clear();
          }
        require(values.size() == 3 && values[2] > 0. &&
                  std::all_of(values.begin(), values.end(),
                              [](const double value) { return std::isfinite(value); }),
                "'Output/Cells' cannot be '" + text +
                  "'; allowed: x,y,depth in mm, depth above 0, entries separated by semicolons");
        const double     depth = 1e-3 * values[2];
        dealii::Point<3> place(1e-3 * values[0], 1e-3 * values[1], 0.);
        // Below a wheelset in a position depth is measured across the plane of contact, which may be steep.
        constexpr unsigned int most_steps = 60;
        constexpr double       close      = 1e-9; // m
        for (unsigned int step = 0; step < most_steps; ++step)
          {
            const double up = depth_in_rail(place) - depth;
            place[2] += up;
            if (std::abs(up) < close)
              break;
          }
        points.push_back(place);
      }
    return points;
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
    if (wheelset.both_wheels) // which have different ones
      return wheel.radius;
    if (is_positioned())
      return placed_wheel().main_patch().rolling_radius;
    const auto &offset = surfaces().tread_offset;
    return wheel.radius + (offset ? offset(first_contact().y) : 0.);
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
