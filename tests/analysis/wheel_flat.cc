// SPDX-License-Identifier: LGPL-2.1-or-later
// Wheels that are not round: scans, flats and waves against closed forms, and scans that no wheel can have.
#include <tread/analysis/wheelset_contact.h>
#include <tread/base/input_error.h>
#include <tread/geometry/patch_surfaces.h>
#include <tread/geometry/wheel_deviation.h>

#include "check.h"
#include "temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace tread;

namespace analysis_wheel_flat
{
  ProfileCurve cylinder()
  {
    return wheel_curve("cylinder");
  }

  constexpr double radius = 0.46, pi = std::numbers::pi, degree = pi / 180.;

  /// @param dz in m of the angle in rad and of y in m
  template <typename Function>
  DeviationLines lines(const double begin, const double end, const unsigned int n, const Function &dz)
  {
    DeviationLines scan{"scan of the test", {}, {}, {}};
    for (int k = -10; k <= 10; ++k)
      scan.y.push_back(3e-3 * k);
    for (unsigned int i = 0; i <= n; ++i)
      {
        scan.angles.push_back(begin + (end - begin) * i / n);
        scan.dz.emplace_back();
        for (const double y : scan.y)
          scan.dz.back().push_back(dz(scan.angles.back(), y));
      }
    return scan;
  }

  /// A flat of 0.8 mm that leaves its middle as a parabola and ends with the slope 0.
  double bump(const double angle, const double y)
  {
    constexpr double half = 0.1;
    const double     u    = angle / half;
    return std::abs(u) < 1. ? -0.8e-3 * (1. + 0.3 * y / 30e-3) * std::pow(1. - u * u, 3.) : 0.;
  }

  void scan(tests::Check &check)
  {
    const ScannedDeviation table(lines(-0.12, 0.12, 48, bump), radius, 0.);
    double                 off = 0., by_angle = 0., by_y = 0.;
    for (const double angle : {-0.0512, 0.0333, 0.0871})
      for (const double y : {-22.3e-3, 1.1e-3, 20.4e-3})
        {
          constexpr double            h    = 1e-6;
          const WheelDeviation::Value here = table.at(angle, y);
          off                              = std::max(off, std::abs(here.dz - bump(angle, y)));
          by_angle =
            std::max(by_angle, std::abs(here.by_angle -
                                        (table.at(angle + h, y).dz - table.at(angle - h, y).dz) / (2. * h)));
          by_y = std::max(
            by_y, std::abs(here.by_y - (table.at(angle, y + h).dz - table.at(angle, y - h).dz) / (2. * h)));
        }
    check.below("between the lines, um", 1e6 * off, 0.1);
    check.below("derivative by the angle, um", 1e6 * by_angle, 1e-3);
    check.below("derivative by y", by_y, 1e-9);
    check.absolute("a turn further it is the same, um", 1e6 * table.at(0.03 + 6. * pi, 5e-3).dz,
                   1e6 * table.at(0.03, 5e-3).dz, 1e-6);
    check.absolute("nothing on the other side of the wheel", table.at(2., 0.).dz, 0., 0.);
    check.absolute("beside the lines it goes on level, um", 1e6 * table.at(0.03, 50e-3).dz,
                   1e6 * table.at(0.03, 30e-3).dz, 1e-6);
    check.absolute("its words give the depth, mm",
                   std::stod(table.in_words().substr(table.in_words().find("radius ") + 7)),
                   1e3 * -0.8e-3 * 1.3, 1e-3);

    // Waves around the wheel, and what smoothing over 20 mm leaves of them.
    const auto wavy = [](const double length) {
      return ScannedDeviation(lines(-pi, pi, 1444,
                                    [&](const double angle, double) {
                                      return 10e-6 * std::cos(2. * pi / length * radius * angle);
                                    }),
                              radius, 20e-3);
    };
    constexpr double around = 2. * pi * radius, wave = around / 145., long_wave = around / 36.;
    check.absolute("of waves of the smoothing's length half is left, um", 1e6 * wavy(wave).at(0., 0.).dz, 5.,
                   0.05);
    check.absolute("of waves four times as long all but 0.4 %, um", 1e6 * wavy(long_wave).at(0., 0.).dz,
                   10. / (1. + 1. / 256.), 0.05);
    check.that("its words say what it was smoothed over, those of a scan as it is nothing",
               wavy(wave).in_words().find(", smoothed over 20 mm") != std::string::npos &&
                 table.in_words().find("smoothed") == std::string::npos);
    // The same at the seam of a scan as on its other side, and where a scan ends as of one that goes on.
    const auto around_from = [&](const double begin) {
      const auto wrapped = [](const double angle, const double y) {
        return bump(std::remainder(angle, 2. * pi), y);
      };
      return ScannedDeviation(lines(begin, begin + 2. * pi * 1439. / 1440., 1439, wrapped), radius, 60e-3);
    };
    const ScannedDeviation seam = around_from(0.), whole = around_from(-pi),
                           part(lines(-0.105, 0.105, 48, bump), radius, 60e-3);
    for (const double angle : {-0.104, -0.02, 0., 0.03, 0.103})
      {
        check.absolute("smoothed over a seam on the flat, um", 1e6 * seam.at(angle, 5e-3).dz,
                       1e6 * whole.at(angle, 5e-3).dz, 0.1);
        check.absolute("smoothed at the end of a scan, um", 1e6 * part.at(angle, 5e-3).dz,
                       1e6 * whole.at(angle, 5e-3).dz, 2.);
      }
    check.below("smoothing leaves no step beyond a scan, um", 1e6 * part.at(0.35, 5e-3).dz, 1.);
  }

