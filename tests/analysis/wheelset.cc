// SPDX-License-Identifier: LGPL-2.1-or-later
// A wheelset in any position: where it touches, how it rolls, its half-space answer; against closed forms.
#include <tread/analysis/wheelset_contact.h>
#include <tread/base/format.h>
#include <tread/geometry/contact_points.h>
#include <tread/geometry/patch_surfaces.h>
#include <tread/geometry/rail_profile.h>
#include <tread/geometry/wheel_tread.h>
#include <tread/reference/hertz.h>

#include "check.h"

#include <algorithm>
#include <cmath>

using namespace tread;

namespace analysis_wheelset
{
  constexpr double radius = 0.46;

  /// @param begin, end of the tread, mm
  ProfileCurve straight_cone(const double slope, const int begin = -60, const int end = 60)
  {
    std::vector<dealii::Point<2>> points;
    for (int i = begin; i <= end; ++i)
      points.emplace_back(1e-3 * i, slope * 1e-3 * i);
    return ProfileCurve(points);
  }

  /// Upper half of a circle, top at the origin.
  ProfileCurve round_rail(const double crown)
  {
    std::vector<dealii::Point<2>> points;
    const int                     n = 400;
    for (int i = -n; i <= n; ++i)
      {
        const double angle = 1.5 * i / n;
        points.emplace_back(crown * std::sin(angle), crown * (std::cos(angle) - 1.));
      }
    return ProfileCurve(points);
  }

  ProfileCurve rail_60e1(const double slope)
  {
    return rail_curve(RailProfile::rail_60e1()).turned(std::atan(slope));
  }

  WheelRolling rolling_at(const double angular_velocity)
  {
    WheelRolling rolling;
    rolling.wheel = rolling.rail = {210e9, 0.3};
    rolling.friction             = 0.3;
    rolling.speed                = 20.;
    rolling.angular_velocity     = angular_velocity;
    return rolling;
  }

  /// Curves of formulas: on the profile, and where they end.
  void check_curves(tests::Check &check)
  {
    const ProfileCurve s1002 = wheel_curve("S1002");
    double             worst = 0.;
    for (double s = 0.3e-3; s < s1002.length() - 0.1e-3; s += 0.037e-3)
      {
        const ProfileCurve::Place p = s1002.at(s);
        if (p.y > -69e-3)
          worst = std::max(worst, std::abs(p.z + s1002_offset(p.y)) * std::abs(p.dy));
      }
    // The points are exact. Beside the steps of the standard's own parts, up to 1.5e-4 mm, the spline swings
    // over.
    check.below("S1002 as a curve, off the formula, um", 1e6 * worst, 0.2);
    double lowest = 0.;
    for (double s = 0.; s < s1002.length(); s += 0.01e-3)
      lowest = std::min(lowest, s1002.at(s).z);
    check.absolute("its flange, mm", 1e3 * lowest, -28., 1e-6);

    const CurveFromAbove upright(rail_60e1(0.));
    const RailProfile    profile = RailProfile::rail_60e1();
    worst                        = 0.;
    for (double y = -35.5e-3; y < 35.5e-3; y += 0.1e-3)
      worst =
        std::max(worst, std::abs(upright.height(y) - profile.z_top(y)) / std::hypot(1., upright.slope(y)));
    check.below("60E1 as a curve, off the arcs, um", 1e6 * worst, 0.02);
    check.relative("radius of its crown, mm", upright.curve().radius(upright.parameter(2e-3)), 0.3, 1e-4);
    check.relative("and of its gauge corner", upright.curve().radius(upright.parameter(-33e-3)), 13e-3, 1e-3);

    const ProfileCurve cone = wheel_curve("cone 1:40");
    worst                   = 0.;
    for (double s = 0.5e-3; s < cone.length() - 0.5e-3; s += 0.05e-3)
      {
        const auto turn = [&](const double at) {
          const ProfileCurve::Place p = cone.at(at);
          return std::atan2(p.dz, p.dy);
        };
        worst = std::max(worst, std::abs(turn(s + 0.05e-3) - turn(s)));
      }
    // An arc of 12 mm turns by 0.05/12 over that length; a kink would turn by more.
    check.below("cone with flange: largest turn in 0.05 mm, rad", worst, 0.05 / 12. * 1.3);
  }

  /// Cones on rails with round crowns: conicity gamma (l + R gamma)/(l - r gamma), l half of the distance of
  /// the contact points, R that of the crown, r that of the wheel (Wickens 2003, chapter 2).
  void check_conicity(tests::Check &check)
  {
    for (const double slope : {1. / 40., 1. / 20.})
      for (const double crown : {20e-3, 300e-3})
        {
          const WheelOnRail      surfaces(straight_cone(slope), round_rail(crown), radius,
                                          {1.46, std::min(14e-3, 0.01 * crown), 1.36, -70e-3});
          const TouchingWheelset middle = touching_wheelset(surfaces, {});
          const double           l      = middle.own.y;
          check.below("cone in the middle: radius difference, nm", 1e9 * middle.radius_difference(), 1e-3);
          const double     shift = 1e-3;
          WheelsetPosition position;
          position.shift                = shift;
          const TouchingWheelset beside = touching_wheelset(surfaces, position);
          const double           r      = middle.own.rolling_radius;
          const double           flat   = std::atan(slope); // the formulas' angle
          check.relative("cone: radius difference over 2 y", beside.radius_difference() / (2. * shift),
                         slope * (l + crown * flat) / (l - r * flat), 5e-5);
          check.relative("cone: roll, mrad", 1e3 * beside.position.roll, -1e3 * flat * shift / (l - r * flat),
                         2e-3);
          std::vector<double> shifts, differences;
          for (int i = -4; i <= 4; ++i)
            {
              position.shift = 1e-3 * i;
              shifts.push_back(position.shift);
              differences.push_back(touching_wheelset(surfaces, position).radius_difference());
            }
          check.relative("cone: equivalent conicity at 3 mm", harmonic_conicity(shifts, differences, 3e-3),
                         beside.radius_difference() / (2. * shift), 1e-3);
        }
  }

