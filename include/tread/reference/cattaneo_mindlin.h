// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_cattaneo_mindlin_h
#define tread_reference_cattaneo_mindlin_h

#include <tread/reference/elastic.h>

namespace tread::reference
{
  /// Spheres pressed together by N, then sheared by T < f N without rolling
  /// (Cattaneo 1938, Mindlin 1949; Johnson 1985, sect. 7.2). Like bodies in the sense K = 0.
  struct CattaneoMindlin
  {
    double contact_radius;  ///< a [m]
    double adhesion_radius; ///< c = a (1 - T/(f N))^(1/3) [m]
    double max_pressure;    ///< p0 [Pa]
    double friction;        ///< f [-]
    double shift;           ///< relative displacement of distant points,
                            ///< 3 f N (2 - nu)/(8 a G) [1 - (1 - T/(f N))^(2/3)] [m]

    /// Magnitude of the shear at radius r: f p0 {sqrt(1 - r^2/a^2) - (c/a) sqrt(1 - r^2/c^2)} [Pa].
    double shear(double r) const;
  };

  /// @param radius relative radius R [m]; @param pair combined constants; @param normal_force N [N] > 0;
  /// @param friction f > 0; @param tangential_force T [N], 0 <= T <= f N
  CattaneoMindlin cattaneo_mindlin(double             radius,
                                   const ElasticPair &pair,
                                   double             normal_force,
                                   double             friction,
                                   double             tangential_force);

  /// Energy lost per cycle when T oscillates between -T* and T* (Mindlin & Deresiewicz 1953; Johnson 1985,
  /// eq. 7.57), q = T*/(f N):
  ///   9 f^2 N^2/(10 a) 2 (2 - nu)/G {1 - (1 - q)^(5/3) - (5 q/6)[1 + (1 - q)^(2/3)]}  [J].
  double cattaneo_mindlin_cycle_energy(double             radius,
                                       const ElasticPair &pair,
                                       double             normal_force,
                                       double             friction,
                                       double             amplitude);
} // namespace tread::reference

#endif
