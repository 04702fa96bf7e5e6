// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/zimmermann.h>

#include "require.h"

#include <cmath>

namespace tread::reference
{
  double Zimmermann::deflection(const double x) const
  {
    const double t = std::abs(x) / length;
    return max_deflection * std::exp(-t) * (std::cos(t) + std::sin(t));
  }

  double Zimmermann::moment(const double x) const
  {
    const double t = std::abs(x) / length;
    return max_moment * std::exp(-t) * (std::cos(t) - std::sin(t));
  }

  double Zimmermann::support_force(const double spacing) const
  {
    require_positive("spacing", spacing, "m");
    return spacing * foundation * max_deflection;
  }

  Zimmermann zimmermann(const double bending_stiffness, const double foundation, const double force)
  {
    require_positive("bending_stiffness", bending_stiffness, "N m^2");
    require_positive("foundation", foundation, "N/m^2");
    require_finite("force", force);
    Zimmermann result;
    result.length         = std::pow(4. * bending_stiffness / foundation, 0.25);
    result.force          = force;
    result.foundation     = foundation;
    result.max_deflection = force / (2. * foundation * result.length);
    result.max_moment     = 0.25 * force * result.length;
    return result;
  }

  double foundation_modulus(const double pad_stiffness, const double ballast_stiffness, const double spacing)
  {
    require_positive("pad_stiffness", pad_stiffness, "N/m");
    require_positive("ballast_stiffness", ballast_stiffness, "N/m");
    require_positive("spacing", spacing, "m");
    return 1. / (1. / pad_stiffness + 1. / ballast_stiffness) / spacing;
  }

  double zimmermann_critical_speed(const double bending_stiffness, const double foundation, const double mass)
  {
    require_positive("bending_stiffness", bending_stiffness, "N m^2");
    require_positive("foundation", foundation, "N/m^2");
    require_positive("mass", mass, "kg/m");
    return std::pow(4. * foundation * bending_stiffness / (mass * mass), 0.25);
  }
} // namespace tread::reference
