// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_material_elastic_h
#define tread_material_elastic_h

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

  /// St. Venant-Kirchhoff: second Piola-Kirchhoff stress S = lambda tr(E) 1 + 2 mu E, for
  /// small strain under any rotation. T is double or a vector of lanes; symmetric tensors
  /// are stored as xx, yy, zz, xy, yz, zx.
  template <typename T>
  inline void saint_venant_kirchhoff(const double lambda,
                                     const double mu,
                                     const T (&strain)[6],
                                     T (&stress)[6])
  {
    const T pressure_part = lambda * (strain[0] + strain[1] + strain[2]);
    for (unsigned int i = 0; i < 3; ++i)
      stress[i] = pressure_part + 2. * mu * strain[i];
    for (unsigned int i = 3; i < 6; ++i)
      stress[i] = 2. * mu * strain[i];
  }
} // namespace tread

#endif
