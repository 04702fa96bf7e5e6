// SPDX-License-Identifier: LGPL-2.1-or-later
// First version: Hertz and Shen-Hedrick-Elkins until the half-space solver is in.
#include <tread/reference/hertz.h>
#include <tread/reference/kalker.h>
#include <tread/reference/rolling_case.h>

#include "require.h"

#include <cmath>

namespace tread::reference
{
  double creepage_for_traction(const RollingCase &c)
  {
    const ElasticPair  pair  = combine(c.wheel, c.rail);
    const HertzEllipse hertz = hertz_ellipse(c.curvature_x, c.curvature_y, pair.hertz_modulus(), c.normal_force);
    const CreepPatch   patch{hertz.semi_axis_x, hertz.semi_axis_y, pair.shear, pair.poisson, c.normal_force, c.friction};
    return -shen_hedrick_elkins_creepage(patch, c.traction_coefficient * c.normal_force);
  }

  RollingResult solve_rolling(const RollingCase &c)
  {
    const ElasticPair  pair  = combine(c.wheel, c.rail);
    const HertzEllipse hertz = hertz_ellipse(c.curvature_x, c.curvature_y, pair.hertz_modulus(), c.normal_force);
    const double       d     = c.element_size;
    require_positive("element_size", d, "m");
    RollingResult r;
    const int     mx = static_cast<int>(hertz.semi_axis_x / d) + 2, my = static_cast<int>(hertz.semi_axis_y / d) + 2;
    r.n_x = 2 * mx + 1, r.n_y = 2 * my + 1;
    r.element_size = d;
    for (int j = -my; j <= my; ++j)
      for (int i = -mx; i <= mx; ++i)
        {
          r.x.push_back(i * d), r.y.push_back(j * d);
          const double p = hertz.pressure(i * d, j * d);
          r.pressure.push_back(p);
          r.shear_x.push_back(c.traction_coefficient * p), r.shear_y.push_back(0.);
          r.slip_x.push_back(0.), r.slip_y.push_back(0.);
          r.state.push_back(p > 0. ? ElementState::adhesion : ElementState::exterior);
        }
    r.normal_force         = c.normal_force;
    r.longitudinal_force   = c.traction_coefficient * c.normal_force;
    r.traction_coefficient = c.traction_coefficient;
    r.creepage             = -creepage_for_traction(c);
    r.approach             = hertz.approach;
    r.max_pressure = r.hertz_pressure = hertz.max_pressure;
    r.area         = hertz.area;
    r.semi_axis_x = r.hertz_semi_x = hertz.semi_axis_x;
    r.semi_axis_y = r.hertz_semi_y = hertz.semi_axis_y;
    return r;
  }
} // namespace tread::reference
