// SPDX-License-Identifier: LGPL-2.1-or-later
// Surfaces that change along the way: rails of slices and wheels that are not round, against closed forms.
#include <tread/analysis/wheelset_contact.h>
#include <tread/base/input_error.h>
#include <tread/geometry/patch_surfaces.h>
#include <tread/geometry/rail_slices.h>

#include "check.h"
#include "temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>

using namespace tread;

namespace analysis_crossing
{
  constexpr double radius = 0.46;
  constexpr double nan    = std::numeric_limits<double>::quiet_NaN();

  std::vector<dealii::Point<2>> arc(const double crown, const double half, const double top)
  {
    std::vector<dealii::Point<2>> points;
    constexpr int                 n = 200;
    for (int i = -n; i <= n; ++i)
      {
        const double angle = half * i / n;
        points.emplace_back(crown * std::sin(angle), crown * (std::cos(angle) - 1.) + top);
      }
    return points;
  }

  WheelSurface cylinder(std::shared_ptr<const WheelDeviation> deviation = {})
  {
    std::vector<dealii::Point<2>> points;
    for (int i = -60; i <= 60; ++i)
      points.emplace_back(1e-3 * i, 0.);
    return WheelSurface(ProfileCurve(points), std::move(deviation));
  }

  /// z over y = 0 along x.
  RailSlices slices(const std::vector<double> &x, const std::function<double(double)> &top)
  {
    RailSlices rail{"slices of the test", {}};
    for (const double at : x)
      rail.slices.push_back({at, arc(0.3, 0.1, top(at)), {}, {}});
    return rail;
  }

  WheelOnRail over(const WheelSurface &wheel, const std::shared_ptr<const Surface> &rail)
  {
    return {wheel, rail, radius, TrackGauge(), WheelOnRail::RailOrigin{0.75, 0.}};
  }

  const std::vector<double> places{-0.12, -0.1, -0.07, -0.03, -0.01, 0., 0.02, 0.05, 0.08, 0.12};


  void constant(tests::Check &check)
  {
    const auto             same   = std::make_shared<SlicedRail>(slices(places, [](double) { return 0.; }));
    const auto             prism  = std::make_shared<PrismSurface>(ProfileCurve(arc(0.3, 0.1, 0.)));
    const WheelOnRail      sliced = over(cylinder(), same), straight = over(cylinder(), prism);
    const WheelsetPosition position{1e-3, 2e-3, 1e-3, -40e-6};
    const auto             regions = straight.overlaps(position, 0.), found = sliced.overlaps(position, 0.);
    check.that("one overlap by outline and by lines", regions.size() == 1 && found.size() == 1);
    const PatchSurfaces one(sliced, position, regions[0]), other(straight, position, regions[0]);
    double              off = 0.;
    for (const double x : {-5e-3, 0., 3e-3})
      for (const double s : {-4e-3, 0.1e-3, 5e-3})
        off = std::max(off, std::abs(one.gap(x, s) - other.gap(x, s)));
    check.below("equal slices: gap beside that of the profile, nm", 1e9 * off, 0.1);
    for (const unsigned int d : {0, 1, 2})
      check.absolute("reference point by lines and by outline, um", 1e6 * found[0].reference[d],
                     1e6 * regions[0].reference[d], 2.);
    WheelRolling rolling;
    rolling.wheel = rolling.rail = {210e9, 0.3};
    rolling.friction             = 0.3;
    rolling.angular_velocity     = 1. / radius;
    const WheelContact a         = contact_under_load(sliced, rolling, position, 5e4),
                       b         = contact_under_load(straight, rolling, position, 5e4);
    check.absolute("depth under a load, um", -1e6 * a.position.height, -1e6 * b.position.height, 0.02);
    check.absolute("largest pressure, MPa", 1e-6 * a.patches.at(0).solution.max_pressure,
                   1e-6 * b.patches.at(0).solution.max_pressure,
                   2e-3 * 1e-6 * b.patches.at(0).solution.max_pressure);
  }


