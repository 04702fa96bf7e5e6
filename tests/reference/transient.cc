// SPDX-License-Identifier: LGPL-2.1-or-later
// Transient rolling of half-spaces: its start beside Cattaneo and Mindlin, its end beside steady rolling, and
// the way from one to the other in small and large steps.
#include <tread/reference/cattaneo_mindlin.h>
#include <tread/reference/hertz.h>
#include <tread/reference/rolling_estimate.h>
#include <tread/reference/transient.h>

#include "check.h"

#include <algorithm>
#include <string>

using namespace tread::reference;

namespace reference_transient
{
  /// Sphere with a contact radius of 3.5 mm (Kalker 1990, section 5.2.2.5), G = 1 N/mm2, nu = 0.28.
  RollingCase sphere(const double element_size)
  {
    RollingCase c;
    c.wheel = c.rail       = Elastic{2. * 1e6 * 1.28, 0.28};
    const double radius    = 337.5e-3;
    c.curvature_x          = 0.5 / radius;
    c.curvature_y          = 0.5 / radius;
    const ElasticPair pair = combine(c.wheel, c.rail);
    c.normal_force         = 4. * pair.hertz_modulus() * std::pow(3.5e-3, 3) / (3. * radius);
    c.friction             = 0.4013;
    c.element_size         = element_size;
    return c;
  }

  double at(const TransientResult &r, const std::vector<double> &values, const double distance)
  {
    std::size_t k = 1;
    while (k + 1 < r.distance.size() && r.distance[k] < distance)
      ++k;
    const double share = (distance - r.distance[k - 1]) / (r.distance[k] - r.distance[k - 1]);
    return values[k - 1] + share * (values[k] - values[k - 1]);
  }

  void cattaneo_to_carter(tread::tests::Check &check)
  {
    std::printf("\n--- from Cattaneo's shift to steady rolling at Fx = -0.657 f Fn\n");
    TransientCase t;
    t.rolling                      = sphere(0.25e-3);
    const double f                 = t.rolling.friction;
    t.rolling.traction_coefficient = -0.657 * f;
    t.start_traction_coefficient   = -0.657 * f;
    t.distance                     = 24.5e-3;
    t.fields_at                    = {1e-3, 2e-3, 3e-3, 5e-3, 7e-3, 24.5e-3};
    const TransientResult r        = solve_transient(t);
    const ElasticPair     pair     = combine(t.rolling.wheel, t.rolling.rail);
    const CattaneoMindlin exact = cattaneo_mindlin(0.5 / t.rolling.curvature_x, pair, t.rolling.normal_force,
                                                   f, 0.657 * f * t.rolling.normal_force);
    check.relative("contact radius [mm]", 1e3 * exact.contact_radius, 3.5, 1e-6);
    check.relative("shift without rolling [um]", 1e6 * r.start_shift, 1e6 * exact.shift, 3e-3);
    RollingCase           steady = t.rolling;
    const RollingEstimate after  = estimate_rolling(steady);
    check.relative("creepage after 7 a [1e-3]", 1e3 * r.creepage.back(), 1e3 * after.creepage.value, 2e-3);
    double largest = 0., square = 0., n = 0.;
    for (std::size_t e = 0; e < r.x.size(); ++e)
      if (r.pressure[e] > 0.)
        {
          square += std::pow(r.fields.back().shear_x[e] - after.fields.shear_x[e], 2);
          largest = std::max(largest, f * r.pressure[e]);
          n += 1.;
        }
    check.below("shear after 7 a, off steady rolling, rms over f p_max", std::sqrt(square / n) / largest,
                0.01);
    // The adhesion area of the shift lies about the middle; that of rolling at the leading edge, and the
    // traction that is left from the shift leaves at the trailing edge after 2 a.
    for (std::size_t k = 0; k < t.fields_at.size(); ++k)
      {
        double first = 0., all = 0.;
        for (std::size_t e = 0; e < r.x.size(); ++e)
          if (r.fields[k].state[e] == ElementState::adhesion)
            {
              first += r.x[e];
              all += 1.;
            }
        std::printf("after %4.1f mm: creepage %.4e, adhesion about x = %.3f mm\n", 1e3 * r.fields[k].distance,
                    at(r, r.creepage, r.fields[k].distance), 1e3 * first / all);
      }
    check.that("the force is kept", std::abs(r.traction_coefficient[20] / (-0.657 * f) - 1.) < 1e-5);
  }