  /// Cones so narrow that they leave their rails on the way to both sides: conicities of smaller amplitudes
  /// are those of wide ones, of larger ones there are none.
  void check_conicity_beyond_reach(tests::Check &check)
  {
    constexpr double largest = 8e-3, smaller = 3e-3;
    const auto       on_rail = [](const ProfileCurve &cone) {
      return WheelOnRail(cone, round_rail(300e-3), radius, {1.46, 3e-3, 1.36, -70e-3});
    };
    const WheelOnRail       whole  = on_rail(straight_cone(1. / 20.));
    const int               middle = std::lround(1e3 * touching_wheelset(whole, {}).own.wheel_y);
    const WheelOnRail       cut    = on_rail(straight_cone(1. / 20., middle - 5, middle + 5));
    const RadiusDifferences narrow({cut, cut}, {}, largest), wide({whole, whole}, {}, largest);
    check.relative("narrow cone: harmonic conicity at 3 mm", narrow.harmonic(smaller), wide.harmonic(smaller),
                   1e-6);
    check.relative("narrow cone: equivalent conicity at 3 mm", narrow.motion().conicity(smaller),
                   wide.motion().conicity(smaller), 1e-6);
    check.that("narrow cone: none where it has left the rail",
               std::isnan(narrow.harmonic(largest)) && std::isnan(narrow.motion().conicity(largest)) &&
                 !std::isnan(wide.harmonic(largest)));
  }

  /// Radius differences and conicities that EN 15302:2008+A1:2010 tabulates for reference combination E.1, in
  /// steps of 0.1 mm and with three decimals.
  const std::vector<double> tabulated_mm{
    0.,    0.032, 0.051, 0.071, 0.092, 0.116, 0.142, 0.167, 0.197, 0.227, 0.257, 0.292, 0.328, 0.361,
    0.402, 0.443, 0.481, 0.527, 0.574, 0.616, 0.667, 0.719, 0.766, 0.822, 0.879, 0.931, 0.992, 1.055,
    1.111, 1.177, 1.236, 1.299, 1.346, 1.407, 1.471, 1.539, 1.598, 1.673, 1.752, 1.834, 1.906, 1.995,
    2.088, 2.185, 2.286, 2.373, 2.481, 2.593, 2.709, 2.808, 2.931, 3.058, 3.189, 3.324, 3.44,  3.582,
    3.729, 3.879, 4.008, 4.166, 4.328, 4.494, 4.636, 5.064, 5.692, 6.521, 7.597, 9.01,  10.954};
  const std::vector<std::pair<double, double>> tabulated_conicities{
    {1., 0.125}, {2., 0.155}, {3., 0.188}, {4., 0.216}, {5., 0.254}, {6., 0.303}, {6.5, 0.348}, {6.8, 0.427}};


  /// A reference combination of EN 15302:2008+A1:2010, Annex E: radius differences in mm from shift 0 on, in
  /// steps of 0.1 mm, of like wheels of 920 mm; and the conicities that the standard gives for them, and for
  /// a right wheel of 920 beside a left one of 918 mm, by the amplitude in mm.
  struct ReferenceCombination
  {
    std::string                            like, unlike;
    std::vector<double>                    differences_mm;
    std::vector<std::pair<double, double>> conicities, conicities_unlike;
  };

