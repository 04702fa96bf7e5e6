// SPDX-License-Identifier: LGPL-2.1-or-later
// Closed forms of normal contact against known figures. Where a reference is printed with n digits, the
// tolerance is half a unit of its last digit; otherwise the identity holds to round-off.
#include <tread/reference/elastic.h>
#include <tread/reference/hertz.h>
#include <tread/reference/zimmermann.h>

#include "check.h"

#include <algorithm>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>

using namespace tread::reference;

namespace reference_hertz
{
  struct Maximum
  {
    double depth, value;
  };

  Maximum maximum_over_depth(const std::function<double(double)> &f)
  {
    Maximum best{0., f(0.)};
    for (double z = 0.; z < 2.; z += 1e-4)
      if (f(z) > best.value)
        best = {z, f(z)};
    return best;
  }

  void elastic_constants(tread::tests::Check &check, const ElasticPair &steel)
  {
    check.relative("E* of steel on steel [GPa]", steel.hertz_modulus() * 1e-9, 115.38, 5e-5);
    check.relative("G of steel on steel [GPa]", steel.shear * 1e-9, 80.769231, 1e-8);
    check.below("K of like bodies [-]", steel.coupling, 1e-15);
    // aluminium on steel: E* must be that of the two-body formula
    // Over 1 - nu the coupling is Dundurs' second parameter: (1 - 2 nu)/(2 (1 - nu)) on a rigid body.
    const ElasticPair on_rigid = combine(Elastic{210e9, 0.3}, Elastic{210e21, 0.3});
    check.relative("on a rigid body: coupling over 1 - nu", on_rigid.coupling / (1. - on_rigid.poisson),
                   0.2 / 0.7, 1e-9);
    const ElasticPair pair = combine(Elastic{70e9, 0.33}, Elastic{210e9, 0.3});
    check.relative("E* of unlike bodies [GPa]", pair.hertz_modulus() * 1e-9,
                   1e-9 / ((1. - 0.33 * 0.33) / 70e9 + (1. - 0.09) / 210e9), 1e-14);
  }

  /// Elliptic integrals: Abramowitz & Stegun (1964), table 17.1, m = 0.5; Legendre's relation for two others.
  void integrals(tread::tests::Check &check)
  {
    const EllipticIntegrals f = elliptic_integrals(std::sqrt(0.5));
    check.relative("K(m = 0.5)", f.first, 1.854074677301372, 1e-14);
    check.relative("E(m = 0.5)", f.second, 1.350643881047675, 1e-14);
    const EllipticIntegrals g = elliptic_integrals(0.1), h = elliptic_integrals(std::sqrt(0.99));
    check.relative("Legendre's relation", g.second * h.first + h.second * g.first - g.first * h.first,
                   std::numbers::pi / 2., 1e-13);
    check.relative("D(e -> 0)", elliptic_integrals(1e-9).difference, std::numbers::pi / 4., 1e-14);
    check.relative("D(m = 0.5)", f.difference, (f.first - f.second) / 0.5, 1e-13);
    check.relative("B(m = 0.5)", f.complement, (f.second - 0.5 * f.first) / 0.5, 1e-13);
  }

  /// Both elastic, R = 50 mm, 1 kN.
  void sphere_on_plane(tread::tests::Check &check, const double modulus)
  {
    const HertzEllipse sphere = hertz_sphere(0.05, modulus, 1000.);
    check.absolute("sphere: a [mm]", sphere.semi_axis_x * 1e3, 0.6875, 6e-5);
    check.absolute("sphere: p0 [MPa]", sphere.max_pressure * 1e-6, 1010.1, 0.06);
    check.absolute("sphere: approach [um]", sphere.approach * 1e6, 9.454, 6e-4);
    check.relative("sphere: a^3 = 3 N R/(4 E*)", std::pow(sphere.semi_axis_x, 3),
                   0.75 * 1000. * 0.05 / modulus, 1e-13);
    const double d = 1e-4;
    check.relative("sphere: stiffness [N/um]", sphere.stiffness * 1e-6,
                   1e-6 * 2000. * d /
                     (hertz_sphere(0.05, modulus, 1000. * (1. + d)).approach -
                      hertz_sphere(0.05, modulus, 1000. * (1. - d)).approach),
                   1e-7);
  }

