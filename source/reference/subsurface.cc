// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/subsurface.h>

#include "require.h"

#include <cmath>
#include <numbers>

namespace tread::reference
{
  namespace
  {
    // ln(r + t) with t^2 + s^2 = r^2, without cancellation for t < 0
    double log_sum(const double r, const double t, const double s2)
    {
      return t >= 0. ? std::log(r + t) : (s2 > 0. ? std::log(s2 / (r - t)) : 0.);
    }

    // 1/(r + t), likewise
    double inverse_sum(const double r, const double t, const double s2)
    {
      return t >= 0. ? 1. / (r + t) : (s2 > 0. ? (r - t) / s2 : 0.);
    }

    /// Double primitives in x and y of derivatives of phi = ln(r + z) and omega = z ln(r + z) - r, named by
    /// the derivative. They are to be summed over the corners of the rectangle with alternating signs.
    struct Primitives
    {
      double phi_xx, phi_yy, phi_zz, phi_xy, phi_xz, phi_yz;
      double phi_xxx, phi_xxy, phi_xyy, phi_yyy, phi_xxz, phi_yyz, phi_zzz, phi_xyz, phi_xzz, phi_yzz;
      double omega_xxx, omega_xxy, omega_xyy, omega_yyy;
    };

    Primitives primitives(const double x, const double y, const double z)
    {
      const double x2 = x * x, y2 = y * y, z2 = z * z;
      const double r   = std::sqrt(x2 + y2 + z2);
      const double s   = 1. / (r + z);
      const double l_y = log_sum(r, y, x2 + z2), l_x = log_sum(r, x, y2 + z2);
      const double i_y = inverse_sum(r, y, x2 + z2), i_x = inverse_sum(r, x, y2 + z2);
      const double ir = 1. / r;
      const double xz = x2 + z2 > 0. ? x * y * ir / (x2 + z2) : 0.;
      const double yz = y2 + z2 > 0. ? x * y * ir / (y2 + z2) : 0.;

      Primitives f;
      f.phi_zz    = -std::atan2(x * y, z * r);
      f.phi_xx    = std::atan2(x * y * (r - z), x2 * r + y2 * z);
      f.phi_yy    = std::atan2(x * y * (r - z), y2 * r + x2 * z);
      f.phi_xy    = std::log(r + z);
      f.phi_xz    = l_y;
      f.phi_yz    = l_x;
      f.phi_xxy   = x * ir * s;
      f.phi_xyy   = y * ir * s;
      f.phi_xzz   = z * ir * i_y;
      f.phi_yzz   = z * ir * i_x;
      f.phi_xxx   = -f.phi_xyy - f.phi_xzz;
      f.phi_yyy   = -f.phi_xxy - f.phi_yzz;
      f.phi_xxz   = -xz;
      f.phi_yyz   = -yz;
      f.phi_zzz   = xz + yz;
      f.phi_xyz   = ir;
      f.omega_xxy = -x * s;
      f.omega_xyy = -y * s;
      f.omega_xxx = y * s - l_y;
      f.omega_yyy = x * s - l_x;
      return f;
    }

    // Stress times 2 pi of one corner. Point forces, with z into the body (Johnson 1985, eqs. 3.18
    // to 3.20, 3.75 to 3.77):
    //   P: 2 pi sigma_ij = 2 nu phi_zz delta_ij(x, y only) - z phi_ijz - (1 - 2 nu) phi_ij, ...
    Stress corner(const double                 nu,
                  const std::array<double, 3> &q,
                  const double                 x,
                  const double                 y,
                  const double                 z)
    {
      const Primitives f = primitives(x, y, z);
      const double     m = 1. - 2. * nu;
      Stress           s;
      // pressure
      s.xx = q[2] * (2. * nu * f.phi_zz - z * f.phi_xxz - m * f.phi_xx);
      s.yy = q[2] * (2. * nu * f.phi_zz - z * f.phi_yyz - m * f.phi_yy);
      s.zz = q[2] * (f.phi_zz - z * f.phi_zzz);
      s.xy = q[2] * (-z * f.phi_xyz - m * f.phi_xy);
      s.xz = q[2] * (-z * f.phi_xzz);
      s.yz = q[2] * (-z * f.phi_yzz);
      // shear in x
      s.xx += q[0] * (2. * (1. + nu) * f.phi_xz - z * f.phi_xxx + 2. * nu * f.omega_xxx);
      s.yy += q[0] * (2. * nu * f.phi_xz - z * f.phi_xyy + 2. * nu * f.omega_xyy);
      s.zz += q[0] * (-z * f.phi_xzz);
      s.xy += q[0] * (f.phi_yz - z * f.phi_xxy + 2. * nu * f.omega_xxy);
      s.xz += q[0] * (f.phi_zz - z * f.phi_xxz);
      s.yz += q[0] * (-z * f.phi_xyz);
      // shear in y: x and y exchanged
      s.yy += q[1] * (2. * (1. + nu) * f.phi_yz - z * f.phi_yyy + 2. * nu * f.omega_yyy);
      s.xx += q[1] * (2. * nu * f.phi_yz - z * f.phi_xxy + 2. * nu * f.omega_xxy);
      s.zz += q[1] * (-z * f.phi_yzz);
      s.xy += q[1] * (f.phi_xz - z * f.phi_xyy + 2. * nu * f.omega_xyy);
      s.yz += q[1] * (f.phi_zz - z * f.phi_yyz);
      s.xz += q[1] * (-z * f.phi_xyz);
      return s;
    }

