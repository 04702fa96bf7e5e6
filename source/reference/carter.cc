// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/carter.h>
#include <tread/reference/hertz.h>

#include "require.h"

#include <algorithm>
#include <cmath>

namespace tread::reference
{
  double Carter::shear(const double x) const
  {
    const double outer = 1. - (x / half_width) * (x / half_width);
    if (outer <= 0. || creepage == 0.)
      return 0.;
    double value = std::sqrt(outer);
    if (adhesion_half > 0.)
      {
        const double t     = (x - (half_width - adhesion_half)) / adhesion_half;
        const double inner = 1. - t * t;
        value -= inner > 0. ? adhesion_half / half_width * std::sqrt(inner) : 0.;
      }
    return -std::copysign(friction * max_pressure * value, creepage);
  }

  double Carter::relative_slip(const double x) const
  {
    if (std::abs(x) > half_width)
      return 0.;
    const double t = x - (half_width - adhesion_half);
    if (adhesion_half > 0.)
      {
        const double s = t * t - adhesion_half * adhesion_half;
        return (s > 0. && t < 0.) ? std::copysign(friction / radius * std::sqrt(s), creepage) : 0.;
      }
    // full slip: rigid slip less the strain of the whole ellipse, f x/R
    return creepage - std::copysign(friction / radius, creepage) * x;
  }

  Carter carter(const double radius,
                const double hertz_modulus,
                const double force_per_length,
                const double friction,
                const double creepage)
  {
    require_positive("friction", friction, "");
    require_finite("creepage", creepage);
    const HertzLine line = hertz_line(radius, hertz_modulus, force_per_length);
    const double    tau  = std::min(1., std::abs(creepage) * radius / (friction * line.half_width));
    Carter          result;
    result.half_width       = line.half_width;
    result.max_pressure     = line.max_pressure;
    result.friction         = friction;
    result.radius           = radius;
    result.creepage         = creepage;
    result.adhesion_half    = (1. - tau) * line.half_width;
    result.traction_ratio   = -std::copysign(1. - (1. - tau) * (1. - tau), creepage);
    result.force_per_length = result.traction_ratio * friction * force_per_length;
    return result;
  }

  double carter_creepage(const double radius,
                         const double hertz_modulus,
                         const double force_per_length,
                         const double friction,
                         const double traction_ratio)
  {
    require_positive("friction", friction, "");
    require(std::abs(traction_ratio) <= 1., "traction_ratio", traction_ratio, "-1 to 1");
    const HertzLine line = hertz_line(radius, hertz_modulus, force_per_length);
    return -std::copysign(
      friction * line.half_width / radius * (1. - std::sqrt(1. - std::abs(traction_ratio))), traction_ratio);
  }
} // namespace tread::reference