  WheelOnRail pair(const std::shared_ptr<const WheelDeviation> &deviation, const double of_radius = radius)
  {
    std::vector<dealii::Point<2>> crown;
    for (int i = -200; i <= 200; ++i)
      crown.emplace_back(0.3 * std::sin(5e-4 * i), 0.3 * (std::cos(5e-4 * i) - 1.));
    return {WheelSurface(wheel_curve("cylinder"), deviation),
            std::make_shared<PrismSurface>(ProfileCurve(crown)), of_radius, TrackGauge(),
            WheelOnRail::RailOrigin{0.75, 0.}};
  }

  WheelContact under_load(const WheelOnRail &surfaces, const double pitch)
  {
    WheelRolling rolling;
    rolling.wheel = rolling.rail = {210e9, 0.3};
    rolling.angular_velocity     = 1. / radius;
    rolling.element_x = rolling.element_y = 0.4e-3;
    WheelsetPosition position;
    position.pitch = pitch;
    return contact_under_load(surfaces, rolling, position, 80e3);
  }

  void contact(tests::Check &check)
  {
    const WheelContact round = under_load(pair({}), 0.);
    // An eccentric wheel is a round one whose middle lies beside its axle.
    constexpr double e = 0.5e-3, crest = 30. * degree;
    const auto       eccentric = pair(wheel_deviation("waves: 1=0.5@30", cylinder, radius, 0.));
    for (const double pitch : {-30. * degree, 60. * degree, 150. * degree})
      {
        const WheelContact here = under_load(eccentric, pitch);
        check.absolute("eccentric wheel: height of the axle, um",
                       1e6 * (here.position.height - round.position.height),
                       1e6 * e * std::cos(pitch + crest), 0.5);
        check.relative("largest pressure, Pa", here.patches.at(0).solution.max_pressure,
                       round.patches.at(0).solution.max_pressure, 3e-3);
        check.absolute("where it touches, mm", 1e3 * here.patches.at(0).region.reference[0],
                       1e3 * e * std::sin(pitch + crest), 5e-3);
      }
    // At the bottom of a long flat the curvature along x is 1/R - depth/2 (2 pi/length)^2: a bigger wheel.
    const auto flat =
      pair(wheel_deviation("flat: length_mm=400 depth_mm=1.2 angle_deg=-2", cylinder, radius, 0.));
    const WheelContact here = under_load(flat, 2. * degree);
    check.absolute("flat: where it touches, mm", 1e3 * here.patches.at(0).region.reference[0], 0., 0.02);
    const WheelContact bigger =
      under_load(pair({}, 1. / (1. / radius - 0.6e-3 * std::pow(2. * pi / 0.4, 2.))), 0.);
    check.relative("largest pressure on it, Pa", here.patches.at(0).solution.max_pressure,
                   bigger.patches.at(0).solution.max_pressure, 3e-3);
    check.absolute("the axle is as much lower, um", 1e6 * (here.position.height - bigger.position.height),
                   -1200., 0.5);
    // A map of zeros is no deviation.
    const WheelContact zero =
      under_load(pair(std::make_shared<ScannedDeviation>(
                   lines(-0.1, 0.1, 20, [](double, double) { return 0.; }), radius, 0.)),
                 0.);
    check.relative("a map of zeros: largest pressure, Pa", zero.patches.at(0).solution.max_pressure,
                   round.patches.at(0).solution.max_pressure, 1e-6);
    check.absolute("its height, nm", 1e9 * zero.position.height, 1e9 * round.position.height, 2.);
  }

