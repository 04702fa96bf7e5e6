// SPDX-License-Identifier: LGPL-2.1-or-later
// Rolling over an uneven way: level, it is steady rolling; with a creepage from rest, transient rolling; a
// long bump is another curvature and another load; and what it refuses.
#include <tread/reference/errors.h>
#include <tread/reference/transient.h>
#include <tread/reference/uneven_way.h>

#include "check.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <string>

using namespace tread::reference;

namespace reference_uneven_way
{
  constexpr double curvature_x = 1.087, curvature_y = 1.667, load = 127.1e3, edge = 0.5e-3, edge_y = 0.6e-3;

  /// A wheel on a rail; the grid is wide enough for half as much load again. @param bent curvature of the
  /// rail along the way [1/m]
  UnevenWay wheel(const std::size_t n_steps, const double creepage, const double bent = 0.)
  {
    UnevenWay way;
    way.contact.grid = {45, 35, edge, edge_y, -22 * edge, -17 * edge_y};
    way.contact.gap  = [bent](const double x, const double y) {
      return (curvature_x + bent / 2.) * x * x + curvature_y * y * y;
    };
    way.contact.friction = 0.3;
    way.contact.wheel = way.contact.rail = {210e9, 0.3};
    way.heights.assign(n_steps, 0.);
    way.normal_force.assign(n_steps, load);
    way.longitudinal.assign(n_steps, creepage);
    return way;
  }

  PlanarResult steady(const UnevenWay &way, const double force, const double creepage)
  {
    PlanarCase c   = way.contact;
    c.normal_force = force;
    c.longitudinal = creepage;
    return solve_planar(c);
  }

  double sum_across(const UnevenResult &result, const std::size_t place)
  {
    double sum = 0.;
    for (std::size_t k = place; k < result.work.size(); k += result.approach.size())
      sum += result.work[k];
    return sum;
  }

  void level(tread::tests::Check &check)
  {
    std::printf("\n--- a level way is steady rolling\n");
    for (const double creepage : {-1e-3, -2e-2})
      {
        const UnevenWay    way    = wheel(60, creepage);
        const UnevenResult result = roll_over(way);
        const PlanarResult known  = steady(way, load, creepage);
        check.relative("approach after 60 steps [um]", 1e6 * result.approach.back(), 1e6 * known.approach,
                       1e-6);
        check.relative("longitudinal force after 60 steps [kN]", 1e-3 * result.longitudinal_force.back(),
                       1e-3 * known.longitudinal_force, 2e-4);
        // Per length of the way. The slip of elements has an error of first order.
        check.relative("work [J/m]", edge_y * sum_across(result, 30), known.frictional_power, 0.03);
        check.relative("the same of a place further on", sum_across(result, 35), sum_across(result, 30),
                       1e-3);
      }
    const UnevenWay    way    = wheel(60, -2e-2);
    const UnevenResult result = roll_over(way);
    check.relative("full slip: friction times load times creepage [J/m]", edge_y * sum_across(result, 30),
                   0.3 * load * 2e-2, 1e-3);
    // Of its pressure the half behind the middle passes the first place.
    check.relative("the first place of the way", sum_across(result, 0) / sum_across(result, 30), 0.5, 0.2);
  }

  void from_rest(tread::tests::Check &check)
  {
    std::printf("\n--- creepage that begins is transient rolling\n");
    UnevenWay way            = wheel(41, -1e-3);
    way.longitudinal.front() = 0.;
    TransientCase t;
    t.rolling.curvature_x  = curvature_x;
    t.rolling.curvature_y  = curvature_y;
    t.rolling.normal_force = load;
    t.rolling.friction     = way.contact.friction;
    t.rolling.wheel = t.rolling.rail = way.contact.wheel;
    t.rolling.prescribe_force        = false;
    t.rolling.creepage               = -1e-3;
    t.rolling.element_size           = edge;
    t.rolling.element_size_y         = edge_y;
    t.distance                       = 40 * edge;
    const UnevenResult    result     = roll_over(way);
    const TransientResult known      = solve_transient(t);
    // The creepage changes between two steps, half an element before the one that has it.
    for (const std::size_t k : {3, 5, 10, 20, 40})
      check.relative("force over load after " + std::to_string(k) + " elements",
                     result.longitudinal_force[k] / load,
                     0.5 * (known.traction_coefficient[k - 1] + known.traction_coefficient[k]), 0.02);
  }

