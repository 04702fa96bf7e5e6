// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/half_space.h>
#include <tread/reference/all_cores.h>
#include <tread/reference/fatigue.h>
#include <tread/reference/hertz.h>
#include <tread/reference/planar_contact.h>
#include <tread/reference/t_gamma.h>
#include <tread/reference/uneven_way.h>

#include "require.h"
#include "rolling_solve.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <tuple>

// The C interface of the half-space solver: translates structs, and exceptions into a status.

using namespace tread::reference;

/// Fields of the case that was solved last.
struct tread_half_space
{
  Grid                      grid;
  std::vector<double>       pressure, shear_x, shear_y, slip_x, slip_y;
  std::vector<ElementState> state;
  std::string               message;
};

namespace
{
  /// Where none are given. Shorter ones in rolling direction than across, relative to the patch, are the
  /// most accurate for their number (doc/half-space-library.md).
  constexpr double elements_along_a = 28., elements_along_b = 10.;

  unsigned int order_of(const tread_half_space_case &problem)
  {
    require(problem.slip_order >= 0 && problem.slip_order <= 2, "slip_order", problem.slip_order,
            "1 or 2, or 0 for 2");
    return problem.slip_order == 1 ? 1 : 2;
  }

  void check_creepage(const char *name, const double value)
  {
    require(std::abs(value) <= 1e3, name, value, "a number up to 1000 in size");
  }

  /// What no contact has, and what would overflow.
  void check_magnitudes(const tread_half_space_case &problem)
  {
    check_creepage("creepage", problem.creepage);
    check_creepage("lateral_creepage", problem.lateral_creepage);
    for (const auto &[name, value, largest] :
         {std::tuple("spin", problem.spin, 1e6), std::tuple("friction", problem.friction, 1e6)})
      require(std::abs(value) <= largest, name, value,
              "a number up to " + std::to_string(static_cast<int>(largest)) + " in size");
  }

  bool is_finite(const tread_half_space_answer &a)
  {
    for (const double value : {a.longitudinal_force, a.lateral_force, a.spin_moment, a.max_pressure,
                               a.adhesion_share, a.area, a.approach, a.frictional_work})
      if (!std::isfinite(value))
        return false;
    return true;
  }

  template <typename Result>
  void keep_fields(tread_half_space &solver, const Grid &grid, Result &result)
  {
    solver.grid     = grid;
    solver.pressure = std::move(result.pressure);
    solver.shear_x  = std::move(result.shear_x);
    solver.shear_y  = std::move(result.shear_y);
    solver.slip_x   = std::move(result.slip_x);
    solver.slip_y   = std::move(result.slip_y);
    solver.state    = std::move(result.state);
  }

  template <typename Result>
  void set_common(tread_half_space_answer &answer, const Result &result)
  {
    answer.longitudinal_force = result.longitudinal_force;
    answer.lateral_force      = result.lateral_force;
    answer.spin_moment        = result.spin_moment;
    answer.max_pressure       = result.max_pressure;
    answer.adhesion_share     = result.adhesion_share;
    answer.area               = result.area;
    answer.approach           = result.approach;
  }

  /// Slope of the gap beyond which bodies are no half-spaces; steel under a wheel has 0.03.
  constexpr double steepest = 0.3;

  /// Refuses ellipses on whose edge the gap is so steep that the bodies are no half-spaces: radii of a
  /// millimetre, or steel as soft as its modulus in GPa taken for Pa.
  void check_slope(const RollingCase &c, const HertzEllipse &hertz)
  {
    const double slope = 2. * std::max(c.curvature_x * hertz.semi_axis_x, c.curvature_y * hertz.semi_axis_y);
    if (slope > steepest)
      throw std::invalid_argument(
        "curvature_x, curvature_y, normal_force, young: the gap rises by " + std::to_string(slope) +
        " of the way at the edge of the patch; half-spaces allow " + std::to_string(steepest).substr(0, 3) +
        ": see that they are in 1/m, N and Pa");
  }