  /// R = 460 mm, 10 MN/m.
  void line_contact(tread::tests::Check &check, const double modulus)
  {
    const HertzLine line = hertz_line(0.46, modulus, 10e6);
    check.absolute("line: a [mm]", line.half_width * 1e3, 7.125, 6e-4);
    check.absolute("line: p0 [MPa]", line.max_pressure * 1e-6, 893.6, 0.06);
  }

  /// R = 460 mm on a rail head of 300 mm.
  void wheel_on_rail_head(tread::tests::Check &check, const double modulus)
  {
    struct Row
    {
      double force, a, b, p0, approach;
    };
    for (const Row &row :
         {Row{100e3, 7.162, 5.387, 1237.6, 104.1}, Row{116.8e3, 7.542, 5.673, 1303.3, 115.5},
          Row{127.1e3, 7.758, 5.835, 1340.5, 122.2}, Row{140e3, 8.012, 6.027, 1384.4, 130.3}})
      {
        const HertzEllipse h = hertz_ellipse(1. / 0.92, 1. / 0.6, modulus, row.force);
        const std::string  name =
          "ellipse " + std::to_string(static_cast<int>(row.force / 100.) / 10) + " kN: ";
        check.absolute(name + "a [mm]", h.semi_axis_x * 1e3, row.a, 6e-4);
        check.absolute(name + "b [mm]", h.semi_axis_y * 1e3, row.b, 6e-4);
        check.absolute(name + "p0 [MPa]", h.max_pressure * 1e-6, row.p0, 0.06);
        check.absolute(name + "approach [um]", h.approach * 1e6, row.approach, 0.06);
        const HertzEllipse t = hertz_ellipse(1. / 0.6, 1. / 0.92, modulus, row.force);
        check.that(name + "axes exchange with A and B",
                   t.semi_axis_x == h.semi_axis_y && t.semi_axis_y == h.semi_axis_x);
      }
    // 1 - 0.36 - 0.28: six tenths of the largest pressure; nothing beyond the edge on either axis
    const HertzEllipse press = hertz_ellipse(1. / 0.88, 1. / 0.56, modulus, 90e3);
    check.relative("pressure in an ellipse over the largest one",
                   press.pressure(-0.6 * press.semi_axis_x, std::sqrt(0.28) * press.semi_axis_y) /
                     press.max_pressure,
                   0.6, 1e-13);
    check.that("no pressure outside of the ellipse", press.pressure(1.001 * press.semi_axis_x, 0.) == 0. &&
                                                       press.pressure(0., -1.001 * press.semi_axis_y) == 0.);
    // nearly a line: the ellipse's p0 against the line's at the force per length of its middle, 3 N/(4 b)
    const HertzEllipse slender = hertz_ellipse(1., 1e-6, modulus, 1e5);
    const HertzLine    line    = hertz_line(0.5, modulus, 0.75e5 / slender.semi_axis_y);
    check.relative("slender ellipse like a line: a", slender.semi_axis_x, line.half_width, 1e-3);
  }

  /// Textbook maxima (Johnson 1985, sects. 4.1, 3.4), given with three digits.
  void stress_on_axis(tread::tests::Check &check)
  {
    const auto circle = [](const double z) {
      return hertz_axis_stress_circle(1., 1., 0.3, z);
    };
    const Maximum tau = maximum_over_depth([&](const double z) { return circle(z).max_shear(); });
    check.absolute("circle: tau_max/p0", tau.value, 0.310, 6e-4);
    check.absolute("circle: its depth/a", tau.depth, 0.481, 6e-4);
    const Maximum mises = maximum_over_depth([&](const double z) { return circle(z).von_mises(); });
    check.absolute("circle: p0/Y at first yield, nu = 0.3", 1. / mises.value, 1.613, 6e-4);
    const Maximum mises28 = maximum_over_depth(
      [](const double z) { return hertz_axis_stress_circle(1., 1., 0.28, z).von_mises(); });
    check.absolute("circle: p0/Y at first yield, nu = 0.28", 1. / mises28.value, 1.589, 6e-4);
    const auto line = [](const double z) {
      return hertz_axis_stress_line(1., 1., 0.3, z);
    };
    const Maximum tau_line = maximum_over_depth([&](const double z) { return line(z).max_shear(); });
    check.absolute("line: tau_max/p0", tau_line.value, 0.300, 6e-4);
    check.absolute("line: its depth/a", tau_line.depth, 0.786, 6e-4);
    const Maximum mises_line = maximum_over_depth([&](const double z) { return line(z).von_mises(); });
    check.absolute("line: p0/Y at first yield, von Mises", 1. / mises_line.value, 1.794, 6e-4);
  }

