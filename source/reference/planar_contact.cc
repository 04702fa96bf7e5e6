// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/errors.h>
#include <tread/reference/planar_contact.h>

#include "require.h"
#include "slip_friction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tread::reference
{
  namespace
  {
    TangentialProblem tangential_problem(const PlanarCase &c)
    {
      TangentialProblem problem;
      problem.friction     = c.friction;
      problem.longitudinal = c.longitudinal;
      problem.lateral      = c.lateral;
      problem.spin         = c.spin;
      problem.more_slip    = c.more_slip;
      problem.order        = c.order;
      return problem;
    }

    /// Without friction nothing adheres, and the slip is that of rigid bodies.
    TangentialSolution frictionless(const Grid              &grid,
                                    const NormalSolution    &normal,
                                    const TangentialProblem &problem)
    {
      TangentialSolution t;
      for (std::vector<double> *field : {&t.shear_x, &t.shear_y, &t.slip_x, &t.slip_y})
        field->assign(grid.size(), 0.);
      t.state.assign(grid.size(), ElementState::exterior);
      for (const unsigned int e : normal.contact)
        {
          const auto uneven = problem.uneven_slip(grid.x(e % grid.n_x), grid.y(e / grid.n_x));
          t.slip_x[e]       = problem.longitudinal + uneven[0];
          t.slip_y[e]       = problem.lateral + uneven[1];
          t.state[e]        = ElementState::slip;
        }
      return t;
    }

    /// With order 2 what was carried from a cut element to the next one may be beyond the friction bound.
    void keep_to_bound(const PlanarCase &c, PlanarResult &r)
    {
      for (std::size_t e = 0; e < r.pressure.size(); ++e)
        {
          const double shear = std::hypot(r.shear_x[e], r.shear_y[e]),
                       limit =
                         c.friction_bound(r.grid.x(e % r.grid.n_x), r.grid.y(e / r.grid.n_x), r.pressure[e]);
          if (shear > limit)
            {
              r.shear_x[e] *= limit / shear;
              r.shear_y[e] *= limit / shear;
            }
        }
    }

    /// What the bodies' rigid motion puts into friction: shear times rigid slip, and for unlike bodies the
    /// moment of their pressure, which resists the rolling. Elements' own slip has an error of a share of an
    /// element, which is much where little slips.
    double power_balance(const PlanarCase &c, const PlanarResult &r, const TangentialProblem &problem)
    {
      const Grid  &grid = r.grid;
      const double h    = 0.5 * grid.dx;
      const bool   like = combine(c.wheel, c.rail).coupling == 0.;
      double       work = 0.;
      for (std::size_t e = 0; e < grid.size(); ++e)
        if (r.state[e] != ElementState::exterior)
          {
            const double x = grid.x(e % grid.n_x), y = grid.y(e / grid.n_x);
            const auto   uneven = problem.uneven_slip(x, y);
            work += r.shear_x[e] * (problem.longitudinal + uneven[0]) +
                    r.shear_y[e] * (problem.lateral + uneven[1]);
            if (!like)
              work -= r.pressure[e] * (c.gap(x + h, y) - c.gap(x - h, y)) / (2. * h);
          }
      return 0. - c.speed * grid.element_area() * work;
    }

    void measure(const PlanarCase &c, PlanarResult &r)
    {
      const Grid  &grid      = r.grid;
      const double area      = grid.element_area();
      std::size_t  n_contact = 0, n_adhesion = 0;
      r.x_begin = r.y_begin = std::numeric_limits<double>::max();
      r.x_end = r.y_end = -std::numeric_limits<double>::max();
      for (std::size_t e = 0; e < grid.size(); ++e)
        {
          const double x = grid.x(e % grid.n_x), y = grid.y(e / grid.n_x);
          r.overlap = std::max(r.overlap, -c.gap(x, y));
          if (r.state[e] == ElementState::exterior)
            continue;
          const double shear = std::hypot(r.shear_x[e], r.shear_y[e]),
                       slip  = std::hypot(r.slip_x[e], r.slip_y[e]);
          ++n_contact;
          n_adhesion += r.state[e] == ElementState::adhesion ? 1 : 0;
          r.normal_force += area * r.pressure[e];
          r.max_pressure = std::max(r.max_pressure, r.pressure[e]);
          r.max_shear    = std::max(r.max_shear, shear);
          r.max_slip     = std::max(r.max_slip, slip);
          r.x_begin      = std::min(r.x_begin, x - 0.5 * grid.dx);
          r.x_end        = std::max(r.x_end, x + 0.5 * grid.dx);
          r.y_begin      = std::min(r.y_begin, y - 0.5 * grid.dy);
          r.y_end        = std::max(r.y_end, y + 0.5 * grid.dy);
        }
      r.area           = n_contact * area;
      r.adhesion_share = static_cast<double>(n_adhesion) / n_contact;
    }
  } // namespace

  PlanarResult solve_planar(const PlanarCase &c)
  {
    check_grid(c.grid);
    require_positive("speed", c.speed, "m/s");
    require(std::isfinite(c.normal_force) && c.normal_force >= 0., "normal_force", c.normal_force, ">= 0 N");
    const ElasticPair pair = combine(c.wheel, c.rail);
    check_friction(c, pair);
    NormalProblem normal;
    normal.prescribe_force = c.normal_force > 0.;
    normal.force           = c.normal_force;
    normal.approach        = 0.;
    normal.gap.resize(c.grid.size());
    for (std::size_t e = 0; e < c.grid.size(); ++e)
      normal.gap[e] = c.gap(c.grid.x(e % c.grid.n_x), c.grid.y(e / c.grid.n_x));

    const TangentialProblem problem = tangential_problem(c);
    ContactSolution         contact;
    if (c.friction > 0. && c.is_coulomb())
      contact = solve_contact(c.grid, pair, normal, problem);
    else
      {
        const FourierGrid fourier(c.grid);
        contact.normal = solve_normal(fourier, NormalOperator(fourier, pair), normal);
        contact.tangential =
          c.friction > 0. ? solve_with_friction(c.grid, pair, contact.normal.pressure, problem, c, c.speed)
                          : frictionless(c.grid, contact.normal, problem);
      }
    if (contact.normal.cut)
      throw ReachesBorder();

    PlanarResult        result;
    TangentialSolution &t     = contact.tangential;
    result.approach           = contact.normal.approach;
    result.iterations         = t.iterations;
    result.grid               = c.grid;
    result.pressure           = std::move(contact.normal.pressure);
    result.shear_x            = std::move(t.shear_x);
    result.shear_y            = std::move(t.shear_y);
    result.slip_x             = std::move(t.slip_x);
    result.slip_y             = std::move(t.slip_y);
    result.state              = std::move(t.state);
    result.longitudinal_force = t.longitudinal_force;
    result.lateral_force      = t.lateral_force;
    result.spin_moment        = t.spin_moment;
    for (std::size_t e = 0; e < c.grid.size(); ++e)
      {
        result.slip_x[e] *= c.speed;
        result.slip_y[e] *= c.speed;
      }
    const double power = power_balance(c, result, problem);
    if (c.order == 2)
      keep_to_bound(c, result);
    measure(c, result);
    // Before shear was cut to the bound, which the forces do not know of.
    result.frictional_power = power;
    return result;
  }
} // namespace tread::reference
