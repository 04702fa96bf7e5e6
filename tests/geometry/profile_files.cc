// SPDX-License-Identifier: LGPL-2.1-or-later
// Files of profiles as instruments, spreadsheets and other programs write them, drawn by a rule from eight
// shapes: each is read as the shape it was made from, refused by its cause, or read with words about what is
// wrong with it. None is silently another profile.
#include <tread/geometry/measured_line.h>
#include <tread/geometry/profile_curve.h>
#include <tread/geometry/rail_profile.h>
#include <tread/geometry/running_surfaces.h>
#include <tread/geometry/smoothing_spline.h>
#include <tread/reference/elastic.h>
#include <tread/reference/half_space.h>
#include <tread/reference/hertz.h>
#include <tread/reference/influence.h>

#include "check.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

using namespace tread;

namespace geometry_profile_files
{
  using Point = dealii::Point<2>;
  using Curve = std::vector<Point>; ///< mm, from low to high y, z up, the flange at y < 0

  constexpr double half_width = 25e-3, load = 80e3, radius = 0.46; // m, N, m

  /// The same draws on every system.
  class Draw
  {
  public:
    explicit Draw(const std::uint64_t seed)
      : engine(seed)
    {
    }
    unsigned int below(const unsigned int n)
    {
      return engine() % n;
    }
    bool one_in(const unsigned int n)
    {
      return below(n) == 0;
    }
    double uniform(const double from = 0., const double to = 1.)
    {
      return from + (to - from) * ((engine() >> 11) * 0x1p-53);
    }
    double normal()
    {
      return std::sqrt(-2. * std::log(1. - uniform())) * std::cos(2. * std::numbers::pi * uniform());
    }
    template <typename T>
    T of(const std::vector<T> &list)
    {
      return list[below(list.size())];
    }

  private:
    std::mt19937_64 engine;
  };


  // Shapes

  Curve rail_points(const RailProfile &profile, const double spacing)
  {
    Curve        points;
    const double length = profile.head_length();
    const int    n      = static_cast<int>(1e3 * length / spacing);
    for (int i = -n; i <= n; ++i)
      points.push_back(Point(1e3 * profile.head_point(i * length / n * (1. - 1e-12))));
    return points;
  }

  /// From the back of the flange to the end of the tread.
  Curve wheel_points(const std::string &name, const double spacing)
  {
    const ProfileCurve curve = wheel_curve(name);
    Curve              points;
    const int          n = static_cast<int>(1e3 * curve.length() / spacing);
    for (int i = 0; i <= n; ++i)
      if (const auto p = curve.at(i * curve.length() / n); p.y > -66e-3)
        points.emplace_back(1e3 * p.y, 1e3 * p.z);
    return points;
  }

  /// Wear of a shape: a hollow of so many mm around y, whose width is that at which 1/e is left.
  Curve worn(Curve points, const double depth, const double y, const double width)
  {
    for (Point &p : points)
      p[1] += depth * std::exp(-(p[0] - y) * (p[0] - y) / (width * width));
    return points;
  }

  struct Shape
  {
    std::string name;
    bool        is_wheel;
    Curve (*points)(double spacing);
  };

  const std::vector<Shape> shapes{{"60E1", false,
                                   [](const double d) {
                                     return rail_points(RailProfile::rail_60e1(), d);
                                   }},
                                  {"54E1", false,
                                   [](const double d) {
                                     return rail_points(RailProfile::rail_54e1(), d);
                                   }},
                                  {"60E1, worn flat", false,
                                   [](const double d) {
                                     return worn(rail_points(RailProfile::rail_60e1(), d), -0.4, -2., 12.);
                                   }},
                                  {"54E1, worn at the gauge corner", false,
                                   [](const double d) {
                                     return worn(rail_points(RailProfile::rail_54e1(), d), -1.2, -26., 12.);
                                   }},
                                  {"S1002", true,
                                   [](const double d) {
                                     return wheel_points("S1002", d);
                                   }},
                                  {"S1002, worn hollow", true,
                                   [](const double d) {
                                     return worn(wheel_points("S1002", d), 0.5, 4., 16.);
                                   }},
                                  {"cone 1:20", true,
                                   [](const double d) {
                                     return wheel_points("cone 1:20", d);
                                   }},
                                  {"cone 1:40, worn", true, [](const double d) {
                                     return worn(wheel_points("cone 1:40", d), 0.3, -8., 14.);
                                   }}};


