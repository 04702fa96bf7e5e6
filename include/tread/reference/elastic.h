// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_elastic_h
#define tread_reference_elastic_h

namespace tread::reference
{
  /// Isotropic elastic constants of one body.
  struct Elastic
  {
    double young   = 210e9; ///< Young's modulus [Pa], > 0
    double poisson = 0.3;   ///< Poisson's ratio [-], in [0, 0.5]

    /// Shear modulus G = E / (2 (1 + nu)) [Pa].
    double shear() const;
  };

  /// The two bodies as the half-space kernels see them (Kalker 1990, eq. 1.44):
  ///   1/G  = (1/G1 + 1/G2)/2,
  ///   nu/G = (nu1/G1 + nu2/G2)/2,
  ///   K/G  = ((1 - 2 nu1)/G1 - (1 - 2 nu2)/G2)/4.
  /// K couples the normal and the tangential problem; it is zero for like bodies.
  struct ElasticPair
  {
    double shear    = 0.; ///< combined shear modulus G [Pa]
    double poisson  = 0.; ///< combined Poisson's ratio nu [-]
    double coupling = 0.; ///< difference parameter K [-]
    /// Thickness over shear modulus of a layer between the bodies, which lets the surfaces shift by so much
    /// for a unit of shear stress at the place [m/Pa] (Hou, Kalousek & Magel 1997); 0: none.
    double layer = 0.;

    /// Hertz modulus E* = 1 / ((1 - nu1^2)/E1 + (1 - nu2^2)/E2) = G / (1 - nu) [Pa].
    double hertz_modulus() const;
  };

  /// Combine wheel (body 1, upper) and rail (body 2, lower).
  /// Throws std::invalid_argument for constants out of range.
  ElasticPair combine(const Elastic &wheel, const Elastic &rail);
} // namespace tread::reference

#endif