  void solve_ellipse(tread_half_space            &solver,
                     const tread_half_space_case &problem,
                     tread_half_space_answer     &answer)
  {
    RollingCase c;
    c.curvature_x = problem.curvature_x;
    c.curvature_y = problem.curvature_y;
    require_positive("curvature_x", c.curvature_x, "1/m");
    require_positive("curvature_y", c.curvature_y, "1/m");
    c.normal_force = problem.normal_force;
    require_positive("normal_force", c.normal_force, "N");
    c.friction = problem.friction;
    c.wheel = c.rail   = {problem.young, problem.poisson};
    c.prescribe_force  = false;
    c.creepage         = problem.creepage;
    c.lateral_creepage = problem.lateral_creepage;
    c.spin             = problem.spin;
    const HertzEllipse hertz =
      hertz_ellipse(c.curvature_x, c.curvature_y, combine(c.wheel, c.rail).hertz_modulus(), c.normal_force);
    check_slope(c, hertz);
    c.element_size   = problem.element_x != 0. ? problem.element_x : hertz.semi_axis_x / elements_along_a;
    c.element_size_y = problem.element_y != 0. ? problem.element_y : hertz.semi_axis_y / elements_along_b;
    Edges         edges;
    RollingResult result = solve_rolling(c, order_of(problem), edges);
    set_common(answer, result);
    if (order_of(problem) == 2)
      {
        answer.max_pressure = result.hertz.max_pressure;
        answer.area         = edges.area(result.grid);
      }
    answer.frictional_work = result.power_balance;
    answer.iterations      = static_cast<int>(result.convergence.tangential_iterations);
    const Grid grid        = result.grid;
    keep_fields(solver, grid, result);
  }

  /// Elements in contact that hang together.
  struct Island
  {
    unsigned int i_low, i_high, j_low, j_high;
    double       pressure = 0.; ///< sum over its elements [Pa]

    unsigned int along() const
    {
      return i_high - i_low + 1;
    }
    unsigned int across() const
    {
      return j_high - j_low + 1;
    }
  };

  std::vector<Island> islands(const Grid &grid, const std::vector<double> &pressure)
  {
    std::vector<Island>      found;
    std::vector<bool>        seen(grid.size(), false);
    std::vector<std::size_t> open;
    for (std::size_t first = 0; first < grid.size(); ++first)
      {
        if (seen[first] || !(pressure[first] > 0.))
          continue;
        const unsigned int i0 = first % grid.n_x, j0 = first / grid.n_x;
        Island             island{i0, i0, j0, j0};
        open.push_back(first);
        seen[first] = true;
        while (!open.empty())
          {
            const std::size_t e = open.back();
            open.pop_back();
            const unsigned int i = e % grid.n_x, j = e / grid.n_x;
            island.i_low  = std::min(island.i_low, i);
            island.i_high = std::max(island.i_high, i);
            island.j_low  = std::min(island.j_low, j);
            island.j_high = std::max(island.j_high, j);
            island.pressure += pressure[e];
            for (unsigned int jj = j - std::min(j, 1u); jj <= std::min(j + 1, grid.n_y - 1); ++jj)
              for (unsigned int ii = i - std::min(i, 1u); ii <= std::min(i + 1, grid.n_x - 1); ++ii)
                if (const std::size_t n = std::size_t(jj) * grid.n_x + ii; !seen[n] && pressure[n] > 0.)
                  {
                    seen[n] = true;
                    open.push_back(n);
                  }
          }
        found.push_back(island);
      }
    return found;
  }

  /// Refuses answers of elements too large for the patch, as solve_rolling() refuses them for ellipses, and
  /// gaps so steep that the bodies are no half-spaces. A strip of one row of long elements is the plane
  /// problem of long cylinders.
  void check_resolution(const tread_half_space_case &problem, const PlanarResult &result)
  {
    const Grid               &grid  = result.grid;
    constexpr unsigned int    least = 5; // three over a semi-axis, whose ends lie anywhere in an element
    constexpr double          long_element = 10., much = 0.5;
    const std::vector<Island> all        = islands(grid, result.pressure);
    const auto                too_coarse = [&](const Island &island) {
      const bool strip = island.across() == 1 && grid.dy >= long_element * island.along() * grid.dx;
      return island.along() < least || (island.across() < least && !strip);
    };
    double        sum = 0., coarse = 0.;
    const Island *worst = nullptr;
    for (const Island &island : all)
      {
        sum += island.pressure;
        if (!too_coarse(island))
          continue;
        coarse += island.pressure;
        if (!worst || island.pressure > worst->pressure)
          worst = &island;
      }
    if (coarse > much * sum)
      throw std::invalid_argument(
        "element_x, element_y: the patch has " + std::to_string(worst->along()) + " elements along and " +
        std::to_string(worst->across()) + " across, where at least " + std::to_string(least) +
        " are needed in both directions: take smaller ones, and see that the gap is in m, not in mm");

    double slope = 0.;
    for (std::size_t e = 0; e < grid.size(); ++e)
      if (result.pressure[e] > 0.)
        {
          if (e % grid.n_x + 1 < grid.n_x && result.pressure[e + 1] > 0.)
            slope = std::max(slope, std::abs(problem.gap[e + 1] - problem.gap[e]) / grid.dx);
          if (e / grid.n_x + 1 < grid.n_y && result.pressure[e + grid.n_x] > 0.)
            slope = std::max(slope, std::abs(problem.gap[e + grid.n_x] - problem.gap[e]) / grid.dy);
        }
    if (slope > steepest)
      throw std::invalid_argument("gap: it rises by " + std::to_string(slope) +
                                  " of the way from one element in contact to the next; half-spaces allow " +
                                  std::to_string(steepest).substr(0, 3) + ": see that it is in m, not in mm");
  }

