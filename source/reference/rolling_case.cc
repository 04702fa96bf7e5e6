// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/half_space.h>
#include <tread/reference/hertz.h>
#include <tread/reference/rolling_case.h>

#include "require.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace tread::reference
{
  namespace
  {
    void check(const RollingCase &c)
    {
      require_positive("curvature_x", c.curvature_x, "1/m");
      require_positive("curvature_y", c.curvature_y, "1/m");
      require_positive("normal_force", c.normal_force, "N (no contact otherwise)");
      require(std::isfinite(c.friction) && c.friction >= 0., "friction", c.friction, "a number >= 0");
      require_positive("speed", c.speed, "m/s");
      require_positive("element_size", c.element_size, "m");
      require_finite("lateral_creepage", c.lateral_creepage);
      require_finite("spin", c.spin);
      if (c.prescribe_force)
        require(std::abs(c.traction_coefficient) < c.friction ||
                  (c.friction == 0. && c.traction_coefficient == 0.),
                "traction_coefficient", c.traction_coefficient,
                "less in magnitude than the friction coefficient, " + std::to_string(c.friction));
      else
        require_finite("creepage", c.creepage);
    }

    void summarise(const RollingCase       &c,
                   const TangentialProblem &tangential,
                   const Grid              &grid,
                   RollingResult           &result)
    {
      const double              area = grid.element_area();
      std::vector<unsigned int> in_row(grid.n_y, 0), in_column(grid.n_x, 0);
      unsigned int              n_contact = 0, n_adhesion = 0;
      const auto                slope = [&](const double x, const double y) { // of the gap along x
        const double h = 0.5 * c.element_size;
        return c.gap ? (c.gap(x + h, y) - c.gap(x - h, y)) / (2. * h) : 2. * c.curvature_x * x;
      };
      double work =
        result.longitudinal_force * result.creepage + result.lateral_force * result.lateral_creepage;
      for (std::size_t e = 0; e < grid.size(); ++e)
        if (result.state[e] != ElementState::exterior)
          {
            ++n_contact;
            n_adhesion += result.state[e] == ElementState::adhesion ? 1 : 0;
            ++in_row[e / grid.n_x];
            ++in_column[e % grid.n_x];
            const double shear  = std::hypot(result.shear_x[e], result.shear_y[e]);
            const double slip   = std::hypot(result.slip_x[e], result.slip_y[e]);
            result.max_pressure = std::max(result.max_pressure, result.pressure[e]);
            result.max_shear    = std::max(result.max_shear, shear);
            result.max_slip     = std::max(result.max_slip, slip);
            result.frictional_power += shear * slip * area;

            const double x = grid.x(e % grid.n_x), y = grid.y(e / grid.n_x);
            const auto   uneven = tangential.uneven_slip(x, y);
            work += area * (result.shear_x[e] * uneven[0] + result.shear_y[e] * uneven[1]);
            // The pressure's moment, which unlike bodies have, resists the rolling.
            work -= area * result.pressure[e] * slope(x, y);
          }
      result.area                 = n_contact * area;
      result.semi_axis_x          = 0.5 * grid.dx * *std::max_element(in_row.begin(), in_row.end());
      result.semi_axis_y          = 0.5 * grid.dy * *std::max_element(in_column.begin(), in_column.end());
      result.adhesion_share       = static_cast<double>(n_adhesion) / n_contact;
      result.traction_coefficient = result.longitudinal_force / result.normal_force;
      result.power_balance        = 0. - c.speed * work;
    }

    /// Without friction all of the patch slips, and only its rigid motion and, for unlike bodies, the
    /// tangential displacements by pressure make it.
    ContactSolution solve_frictionless(const Grid              &grid,
                                       const ElasticPair       &pair,
                                       const NormalProblem     &normal,
                                       const TangentialProblem &tangential)
    {
      const FourierGrid   fourier(grid);
      ContactSolution     solution;
      TangentialSolution &t = solution.tangential;
      solution.normal       = solve_normal(fourier, NormalOperator(fourier, pair), normal);
      t.longitudinal        = tangential.longitudinal;
      t.lateral             = tangential.lateral;
      t.spin                = tangential.spin;
      std::vector<double> by_pressure(2 * grid.size(), 0.);
      if (pair.coupling != 0.)
        CouplingOperator(fourier, pair, {{1. / grid.dx, 0.}, {-1. / grid.dx, grid.dx}})
          .tangential_by_pressure(solution.normal.pressure.data(), by_pressure.data());
      for (std::vector<double> *field : {&t.shear_x, &t.shear_y, &t.slip_x, &t.slip_y})
        field->assign(grid.size(), 0.);
      t.state.assign(grid.size(), ElementState::exterior);
      for (const unsigned int e : solution.normal.contact)
        {
          const auto uneven = tangential.uneven_slip(grid.x(e % grid.n_x), grid.y(e / grid.n_x));
          t.slip_x[e]       = t.longitudinal + uneven[0] + by_pressure[e];
          t.slip_y[e]       = t.lateral + uneven[1] + by_pressure[grid.size() + e];
          t.state[e]        = ElementState::slip;
        }
      return solution;
    }
  } // namespace

  RollingResult solve_rolling(const RollingCase &c)
  {
    const auto start = std::chrono::steady_clock::now();
    check(c);
    const ElasticPair  pair = combine(c.wheel, c.rail);
    const HertzEllipse hertz =
      hertz_ellipse(c.curvature_x, c.curvature_y, pair.hertz_modulus(), c.normal_force);
    require(3. * c.element_size <= std::min(hertz.semi_axis_x, hertz.semi_axis_y), "element_size",
            c.element_size,
            "at most a third of the smaller Hertz semi-axis, " +
              std::to_string(std::min(hertz.semi_axis_x, hertz.semi_axis_y) / 3.) + " m");

    TangentialProblem tangential;
    tangential.friction     = c.friction;
    tangential.longitudinal = c.prescribe_force ? 0. : c.creepage;
    tangential.lateral      = c.lateral_creepage;
    tangential.spin         = c.spin;
    if (c.radius_change)
      tangential.more_slip = [&](const double x, const double y) -> std::array<double, 2> {
        const double h = 0.5 * c.element_size;
        return {-c.radius_change(y), x * (c.radius_change(y + h) - c.radius_change(y - h)) / (2. * h)};
      };
    tangential.prescribe_longitudinal_force = c.prescribe_force;
    tangential.longitudinal_force           = c.traction_coefficient * c.normal_force;

    const auto normal_problem = [&](const Grid &grid) {
      NormalProblem normal;
      normal.force = c.normal_force;
      normal.gap.resize(grid.size());
      normal.initial_pressure.resize(grid.size());
      for (unsigned int j = 0; j < grid.n_y; ++j)
        for (unsigned int i = 0; i < grid.n_x; ++i)
          {
            const double x = grid.x(i), y = grid.y(j);
            normal.gap[j * grid.n_x + i] =
              c.gap ? c.gap(x, y) : c.curvature_x * x * x + c.curvature_y * y * y;
            normal.initial_pressure[j * grid.n_x + i] = hertz.pressure(x, y);
          }
      return normal;
    };
    // How far a patch that is no ellipse reaches is found with large elements.
    double half_x = hertz.semi_axis_x, half_y = hertz.semi_axis_y;
    if (c.gap)
      for (const double size = std::min(half_x, half_y) / 3.;;)
        {
          const Grid           coarse = centred_grid(half_x + 2. * size, half_y + 2. * size, size);
          const FourierGrid    fourier(coarse);
          const NormalSolution normal =
            solve_normal(fourier, NormalOperator(fourier, pair), normal_problem(coarse));
          if (normal.cut)
            {
              half_x *= 1.5;
              half_y *= 1.5;
              continue;
            }
          half_x = half_y = 0.;
          for (const unsigned int e : normal.contact)
            {
              half_x = std::max(half_x, std::abs(coarse.x(e % coarse.n_x)) + size);
              half_y = std::max(half_y, std::abs(coarse.y(e / coarse.n_x)) + size);
            }
          break;
        }

    RollingResult   result;
    Grid            grid;
    ContactSolution contact;
    for (double margin = 2. * c.element_size;; margin *= 3.)
      {
        grid                       = centred_grid(half_x + margin, half_y + margin, c.element_size);
        const NormalProblem normal = normal_problem(grid);
        contact                    = c.friction > 0. ? solve_contact(grid, pair, normal, tangential)
                                                     : solve_frictionless(grid, pair, normal, tangential);
        if (!contact.normal.cut)
          break;
      }

    result.n_x          = grid.n_x;
    result.n_y          = grid.n_y;
    result.element_size = c.element_size;
    for (unsigned int j = 0; j < grid.n_y; ++j)
      for (unsigned int i = 0; i < grid.n_x; ++i)
        {
          result.x.push_back(grid.x(i));
          result.y.push_back(grid.y(j));
        }
    NormalSolution     &n = contact.normal;
    TangentialSolution &t = contact.tangential;
    result.pressure       = std::move(n.pressure);
    result.shear_x        = std::move(t.shear_x);
    result.shear_y        = std::move(t.shear_y);
    result.slip_x         = std::move(t.slip_x);
    result.slip_y         = std::move(t.slip_y);
    for (std::size_t e = 0; e < grid.size(); ++e)
      {
        result.slip_x[e] *= c.speed;
        result.slip_y[e] *= c.speed;
      }
    result.state                 = std::move(t.state);
    result.normal_force          = n.force;
    result.longitudinal_force    = t.longitudinal_force;
    result.lateral_force         = t.lateral_force;
    result.spin_moment           = t.spin_moment;
    result.creepage              = t.longitudinal + 0.; // no negative zero
    result.lateral_creepage      = t.lateral;
    result.spin                  = t.spin;
    result.approach              = n.approach;
    result.hertz_pressure        = hertz.max_pressure;
    result.hertz_semi_x          = hertz.semi_axis_x;
    result.hertz_semi_y          = hertz.semi_axis_y;
    result.normal_iterations     = n.iterations;
    result.tangential_iterations = t.iterations;
    result.linear_iterations     = t.linear_iterations;
    result.normal_residual       = n.residual;
    result.tangential_residual   = t.residual;
    summarise(c, tangential, grid, result);
    result.solve_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }

  double creepage_for_traction(const RollingCase &rolling_case)
  {
    RollingCase c     = rolling_case;
    c.prescribe_force = true;
    return 0. - solve_rolling(c).creepage;
  }
} // namespace tread::reference
