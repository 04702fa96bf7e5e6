// SPDX-License-Identifier: LGPL-2.1-or-later
// Treads, inclined and measured rails, where they touch first, and the height of defects.
#include <tread/base/hdf5_file.h>
#include <tread/base/input_error.h>
#include <tread/geometry/defect.h>
#include <tread/geometry/height_map.h>
#include <tread/geometry/measured_line.h>
#include <tread/geometry/rail_profile.h>
#include <tread/geometry/running_surfaces.h>
#include <tread/geometry/wheel_tread.h>

#include <deal.II/base/numbers.h>

#include "check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <limits>
#include <stdexcept>

using namespace tread;

namespace geometry_surfaces
{
  std::function<double(double)> rail(const RailProfile &profile, const double slope)
  {
    const auto own = [profile](const double y) {
      const double edge = 0.999 * profile.head_half_width(), on_head = std::clamp(y, -edge, edge);
      return profile.z_top(on_head) - std::abs(y - on_head);
    };
    return [own, angle = std::atan(slope)](const double y) {
      return turned_line(own, angle, y);
    };
  }

  void check_treads(tests::Check &check)
  {
    // EN 13715: running circle, flange tip, chamfer.
    check.absolute("S1002 at the running circle, mm", 1e3 * s1002_offset(0.), 0., 1e-12);
    check.absolute("S1002 flange height, mm", 1e3 * s1002_offset(-55e-3), 28., 1e-9);
    check.absolute("S1002 at y = 60 mm, mm", 1e3 * s1002_offset(60e-3), -2.6357, 1e-4);
    check.absolute("S1002 slope at the running circle", (s1002_offset(1e-6) - s1002_offset(-1e-6)) / 2e-6,
                   -3.358537058e-2, 1e-6);
    double jump = 0.;
    for (const double joint : {32.15796, -26., -35., -38.426669, -39.764474, -49.662510, -62.764706})
      jump =
        std::max(jump, std::abs(s1002_offset(1e-3 * joint + 1e-10) - s1002_offset(1e-3 * joint - 1e-10)));
    check.below("S1002 steps between its parts, mm", 1e3 * jump, 2e-4); // the coefficients' last digits
    const auto s1002 = tread_offset("S1002", 0.);
    check.absolute("S1002 as meshed is the profile on the tread, mm", 1e3 * s1002(-20e-3),
                   1e3 * s1002_offset(-20e-3), 1e-12);
    check.that("and goes on level where the flange is steep", s1002(-60e-3) == s1002(-45e-3));
    check.that("a cylinder has no offset", !tread_offset("cylinder", 0.));
    check.absolute("cone 1:40 at 10 mm, mm", 1e3 * tread_offset("cone 1:40", 0.)(10e-3), -0.25, 1e-12);
  }

  void check_first_contact(tests::Check &check)
  {
    for (const double slope : {1. / 40., 1. / 20.})
      {
        // On a circle of radius 300 mm, turned by the angle a: highest point 300 mm sin(a) beside the middle,
        // 300 mm (1 - cos(a)) above it. 15 mm is beside the crown arc (10.2 mm): there by the arc R80.
        const RailProfile profile = RailProfile::rail_60e1();
        RunningSurfaces   surfaces;
        surfaces.rail_top      = rail(profile, slope);
        const FirstContact top = first_contact(surfaces, 0.);
        if (slope < 0.03)
          {
            check.absolute("cylinder on 1:40: y, mm", 1e3 * top.y, 300. * std::sin(std::atan(slope)), 0.011);
            check.absolute("cylinder on 1:40: lift, um", 1e6 * top.lift,
                           3e5 * (1. - std::cos(std::atan(slope))), 2e-4);
          }
        surfaces.tread_offset = [slope](const double y) {
          return -slope * y;
        };
        const FirstContact cone = first_contact(surfaces, 0.);
        check.absolute("cone of the rail's slope: y, mm", 1e3 * cone.y, 0., 0.011);
        check.below("cone of the rail's slope: lift, um", 1e6 * cone.lift, 1e-3);
        check.relative("cone of the rail's slope: lateral radius, mm", 1e3 * cone.lateral_radius, 300., 5e-3);

        // For any shift of the tread the surfaces touch without overlapping.
        for (const double shift : {-6., -3., 0., 2., 8.})
          {
            surfaces.tread_offset = [shift, tread = tread_offset("S1002", 0.)](const double y) {
              return tread(y - 1e-3 * shift);
            };
            const FirstContact contact = first_contact(surfaces, 0.);
            double             least   = surfaces.gap(contact.y) + contact.lift;
            for (double y = -surfaces.half_width; y <= surfaces.half_width; y += 3.3e-6)
              least = std::min(least, surfaces.gap(y) + contact.lift);
            check.below("S1002 moved by " + std::to_string(int(shift)) + " mm: least gap, nm", 1e9 * least,
                        0.2);
          }
      }

    // Over the middle of a dip the wheel (R = 460 mm) rests on the edges: chord of 20 mm, 0.1087 mm, or on
    // the bottom if that is higher.
    RunningSurfaces surfaces;
    surfaces.rail_top = rail(RailProfile::rail_54e1(), 0.);
    Defect hollow;
    hollow.shape    = dip(0., 0.);
    hollow.begin    = -10e-3;
    hollow.width    = 60e-3;
    hollow.depth    = 0.05e-3;
    surfaces.defect = [&](const double x, const double y) {
      return hollow.height(x, y);
    };
    check.absolute("in a flat dip: lift, um", 1e6 * first_contact(surfaces, 0.).lift, -50., 1e-6);
    hollow.depth = 1e-3;
    check.absolute("over a deep dip: lift, um", 1e6 * first_contact(surfaces, 0.).lift,
                   1e6 * (std::sqrt(0.46 * 0.46 - 1e-4) - 0.46), 1e-6);

    // A coned wheel on a rail whose defect is a plate of 0.1 mm everywhere is as much higher.
    surfaces.tread_offset = tread_offset("cone 1:20", 0.);
    surfaces.defect       = {};
    const double on_rail  = first_contact(surfaces, 0.).lift;
    surfaces.defect       = [](const double, const double) {
      return 0.1e-3;
    };
    check.that("coned wheel: it does not touch in the middle", std::abs(on_rail) > 50e-6);
    check.absolute("coned wheel on a plate: lift, um", 1e6 * first_contact(surfaces, 0.).lift,
                   1e6 * on_rail + 100., 0.03);
  }

