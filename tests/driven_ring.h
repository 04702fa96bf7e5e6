// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tests_driven_ring_h
#define tread_tests_driven_ring_h

#include <tread/track/wheel_hub.h>

#include "boxes.h"

namespace tread::tests
{
  /// A rim of a wheel's size, with smaller cells around its lowest point.
  inline Body make_driven_ring()
  {
    Body body = make_ring(.46, .40, .06, {{36, 2, 2}});
    refine_near(body, dealii::Point<3>(0., 0., -.46), .05, .02);
    return body;
  }

  /// The hub of half a wheelset under its share of a wagon.
  inline WheelHubParameters sprung_hub()
  {
    WheelHubParameters parameters;
    parameters.mass                 = 400.;
    parameters.moment_of_inertia    = 40.;
    parameters.sprung_mass          = 5000.;
    parameters.suspension_stiffness = 1e6;
    parameters.suspension_damping   = 2e4;
    return parameters;
  }
} // namespace tread::tests

#endif
