// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/half_space.h>
#include <tread/reference/hertz.h>
#include <tread/reference/rolling_case.h>

#include "require.h"
#include "rolling_solve.h"
#include "slip_friction.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace tread::reference
{
  void check_case(const RollingCase &c)
  {
    require_positive("curvature_x", c.curvature_x, "1/m");
    require_positive("curvature_y", c.curvature_y, "1/m");
    require_positive("normal_force", c.normal_force, "N (no contact otherwise)");
    require_positive("speed", c.speed, "m/s");
    require_positive("element_size", c.element_size, "m");
    require(std::isfinite(c.element_size_y) && c.element_size_y >= 0., "element_size_y", c.element_size_y,
            ">= 0 m");
    require_finite("lateral_creepage", c.lateral_creepage);
    require_finite("spin", c.spin);
    require(std::isfinite(c.layer) && c.layer >= 0., "layer", c.layer, ">= 0 m/Pa");
    check_friction(c, combine(c.wheel, c.rail));
    if (c.prescribe_force)
      require(std::abs(c.traction_coefficient) < c.friction ||
                (c.friction == 0. && c.traction_coefficient == 0.),
              "traction_coefficient", c.traction_coefficient,
              "less in magnitude than the friction coefficient, " + std::to_string(c.friction));
    else
      require_finite("creepage", c.creepage);
  }

  namespace
  {
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
        // The pressure's moment, which unlike bodies have, resists the rolling.
        if (result.pressure[e] > 0.)
          work -= area * result.pressure[e] * slope(grid.x(e % grid.n_x), grid.y(e / grid.n_x));
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

    /// The normal problem on a grid, to be started from Hertz's pressure.
    NormalProblem normal_problem(const RollingCase &c, const HertzEllipse &hertz, const Grid &grid)
    {
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
    }

    TangentialProblem tangential_problem(const RollingCase &c, const unsigned int order)
    {
      TangentialProblem tangential;
      tangential.friction     = c.friction;
      tangential.longitudinal = c.prescribe_force ? 0. : c.creepage;
      tangential.lateral      = c.lateral_creepage;
      tangential.order        = order;
      tangential.spin         = c.spin;
      if (c.radius_change)
        tangential.more_slip = [&c](const double x, const double y) -> std::array<double, 2> {
          const double h = 0.5 * c.element_size;
          return {-c.radius_change(y), x * (c.radius_change(y + h) - c.radius_change(y - h)) / (2. * h)};
        };
      tangential.prescribe_longitudinal_force = c.prescribe_force;
      tangential.longitudinal_force           = c.traction_coefficient * c.normal_force;
      return tangential;
    }

    /// Hertz's pressure, mean over each element.
    NormalSolution known_normal(const Grid &grid, const HertzEllipse &hertz, const double force)
    {
      constexpr unsigned int n_points = 8; // along an edge of an element
      NormalSolution         normal;
      normal.pressure.assign(grid.size(), 0.);
      for (unsigned int e = 0; e < grid.size(); ++e)
        {
          for (unsigned int k = 0; k < n_points * n_points; ++k)
            normal.pressure[e] +=
              hertz.pressure(grid.x(e % grid.n_x) + grid.dx * ((k % n_points + 0.5) / n_points - 0.5),
                             grid.y(e / grid.n_x) + grid.dy * ((k / n_points + 0.5) / n_points - 0.5));
          normal.force += normal.pressure[e] * grid.element_area();
        }
      for (double &p : normal.pressure)
        p *= force / normal.force;
      for (unsigned int e = 0; e < grid.size(); ++e)
        if (normal.pressure[e] > 0.)
          normal.contact.push_back(e);
      normal.force    = force;
      normal.approach = hertz.approach;
      return normal;
    }

    /// The pressure of elements a third as large, mean over each element, and its edges. Their error is a
    /// ninth of the grid's own, and the normal problem is the smaller part of the work.
    NormalSolution finer_normal(const RollingCase  &c,
                                const ElasticPair  &pair,
                                const HertzEllipse &hertz,
                                const Grid         &grid,
                                Edges              &edges)
    {
      constexpr unsigned int parts = 3;
      const double           dx = grid.dx / parts, dy = grid.dy / parts, ahead = 0.5 * (parts - 1);
      const Grid             fine{parts * grid.n_x,          parts * grid.n_y,         dx, dy,
                      grid.x_first - ahead * dx, grid.y_first - ahead * dy};
      const FourierGrid      fourier(fine);
      NormalSolution         normal =
        solve_normal(fourier, NormalOperator(fourier, pair), normal_problem(c, hertz, fine));
      const Edges         fine_edges = pressure_edges(fine, normal.pressure);
      std::vector<double> pressure(grid.size(), 0.), gap(grid.size(), 0.);
      for (const unsigned int e : normal.contact)
        pressure[e / fine.n_x / parts * grid.n_x + e % fine.n_x / parts] +=
          normal.pressure[e] / (parts * parts);
      for (unsigned int e = 0; e < grid.size(); ++e)
        gap[e] = normal.gap[(e / grid.n_x * parts + parts / 2) * std::size_t(fine.n_x) +
                            e % grid.n_x * parts + parts / 2];
      edges.semi_axis_x = fine_edges.semi_axis_x;
      edges.semi_axis_y = fine_edges.semi_axis_y;
      edges.lead.assign(grid.n_y, -1.);
      edges.trail.assign(grid.n_y, 0.);
      for (unsigned int j = 0; j < grid.n_y; ++j)
        {
          // Rows in part beside the patch: as long as their share of it, about the middle of the others.
          double length = 0., middle = 0., n = 0.;
          for (unsigned int k = parts * j; k < parts * (j + 1); ++k)
            if (fine_edges.lead[k] > fine_edges.trail[k])
              {
                length += (fine_edges.lead[k] - fine_edges.trail[k]) / parts;
                middle += 0.5 * (fine_edges.lead[k] + fine_edges.trail[k]);
                n += 1.;
              }
          if (n > 0.)
            {
              edges.lead[j]  = middle / n + 0.5 * length;
              edges.trail[j] = middle / n - 0.5 * length;
            }
        }
      normal.pressure = std::move(pressure);
      normal.gap      = std::move(gap);
      normal.contact.clear();
      for (unsigned int e = 0; e < grid.size(); ++e)
        if (normal.pressure[e] > 0.)
          normal.contact.push_back(e);
      return normal;
    }

    /// How far a patch reaches from the point of contact, in x and in y.
    struct Reach
    {
      double x, y;
    };

    /// As far as Hertz's ellipse; the reach of a patch that is no ellipse is found with large elements.
    Reach patch_reach(const RollingCase &c, const ElasticPair &pair, const HertzEllipse &hertz)
    {
      Reach reach{hertz.semi_axis_x, hertz.semi_axis_y};
      if (!c.gap)
        return reach;
      const double size = std::min(reach.x, reach.y) / 3.;
      while (true)
        {
          const Grid           coarse = centred_grid(reach.x + 2. * size, reach.y + 2. * size, size);
          const FourierGrid    fourier(coarse);
          const NormalSolution normal =
            solve_normal(fourier, NormalOperator(fourier, pair), normal_problem(c, hertz, coarse));
          if (normal.cut)
            {
              reach.x *= 1.5;
              reach.y *= 1.5;
              continue;
            }
          reach = {0., 0.};
          for (const unsigned int e : normal.contact)
            {
              reach.x = std::max(reach.x, std::abs(coarse.x(e % coarse.n_x)) + size);
              reach.y = std::max(reach.y, std::abs(coarse.y(e / coarse.n_x)) + size);
            }
          return reach;
        }
    }

    /// Contact on one grid, and where its patch ends. The pressure of like bodies does not depend on the
    /// tractions: with order 2 it is known, or found with finer elements, before the tangential problem.
    ContactSolution solve_on_grid(const RollingCase  &c,
                                  const ElasticPair  &pair,
                                  const HertzEllipse &hertz,
                                  const Grid         &grid,
                                  TangentialProblem  &tangential,
                                  Edges              &edges)
    {
      const NormalProblem normal = normal_problem(c, hertz, grid);
      const bool          known  = tangential.order == 2 && pair.coupling == 0.;
      ContactSolution     contact;
      edges = Edges(); // those of a grid that was too small do not fit this one
      if (known && !c.gap)
        {
          contact.normal = known_normal(grid, hertz, c.normal_force);
          edges          = ellipse_edges(grid, hertz.semi_axis_x, hertz.semi_axis_y);
        }
      else if (known)
        contact.normal = finer_normal(c, pair, hertz, grid, edges);
      tangential.leading_edge = edges.lead;
      if (c.friction == 0.)
        {
          const NormalSolution by_elements = contact.normal;
          contact                          = solve_frictionless(grid, pair, normal, tangential);
          if (known)
            contact.normal = by_elements;
        }
      else if (!c.is_coulomb())
        {
          if (!known)
            {
              const FourierGrid fourier(grid);
              contact.normal = solve_normal(fourier, NormalOperator(fourier, pair), normal);
            }
          contact.tangential =
            solve_with_friction(grid, pair, contact.normal.pressure, tangential, c, c.speed);
        }
      else if (known)
        contact.tangential = solve_tangential(grid, pair, contact.normal.pressure, tangential);
      else
        contact = solve_contact(grid, pair, normal, tangential);
      if (!known)
        edges = pressure_edges(grid, contact.normal.pressure);
      return contact;
    }

    /// The fields and the numbers that the solution has itself; slips become velocities.
    RollingResult as_result(const RollingCase  &c,
                            const HertzEllipse &hertz,
                            const Grid         &grid,
                            ContactSolution   &&contact)
    {
      RollingResult result;
      result.grid = grid;
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
      result.state              = std::move(t.state);
      result.normal_force       = n.force;
      result.longitudinal_force = t.longitudinal_force;
      result.lateral_force      = t.lateral_force;
      result.spin_moment        = t.spin_moment;
      result.creepage           = t.longitudinal + 0.; // no negative zero
      result.lateral_creepage   = t.lateral;
      result.spin               = t.spin;
      result.approach           = n.approach;
      result.hertz              = hertz;
      result.convergence        = {n.iterations, t.iterations, t.linear_iterations, n.residual, t.residual};
      return result;
    }
  } // namespace

  RollingResult solve_rolling(const RollingCase &c)
  {
    Edges edges;
    return solve_rolling(c, 1, edges);
  }

  RollingResult solve_rolling(const RollingCase &c, const unsigned int order, Edges &edges)
  {
    const auto start = std::chrono::steady_clock::now();
    check_case(c);
    ElasticPair pair = combine(c.wheel, c.rail);
    pair.layer       = c.layer;
    const HertzEllipse hertz =
      hertz_ellipse(c.curvature_x, c.curvature_y, pair.hertz_modulus(), c.normal_force);
    for (const auto &[name, size, semi_axis] : {std::tuple("element_size", c.element_size, hertz.semi_axis_x),
                                                std::tuple("element_size_y", c.edge_y(), hertz.semi_axis_y)})
      require(3. * size <= semi_axis, name, size,
              "at most a third of the Hertz semi-axis, " + std::to_string(semi_axis / 3.) + " m");

    TangentialProblem tangential = tangential_problem(c, order);
    const Reach       reach      = patch_reach(c, pair, hertz);
    Grid              grid;
    ContactSolution   contact;
    for (double margin = 2.;; margin *= 3.) // elements
      {
        grid = centred_grid(reach.x + margin * c.element_size, reach.y + margin * c.edge_y(), c.element_size,
                            c.edge_y());
        contact = solve_on_grid(c, pair, hertz, grid, tangential, edges);
        if (!contact.normal.cut)
          break;
      }

    RollingResult result = as_result(c, hertz, grid, std::move(contact));
    summarise(c, tangential, grid, result);
    if (order == 2)
      {
        result.semi_axis_x = edges.semi_axis_x;
        result.semi_axis_y = edges.semi_axis_y;
      }
    result.convergence.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }
} // namespace tread::reference