  void check_defects(tests::Check &check)
  {
    {
      // Three alike: each where it was put, and nothing between them.
      Defect one;
      one.shape  = dip(0., 0.1);
      one.begin  = -10e-3;
      one.length = 12e-3;
      Defect three(one), alone(one);
      three.repeated_at = {5e-3, 40e-3};
      for (const double begin : {-10e-3, 5e-3, 40e-3})
        {
          alone.begin = begin;
          for (const double u : {0.1, 0.5, 0.93})
            check.relative("three dips: height, um", 1e6 * three.height(begin + u * one.length, 1e-3),
                           1e6 * alone.height(begin + u * one.length, 1e-3), 1e-12);
        }
      check.absolute("three dips: height between them, um", 1e6 * three.height(25e-3, 0.), 0., 0.);
    }
    {
      // Edges that are rounded over 2 and 4 of 20 mm of the path: no more across it than along it.
      const auto rounded = dip(0.1, 0.2);
      double     step = 0., beyond = 0.;
      for (double v = -1.1; v <= 1.1; v += 0.01)
        {
          step = std::max(step, std::abs(rounded(0.5 + 1e-6, v) - rounded(0.5 - 1e-6, v)));
          if (std::abs(v) > 1.)
            beyond = std::max(beyond, rounded(0.5, v));
        }
      check.below("rounded dip: step across the path in its middle, share of the depth", step, 1e-5);
      check.below("rounded dip: depth beside it there, share", beyond, 0.);
      // The kink of -4 per length at the leading edge: a parabola over 0.1 of the length, half on each side.
      check.relative("rounded dip: depth at the leading edge, share", rounded(0., 0.), 0.05, 1e-9);
      check.below("rounded dip: depth half of the rounding ahead", rounded(-0.05, 0.), 0.);
      // Over half of the length, which is the most: a parabola over a quarter of it outside, none beyond the
      // width, and no kink anywhere.
      const auto   most    = dip(0.5, 0.5);
      double       outside = 0., kink = 0.;
      const double small = 1e-6;
      for (double u = -0.3; u <= 1.3; u += 0.0037)
        for (double v = -1.1; v <= 1.1; v += 0.0037)
          {
            if (std::abs(v) >= 1.)
              outside = std::max(outside, most(u, v));
            kink =
              std::max({kink, std::abs(most(u + small, v) - 2. * most(u, v) + most(u - small, v)) / small,
                        std::abs(most(u, v + small) - 2. * most(u, v) + most(u, v - small)) / small});
          }
      check.relative("half of a dip rounded: depth at the edge, share", most(1., 0.), 0.25, 1e-9);
      check.below("half of a dip rounded: depth beside it, share", outside, 0.);
      check.below("half of a dip rounded: change of the slope within 1e-6 of its length or width", kink,
                  2e-3);
    }
    Defect hollow;
    hollow.shape  = dip(0., 0.);
    hollow.begin  = 5e-3;
    hollow.length = 20e-3;
    hollow.width  = 30e-3;
    hollow.depth  = 0.2e-3;
    check.absolute("dip: depth in its middle, um", 1e6 * hollow.height(15e-3, 0.), -200., 1e-9);
    check.that("dip: none beside it",
               hollow.height(4.999e-3, 0.) == 0. && hollow.height(25.001e-3, 0.) == 0. &&
                 hollow.height(15e-3, 15.001e-3) == 0. && hollow.height(7e-3, 14e-3) == 0.);
    double       volume = 0.;
    const double step   = 0.1e-3;
    for (double x = 0.5 * step; x < 30e-3; x += step)
      for (double y = -20e-3 + 0.5 * step; y < 20e-3; y += step)
        volume -= step * step * hollow.height(x, y);
    check.relative("dip: volume of a paraboloid, mm3", 1e9 * volume, 3.14159265 / 8. * 0.2 * 20. * 30., 1e-3);
    // A sphere's cap of 20 mm and 0.2 mm: radius 250.1 mm.
    hollow.width       = hollow.length;
    const double cap_r = (0.25 * 20. * 20. + 0.2 * 0.2) / (2. * 0.2);
    check.absolute("dip: a sphere's cap at half its radius, um", 1e6 * hollow.height(20e-3, 0.),
                   -1e3 * (std::sqrt(cap_r * cap_r - 25.) - (cap_r - 0.2)), 0.1);

    // Slopes jump at a sharp edge by 4 d/L = 0.04; a rounding spreads that evenly over its length.
    const auto slope = [&](const double x) {
      return (hollow.height(x + 1e-7, 0.) - hollow.height(x - 1e-7, 0.)) / 2e-7;
    };
    check.absolute("dip: slope behind the sharp leading edge", slope(5.001e-3), -0.04, 1e-4);
    hollow.shape = dip(0., 4e-3 / hollow.length);
    check.absolute("dip: slope in front of the rounded trailing edge", slope(22.7e-3), 0.0308, 1e-4);
    check.absolute("dip: slope in its middle", slope(25e-3), 0.02, 2e-3); // r^2 curves over 4 mm by a tenth
    check.below("dip: slope behind it", slope(27.5e-3), 1e-9);
    check.absolute("dip: the leading edge stays sharp", slope(5.001e-3), -0.04, 1e-4);

    // A measured line on a slope: depth counts from its chord.
    const MeasuredLine line({0., 10e-3, 20e-3, 30e-3, 40e-3}, {1e-3, 0.6e-3, 0.4e-3, 0.4e-3, 0.2e-3});
    Defect             along = defect_along(line, LineDatum::chord, false);
    const auto         alike = along.shape;
    along.width              = 40e-3;
    along.shape              = with_parabola(alike);
    check.absolute("profile: length, mm", 1e3 * along.length, 40., 1e-9);
    check.absolute("profile: at a point of the file, um", 1e6 * along.height(10e-3, 0.), -200., 1e-6);
    check.absolute("profile: half way to the side a parabola, um", 1e6 * along.height(10e-3, 10e-3), -150.,
                   1e-6);
    along.width = std::numeric_limits<double>::infinity();
    along.shape = alike;
    check.absolute("profile: uniform, um", 1e6 * along.height(10e-3, 30e-3), -200., 1e-6);
    Defect back = defect_along(line, LineDatum::chord, true);
    back.width  = 40e-3;
    check.absolute("profile: reversed, um", 1e6 * back.height(30e-3, 0.), -200., 1e-6);
  }