  void ramp(tests::Check &check)
  {
    // A wheel on a ramp of the slope a touches where its own slope is a: the height over the ramp's line is
    // R (sqrt(1 + a^2) - 1).
    constexpr double  slope = 0.05, at = 0.01;
    const auto        rail = std::make_shared<SlicedRail>(slices(places, [](double x) { return slope * x; }));
    const WheelOnRail pair = over(cylinder(), rail);
    WheelsetPosition  position;
    position.along                    = at;
    const WheelOnRail::Nearest touch  = pair.nearest(position);
    const double               height = slope * at + radius * (std::sqrt(1. + slope * slope) - 1.);
    check.absolute("height of a wheel on a ramp, um", -1e6 * touch.gap, 1e6 * height, 0.1);
    check.absolute("place where it touches, mm", 1e3 * touch.point.place[0],
                   1e3 * radius * slope / std::sqrt(1. + slope * slope), 0.2);
    const auto here = rail->height(at, 2e-3);
    check.absolute("slope of the surface along the way", here ? here->by_along : 0., slope, 1e-6);
    check.absolute("slope across", here ? here->by_y : 0., -2e-3 / std::sqrt(0.09 - 4e-6), 1e-6);
    check.that("nothing beyond the slices", !rail->height(0.13, 0.));
  }


  void parts(tests::Check &check)
  {
    // A wing, and a nose that begins at the third slice.
    RailSlices rail{"parts of the test", {}};
    for (const double x : {0., 0.01, 0.02, 0.03, 0.04})
      {
        RailSlice  slice{x, {}, {}, {}};
        const bool has_nose = x > 0.015;
        if (has_nose)
          for (int i = 0; i <= 40; ++i)
            slice.points.emplace_back(-40e-3 + 0.5e-3 * i, -1e-3 - 1e-6 * i * i);
        if (has_nose)
          for (int i = 1; i < 20; ++i)
            slice.points.emplace_back(-20e-3 + 1e-3 * i, -30e-3);
        const std::size_t before = slice.points.size();
        for (int i = 0; i <= 60; ++i)
          slice.points.emplace_back(0.5e-3 * i, 0.);
        slice.bodies.assign(slice.points.size(), "wing");
        std::fill(slice.bodies.begin(), slice.bodies.begin() + before, "nose");
        double length = 0.;
        slice.breaks  = {has_nose ? 0. : nan, nan, nan, nan};
        for (std::size_t k = 1; k < slice.points.size(); ++k)
          {
            length += slice.points[k].distance(slice.points[k - 1]);
            if (has_nose && k == 40)
              slice.breaks[1] = length;
            if (k == before)
              slice.breaks[2] = length;
          }
        if (!has_nose)
          slice.breaks[2] = 0.;
        slice.breaks[3] = length;
        rail.slices.push_back(slice);
      }
    const SlicedRail surface(rail);
    check.that("before its slice there is no nose",
               !surface.height(0.019, -30e-3) && surface.height(0.019, 10e-3));
    check.that("behind it there is", surface.height(0.021, -30e-3) && surface.height(0.021, 10e-3));
    check.that("names of bodies",
               surface.body(0.03, -30e-3) == "nose" && surface.body(0.03, 10e-3) == "wing");
    check.absolute("height of the nose, um",
                   1e6 * surface.height(0.025, -30e-3).value_or(Surface::Height{}).z, -1400., 0.5);
    const auto refused = [&](const std::string &what, const std::function<void(RailSlices &)> &spoil) {
      RailSlices other = rail;
      spoil(other);
      std::string said;
      try
        {
          const SlicedRail unused(other);
        }
      catch (const InputError &error)
        {
          said = error.what();
        }
      check.that(what + " is refused: " + said, !said.empty() && said.find('\n') == said.npos &&
                                                  said.find("parts of the test") != said.npos);
    };
    refused("slices out of order", [](RailSlices &r) { std::swap(r.slices[1], r.slices[2]); });
    refused("parts that cross",
            [](RailSlices &r) { std::swap(r.slices[3].breaks[1], r.slices[3].breaks[2]); });
    refused("nothing in common", [](RailSlices &r) { r.slices[0].breaks = {0., 10e-3, nan, nan}; });
    refused("another number of parts", [](RailSlices &r) { r.slices[0].breaks = {0., 10e-3}; });
    refused("metres for millimetres", [](RailSlices &r) { r.slices[1].points[3][1] = -30.; });
    refused("points in no order", [](RailSlices &r) {
      for (std::size_t k = 0; k < 2000; ++k)
        r.slices[1].points.emplace_back(k % 2 == 0 ? 0. : 30e-3, -1e-6 * k);
    });
    refused("a single slice", [](RailSlices &r) { r.slices.resize(1); });
  }