  // What half-space theory says of a profile on a standard partner

  struct Answer
  {
    double y, pressure; ///< mm, Pa
  };

  Answer answer(const bool is_wheel, const MeasuredLine &line)
  {
    RunningSurfaces surfaces;
    surfaces.radius     = radius;
    surfaces.half_width = half_width;
    if (is_wheel)
      {
        static const RailProfile rail = RailProfile::rail_60e1();
        surfaces.tread_offset         = [line](const double y) {
          return -line(y);
        };
        surfaces.rail_top = [](const double y) {
          return turned_line([](const double z) { return rail.z_top(z); }, 1. / 40., y);
        };
      }
    else
      {
        surfaces.tread_offset = [](const double y) {
          return -y / 40.;
        };
        surfaces.rail_top = [line](const double y) {
          return line(y);
        };
      }
    const FirstContact           first = first_contact(surfaces, 0.);
    const reference::ElasticPair pair  = reference::combine({}, {});
    reference::Grid              grid;
    grid.n_x     = 31;
    grid.n_y     = 61;
    grid.dx      = 0.7e-3;
    grid.dy      = 0.45e-3;
    grid.x_first = -15. * grid.dx;
    grid.y_first = -30. * grid.dy;
    reference::NormalProblem problem;
    problem.force     = load;
    problem.tolerance = 1e-5;
    for (unsigned int j = 0; j < grid.n_y; ++j)
      for (unsigned int i = 0; i < grid.n_x; ++i)
        {
          const double y = first.y + grid.y(j);
          // Beside what is known nothing touches.
          problem.gap.push_back(0.5 * grid.x(i) * grid.x(i) / radius +
                                (std::abs(y) < half_width ? surfaces.gap(y) - surfaces.gap(first.y) : 1e-3));
          problem.initial_pressure.push_back(
            std::abs(grid.x(i)) < 6e-3 && std::abs(grid.y(j)) < 5e-3 && std::abs(y) < half_width ? 1e9 : 0.);
        }
    const reference::FourierGrid    fourier(grid);
    const reference::NormalSolution solution =
      reference::solve_normal(fourier, reference::NormalOperator(fourier, pair), problem);
    return {1e3 * first.y, *std::max_element(solution.pressure.begin(), solution.pressure.end())};
  }

  /// A shape without a file: the line through its points within 28 mm of y = 0.
  MeasuredLine line_of(const Curve &points, const bool is_wheel)
  {
    std::vector<double> y, z;
    double              top = -1e300;
    for (const Point &p : points)
      if (std::abs(p[0]) < 28.)
        {
          y.push_back(1e-3 * p[0]);
          z.push_back(1e-3 * p[1]);
          if (std::abs(p[0]) <= 20.)
            top = std::max(top, z.back());
        }
    const double level = is_wheel ? MeasuredLine(y, z)(0.) : top;
    for (double &height : z)
      height -= level;
    return MeasuredLine(y, z);
  }

  Answer answer_of_file(const bool is_wheel, const std::string &file, const ProfilePlacement &placement = {})
  {
    return answer(is_wheel, is_wheel ? read_wheel_tread(file, half_width, placement)
                                     : read_rail_head(file, half_width, half_width, placement));
  }


  // Files

  struct File
  {
    std::string              name, text; ///< text: bytes
    std::vector<std::string> faults;     ///< what may be refused or must be named, by the words that do so
    std::string              about;
    bool is_rounded = false; ///< to 0.1 um, as many are: that is part of what was measured
  };

  std::string number(const double value, const int digits, const char decimal, const bool plus)
  {
    char text[40];
    std::snprintf(text, sizeof text, plus ? "%+.*f" : "%.*f", digits, value);
    std::string result = text;
    std::replace(result.begin(), result.end(), '.', decimal);
    return result;
  }

