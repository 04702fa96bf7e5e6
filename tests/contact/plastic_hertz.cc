// SPDX-License-Identifier: LGPL-2.1-or-later
// First yield under a sphere: below the surface, at a pressure of 1.613 times the yield stress for Poisson's
// ratio 0.3 (Johnson 1985, section 6.1: 1.60; the figure here is the maximum of Huber's stresses).
#include <tread/reference/hertz.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include "check.h"
#include "pressed.h"

#include <algorithm>

using namespace tread;
using dealii::Point;

namespace plastic_hertz
{
  constexpr double radius = 0.05, yield = 500e6; // m, Pa

  struct Yielding
  {
    double       largest_strain = 0., depth = 0.; ///< plastic strain, and where it is largest (m)
    double       force          = 0.;             ///< that acts, N
    double       largest_stress = 0.;             ///< of von Mises, Pa
    unsigned int n_yielded      = 0;
  };

  /// A rigid hub presses a sphere that stays elastic on a block that may yield.
  Yielding press(const double force, const double a)
  {
    const double    size = 14. * a, h = a / 16.;
    PlasticMaterial material;
    material.yield_stress      = yield;
    material.isotropic_modulus = hardening_modulus(210e9, 21e9);
    tests::PressParameters parameters;
    parameters.force         = force;
    parameters.axle          = size;
    parameters.plastic_zones = {{0, material, [=](const Point<3> &p) {
                                   return p[2] > -1.2 * a && p.norm() < 2. * a;
                                 }}};
    tests::Pressed pressed(
      tests::sphere_on_flat(radius, size, 64. * h, tests::zone_around(a, a, h, 0.75 * a)), parameters);
    pressed.relax();

    const Mesh             &mesh     = pressed.mesh;
    const Solid            &solid    = pressed.solid;
    const ExplicitDynamics &dynamics = pressed.dynamics;
    Yielding                result;
    result.force                     = pressed.force();
    const std::vector<double> strain = solid.plastic().equivalent_plastic_strain(dynamics.state.history);
    const auto stress = solid.cauchy_stress(dynamics.state.positions().data(), dynamics.state.history);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (solid.plastic().contains(c))
        {
          result.largest_stress = std::max(result.largest_stress, von_mises(stress[c]));
          result.n_yielded += strain[c] > 0.;
          if (strain[c] > result.largest_strain)
            {
              result.largest_strain = strain[c];
              result.depth          = 0.;
              for (const unsigned int i : mesh.cells[c].nodes)
                result.depth -= mesh.nodes[i][2] / 8.;
            }
        }
    return result;
  }
} // namespace plastic_hertz


TREAD_TEST(plastic_hertz)(tests::Check &check, const tests::Arguments &)
{
  const double modulus = 210e9 / (2. * (1. - 0.09)), pi = dealii::numbers::PI;
  // The force of a given largest pressure p0 (Hertz): F = pi^3 p0^3 R^2/(6 E*^2).
  const auto force_of = [&](const double p0) {
    return std::pow(pi * p0, 3) * radius * radius / (6. * modulus * modulus);
  };
  const double p_first = 1.613 * yield,
               a       = reference::hertz_sphere(radius, modulus, force_of(p_first)).semi_axis_x;
  for (const double share : {0.98, 1.02})
    {
      const Yielding    result = press(force_of(share * p_first), a);
      const std::string name   = "p0 = " + std::to_string(share).substr(0, 4) + " of first yield: ";
      std::printf("%sforce %.2f N, largest stress %.2f MPa, %u cells yield, most at depth %.3f a\n",
                  name.c_str(), result.force, 1e-6 * result.largest_stress, result.n_yielded,
                  result.depth / a);
      check.relative(name + "force, N", result.force, force_of(share * p_first), 1e-3);
      if (share < 1.)
        {
          check.that(name + "nothing yields", result.n_yielded == 0);
          check.relative(name + "largest stress/Y", result.largest_stress / yield, share, 0.02);
        }
      else
        {
          check.that(name + "yields", result.n_yielded > 0);
          check.relative(name + "depth/a", result.depth / a, 0.481, 0.1);
        }
    }
}
