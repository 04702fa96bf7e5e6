// SPDX-License-Identifier: LGPL-2.1-or-later
/// Hencky's law to second order: the Cauchy stress over the logarithmic strain, the energy, and the same
/// forces from elastic cells and from cells of a plastic zone that do not yield.
#include <tread/material/elastic.h>
#include <tread/material/plastic.h>
#include <tread/solid/solid.h>

#include <deal.II/base/mpi.h>

#include <boxes.h>
#include <check.h>

#include <cmath>

using namespace tread;

namespace material_elastic
{
  const ElasticMaterial steel;

  /// Stretches along the axes to these logarithmic strains: Cauchy stress along x, Pa.
  double cauchy_stress(const double (&e)[3])
  {
    double E[6] = {}, S[6], volume = 1.;
    for (unsigned int i = 0; i < 3; ++i)
      {
        E[i] = 0.5 * (std::exp(2. * e[i]) - 1.);
        volume *= std::exp(e[i]);
      }
    HenckyPoint<double>(E).stress(steel.lame(), steel.shear_modulus(), S);
    return S[0] * std::exp(2. * e[0]) / volume;
  }

  /// The part of second order in the strain, over the part of first order and the strain: 0 of a law that is
  /// linear in the logarithmic strain but for the change of volume, by which Cauchy's and Kirchhoff's stress
  /// differ.
  double second_order(const double (&direction)[3], const double strain)
  {
    double there[3], back[3], trace = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      {
        there[i] = strain * direction[i];
        back[i]  = -there[i];
        trace += there[i];
      }
    const double pull = cauchy_stress(there) * std::exp(trace), push = cauchy_stress(back) * std::exp(-trace);
    return (pull + push) / (pull - push) / strain;
  }

  void test_law(tests::Check &check)
  {
    // St. Venant and Kirchhoff's law has 3 e/2 and more here.
    check.below("curvature over slope, uniaxial strain", second_order({1., 0., 0.}, 1e-3), 1e-3);
    check.below("curvature over slope, compressed along x", second_order({-1., 0.3, 0.3}, 1e-3), 1e-3);
    check.below("curvature over slope, along y", second_order({0.2, 1., -0.5}, 1e-3), 1e-3);
    // What is left is of third order, seven times the square of the strain; St. Venant and Kirchhoff: 1.5e-2.
    const double modulus = steel.lame() + 2. * steel.shear_modulus();
    check.relative("Kirchhoff stress at 0.5 % of uniaxial strain, MPa",
                   1e-6 * cauchy_stress({-5e-3, 0., 0.}) * std::exp(-5e-3), -1e-6 * modulus * 5e-3, 3e-4);

    // S = dW/dE by differences, at a strain of some per cent with shear.
    const double E[6] = {0.02, -0.03, 0.01, 0.015, -0.02, 0.025};
    double       S[6], largest = 0., error = 0.;
    HenckyPoint<double>(E).stress(steel.lame(), steel.shear_modulus(), S);
    for (unsigned int k = 0; k < 6; ++k)
      {
        const double step = 1e-5;
        double       energy[2];
        for (const unsigned int side : {0u, 1u})
          {
            double moved[6];
            std::copy(E, E + 6, moved);
            moved[k] += side == 1 ? step : -step;
            energy[side] = HenckyPoint<double>(moved).energy(steel.lame(), steel.shear_modulus());
          }
        const double slope = (energy[1] - energy[0]) / (2. * step) * (k < 3 ? 1. : 0.5);
        largest            = std::max(largest, std::abs(S[k]));
        error              = std::max(error, std::abs(S[k] - slope));
      }
    check.below("stress beside the energy's slope, over the largest", error / largest, 1e-8);
  }

  /// Forces of a block under half a per cent of strain, with a gradient.
  NodalField forces(const Mesh &mesh, const std::vector<PlasticZone> &zones)
  {
    const Solid solid(mesh, {steel}, SolidParameters(), zones);
    NodalField  x(mesh.nodes.size()), f(mesh.nodes.size(), Vector3{});
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        const auto &X = mesh.nodes[i];
        x[i] =
          Vector3{X[0] * (1. + 2e-3 + 0.02 * X[2]), X[1] * (1. + 1e-3), X[2] * (1. - 5e-3 - 0.02 * X[0]), 0.};
      }
    solid.add_internal_forces(x.data(), x.data(), f.data());
    return f;
  }

  void test_cells(tests::Check &check)
  {
    const Mesh  mesh(MPI_COMM_SELF, {tests::make_box("box", dealii::Point<3>(),
                                                     dealii::Point<3>(0.1, 0.1, 0.1), {{3, 3, 3}})});
    PlasticZone zone;
    zone.body     = 0;
    zone.contains = [](const dealii::Point<3> &) {
      return true;
    };
    zone.material.yield_stress = 1e15;
    const NodalField elastic = forces(mesh, {}), plastic = forces(mesh, {zone});
    double           largest = 0., error = 0.;
    for (unsigned int i = 0; i < elastic.size(); ++i)
      {
        largest = std::max(largest, std::sqrt(dot(elastic[i], elastic[i])));
        error   = std::max(error, std::sqrt(dot(elastic[i] - plastic[i], elastic[i] - plastic[i])));
      }
    // Third order: the square of the strain. St. Venant and Kirchhoff's law differs by 1e-2.
    check.below("forces of elastic cells beside those of cells that could yield", error / largest, 5e-4);
  }
} // namespace material_elastic


TREAD_TEST(material_elastic)(tests::Check &check, const tests::Arguments &)
{
  test_law(check);
  test_cells(check);
}
