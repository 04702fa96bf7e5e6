// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_rolling_estimate_h
#define tread_reference_rolling_estimate_h

#include <tread/reference/rolling_case.h>

namespace tread::reference
{
  /// A value with the uncertainty of its distance from the limit of small elements.
  struct Estimate
  {
    double value       = 0.;
    double uncertainty = 0.; ///< >= 0, same unit
  };

  /// The answer to a RollingCase in the limit of small elements. Signs and units as in RollingResult.
  ///
  /// The slip is of second order in the element size and the leading edge may lie within an element
  /// (TangentialProblem::order 2). What elements cannot count smoothly is measured within them: the border of
  /// adhesion where the square of what is left to the friction bound and, beyond, that of the slip go through
  /// zero (both begin as the square root of the distance; Carter 1926), the largest shear on that border, the
  /// largest slip at the trailing edge. The uncertainty comes from a second grid with elements half as large
  /// again; tests/reference/convergence.cc compares it with the true error.
  struct RollingEstimate
  {
    Estimate max_pressure;         ///< [Pa]
    Estimate creepage;             ///< longitudinal, negative for a driving wheel [-]
    Estimate longitudinal_force;   ///< Fx on the wheel [N]
    Estimate lateral_force;        ///< Fy on the wheel [N]
    Estimate traction_coefficient; ///< Fx/Fn [-]
    Estimate area;                 ///< [m^2]
    Estimate adhesion_share;       ///< of the area [-]
    Estimate max_shear;            ///< [Pa]
    Estimate max_slip;             ///< [m/s]
    Estimate frictional_power;     ///< as RollingResult::power_balance [W]

    RollingResult fields; ///< of the finer grid
  };

  /// Two solutions, with elements of the size of the case and half as large again.
  /// Errors: as solve_rolling().
  RollingEstimate estimate_rolling(const RollingCase &rolling_case);

  /// The creepage at which a wheel transmits Fx = traction_coefficient Fn: magnitude with the sign of the
  /// force, POSITIVE FOR A DRIVING WHEEL (circumferential speed over rolling speed, minus one), i.e. minus
  /// RollingEstimate::creepage.
  double creepage_for_traction(const RollingCase &rolling_case);
} // namespace tread::reference

#endif
