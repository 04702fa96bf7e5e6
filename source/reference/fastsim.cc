// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/fastsim.h>

#include "require.h"

#include <cmath>
#include <numbers>

namespace tread::reference
{
  CreepForce fastsim(const CreepPatch     &patch,
                     const Creepage       &creepage,
                     const unsigned int    n_strips,
                     const unsigned int    n_elements,
                     const FastsimPressure pressure)
  {
    require(n_strips >= 3, "n_strips", n_strips, "at least 3");
    require(n_elements >= 3, "n_elements", n_elements, "at least 3");
    require_positive("semi_axis_x", patch.semi_axis_x, "m");
    require_positive("semi_axis_y", patch.semi_axis_y, "m");
    require_positive("shear", patch.shear, "Pa");
    require_positive("normal_force", patch.normal_force, "N");
    require_positive("friction", patch.friction, "");

    const double               a = patch.semi_axis_x, b = patch.semi_axis_y;
    const CreepageCoefficients c  = creepage_coefficients(a / b, patch.poisson);
    const double               l1 = 8. * a / (3. * c.c11 * patch.shear);
    const double               l2 = 8. * a / (3. * c.c22 * patch.shear);
    const double               l3 = std::numbers::pi * a * std::sqrt(a / b) / (4. * c.c23 * patch.shear);
    const bool                 parabola = pressure == FastsimPressure::paraboloid;
    const double               scale =
      (parabola ? 2. : 1.5) * patch.friction * patch.normal_force / (std::numbers::pi * a * b);

    CreepForce   force{0., 0.};
    double       volume = 0.; // of the bound, to make the discrete full slip exactly f N
    const double dy     = 2. * b / n_strips;
    for (unsigned int j = 0; j < n_strips; ++j)
      {
        const double y    = -b + (j + 0.5) * dy;
        const double half = a * std::sqrt(1. - (y / b) * (y / b));
        const double dx   = 2. * half / n_elements;
        double       px = 0., py = 0.;
        for (unsigned int i = 0; i < n_elements; ++i)
          {
            const double x = half - (i + 0.5) * dx;
            // adhesion: L dp/dx = w; the particle has come from x + dx (half an element from the edge at
            // first)
            const double step = i == 0 ? 0.5 * dx : dx;
            px -= step * (creepage.longitudinal / l1 - creepage.spin * y / l3);
            py -= step * (creepage.lateral / l2 + creepage.spin * (x + 0.5 * step) / l3);
            const double q     = 1. - (x / a) * (x / a) - (y / b) * (y / b);
            const double bound = scale * (parabola ? q : std::sqrt(q));
            const double size  = std::hypot(px, py);
            if (size > bound)
              {
                px *= bound / size;
                py *= bound / size;
              }
            force.longitudinal += px * dx * dy;
            force.lateral += py * dx * dy;
            volume += bound * dx * dy;
          }
      }
    const double correction = patch.friction * patch.normal_force / volume;
    return {force.longitudinal * correction, force.lateral * correction};
  }
} // namespace tread::reference
