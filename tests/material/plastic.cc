// SPDX-License-Identifier: LGPL-2.1-or-later
// A material point that yields: closed forms of uniaxial, shear and cyclic loading, the return itself, and
// that lanes do not depend on each other.
#include <tread/material/plastic.h>

#include "check.h"

#include <algorithm>
#include <cstring>
#include <random>

using namespace tread;

namespace material_plastic
{
  /// A point with its history, driven by prescribed deformation gradients without rotation.
  template <unsigned int n>
  struct Specimen
  {
    YieldConstants<n> material;
    Lanes             G[6], plastic_strain{}, backstress[n > 0 ? n : 1][6] = {};
    PlasticPoint<n>   point;

    Specimen(const ElasticMaterial &elastic, const PlasticMaterial &plastic)
      : material(elastic, plastic)
    {
      for (unsigned int k = 0; k < 6; ++k)
        G[k] = broadcast(k < 3 ? 1. : 0.);
    }

    /// The stress that M would cause; nothing is remembered.
    void attempt(const Lanes (&M)[3][3])
    {
      point.plastic_strain = plastic_strain;
      std::memcpy(point.backstress, backstress, sizeof backstress);
      point.evaluate(material, M, G);
    }

    void load(const Lanes (&M)[3][3])
    {
      attempt(M);
      Lanes next[6];
      point.plastic_inverse(next);
      const auto yields = point.flow.strain > 0.;
      for (unsigned int k = 0; k < 6; ++k)
        G[k] = yields ? next[k] : G[k];
      plastic_strain = point.plastic_strain;
      std::memcpy(backstress, point.backstress, sizeof backstress);
    }

    /// Stretch along x to the logarithmic strain given, free laterally; the Kirchhoff stress, Pa.
    double stretch(const double strain)
    {
      double lateral = last_lateral, before = 0., stress_before = 0.;
      for (unsigned int iteration = 0; iteration < 60; ++iteration)
        {
          Lanes M[3][3] = {};
          M[0][0]       = broadcast(std::exp(strain));
          M[1][1] = M[2][2] = broadcast(std::exp(lateral));
          attempt(M);
          const double stress = point.kirchhoff[1][0];
          if (std::abs(stress) < 1e-3)
            {
              load(M);
              break;
            }
          // Secant method; the first step is elastic.
          const double next = iteration == 0
                                ? lateral - stress / 280e9
                                : lateral - stress * (lateral - before) / (stress - stress_before);
          before            = lateral;
          stress_before     = stress;
          lateral           = next;
        }
      last_lateral = lateral;
      return point.kirchhoff[0][0];
    }

    /// The same in equal steps from one strain to another.
    double stretch(const double from, const double to, const unsigned int n_steps)
    {
      double stress = 0.;
      for (unsigned int i = 1; i <= n_steps; ++i)
        stress = stretch(from + (to - from) * i / n_steps);
      return stress;
    }

    /// Pure shear in the plane xy to the engineering strain given (logarithmic, no rotation); Kirchhoff
    /// stress, Pa.
    double shear(const double gamma)
    {
      Lanes M[3][3] = {};
      M[0][0] = M[1][1] = broadcast(std::cosh(0.5 * gamma));
      M[0][1] = M[1][0] = broadcast(std::sinh(0.5 * gamma));
      M[2][2]           = broadcast(1.);
      load(M);
      return point.kirchhoff[3][0];
    }

    double last_lateral = 0.;
  };

  /// Random stretches near 1: more than ten times the yield strain.
  void random_stretch(std::mt19937 &random, const double size, Lanes (&M)[3][3])
  {
    std::uniform_real_distribution<> number(-size, size);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
        for (unsigned int l = 0; l < n_lanes; ++l)
          M[i][j][l] = M[j][i][l] = (i == j ? 1. : 0.) + number(random);
  }

