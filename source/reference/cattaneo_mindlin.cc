// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/cattaneo_mindlin.h>
#include <tread/reference/hertz.h>

#include "require.h"

#include <cmath>

namespace tread::reference
{
  double CattaneoMindlin::shear(const double r) const
  {
    const double outer = 1. - (r / contact_radius) * (r / contact_radius);
    if (outer <= 0.)
      return 0.;
    double value = std::sqrt(outer);
    if (r < adhesion_radius)
      value -=
        adhesion_radius / contact_radius * std::sqrt(1. - (r / adhesion_radius) * (r / adhesion_radius));
    return friction * max_pressure * value;
  }

  CattaneoMindlin cattaneo_mindlin(const double       radius,
                                   const ElasticPair &pair,
                                   const double       normal_force,
                                   const double       friction,
                                   const double       tangential_force)
  {
    require_positive("friction", friction, "");
    const HertzEllipse hertz = hertz_sphere(radius, pair.hertz_modulus(), normal_force);
    const double       bound = friction * normal_force;
    require(tangential_force >= 0. && tangential_force <= bound, "tangential_force", tangential_force,
            "0 to friction times normal force");
    const double    c = std::cbrt(1. - tangential_force / bound);
    CattaneoMindlin result;
    result.contact_radius  = hertz.semi_axis_x;
    result.adhesion_radius = c * hertz.semi_axis_x;
    result.max_pressure    = hertz.max_pressure;
    result.friction        = friction;
    result.shift = 3. * bound * (2. - pair.poisson) / (8. * hertz.semi_axis_x * pair.shear) * (1. - c * c);
    return result;
  }

  double cattaneo_mindlin_cycle_energy(const double       radius,
                                       const ElasticPair &pair,
                                       const double       normal_force,
                                       const double       friction,
                                       const double       amplitude)
  {
    require_positive("friction", friction, "");
    const HertzEllipse hertz = hertz_sphere(radius, pair.hertz_modulus(), normal_force);
    const double       bound = friction * normal_force;
    require(amplitude >= 0. && amplitude <= bound, "amplitude", amplitude,
            "0 to friction times normal force");
    const double q = amplitude / bound;
    const double c = std::cbrt(1. - q);
    // for q -> 0 the braces go as 5 q^3/162 and their difference is round-off
    const double loss = q < 1e-3 ? 5. / 162. * q * q * q * (1. + 2. / 3. * q)
                                 : 1. - c * c * c * c * c - 5. / 6. * q * (1. + c * c);
    return 0.9 * bound * bound / hertz.semi_axis_x * 2. * (2. - pair.poisson) / pair.shear * loss;
  }
} // namespace tread::reference
