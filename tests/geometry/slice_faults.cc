// SPDX-License-Identifier: LGPL-2.1-or-later
// Slices of a crossing of which one is wrong: faults by drawing lots, beside the sound ones.
#include <tread/base/input_error.h>
#include <tread/geometry/rail_slices.h>

#include "check.h"
#include "temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <random>

using namespace tread;

namespace geometry_slice_faults
{
  using Point = dealii::Point<2>;

  std::vector<std::string> doubts_of(const RailSlices &rail)
  {
    return SlicedRail(rail).doubts();
  }

  /// What is said of a rail, or why it is refused.
  std::string said_of(const RailSlices &rail)
  {
    try
      {
        std::string all;
        for (const std::string &doubt : doubts_of(rail))
          all += doubt + '\n';
        return all;
      }
    catch (const InputError &error)
      {
        return error.what();
      }
  }

  /// Whether a slice is named, by itself or with its neighbours.
  bool names(const std::string &said, const RailSlice &slice)
  {
    const double x = 1e3 * slice.x;
    double       from, to;
    if (const std::size_t at = said.find("the slice at "); at != said.npos)
      return std::sscanf(said.c_str() + at, "the slice at %lf mm", &from) == 1 && std::abs(from - x) < 1e-3;
    if (const std::size_t at = said.find("the slices at "); at != said.npos)
      return std::sscanf(said.c_str() + at, "the slices at %lf to %lf mm", &from, &to) == 2 &&
             from < x + 1e-3 && to > x - 1e-3;
    return false;
  }

  /// Moves the points of a slice, and the places where it is cut with them.
  template <typename Move>
  void change(RailSlice &slice, const Move &move)
  {
    std::vector<double> at{0.};
    for (std::size_t k = 1; k < slice.points.size(); ++k)
      at.push_back(at.back() + slice.points[k].distance(slice.points[k - 1]));
    const auto point_of = [&](const double length) {
      return std::min_element(
               at.begin(), at.end(),
               [&](const double a, const double b) { return std::abs(a - length) < std::abs(b - length); }) -
             at.begin();
    };
    std::vector<long> cuts;
    for (const double length : slice.breaks)
      cuts.push_back(std::isnan(length) ? -1 : point_of(length));
    for (Point &p : slice.points)
      p = move(p);
    for (std::size_t k = 1; k < slice.points.size(); ++k)
      at[k] = at[k - 1] + slice.points[k].distance(slice.points[k - 1]);
    for (std::size_t b = 0; b < cuts.size(); ++b)
      if (cuts[b] >= 0)
        slice.breaks[b] = at[cuts[b]];
  }

  using Random = std::mt19937;

  /// A slice that lies too high, too far beside, is turned, or larger or smaller, so that a point moves by
  /// the size at most.
  void spoil(RailSlice &slice, Random &random, const double size)
  {
    const double off   = random() % 2 == 0 ? size : -size;
    double       y_low = 1e300, y_high = -1e300, furthest = 0.;
    for (const Point &p : slice.points)
      {
        y_low    = std::min(y_low, p[0]);
        y_high   = std::max(y_high, p[0]);
        furthest = std::max({furthest, std::abs(p[0]), std::abs(p[1])});
      }
    const double middle = 0.5 * (y_low + y_high), angle = off / (y_high - middle);
    switch (random() % 4)
      {
      case 0:
        change(slice, [&](const Point &p) { return Point(p[0], p[1] + off); });
        return;
      case 1:
        change(slice, [&](const Point &p) { return Point(p[0] + off, p[1]); });
        return;
      case 2:
        change(slice, [&](const Point &p) {
          return Point(middle + (p[0] - middle) * std::cos(angle) - p[1] * std::sin(angle),
                       p[1] * std::cos(angle) + (p[0] - middle) * std::sin(angle));
        });
        return;
      default:
        change(slice, [&](const Point &p) { return p * (1. + off / furthest); });
      }
  }


