// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_hertz_h
#define tread_reference_hertz_h

namespace tread::reference
{
  /// Complete elliptic integrals of modulus e (m = e^2), by the arithmetic-geometric mean
  /// (Abramowitz & Stegun 1964, 17.6), with the two combinations that Hertz's theory needs free of
  /// cancellation.
  struct EllipticIntegrals
  {
    double first;      ///< K(e)
    double second;     ///< E(e)
    double difference; ///< D(e) = (K - E)/e^2, pi/4 at e = 0
    double complement; ///< B(e) = (E - (1 - e^2) K)/e^2, pi/4 at e = 0
  };

  /// @param modulus e in [0, 1)
  EllipticIntegrals elliptic_integrals(double modulus);

  /// Elliptic (or circular) Hertz contact.
  struct HertzEllipse
  {
    double semi_axis_x;   ///< a [m]
    double semi_axis_y;   ///< b [m]
    double max_pressure;  ///< p0 = 3 N / (2 pi a b) [Pa]
    double mean_pressure; ///< 2 p0 / 3 [Pa]
    double approach;      ///< of distant points [m]
    double area;          ///< pi a b [m^2]
    double stiffness;     ///< dN/d(approach) = 1.5 N / approach [N/m]

    /// p0 sqrt(1 - x^2/a^2 - y^2/b^2), zero outside [Pa].
    double pressure(double x, double y) const;
  };

  /// Two bodies with the undeformed gap A x^2 + B y^2 pressed together (Hertz 1882; Johnson 1985, eqs. 4.25
  /// to 4.28):
  ///   A = p0/E* b/(a^2) D(e), B = p0/E* b/(b^2) B(e), approach = p0/E* b K(e), for a >= b and e^2 = 1 -
  ///   b^2/a^2.
  /// @param curvature_x   A [1/m] > 0
  /// @param curvature_y   B [1/m] > 0
  /// @param hertz_modulus E* [Pa] > 0
  /// @param force         N [N] > 0
  HertzEllipse hertz_ellipse(double curvature_x, double curvature_y, double hertz_modulus, double force);

  /// Sphere of radius R (relative: 1/R = 1/R1 + 1/R2) on a half-space:
  /// a^3 = 3 N R/(4 E*), approach = a^2/R (Johnson 1985, eqs. 4.22 to 4.24).
  HertzEllipse hertz_sphere(double radius, double hertz_modulus, double force);

  /// Line contact of parallel cylinders.
  struct HertzLine
  {
    double half_width;    ///< a, a^2 = 4 P R/(pi E*) [m]
    double max_pressure;  ///< p0 = 2 P/(pi a) [Pa]
    double mean_pressure; ///< pi/4 p0 [Pa]

    /// p0 sqrt(1 - x^2/a^2), zero outside [Pa].
    double pressure(double x) const;
  };

  /// @param radius         relative radius R [m] > 0, gap x^2/(2 R)
  /// @param hertz_modulus  E* [Pa] > 0
  /// @param force_per_length P [N/m] > 0  (Johnson 1985, eqs. 4.43 to 4.45)
  HertzLine hertz_line(double radius, double hertz_modulus, double force_per_length);

  /// Stresses on the axis of symmetry under a contact, tension positive [Pa].
  struct AxisStress
  {
    double sigma_x; ///< in the plane of the line contact, or radial
    double sigma_y; ///< along the line, or circumferential
    double sigma_z; ///< vertical

    double max_shear() const; ///< Tresca: half the largest difference of principal stresses
    double von_mises() const;
  };

  /// On the axis under a circular Hertz contact (Johnson 1985, eq. 3.45). @param depth z >= 0 [m]
  AxisStress hertz_axis_stress_circle(double radius_of_contact,
                                      double max_pressure,
                                      double poisson,
                                      double depth);

  /// On the axis under a line contact, plane strain (Johnson 1985, eq. 4.46). @param depth z >= 0 [m]
  AxisStress hertz_axis_stress_line(double half_width, double max_pressure, double poisson, double depth);

  /// Elastic impact of a sphere (Hertz 1882; Johnson 1985, eqs. 11.20 to 11.24).
  struct HertzImpact
  {
    double max_approach;   ///< (15 m v^2/(16 E* sqrt R))^(2/5) [m]
    double duration;       ///< 2.9432 max_approach / v [s]
    double max_force;      ///< 4/3 E* sqrt(R) max_approach^(3/2) [N]
    double contact_radius; ///< at maximum force [m]
    double max_pressure;   ///< at maximum force [Pa]
  };

  /// @param mass effective mass m, 1/m = 1/m1 + 1/m2 [kg] > 0; @param radius relative radius [m] > 0
  /// @param hertz_modulus E* [Pa] > 0; @param velocity closing velocity [m/s] > 0
  HertzImpact hertz_impact(double mass, double radius, double hertz_modulus, double velocity);
} // namespace tread::reference

#endif
