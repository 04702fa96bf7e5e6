// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_carter_h
#define tread_reference_carter_h

namespace tread::reference
{
  /// Two-dimensional steady rolling of like cylinders (Carter 1926; Johnson 1985, sect. 8.3). Signs as in
  /// rolling_case.h: x in rolling direction, tractions on the wheel, xi < 0 drives.
  struct Carter
  {
    double half_width;       ///< a [m]
    double max_pressure;     ///< p0 [Pa]
    double friction;         ///< f [-]
    double radius;           ///< relative radius R, gap x^2/(2 R) [m]
    double creepage;         ///< xi [-]
    double adhesion_half;    ///< half-width a' of the adhesion area, which reaches from a - 2 a' to a [m]
    double force_per_length; ///< Q on the wheel [N/m]
    double traction_ratio;   ///< Q/(f P) [-], sign of Q

    /// Shear traction on the wheel, f p0 {sqrt(1 - x^2/a^2) - (a'/a) sqrt(1 - (x - d)^2/a'^2)}, d = a - a'
    /// [Pa].
    double shear(double x) const;
    /// Slip of the wheel relative to the rail over the speed: -sign(Q) (f/R) sqrt((x - d)^2 - a'^2) behind
    /// the adhesion area [-].
    double relative_slip(double x) const;
  };

  /// Carter's solution at a creepage: a'/a = 1 - |xi| R/(f a), Q/(f P) = 1 - (a'/a)^2.
  /// @param radius relative radius R [m]; @param hertz_modulus E* [Pa]; @param force_per_length P [N/m];
  /// @param friction f > 0; @param creepage xi [-], negative for driving
  Carter carter(double radius,
                double hertz_modulus,
                double force_per_length,
                double friction,
                double creepage);

  /// The creepage at which Q/(f P) takes a value: xi = -sign(Q) f a/R (1 - sqrt(1 - |Q|/(f P))).
  /// @param traction_ratio Q/(f P) in [-1, 1]
  double carter_creepage(double radius,
                         double hertz_modulus,
                         double force_per_length,
                         double friction,
                         double traction_ratio);
} // namespace tread::reference

#endif