  /// A flat by a plane at a distance from the axle.
  class Chord : public WheelDeviation
  {
  public:
    explicit Chord(const double half)
      : half(half)
    {
    }
    std::string in_words() const override
    {
      return "a flat";
    }
    Value at(const double angle, const double) const override
    {
      const double c = radius * std::cos(half);
      if (std::abs(angle) >= half)
        return {0., 0., 0.};
      return {c / std::cos(angle) - radius, c * std::sin(angle) / std::pow(std::cos(angle), 2.), 0.};
    }

  private:
    double half;
  };


  void flat(tests::Check &check)
  {
    constexpr double  half  = 0.05;
    const auto        prism = std::make_shared<PrismSurface>(ProfileCurve(arc(0.3, 0.1, 0.)));
    const WheelOnRail pair  = over(cylinder(std::make_shared<Chord>(half)), prism);
    for (const double pitch : {0., 0.02, 0.05, 0.1})
      {
        WheelsetPosition position;
        position.pitch = pitch;
        // The corner of the flat that is nearer to the rail, or the round part.
        const double expected = radius * (1. - (pitch < half ? std::cos(half - pitch) : 1.));
        check.absolute("axle over a flat, turned by " + std::to_string(pitch) + ", um",
                       1e6 * pair.nearest(position).gap, 1e6 * expected, 1.);
      }
    const WheelSurface round = cylinder();
    check.that("round and not round", round.is_constant() && !pair.is_constant());
  }


  void files(tests::Check &check)
  {
    const tests::TemporaryFolder folder;
    const std::string            list = folder.path + "/rail.slcs", table = folder.path + "/rail.csv";
    for (const char *name : {"/a.txt", "/b.txt"})
      {
        std::ofstream file(folder.path + name);
        for (int i = -30; i <= 30; ++i)
          file << i << ' ' << i * i / 600. << '\n'; // z down
      }
    const auto write = [&](const std::string &counts, const std::string &features) {
      std::ofstream(list) << "% a list\n 0.5 1000. offset, scale\n 2 slices\n"
                          << counts << "\n 1 method\n 0.0 'a.txt'\n 0.1 'b.txt'\n"
                          << features;
    };
    write(" 0 0 0 features", "");
    const RailSlices rail = read_rail_slices(list);
    check.that("two slices of a list, scaled and moved",
               rail.slices.size() == 2 && std::abs(rail.slices[1].x - 0.6) < 1e-12);
    check.absolute("z is turned up, mm", 1e3 * rail.slices[0].points.front()[1], -1.5, 1e-9);
    write(" 3 0 0 features", " 0.0 0. 20. 999.\n 0.1 -1 20. 999.\n");
    const RailSlices cut = read_rail_slices(list);
    check.that("features cut them, 999 is the end, -1 nothing", cut.slices[0].breaks.size() == 3 &&
                                                                  cut.slices[0].breaks[2] < 0.07 &&
                                                                  std::isnan(cut.slices[1].breaks[0]));
    const auto refused = [&](const std::string &file, const std::string &word) {
      std::string said;
      try
        {
          read_rail_slices(file);
        }
      catch (const InputError &error)
        {
          said = error.what();
        }
      check.that("refused in one line, with '" + word + "': " + said,
                 said.find(word) != said.npos && said.find('\n') == said.npos);
    };
    write(" 3 1 0 features", "");
    refused(list, "line 4");
    write(" 3 0 0 features", " 0.0 0. 20. 999.\n");
    refused(list, "ends before");
    write(" 3 0 0 features", " 0.0 0. 20. 999.\n 0.3 -1 20. 999.\n");
    refused(list, "comes next");
    refused(folder.path + "/rail.xyz", ".slcs or .csv");
    std::ofstream(table) << "x_mm,y_mm,z_mm,part\n0,0,0,1\n0,1,0,1\n0,2,0,3\n";
    refused(table, "row 3");
  }
} // namespace analysis_crossing


TREAD_TEST(analysis_crossing)(tests::Check &check, const tests::Arguments &)
{
  constant(check);
  ramp(check);
  parts(check);
  flat(check);
  files(check);
}