    void add(Stress &sum, const double factor, const Stress &s)
    {
      sum.xx += factor * s.xx;
      sum.yy += factor * s.yy;
      sum.zz += factor * s.zz;
      sum.xy += factor * s.xy;
      sum.xz += factor * s.xz;
      sum.yz += factor * s.yz;
    }
  } // namespace

  double Stress::von_mises() const
  {
    const double a = xx - yy, b = yy - zz, c = zz - xx;
    return std::sqrt(0.5 * (a * a + b * b + c * c) + 3. * (xy * xy + xz * xz + yz * yz));
  }

  Stress &Stress::operator+=(const Stress &other)
  {
    add(*this, 1., other);
    return *this;
  }

  Stress rectangle_stress(const double                 poisson,
                          const double                 dx,
                          const double                 dy,
                          const std::array<double, 3> &traction,
                          const double                 x,
                          const double                 y,
                          const double                 z)
  {
    require_positive("dx", dx, "m");
    require_positive("dy", dy, "m");
    require(z >= 0., "depth", z, ">= 0 m");
    Stress sum;
    for (const double i : {-1., 1.})
      for (const double j : {-1., 1.})
        add(sum, i * j / (2. * std::numbers::pi),
            corner(poisson, traction, x + 0.5 * i * dx, y + 0.5 * j * dy, z));
    return sum;
  }

  std::vector<Stress> subsurface_stress(const Grid                               &grid,
                                        const double                              poisson,
                                        const std::vector<double>                &pressure,
                                        const std::vector<double>                &shear_x,
                                        const std::vector<double>                &shear_y,
                                        const Body                                body,
                                        const std::vector<std::array<double, 3>> &points)
  {
    check_grid(grid);
    require(poisson >= 0. && poisson <= 0.5, "poisson", poisson, "0 to 0.5");
    for (const std::vector<double> *field : {&pressure, &shear_x, &shear_y})
      require(field->size() == grid.size(), "size of a traction field", static_cast<double>(field->size()),
              "the number of grid elements");
    for (const auto &point : points)
      require(point[2] >= 0., "depth", point[2], ">= 0 m");

    // The corner functions are shared by up to four elements: sum over corners, the tractions' mixed
    // differences as weights.
    struct Corner
    {
      double                x, y;
      std::array<double, 3> traction;
    };
    std::vector<Corner> corners;
    const double        sign = body == Body::wheel ? 1. : -1.;
    const auto          load = [&](const int i, const int j) -> std::array<double, 3> {
      if (i < 0 || j < 0 || i >= static_cast<int>(grid.n_x) || j >= static_cast<int>(grid.n_y))
        return {0., 0., 0.};
      const std::size_t e = static_cast<std::size_t>(j) * grid.n_x + i;
      return {sign * shear_x[e], sign * shear_y[e], pressure[e]};
    };
    for (int j = 0; j <= static_cast<int>(grid.n_y); ++j)
      for (int i = 0; i <= static_cast<int>(grid.n_x); ++i)
        {
          // For an element centred at x', its corner x - x' + dx/2 is at the grid line x' - dx/2.
          const auto right_up = load(i, j), left_up = load(i - 1, j), right_down = load(i, j - 1),
                     left_down = load(i - 1, j - 1);
          Corner c{grid.x_first + (i - 0.5) * grid.dx, grid.y_first + (j - 0.5) * grid.dy, {}};
          bool   any = false;
          for (unsigned int d = 0; d < 3; ++d)
            {
              c.traction[d] = right_up[d] - left_up[d] - right_down[d] + left_down[d];
              any           = any || c.traction[d] != 0.;
            }
          if (any)
            corners.push_back(c);
        }

    std::vector<Stress> result(points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
      {
        Stress sum;
        for (const Corner &c : corners)
          add(sum, 1. / (2. * std::numbers::pi),
              corner(poisson, c.traction, points[k][0] - c.x, points[k][1] - c.y, points[k][2]));
        // The rail's own axis points down: the shear stresses with z change sign in the global axes.
        sum.xz *= sign;
        sum.yz *= sign;
        result[k] = sum;
      }
    return result;
  }
} // namespace tread::reference