  /// Largest distance from the yield surface over random histories with large increments, in yield stresses;
  /// and from plastic incompressibility.
  template <unsigned int n>
  void check_return(tests::Check &check, const std::string &name, const PlasticMaterial &plastic)
  {
    const ElasticMaterial elastic;
    std::mt19937          random(7);
    double                distance = 0., volume = 0.;
    unsigned int          n_yielded = 0;
    for (unsigned int history = 0; history < 200; ++history)
      {
        Specimen<n> specimen(elastic, plastic);
        for (unsigned int step = 0; step < 5; ++step)
          {
            Lanes M[3][3];
            random_stretch(random, 0.03, M);
            specimen.load(M);
            Lanes        s[6];
            const Lanes &mean =
              (specimen.point.kirchhoff[0] + specimen.point.kirchhoff[1] + specimen.point.kirchhoff[2]) / 3.;
            for (unsigned int k = 0; k < 6; ++k)
              {
                s[k] = specimen.point.kirchhoff[k] - (k < 3 ? mean : Lanes{});
                for (unsigned int i = 0; i < n; ++i)
                  s[k] -= specimen.backstress[i][k];
              }
            const Lanes equivalent = square_root(1.5 * contraction(s, s));
            const Lanes limit = plastic.yield_stress + plastic.isotropic_modulus * specimen.plastic_strain;
            const Lanes det   = determinant(specimen.G);
            for (unsigned int l = 0; l < n_lanes; ++l)
              if (specimen.point.flow.strain[l] > 0.)
                {
                  ++n_yielded;
                  distance = std::max(distance, std::abs(equivalent[l] - limit[l]) / plastic.yield_stress);
                  volume   = std::max(volume, std::abs(det[l] - 1.));
                }
          }
      }
    std::printf("%s: %u points yielded\n", name.c_str(), n_yielded);
    check.that(name + ": most points yield", n_yielded > 900 * n_lanes);
    check.below(name + ": distance from the yield surface/Y", distance, 1e-10);
    // The cube root in plastic_inverse() ends with its second term: cubes of volume changes of 1e-3 remain,
    // and do not add up.
    check.below(name + ": det G - 1", volume, 1e-9);
  }

  /// Lane l of a full set of lanes against the same point with any other companions.
  template <unsigned int n>
  void check_lanes(tests::Check &check, const std::string &name, const PlasticMaterial &plastic)
  {
    const ElasticMaterial elastic;
    bool                  equal = true;
    for (unsigned int kept = 0; kept < n_lanes; ++kept)
      {
        std::mt19937 random(11), other(100 + kept);
        Specimen<n>  a(elastic, plastic), b(elastic, plastic);
        for (unsigned int step = 0; step < 20; ++step)
          {
            // Some companions are elastic, some yield much.
            Lanes M[3][3], N[3][3];
            random_stretch(random, 0.004, M);
            random_stretch(other, step % 2 ? 0.05 : 1e-4, N);
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                N[i][j][kept] = M[i][j][kept];
            a.load(M);
            b.load(N);
            for (unsigned int k = 0; k < 6; ++k)
              equal = equal && a.point.kirchhoff[k][kept] == b.point.kirchhoff[k][kept] &&
                      a.G[k][kept] == b.G[k][kept];
            equal = equal && a.plastic_strain[kept] == b.plastic_strain[kept];
          }
        equal = equal && a.plastic_strain[kept] > 0.;
      }
    check.that(name + ": a lane is the same to the last bit whatever the others do", equal);
  }
} // namespace material_plastic


