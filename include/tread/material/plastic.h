// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_material_plastic_h
#define tread_material_plastic_h

#include <tread/base/matrix3.h>
#include <tread/material/elastic.h>

#include <vector>

namespace tread
{
  /// Plastic properties in addition to an elastic material: von Mises, with linear isotropic hardening and up
  /// to three backstresses (Chaboche 1986). SI units.
  struct PlasticMaterial
  {
    /// da = (2/3) C de_p - gamma a dp: linear kinematic hardening for gamma = 0 (Prager 1956), else that of
    /// Armstrong & Frederick (1966), which saturates at C/gamma.
    struct Backstress
    {
      double modulus;  ///< C, Pa
      double recovery; ///< gamma, no unit
    };
    static constexpr unsigned int max_backstresses = 3;

    double                  yield_stress      = 0.; ///< Pa; 0: does not yield
    double                  isotropic_modulus = 0.; ///< slope of the yield stress over plastic strain, Pa
    std::vector<Backstress> backstresses;
  };

  /// Slope of the stress over the plastic strain, E Et/(E - Et), of a bi-linear material with Young's modulus
  /// E and tangent modulus Et < E, all in Pa.
  inline double hardening_modulus(const double young_modulus, const double tangent_modulus)
  {
    return young_modulus * tangent_modulus / (young_modulus - tangent_modulus);
  }

  /// The constants of a material point with n backstresses.
  template <unsigned int n>
  struct YieldConstants
  {
    double bulk_modulus, shear_modulus, yield_stress, isotropic_modulus;
    double modulus[n > 0 ? n : 1], recovery[n > 0 ? n : 1];

    YieldConstants(const ElasticMaterial &elastic, const PlasticMaterial &plastic)
      : bulk_modulus(elastic.lame() + 2. / 3. * elastic.shear_modulus())
      , shear_modulus(elastic.shear_modulus())
      , yield_stress(plastic.yield_stress)
      , isotropic_modulus(plastic.isotropic_modulus)
      , modulus{}
      , recovery{}
    {
      for (unsigned int i = 0; i < n; ++i)
        {
          modulus[i]  = plastic.backstresses[i].modulus;
          recovery[i] = plastic.backstresses[i].recovery;
        }
    }
  };

  /// Result of a step of plastic flow; 0 in lanes that did not yield.
  struct Flow
  {
    Lanes strain; ///< increment of the equivalent plastic strain
    Lanes work;   ///< of the stress on the plastic strain, J/m^3
    Lanes share;  ///< by which the stress was taken back: 3 mu dp over the equivalent trial stress
  };

  /// Radial return (Wilkins 1964; Simo & Hughes 1998, section 3.3; with backstresses Chaboche 1986): backward
  /// Euler from the deviatoric trial stress to the yield surface. Closed form for linear hardening, else
  /// Newton for the equivalent plastic strain, to 1e-12 of the yield stress. No lane depends on another.
  /// @param s deviatoric trial stress (Pa), replaced by the stress.
  /// @param backstress n of them (Pa) before, and after the step.
  /// @param plastic_strain equivalent, before and after the step.
  template <unsigned int n>
  inline Flow radial_return(const YieldConstants<n> &material,
                            Lanes (&s)[6],
                            Lanes (*backstress)[6],
                            Lanes &plastic_strain)
  {
    const double mu = material.shear_modulus, hardening = material.isotropic_modulus;
    const Lanes  zero{};
    Lanes        overstress[6]; // over what the backstresses will have become
    for (unsigned int k = 0; k < 6; ++k)
      {
        overstress[k] = s[k];
        for (unsigned int i = 0; i < n; ++i)
          overstress[k] -= backstress[i][k];
      }
    Lanes       equivalent = square_root(1.5 * contraction(overstress, overstress));
    const Lanes excess     = equivalent - (material.yield_stress + hardening * plastic_strain);
    const auto  yields     = excess > 0.;
    if (!any(yields))
      return {zero, zero, zero};

    double slope = 3. * mu + hardening;
    for (unsigned int i = 0; i < n; ++i)
      slope += material.modulus[i];
    Lanes dp = yields ? excess * (1. / slope) : zero;
    Lanes theta[n > 0 ? n : 1];
    if constexpr (n > 0)
      {
        constexpr unsigned int max_iterations = 50;
        for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
          {
            Lanes change[6] = {}, resistance = zero + 3. * mu, resistance_slope = zero + 3. * mu;
            for (unsigned int k = 0; k < 6; ++k)
              overstress[k] = s[k];
            for (unsigned int i = 0; i < n; ++i)
              {
                theta[i] = 1. / (1. + material.recovery[i] * dp);
                resistance += material.modulus[i] * theta[i];
                resistance_slope += material.modulus[i] * theta[i] * theta[i];
                for (unsigned int k = 0; k < 6; ++k)
                  {
                    overstress[k] -= theta[i] * backstress[i][k];
                    change[k] += material.recovery[i] * theta[i] * theta[i] * backstress[i][k];
                  }
              }
            equivalent = square_root(1.5 * contraction(overstress, overstress));
            const Lanes error =
              equivalent - dp * resistance - (material.yield_stress + hardening * (plastic_strain + dp));
            const Lanes error_size = error < 0. ? -error : error;
            const auto  goes_on    = yields & (error_size > 1e-12 * material.yield_stress);
            if (!any(goes_on))
              break;
            const Lanes derivative =
              1.5 * contraction(overstress, change) / equivalent - resistance_slope - hardening;
            const Lanes next = dp - error / derivative;
            dp               = goes_on ? (next > 0. ? next : 0.5 * dp) : dp;
          }
      }
    Flow flow;
    flow.strain = dp;
    flow.share  = yields ? 3. * mu * dp / equivalent : zero;
    flow.work   = zero;
    Lanes increment[6]; // of the plastic strain
    for (unsigned int k = 0; k < 6; ++k)
      {
        increment[k] = yields ? 1.5 * dp * overstress[k] / equivalent : zero;
        s[k] -= 2. * mu * increment[k];
        for (unsigned int i = 0; i < n; ++i)
          backstress[i][k] = yields
                               ? theta[i] * (backstress[i][k] + 2. / 3. * material.modulus[i] * increment[k])
                               : backstress[i][k];
      }
    flow.work = contraction(s, increment);
    plastic_strain += dp;
    return flow;
  }

