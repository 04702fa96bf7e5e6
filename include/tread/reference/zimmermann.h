// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_zimmermann_h
#define tread_reference_zimmermann_h

namespace tread::reference
{
  /// An infinite Euler beam on an elastic (Winkler) foundation under one load (Winkler 1867, Zimmermann
  /// 1888).
  struct Zimmermann
  {
    double length;         ///< L = (4 E I/u)^(1/4) [m]
    double force;          ///< F [N]
    double foundation;     ///< u, force per length and deflection [N/m^2]
    double max_deflection; ///< F/(2 u L), downwards [m]
    double max_moment;     ///< F L/4 [N m]

    /// w0 exp(-|x|/L)(cos |x|/L + sin |x|/L), downwards [m].
    double deflection(double x) const;
    /// M0 exp(-|x|/L)(cos |x|/L - sin |x|/L) [N m].
    double moment(double x) const;
    /// Force on a support over which the load stands, spacing u w0 = spacing F/(2 L) [N].
    double support_force(double spacing) const;
  };

  /// @param bending_stiffness E I [N m^2] > 0; @param foundation u [N/m^2] > 0; @param force F [N]
  Zimmermann zimmermann(double bending_stiffness, double foundation, double force);

  /// Foundation modulus of discrete supports: pad and ballast stiffness in series over the spacing [N/m^2].
  double foundation_modulus(double pad_stiffness, double ballast_stiffness, double spacing);

  /// Critical speed of a moving load (4 u E I/m^2)^(1/4) [m/s]; below it the deflection grows by
  /// 1/sqrt(1 - (v/vc)^2) (Timoshenko 1926; Fryba 1972, sect. 13.1). @param mass per length [kg/m]
  double zimmermann_critical_speed(double bending_stiffness, double foundation, double mass);
} // namespace tread::reference

#endif