TREAD_TEST(material_plastic)(tests::Check &check, const tests::Arguments &)
{
  const ElasticMaterial elastic;
  const double          E = elastic.young_modulus, Y = 500e6, H = hardening_modulus(E, 21e9), MPa = 1e-6;

  PlasticMaterial isotropic;
  isotropic.yield_stress      = Y;
  isotropic.isotropic_modulus = H;
  PlasticMaterial kinematic;
  kinematic.yield_stress = Y;
  kinematic.backstresses = {{H, 0.}};
  PlasticMaterial armstrong_frederick;
  armstrong_frederick.yield_stress = Y;
  armstrong_frederick.backstresses = {{60e9, 300.}};
  PlasticMaterial chaboche;
  chaboche.yield_stress      = Y;
  chaboche.isotropic_modulus = 1e9;
  chaboche.backstresses      = {{100e9, 1000.}, {20e9, 150.}, {2e9, 0.}};

  // Elastic strain is Hencky's to 1e-5 of itself, hence 1e-4 MPa at 500 MPa and half a per cent.
  check.relative("hardening modulus, GPa", 1e-9 * H, 23.3333333, 1e-8);
  {
    Specimen<0> point(elastic, isotropic);
    check.absolute("isotropic: 1 % in one step, MPa", MPa * point.stretch(0.01), 660.0, 0.01);
    Specimen<0> slowly(elastic, isotropic);
    check.absolute("isotropic: 1 % in 100 steps, MPa", MPa * slowly.stretch(0., 0.01, 100), 660.0, 0.01);
    check.relative("plastic strain, %", 100. * slowly.plastic_strain[0], 100. * (0.01 - 660. / 210e3), 1e-4);
    check.absolute("isotropic: then to -1 %, MPa", MPa * slowly.stretch(0.01, -0.01, 200), -948.0, 0.02);
    // The next half cycle of a bi-linear material: from -948 MPa, elastic over 2 x 948.
    check.absolute("isotropic: and back to 1 %, MPa", MPa * slowly.stretch(-0.01, 0.01, 200),
                   948. + 21e3 * (0.02 - 2. * 948. / 210e3), 0.05);
  }
  {
    Specimen<1> point(elastic, kinematic);
    check.absolute("kinematic: 1 % in one step, MPa", MPa * point.stretch(0.01), 660.0, 0.01);
    check.absolute("kinematic: then to -1 %, MPa", MPa * point.stretch(0.01, -0.01, 200), -660.0, 0.02);
    check.absolute("kinematic: and back to 1 %, MPa", MPa * point.stretch(-0.01, 0.01, 200), 660.0, 0.02);
  }
  {
    Specimen<0>  point(elastic, isotropic);
    const double mu = elastic.shear_modulus(), gamma_y = Y / std::sqrt(3.) / mu;
    check.relative("shear: below yield, MPa", MPa * point.shear(0.9 * gamma_y), 0.9 * MPa * Y / std::sqrt(3.),
                   1e-5);
    const double gamma = 0.02;
    check.absolute("shear: 2 %, MPa", MPa * point.shear(gamma),
                   MPa * (Y / std::sqrt(3.) + (gamma - gamma_y) / (1. / mu + 3. / H)), 0.01);
  }
  {
    // Monotonic: a = C/gamma (1 - exp(-gamma p)); backward Euler is of first order in the step.
    double error[2];
    for (const unsigned int refined : {0u, 1u})
      {
        Specimen<1>  point(elastic, armstrong_frederick);
        const double stress = point.stretch(0., 0.01, refined ? 400 : 200);
        const double exact  = Y + 60e9 / 300. * (1. - std::exp(-300. * point.plastic_strain[0]));
        error[refined]      = std::abs(stress - exact);
        check.relative("Armstrong-Frederick: 1 %, MPa", MPa * stress, MPa * exact, 1e-3);
      }
    check.absolute("Armstrong-Frederick: order in the step", std::log2(error[0] / error[1]), 1., 0.01);
    Specimen<1> point(elastic, armstrong_frederick);
    check.relative("Armstrong-Frederick: saturated, MPa", MPa * point.stretch(0., 0.08, 200), 700., 1e-3);
    // Cycles between 1 % and -0.6 %: the stress range of a stabilised cycle is that of the closed form
    // a = (C/gamma) tanh(gamma dp/2) (Lemaitre & Chaboche 1990, section 5.4.4).
    double      high = 0., low = 0., p_before = 0.;
    Specimen<1> cycled(elastic, armstrong_frederick);
    cycled.stretch(0., 0.01, 400);
    for (unsigned int cycle = 0; cycle < 8; ++cycle)
      {
        p_before = cycled.plastic_strain[0];
        low      = cycled.stretch(0.01, -0.006, 640);
        p_before = cycled.plastic_strain[0] - p_before;
        high     = cycled.stretch(-0.006, 0.01, 640);
      }
    check.relative("Armstrong-Frederick: stable stress range, MPa", MPa * (high - low),
                   2. * MPa * (Y + 60e9 / 300. * std::tanh(0.5 * 300. * p_before)), 2e-3);
  }
  {
    // Far beyond small strain: drawn to seven times the length, the stress is still on the straight line.
    PlasticMaterial soft;
    soft.yield_stress      = Y;
    soft.isotropic_modulus = 0.1e9;
    Specimen<0>  point(elastic, soft);
    const double stress = point.stretch(0., 2., 400);
    check.relative("soft: drawn to e^2, MPa", MPa * stress, MPa * (Y + 0.1e9 * (2. - stress / E)), 1e-4);
  }
  check_return<0>(check, "isotropic", isotropic);
  check_return<1>(check, "kinematic", kinematic);
  check_return<1>(check, "Armstrong-Frederick", armstrong_frederick);
  check_return<3>(check, "Chaboche, three backstresses", chaboche);
  check_lanes<0>(check, "isotropic", isotropic);
  check_lanes<1>(check, "Armstrong-Frederick", armstrong_frederick);
  check_lanes<3>(check, "Chaboche", chaboche);
}