  std::string encoded(const std::string &text, const std::string &encoding)
  {
    if (encoding == "UTF-8")
      return text;
    if (encoding == "UTF-8 with a mark")
      return "\xEF\xBB\xBF" + text;
    const bool  little = encoding.find("little") != encoding.npos;
    std::string bytes  = encoding.find("mark") == encoding.npos ? "" : little ? "\xFF\xFE" : "\xFE\xFF";
    for (const char c : text)
      bytes += little ? std::string{c, '\0'} : std::string{'\0', c};
    return bytes;
  }

  /// One file, drawn.
  File draw_file(Draw &draw, const Shape &shape, Curve points, const double spacing)
  {
    File       file;
    const auto note = [&](const std::string &what) {
      file.about += (file.about.empty() ? "" : ", ") + what;
    };
    const auto fault = [&](const std::string &what, const std::vector<std::string> &words) {
      note(what);
      file.faults.insert(file.faults.end(), words.begin(), words.end());
    };
    const std::string format = draw.of<std::string>({"table", "table", "MiniProf", "Simpack"});
    note(format);

    // What was measured of the body.
    bool has_flange = shape.is_wheel;
    if (shape.is_wheel)
      {
        const auto tip = std::min_element(points.begin(), points.end(),
                                          [](const Point &a, const Point &b) { return a[1] < b[1]; });
        switch (draw.below(6))
          {
          case 0:
            note("up to the flange's tip");
            points.erase(points.begin(), tip - std::min<std::ptrdiff_t>(tip - points.begin(), 4. / spacing));
            break;
          case 1:
            {
              const double depth = draw.uniform(4., 24.);
              points.erase(points.begin(),
                           std::find_if(tip, points.end(), [&](const Point &p) { return p[1] > -depth; }));
              fault("flank cut at " + std::to_string(depth) + " mm", {"no flange"});
              has_flange = false;
              break;
            }
          case 2:
            points.erase(points.begin(),
                         std::find_if(tip, points.end(), [](const Point &p) { return p[0] > -30.; }));
            fault("no flange", {"no flange"});
            has_flange = false;
            break;
          default:
            break;
          }
        if (draw.one_in(3))
          {
            const double height = draw.uniform(3., 40.), from = points.back()[1];
            for (double z = spacing; z < height; z += spacing)
              points.emplace_back(points.back()[0] + 0.02 * spacing, from + z);
            note("face of the rim, " + std::to_string(height) + " mm");
          }
      }

    // What the instrument did.
    if (draw.one_in(4))
      {
        const double noise = draw.of<double>({0.3e-3, 1e-3, 3e-3, 10e-3});
        for (Point &p : points)
          p += Point(0.2 * noise * draw.normal(), noise * draw.normal());
        fault("noise of " + std::to_string(1e3 * noise) + " um",
              {"noise", "back on the line", "spike", "turns back"});
      }
    if (draw.one_in(8))
      {
        const double      size = 0.02 * std::pow(100., draw.uniform()) * (draw.one_in(2) ? 1. : -1.);
        const std::size_t at = draw.below(points.size() - 3) + 1, width = draw.below(2) + 1;
        const Point       along  = Point(points[at + 1] - points[at - 1]);
        const double      length = std::hypot(along[0], along[1]);
        for (std::size_t i = at; i < at + width; ++i)
          points[i] += Point(-size * along[1] / length, size * along[0] / length);
        fault("spike of " + std::to_string(size) + " mm at y = " + std::to_string(points[at][0]),
              {"spike", "back on the line", "turns back", "above the top", "gap", "noise"});
      }
    if (draw.one_in(10))
      {
        const double      size  = 0.005 * std::pow(60., draw.uniform());
        const std::size_t at    = draw.below(points.size() - 6) + 3;
        const Point       along = Point(points[at + 1] - points[at]);
        points[at + 1] = points[at] - size / std::hypot(along[0], along[1]) * dealii::Tensor<1, 2>(along);
        fault("a point " + std::to_string(size) + " mm back at y = " + std::to_string(points[at][0]),
              {"back on the line", "turns back", "gap", "spike"});
      }
    if (draw.one_in(16))
      {
        const double from = draw.uniform(-24., 14.);
        points.erase(std::remove_if(points.begin(), points.end(),
                                    [&](const Point &p) { return p[0] > from && p[0] < from + 8.; }),
                     points.end());
        fault("8 mm missing from y = " + std::to_string(from), {"gap"});
      }

    // How the file counts.
    const bool down     = draw.one_in(2) && (!shape.is_wheel || has_flange),
               mirrored = draw.one_in(2) && has_flange;
    for (Point &p : points)
      p = Point(mirrored ? -p[0] : p[0], down ? -p[1] : p[1]);
    if (down)
      note("z down");
    if (mirrored)
      note("flange at y > 0");
    if (draw.one_in(2))
      std::reverse(points.begin(), points.end());
    double      y_unit = 1., z_unit = 1.;
    std::string simpack;
    if (format == "Simpack")
      {
        // What its header does is undone in the points: units, mirror, bounds, rotation, shift.
        const auto [name, per_metre] = draw.of<std::pair<std::string, double>>(
          {{"mm", 1e3}, {"m", 1.}, {"cm", 1e2}, {"inch", 1. / 0.0254}});
        const bool   flip_y = draw.one_in(2), flip_z = draw.one_in(2), clip = draw.one_in(3);
        const double angle = draw.one_in(2) ? draw.uniform(-0.3, 0.3) : 0., shift_y = draw.uniform(-30., 30.),
                     shift_z = draw.uniform(-30., 30.);
        Curve  raw;
        double least = 1e300, most = -1e300;
        for (const Point &p : points)
          {
            raw.emplace_back(flip_y ? -p[0] : p[0], flip_z ? -p[1] : p[1]);
            least = std::min(least, raw.back()[0]);
            most  = std::max(most, raw.back()[0]);
          }
        if (clip) // debris beyond the bounds
          {
            raw.emplace_back(most + 3., raw.back()[1] + 8.);
            raw.insert(raw.begin(), Point(least - 2., raw.front()[1] - 5.));
          }
        for (Point &p : raw)
          {
            const Point q(std::cos(angle) * p[0] + std::sin(angle) * p[1],
                          -std::sin(angle) * p[0] + std::cos(angle) * p[1]);
            p = Point(q[0] - shift_y, q[1] - shift_z);
          }
        const double f = 1e-3 * per_metre;
        char         text[800];
        std::snprintf(
          text, sizeof text,
          "header.begin\n  version = 1\n  type = %d ! 0=rail, 1=wheel\nheader.end\nspline.begin\n"
          "  approx.smooth = 0.0\n  comment = 'made!'\n  point.dist.min = 0.0\n  shift.y = %.12g\n  shift.z "
          "= %.12g\n  rotate = %.12g\n  bound.y.min = %.12g\n  bound.y.max = %.12g\n  bound.z.min = 1\n  "
          "bound.z.max = 0\n  mirror.y = %d\n  mirror.z = %d\n  inversion = 0\n  units.len = '%s'\n  "
          "units.len.f = %.12g\n  units.ang.f = 57.29577951308232\n  point.begin\n",
          shape.is_wheel ? 1 : 0, f * shift_y, f * shift_z, 57.29577951308232 * angle,
          clip ? f * (least - 1e-3) : 1., clip ? f * (most + 1e-3) : 0., flip_y, flip_z, name.c_str(),
          per_metre);
        simpack = text;
        points  = raw;
        y_unit = z_unit = f;
        note("header in " + name + (clip ? ", clipped" : "") + (flip_y ? ", mirror.y" : "") +
             (angle != 0. ? ", rotate" : ""));
      }
    if (format != "Simpack" && draw.one_in(8))
      {
        const auto [name, factor] = draw.of<std::pair<std::string, double>>(
          {{"um", 1e3}, {"m", 1e-3}, {"inch", 1. / 25.4}, {"cm", 0.1}});
        const bool only_heights = (name == "um" || name == "m") && draw.one_in(2);
        z_unit                  = factor;
        y_unit                  = only_heights ? 1. : factor;
        fault((only_heights ? "heights in " : "all in ") + name,
              {"are its lengths in", "are they in", "in another unit", "further away", "wide, more than",
               "or are heights"});
      }

    // How it is written.
    const std::string separator = draw.of<std::string>({" ", "\t", ",", ";", ", ", "; ", "   "});
    const bool        quotes    = draw.one_in(10) && format != "Simpack";
    const char        decimal   = separator.front() == ',' && !quotes
                                    ? (draw.one_in(6) && separator == "," ? ',' : '.')
                                  : draw.one_in(2) ? ','
                                                   : '.';
    if (decimal == ',' && separator == "," && !quotes)
      fault("commas for decimals and between", {"decimal comma"});
    const double least_unit = std::min(y_unit, z_unit);
    const bool   coarse = draw.one_in(8), exact = draw.one_in(2) || format == "Simpack" || least_unit != 1.;
    const int    digits = std::max(1., (coarse ? 3. : exact ? 7. : 4.) - std::round(std::log10(least_unit)));
    file.is_rounded     = !coarse && !exact;
    if (coarse)
      fault("rounded to 1 um", {"noise", "back on the line", "turns back"});
    const std::string encoding =
      draw.of<std::string>({"UTF-8", "UTF-8", "UTF-8", "UTF-8 with a mark", "UTF-16 little with a mark",
                            "UTF-16 big with a mark", "UTF-16 little", "UTF-16 big"});
    const std::string ends    = draw.of<std::string>({"\n", "\r\n", "\r"});
    const bool        remarks = draw.one_in(4), plus = draw.one_in(8), blank_lines = draw.one_in(6);
    note(std::string("separator '") + separator + "', decimal '" + decimal + "'" +
         (quotes ? ", quotes" : "") + ", " + encoding +
         (ends == "\n"   ? ""
          : ends == "\r" ? ", CR"
                         : ", CR LF"));
    std::string text         = simpack;
    const bool  more_columns = format == "MiniProf" && draw.one_in(2) && decimal != separator.front();
    if (format == "MiniProf")
      switch (draw.below(4))
        {
        case 0:
          text += "ProgramName=MiniProf\nXYPoints=" + std::to_string(points.size()) + "\nGauge=1435,2\n\n";
          break;
        case 1:
          text += more_columns ? "ColumnDef=X,Y,A,C\nProgramVer=2.1\n\n" : "ColumnDef=X,Y\n\n";
          break;
        case 2: // of an old instrument
          text += "Rail 7 left\n1435 12\n24.03.98\n\n";
          break;
        default:
          break;
        }
    else if (format == "table" && draw.one_in(2))
      text += draw.of<std::string>(
        {"# y z, mm\n", "y;z\n", "\"y\",\"z\"\n", "% measured at km 12,3\n", "60E1 left rail\n\n"});
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        const auto value = [&](const double v, const double unit) {
          const std::string word = number(unit * v, digits, decimal, plus);
          return quotes ? "\"" + word + "\"" : word;
        };
        text += value(points[i][0], y_unit) + separator + value(points[i][1], z_unit);
        if (more_columns)
          text += separator + value(0.25, 1.) + separator + value(0.5, 1.);
        if (remarks && i % 37 == 5)
          text += i % 2 == 0 ? " repaired" : " # repaired, 3 times";
        text += "\n";
        if (blank_lines && i % 50 == 49)
          text += "\n";
      }
    if (format == "Simpack")
      text += "  point.end\nspline.end\n";
    std::string lines;
    for (const char c : text)
      if (c == '\n')
        lines += ends;
      else
        lines += c;
    file.text = encoded(lines, encoding);
    file.name = std::string("geometry_profile_files") +
                (format == "table"      ? draw.of<std::string>({".txt", ".csv", ".dat"})
                 : format == "MiniProf" ? (shape.is_wheel ? ".whl" : ".ban")
                                        : (shape.is_wheel ? ".prw" : ".prr"));
    return file;
  }

  Curve rounded(Curve points)
  {
    for (Point &p : points)
      for (unsigned int d = 0; d < 2; ++d)
        p[d] = 1e-4 * std::round(1e4 * p[d]);
    return points;
  }

  void check_drawn(tests::Check &check, const std::uint64_t seed)
  {
    constexpr unsigned int        n_files       = 400;
    constexpr double              place_allowed = 0.02, pressure_allowed = 5e-3; // mm, of the pressure
    Draw                          draw(seed);
    std::map<std::string, Answer> known;
    unsigned int                  read = 0, refused = 0, named = 0, silent = 0, causeless = 0;
    for (unsigned int k = 0; k < n_files; ++k)
      {
        const Shape      &shape   = shapes[draw.below(shapes.size())];
        const double      spacing = draw.of<double>({0.2, 0.3, 0.5, 0.8});
        const Curve       points  = shape.points(spacing);
        const File        file    = draw_file(draw, shape, points, spacing);
        const std::string key     = shape.name + std::to_string(spacing) + (file.is_rounded ? "r" : "");
        if (!known.count(key))
          known[key] =
            answer(shape.is_wheel, line_of(file.is_rounded ? rounded(points) : points, shape.is_wheel));
        const Answer right = known[key];
        std::ofstream(file.name, std::ios::binary) << file.text;
        const auto tells = [&](const std::string &what) {
          return std::any_of(file.faults.begin(), file.faults.end(),
                             [&](const std::string &word) { return what.find(word) != what.npos; });
        };
        const auto complain = [&](const std::string &what) {
          std::printf("file %u of seed %llu, %s, points %g mm apart, %s:\n    %s\n", k,
                      static_cast<unsigned long long>(seed), shape.name.c_str(), spacing, file.about.c_str(),
                      what.c_str());
          if (std::getenv("TREAD_KEEP_FILES"))
            std::ofstream("kept-" + std::to_string(seed) + "-" + std::to_string(k) + "-" + file.name,
                          std::ios::binary)
              << file.text;
        };
        try
          {
            const Answer found = answer_of_file(shape.is_wheel, file.name);
            if (std::abs(found.y - right.y) <= place_allowed &&
                std::abs(found.pressure / right.pressure - 1.) <= pressure_allowed)
              ++read;
            else
              {
                const MeasuredProfile profile = read_measured_profile(
                  file.name, shape.is_wheel ? ProfileBody::wheel : ProfileBody::rail, {});
                std::string words = profile.pressure_of_noise(reference::combine({}, {}).hertz_modulus()) >
                                        MeasuredProfile::warned_noise * right.pressure
                                      ? "noise"
                                      : "";
                for (const std::string &remark : profile.remarks)
                  words += remark;
                if (tells(words))
                  ++named;
                else
                  {
                    ++silent;
                    complain("read as " + std::to_string(found.y) + " mm and " +
                             std::to_string(1e-6 * found.pressure) + " MPa, where " +
                             std::to_string(right.y) + " mm and " + std::to_string(1e-6 * right.pressure) +
                             " MPa are right; noise " + std::to_string(1e6 * profile.noise) + " um; " +
                             words);
                  }
              }
          }
        catch (const std::runtime_error &error)
          {
            const std::string what = error.what();
            if (tells(what) && what.find('\n') == what.npos && what.find(file.name) != what.npos)
              ++refused;
            else
              {
                ++causeless;
                complain("refused: " + what);
              }
          }
        std::remove(file.name.c_str());
      }
    std::printf("seed %llu: %u read right, %u refused by their cause, %u read with words about their fault\n",
                static_cast<unsigned long long>(seed), read, refused, named);
    const std::string of_seed = "400 files of seed " + std::to_string(seed) + ": ";
    check.below(of_seed + "silently read as another profile", silent, 0.);
    check.below(of_seed + "refused without their cause", causeless, 0.);
    check.that(of_seed + "most are read right", read > n_files / 3);
  }

  /// A spline takes the noise of an instrument away, and leaves the profile.
  void check_smoothing(tests::Check &check)
  {
    // A curve of one curvature is smooth, up to both of its ends.
    std::vector<dealii::Point<2>> bow;
    for (int i = 0; i <= 80; ++i)
      bow.emplace_back(0.5e-3 * i, std::pow(0.5e-3 * i - 20e-3, 2) / 0.6);
    const std::vector<dealii::Point<2>> kept = smoothed(bow, 6e-3);
    check.absolute("smoothing over 6 mm moves the first point of a parabola, um",
                   1e6 * kept.front().distance(bow.front()), 0., 0.1);
    check.absolute("and the last one, um", 1e6 * kept.back().distance(bow.back()), 0., 0.1);
    // How far one point that stands out was moved, at right angles to the line through those beside it.
    std::ofstream head("geometry_profile_files.txt");
    for (int i = -72; i <= 72; ++i)
      head << 0.5 * i << " " << std::to_string((i == 0 ? 0.008 : 0.) - 0.25 * i * i / 600.) << "\n";
    head.close();
    const MeasuredProfile peak =
      read_measured_profile("geometry_profile_files.txt", ProfileBody::rail, {false, 0., 6e-3});
    std::remove("geometry_profile_files.txt");
    check.absolute("smoothing moves most where a point stands out, at y, mm", 1e3 * peak.y_of_change, 0.,
                   1e-6);
    check.relative("and by, um", 1e6 * peak.largest_change, 1e6 * (peak.measured[72].z - peak.points[72].z),
                   1e-6);
    for (const unsigned int i : {0u, 4u})
      {
        const Shape  &shape  = shapes[i];
        const Curve   points = shape.points(0.25);
        const Answer  right  = answer(shape.is_wheel, line_of(points, shape.is_wheel));
        Draw          draw(7);
        std::ofstream stream("geometry_profile_files.txt");
        for (const Point &p : points)
          stream << p[0] << " " << std::to_string(p[1] + 3e-3 * draw.normal()) << "\n";
        stream.close();
        const auto body    = shape.is_wheel ? ProfileBody::wheel : ProfileBody::rail;
        const auto noisy   = read_measured_profile("geometry_profile_files.txt", body, {}),
                   smooth  = read_measured_profile("geometry_profile_files.txt", body, {false, 0., 6e-3});
        const Answer found = answer_of_file(shape.is_wheel, "geometry_profile_files.txt", {false, 0., 6e-3});
        std::remove("geometry_profile_files.txt");
        check.relative(shape.name + ": noise of 3 um, as it is estimated, um", 1e6 * noisy.noise, 3., 0.3);
        check.below(shape.name + ": noise left by smoothing over 6 mm, um", 1e6 * smooth.noise, 0.05);
        check.absolute(shape.name + ": contact of the smoothed profile, mm", found.y, right.y, 0.3);
        check.relative(shape.name + ": largest pressure of the smoothed profile, MPa", 1e-6 * found.pressure,
                       1e-6 * right.pressure, 0.05);
        check.that(shape.name + ": no flange is missed, neither of a rail nor of a wheel that has one",
                   std::none_of(noisy.remarks.begin(), noisy.remarks.end(), [](const std::string &remark) {
                     return remark.find("no flange") != std::string::npos;
                   }));
        // The largest of some hundred normal errors, and what the spline does to the corner of 13 mm.
        check.that(shape.name +
                     ": largest change of smoothing, um: " + std::to_string(1e6 * smooth.largest_change),
                   smooth.largest_change > 6e-6 && smooth.largest_change < 60e-6);
      }
  }

  /// A point that is given twice, a nanometre's part beside itself, is one: a curve through both would turn
  /// there.
  void check_repeated(tests::Check &check)
  {
    std::vector<dealii::Point<2>> points;
    for (int i = -20; i <= 20; ++i)
      {
        const double y = 1e-3 * i;
        points.emplace_back(y, -y * y / 0.6);
        if (i == 5)
          points.emplace_back(y, -y * y / 0.6 + 0.5e-9);
      }
    const ProfileCurve curve(points);
    check.absolute("a point given twice: points of the curve", curve.knots().size(), 41., 0.);
    const ProfileCurve::Place there = curve.at(curve.knots()[25]);
    check.absolute("a point given twice: slope there", there.dz / there.dy, -5e-3 / 0.3, 1e-5);
  }
} // namespace geometry_profile_files

TREAD_TEST(geometry_profile_files)(tests::Check &check, const tests::Arguments &arguments)
{
  check_smoothing(check);
  check_repeated(check);
  if (arguments.empty())
    {
      check_drawn(check, 1);
      check_drawn(check, 2);
    }
  for (const std::string &seed : arguments)
    check_drawn(check, std::stoull(seed));
}
