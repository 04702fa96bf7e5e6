// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/reference/hertz.h>
#include <tread/reference/rolling_estimate.h>

#include "rolling_solve.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace tread::reference
{
  namespace
  {
    struct Measures
    {
      double max_pressure = 0., area = 0., adhesion_share = 0., max_shear = 0., max_slip = 0.;
    };

    /// Reads the fields of an answer between its elements.
    class Reader
    {
    public:
      Reader(const RollingCase &c, const RollingResult &r, const Edges &edges)
        : c(c)
        , r(r)
        , edges(edges)
        , grid(r.grid)
        , slip_to_shear(0.5 * combine(c.wheel, c.rail).hertz_modulus() / c.speed)
        , bound(r.pressure)
      {
        for (std::size_t e = 0; e < bound.size(); ++e)
          bound[e] = c.friction_bound(grid.x(e % grid.n_x), grid.y(e / grid.n_x), bound[e]);
      }

      Measures measures() const
      {
        Measures m;
        m.area = edges.area(grid);
        m.max_pressure =
          !c.gap && combine(c.wheel, c.rail).coupling == 0. ? r.hertz.max_pressure : peak(r.pressure);
        double adhesion = 0.;
        for (unsigned int j = 0; j < grid.n_y; ++j)
          if (edges.lead[j] > edges.trail[j])
            {
              row(j, adhesion, m.max_shear);
              m.max_slip = std::max(m.max_slip, row_slip(j));
            }
        m.adhesion_share = adhesion * grid.dy / m.area;
        std::vector<double> shear(grid.size());
        for (std::size_t e = 0; e < grid.size(); ++e)
          shear[e] = std::hypot(r.shear_x[e], r.shear_y[e]);
        m.max_shear = std::max(m.max_shear, peak(shear));
        return m;
      }

    private:
      /// Level of an element on a scale that passes through zero linearly at the border of the adhesion area.
      double level(const std::size_t e) const
      {
        const double left = std::max(0., bound[e] - std::hypot(r.shear_x[e], r.shear_y[e]));
        const double slip = slip_to_shear * std::hypot(r.slip_x[e], r.slip_y[e]);
        return r.state[e] == ElementState::adhesion ? left * left : -slip * slip;
      }

      /// Largest value of a field; where the field is smooth about it, of the parabola along x and y.
      double peak(const std::vector<double> &field) const
      {
        const std::size_t e     = std::max_element(field.begin(), field.end()) - field.begin();
        double            value = field[e];
        const std::size_t i = e % grid.n_x, j = e / grid.n_x;
        for (const auto &[inside, stride] : {std::pair<bool, std::size_t>{i > 0 && i + 1 < grid.n_x, 1},
                                             {j > 0 && j + 1 < grid.n_y, grid.n_x}})
          {
            if (!inside || r.state[e - stride] != r.state[e] || r.state[e + stride] != r.state[e])
              continue;
            const double slope = 0.5 * (field[e + stride] - field[e - stride]),
                         bend  = field[e + stride] - 2. * field[e] + field[e - stride];
            if (bend < 0. && std::abs(slope) <= -bend)
              value -= 0.5 * slope * slope / bend;
          }
        return value;
      }

      /// Adds the length in adhesion of a row, and finds the friction bound at its borders.
      void row(const unsigned int j, double &adhesion, double &largest) const
      {
        const std::size_t first = std::size_t(j) * grid.n_x;
        for (unsigned int i = 0; i < grid.n_x; ++i)
          {
            const std::size_t e = first + i;
            if (r.state[e] == ElementState::exterior)
              continue;
            const bool   adheres = r.state[e] == ElementState::adhesion;
            const double x       = grid.x(i);
            if (i == 0 || r.state[e - 1] == ElementState::exterior)
              adhesion += adheres ? std::max(0., x - edges.trail[j]) : 0.;
            if (i + 1 == grid.n_x || r.state[e + 1] == ElementState::exterior)
              {
                adhesion += adheres ? edges.lead[j] - x : 0.;
                continue;
              }
            const bool next_adheres = r.state[e + 1] == ElementState::adhesion;
            if (adheres == next_adheres)
              {
                adhesion += adheres ? grid.dx : 0.;
                continue;
              }
            // The elements beside the border feel it: those beyond them tell better where it is.
            const bool wide =
              i > 0 && i + 2 < grid.n_x && r.state[e - 1] == r.state[e] && r.state[e + 2] == r.state[e + 1];
            const double here = level(wide ? e - 1 : e), next = level(wide ? e + 2 : e + 1);
            double       share = here == next ? 0.5 : here / (here - next); // of the step, to the border
            if (wide)
              share = std::clamp(3. * share - 1., -0.5, 1.5);
            adhesion += grid.dx * (adheres ? share : 1. - share);
            largest = std::max(largest, (1. - share) * bound[e] + share * bound[e + 1]);
          }
      }

      /// The largest slip of a row: of its elements that lie in the patch as a whole, or on the line through
      /// the last two of them at the trailing edge.
      double row_slip(const unsigned int j) const
      {
        const std::size_t first   = std::size_t(j) * grid.n_x;
        double            largest = 0.;
        bool              at_edge = true;
        double            before  = -1.;
        for (unsigned int i = 0; i < grid.n_x; ++i)
          {
            const std::size_t e = first + i;
            const double      x = grid.x(i);
            if (x - 0.5 * grid.dx < edges.trail[j] || x + 0.5 * grid.dx > edges.lead[j])
              continue;
            const double slip = std::hypot(r.slip_x[e], r.slip_y[e]);
            largest           = std::max(largest, slip);
            if (before >= 0. && at_edge)
              {
                const double steps = (x - grid.dx - edges.trail[j]) / grid.dx;
                largest            = std::max(largest, before + steps * (before - slip));
                at_edge            = false;
              }
            before = slip;
          }
        return largest;
      }

      const RollingCase   &c;
      const RollingResult &r;
      const Edges         &edges;
      const Grid           grid;
      const double         slip_to_shear; // Pa per m/s: about the ratio of both sides' square roots
      std::vector<double>  bound;
    };
  } // namespace

  namespace
  {
    /// Spin of the wheel over the rail with that of its tread, as of a cone (rad/m).
    double spin_of(const RollingCase &c, const double half_width)
    {
      const double of_tread =
        c.radius_change ? (c.radius_change(half_width) - c.radius_change(-half_width)) / (2. * half_width)
                        : 0.;
      return c.spin + of_tread;
    }

    /// Elements of about the same number as those asked for, with as many whole ones along each semi-axis as
    /// the coarser grid needs to have its edges at the same places of an element: `parts` of them along a,
    /// two thirds of that across. Only then what is left of the error falls evenly from grid to grid.
    void divide_evenly(RollingCase &c, const HertzEllipse &hertz, const unsigned int parts)
    {
      c.element_size   = hertz.semi_axis_x / parts;
      c.element_size_y = hertz.semi_axis_y * 1.5 / parts;
    }
  } // namespace


  RollingEstimate estimate_rolling(const RollingCase &rolling_case)
  {
    const auto start = std::chrono::steady_clock::now();
    // The finer grid's error of order 1.5 or more is below what the two differ by. Where elements half as
    // large again are too large for the patch, the finer grid is finer than asked for.
    constexpr double ratio     = 1.5;
    RollingCase      fine_case = rolling_case, coarse_case = rolling_case;
    const auto       scale = [](RollingCase &c, const double by) {
      c.element_size *= by;
      c.element_size_y *= by;
    };
    scale(coarse_case, ratio);
    check_case(rolling_case);
    const HertzEllipse hertz = hertz_ellipse(rolling_case.curvature_x, rolling_case.curvature_y,
                                             combine(rolling_case.wheel, rolling_case.rail).hertz_modulus(),
                                             rolling_case.normal_force);
    if (3. * coarse_case.element_size > hertz.semi_axis_x || 3. * coarse_case.edge_y() > hertz.semi_axis_y)
      {
        scale(fine_case, 1. / ratio);
        scale(coarse_case, 1. / ratio);
      }
    const double mean_axis = std::sqrt(hertz.semi_axis_x * hertz.semi_axis_y);
    const double spin = spin_of(rolling_case, hertz.semi_axis_y), by_spin = std::abs(spin) * mean_axis;
    // Beside a given force the creepage is not known yet: so much spin that it may matter is taken for some.
    constexpr double some_spin = 0.05, least_spin = 2e-5;
    const bool       spins = rolling_case.friction > 0. && by_spin > least_spin;
    if (spins)
      {
        constexpr unsigned int multiple = 6, least = 12;
        const double       asked = mean_axis / std::sqrt(rolling_case.element_size * rolling_case.edge_y());
        const unsigned int parts =
          std::max<long>(least, multiple * std::lround(asked / multiple)); // of the coarser grid
        divide_evenly(coarse_case, hertz, parts);
        divide_evenly(fine_case, hertz, parts / 2 * 3);
      }
    Edges           fine_edges, coarse_edges;
    RollingEstimate result;
    RollingResult  &fine       = result.fields;
    fine                       = solve_rolling(fine_case, 2, fine_edges);
    const RollingResult coarse = solve_rolling(coarse_case, 2, coarse_edges);
    const Measures      f      = Reader(fine_case, fine, fine_edges).measures(),
                   g           = Reader(coarse_case, coarse, coarse_edges).measures();
    // Two grids may agree by chance, so that there are least values: with 50 elements along a patch as long
    // as wide 0.03 % of what the whole patch decides, and 0.6 % of what is read between elements, whose error
    // is a share of an element.
    const double elements = mean_axis / std::sqrt(fine_case.element_size * fine_case.edge_y());
    // Under spin the error of creepage and forces falls with the power 1.5 of the element size, on grids that
    // divide the patch evenly: the limit is extrapolated, and known to a half of what that adds, but not to
    // less than 0.1 %, by which single grids scatter. Adhesion has an error of first order. Where next to
    // nothing slips, all errors are of first order: twice the difference.
    const double others         = std::hypot(fine.creepage, rolling_case.lateral_creepage),
                 of_spin        = by_spin > 0. ? by_spin / (by_spin + others) : 0.;
    constexpr double nearly_all = 0.95, spin_order = 1.5, sure = 0.5, least_under_spin = 1e-3;
    const bool       extrapolates  = spins && of_spin > some_spin;
    const double     first_order   = 1. / (ratio - 1.);
    const double     of_difference = extrapolates                    ? 1.5 * first_order
                                     : f.adhesion_share > nearly_all ? first_order
                                                                     : 1.;
    const auto       set = [&](Estimate &estimate, const double fine_value, const double coarse_value,
                         const bool between_elements = false) {
      const double least =
        between_elements ? (extrapolates ? 0.25 : 0.15) / elements : 0.2 / (elements * elements);
      estimate.value = fine_value;
      estimate.uncertainty =
        std::max(of_difference * std::abs(fine_value - coarse_value), least * std::abs(fine_value));
    };
    const auto set_limit = [&](Estimate &estimate, const double fine_value, const double coarse_value) {
      if (!extrapolates)
        return set(estimate, fine_value, coarse_value);
      const double added   = (fine_value - coarse_value) / (std::pow(ratio, spin_order) - 1.);
      estimate.value       = fine_value + added;
      estimate.uncertainty = std::max(sure * std::abs(added), least_under_spin * std::abs(estimate.value));
    };
    set(result.max_pressure, f.max_pressure, g.max_pressure);
    if (f.max_pressure == fine.hertz.max_pressure)
      result.max_pressure.uncertainty = 0.; // exact
    set_limit(result.creepage, fine.creepage, coarse.creepage);
    set_limit(result.longitudinal_force, fine.longitudinal_force, coarse.longitudinal_force);
    set_limit(result.lateral_force, fine.lateral_force, coarse.lateral_force);
    set_limit(result.traction_coefficient, fine.traction_coefficient, coarse.traction_coefficient);
    (rolling_case.prescribe_force ? result.traction_coefficient : result.creepage).uncertainty = 0.;
    if (rolling_case.prescribe_force)
      result.longitudinal_force.uncertainty = 0.;
    // A sum of shear that nearly cancels is as inaccurate as what it is a sum of.
    if (extrapolates)
      result.lateral_force.uncertainty =
        std::max(result.lateral_force.uncertainty,
                 0.25 * least_under_spin * rolling_case.friction * fine.normal_force);
    set(result.area, f.area, g.area);
    // Read between elements it may exceed the whole patch.
    const double adhesion[2] = {std::min(f.adhesion_share, 1.), std::min(g.adhesion_share, 1.)};
    set(result.adhesion_share, adhesion[0], adhesion[1], true);
    if (extrapolates)
      {
        const double added                = first_order * (adhesion[0] - adhesion[1]);
        result.adhesion_share.value       = std::clamp(adhesion[0] + added, 0., 1.);
        result.adhesion_share.uncertainty = std::max(
          {std::abs(added), 0.65 * of_spin / elements * result.adhesion_share.value, 0.1 / elements});
      }
    set(result.max_shear, f.max_shear, g.max_shear, true);
    set(result.max_slip, f.max_slip, g.max_slip, true);
    set(result.frictional_power, fine.power_balance, coarse.power_balance);
    // What was carried from a cut element to the next one may be beyond the friction bound there.
    for (std::size_t e = 0; e < fine.pressure.size(); ++e)
      {
        const double shear = std::hypot(fine.shear_x[e], fine.shear_y[e]),
                     limit = rolling_case.friction_bound(fine.grid.x(e % fine.grid.n_x),
                                                         fine.grid.y(e / fine.grid.n_x), fine.pressure[e]);
        if (shear > limit)
          {
            fine.shear_x[e] *= limit / shear;
            fine.shear_y[e] *= limit / shear;
          }
      }
    fine.convergence.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }

  double creepage_for_traction(const RollingCase &rolling_case)
  {
    RollingCase c     = rolling_case;
    c.prescribe_force = true;
    return 0. - estimate_rolling(c).creepage.value;
  }
} // namespace tread::reference
