// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/kalker.h>

#include "require.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tread::reference
{
  namespace
  {
    using std::numbers::pi;

    struct TableRow
    {
      double axis_ratio; // a/b
      double c[3][3];    // C11, C22, C23 at nu = 0, 0.25, 0.5
    };

    // Kalker (1990), Three-Dimensional Elastic Bodies in Rolling Contact, table E3.
    constexpr TableRow table[n_tabulated_axis_ratios] = {
      {0.1, {{2.51, 3.31, 4.85}, {2.51, 2.52, 2.53}, {0.334, 0.473, 0.731}}},
      {0.2, {{2.59, 3.37, 4.81}, {2.59, 2.63, 2.66}, {0.483, 0.603, 0.809}}},
      {0.3, {{2.68, 3.44, 4.80}, {2.68, 2.75, 2.81}, {0.607, 0.715, 0.889}}},
      {0.4, {{2.78, 3.53, 4.82}, {2.78, 2.88, 2.98}, {0.720, 0.823, 0.977}}},
      {0.5, {{2.88, 3.62, 4.83}, {2.88, 3.01, 3.14}, {0.827, 0.929, 1.07}}},
      {0.6, {{2.98, 3.72, 4.91}, {2.98, 3.14, 3.31}, {0.930, 1.03, 1.18}}},
      {0.7, {{3.09, 3.81, 4.97}, {3.09, 3.28, 3.48}, {1.03, 1.14, 1.29}}},
      {0.8, {{3.19, 3.91, 5.05}, {3.19, 3.41, 3.65}, {1.13, 1.25, 1.40}}},
      {0.9, {{3.29, 4.01, 5.12}, {3.29, 3.54, 3.82}, {1.23, 1.36, 1.51}}},
      {1.0, {{3.40, 4.12, 5.20}, {3.40, 3.67, 3.98}, {1.33, 1.47, 1.63}}},
      {1. / 0.9, {{3.51, 4.22, 5.30}, {3.51, 3.81, 4.16}, {1.44, 1.59, 1.77}}},
      {1. / 0.8, {{3.65, 4.36, 5.42}, {3.65, 3.99, 4.39}, {1.58, 1.75, 1.94}}},
      {1. / 0.7, {{3.82, 4.54, 5.58}, {3.82, 4.21, 4.67}, {1.76, 1.95, 2.18}}},
      {1. / 0.6, {{4.06, 4.78, 5.80}, {4.06, 4.50, 5.04}, {2.01, 2.23, 2.50}}},
      {1. / 0.5, {{4.37, 5.10, 6.11}, {4.37, 4.90, 5.56}, {2.35, 2.62, 2.96}}},
      {1. / 0.4, {{4.84, 5.57, 6.57}, {4.84, 5.48, 6.31}, {2.88, 3.24, 3.70}}},
      {1. / 0.3, {{5.57, 6.34, 7.34}, {5.57, 6.40, 7.51}, {3.79, 4.32, 5.01}}},
      {1. / 0.2, {{6.96, 7.78, 8.82}, {6.96, 8.14, 9.79}, {5.72, 6.63, 7.89}}},
      {1. / 0.1, {{10.7, 11.7, 12.9}, {10.7, 12.8, 16.0}, {12.2, 14.6, 18.0}}}};

    double quadratic_in_poisson(const double (&c)[3], const double poisson)
    {
      const double t = 4. * poisson; // nodes at 0, 1, 2
      return c[0] * 0.5 * (t - 1.) * (t - 2.) - c[1] * t * (t - 2.) + c[2] * 0.5 * t * (t - 1.);
    }

    void check(const CreepPatch &patch)
    {
      require_positive("semi_axis_x", patch.semi_axis_x, "m");
      require_positive("semi_axis_y", patch.semi_axis_y, "m");
      require_positive("shear", patch.shear, "Pa");
      require_positive("normal_force", patch.normal_force, "N");
      require_positive("friction", patch.friction, "");
    }
  } // namespace

  double tabulated_axis_ratio(const unsigned int i)
  {
    require(i < n_tabulated_axis_ratios, "i", i, "0 to 18");
    return table[i].axis_ratio;
  }

  CreepageCoefficients creepage_coefficients(const double axis_ratio, const double poisson)
  {
    require(axis_ratio >= 0.1 * (1. - 1e-12) && axis_ratio <= 10. * (1. + 1e-12), "axis_ratio", axis_ratio,
            "0.1 to 10");
    require(poisson >= 0. && poisson <= 0.5, "poisson", poisson, "0 to 0.5");

    // four neighbouring rows
    unsigned int right = 1;
    while (right < n_tabulated_axis_ratios - 1 && table[right].axis_ratio < axis_ratio)
      ++right;
    const int first =
      std::clamp(static_cast<int>(right) - 2, 0, static_cast<int>(n_tabulated_axis_ratios) - 4);
    const double t = std::log(axis_ratio);

    double value[3] = {0., 0., 0.};
    for (int i = first; i < first + 4; ++i)
      {
        double weight = 1.;
        for (int j = first; j < first + 4; ++j)
          if (j != i)
            weight *=
              (t - std::log(table[j].axis_ratio)) / std::log(table[i].axis_ratio / table[j].axis_ratio);
        for (int k = 0; k < 3; ++k)
          value[k] += weight * std::log(quadratic_in_poisson(table[i].c[k], poisson));
      }
    return {std::exp(value[0]), std::exp(value[1]), std::exp(value[2])};
  }

  CreepForce linear_theory(const CreepPatch &patch, const Creepage &creepage)
  {
    check(patch);
    const CreepageCoefficients c =
      creepage_coefficients(patch.semi_axis_x / patch.semi_axis_y, patch.poisson);
    const double ab = patch.semi_axis_x * patch.semi_axis_y;
    return {-c.c11 * patch.shear * ab * creepage.longitudinal,
            -patch.shear * ab * (c.c22 * creepage.lateral + c.c23 * std::sqrt(ab) * creepage.spin)};
  }

  CreepForce vermeulen_johnson(const CreepPatch &patch, const Creepage &creepage)
  {
    check(patch);
    require(creepage.spin == 0., "spin", creepage.spin, "0 in the theory of Vermeulen and Johnson");
    const double a = patch.semi_axis_x, b = patch.semi_axis_y;

    // Second derivatives of the displacements under a semi-ellipsoidal shear of unit maximum. The integrands
    // are smooth and periodic: the midpoint rule converges exponentially; the number of points grows with the
    // slenderness.
    const unsigned int n   = 64 * static_cast<unsigned int>(1. + std::max(a / b, b / a));
    double             i_x = 0., i_y = 0.;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double angle  = pi * (i + 0.5) / n;
        const double c2     = std::cos(angle) * std::cos(angle);
        const double s2     = 1. - c2;
        const double chord  = c2 / (a * a) + s2 / (b * b);
        const double common = s2 / (a * a * b * b * std::pow(chord, 1.5));
        i_x += (1. - patch.poisson + patch.poisson * c2) * common;
        i_y += (1. - patch.poisson + patch.poisson * s2) * common;
      }
    const double p0    = 1.5 * patch.normal_force / (pi * a * b);
    const double scale = patch.friction * p0 * a / patch.shear * pi / n;
    const double tx    = creepage.longitudinal / (scale * i_x);
    const double ty    = creepage.lateral / (scale * i_y);
    const double tau   = std::hypot(tx, ty);
    if (tau == 0.)
      return {0., 0.};
    const double force = patch.friction * patch.normal_force * (tau < 1. ? 1. - std::pow(1. - tau, 3) : 1.);
    return {-force * tx / tau, -force * ty / tau};
  }

  CreepForce shen_hedrick_elkins(const CreepPatch &patch, const Creepage &creepage)
  {
    const CreepForce linear = linear_theory(patch, creepage);
    const double     bound  = patch.friction * patch.normal_force;
    const double     rho    = std::hypot(linear.longitudinal, linear.lateral) / bound;
    if (rho == 0.)
      return {0., 0.};
    const double factor = (rho < 3. ? rho - rho * rho / 3. + rho * rho * rho / 27. : 1.) / rho;
    return {factor * linear.longitudinal, factor * linear.lateral};
  }

  double shen_hedrick_elkins_creepage(const CreepPatch &patch, const double force)
  {
    check(patch);
    const double bound = patch.friction * patch.normal_force;
    require(std::abs(force) <= bound, "force", force, "at most friction times normal force");
    const CreepageCoefficients c =
      creepage_coefficients(patch.semi_axis_x / patch.semi_axis_y, patch.poisson);
    const double tau  = 1. - std::cbrt(1. - std::abs(force) / bound);
    const double full = 3. * bound / (c.c11 * patch.shear * patch.semi_axis_x * patch.semi_axis_y);
    return -std::copysign(full * tau, force);
  }
} // namespace tread::reference
