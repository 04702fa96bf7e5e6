// SPDX-License-Identifier: LGPL-2.1-or-later
// Friction that falls with slip in the half-space solver: creep curves of a locomotive, published with
// CONTACT (E. Vollebregt, example "Eurosprinter", CONTACT 25; measured by Engel, Beck & Alders 1998; law of
// Polach 2005), and what must hold of any law.
#include <tread/reference/errors.h>
#include <tread/reference/hertz.h>
#include <tread/reference/rolling_case.h>

#include "check.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

using namespace tread::reference;

namespace reference_slip_friction
{
  RollingCase locomotive(const double creepage, const double friction)
  {
    RollingCase c;
    c.wheel = c.rail  = {2. * 82e9 * 1.28, 0.28};
    c.curvature_x     = 0.8;
    c.curvature_y     = 0.281417;
    c.normal_force    = 106700.;
    c.friction        = friction;
    c.speed           = 10.;
    c.prescribe_force = false;
    c.creepage        = creepage;
    c.element_size    = 0.29e-3;
    return c;
  }

  /// The same with friction that falls by half over 1.25 m/s of slip, its memory and an interfacial layer.
  RollingCase wet(const double creepage)
  {
    RollingCase c   = locomotive(creepage, 0.33);
    c.layer         = 1.25e-3 / 8.2e9;
    c.slip_friction = std::make_shared<RollingCase::SlipFriction>(RollingCase::SlipFriction{
      [](const double s) { return 0.14 + 0.19 * std::exp2(-s / 1.25); }, 3e-6, 1e-3});
    return c;
  }

  struct Point
  {
    double creepage, traction;
  };
} // namespace reference_slip_friction

