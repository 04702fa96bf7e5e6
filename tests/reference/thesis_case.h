// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tests_reference_thesis_case_h
#define tread_tests_reference_thesis_case_h

#include <tread/reference/rolling_case.h>

namespace tread::tests
{
  /// A wheel of 460 mm on a rail head of 300 mm at 127.1 kN, friction 0.5, 140 km/h.
  /// @param traction_coefficient share of the normal force
  inline reference::RollingCase thesis_case(const double traction_coefficient, const double element_size_mm)
  {
    reference::RollingCase c;
    c.curvature_x          = 1. / 0.92; // 1/m
    c.curvature_y          = 1. / 0.6;
    c.normal_force         = 127.1e3; // N
    c.friction             = 0.5;
    c.speed                = 38.888889; // m/s
    c.traction_coefficient = traction_coefficient;
    c.element_size         = 1e-3 * element_size_mm;
    return c;
  }
} // namespace tread::tests

#endif
