// SPDX-License-Identifier: LGPL-2.1-or-later
// How far the half-space answers are from the limit of small elements: the order of the slip and of the
// leading edge within an element on Carter's problem, and the uncertainty that estimate_rolling() gives
// beside the true error on rolling cases of every kind.
#include <tread/reference/carter.h>
#include <tread/reference/half_space.h>
#include <tread/reference/hertz.h>
#include <tread/reference/rolling_estimate.h>

#include "check.h"
#include "thesis_case.h"

#include <algorithm>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

using namespace tread::reference;
using std::numbers::pi;

namespace reference_convergence
{
  /// Force of Carter's problem over the exact one, minus one, where `inside` of the last element lies in the
  /// patch of n elements.
  double carter_error(const unsigned int n, const double inside, const double creepage)
  {
    const Elastic     steel{2. * 82e9 * 1.28, 0.28};
    const ElasticPair pair = combine(steel, steel);
    const double      a = 1e-3, radius = 0.5, friction = 0.3,
                 load         = pi * pair.hertz_modulus() * a * a / (4. * radius);
    const HertzLine     hertz = hertz_line(radius, pair.hertz_modulus(), load);
    const double        h = 2. * a / n, width = 1000. * a;
    const unsigned int  m = n + 5; // the last one lies beyond the patch
    const Grid          grid{m, 1, h, width, a - inside * h + 0.5 * h - (m - 2) * h, 0.};
    std::vector<double> pressure(m, 0.);
    const auto          integral = [&](const double x) {
      const double t = std::clamp(x / a, -1., 1.);
      return 0.5 * a * (t * std::sqrt(1. - t * t) + std::asin(t));
    };
    for (unsigned int i = 0; i < m; ++i)
      pressure[i] = hertz.max_pressure * (integral(grid.x(i) + 0.5 * h) - integral(grid.x(i) - 0.5 * h)) / h;
    TangentialProblem t;
    t.friction     = friction;
    t.longitudinal = creepage;
    t.tolerance    = 1e-9;
    t.order        = 2;
    t.leading_edge = {a};
    return solve_tangential(grid, pair, pressure, t).longitudinal_force / (friction * load * width) /
             carter(radius, pair.hertz_modulus(), load, friction, creepage).traction_ratio -
           1.;
  }

  void carter_order(tread::tests::Check &check)
  {
    std::printf("\n--- Carter: order of the force, leading edge anywhere in an element\n");
    for (const double creepage : {-1e-4, -2.4e-4})
      for (const double inside : {0.05, 0.2, 0.4, 0.6, 0.8333, 1.})
        {
          const double coarse = carter_error(40, inside, creepage),
                       fine   = carter_error(160, inside, creepage);
          char name[60];
          std::snprintf(name, sizeof name, "xi %.1e, edge at %.2f h: ", creepage, inside);
          // First order leaves 0.2 to 0.7 % at 40 elements.
          check.below(std::string(name) + "40 elements", coarse, 1e-3);
          check.below(std::string(name) + "160 elements", fine, 1.6e-4);
        }
    // The strip is a thousand half-widths wide, which leaves 4e-5: the order is that of larger errors.
    double coarse = 0., fine = 0.;
    for (double inside = 0.05; inside < 1.; inside += 0.1)
      {
        coarse += std::pow(carter_error(15, inside, -2.4e-4), 2);
        fine += std::pow(carter_error(60, inside, -2.4e-4), 2);
      }
    // from 15 to 60 elements
    check.that("order of the rms over all places at least 1.4",
               0.5 * std::log2(std::sqrt(coarse / fine)) >= 1.4);
    std::printf("order %.2f\n", 0.5 * std::log2(std::sqrt(coarse / fine)));
  }

  struct Case
  {
    std::string                        name;
    std::function<void(RollingCase &)> change;
    double                             coarse, fine; // element sizes, mm
    double                             of_force;     // allowed error of creepage, forces, power
    double                             of_adhesion;  // points
    double                             of_shear;     // share
  };