  std::vector<ReferenceCombination> reference_combinations()
  {
    std::vector<ReferenceCombination> all;
    all.push_back({"E.1",
                   "E.5",
                   tabulated_mm,
                   tabulated_conicities,
                   {{1., 0.280}, {2., 0.272}, {3., 0.261}, {4., 0.269}, {5., 0.307}}});
    // Cones of 1:40, which a second contact ends: there the radius jumps from one row to the next.
    std::vector<double> b, h, cylinder(18, 0.);
    for (int i = 0; i < 30; ++i)
      b.push_back(5e-3 * i);
    for (const double value :
         {1.95,  2.003, 2.057, 2.112, 2.167, 2.224, 2.281, 2.339, 2.397, 2.457, 2.517, 2.578, 2.64,
          2.702, 2.766, 2.83,  2.895, 2.961, 3.027, 3.095, 3.163, 3.232, 3.302, 3.372, 3.444, 3.516,
          3.589, 3.663, 3.737, 3.813, 3.889, 3.966, 4.044, 4.123, 5.392, 6.111, 7.05,  8.27,  9.895})
      b.push_back(value);
    all.push_back({"E.2",
                   "E.6",
                   b,
                   {{1., 0.025}, {2., 0.025}, {3., 0.058}, {4., 0.241}, {5., 0.283}, {6., 0.302}},
                   {{1., 0.660}, {2., 0.376}, {3., 0.278}, {4., 0.227}, {5., 0.295}}});
    for (int i = 0; i < 26; ++i)
      h.push_back(5e-3 * i);
    for (int i = 26; i < 68; ++i)
      h.push_back(2.407 + 22.5e-3 * (i - 26));
    h.push_back(11.216);
    all.push_back({"E.3",
                   "E.7",
                   h,
                   {{1., 0.025}, {2., 0.025}, {3., 0.245}, {4., 0.319}, {5., 0.306}, {6., 0.284}},
                   {{1., 0.712}, {2., 0.381}, {3., 0.270}, {4., 0.217}, {5., 0.275}}});
    // Cylinders in the middle: nothing steers there.
    for (const double value :
         {2.344, 2.404, 2.465, 2.528, 2.591, 2.654, 2.719, 2.784, 2.851, 2.918, 2.985, 3.054, 3.123, 3.194,
          3.265, 3.336, 3.409, 3.483, 3.557, 3.632, 3.708, 3.785, 3.862, 3.941, 4.02,  4.1,   4.181, 4.263,
          4.345, 4.429, 4.513, 4.598, 4.684, 4.742, 4.771, 4.8,   4.829, 4.859, 4.888, 4.917, 4.947, 4.977,
          5.036, 5.066, 5.096, 5.127, 5.157, 5.187, 5.453, 6.053, 6.849, 7.884, 9.237, 11.079})
      cylinder.push_back(value);
    all.push_back({"E.4",
                   "E.8",
                   cylinder,
                   {{1., 0.}, {1.9, 0.208}, {2., 0.293}, {3., 0.489}, {4., 0.485}, {5., 0.475}, {6., 0.447}},
                   {{1., 0.780}, {2., 0.418}, {3., 0.449}, {4., 0.479}, {5., 0.458}, {6., 0.497}}});
    return all;
  }

  /// Unlike profiles, combination E.9: the wheel of E.1 at the right, that of E.2 at the left, on the same
  /// rails; differences from a shift of -6.8 mm on in steps of 0.1 mm.
  const std::vector<double> unlike_profiles_mm{
    -9.964, -8.342, -7.124, -6.188, -5.472, -4.205, -4.129, -4.053, -3.979, -3.905, -3.832, -3.76,  -3.688,
    -3.618, -3.548, -3.479, -3.411, -3.344, -3.277, -3.212, -3.147, -3.083, -3.019, -2.957, -2.895, -2.834,
    -2.774, -2.715, -2.656, -2.598, -2.541, -2.485, -2.429, -2.375, -2.321, -2.267, -2.214, -2.163, -2.112,
    -0.308, -0.305, -0.302, -0.299, -0.295, -0.292, -0.288, -0.285, -0.282, -0.279, -0.275, -0.271, -0.268,
    -0.263, -0.26,  -0.256, -0.252, -0.248, -0.245, -0.241, -0.236, -0.232, -0.229, -0.224, -0.22,  -0.216,
    -0.21,  -0.206, -0.202, -0.182, -0.166, -0.146, -0.124, -0.104, -0.079, -0.052, -0.026, 0.004,  0.036,
    0.066,  0.102,  0.14,   0.174,  0.216,  0.258,  0.298,  0.344,  0.393,  0.437,  0.489,  0.542,  0.591,
    0.648,  0.707,  0.761,  0.823,  0.888,  0.946,  1.014,  1.075,  1.139,  1.189,  1.251,  1.318,  1.388,
    1.45,   1.527,  1.608,  1.692,  1.766,  1.858,  1.954,  2.053,  2.157,  2.246,  2.357,  2.471,  2.589,
    2.691,  2.817,  2.947,  3.08,   3.218,  3.336,  3.48,   3.629,  3.782,  3.913,  4.074,  4.239,  4.407,
    4.552,  4.982,  5.613,  6.444,  7.523,  8.938,  10.884};

  /// The nine combinations of reference profiles: like wheels, unlike diameters, unlike profiles. The
  /// standard allows 0.05; its third decimals come out.
  void check_reference_combinations(tests::Check &check)
  {
    constexpr double digits   = 9e-4; // half of the last one, and what the last digits of differences move
    const auto       conicity = [&](const std::string &name, const LateralMotion &motion,
                              const std::vector<std::pair<double, double>> &conicities) {
      for (const auto &[amplitude, value] : conicities)
        check.absolute("EN 15302, " + name + ": conicity at " + format("%.1f mm", amplitude),
                             motion.conicity(1e-3 * amplitude), value, digits);
    };
    for (const ReferenceCombination &reference : reference_combinations())
      {
        std::vector<double> shifts, differences, of_unlike;
        const int           n = reference.differences_mm.size() - 1;
        for (int i = -n; i <= n; ++i)
          {
            shifts.push_back(1e-4 * i);
            differences.push_back(1e-3 * std::copysign(reference.differences_mm[std::abs(i)], i));
            of_unlike.push_back(differences.back() + 1e-3); // half of 2 mm of diameter
          }
        conicity(reference.like, {shifts, differences}, reference.conicities);
        conicity(reference.unlike, {shifts, of_unlike}, reference.conicities_unlike);
      }
    std::vector<double> shifts, differences;
    for (unsigned int i = 0; i < unlike_profiles_mm.size(); ++i)
      {
        shifts.push_back(1e-4 * (static_cast<int>(i) - 68));
        differences.push_back(1e-3 * unlike_profiles_mm[i]);
      }
    conicity("E.9", {shifts, differences},
             {{1., 0.137}, {2., 0.104}, {3., 0.132}, {4., 0.225}, {5., 0.271}, {6., 0.307}});
  }