  void one_that_is_wrong(tests::Check &check, const RailSlices &sound)
  {
    check.that("nothing is said of the sound slices: " + said_of(sound), said_of(sound).empty());
    constexpr unsigned int drawn = 20;
    Random                 random(7);
    // Of 200 that were drawn 51, 90 and 98 % were named, and 1, 4 and 0 % beside the one that was wrong: two
    // standard deviations of 20 below and above.
    for (const auto &[size, least] : {std::pair(0.05e-3, 0.25), std::pair(0.3e-3, 0.7), std::pair(1e-3, 0.9)})
      {
        unsigned int found = 0, others = 0;
        for (unsigned int k = 0; k < drawn; ++k)
          {
            RailSlices rail = sound;
            RailSlice &one  = rail.slices[random() % rail.slices.size()];
            spoil(one, random, size);
            const std::string said = said_of(rail);
            if (names(said, one))
              ++found;
            else if (!said.empty())
              ++others;
          }
        char what[100];
        std::snprintf(what, sizeof what,
                      "one slice wrong by %g mm at most: %u of %u are named, another %u times", 1e3 * size,
                      found, drawn, others);
        check.that(what, found >= least * drawn && others <= 3);
      }
    unsigned int inches = 0, missing = 0;
    for (std::size_t i = 0; i < sound.slices.size(); ++i)
      {
        RailSlices rail = sound;
        change(rail.slices[i], [](const Point &p) { return p / 25.4; });
        inches += names(said_of(rail), sound.slices[i]);
        rail = sound;
        rail.slices.erase(rail.slices.begin() + i);
        missing += said_of(rail).find("is one missing") != std::string::npos;
      }
    check.that("each slice in inches is named: " + std::to_string(inches), inches == sound.slices.size());
    // Not both ends, and not where distances change: where the nose begins and behind it.
    check.that("a slice that is missing: " + std::to_string(missing) + " of " +
                 std::to_string(sound.slices.size()),
               missing + 6 >= sound.slices.size());
  }


  void neighbours_that_are_wrong(tests::Check &check, const RailSlices &sound)
  {
    constexpr unsigned int drawn = 12;
    Random                 random(3);
    unsigned int           pairs = 0, exchanged = 0;
    for (unsigned int k = 0; k < drawn; ++k)
      {
        RailSlices        rail  = sound;
        const std::size_t first = 1 + random() % (rail.slices.size() - 3);
        const double      up    = 0.5e-3;
        for (const std::size_t i : {first, first + 1})
          change(rail.slices[i], [&](const Point &p) { return Point(p[0], p[1] + up); });
        pairs += said_of(rail).find("the slices at") != std::string::npos;
        rail = sound;
        std::swap(rail.slices[first], rail.slices[first + 1]);
        std::swap(rail.slices[first].x, rail.slices[first + 1].x);
        exchanged += !said_of(rail).empty();
      }
    // Regression: of all 35 pairs 27, and 31 that are exchanged.
    check.that("two neighbours 0.5 mm too high: " + std::to_string(pairs) + " of 12 are named", pairs >= 7);
    check.that("exchanged: of " + std::to_string(exchanged) + " of 12 something is said", exchanged >= 8);
  }


  /// A head of 300 mm radius at each x, moved by what a shape says.
  RailSlices designed(const std::vector<double> &places, const std::function<Point(double, Point)> &shape)
  {
    RailSlices rail{"a design", {}};
    for (const double x : places)
      {
        rail.slices.push_back({x, {}, {}, {}});
        for (int i = -60; i <= 60; ++i)
          {
            const double y = 0.5e-3 * i;
            rail.slices.back().points.push_back(shape(x, Point(y, -y * y / 0.6)));
          }
      }
    return rail;
  }


  void honest_shapes(tests::Check &check)
  {
    std::vector<double> places;
    for (int i = 0; i <= 25; ++i)
      places.push_back(20e-3 * i);
    const auto silent = [&](const std::string &what, const std::function<Point(double, Point)> &shape,
                            const std::vector<double> &at) {
      const std::string said = said_of(designed(at, shape));
      check.that(what + ": nothing is said: " + said, said.empty());
    };
    const auto raised = [](const std::function<double(double)> &by) {
      return [=](const double x, const Point p) {
        return Point(p[0], p[1] + by(x));
      };
    };
    silent("alike", raised([](double) { return 0.; }), places);
    silent("a ramp from a slice on", raised([](double x) { return -0.01 * std::max(0., x - 0.2); }), places);
    silent("a ramp, one slice in three", raised([](double x) { return -0.01 * std::max(0., x - 0.2); }),
           {0., 0.1, 0.2, 0.22, 0.24, 0.34, 0.44, 0.54});
    silent(
      "a wing that leads away",
      [](double x, Point p) { return Point(p[0] + 0.02 * std::max(0., x - 0.2), p[1]); }, places);
    silent("a dip with straight sides",
           raised([](double x) { return -5e-3 * std::max(0., 0.06 - std::abs(x - 0.2)); }), places);
    silent("a step", raised([](double x) { return x > 0.25 ? -1e-3 : 0.; }), places);
    silent("waves", raised([](double x) { return 0.2e-3 * std::sin(x / 0.04); }), places);
  }