  /// Writes the text and reads it as `kind`; what the program says, empty if it takes it.
  std::string complaint(const std::string &kind, const std::string &ending, const std::string &text)
  {
    const std::string file = "geometry_surfaces_" + kind + ending;
    std::ofstream(file) << text;
    const std::string what = tests::complaint<std::runtime_error>([&] {
      if (kind == "rail")
        read_rail_head(file, 20e-3, 12e-3);
      else if (kind == "wheel")
        read_wheel_tread(file, 20e-3);
      else if (kind == "flange")
        read_wheel_points(file);
      else if (kind == "map")
        HeightMap map(file);
      else
        read_longitudinal_profile(file);
    });
    std::remove(file.c_str());
    return what;
  }

  void check_height_map(tests::Check &check)
  {
    // A plane and a parabola in each direction, in any order of the rows.
    const auto height = [](const double x, const double y) {
      return -0.3 + 0.01 * x - 0.02 * y + 2e-3 * x * x - 1e-3 * y * y + 5e-4 * x * y;
    };
    const std::string file = "geometry_surfaces_map.csv";
    std::ofstream     stream(file);
    stream << "z_mm,y_mm,x_mm\n" << std::setprecision(15);
    for (int j = 12; j >= 0; --j)
      for (int i = 0; i < 20; ++i)
        stream << height(0.7 * i, -3. + 0.5 * j) << "," << -3. + 0.5 * j << "," << 0.7 * i << "\n";
    stream.close();
    const HeightMap map(file);
    std::remove(file.c_str());
    check.absolute("map: extent along, mm", 1e3 * (map.x_end() - map.x_begin()), 13.3, 1e-9);
    check.absolute("map: extent across, mm", 1e3 * (map.y_end() - map.y_begin()), 6., 1e-9);
    for (const auto &[x, y] : {std::pair(3.11, 0.23), std::pair(7.7, -1.9), std::pair(9.999, 2.2)})
      check.absolute("map: a parabola at " + std::to_string(x) + " mm, um",
                     1e6 * map.height(1e-3 * x, 1e-3 * y), 1e3 * height(x, y), 1e-9);
    check.absolute("map: between the last places of a border a straight line, um",
                   1e6 * map.height(0.35e-3, 0.5e-3), 1e3 * height(0.35, 0.5), 0.5);
    check.absolute("map: the same at its first row, um", 1e6 * map.height(3.11e-3, -2.83e-3),
                   1e3 * height(3.11, -2.83), 0.1);
    check.absolute("map: beyond it the border's height, um", 1e6 * map.height(-5e-3, 0.5e-3),
                   1e3 * height(0., 0.5), 1e-9);
  }