  /// @param beside by how much the table is moved, m
  LateralMotion standard_motion(const double beside = 0., const double factor = 1.)
  {
    std::vector<double> shifts, differences;
    const int           n = tabulated_mm.size() - 1;
    for (int i = -n; i <= n; ++i)
      {
        shifts.push_back(1e-4 * i + beside);
        differences.push_back(factor * std::copysign(1e-3 * tabulated_mm[std::abs(i)], i));
      }
    return {shifts, differences};
  }

  void check_lateral_motion(tests::Check &check)
  {
    const LateralMotion standard = standard_motion(), beside = standard_motion(0.4e-3),
                        away = standard_motion(0., -1.);
    for (const auto &[amplitude, conicity] : tabulated_conicities)
      {
        const std::string at = format(" at %.1f mm", amplitude);
        // half of the last digit, and as much for the digits of the differences
        check.absolute("EN 15302, E.1: conicity" + at, standard.conicity(1e-3 * amplitude), conicity, 6e-4);
        check.relative("unlike sides: the motion is about its equilibrium" + at,
                       beside.conicity(0.999e-3 * amplitude), standard.conicity(0.999e-3 * amplitude), 1e-6);
        check.relative("a difference that drives outwards: negative" + at, away.conicity(1e-3 * amplitude),
                       -standard.conicity(1e-3 * amplitude), 1e-9);
      }
    check.absolute("unlike sides: shift of equal radii, mm", 1e3 * beside.equilibrium(), 0.4, 1e-9);
    check.that("no conicity beyond the table", std::isnan(standard.conicity(6.9e-3)) &&
                                                 std::isnan(beside.conicity(6.81e-3)) &&
                                                 std::isnan(standard.conicity(0.)));
    // Cones on one side, cylinders on the other, and wheels of unlike radius: straight lines.
    const LateralMotion cone({-5e-3, 0., 5e-3}, {-5e-3 * 0.1 + 2e-4, 2e-4, 5e-3 * 0.1 + 2e-4});
    check.absolute("unlike radii: shift of equal radii, mm", 1e3 * cone.equilibrium(), -2., 1e-9);
    check.relative("unlike radii on cones: conicity", cone.conicity(2.9e-3), 0.05, 1e-6);
    check.that("unlike radii: the table ends first at one side", std::isnan(cone.conicity(3.1e-3)));
    const LateralMotion none({-1e-3, 0., 1e-3}, {0., 0., 0.}), apart({-1e-3, 1e-3}, {1e-4, 1e-4});
    check.that("cylinders: no conicity", none.conicity(0.5e-3) == 0. && std::isnan(none.conicity(1.5e-3)));
    check.that("no shift of equal radii",
               std::isnan(apart.equilibrium()) && std::isnan(apart.conicity(0.5e-3)));
    // Steeper beyond 1 mm: by hand, half a period is that of a sine, and arcs of the steeper one.
    const double        a = 0.05, b = 0.2, y0 = 1e-3, y1 = 2e-3;
    const LateralMotion bent({-y1, -y0, y0, y1}, {-2. * (a * y0 + b * (y1 - y0)), -2. * a * y0, 2. * a * y0,
                                                  2. * (a * y0 + b * (y1 - y0))});
    const double        w = std::sqrt(2. * a), u = std::sqrt(2. * b), centre = y0 - a / b * y0,
                 v1    = u * std::sqrt((y1 - centre) * (y1 - centre) - (y0 - centre) * (y0 - centre)),
                 inner = std::atan(w * y0 / v1) / w, outer = std::acos((y0 - centre) / (y1 - centre)) / u;
    check.relative("differences with a bend: conicity", bent.conicity(y1),
                   dealii::numbers::PI * dealii::numbers::PI / 8. / ((inner + outer) * (inner + outer)),
                   1e-5);
  }

  /// Contact points of unlike sides, and without roll, beside those of like ones.
  void check_unlike_sides(tests::Check &check)
  {
    const TrackGauge  gauge{1.46, 3e-3, 1.36, -70e-3};
    const WheelOnRail steep(straight_cone(0.05), round_rail(300e-3), radius, gauge),
      flat(straight_cone(0.025), round_rail(300e-3), radius, gauge),
      larger(straight_cone(0.05), round_rail(300e-3), radius + 1e-3, gauge);
    WheelsetPosition position;
    position.shift = 2e-3;
    // Without roll each wheel stands where its cone touches the crown, whatever the shift.
    const auto on_wheel = [](const WheelOnRail &side, const double slope) {
      return side.rail_origin_y() - 300e-3 * std::sin(std::atan(slope)) - side.wheel_origin_y();
    };
    const TouchingWheelset level = touching_wheelset({steep, flat}, position, Roll::none);
    check.relative("without roll, unlike cones: radius difference, um", 1e6 * level.radius_difference(),
                   1e6 * (0.05 * (position.shift - on_wheel(steep, 0.05)) +
                          0.025 * (position.shift + on_wheel(flat, 0.025))),
                   2e-3);
    check.absolute("without roll: roll, mrad", 1e3 * level.position.roll, 0., 0.);
    const TouchingWheelset like    = touching_wheelset({steep, steep}, position, Roll::none),
                           shifted = touching_wheelset({larger, steep}, position, Roll::none);
    check.absolute("without roll, unlike radii: added to the difference, mm",
                   1e3 * (shifted.radius_difference() - like.radius_difference()), 1., 1e-6);
    const TouchingWheelset rolled = touching_wheelset({larger, steep}, position);
    check.absolute("with roll, unlike radii: roll, mrad",
                   1e3 * (rolled.position.roll - touching_wheelset(steep, position).position.roll),
                   -1. / (rolled.own.y + rolled.other.y - 2. * radius * std::atan(0.05)), 2e-3);
    check.relative("with roll, both sides by themselves",
                   touching_wheelset({steep, steep}, position).radius_difference(),
                   touching_wheelset(steep, position).radius_difference(), 1e-12);
  }