  /// A cylinder on a flat rail that is narrower than it, and on one that is wider.
  void ends(tests::Check &check)
  {
    const auto on_flat = [](const double width) {
      std::vector<dealii::Point<2>> flat;
      for (int i = -10; i <= 10; ++i)
        flat.emplace_back(0.05 * i * width, 0.);
      return WheelOnRail(
        WheelSurface(wheel_curve("cylinder"), wheel_deviation("waves: 1=0.01@0", cylinder, radius, 0.)),
        std::make_shared<PrismSurface>(ProfileCurve(flat)), radius, TrackGauge(),
        WheelOnRail::RailOrigin{0.75, 0.});
    };
    // Looked at in 808 columns of 0.05 mm, of which there is an overlap in the last one as in the first.
    constexpr double  width  = 40.37e-3;
    const WheelOnRail narrow = on_flat(width);
    WheelsetPosition  sunk;
    sunk.height                                    = -0.1e-3;
    const std::vector<WheelOnRail::Region> regions = narrow.overlaps(sunk, 1e-3);
    if (check.absolute("narrow rail: overlaps", regions.size(), 1., 0.))
      {
        check.absolute("its width, mm", 1e3 * (regions[0].s_end - regions[0].s_begin), 1e3 * width, 0.05);
        check.absolute("its depth, um", 1e6 * regions[0].overlap, 110., 0.5);
      }
    const WheelOnRail   wide = on_flat(160e-3);
    WheelOnRail::Region all;
    all.s_end     = wide.wheel().length();
    all.reference = {{0., 0.75, 0.}};
    const PatchSurfaces heights(wide, {}, all);
    check.that("wide rail: the wheel ends where its profile does",
               heights.exists(0., 59.9e-3) && !heights.exists(0., 60.1e-3) && heights.exists(0., -69.9e-3) &&
                 !heights.exists(0., -70.1e-3));
  }

  void refusals(tests::Check &check)
  {
    const auto refused = [&](const std::string &what, const std::string &word, const auto &make) {
      const std::string said = tests::complaint<InputError>(make);
      check.that(what + ": \"" + said + "\"", said.find(word) != said.npos && said.find('\n') == said.npos);
    };
    const auto spoilt = [&](const std::string &what, const std::string &word, const auto &spoil) {
      DeviationLines scan = lines(-0.12, 0.12, 48, bump);
      spoil(scan);
      refused(what, word, [&] { ScannedDeviation(scan, radius, 0.); });
    };
    spoilt("lines out of order", "follow", [](DeviationLines &s) { std::swap(s.angles[3], s.angles[4]); });
    spoilt("degrees as radians", "more than once", [](DeviationLines &s) {
      for (double &angle : s.angles)
        angle /= degree;
    });
    spoilt("radians as degrees", "along the tread", [](DeviationLines &s) {
      for (double &angle : s.angles)
        angle *= degree;
    });
    spoilt("y in inches", "in mm?", [](DeviationLines &s) {
      for (double &y : s.y)
        y /= 25.4;
    });
    spoilt("a spike", "spike", [](DeviationLines &s) { s.dz[7][5] += 3e-3; });
    spoilt("too deep", "up to 20", [](DeviationLines &s) { s.dz[24][5] = -0.8; });
    spoilt("missing lines", "missing", [](DeviationLines &s) {
      s.angles.erase(s.angles.begin() + 20, s.angles.begin() + 30);
      s.dz.erase(s.dz.begin() + 20, s.dz.begin() + 30);
    });
    spoilt("a scan that ends on the flat", "round", [](DeviationLines &s) {
      s.angles.resize(30);
      s.dz.resize(30);
    });
    refused("a seam", "seam", [] {
      ScannedDeviation(lines(0., 2. * pi * 199. / 200., 199,
                             [](const double angle, double) { return 0.2e-3 * angle / (2. * pi); }),
                       radius, 0.);
    });
  }