  void long_wave(tread::tests::Check &check)
  {
    std::printf("\n--- on the crest and in the trough of a long wave: steady rolling with the rail's "
                "curvature there\n");
    constexpr double height = 100e-6, length = 0.4;
    const auto       n   = static_cast<std::size_t>(length / edge);
    UnevenWay        way = wheel(n, -2e-3);
    const double     k   = 2. * std::numbers::pi / length;
    for (std::size_t i = 0; i < n; ++i)
      {
        way.heights[i]      = height * std::cos(k * i * edge - std::numbers::pi / 2.);
        way.normal_force[i] = load * (1. + 0.2 * std::cos(k * i * edge - std::numbers::pi / 2.));
      }
    const UnevenResult result = roll_over(way);
    for (const double sign : {1., -1.})
      {
        const std::size_t  place = n / 4 * (sign > 0. ? 1 : 3);
        const double       bent  = sign * height * k * k;
        const UnevenWay    there = wheel(1, 0., bent);
        const PlanarResult known =
          steady(there, load * (1. + 0.2 * sign), -2e-3 * (2. * curvature_x + bent) / (2. * curvature_x));
        const std::string name = sign > 0. ? "crest" : "trough";
        check.relative(name + ": approach less height [um]",
                       1e6 * (result.approach[place] + way.heights[place]), 1e6 * known.approach, 1e-3);
        check.relative(name + ": longitudinal force [kN]", 1e-3 * result.longitudinal_force[place],
                       1e-3 * known.longitudinal_force, 3e-3);
        check.relative(name + ": work [J/m]", edge_y * sum_across(result, place), known.frictional_power,
                       0.03);
      }
  }

  void refusals(tread::tests::Check &check)
  {
    std::printf("\n--- what is refused\n");
    const auto refuses = [&](const std::string &what, const std::string &words,
                             const std::function<void(UnevenWay &)> &wrong) {
      UnevenWay way = wheel(3, -1e-3);
      wrong(way);
      check.refuses(what, words, [&] { roll_over(way); });
    };
    refuses("no steps", "each step",
            [](UnevenWay &way) { way.heights = way.normal_force = way.longitudinal = {}; });
    refuses("fewer forces than heights", "each step", [](UnevenWay &way) { way.normal_force.pop_back(); });
    refuses("a load of nothing", "normal_force", [](UnevenWay &way) { way.normal_force[1] = 0.; });
    refuses("a height that is no number", "heights", [](UnevenWay &way) { way.heights[2] = std::nan(""); });
    refuses("no friction", "friction", [](UnevenWay &way) { way.contact.friction = 0.; });
    refuses("unlike bodies", "unlike bodies", [](UnevenWay &way) { way.contact.rail.young = 100e9; });
    refuses("no centre at x = 0", "x_first", [](UnevenWay &way) { way.contact.grid.x_first += 0.4 * edge; });
    check.that("a grid too small for the load", !tread::tests::complaint<ReachesBorder>([] {
                                                   UnevenWay way       = wheel(3, -1e-3);
                                                   way.normal_force[2] = 100. * load;
                                                   roll_over(way);
                                                 }).empty());
  }
} // namespace reference_uneven_way

TREAD_TEST(reference_uneven_way)(tread::tests::Check &check, const tread::tests::Arguments &)
{
  level(check);
  from_rest(check);
  long_wave(check);
  refusals(check);
}