  void check_hdf5_map(tests::Check &check)
  {
    const std::string file  = "geometry_surfaces_map.h5";
    const auto        write = [&](const std::vector<double> &x, const std::vector<double> &y,
                           const std::vector<double> &z) {
      const hdf5::Handle stream(hdf5::create(file), H5Fclose);
      hdf5::write_rows(stream, "x_mm", x);
      hdf5::write_rows(stream, "y_mm", y);
      hdf5::write_rows(stream, "z_mm", z, x.size());
    };
    // Three places across, four along: their order cannot be mistaken.
    const std::vector<double> x{2., 4., 6., 8.}, y{-1., 0., 1.};
    std::vector<double>       z;
    for (const double across : y)
      for (const double along : x)
        z.push_back(0.01 * along - 0.02 * across);
    write(x, y, z);
    const HeightMap map(file);
    check.absolute("map of HDF5: begins at, mm", 1e3 * map.x_begin(), 2., 1e-12);
    check.absolute("map of HDF5: ends at, mm", 1e3 * map.y_end(), 1., 1e-12);
    check.absolute("map of HDF5: a plane, um", 1e6 * map.height(4.7e-3, -0.3e-3), 1e3 * (0.047 + 0.006),
                   1e-9);
    const auto refused = [&](const std::string &what, const std::string &words) {
      const std::string said = tests::complaint<InputError>([&] { HeightMap again(file); });
      check.that(what + ": \"" + said + "\"", said.find(words) != std::string::npos);
    };
    z.resize(8);
    write(x, y, z);
    refused("map of HDF5: of another size", "they are 4, 3 and 2 x 4");
    z.assign(12, std::nan(""));
    write(x, y, z);
    refused("map of HDF5: nan", "z_mm has a value that is no finite number");
    write({2., 4., 7.}, y, std::vector<double>(9, 0.));
    refused("map of HDF5: unequal spacings", "does not lie on a grid");
    {
      const hdf5::Handle stream(hdf5::create(file), H5Fclose);
    }
    refused("map of HDF5: without a dataset", "the dataset of numbers 'x_mm' is not there");
    std::ofstream(file) << "x_mm,y_mm,z_mm\n";
    refused("map of HDF5: a text", "as a file of HDF5");
    std::remove(file.c_str());
  }

  void check_long_defects(tests::Check &check)
  {
    Defect waves;
    waves.length = 0.3;
    waves.depth  = 50e-6;
    waves.width  = std::numeric_limits<double>::infinity();
    waves.shape  = corrugation(0.06 / waves.length);
    check.absolute("corrugation: crest, um", 1e6 * waves.height(0.12, 0.01), 0., 1e-9);
    check.absolute("corrugation: trough, um", 1e6 * waves.height(0.15, -0.02), -50., 1e-9);
    check.absolute("corrugation: mean depth, um", 1e6 * waves.height(0.135, 0.), -25., 1e-9);
    check.absolute("corrugation: before it, um", 1e6 * waves.height(-0.03, 0.), 0., 0.);
    // A ramp over a third of the length: half a cosine, and the same from both ends.
    waves.shape = with_ramps(waves.shape, 0.1 / waves.length);
    check.absolute("ramp: trough at 30 mm of 100, um", 1e6 * waves.height(0.03, 0.),
                   -50. * 0.5 * (1. - std::cos(0.3 * dealii::numbers::PI)), 1e-9);
    check.absolute("ramp: the same from the other end, um", 1e6 * waves.height(0.27, 0.),
                   1e6 * waves.height(0.03, 0.), 1e-9);
    check.absolute("ramp: beyond it nothing, um", 1e6 * waves.height(0.15, 0.), -50., 1e-9);

    // A measured wave on a slope, which begins at a crest and ends in a trough.
    const std::string file = "geometry_surfaces_wave.txt";
    std::ofstream     stream(file);
    stream << std::setprecision(15);
    for (int i = 0; i <= 450; ++i)
      stream << i << " " << 0.05 * std::cos(2. * dealii::numbers::PI * i / 100.) + 1e-3 * i << "\n";
    stream.close();
    const MeasuredLine line = read_longitudinal_profile(file);
    std::remove(file.c_str());
    const Defect chord = defect_along(line, LineDatum::chord, false),
                 fit   = defect_along(line, LineDatum::fitted, false);
    check.absolute("measured wave: depth below its chord, mm", 1e3 * chord.depth, 0.1, 0.03);
    // The line of best fit leans by what the odd half wave moves it.
    check.absolute("measured wave: depth from its fitted line, mm", 1e3 * fit.depth, 0.05, 0.01);
    double sum = 0., moment = 0.;
    for (int i = 0; i <= 450; ++i)
      {
        sum += fit.height(1e-3 * i, 0.);
        moment += (i - 225) * fit.height(1e-3 * i, 0.);
      }
    check.absolute("measured wave: no mean beside its fitted line, um", 1e6 * sum / 451., 0., 0.3);
    check.absolute("measured wave: no slope, um", 1e6 * moment / 451. / 225., 0., 0.3);
  }