  void files(tests::Check &check)
  {
    const tests::TemporaryFolder folder;
    const std::string            head = "angle_deg,y-20,y-10,y+0,y+10,y+20\n";
    std::string                  wide = head, tall = "angle_rad;y_mm;dz_mm\n";
    for (int i = -4; i <= 4; ++i)
      {
        const double dz = std::abs(i) < 4 ? -0.1 * (4 - std::abs(i)) : 0.;
        wide += std::to_string(i) + (dz == 0. ? ",0,0,0,0,0\n" : [&] {
                  std::string row;
                  for (int k = -2; k <= 2; ++k)
                    row += "," + std::to_string(dz * (1. + 0.1 * k));
                  return row + "\n";
                }());
        for (int k = -2; k <= 2; ++k)
          {
            std::string row = std::to_string(i * degree) + ";" + std::to_string(10 * k) + ";" +
                              std::to_string(dz * (1. + 0.1 * k)) + "\n";
            std::replace(row.begin(), row.end(), '.', ',');
            tall += row;
          }
      }
    const DeviationLines a = read_deviation_lines(folder.write("wide.csv", wide), cylinder),
                         b = read_deviation_lines(folder.write("tall.csv", tall), cylinder);
    check.that("nine lines of five places", a.dz.size() == 9 && a.y.size() == 5 && b.dz.size() == 9);
    double off = 0.;
    for (std::size_t i = 0; i < a.dz.size(); ++i)
      for (std::size_t j = 0; j < a.y.size(); ++j)
        off = std::max({off, std::abs(a.dz[i][j] - b.dz[i][j]), std::abs(a.y[j] - b.y[j]),
                        1e-3 * std::abs(a.angles[i] - b.angles[i])});
    check.below("the same from both kinds of tables, nm", 1e9 * off, 1.);
    check.absolute("dz at 1 degree, y = 20 mm, um", 1e6 * a.dz[5][4], -360., 1e-9);

    // Slices of CONTACT, z down: a cylinder whose radius is 0.1 mm less in the middle.
    for (const int k : {0, 1})
      {
        std::string text;
        for (int i = -30; i <= 30; ++i)
          text += std::to_string(i) + " " + (k == 1 ? "-0.1" : "0.0") + "\n";
        folder.write("slice" + std::to_string(k) + ".txt", text);
      }
    const auto list = [&](const char *method) {
      std::string text = std::string("0 0.5\n 7\n 0 0 0\n ") + method + "\n";
      for (int i = -3; i <= 3; ++i)
        text += std::to_string(0.02 * i) + (i == 0 ? " 'slice1.txt'\n" : " 'slice0.txt'\n");
      return read_deviation_lines(folder.write("wheel.slcw", text), cylinder);
    };
    const DeviationLines through = list("1"), beside = list("2");
    check.absolute("angles are scaled, rad", through.angles.back(), 0.03, 1e-12);
    check.absolute("splines through the slices, um", 1e6 * through.dz[3][5], -100., 1e-6);
    check.absolute("beside them: 2/3 in the middle, um", 1e6 * beside.dz[3][5], -200. / 3., 1e-6);
    check.absolute("and 1/6 next to it, um", 1e6 * beside.dz[4][5], -100. / 6., 1e-6);

    const auto refused = [&](const std::string &text, const std::string &word) {
      const std::string said =
        tests::complaint<InputError>([&] { wheel_deviation(text, cylinder, radius, 0.); });
      check.that("refused with '" + word + "': " + said,
                 said.find(word) != said.npos && said.find('\n') == said.npos);
    };
    refused(folder.write("inches.csv", "angle_deg,y_in,dz_in\n0,0,0\n"), "y_mm and dz_mm");
    refused(folder.write("short.csv", "angle_deg,y_mm,dz_mm\n0,0,0\n0,5,0\n1,0,0\n"), "1 places");
    refused(folder.write("other.csv", "angle_deg,y_mm,dz_mm\n0,0,0\n0,5,0\n1,0,0\n1,6,0\n"), "row 4");
    refused(folder.write("empty.csv", head), "no rows");
    refused(folder.path + "/missing.csv", "cannot read");
    refused(folder.path + "/wheel.txt", ".csv or .slcw");
    refused("flat: length_mm=50", "depth_mm is missing");
    refused("flat: length_mm=50 depth_mm=1 depth_mm=2", "twice");
    refused("flat: length_mm=50 depth_m=1", "not known");
    refused("flat: length_mm=50 depth_mm=-1", "allowed");
    refused("waves: 1000=1", "steep");
    refused("flat: length_mm=2 depth_mm=1", "steep");
    refused("waves: 2.5=0.1", "whole number");
    refused("waves:", "no wave");
  }
} // namespace analysis_wheel_flat


TREAD_TEST(analysis_wheel_flat)(tests::Check &check, const tests::Arguments &)
{
  scan(check);
  contact(check);
  ends(check);
  refusals(check);
  files(check);
}