  /// Steel sphere R = 10 mm.
  void impact_of_sphere(tread::tests::Check &check, const double modulus)
  {
    const double      mass = 7800. * 4. / 3. * std::numbers::pi * 1e-6;
    const HertzImpact fast = hertz_impact(mass, 0.01, modulus, 1.),
                      slow = hertz_impact(mass, 0.01, modulus, 0.1);
    check.absolute("impact 1 m/s: duration [us]", fast.duration * 1e6, 68.93, 6e-3);
    check.absolute("impact 1 m/s: approach [um]", fast.max_approach * 1e6, 23.42, 6e-3);
    check.absolute("impact 1 m/s: force [N]", fast.max_force, 1743.8, 0.06);
    check.absolute("impact 1 m/s: a [mm]", fast.contact_radius * 1e3, 0.484, 6e-4);
    check.absolute("impact 1 m/s: p0 [MPa]", fast.max_pressure * 1e-6, 3555., 0.6);
    check.absolute("impact 0.1 m/s: duration [us]", slow.duration * 1e6, 109.25, 6e-3);
    check.absolute("impact 0.1 m/s: force [N]", slow.max_force, 110.0, 0.06);
    const HertzImpact rigid = hertz_impact(mass, 0.01, 2. * modulus, 1.);
    check.absolute("impact on a rigid plane: duration [us]", rigid.duration * 1e6, 52.24, 6e-3);
    check.absolute("impact on a rigid plane: force [N]", rigid.max_force, 2300.9, 0.06);
  }

  /// 54E1 (EI = 210 GPa x 2337.9 cm^4), pads 1300 and ballast 45 MN/m, sleepers 0.6 m.
  void rail_on_winkler_foundation(tread::tests::Check &check)
  {
    const double     u    = foundation_modulus(1300e6, 45e6, 0.6);
    const Zimmermann beam = zimmermann(210e9 * 2337.9e-8, u, 116.8e3);
    check.absolute("Zimmermann: u [MN/m^2]", u * 1e-6, 72.49, 6e-3);
    check.absolute("Zimmermann: L [m]", beam.length, 0.7214, 1e-4);
    check.absolute("Zimmermann: deflection [mm]", beam.max_deflection * 1e3, 1.117, 6e-4);
    check.absolute("Zimmermann: moment [kN m]", beam.max_moment * 1e-3, 21.07, 6e-3);
    check.absolute("Zimmermann: support [kN]", beam.support_force(0.6) * 1e-3, 48.57, 6e-3);
    double sum = 0.;
    for (double x = -20.; x < 20.; x += 1e-3)
      sum += 1e-3 * u * beam.deflection(x + 5e-4);
    check.relative("Zimmermann: the foundation carries F", sum, 116.8e3, 1e-6);
    // half a unit of its last digit
    check.absolute("Zimmermann: critical speed of bare 54E1 [m/s]",
                   zimmermann_critical_speed(210e9 * 2337.9e-8, u, 54.77), 830., 0.5);
  }

  /// Refused with one line that names the argument.
  void bad_input(tread::tests::Check &check, const double modulus)
  {
    check.refuses("no curvature", "curvature_x", [&] { hertz_ellipse(0., 1., modulus, 1.); });
    check.refuses("negative force", "force", [&] { hertz_ellipse(1., 1., modulus, -1.); });
    check.refuses("NaN force", "force", [&] { hertz_ellipse(1., 1., modulus, NAN); });
    check.refuses("Poisson's ratio", "Poisson's ratio of the rail", [] {
      combine(Elastic{}, Elastic{210e9, 0.6});
    });
  }
} // namespace reference_hertz

TREAD_TEST(reference_hertz)(tread::tests::Check &check, const tread::tests::Arguments &)
{
  const ElasticPair steel   = combine(Elastic{}, Elastic{});
  const double      modulus = steel.hertz_modulus();
  elastic_constants(check, steel);
  integrals(check);
  sphere_on_plane(check, modulus);
  line_contact(check, modulus);
  wheel_on_rail_head(check, modulus);
  stress_on_axis(check);
  impact_of_sphere(check, modulus);
  rail_on_winkler_foundation(check);
  bad_input(check, modulus);
}
