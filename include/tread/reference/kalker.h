// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_kalker_h
#define tread_reference_kalker_h

namespace tread::reference
{
  // Signs in this file as in rolling_case.h: creepage xi, eta and spin phi are those of the wheel relative to
  // the rail, forces act on the wheel, so a positive xi gives a negative Fx.

  /// Kalker's creepage coefficients [-].
  struct CreepageCoefficients
  {
    double c11; ///< longitudinal
    double c22; ///< lateral
    double c23; ///< lateral force by spin
  };

  /// Coefficients of the linear theory for semi-axes a (rolling direction) and b: the table of Kalker (1990),
  /// table E3, interpolated: ln C by four-point Lagrange polynomials in ln(a/b), quadratic in nu through 0,
  /// 0.25, 0.5.
  /// @param axis_ratio a/b in [0.1, 10]
  /// @param poisson    nu in [0, 0.5]
  CreepageCoefficients creepage_coefficients(double axis_ratio, double poisson);

  /// Number of tabulated axis ratios a/b, from 0.1 to 10.
  constexpr unsigned int n_tabulated_axis_ratios = 19;
  /// The i-th tabulated a/b.
  double tabulated_axis_ratio(unsigned int i);

  /// An elliptic patch that rolls.
  struct CreepPatch
  {
    double semi_axis_x;  ///< a [m] > 0, rolling direction
    double semi_axis_y;  ///< b [m] > 0
    double shear;        ///< combined shear modulus G [Pa]
    double poisson;      ///< combined Poisson's ratio [-]
    double normal_force; ///< N [N]
    double friction;     ///< f [-]
  };

  /// Rigid slip of the wheel over the rail, divided by the rolling speed.
  struct Creepage
  {
    double longitudinal = 0.; ///< xi [-]
    double lateral      = 0.; ///< eta [-]
    double spin         = 0.; ///< phi [rad/m]
  };

  /// Tangential force on the wheel.
  struct CreepForce
  {
    double longitudinal; ///< Fx [N]
    double lateral;      ///< Fy [N]
  };

  /// Linear theory (Kalker 1967), no friction bound:
  ///   Fx = -C11 G a b xi,   Fy = -G a b (C22 eta + C23 sqrt(a b) phi).
  /// With spin positive about z (up), w_y = eta + phi x.
  CreepForce linear_theory(const CreepPatch &patch, const Creepage &creepage);

  /// Vermeulen & Johnson (1964): the adhesion area is an ellipse that touches the leading edge; no spin.
  ///   F/(f N) = 1 - (1 - tau)^3 for tau < 1, else 1;  tau^2 = (xi/xi_s)^2 + (eta/eta_s)^2,
  /// with the creepage of full slip xi_s = 2 a f p0/G (1/2) int_0^pi [(1-nu) + nu cos^2] sin^2/(a^2 b^2
  /// A^(3/2)) dphi, A = cos^2/a^2 + sin^2/b^2 (from the displacements of Johnson 1985, sect. 3.5, eq. 3.57;
  /// nu sin^2 for eta_s).
  CreepForce vermeulen_johnson(const CreepPatch &patch, const Creepage &creepage);

  /// Shen, Hedrick & Elkins (1983): the linear theory's force, rho = |F|/(f N), reduced to
  ///   f N (rho - rho^2/3 + rho^3/27) for rho < 3, else f N. Good for small spin.
  CreepForce shen_hedrick_elkins(const CreepPatch &patch, const Creepage &creepage);

  /// The longitudinal creepage at which Shen-Hedrick-Elkins gives a longitudinal force; no lateral creepage,
  /// no spin:
  ///   xi = -sign(Fx) 3 f N/(C11 G a b) (1 - (1 - |Fx|/(f N))^(1/3)).
  /// @param force Fx [N], |Fx| <= f N
  double shen_hedrick_elkins_creepage(const CreepPatch &patch, double force);
} // namespace tread::reference

#endif