  /// A yawed cylinder: lateral creepage -2 tan(yaw/2); a cone: spin sin(angle)/r; and forces by Hertz.
  void check_rolling(tests::Check &check)
  {
    const WheelOnRail  cylinder(wheel_curve("cylinder"), rail_60e1(0.), radius, {});
    const double       speed = 20., yaw = 0.02;
    const WheelContact yawed =
      contact_under_load(cylinder, rolling_at(speed / radius), {0., yaw, 0., 0.}, 100e3);
    check.that("one patch", yawed.patches.size() == 1);
    const WheelPatch &patch = yawed.patches[0];
    check.absolute("yawed cylinder: x of the contact, mm", 1e3 * patch.region.reference[0],
                   -1e3 * cylinder.rail_origin_y() * std::tan(yaw), 1e-6);
    check.relative("lateral creepage, 1e-3", 1e3 * patch.lateral_creepage, -2e3 * std::tan(0.5 * yaw), 1e-9);
    check.relative("vertical force, kN", 1e-3 * yawed.force[2], 100., 1e-6);
    check.relative("all slides: force over friction bound",
                   std::hypot(patch.solution.lateral_force, patch.solution.longitudinal_force) / 30e3, 1.,
                   3e-4);
    check.that("against the slip, to the own side", patch.solution.lateral_force > 29e3);

    const WheelContact straight = contact_under_load(cylinder, rolling_at(speed / radius), {}, 100e3);
    const auto         pair     = reference::combine({210e9, 0.3}, {210e9, 0.3});
    const auto         hertz = reference::hertz_ellipse(0.5 / radius, 0.5 / 0.3, pair.hertz_modulus(), 100e3);
    // 60 x 40 elements along the patch; the crown's arc of 300 mm ends 10.2 mm beside the middle, where the
    // patch is not.
    check.relative("upright cylinder: largest pressure, MPa",
                   1e-6 * straight.patches[0].solution.max_pressure, 1e-6 * hertz.max_pressure, 1e-3);
    check.relative("overlap = approach, um", 1e6 * straight.patches[0].region.overlap, 1e6 * hertz.approach,
                   3e-4);

    for (const double slope : {1. / 40., 1. / 20.})
      {
        const WheelOnRail  cone(straight_cone(slope), rail_60e1(slope), radius, {});
        const WheelContact contact = contact_under_load(cone, rolling_at(speed / radius), {}, 100e3);
        const WheelPatch  &p       = contact.patches[0];
        check.absolute("cone: contact angle, mrad", 1e3 * p.angle(), 1e3 * std::atan(slope), 0.01);
        check.relative("cone: spin, 1/m", p.spin, -std::sin(p.angle()) * (speed / radius) / p.rolling_speed,
                       1e-12);
        check.relative("which is sin(angle)/r, 1/m", p.spin, -std::sin(std::atan(slope)) / radius, 3e-4);
        check.below("cone: creepage, 1e-6",
                    1e6 * (p.creepage - (speed - speed / radius * p.rolling_radius) / p.rolling_speed), 1e-6);
        // On a cone the slip over the patch is linear: both ways are one.
        WheelRolling plane          = rolling_at(speed / radius);
        plane.slip_follows_surface  = false;
        const WheelContact as_plane = contact_under_load(cone, plane, {}, 100e3);
        check.absolute("cone: lateral force by both ways of slip, N", contact.force[1], as_plane.force[1],
                       0.02);
      }
  }

  /// The mirror image about the plane y = 0 of the wheel: a symmetric pair yawed to either side.
  void check_mirror(tests::Check &check)
  {
    const WheelOnRail  cylinder(wheel_curve("cylinder"), rail_60e1(0.), radius, {});
    const WheelRolling rolling = rolling_at(20. / radius * 1.001);
    const WheelContact to_own  = contact_under_load(cylinder, rolling, {0., 0.5e-3, 0., 0.}, 80e3),
                       away    = contact_under_load(cylinder, rolling, {0., -0.5e-3, 0., 0.}, 80e3);
    check.relative("mirror: longitudinal force", to_own.force[0], away.force[0], 5e-8);
    check.relative("mirror: lateral force", to_own.patches[0].solution.lateral_force,
                   -away.patches[0].solution.lateral_force, 1e-8);
    const WheelOnRail      s1002(wheel_curve("S1002"), rail_60e1(1. / 40.), radius, {});
    const TouchingWheelset right = touching_wheelset(s1002, {3e-3, 5e-3, 0., 0.}),
                           left  = touching_wheelset(s1002, {-3e-3, -5e-3, 0., 0.});
    check.below("mirror: rolling radius of the other wheel, mm",
                1e3 * (right.own.rolling_radius - left.other.rolling_radius), 1e-10);
    check.below("mirror: roll, mrad", 1e3 * (right.position.roll + left.position.roll), 1e-10);
  }