  void units_and_directions(tests::Check &check, const RailSlices &sound)
  {
    const auto moved = [&](const double of_points, const double of_places) {
      RailSlices rail = sound;
      for (RailSlice &slice : rail.slices)
        {
          change(slice, [&](const Point &p) { return p * of_points; });
          slice.x *= of_places;
        }
      return said_of(rail);
    };
    for (const auto &[what, said] :
         {std::pair("points in inches", moved(1. / 25.4, 1.)),
          std::pair("places in inches", moved(1., 1. / 25.4)), std::pair("points in metres", moved(1e-3, 1.)),
          std::pair("places in metres", moved(1., 1e-3))})
      check.that(what + (": " + said), said.find("in mm?") != std::string::npos);

    // A surface with a groove, whose ends lie at its top.
    for (const double up : {1., -1.})
      {
        const tests::TemporaryFolder folder;
        const std::string            file = folder.path + "/groove.csv";
        std::ofstream                out(file);
        out << "x_mm,y_mm,z_mm\n";
        for (const double x : {0., 50., 100.})
          for (const Point &p : {Point(-40., -1.), Point(-20., 0.), Point(0., 0.), Point(20., -1.),
                                 Point(22., -40.), Point(60., -40.), Point(62., -1.), Point(80., 0.)})
            out << x << ',' << p[0] << ',' << up * p[1] << '\n';
        out.close();
        const auto top = SlicedRail(read_rail_slices(file)).height(0.05, -10e-3);
        check.absolute("a groove: top, mm", top ? 1e3 * top->z : -1e3, 0., 0.3);
      }

    // A rail from foot to foot, and with the line under the foot, whatever the points are dense on.
    const tests::TemporaryFolder folder;
    const std::vector<Point> outline{{-75., -172.}, {-75., -161.}, {-8., -140.}, {-8., -40.}, {-36., -30.},
                                     {-36., -8.},   {-20., -1.},   {20., -1.},   {36., -8.},  {36., -30.},
                                     {8., -40.},    {8., -140.},   {75., -161.}, {75., -172.}};
    for (const bool closed : {false, true})
      for (const bool down : {false, true})
        for (const double dense_web : {1., 20.})
          {
            const std::string file = folder.path + "/whole.csv";
            std::ofstream     out(file);
            out << "x_mm,y_mm,z_mm\n";
            for (const double x : {0., 50., 100.})
              for (std::size_t k = 0; k + (closed ? 0 : 1) < outline.size(); ++k)
                {
                  const Point &a = outline[k], &b = outline[(k + 1) % outline.size()];
                  const int    n = std::ceil(a.distance(b) / 2.) * (a[0] == b[0] ? dense_web : 1.);
                  for (int i = 0; i < n; ++i)
                    {
                      const Point p = a + (i + 0.) / n * (b - a);
                      out << x << ',' << p[0] << ',' << (down ? -p[1] : p[1]) << '\n';
                    }
                }
            out.close();
            const SlicedRail rail(read_rail_slices(file));
            const auto       top = rail.height(0.05, 0.);
            check.absolute(std::string(closed ? "closed" : "from foot to foot") +
                             (down ? ", z down" : ", z up") + ", its top, mm",
                           top ? 1e3 * top->z : 0., -1., 0.5);
          }
  }


  void one_that_is_there_twice(tests::Check &check, const RailSlices &sound)
  {
    RailSlices rail = sound;
    rail.slices.insert(rail.slices.begin() + 20, rail.slices[20]);
    check.that("at the same place: " + said_of(rail), said_of(rail).find("must follow") != std::string::npos);
    rail.slices[20].x -= 1e-6;
    check.that("almost there: " + said_of(rail), said_of(rail).find("twice") != std::string::npos);
    rail            = sound;
    RailSlice &once = rail.slices[30];
    once.points.insert(once.points.end(), sound.slices[30].points.begin(), sound.slices[30].points.end());
    check.that("its points once more: " + said_of(rail),
               said_of(rail).find("come back to") != std::string::npos);
    rail = sound;
    std::swap(rail.slices[30].points[100], rail.slices[30].points[120]);
    check.that("two points exchanged: " + said_of(rail),
               said_of(rail).find("come back to") != std::string::npos);
  }
} // namespace geometry_slice_faults


TREAD_TEST(geometry_slice_faults)(tests::Check &check, const tests::Arguments &)
{
  const RailSlices sound = read_rail_slices(TREAD_CROSSING);
  one_that_is_wrong(check, sound);
  neighbours_that_are_wrong(check, sound);
  honest_shapes(check);
  units_and_directions(check, sound);
  one_that_is_there_twice(check, sound);
}