  /// What the header of Simpack's files does, in its order, and what MiniProf's means.
  void check_headers(tests::Check &check)
  {
    const auto worn = [](const double y_mm) {
      return (y_mm - 3.) * (y_mm - 3.) / 600.;
    };
    const auto check_head = [&](const std::string &what, const std::string &name, const std::string &text,
                                const double allowed) {
      std::ofstream(name, std::ios::binary) << text;
      const MeasuredLine head = read_rail_head(name, 25e-3, 25e-3);
      std::remove(name.c_str());
      for (const double y : {-17.3, 3., 22.1})
        check.absolute(what + " at " + std::to_string(y) + " mm, um", 1e6 * head(1e-3 * y), -1e3 * worn(y),
                       allowed);
    };
    // Shifted, turned by 2 degrees, clipped, mirrored, in inches.
    const double angle = 2. * dealii::numbers::PI / 180., c = std::cos(angle), s = std::sin(angle);
    std::string  text =
      "spline.begin\n mirror.y = 1\n units.len.f = 39.37007874015748\n units.ang.f = 57.29577951\n"
      " bound.y.min = -1.14\n bound.y.max = 1.19\n rotate = 2\n shift.y = 0.5 ! inch\n shift.z = -0.25\n"
      "point.begin\n";
    for (double y = -34.; y <= 34.01; y += 0.5)
      {
        // Beyond -30 and 28.9 mm lies debris. The last step first.
        const double a = -y / 25.4, b = (worn(y) + (y < -30.3 || y > 29. ? -9. : 0.)) / 25.4;
        char         row[80];
        std::snprintf(row, sizeof row, "%.9f %.9f\n", c * a + s * b - 0.5, -s * a + c * b + 0.25);
        text += row;
      }
    check_head(".prr with all steps", "geometry_surfaces.prr", text + "point.end\n", 0.02);

    std::string rows, by_columns, near;
    for (int y = -30; y <= 30; ++y)
      {
        rows += std::to_string(y) + " " + std::to_string(worn(y)) + " 0.1\n";
        by_columns += "0.5," + std::to_string(worn(y) + 0.75) + "," + std::to_string(y - 1.5) + "\n";
      }
    check_head("MiniProf of an old age", "geometry_surfaces.ban", "Line 3 left\n1435 20\n24.03.98\n\n" + rows,
               0.02);
    check_head("MiniProf without a heading, an empty line among its points", "geometry_surfaces.ban",
               rows.substr(0, rows.find("\n4 ") + 1) + rows.substr(rows.find("\n4 ")), 0.02);
    check_head("MiniProf whose columns are named", "geometry_surfaces.ban",
               "ColumnDef=A,Y,X\nXOffset=1,5\nYOffset=-0.75\nXYPoints=61\n\n" + by_columns, 0.02);
    // Of points nearer than the least distance the first is kept.
    near = "point.dist.min = 0.2\npoint.begin\n";
    for (int y = -30; y <= 30; ++y)
      near += std::to_string(y) + " " + std::to_string(worn(y)) + "\n" + std::to_string(y + 0.1) + " " +
              std::to_string(worn(y) - 0.004) + "\n";
    check_head(".prr with a least distance", "geometry_surfaces.prr", near + "point.end\n", 0.02);
  }

  /// A wheel with the face of its rim, 36 mm high: further from the tread than the flange.
  void check_rim_face(tests::Check &check)
  {
    for (const double side : {1., -1.})
      for (const double up : {1., -1.})
        {
          std::string rows;
          const auto  add = [&](const double y, const double z) {
            rows += std::to_string(side * y) + " " + std::to_string(up * z) + "\n";
          };
          for (double y = -66.; y <= 60.; y += 0.25)
            add(y, -1e3 * s1002_offset(1e-3 * y));
          for (double z = -1e3 * s1002_offset(60e-3) + 1.; z < 38.; z += 1.)
            add(60.01 + 0.001 * z, z);
          std::ofstream("geometry_surfaces.txt") << rows;
          const MeasuredLine                  tread  = read_wheel_tread("geometry_surfaces.txt", 25e-3);
          const std::vector<dealii::Point<2>> points = read_wheel_points("geometry_surfaces.txt");
          const std::string                   what   = std::string("wheel with a rim's face, flange at ") +
                                   (side > 0. ? "-" : "+") + "y, z " + (up > 0. ? "up" : "down") + ": ";
          for (const double y : {-21.2, 17.4})
            check.absolute(what + "at " + std::to_string(y) + " mm, um", 1e6 * tread(1e-3 * y),
                           -1e6 * s1002_offset(1e-3 * y), 0.5);
          check.absolute(what + "begins at, mm", 1e3 * points.front()[0], -66., 1e-9);
        }
    std::remove("geometry_surfaces.txt");
  }

