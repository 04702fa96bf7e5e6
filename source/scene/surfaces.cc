// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/wheel_tread.h>
#include <tread/mesh/rail_body.h>
#include <tread/reference/half_space.h>
#include <tread/reference/hertz.h>
#include <tread/scene/scene.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace tread
{
  namespace
  {
    std::string number(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }

    void require(const bool holds, const std::string &line)
    {
      if (!holds)
        throw SceneError(line);
    }

    /// A number of mm, or what takes the place of "automatic".
    double place(const std::string &text, const double automatic, const std::string &name)
    {
      if (text == "automatic")
        return automatic;
      try
        {
          const double value = dealii::Utilities::string_to_double(text);
          if (std::abs(value) <= 1e5)
            return value;
        }
      catch (const dealii::ExceptionBase &)
        {
        }
      throw SceneError("'" + name + "' cannot be '" + text +
                       "'; allowed: 'automatic' or a number from -1e5 to 1e5");
    }

    /// A measured running surface is needed, and contact is looked for, up to here on each side (m).
    constexpr double running_half_width = 25e-3;
  } // namespace


  void Scene::declare_defect()
  {
    using dealii::Patterns::Double;
    using dealii::Patterns::Selection;
    dealii::ParameterHandler &prm = handler;
    prm.enter_subsection("Defect");
    prm.add_parameter(
      "Shape", defect_shape,
      "none: smooth. dip: of Length, Width and Depth, a sphere's cap where length and width are equal. "
      "profile: along the path as in Profile file, across as Lateral law says.",
      Selection("none|dip|profile"));
    prm.add_parameter(
      "Position (mm)", defect_position_mm,
      "x of the leading edge. Where the wheel starts and ends: 'Motion/Start' and 'Rolled distance'.",
      Double(-1e5, 1e5));
    prm.add_parameter("Length (mm)", defect_length_mm,
                      "Along the rail. A profile is stretched to it; 0: as in the file.", Double(0., 1e4));
    prm.add_parameter("Width (mm)", defect_width_mm, "Lateral. 0: as long as it is wide, for a dip.",
                      Double(0., 200.));
    prm.add_parameter("Depth (mm)", defect_depth_mm,
                      "Of the deepest point. A profile is scaled to it; 0: as in the file.", Double(0., 10.));
    prm.add_parameter("Lateral position (mm)", defect_lateral_mm,
                      "y of its middle, along the rail's top; the gauge side is y < 0.", Double(-50., 50.));
    prm.add_parameter("Rounded leading edge (mm)", leading_rounding_mm,
                      "Of a dip: the kink at its beginning is rounded over so much of the path. 0: sharp.",
                      Double(0., 1000.));
    prm.add_parameter("Rounded trailing edge (mm)", trailing_rounding_mm, "The same at its end.",
                      Double(0., 1000.));
    prm.add_parameter(
      "Profile file", defect_file,
      "Columns x and z in mm, z up; depth is counted from the straight line between the ends. Looked for in "
      "the present folder and beside the parameter file.",
      dealii::Patterns::Anything());
    prm.add_parameter(
      "Lateral law", defect_lateral_law,
      "Of a profile. parabola: 1 - (2 y / Width)^2 of the depth. uniform: the whole head, as at "
      "a weld.",
      Selection("parabola|uniform"));
    prm.add_parameter("Reversed", defect_reversed, "A profile is rolled over from its other end.");
    prm.leave_subsection();
  }


  std::string Scene::located(const std::string &file) const
  {
    return !std::filesystem::exists(file) && std::filesystem::exists(folder / file) ? (folder / file).string()
                                                                                    : file;
  }


  void Scene::make_shapes()
  {
    auto         made      = std::make_shared<Shapes>();
    const double start_mm  = place(starts_at, -rolled_mm, "Motion/Start (mm)");
    const double margin_mm = rail_length_mm > 0. ? 0.5 * (rail_length_mm - rolled_mm) : rail_margin_mm;
    made->path_begin       = 1e-3 * start_mm;
    made->path_end         = 1e-3 * (start_mm + rolled_mm);
    made->rail_begin       = 1e-3 * place(rail_begins_at, start_mm - margin_mm, "Rail/Begin (mm)");
    made->defect           = make_defect();

    RunningSurfaces &surfaces = made->surfaces;
    surfaces.radius           = 1e-3 * radius_mm;
    surfaces.half_width       = running_half_width;
    std::function<double(double)> height; // over the profile, along its own vertical
    try
      {
        if (const auto offset =
              tread_offset(located(tread), running_half_width + 1e-3 * std::abs(lateral_position_mm)))
          surfaces.tread_offset = [offset, y_circle = 1e-3 * lateral_position_mm](const double y) {
            return offset(y - y_circle);
          };
      }
    catch (const std::runtime_error &error)
      {
        throw SceneError("'Wheel/Tread profile': " + std::string(error.what()) +
                         "; allowed: cylinder, cone 1:40, cone 1:20, S1002 or a file");
      }

    if (rail_shape == "block")
      {
        surfaces.half_width = std::min(running_half_width, 0.499e-3 * block_width_mm);
        surfaces.rail_top   = [radius = 1e-3 * crown_radius_mm](const double y) {
          return crown_height(y, radius);
        };
      }
    else
      {
        const RailProfile rail    = rail_profile();
        const double      edge    = 0.999 * rail.head_half_width();
        const auto        nominal = [rail, edge](const double y) {
          const double on_head = std::clamp(y, -edge, edge);
          return rail.z_top(on_head) - std::abs(y - on_head);
        };
        if (!measured_head.empty())
          try
            {
              const MeasuredLine line = read_rail_head(located(measured_head), running_half_width);
              // Beside the measured part the difference fades out over 5 mm.
              height = [line, nominal, edge](const double y) {
                const double measured =
                  std::clamp(y, std::max(line.begin(), -edge), std::min(line.end(), edge));
                const double fade = std::max(0., 1. - std::abs(y - measured) / 5e-3);
                return fade * (line(measured) - nominal(measured));
              };
            }
          catch (const std::runtime_error &error)
            {
              throw SceneError("'Rail/Measured head': " + std::string(error.what()));
            }
        const auto own = [nominal, height](const double y) {
          return nominal(y) + (height ? height(y) : 0.);
        };
        if (const double angle = inclination(); angle == 0.)
          surfaces.rail_top = own;
        else
          surfaces.rail_top = [own, angle](const double y) {
            return turned_line(own, angle, y);
          };
      }

    if (made->defect)
      surfaces.defect = [defect = *made->defect](const double x, const double y) {
        return defect.height(x, y);
      };
    if (height || made->defect)
      made->rail_height = [height, defect = surfaces.defect](const double x, const double y) {
        return (height ? height(y) : 0.) + (defect ? defect(x, y) : 0.);
      };
    made->contact = tread::first_contact(surfaces, made->path_begin);
    shapes        = made;
    made->patch   = patch_under_load();
  }


  Scene::PatchExtent Scene::patch_under_load() const
  {
    const double y = first_contact().y, load = static_load();
    if (load <= 0.)
      return {y, y};
    const ElasticMaterial         wheel = wheel_material.si(), rail = rail_material.si();
    const reference::ElasticPair  pair   = reference::combine({wheel.young_modulus, wheel.poisson_ratio},
                                                              {rail.young_modulus, rail.poisson_ratio});
    const double                  radius = rolling_radius();
    const reference::HertzEllipse hertz =
      reference::hertz_ellipse(0.5 / radius, 0.5 / lateral_radius(), pair.hertz_modulus(), load);

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
    return 1.1 * std::max(patch_extent().end - path_y(), path_y() - patch_extent().begin) + 1e-3 * finest_mm;
  }


  double Scene::fine_half_width() const
  {
    // A load that doubles or triples makes the patch wider by its cube root.
    constexpr double room_for_dynamic_load = 1.35;
    return fine_half_width_mm > 0. ? 1e-3 * fine_half_width_mm
                                   : (quasi_static ? 1. : room_for_dynamic_load) * needed_half_width();
  }


  double Scene::path_y() const
  {
    const double cell = 1e-3 * finest_mm, y = first_contact().y;
    return y + cell * std::trunc((0.5 * (patch_extent().begin + patch_extent().end) - y) / cell);
  }


  double Scene::depth_in_rail(const dealii::Point<3> &p) const
  {
    const auto &height = surfaces().defect;
    return surfaces().rail_top(p[1]) + (height ? height(p[0], p[1]) : 0.) - p[2];
  }


  std::vector<dealii::Point<3>> Scene::recorded_cells() const
  {
    std::vector<dealii::Point<3>> points;
    for (const std::string &text : dealii::Utilities::split_string_list(cells, ';'))
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
        require(values.size() == 3 && values[2] > 0.,
                "'Output/Cells' cannot be '" + text +
                  "'; allowed: x,y,depth in mm, depth above 0, entries separated by semicolons");
        const dealii::Point<3> at_top(1e-3 * values[0], 1e-3 * values[1], 0.);
        points.emplace_back(at_top[0], at_top[1], depth_in_rail(at_top) - 1e-3 * values[2]);
      }
    return points;
  }


  std::shared_ptr<const Defect> Scene::make_defect() const
  {
    if (defect_shape == "none")
      return nullptr;
    auto defect = std::make_shared<Defect>();
    if (defect_shape == "dip")
      {
        require(defect_length_mm > 0. && defect_depth_mm > 0.,
                "a dip needs 'Defect/Length (mm)' and 'Defect/Depth (mm)' above 0");
        require(!defect_reversed,
                "'Defect/Reversed' is for 'Defect/Shape' profile; a dip is rolled over from its other "
                "end with its rounded edges exchanged");
        defect->width             = 1e-3 * (defect_width_mm > 0. ? defect_width_mm : defect_length_mm);
        defect->leading_rounding  = 1e-3 * leading_rounding_mm;
        defect->trailing_rounding = 1e-3 * trailing_rounding_mm;
        require(std::max(leading_rounding_mm, trailing_rounding_mm) <= 0.5 * defect_length_mm,
                "'Defect/Rounded leading edge (mm)' and 'Rounded trailing edge (mm)' must be at most half of "
                "'Defect/Length (mm)', " +
                  number(0.5 * defect_length_mm));
      }
    else
      {
        require(!defect_file.empty(), "'Defect/Shape' profile needs 'Defect/Profile file'");
        try
          {
            *defect = defect_along(read_longitudinal_profile(located(defect_file)), defect_reversed);
          }
        catch (const std::runtime_error &error)
          {
            throw SceneError("'Defect/Profile file': " + std::string(error.what()));
          }
        const bool uniform = defect_lateral_law == "uniform";
        require(uniform || defect_width_mm > 0.,
                "'Defect/Width (mm)' must be above 0 for a profile with 'Lateral law' parabola");
        defect->width = uniform ? std::numeric_limits<double>::infinity() : 1e-3 * defect_width_mm;
      }
    if (defect_length_mm > 0.)
      defect->length = 1e-3 * defect_length_mm;
    if (defect_depth_mm > 0.)
      defect->depth = 1e-3 * defect_depth_mm;
    defect->begin    = 1e-3 * defect_position_mm;
    defect->y_middle = 1e-3 * defect_lateral_mm;
    return defect;
  }


  void Scene::check_surfaces() const
  {
    require(rail_shape != "block" || (rail_inclination == "none" && measured_head.empty()),
            "'Rail/Inclination' and 'Rail/Measured head' are for 'Rail/Shape' head or full section");
    const double from_mm = 1e3 * path_begin() - rail_margin_mm, to_mm = 1e3 * path_end() + rail_margin_mm,
                 round_off_mm = 1e-6;
    require(1e3 * rail_begin() <= from_mm + round_off_mm && 1e3 * rail_end() >= to_mm - round_off_mm,
            "the rail, by 'Rail/Begin (mm)' and 'Length (mm)' from " + number(1e3 * rail_begin()) + " to " +
              number(1e3 * rail_end()) +
              " mm, must hold the path and 'Rail/Margin (mm)' at both ends, from " + number(from_mm) +
              " to " + number(to_mm) + " mm");

    if (defect())
      {
        const double end_mm = 1e3 * (defect()->begin + defect()->length);
        require(defect()->begin >= rail_begin() && end_mm <= 1e3 * rail_end(),
                "the defect, from 'Defect/Position (mm)' " + number(defect_position_mm) + " to " +
                  number(end_mm) + " mm, lies outside the rail, which is from " + number(1e3 * rail_begin()) +
                  " to " + number(1e3 * rail_end()) + " mm");
        const std::string of_width = defect_width_mm > 0. ? "'Defect/Width (mm)'" : "'Defect/Length (mm)'";
        for (const auto &[name, size] :
             std::vector<std::pair<std::string, double>>{{"'Defect/Length (mm)'", defect()->length},
                                                         {of_width, defect()->width}})
          require(1e3 * size >= finest_mm,
                  name + " " + number(1e3 * size) +
                    " is lost between the nodes; at least 'Mesh/Finest cell (mm)', " + number(finest_mm));
        const double head_mm = rail_shape == "block"
                                 ? 0.5 * block_width_mm
                                 : 1e3 * rail_profile().head_point(rail_profile().shoulder_length())[0];
        const double edge_mm =
          std::isinf(defect()->width) ? 0. : std::abs(defect_lateral_mm) + 0.5e3 * defect()->width;
        require(edge_mm <= head_mm, "the defect reaches to " + number(edge_mm) +
                                      " mm beside the rail's middle and the top of the head only to " +
                                      number(head_mm) +
                                      " mm: lower 'Defect/Width (mm)' or 'Lateral position (mm)'");
      }

    require(
      std::abs(first_contact().y) < 0.99 * surfaces().half_width,
      "wheel and rail touch at y = " + number(1e3 * first_contact().y) +
        " mm, beside the running surface: change 'Wheel/Tread profile', 'Wheel/Lateral position (mm)' or "
        "'Rail/Inclination'");
    if (rail_shape != "block")
      {
        const double reach_mm = 1e3 * rail_profile().head_point(RailHead().contact_half_width)[0];
        require(1e3 * std::max(-patch_extent().begin, patch_extent().end) + finest_mm <= reach_mm,
                "the patch under the static load, from y = " + number(1e3 * patch_extent().begin) + " to " +
                  number(1e3 * patch_extent().end) +
                  " mm, leaves what of the rail is meshed for contact, up to " + number(reach_mm) +
                  " mm from the middle: change 'Wheel/Tread profile', 'Wheel/Lateral position (mm)' or "
                  "'Rail/Inclination'");
      }
    recorded_cells();
    require(fine_from_mm <= fine_to_mm, "'Mesh/Fine from (mm)' must be below 'Mesh/Fine to (mm)'");
    require(fine_from_mm == fine_to_mm || (defect_position_mm + fine_from_mm < 1e3 * rail_end() &&
                                           defect_position_mm + fine_to_mm > 1e3 * rail_begin()),
            "'Mesh/Fine from (mm)' to 'Fine to (mm)', from the defect's leading edge at " +
              number(defect_position_mm) + " mm, must lie on the rail from " + number(1e3 * rail_begin()) +
              " to " + number(1e3 * rail_end()) + " mm at least in part");
    require(path_cell_mm == 0. || path_cell_mm >= finest_mm, "'Mesh/Path cell (mm)' " + number(path_cell_mm) +
                                                               " must be at least 'Mesh/Finest cell (mm)' " +
                                                               number(finest_mm) + ", or 0 for the same");
    require(path_cell_mm <= finest_mm || fine_from_mm < fine_to_mm,
            "'Mesh/Path cell (mm)' needs 'Mesh/Fine from (mm)' and 'Fine to (mm)'");
  }


  RailProfile Scene::rail_profile() const
  {
    return profile == "54E1" ? RailProfile::rail_54e1() : RailProfile::rail_60e1();
  }


  double Scene::rail_end() const
  {
    return rail_length_mm > 0. ? rail_begin() + 1e-3 * rail_length_mm : path_end() + 1e-3 * rail_margin_mm;
  }


  double Scene::inclination() const
  {
    return rail_inclination == "1:40"   ? std::atan(1. / 40.)
           : rail_inclination == "1:20" ? std::atan(1. / 20.)
                                        : 0.;
  }


  dealii::Point<3> Scene::in_rail_axes(const dealii::Point<3> &p) const
  {
    const double c = std::cos(inclination()), s = std::sin(inclination());
    return {p[0], c * p[1] + s * p[2], -s * p[1] + c * p[2]};
  }


  double Scene::rolling_radius() const
  {
    const auto &offset = surfaces().tread_offset;
    return 1e-3 * radius_mm + (offset ? offset(first_contact().y) : 0.);
  }


  double Scene::lateral_radius() const
  {
    if (!surfaces().tread_offset && inclination() == 0. && measured_head.empty())
      return rail_shape == "block" ? 1e-3 * crown_radius_mm : rail_profile().crown_radius();
    return std::min(first_contact().lateral_radius, 10.);
  }
} // namespace tread