  /// Without the load.
  PlanarCase planar_case(const tread_half_space_case &problem)
  {
    PlanarCase c;
    c.grid = {problem.n_x,       problem.n_y,     problem.element_x,
              problem.element_y, problem.x_first, problem.y_first};
    check_grid(c.grid);
    c.gap = [&](const double x, const double y) {
      const auto i = std::lround((x - problem.x_first) / problem.element_x),
                 j = std::lround((y - problem.y_first) / problem.element_y);
      return problem.gap[j * problem.n_x + i];
    };
    c.friction     = problem.friction;
    c.longitudinal = problem.creepage;
    c.lateral      = problem.lateral_creepage;
    c.spin         = problem.spin;
    c.wheel = c.rail = {problem.young, problem.poisson};
    c.order          = order_of(problem);
    return c;
  }

  void solve_gap(tread_half_space            &solver,
                 const tread_half_space_case &problem,
                 tread_half_space_answer     &answer)
  {
    PlanarCase c = planar_case(problem);
    require_positive("normal_force", problem.normal_force, "N");
    c.normal_force      = problem.normal_force;
    PlanarResult result = solve_planar(c);
    check_resolution(problem, result);
    set_common(answer, result);
    answer.frictional_work = result.frictional_power;
    answer.iterations      = static_cast<int>(result.iterations);
    keep_fields(solver, c.grid, result);
  }

  tread_half_space_answer no_answer()
  {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {TREAD_HALF_SPACE_NOT_SOLVED, 0, nan, nan, nan, nan, nan, nan, nan, nan};
  }

  /// Status of what is done; the solver's message says why it was not. Texts of exceptions are short: what
  /// has no memory for them has none for a case either.
  template <typename Task>
  int status_of(tread_half_space &solver, const Task &task) noexcept
  {
    solver.message.clear();
    solver.state.clear();
    try
      {
        task();
        return TREAD_HALF_SPACE_SOLVED;
      }
    catch (const std::bad_alloc &)
      {
        solver.message = "no memory";
        return TREAD_HALF_SPACE_OUT_OF_MEMORY;
      }
    catch (const std::invalid_argument &error)
      {
        solver.message = error.what();
        return TREAD_HALF_SPACE_WRONG_INPUT;
      }
    catch (const std::exception &error)
      {
        solver.message = error.what();
        return TREAD_HALF_SPACE_NOT_SOLVED;
      }
  }

  int solve(tread_half_space            &solver,
            const tread_half_space_case &problem,
            tread_half_space_answer     &answer) noexcept
  {
    answer           = no_answer();
    const int status = status_of(solver, [&] {
      check_magnitudes(problem);
      if (problem.gap)
        solve_gap(solver, problem, answer);
      else
        solve_ellipse(solver, problem, answer);
      if (!is_finite(answer))
        throw std::runtime_error("numbers overflow");
      answer.frictional_work = std::max(answer.frictional_work, 0.); // no negative round-off
    });
    if (status != TREAD_HALF_SPACE_SOLVED)
      answer = no_answer();
    return answer.status = status;
  }

  void roll(const tread_half_space_case &problem,
            const tread_half_space_way  &way,
            double                      *approach,
            double                      *longitudinal_force,
            double                      *work)
  {
    check_magnitudes(problem);
    if (!problem.gap)
      throw std::invalid_argument("rolling over an uneven way needs a gap");
    if (way.n == 0)
      throw std::invalid_argument("n: a way has at least one step");
    UnevenWay  uneven{planar_case(problem), {}, {}, {}};
    const auto numbers = [&](const double *values, const double otherwise) {
      return values ? std::vector<double>(values, values + way.n) : std::vector<double>(way.n, otherwise);
    };
    uneven.heights      = numbers(way.heights, 0.);
    uneven.normal_force = numbers(way.normal_force, problem.normal_force);
    uneven.longitudinal = numbers(way.creepage, problem.creepage);
    for (const double creepage : uneven.longitudinal)
      check_creepage("creepage", creepage);
    for (std::size_t k = 1; k < way.n; ++k)
      if (const double rise = std::abs(uneven.heights[k] - uneven.heights[k - 1]);
          !(rise <= steepest * problem.element_x))
        throw std::invalid_argument("heights: they change by " + std::to_string(rise / problem.element_x) +
                                    " of the way from one element to the next; half-spaces allow " +
                                    std::to_string(steepest).substr(0, 3) +
                                    ": see that they are in m, not in mm");
    // The patch at the start tells whether the elements are small enough.
    tread_half_space_case   at_start = problem;
    tread_half_space        of_start;
    tread_half_space_answer unused;
    at_start.normal_force = uneven.normal_force.front();
    at_start.creepage     = uneven.longitudinal.front();
    solve_gap(of_start, at_start, unused);

    const UnevenResult result = roll_over(uneven);
    for (const std::vector<double> *values : {&result.approach, &result.longitudinal_force, &result.work})
      for (const double value : *values)
        if (!std::isfinite(value))
          throw std::runtime_error("numbers overflow");
    for (const auto &[from, to] :
         {std::pair(&result.approach, approach), std::pair(&result.longitudinal_force, longitudinal_force),
          std::pair(&result.work, work)})
      if (to)
        std::copy(from->begin(), from->end(), to);
  }