  void check_files(tests::Check &check)
  {
    // The same arc of 300 mm in all formats.
    const auto arc = [](const double y_mm) {
      return 300. - std::sqrt(9e4 - y_mm * y_mm);
    };
    std::string table = "y_mm, z_mm\n", miniprof = "Gauge=1435\nXYPoints=61\n",
                simpack = "header.begin\nheader.end\nspline.begin\n units.len.f = 1.0e3 ! mm\npoint.begin\n";
    for (int y = -30; y <= 30; ++y)
      {
        const std::string a = std::to_string(y), z = std::to_string(arc(y));
        table += a + ", -" + z + "\n";
        miniprof += std::to_string(-y) + " " + z + " 0.1 0.003\n";
        simpack += a + " " + z + " 1.0\n";
      }
    simpack += "point.end\nspline.end\n";
    // Headings and comments as other programs write them.
    const std::string words = "Worn rail of line 3\n% measured by hand\n\"Y\" \"Z\"\n",
                      rows  = miniprof.substr(miniprof.find("61\n") + 3);
    const std::pair<std::string, std::string> formats[] = {{".txt", table},
                                                           {".ban", miniprof},
                                                           {".prr", simpack},
                                                           {".txt", words + table},
                                                           {".ban", words + rows}};
    for (const auto &[ending, text] : formats)
      {
        const std::string file = "geometry_surfaces" + ending;
        std::ofstream(file) << text;
        const MeasuredLine line = read_rail_head(file, 25e-3, 25e-3);
        std::remove(file.c_str());
        check.absolute("rail head from " + ending + " at 10.5 mm, um", 1e6 * line(10.5e-3), -1e3 * arc(10.5),
                       4e-3);
        check.absolute("rail head from " + ending + " reaches to, mm", 1e3 * line.end(), 30., 1e-9);
      }

    // S1002 as a file of Simpack: y towards the flange, z down.
    std::string prw = "units.len.f = 1000\npoint.begin\n";
    for (int s = 45; s >= -60; --s)
      prw += std::to_string(-s) + " " + std::to_string(1e3 * s1002_offset(1e-3 * s)) + "\n";
    std::ofstream("geometry_surfaces.prw") << prw + "point.end\n";
    const auto tread = tread_offset("geometry_surfaces.prw", 25e-3);
    std::remove("geometry_surfaces.prw");
    for (const double y : {-20.3, -7.7, 11.4, 24.6})
      check.absolute("S1002 from .prw at " + std::to_string(y) + " mm, um", 1e6 * tread(1e-3 * y),
                     1e6 * s1002_offset(1e-3 * y), 0.02);

    // A head whose top lies 7 mm to the field side, shifted and then mirrored by the file.
    const auto worn = [](const double y_mm) {
      return (y_mm - 7.) * (y_mm - 7.) / 600.;
    };
    std::string moved = "mirror.y = 1\nshift.y = 4.0\nshift.z = -2.5\npoint.begin\n";
    for (int y = 30; y >= -30; --y)
      moved += std::to_string(-4 - y) + " " + std::to_string(worn(y) + 2.5) + "\n";
    std::ofstream("geometry_surfaces.prr") << moved + "point.end\n";
    const MeasuredLine head = read_rail_head("geometry_surfaces.prr", 25e-3, 25e-3);
    std::remove("geometry_surfaces.prr");
    for (const double y : {-13.3, 7., 21.2})
      check.absolute("mirrored and shifted .prr at " + std::to_string(y) + " mm, um", 1e6 * head(1e-3 * y),
                     -1e3 * worn(y), 0.02);

    // The same in a table whose y has the other sign and another origin, placed by the caller.
    std::string mirrored;
    for (int y = 30; y >= -30; --y)
      mirrored += std::to_string(12 - y) + " " + std::to_string(-worn(y)) + "\n";
    std::ofstream("geometry_surfaces.txt") << mirrored;
    const MeasuredLine placed = read_rail_head("geometry_surfaces.txt", 25e-3, 25e-3, {true, 12e-3});
    const std::vector<dealii::Point<2>> placed_points =
      read_rail_points("geometry_surfaces.txt", {true, 12e-3});
    for (const double y : {-13.3, 7., 21.2})
      check.absolute("mirrored and shifted table at " + std::to_string(y) + " mm, um", 1e6 * placed(1e-3 * y),
                     -1e3 * worn(y), 0.02);
    check.absolute("mirrored and shifted points begin at, mm", 1e3 * placed_points.front()[0], -30., 1e-9);
    check.absolute("with, um", 1e6 * placed_points.front()[1], -1e3 * worn(-30.), 1e-3);

    // A wheel whose y begins at the back of the flange and points away from it.
    std::string from_back;
    for (double s = -70.; s <= 45.; s += 0.125)
      from_back += std::to_string(s + 70.) + " " + std::to_string(-1e3 * s1002_offset(1e-3 * s)) + "\n";
    std::ofstream("geometry_surfaces.txt") << from_back;
    const std::vector<dealii::Point<2>> wheel_points =
      read_wheel_points("geometry_surfaces.txt", {false, -70e-3});
    check.absolute("wheel from the back of its flange begins at, mm", 1e3 * wheel_points.front()[0], -70.,
                   1e-9);
    check.absolute("and ends with, um", 1e6 * wheel_points.back()[1], -1e6 * s1002_offset(45e-3), 5e-3);

    // A hollow tread without a flange: nothing says that it should be turned.
    std::string hollow;
    for (int y = -30; y <= 40; ++y)
      hollow += std::to_string(y) + " " + std::to_string(1e-3 * y * y) + "\n";
    std::ofstream("geometry_surfaces.txt") << hollow;
    const MeasuredLine without_flange = read_wheel_tread("geometry_surfaces.txt", 25e-3);
    std::remove("geometry_surfaces.txt");
    check.absolute("hollow tread without a flange at 20 mm, um", 1e6 * without_flange(20e-3), 400., 1e-6);

    // Invalid files: the error names the file and the line.
    const auto says = [&](const std::string &what, const std::string &said,
                          const std::vector<std::string> &words) {
      bool all = !said.empty();
      for (const std::string &word : words)
        all = all && said.find(word) != std::string::npos;
      if (!check.that(what, all))
        std::printf("    %s\n", said.c_str());
    };
    check.that("a good longitudinal profile",
               complaint("defect", ".txt", "# a\n0 0\n1 -.1\n2 -.2\n3 0\n").empty());
    check.that(
      "a profile in quotes, with a heading that begins with a rail's name, is read",
      complaint("defect", ".txt", "60E1 rail\n\"0\",\"0\"\n\"1\",\"-.1\"\n\"2\",\"-.2\"\n3,0\n").empty());
    says("three columns in quotes", complaint("defect", ".txt", "\"0\",\"0\",\"1\"\n\"1\",\"-.1\",\"1\"\n"),
         {"line 1", "two numbers"});
    says("a first row that is no number", complaint("defect", ".txt", "nan 0\n0 0\n1 -.1\n2 -.2\n3 0\n"),
         {"line 1", "two numbers"});
    says("three columns", complaint("defect", ".txt", "0 0\n1 -.1 5\n2 -.2\n3 0\n"),
         {"line 2", "two numbers"});
    says("words", complaint("defect", ".txt", "0 0\n1 -.1\n2 deep\n3 0\n"), {"line 3", "two numbers"});
    says("not a number", complaint("defect", ".txt", "0 0\n1 nan\n2 -.1\n3 0\n"), {"line 2", "two numbers"});
    says("x turns back", complaint("defect", ".txt", "0 0\n2 -.1\n1 -.2\n3 0\n"), {"line 3", "increase"});
    says("a gap", complaint("defect", ".txt", "0 0\n1 -.1\n2 -.2\n3 -.2\n30 0\n31 0\n"),
         {"line 5", "gap", "27 mm"});
    says("a point beyond all rails", complaint("defect", ".txt", "0 0\n1 -.1\n2 -.2\n3 1e300\n"),
         {"line 4", "further away"});
    says("points that nearly coincide", complaint("defect", ".txt", "0 0\n1e-10 -.1\n2 -.2\n3 0\n"),
         {"line 2", "increase"});
    says("a unit that makes lengths infinite",
         complaint("rail", ".prr", "units.len.f = 1e-300\npoint.begin\n-30 1\n-1 0\n1 0\n30 1\npoint.end\n"),
         {"line 3", "further away"});
    says("too few points", complaint("defect", ".txt", "0 0\n1 0\n"), {"2 points"});
    check.that("a rail head of 15 mm to each side is taken",
               complaint("rail", ".txt", "-15 -.4\n-10 -.2\n-5 -.05\n0 0\n5 -.05\n10 -.2\n15 -.4\n").empty());
    says("a narrow rail head", complaint("rail", ".txt", "-5 -.1\n-2 0\n2 0\n5 -.1\n"), {"-5 mm", "12 mm"});
    says("a rail head that folds back",
         complaint("rail", ".txt", "-25 -2\n-15 -1\n-5 0\n5 0\n10 -.5\n9 -.6\n20 -2\n25 -3\n"),
         {"line 6", "turns back"});
    says("a .prr without points", complaint("rail", ".prr", "header.begin\n"), {"point.begin"});
    says("a map with a place missing", complaint("map", ".csv", "x_mm,y_mm,z_mm\n0,0,0\n1,0,0\n0,1,0\n"),
         {"x 1 mm, y 1 mm", "missing"});
    says("a map with a place twice",
         complaint("map", ".csv", "x_mm,y_mm,z_mm\n0,0,0\n1,0,0\n0,1,0\n1,1,0\n1,1,1\n"), {"row 5", "twice"});
    says("a map with unequal spacings",
         complaint("map", ".csv", "x_mm,y_mm,z_mm\n0,0,0\n1,0,0\n3,0,0\n0,1,0\n1,1,0\n3,1,0\n"),
         {"x_mm 1", "equal spacings"});
    says("a map whose spacing vanishes",
         complaint("map", ".csv", "x_mm,y_mm,z_mm\n0,0,0\n5e-324,0,0\n0,1,0\n5e-324,1,-1\n"),
         {"x_mm have spacings of 0 mm", "at least"});
    says("a map of one line", complaint("map", ".csv", "x_mm,y_mm,z_mm\n0,0,0\n1,0,0\n"),
         {"two different y_mm"});
    says("a map without heights", complaint("map", ".csv", "x_mm,y_mm\n0,0\n1,0\n0,1\n1,1\n"),
         {"no column 'z_mm'"});
    says("a wheel that ends beside its running circle",
         complaint("flange", ".txt", "-50 -30\n-45 -28\n-4 0\n-1 0\n-1 .1\n1 0\n4 0\n"),
         {"one side of the running circle"});
    says("a .ban with one column", complaint("rail", ".ban", "A=1\n1\n"), {"line 2", "two numbers"});

    // What is no profile, or not that of the body that was asked for.
    const auto rows_of = [](const auto &height, const double from, const double to, const double step,
                            const double y_unit = 1., const double z_unit = 1.) {
      std::string rows;
      for (double y = from; y <= to + 1e-9; y += step)
        {
          char row[80];
          std::snprintf(row, sizeof row, "%.9g %.9g\n", y_unit * y, z_unit * height(y));
          rows += row;
        }
      return rows;
    };
    const auto crown = [&](const double y) {
      return -arc(y);
    };
    const auto wheel = [](const double y) {
      return -1e3 * s1002_offset(1e-3 * y);
    };
    says("a head in m", complaint("rail", ".txt", rows_of(crown, -32., 32., 1., 1e-3, 1e-3)),
         {"lengths in m?"});
    says("a head in inch", complaint("rail", ".txt", rows_of(crown, -32., 32., 1., 1. / 25.4, 1. / 25.4)),
         {"inch"});
    says("a head in um", complaint("rail", ".txt", rows_of(crown, -32., 32., 1., 1e3, 1e3)), {"in um"});
    says("heights in um", complaint("rail", ".txt", rows_of(crown, -32., 32., 1., 1., 1e3)),
         {"heights", "in um?"});
    says("heights in m", complaint("rail", ".txt", rows_of(crown, -32., 32., 1., 1., 1e-3)),
         {"heights", "in m?"});
    says("heights in inch", complaint("rail", ".txt", rows_of(crown, -32., 32., 1., 1., 1. / 25.4)),
         {"heights in another unit"});
    says("a wheel in um", complaint("flange", ".txt", rows_of(wheel, -66., 60., 0.5, 1e3, 1e3)), {"in um"});
    says("a wheel whose heights are in inch",
         complaint("flange", ".txt", rows_of(wheel, -66., 60., 0.5, 1., 1. / 25.4)),
         {"no flange", "another unit"});
    says("a wheel for a rail", complaint("rail", ".txt", rows_of(wheel, -66., 60., 0.5)), {"wheel"});
    says("a rail for a wheel",
         complaint("flange", ".txt", rows_of([](const double y) { return -y * y / 80.; }, -36., 36., 0.5)),
         {"no flange", "rail"});
    says("a wheel whose flange is cut off", complaint("wheel", ".txt", rows_of(wheel, -37.5, 60., 0.25)),
         {"no flange", "cut off"});
    says("a tread turned round",
         complaint("wheel", ".txt", rows_of([](const double y) { return -y / 30.; }, -28., 28., 1.)),
         {"no flange", "1:30", "turn y or z"});
    says("a head with something on it",
         complaint("rail", ".txt",
                   rows_of([&](const double y) { return y > 30. ? 4. : crown(y); }, -34., 34., 0.5)),
         {"above the top"});
    const auto with = [&](const double at, const double change) {
      return rows_of([&](const double y) { return crown(y) + (std::abs(y - at) < 1e-6 ? change : 0.); }, -32.,
                     32., 0.25);
    };
    says("a spike of 0.15 mm", complaint("rail", ".txt", with(3.75, 0.15)),
         {"line 144", "y = 3.75 mm", "spike"});
    says("a spike of 12 um", complaint("rail", ".txt", with(-9.25, -0.012)), {"line 92", "spike"});
    std::string back = rows_of(crown, -32., 32., 0.25);
    back.replace(back.find("\n5.25 ") + 1, 5, "4.75 ");
    says("a point 0.25 mm back", complaint("rail", ".txt", back),
         {"y = 4.75 mm", "turns back", "Smoothing length"});
    says("decimal commas and commas between", complaint("rail", ".txt", "-1,5,2,5\n0,5,1,5\n1,5,1,5\n"),
         {"line 1", "decimal commas", "semicolons"});
    says("both decimal signs", complaint("rail", ".txt", "-1,5 2,5\n0.5 1,5\n1,5 1,5\n"),
         {"line 2", "decimal points", "line 1"});
    says("separators of thousands", complaint("rail", ".txt", "-1.000,5 2,5\n0,5 1,5\n"),
         {"line 1", "thousands"});
    says("an entry that is empty", complaint("rail", ".txt", "-1;2\n0;;3\n"), {"line 2", "empty"});
    says("a container of MiniProf", complaint("rail", ".mpt", "x"), {".ban or .whl"});
    says("slices of a wheel", complaint("wheel", ".slcw", "SLICES\n2\n"), {"slices", "not available"});
    says("a spreadsheet", complaint("rail", ".txt", std::string("PK\x03\x04")), {"spreadsheet"});
    says("a file of zeros", complaint("rail", ".txt", std::string("1 2\n\0\0", 6)), {"no text"});
    says("a name in .prr that is not known", complaint("rail", ".prr", "scale.y = 2\npoint.begin\n"),
         {"line 1", "'scale.y' is not known"});
    says("a smoothing in .prr", complaint("rail", ".prr", "approx.smooth = 0.5\npoint.begin\n"),
         {"line 1", "approx.smooth", "Smoothing length"});
    says("a wheel's .prr for a rail", complaint("rail", ".prr", "header.begin\ntype = 1\nheader.end\n"),
         {"line 2", "a rail is needed"});
    says("a .ban that is cut off", complaint("rail", ".ban", "XYPoints=99\n\n-1 0\n0 0\n1 0\n2 0\n"),
         {"4 points", "'XYPoints' is 99"});
    says("two measurements in a .ban", complaint("rail", ".ban", "A=1\n\n-1 0\n0 0\nA=2\n"),
         {"line 5", "another measurement"});
  }
} // namespace geometry_surfaces

TREAD_TEST(geometry_surfaces)(tests::Check &check, const tests::Arguments &)
{
  check_treads(check);
  check_first_contact(check);
  check_defects(check);
  check_height_map(check);
  check_hdf5_map(check);
  check_long_defects(check);
  check_headers(check);
  check_rim_face(check);
  check_files(check);
}