  void cases(tread::tests::Check &check)
  {
    const std::vector<Case> all = {
      {"traction 0.30", [](RollingCase &) {}, 0.31, 0.13, 3e-4, 0.03, 4e-3},
      {"traction 0.15", [](RollingCase &c) { c.traction_coefficient = 0.15; }, 0.31, 0.13, 3e-4, 0.2, 8e-3},
      {"given creepage",
       [](RollingCase &c) {
         c.prescribe_force = false;
         c.creepage        = -1.5e-3;
       },
       0.31, 0.13, 3e-4, 0.2, 5e-3},
      {"spin and lateral creepage",
       [](RollingCase &c) {
         c.prescribe_force  = false;
         c.creepage         = -5e-4;
         c.lateral_creepage = 5e-4;
         c.spin             = 0.2;
       },
       0.31, 0.13, 2e-3, 0.4, 2e-2},
      {"spin alone",
       [](RollingCase &c) {
         c.prescribe_force = false;
         c.spin            = 0.4;
       },
       0.31, 0.15, 2e-3, 1.2, 2e-2},
      {"traction and the spin of a cone",
       [](RollingCase &c) {
         c.traction_coefficient = 0.2;
         c.radius_change        = [](const double y) {
           return 0.15 * y;
         };
       },
       0.31, 0.15, 1e-3, 0.8, 1e-2},
      {"wide patch", [](RollingCase &c) { c.curvature_y = 0.3; }, 0.31, 0.15, 1e-3, 1., 5e-3},
      {"unlike bodies",
       [](RollingCase &c) {
         c.wheel.young   = 150e9;
         c.wheel.poisson = 0.25;
       },
       0.31, 0.19, 5e-3, 0.3, 3e-3},
      {"another gap",
       [](RollingCase &c) {
         c.gap = [](const double x, const double y) {
           return x * x / 0.92 + y * y / 0.6 * (1. + y / 0.05) + 3e3 * y * y * y * y;
         };
       },
       0.31, 0.2, 1e-3, 0.3, 4e-3}};
    for (const Case &one : all)
      {
        std::printf("\n--- %s: elements of %.2f mm beside %.2f mm\n", one.name.c_str(), one.coarse, one.fine);
        RollingCase c = tread::tests::thesis_case(0.3, one.coarse);
        one.change(c);
        const RollingEstimate estimate = estimate_rolling(c);
        c.element_size                 = 1e-3 * one.fine;
        const RollingEstimate limit    = estimate_rolling(c);
        const auto compare = [&](const char *name, const Estimate RollingEstimate::*member, const double unit,
                                 const double allowed) {
          const Estimate &here = estimate.*member, &there = limit.*member;
          if (std::abs(there.value) * unit < 1e-6)
            return;
          check.relative(name, here.value * unit, there.value * unit, allowed);
          check.absolute("  within its uncertainty", here.value * unit, there.value * unit,
                         here.uncertainty * unit + 1e-9);
        };
        compare("maximum pressure [MPa]", &RollingEstimate::max_pressure, 1e-6, 3e-4);
        // Nor do the elements that the patch's edge cuts carry more than friction lets them.
        const RollingResult &fields = estimate.fields;
        double               excess = 0.;
        for (std::size_t e = 0; e < fields.pressure.size(); ++e)
          excess =
            std::max(excess, std::hypot(fields.shear_x[e], fields.shear_y[e]) -
                               c.friction_bound(fields.grid.x(e % fields.grid.n_x),
                                                fields.grid.y(e / fields.grid.n_x), fields.pressure[e]));
        check.below("shear beyond the friction bound [MPa]", 1e-6 * excess, 1e-9);
        if (c.prescribe_force)
          compare("creepage [1e-3]", &RollingEstimate::creepage, 1e3, one.of_force);
        else
          {
            compare("Fx [kN]", &RollingEstimate::longitudinal_force, 1e-3, one.of_force);
            compare("Fy [kN]", &RollingEstimate::lateral_force, 1e-3, one.of_force);
          }
        compare("frictional power [W]", &RollingEstimate::frictional_power, 1., one.of_force);
        check.absolute("adhesion share [points]", 100. * estimate.adhesion_share.value,
                       100. * limit.adhesion_share.value, one.of_adhesion);
        check.absolute("  within its uncertainty", 100. * estimate.adhesion_share.value,
                       100. * limit.adhesion_share.value, 100. * estimate.adhesion_share.uncertainty);
        compare("largest shear [MPa]", &RollingEstimate::max_shear, 1e-6, one.of_shear);
        check.absolute("largest slip [m/s] within its uncertainty", estimate.max_slip.value,
                       limit.max_slip.value, estimate.max_slip.uncertainty);
        if (one.name == "traction 0.30")
          {
            // CONTACT 25.2, 2 q(0.1 mm) - q(0.2 mm) of first-order values, good to 0.1 or 0.2 %
            check.relative("creepage beside CONTACT extrapolated [1e-3]", -1e3 * estimate.creepage.value,
                           2.8899, 2e-3);
            check.absolute("adhesion share beside CONTACT extrapolated [points]",
                           100. * estimate.adhesion_share.value, 62.07, 0.03);
            check.relative("largest shear beside CONTACT extrapolated [MPa]", 1e-6 * estimate.max_shear.value,
                           618.25, 3e-3);
          }
      }
  }

  void frictionless(tread::tests::Check &check)
  {
    std::printf("\n--- without friction\n");
    RollingCase c;
    c.curvature_x  = 1. / 0.92;
    c.curvature_y  = 1. / 0.6;
    c.normal_force = 127.1e3;
    c.element_size = 0.31e-3;
    c.gap          = [](const double x, const double y) {
      return x * x / 0.92 + y * y / 0.6;
    };
    const RollingEstimate e = estimate_rolling(c);
    // Hertz's patch, found from the gap
    check.relative("maximum pressure [MPa]", 1e-6 * e.max_pressure.value, 1e-6 * e.fields.hertz.max_pressure,
                   3e-4);
    check.absolute("  within its uncertainty", 1e-6 * e.max_pressure.value,
                   1e-6 * e.fields.hertz.max_pressure, 1e-6 * e.max_pressure.uncertainty);
    check.relative("area [mm2]", 1e6 * e.area.value,
                   1e6 * pi * e.fields.hertz.semi_axis_x * e.fields.hertz.semi_axis_y, 5e-3);
    check.absolute("shear, slip, adhesion, power",
                   e.max_shear.value + e.adhesion_share.value + std::abs(e.frictional_power.value) * 1e-3, 0.,
                   1e-6);
  }
} // namespace reference_convergence

TREAD_TEST(reference_convergence)(tread::tests::Check &check, const tread::tests::Arguments &)
{
  carter_order(check);
  cases(check);
  frictionless(check);
}