  void check_two_patches(tests::Check &check)
  {
    // At the lateral shift at which the contact jumps from the tread to the flange both touch, and under load
    // both carry: each its own force, in sum the load.
    const WheelOnRail cone(wheel_curve("cone 1:40"), rail_60e1(1. / 40.), radius, {});
    const auto        on_flange = [&](const double shift) {
      return cone.wheel().at(cone.nearest({shift, 0., 0., 0.}).point.s).y < -25e-3;
    };
    double on_tread = 0., beyond = 8e-3;
    check.that("on the tread in the middle, on the flange 8 mm beside it",
               !on_flange(on_tread) && on_flange(beyond));
    for (unsigned int i = 0; i < 30; ++i)
      {
        const double middle                     = 0.5 * (on_tread + beyond);
        (on_flange(middle) ? beyond : on_tread) = middle;
      }
    const WheelContact contact =
      contact_under_load(cone, rolling_at(20. / radius), {beyond, 0., 0., 0.}, 60e3);
    if (!check.that("two patches", contact.patches.size() == 2))
      return;
    const WheelPatch &flange = contact.patches[0], &tread = contact.patches[1];
    check.absolute("angle on the flange, degrees", 180. / M_PI * flange.angle(), 70., 0.2);
    check.absolute("angle on the tread, degrees", 180. / M_PI * tread.angle(), 180. / M_PI / 40., 0.01);
    check.relative("their vertical forces add to the load, kN", 1e-3 * (flange.force()[2] + tread.force()[2]),
                   60., 2e-6);
    // Each is a force on a half-space that the other one stands on, as far as both press in the same
    // direction.
    const double way = std::hypot(flange.region.reference[0] - tread.region.reference[0],
                                  flange.region.reference[1] - tread.region.reference[1],
                                  flange.region.reference[2] - tread.region.reference[2]);
    check.relative("tread sinks under the flange, um", 1e6 * tread.sink_by_others,
                   1e6 * (1. - 0.3 * 0.3) / (M_PI * 210e9) * 2. * flange.solution.normal_force *
                     std::cos(flange.angle() - tread.angle()) / way,
                   1e-6);
    check.that("and both press", flange.solution.normal_force > 1e3 && tread.solution.normal_force > 1e3);
  }

  /// A profile as an instrument gives it, a point every quarter of a millimetre, worn by so much about y.
  ProfileCurve worn(const ProfileCurve &curve, const double depth, const double y, const double width)
  {
    std::vector<dealii::Point<2>> points;
    for (double s = 0.; s < curve.length(); s += 0.25e-3)
      {
        const ProfileCurve::Place p    = curve.at(s);
        const double              wear = depth * std::exp(-std::pow((p.y - y) / width, 2.));
        points.emplace_back(p.y - wear * p.dz / std::hypot(p.dy, p.dz),
                            p.z + wear * p.dy / std::hypot(p.dy, p.dz));
      }
    return ProfileCurve(points);
  }

