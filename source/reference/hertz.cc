// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/hertz.h>

#include "require.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tread::reference
{
  using std::numbers::pi;

  EllipticIntegrals elliptic_integrals(const double modulus)
  {
    require(modulus >= 0. && modulus < 1., "modulus", modulus, "0 <= modulus < 1");
    const double m = modulus * modulus;
    double       a = 1., b = std::sqrt(1. - m);
    // E = K (1 - sum_n 2^(n-1) c_n^2) with c_0 = e, c_(n+1) = c_n^2/(4 a_(n+1)). Here c = c_n/e and the sum
    // is divided by e^2, so that nothing cancels for e -> 0.
    double c = 1., sum = 0.5, power = 0.5;
    for (unsigned int n = 0; n < 40; ++n)
      {
        const double a_new = 0.5 * (a + b);
        b                  = std::sqrt(a * b);
        a                  = a_new;
        c                  = c * c * modulus / (4. * a_new);
        power *= 2.;
        const double add = power * c * c;
        sum += add;
        if (add < 1e-18 * sum)
          break;
      }
    EllipticIntegrals result;
    result.first      = pi / (2. * a);
    result.second     = result.first * (1. - m * sum);
    result.difference = result.first * sum;
    result.complement = result.first * (1. - sum);
    return result;
  }

  double HertzEllipse::pressure(const double x, const double y) const
  {
    const double s = 1. - (x / semi_axis_x) * (x / semi_axis_x) - (y / semi_axis_y) * (y / semi_axis_y);
    return s > 0. ? max_pressure * std::sqrt(s) : 0.;
  }

  HertzEllipse hertz_ellipse(const double curvature_x,
                             const double curvature_y,
                             const double hertz_modulus,
                             const double force)
  {
    require_positive("curvature_x", curvature_x, "1/m");
    require_positive("curvature_y", curvature_y, "1/m");
    require_positive("hertz_modulus", hertz_modulus, "Pa");
    require_positive("force", force, "N");

    // Work with the longer axis first: the smaller curvature belongs to it.
    const double small = std::min(curvature_x, curvature_y);
    const double large = std::max(curvature_x, curvature_y);
    require(large / small < 1e8, "larger curvature over smaller", large / small,
            "below 1e8 (use the line contact)");

    // small/large = k^2 D(e)/B(e) with k = b/a; it grows monotonically from 0 to 1 with k: bisection in ln k.
    const auto ratio = [](const double k) {
      const EllipticIntegrals f = elliptic_integrals(std::sqrt((1. - k) * (1. + k)));
      return k * k * f.difference / f.complement;
    };
    double low = std::log(1e-7), high = 0.;
    for (unsigned int i = 0; i < 200 && high - low > 1e-16; ++i)
      {
        const double middle                                    = 0.5 * (low + high);
        (ratio(std::exp(middle)) < small / large ? low : high) = middle;
      }
    const double            k = (small == large) ? 1. : std::exp(0.5 * (low + high));
    const EllipticIntegrals f = elliptic_integrals(std::sqrt((1. - k) * (1. + k)));

    // small = p0/E* b/a^2 D and p0 = 3 N/(2 pi a b) give a^3.
    const double a  = std::cbrt(3. * force * f.difference / (2. * pi * hertz_modulus * small));
    const double b  = k * a;
    const double p0 = 3. * force / (2. * pi * a * b);

    HertzEllipse result;
    result.semi_axis_x   = curvature_x <= curvature_y ? a : b;
    result.semi_axis_y   = curvature_x <= curvature_y ? b : a;
    result.max_pressure  = p0;
    result.mean_pressure = 2. / 3. * p0;
    result.approach      = p0 / hertz_modulus * b * f.first;
    result.area          = pi * a * b;
    result.stiffness     = 1.5 * force / result.approach;
    return result;
  }

  HertzEllipse hertz_sphere(const double radius, const double hertz_modulus, const double force)
  {
    require_positive("radius", radius, "m");
    return hertz_ellipse(0.5 / radius, 0.5 / radius, hertz_modulus, force);
  }

  double HertzLine::pressure(const double x) const
  {
    const double s = 1. - (x / half_width) * (x / half_width);
    return s > 0. ? max_pressure * std::sqrt(s) : 0.;
  }

  HertzLine hertz_line(const double radius, const double hertz_modulus, const double force_per_length)
  {
    require_positive("radius", radius, "m");
    require_positive("hertz_modulus", hertz_modulus, "Pa");
    require_positive("force_per_length", force_per_length, "N/m");
    HertzLine result;
    result.half_width    = std::sqrt(4. * force_per_length * radius / (pi * hertz_modulus));
    result.max_pressure  = 2. * force_per_length / (pi * result.half_width);
    result.mean_pressure = 0.25 * pi * result.max_pressure;
    return result;
  }

  double AxisStress::max_shear() const
  {
    return 0.5 * (std::max({sigma_x, sigma_y, sigma_z}) - std::min({sigma_x, sigma_y, sigma_z}));
  }

  double AxisStress::von_mises() const
  {
    const double a = sigma_x - sigma_y, b = sigma_y - sigma_z, c = sigma_z - sigma_x;
    return std::sqrt(0.5 * (a * a + b * b + c * c));
  }

  AxisStress hertz_axis_stress_circle(const double radius_of_contact,
                                      const double max_pressure,
                                      const double poisson,
                                      const double depth)
  {
    require_positive("radius_of_contact", radius_of_contact, "m");
    require(depth >= 0., "depth", depth, ">= 0 m");
    const double z = depth / radius_of_contact;
    const double q = 1. / (1. + z * z);
    // 1 - z atan(1/z), atan2 covers z = 0
    const double radial = max_pressure * (-(1. + poisson) * (1. - z * std::atan2(1., z)) + 0.5 * q);
    return {radial, radial, -max_pressure * q};
  }

  AxisStress hertz_axis_stress_line(const double half_width,
                                    const double max_pressure,
                                    const double poisson,
                                    const double depth)
  {
    require_positive("half_width", half_width, "m");
    require(depth >= 0., "depth", depth, ">= 0 m");
    const double z    = depth / half_width;
    const double root = std::sqrt(1. + z * z);
    const double sx   = -max_pressure * ((1. + 2. * z * z) / root - 2. * z);
    const double sz   = -max_pressure / root;
    return {sx, poisson * (sx + sz), sz};
  }

  HertzImpact hertz_impact(const double mass,
                           const double radius,
                           const double hertz_modulus,
                           const double velocity)
  {
    require_positive("mass", mass, "kg");
    require_positive("radius", radius, "m");
    require_positive("hertz_modulus", hertz_modulus, "Pa");
    require_positive("velocity", velocity, "m/s");
    // T v/delta = 2 int_0^1 dx/sqrt(1 - x^(5/2)) = (4/5) sqrt(pi) Gamma(2/5)/Gamma(9/10)
    const double factor = 0.8 * std::sqrt(pi) * std::tgamma(0.4) / std::tgamma(0.9);
    HertzImpact  result;
    result.max_approach =
      std::pow(15. * mass * velocity * velocity / (16. * hertz_modulus * std::sqrt(radius)), 0.4);
    result.duration       = factor * result.max_approach / velocity;
    result.max_force      = 4. / 3. * hertz_modulus * std::sqrt(radius) * std::pow(result.max_approach, 1.5);
    result.contact_radius = std::sqrt(result.max_approach * radius);
    result.max_pressure   = 1.5 * result.max_force / (pi * result.contact_radius * result.contact_radius);
    return result;
  }
} // namespace tread::reference
