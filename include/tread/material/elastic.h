// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_material_elastic_h
#define tread_material_elastic_h

#include <tread/base/matrix3.h>

#include <array>
#include <cmath>

namespace tread
{
  /// Isotropic elasticity, SI units: Pa and kg/m^3.
  struct ElasticMaterial
  {
    double young_modulus = 210e9;
    double poisson_ratio = 0.3;
    double density       = 7800.;

    double shear_modulus() const
    {
      return young_modulus / (2. * (1. + poisson_ratio));
    }
    /// Lame's first constant.
    double lame() const
    {
      return young_modulus * poisson_ratio / ((1. + poisson_ratio) * (1. - 2. * poisson_ratio));
    }
    /// Speed of pressure waves, m/s.
    double pressure_wave_speed() const
    {
      return std::sqrt((lame() + 2. * shear_modulus()) / density);
    }
    /// Speed of shear waves, m/s.
    double shear_wave_speed() const
    {
      return std::sqrt(shear_modulus() / density);
    }
  };

  /// Equivalent stress of von Mises, of xx, yy, zz, xy, yz, zx.
  inline double von_mises(const std::array<double, 6> &s)
  {
    const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
    return std::sqrt(0.5 * (a * a + b * b + c * c) + 3. * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
  }

  /// An isotropic material whose Cauchy stress is linear in the logarithmic strain (Hencky 1928) to second
  /// order, as in cells that yield (PlasticPoint): hyperelastic in the Green-Lagrange strain E, with the
  /// energy of ln(U) = E - E^2 + O(E^3) to third order,
  ///   W = lambda/2 (tr(E)^2 - 2 tr(E) tr(E^2)) + mu (tr(E^2) - 2 tr(E^3)).
  /// St. Venant and Kirchhoff's law, linear in E, softens in compression: by one per cent at a strain of half
  /// a per cent. Meant for the strains of elastic steel: in tension beyond E = 1/6 this law softens without
  /// end. T is double or a vector of lanes; symmetric tensors are stored as xx, yy, zz, xy, yz, zx.
  template <typename T>
  struct HenckyPoint
  {
    const T (&strain)[6];
    T square[6]; ///< E^2
    T trace, trace_of_square;

    explicit HenckyPoint(const T (&E)[6])
      : strain(E)
    {
      commuting_product(E, E, square);
      trace           = E[0] + E[1] + E[2];
      trace_of_square = square[0] + square[1] + square[2];
    }

    /// Second Piola-Kirchhoff stress, dW/dE, Pa.
    void stress(const double lambda, const double mu, T (&S)[6]) const
    {
      const T mean = lambda * (trace - trace_of_square), slope = 2. * mu - (2. * lambda) * trace;
      for (unsigned int k = 0; k < 6; ++k)
        S[k] = slope * strain[k] - (6. * mu) * square[k];
      for (unsigned int k = 0; k < 3; ++k)
        S[k] += mean;
    }

    /// W, over the undeformed volume, J/m^3.
    T energy(const double lambda, const double mu) const
    {
      return 0.5 * lambda * (trace * trace - 2. * trace * trace_of_square) +
             mu * (trace_of_square - 2. * contraction(square, strain));
    }
  };
} // namespace tread

#endif