TREAD_TEST(reference_slip_friction)(tread::tests::Check &check, const tread::tests::Arguments &)
{
  // A law that falls within some micrometres per second has no steady state without a memory, which is known
  // before anything is solved; with a memory it has. One that falls 50 times more slowly is given up early.
  for (const auto &[speed, most_calls] : {std::pair(2e-5, 2e3), {1e-3, 6e4}})
    {
      RollingCase   c       = locomotive(0.0012, 0.33);
      unsigned long n_calls = 0;
      const auto    law     = [&n_calls, speed = speed](const double s) {
        ++n_calls;
        return 0.14 + 0.19 * std::exp(-s / speed);
      };
      c.element_size  = 0.6e-3;
      c.slip_friction = std::make_shared<RollingCase::SlipFriction>(RollingCase::SlipFriction{law, 0., 0.});
      std::string said;
      try
        {
          solve_rolling(c);
        }
      catch (const FrictionTooSteep &error)
        {
          said = error.what();
        }
      check.that("steep law refused: " + said, said.find("memory") != std::string::npos);
      std::printf("evaluations of the law: %lu\n", n_calls);
      check.below("evaluations of the law over those allowed", n_calls / most_calls, 1.);
      c.slip_friction =
        std::make_shared<RollingCase::SlipFriction>(RollingCase::SlipFriction{law, 1e-4, 1e-3});
      const double traction = -solve_rolling(c).traction_coefficient;
      check.that("with a memory it has an answer", traction > 0.14 && traction < 0.33);
    }

  // Friction that falls with the pressure, 1 - p/p_1: what slides carries is that of the mean of p^2, three
  // quarters of the largest pressure times the force, and no element carries more than its own bound.
  {
    RollingCase  c    = locomotive(0.05, 0.33);
    const double p_1  = 3e9;
    c.pressure_factor = [p_1](const double p) {
      return 1. - p / p_1;
    };
    const RollingResult sliding = solve_rolling(c);
    check.relative("falls with pressure, sliding", -sliding.traction_coefficient,
                   0.33 * (1. - 0.75 * sliding.hertz.max_pressure / p_1), 1e-3);
    c.creepage                  = 0.0016;
    const RollingResult rolling = solve_rolling(c);
    double              worst   = 0.;
    for (std::size_t e = 0; e < rolling.pressure.size(); ++e)
      worst = std::max(worst, std::hypot(rolling.shear_x[e], rolling.shear_y[e]) -
                                c.friction_bound(0., 0., rolling.pressure[e]));
    check.absolute("falls with pressure, rolling: shear beyond the bound", worst / rolling.hertz.max_pressure,
                   0., 1e-9);
    c.pressure_factor = [p_2 = 0.6 * rolling.hertz.max_pressure](const double p) {
      return p < p_2 ? 1. : 0.;
    };
    const RollingResult slippery = solve_rolling(c);
    // Hertz: (1 - 0.8^2)^(3/2) of the force lies outside, and nearly all of it slides.
    check.relative("no friction under high pressure: traction", -slippery.traction_coefficient,
                   0.33 * std::pow(0.36, 1.5), 0.05);
    check.that("falls with pressure, rolling: less traction than 0.2584",
               -rolling.traction_coefficient < 0.25 && -rolling.traction_coefficient > 0.15);
  }

  // Friction that is another one at each side: what slides carries the mean, and the same everywhere is
  // another coefficient. Along the way only the factor of the own place counts.
  {
    RollingCase c = locomotive(0.05, 0.33);
    // Odd about the middle, so that elements on it count half.
    const auto share = [](const double place) {
      constexpr double width = 1e-3; // m
      return 0.5 + 0.5 * std::clamp(place / width, -1., 1.);
    };
    c.place_factor = [&](const double, const double y) {
      return 0.4 + 0.6 * share(y);
    };
    check.relative("less on one side, sliding", -solve_rolling(c).traction_coefficient, 0.7 * 0.33, 1e-3);
    c.place_factor = [&](const double x, const double y) {
      return share(x) * share(y);
    };
    check.relative("friction on a quarter of the patch, sliding", -solve_rolling(c).traction_coefficient,
                   0.25 * 0.33, 1e-3);
    RollingCase half = locomotive(0.0016, 0.33), same = locomotive(0.0016, 0.165);
    half.place_factor = [](const double, const double) {
      return 0.5;
    };
    check.relative("half of it everywhere, rolling", solve_rolling(half).traction_coefficient,
                   solve_rolling(same).traction_coefficient, 1e-6);
    half.pressure_factor = [](const double) {
      return 2.;
    };
    check.relative("factors of place and pressure multiply", solve_rolling(half).traction_coefficient,
                   solve_rolling(locomotive(0.0016, 0.33)).traction_coefficient, 1e-6);
  }

  // Friction that falls with the temperature to which it heats the surface: each element that slips has the
  // coefficient of its temperature, by the sum over what was felt before (Carslaw and Jaeger 1959, section
  // 2.9), and heat that changes nothing changes nothing.
  {
    RollingCase      c     = locomotive(0.02, 0.33);
    constexpr double share = 0.4, effusivity = 12500., hot = 300.; // -, J/(m^2 K sqrt(s)), K
    c.speed         = 30.;
    const auto with = [&](const std::function<double(double)> &factor) {
      c.heat_friction =
        std::make_shared<RollingCase::HeatFriction>(RollingCase::HeatFriction{factor, share, effusivity});
      return solve_rolling(c);
    };
    const auto factor = [](const double rise) {
      return 1. / (1. + rise / hot);
    };
    for (const double creepage : {0.0016, 0.02})
      {
        c.creepage                = creepage;
        const RollingResult r     = with(factor);
        double              worst = 0., hottest = 0.;
        for (unsigned int j = 0; j < r.grid.n_y; ++j)
          {
            std::vector<double> flux; // from the leading edge on
            double              before = 0.;
            for (unsigned int i = r.grid.n_x; i-- > 0;)
              {
                const std::size_t e     = std::size_t(j) * r.grid.n_x + i;
                const double      shear = std::hypot(r.shear_x[e], r.shear_y[e]);
                flux.push_back(shear * std::hypot(r.slip_x[e], r.slip_y[e]));
                double rise = 0.;
                for (std::size_t k = 0; k < flux.size(); ++k)
                  {
                    const double since = r.grid.dx / c.speed * (flux.size() - k);
                    rise += 2. * share * flux[k] / (effusivity * std::sqrt(M_PI)) *
                            (std::sqrt(since) - std::sqrt(since - r.grid.dx / c.speed));
                  }
                hottest = std::max(hottest, rise);
                if (r.state[e] == ElementState::slip)
                  worst =
                    std::max(worst, std::abs(shear / (0.33 * r.pressure[e]) - factor(.5 * (before + rise))));
                before = rise;
              }
          }
        check.below("falls with temperature, creepage " + std::to_string(creepage) +
                      ": coefficient off its law",
                    worst, 1e-5);
        check.that("it gets hot", hottest > (creepage > 0.01 ? 50. : 3.));
      }
    c.creepage        = 0.0016;
    const double half = with([](const double) { return 0.5; }).traction_coefficient;
    check.relative("the same at any temperature", half,
                   solve_rolling([&] {
                     RollingCase other = locomotive(0.0016, 0.165);
                     other.speed       = c.speed;
                     return other;
                   }())
                     .traction_coefficient,
                   1e-6);
  }

  // Square elements of 0.29 mm beside 0.289 x 0.63 mm there, and printed with four digits.
  for (const auto &[creepage, traction] :
       {Point{0.0008, 0.15651}, {0.0016, 0.25839}, {0.0024, 0.31237}, {0.0032, 0.32924}, {0.0056, 0.32990}})
    check.relative("constant friction, traction at a creepage of " + std::to_string(creepage),
                   -solve_rolling(locomotive(creepage, 0.33)).traction_coefficient, traction, 0.003);
  for (const auto &[creepage, traction] : {Point{0.002, 0.11537},
                                           {0.004, 0.20131},
                                           {0.006, 0.25539},
                                           {0.008, 0.28557},
                                           {0.010, 0.30094},
                                           {0.012, 0.30825},
                                           {0.016, 0.31172},
                                           {0.020, 0.30993},
                                           {0.040, 0.29278},
                                           {0.075, 0.26579},
                                           {0.125, 0.23524},
                                           {0.175, 0.21218}})
    {
      const RollingResult r = solve_rolling(wet(creepage));
      check.relative("falling friction with memory and layer, creepage " + std::to_string(creepage),
                     -r.traction_coefficient, traction, 0.005);
      // Each element that slips has the coefficient of its own slip, without memory.
      RollingCase at_once       = wet(creepage);
      auto        law           = *at_once.slip_friction;
      law.memory_distance       = 0.;
      at_once.slip_friction     = std::make_shared<RollingCase::SlipFriction>(law);
      const RollingResult own   = solve_rolling(at_once);
      double              worst = 0.;
      for (std::size_t e = 0; e < own.pressure.size(); ++e)
        if (own.state[e] == ElementState::slip)
          worst = std::max(worst, std::abs(std::hypot(own.shear_x[e], own.shear_y[e]) / own.pressure[e] -
                                           law.coefficient(std::hypot(own.slip_x[e], own.slip_y[e]))));
      check.below("without memory: coefficient of slipping elements off the law at their slip", worst, 1e-4);
    }
}
