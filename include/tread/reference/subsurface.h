// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_subsurface_h
#define tread_reference_subsurface_h

#include <tread/reference/elastic.h>
#include <tread/reference/influence.h>

#include <array>
#include <vector>

namespace tread::reference
{
  /// Stress in global axes, tension positive [Pa].
  struct Stress
  {
    double xx = 0., yy = 0., zz = 0., xy = 0., xz = 0., yz = 0.;

    double von_mises() const;
    double mean() const
    {
      return (xx + yy + zz) / 3.;
    } ///< CONTACT's sig_hyd
    Stress &operator+=(const Stress &other);
  };

  /// Which body.
  enum class Body
  {
    wheel, ///< z > 0
    rail   ///< z < 0
  };

  /// Stress in a half-space z > 0 under uniform tractions (q_x, q_y, q_z) on the rectangle |x'| <= dx/2, |y'|
  /// <= dy/2 of its surface, z into the body (Love 1929 for the pressure q_z; the potentials of Boussinesq
  /// and Cerruti in Johnson 1985, sect. 3.2, integrated in closed form).
  /// @param z depth >= 0; at 0 not on the edges of the rectangle
  Stress rectangle_stress(double                       poisson,
                          double                       dx,
                          double                       dy,
                          const std::array<double, 3> &traction,
                          double                       x,
                          double                       y,
                          double                       z);

  /// Stresses in one body under the tractions of a grid, as from solve_contact (those on the wheel).
  /// @param points x, y and depth >= 0 [m] below the surface, in both bodies positive
  /// @return stresses in the global axes (z up): at the surface xz = -shear_x in both bodies
  std::vector<Stress> subsurface_stress(const Grid                               &grid,
                                        double                                    poisson,
                                        const std::vector<double>                &pressure,
                                        const std::vector<double>                &shear_x,
                                        const std::vector<double>                &shear_y,
                                        Body                                      body,
                                        const std::vector<std::array<double, 3>> &points);
} // namespace tread::reference

#endif