  /// Elasto-plastic material point at large rotation and large plastic, small elastic strain: the left
  /// Cauchy-Green tensor of the elastic part, b = M G M^T, with the inverse G of the plastic right
  /// Cauchy-Green tensor as the history, takes the place of the strain (Simo 1992). M is the deformation
  /// gradient; with backstresses it is its right stretch, M = U of F = R U, so that these turn with the
  /// material (Green & Naghdi 1965; Dienes 1979).
  ///
  /// The elastic strain is the first Pade approximant of Hencky's, z = (b - 1)(b + 1)^-1 = ln(b)/2 + O(z^3),
  /// whose inverse b = (1 + z)(1 - z)^-1 is exact.
  template <unsigned int n>
  struct PlasticPoint
  {
    Lanes inverse[3][3]; ///< of M
    Lanes elastic[6];    ///< z after the return
    Lanes kirchhoff[6];  ///< stress over the undeformed volume, in the frame of M, Pa
    Lanes energy;        ///< elastic, J/m^3
    Lanes plastic_strain;
    Lanes backstress[n > 0 ? n : 1][6];
    Flow  flow;

    /// @param deformation M; @param plastic_inverse G; the rest of the history is in plastic_strain and
    /// backstress, which must be set before.
    void evaluate(const YieldConstants<n> &material,
                  const Lanes (&deformation)[3][3],
                  const Lanes (&plastic_inverse)[6])
    {
      invert(deformation, inverse);
      Lanes b[6];
      congruence(deformation, plastic_inverse, b);
      for (unsigned int i = 0; i < 3; ++i)
        b[i] += 1.;
      invert(b, elastic);
      for (unsigned int k = 0; k < 6; ++k)
        elastic[k] = (k < 3 ? 1. : 0.) - 2. * elastic[k];
      const Lanes dilatation = elastic[0] + elastic[1] + elastic[2], mean = dilatation * (1. / 3.);
      Lanes       s[6];
      for (unsigned int k = 0; k < 6; ++k)
        s[k] = 2. * material.shear_modulus * (k < 3 ? elastic[k] - mean : elastic[k]);
      flow = radial_return<n>(material, s, backstress, plastic_strain);
      for (unsigned int k = 0; k < 6; ++k)
        {
          elastic[k]   = (1. / (2. * material.shear_modulus)) * s[k];
          kirchhoff[k] = s[k];
        }
      for (unsigned int i = 0; i < 3; ++i)
        {
          elastic[i] += mean;
          kirchhoff[i] += material.bulk_modulus * dilatation;
        }
      energy = 0.5 * contraction(kirchhoff, elastic);
    }

    /// G after the flow, with determinant 1: plastic flow keeps the volume.
    void plastic_inverse(Lanes (&result)[6]) const
    {
      Lanes b[6], rest[6];
      for (unsigned int k = 0; k < 6; ++k)
        rest[k] = (k < 3 ? 1. : 0.) - elastic[k];
      invert(rest, b);
      for (unsigned int k = 0; k < 6; ++k)
        b[k] = 2. * b[k] - (k < 3 ? 1. : 0.);
      congruence(inverse, b, result);
      // The cube root of a number so near 1 needs no more than its first two terms.
      const Lanes change = determinant(result) - 1.,
                  factor = 1. - (1. / 3.) * change + (2. / 9.) * change * change;
      for (Lanes &component : result)
        component *= factor;
    }
  };
} // namespace tread

#endif