  /// Worn wheel on worn rail, at the flange root: an answer for each load, which changes steadily.
  void check_worn(tests::Check &check)
  {
    const WheelOnRail surfaces(worn(wheel_curve("S1002"), 0.3e-3, -38e-3, 6e-3),
                               worn(rail_60e1(1. / 40.), -0.5e-3, -28e-3, 8e-3), radius, {});
    WheelRolling      rolling = rolling_at(1.002 * 20. / radius);
    rolling.separation        = 6e-3;
    rolling.element_x         = 0.4e-3;
    rolling.element_y         = 0.3e-3;
    double before             = 1e3;
    for (const double load : {55., 105., 130.})
      {
        const std::string name   = "worn profiles, " + std::to_string(std::lround(load)) + " kN: ";
        const auto        answer = [&](const double force) {
          return contact_under_load(surfaces, rolling, {6.9e-3, 3e-3, 0., 0.}, 1e3 * force);
        };
        const WheelContact contact = answer(load), more = answer(1.0005 * load);
        check.relative(name + "vertical force, kN", 1e-3 * contact.force[2], load, 1e-4);
        check.that(name + "lower than under a smaller load", contact.position.height < before);
        before                      = contact.position.height;
        const reference::Grid &grid = contact.patches[0].solution.grid;
        check.relative(name + "length of an element, mm", 1e3 * grid.dx, 0.4, 1e-12);
        check.relative(name + "width of an element, mm", 1e3 * grid.dy, 0.3, 1e-12);
        check.that(name + "as many patches under a little more",
                   contact.patches.size() == more.patches.size());
        check.relative(name + "largest pressure under a little more, MPa",
                       1e-6 * more.patches[0].solution.max_pressure,
                       1e-6 * contact.patches[0].solution.max_pressure, 0.01);
      }

    // Heights over the plane of a patch are those of the surface itself, in front and behind, at all angles.
    const WheelsetPosition position{6.9e-3, 3e-3, -1e-3, 0.4e-3};
    const auto             regions = surfaces.overlaps(position, 0.);
    check.that("the flange root overlaps", !regions.empty());
    double off = 0., far = 0., off_rail = 0.;
    for (const WheelOnRail::Region &region : regions)
      {
        const PatchSurfaces heights(surfaces, position, region);
        for (const double x : {-9e-3, 0., 7e-3})
          for (const double s : {-2e-3, -0.3e-3, 1.1e-3})
            {
              const PatchSurfaces::WheelPlace at = heights.wheel(x, s);
              const Vector3d place               = surfaces.surface(position, at.profile_s, at.angle).place;
              off =
                std::max({off, std::abs(place[0] - region.reference[0] - x),
                          std::abs(heights.along(place) - s), std::abs(heights.above(place) - at.height)});
              // The other surface is as high as the curve of the rail from above.
              Vector3d on_rail = region.reference;
              for (unsigned int d = 0; d < 3; ++d)
                on_rail[d] += s * heights.along()[d] + heights.rail(x, s).height * heights.normal()[d];
              off_rail = std::max(off_rail, std::abs(surfaces.rail().height(on_rail[1]) - on_rail[2]));
              far      = std::max(far, std::abs(heights.gap(x, s)));
            }
        check.that("nothing is known beyond the profile", !heights.exists(0., 0.2));
      }
    check.below("wheel over the plane: off the surface, nm", 1e9 * off, 0.01);
    check.below("rail over the plane: off the curve, nm", 1e9 * off_rail, 0.01);
    check.below("gap within 10 mm, mm", 1e3 * far, 5.);

    // A point that an instrument put back by 0.2 mm: the rail's own surface is the higher one there.
    std::vector<dealii::Point<2>> points;
    for (int i = -120; i <= 120; ++i)
      points.emplace_back(0.25e-3 * i, -std::pow(0.25e-3 * i, 2.) / 0.6);
    points.insert(points.begin() + 121, dealii::Point<2>(-0.2e-3, -2e-3));
    points.insert(points.end(), {dealii::Point<2>(33e-3, -10e-3), dealii::Point<2>(33e-3, -30e-3)});
    points.insert(points.begin(), {dealii::Point<2>(-33e-3, -30e-3), dealii::Point<2>(-33e-3, -10e-3)});
    const WheelOnRail   hooked(wheel_curve("cylinder"), ProfileCurve(points), radius, {});
    WheelOnRail::Region region;
    region.s_begin = region.s_end = 70e-3;
    region.reference              = {
                   {0., hooked.rail_origin_y() + 2e-3, hooked.rail().height(hooked.rail_origin_y() + 2e-3)}};
    const PatchSurfaces over(hooked, {}, region);
    check.absolute("rail that turns back: the surface that faces the wheel, um",
                   1e6 * (over.rail(0., -1e-3).height + region.reference[2]),
                   -1e6 * std::pow(1e-3, 2.) / 0.6 + 1e6 * hooked.rail_origin_z(), 15.);
  }

  /// Both wheels of a wheelset in the middle of its track: mirror images.
  void check_both_wheels(tests::Check &check)
  {
    const WheelOnRail cone(wheel_curve("cone 1:40"), rail_60e1(1. / 40.), radius, {});
    const BothWheels  both  = contact_of_both_wheels(cone, rolling_at(20. / radius), {}, 200e3);
    const WheelPatch &other = of_other_wheel(both.other).patches[0], &own = both.own.patches[0];
    check.absolute("both wheels: y of the other one, mm", 1e3 * other.region.reference[1],
                   -1e3 * own.region.reference[1], 1e-6);
    check.relative("both wheels: normal force of the other one, kN", 1e-3 * other.solution.normal_force,
                   1e-3 * own.solution.normal_force, 1e-8);
    check.that("both wheels: whose patch it is", other.is_of_other_wheel && !own.is_of_other_wheel);
  }