  tread_half_space_damage damage_of(const tread_half_space_case   &problem,
                                    const tread_half_space_answer &answer,
                                    const double                   shear_strength)
  {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (answer.status != TREAD_HALF_SPACE_SOLVED)
      return {nan, nan, nan, nan, nan};
    const double friction_used =
      std::hypot(answer.longitudinal_force, answer.lateral_force) / problem.normal_force;
    const double t_gamma_per_area = answer.frictional_work / answer.area;
    const bool   is_known         = shear_strength > 0.;
    return {friction_used, is_known ? answer.max_pressure / shear_strength : nan,
            is_known ? surface_fatigue_index(friction_used, answer.max_pressure, shear_strength) : nan,
            t_gamma_per_area, regimes_of_r8t_on_900a.rate(t_gamma_per_area)};
  }
} // namespace


extern "C"
{
  int tread_half_space_version(void)
  {
    return TREAD_HALF_SPACE_VERSION;
  }

  tread_half_space *tread_half_space_create(void)
  {
    return new (std::nothrow) tread_half_space;
  }

  void tread_half_space_destroy(tread_half_space *solver)
  {
    delete solver;
  }

  int tread_half_space_solve(tread_half_space            *solver,
                             const tread_half_space_case *problem,
                             tread_half_space_answer     *answer)
  {
    return solve(*solver, *problem, *answer);
  }

  int tread_half_space_roll(tread_half_space            *solver,
                            const tread_half_space_case *problem,
                            const tread_half_space_way  *way,
                            double                      *approach,
                            double                      *longitudinal_force,
                            double                      *work)
  {
    return status_of(*solver, [&] { roll(*problem, *way, approach, longitudinal_force, work); });
  }

  const char *tread_half_space_message(const tread_half_space *solver)
  {
    return solver ? solver->message.c_str() : "there is no solver";
  }

  int tread_half_space_get_grid(const tread_half_space *solver, tread_half_space_grid *grid)
  {
    const Grid &g = solver->grid;
    *grid         = {g.n_x, g.n_y, g.dx, g.dy, g.x_first, g.y_first};
    return solver->state.empty();
  }

  int tread_half_space_get_field(const tread_half_space *solver, const int field, double *values)
  {
    const std::vector<double> *of[] = {&solver->pressure, &solver->shear_x, &solver->shear_y, &solver->slip_x,
                                       &solver->slip_y};
    if (solver->state.empty() || field < TREAD_HALF_SPACE_PRESSURE || field > TREAD_HALF_SPACE_STATE)
      return 1;
    if (field == TREAD_HALF_SPACE_STATE)
      std::transform(solver->state.begin(), solver->state.end(), values,
                     [](const ElementState state) { return static_cast<double>(state); });
    else
      std::copy(of[field]->begin(), of[field]->end(), values);
    return 0;
  }

  size_t tread_half_space_solve_all(const tread_half_space_case *problems,
                                    const size_t                 n_problems,
                                    const unsigned int           n_threads,
                                    tread_half_space_answer     *answers)
  {
    std::atomic<std::size_t> failed{0};
    tread::reference::on_all_cores(n_problems, n_threads, [&] {
      return [&, solver = std::make_unique<tread_half_space>()](const std::size_t k) {
        if (solve(*solver, problems[k], answers[k]) != TREAD_HALF_SPACE_SOLVED)
          ++failed;
      };
    });
    return failed;
  }

  void tread_half_space_damage_of(const tread_half_space_case   *problems,
                                  const tread_half_space_answer *answers,
                                  const size_t                   n,
                                  const double                  *shear_strength,
                                  tread_half_space_damage       *damages)
  {
    for (size_t k = 0; k < n; ++k)
      damages[k] = damage_of(problems[k], answers[k], shear_strength ? shear_strength[k] : 0.);
  }
}