  void start_at_small_creepage(tread::tests::Check &check)
  {
    std::printf("\n--- from rest at small creepage: the tangential stiffness of the contact\n");
    TransientCase t;
    t.rolling                 = sphere(0.25e-3);
    t.rolling.prescribe_force = false;
    t.rolling.creepage        = -1e-6;
    t.distance                = 0.2e-3;
    double slope[3];
    for (const unsigned int n : {1u, 2u, 3u})
      {
        t.step                  = 0.2e-3 / (1u << n);
        const TransientResult r = solve_transient(t);
        slope[n - 1]            = r.traction_coefficient[1] * t.rolling.normal_force / (1e-6 * r.distance[1]);
      }
    const ElasticPair pair    = combine(t.rolling.wheel, t.rolling.rail);
    const double      mindlin = 4. * 3.5e-3 * pair.shear / (2. - pair.poisson);
    for (const double k : slope)
      std::printf("over a first step: %.5f of Mindlin's\n", k / mindlin);
    // 28 elements across the patch; the shares of the first steps go on linearly to a step of nothing
    check.relative("dF/ds over creepage [kN/m], step of nothing", 1e-3 * (2. * slope[2] - slope[1]),
                   1e-3 * mindlin, 0.004);
  }

  /// Wheel and block at low strain: prm/verification/transient-low-strain.prm.
  RollingCase blocks(const double element_size)
  {
    RollingCase c;
    c.curvature_x     = 0.25;
    c.curvature_y     = 1. / 2.608696;
    c.normal_force    = 29232.;
    c.friction        = 0.5;
    c.prescribe_force = false;
    c.creepage        = -6.65e-4;
    c.element_size    = element_size;
    return c;
  }

  void from_rest(tread::tests::Check &check)
  {
    std::printf("\n--- from rest at a creepage that leads to a traction coefficient of 0.30\n");
    const auto roll = [](const double size, const unsigned int order, const double distance) {
      TransientCase t;
      t.rolling  = blocks(1e-3 * size);
      t.order    = order;
      t.distance = 1e-3 * distance;
      return solve_transient(t);
    };
    const TransientResult coarse = roll(0.8, 2, 72.), fine = roll(0.4, 2, 16.), first = roll(0.8, 1, 16.),
                          first_fine = roll(0.4, 1, 16.);
    const RollingEstimate steady     = estimate_rolling(blocks(0.31e-3));
    check.relative("traction coefficient after 72 mm beside steady rolling",
                   coarse.traction_coefficient.back(), steady.traction_coefficient.value, 2e-3);
    for (const double s : {1.6, 4., 8., 16.})
      {
        const auto value = [&](const TransientResult &r) {
          return at(r, r.traction_coefficient, 1e-3 * s);
        };
        char name[60];
        std::snprintf(name, sizeof name, "after %4.1f mm: ", s);
        // elements and steps of 0.8 mm, a tenth of the patch's half-length, beside 0.4 mm; the first step is
        // of first order, which is forgotten as the particles leave
        check.relative(std::string(name) + "second order", value(coarse), value(fine),
                       s < 2.   ? 0.012
                       : s < 5. ? 4e-3
                                : 2e-3);
        check.relative(std::string(name) + "first order, extrapolated", 2. * value(first_fine) - value(first),
                       value(fine), 6e-3);
        check.that(std::string(name) + "second order is nearer",
                   std::abs(value(coarse) / value(fine) - 1.) < std::abs(value(first) / value(fine) - 1.));
      }
    bool rises = true;
    for (std::size_t k = 1; k < fine.distance.size(); ++k)
      rises = rises && fine.traction_coefficient[k] > fine.traction_coefficient[k - 1];
    check.that("the traction rises all the way", rises);
  }
  /// Spin, of a number or of a tread that is coned: the end of the transient is steady rolling.
  void with_spin(tread::tests::Check &check)
  {
    std::printf("\n--- to steady rolling under spin\n");
    for (const bool coned : {false, true})
      {
        TransientCase t;
        t.rolling          = blocks(0.8e-3);
        t.rolling.creepage = -2e-4;
        if (coned)
          // Rolling radii that differ by so much have a spin, and a part that bends.
          t.rolling.radius_change = [](const double y) {
            return 0.1 * y + 12. * y * y;
          };
        else
          t.rolling.spin = 0.1;
        t.distance                   = 60e-3;
        const TransientResult after  = solve_transient(t);
        const double          steady = estimate_rolling(t.rolling).lateral_force.value;
        const std::string     name   = coned ? "coned tread: " : "spin: ";
        check.that(name + "the lateral force counts", std::abs(steady) > 0.01 * t.rolling.normal_force);
        // Steady rolling is extrapolated from two grids under spin, the transient is that of one: its own
        // error under spin is the difference (1.05 and 0.67 % found).
        check.relative(name + "lateral coefficient", after.lateral_coefficient.back(),
                       steady / t.rolling.normal_force, coned ? 0.01 : 0.015);
      }
  }
} // namespace reference_transient

TREAD_TEST(reference_transient)(tread::tests::Check &check, const tread::tests::Arguments &)
{
  cattaneo_to_carter(check);
  start_at_small_creepage(check);
  from_rest(check);
  with_spin(check);
}