  /// A wheel that turns and tilts about its own middle, as an axle that twists and bends lets it.
  void check_flexible_axle(tests::Check &check)
  {
    constexpr double  speed = 20., spin = 0.05, tilt = 1e-3, rate = 0.02; // m/s, rad/s, rad, rad/s
    constexpr double  crown = 0.3, load = 80e3;
    const WheelOnRail cylinder(wheel_curve("cylinder"), rail_60e1(0.), radius, {});
    const double      lever = cylinder.wheel_origin_y();
    const auto        of    = [&](const WheelRolling &rolling, const WheelsetPosition &position = {}) {
      return contact_under_load(cylinder, rolling, position, load);
    };
    const auto with = [&](const WheelsetRates::AgainstLine &wheel) {
      WheelRolling rolling = rolling_at(speed / radius);
      rolling.own          = wheel;
      return of(rolling);
    };
    const WheelContact straight = of(rolling_at(speed / radius)), twisted = with({spin}),
                       turned = with({0., 0., tilt}), tilted = with({0., tilt}),
                       turning = with({0., 0., 0., 0., rate}), tilting = with({0., 0., 0., rate});
    const auto patch = [](const WheelContact &contact) -> const WheelPatch & {
      return contact.patches[0];
    };
    check.relative("twisting axle: creepage as that of a faster one, 1e-3", 1e3 * patch(twisted).creepage,
                   1e3 * patch(of(rolling_at(speed / radius + spin))).creepage, 1e-9);
    check.absolute("wheel turned on its axle: lateral creepage, 1e-3", 1e3 * patch(turned).lateral_creepage,
                   -2e3 * std::tan(0.5 * tilt), 1e-4);
    const WheelContact yawed = of(rolling_at(speed / radius), {0., tilt, 0., 0.});
    check.absolute("wheel turned on its axle: it is not behind, mm", 1e3 * patch(turned).region.reference[0],
                   1e3 * patch(yawed).region.reference[0] + 1e3 * lever * tilt, 1e-3);
    check.absolute("wheel turned on its axle: as ahead as the straight one, mm",
                   1e3 * patch(turned).region.reference[0], 1e3 * patch(straight).region.reference[0], 5e-3);
    check.absolute("tilted wheel: its contact moves by angle and crown, mm",
                   1e3 * (patch(tilted).region.reference[1] - patch(straight).region.reference[1]),
                   -1e3 * crown * tilt, 5e-3);
    const WheelContact rolled = of(rolling_at(speed / radius), {0., 0., -tilt, 0.});
    check.absolute("tilted wheel: its angle is that of an axle that rolls, mrad", 1e3 * patch(tilted).angle(),
                   1e3 * patch(rolled).angle(), 1e-2);
    check.absolute("tilted wheel: the axle is as high as with the straight one, um",
                   1e6 * (tilted.position.height - straight.position.height),
                   1e6 * (rolled.position.height - straight.position.height + lever * std::sin(tilt)), 1e-2);
    check.relative("turning wheel: spin, 1/m", patch(turning).spin - patch(straight).spin, rate / speed,
                   1e-3);
    const double beside = patch(straight).region.reference[1] - lever; // of the wheel's middle
    check.absolute("turning wheel: creepage, 1e-3", 1e3 * patch(turning).creepage,
                   -1e3 * rate * beside / speed, 1e-5);
    check.relative("tilting wheel: lateral creepage, 1e-3", 1e3 * patch(tilting).lateral_creepage,
                   1e3 * rate * radius / speed, 2e-3);

    // Wheels that do the same on both sides, and the other one alone.
    WheelRolling rolling  = rolling_at(speed / radius);
    rolling.own           = {spin, tilt, tilt, rate, rate};
    rolling.other         = rolling.own.mirrored();
    const BothWheels both = contact_of_both_wheels(cylinder, rolling, {}, 2. * load);
    check.relative("both wheels tilted: lateral force of the other one, N",
                   both.other.patches[0].solution.lateral_force, both.own.patches[0].solution.lateral_force,
                   1e-6);
    rolling.own          = {};
    const BothWheels one = contact_of_both_wheels(cylinder, rolling, {}, 2. * load);
    check.relative("the other wheel tilted alone: its lateral creepage, 1e-3",
                   1e3 * one.other.patches[0].lateral_creepage, 1e3 * both.other.patches[0].lateral_creepage,
                   1e-2);
    check.relative("the other wheel twisted alone: its creepage, 1e-3", 1e3 * one.other.patches[0].creepage,
                   1e3 * both.other.patches[0].creepage, 1e-2);
    check.below("and creepage of the own wheel, 1e-3", 1e3 * std::abs(one.own.patches[0].creepage), 0.1);
  }

  void check_friction_along_rail(tests::Check &check)
  {
    const WheelOnRail cylinder(wheel_curve("cylinder"), rail_60e1(0.), radius, {});
    constexpr double  yaw = 20e-3, slip = 0.01;
    WheelRolling      rolling  = rolling_at((1. + slip) * 20. / radius);
    const WheelPatch  at_wheel = contact_under_load(cylinder, rolling, {0., yaw, 0., 0.}, 80e3).patches[0];
    const double      ahead    = at_wheel.region.reference[0];
    rolling.friction_along     = [&](const double x) {
      reference::Friction friction;
      friction.friction = x < 0.5 * ahead ? 0.15 : 0.3;
      return friction;
    };
    const WheelPatch there = contact_under_load(cylinder, rolling, {0., yaw, 0., 0.}, 80e3).patches[0];
    const auto       force = [](const WheelPatch &patch) {
      return std::hypot(patch.solution.longitudinal_force, patch.solution.lateral_force) /
             patch.solution.normal_force;
    };
    check.that("yaw moves the contact behind the axle", ahead < -10e-3);
    check.relative("friction with the axle's friction", force(at_wheel), 0.3, 1e-3);
    check.relative("friction of the place where the patch is", force(there), 0.15, 1e-3);
  }

  void check_refusals(tests::Check &check)
  {
    const auto refuses = [&](const std::string &what, const std::string &words, const auto &call) {
      const std::string text = tests::complaint<std::runtime_error>(call);
      check.that(what + ": \"" + text + "\"",
                 text.find(words) != std::string::npos && text.find('\n') == std::string::npos);
    };
    const WheelOnRail s1002(wheel_curve("S1002"), rail_60e1(1. / 40.), radius, {});
    refuses("far to the other side", "falls between the rails", [&] { s1002.nearest({-90e-3, 0., 0., 0.}); });
    refuses("no rail at all", "do not meet", [&] { s1002.nearest({-0.3, 0., 0., 0.}); });
    refuses("a rail without flank", "gauge",
            [&] { WheelOnRail(wheel_curve("S1002"), straight_cone(0.), radius, {}); });
    refuses("a load that nothing carries", "carries",
            [&] { contact_under_load(s1002, rolling_at(40.), {}, 1e9); });
  }
} // namespace analysis_wheelset

TREAD_TEST(analysis_wheelset)(tests::Check &check, const tests::Arguments &)
{
  check_curves(check);
  check_conicity(check);
  check_conicity_beyond_reach(check);
  check_reference_combinations(check);
  check_lateral_motion(check);
  check_unlike_sides(check);
  check_rolling(check);
  check_mirror(check);
  check_two_patches(check);
  check_worn(check);
  check_both_wheels(check);
  check_flexible_axle(check);
  check_friction_along_rail(check);
  check_refusals(check);
}
