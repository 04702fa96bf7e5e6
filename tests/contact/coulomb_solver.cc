// SPDX-License-Identifier: LGPL-2.1-or-later
// The solver for impulses alone, on random problems: the results must satisfy Signorini's conditions and
// Coulomb's law, and must not change when ranks share the constraints.
#include <tread/contact/coulomb_solver.h>

#include <deal.II/base/mpi.h>

#include "check.h"
#include "fields.h"

#include <algorithm>
#include <random>

using namespace tread;
using tests::Check;
using tests::size;

namespace contact_coulomb_solver
{
  constexpr unsigned int n_constraints = 200, n_problems = 20; // with each friction coefficient

  // The sweeps stop at changes of 1e-10; what is left is that over (1 - rate of convergence), at worst a
  // hundredfold. A change of an impulse by one share of the largest changes velocities by some m/s here.
  constexpr double allowed = 1e-7;

  CoulombSolverParameters solver_parameters()
  {
    CoulombSolverParameters parameters;
    parameters.tolerance  = 1e-10;
    parameters.max_sweeps = 2000;
    return parameters;
  }

  struct RandomProblem
  {
    ContactProblem       problem;
    std::vector<Vector3> offset;
    std::vector<Vector3> velocity;
  };

  /// n constraints, each between one slave node and four of n master nodes in a row, as a mortar coupling has
  /// them; normals about z, masses over a decade, part of the pairs open.
  RandomProblem make_problem(const unsigned int n, std::mt19937 &random)
  {
    std::uniform_real_distribution<double> from_0_to_1(0., 1.);
    const auto                             between = [&](const double a, const double b) {
      return a + (b - a) * from_0_to_1(random);
    };

    RandomProblem       r;
    std::vector<double> mass(2 * n);
    for (double &m : mass)
      m = std::pow(10., between(-4., -3.)); // kg
    for (unsigned int j = 0; j < n; ++j)
      {
        const Vector3              direction{between(-0.3, 0.3), between(-0.3, 0.3), 1., 0.};
        ContactProblem::Constraint c{direction * (1. / size(direction)),     1e-6, 0.,
                                     (unsigned int)r.problem.entries.size(), 0,    j};
        double                     weight[4], total = 0.;
        for (double &w : weight)
          total += w = between(-0.1, 1.); // dual functions make some coefficients negative
        r.problem.entries.push_back({j, -1., -1. / mass[j]});
        const unsigned int first = n + std::min(j, n - 4);
        for (unsigned int i = 0; i < 4; ++i)
          r.problem.entries.push_back({first + i, weight[i] / total, weight[i] / total / mass[first + i]});
        c.end = r.problem.entries.size();
        for (unsigned int i = c.begin; i < c.end; ++i)
          c.compliance += r.problem.entries[i].coefficient * r.problem.entries[i].over_mass;
        r.problem.constraints.push_back(c);
        // m/s
        r.offset.push_back(between(-0.1, 1.) * c.normal +
                           cross(c.normal, Vector3{between(-0.1, 0.1), between(-0.1, 0.1), 0., 0.}));
      }
    for (unsigned int i = 0; i < 2 * n; ++i)
      {
        const double closing = i < n ? 1. : -1.;
        r.velocity.push_back(
          Vector3{between(-1., 1.), between(-1., 1.), closing * between(-0.2, 1.), 0.}); // m/s
      }
    return r;
  }

  /// Violations, as shares of 1 m/s and of the largest impulse.
  struct Violation
  {
    double       penetration = 0., tension = 0., complementarity = 0., cone = 0., stick = 0., direction = 0.;
    unsigned int n_open = 0, n_stick = 0, n_slip = 0;

    double largest() const
    {
      return std::max({penetration, tension, complementarity, cone, stick, direction});
    }

    /// The larger of each, the sum of the numbers.
    void include(const Violation &other)
    {
      penetration     = std::max(penetration, other.penetration);
      tension         = std::max(tension, other.tension);
      complementarity = std::max(complementarity, other.complementarity);
      cone            = std::max(cone, other.cone);
      stick           = std::max(stick, other.stick);
      direction       = std::max(direction, other.direction);
      n_open += other.n_open;
      n_stick += other.n_stick;
      n_slip += other.n_slip;
    }
  };

  /// Everything is computed anew from the impulses.
  Violation violation(const RandomProblem        &r,
                      const std::vector<Vector3> &impulse,
                      const FrictionLaw          &friction)
  {
    std::vector<Vector3> velocity = r.velocity;
    double               largest  = 0.;
    for (unsigned int j = 0; j < impulse.size(); ++j)
      {
        r.problem.apply(r.problem.constraints[j], impulse[j], velocity);
        largest = std::max(largest, size(impulse[j]));
      }
    Violation violation;
    for (unsigned int j = 0; j < impulse.size(); ++j)
      {
        const auto   &c           = r.problem.constraints[j];
        const Vector3 u           = r.problem.combine(c, velocity) + r.offset[j];
        const double  rate        = dot(u, c.normal);
        const Vector3 slip        = u - dot(u, c.normal) * c.normal;
        const double  normal      = dot(impulse[j], c.normal);
        const Vector3 tangential  = impulse[j] - normal * c.normal;
        const double  limit       = friction.coefficient(size(slip)) * normal;
        violation.penetration     = std::max(violation.penetration, -rate);
        violation.tension         = std::max(violation.tension, -normal / largest);
        violation.complementarity = std::max(violation.complementarity, std::abs(rate) * normal / largest);
        violation.cone            = std::max(violation.cone, (size(tangential) - limit) / largest);
        if (normal <= 0.)
          ++violation.n_open;
        else if (size(tangential) < limit * (1. - 1e-6))
          {
            ++violation.n_stick;
            violation.stick = std::max(violation.stick, size(slip));
          }
        else
          {
            ++violation
                .n_slip; // the impulse on the master side is against the slip of the master over the slave
            violation.direction =
              std::max(violation.direction, size(size(slip) * tangential + limit * slip) / largest);
          }
      }
    return violation;
  }

  /// Tangential impulses that are given: no more and no less, on normal ones that still close the gaps.
  void given_tractions(Check &check, std::mt19937 &random)
  {
    const RandomProblem  r = make_problem(n_constraints, random);
    Strips               whole(r.problem);
    std::vector<char>    slips;
    std::vector<Vector3> velocity = r.velocity, impulse(n_constraints, Vector3{}), given;
    for (unsigned int j = 0; j < n_constraints; ++j)
      given.push_back(Vector3{0.2 * std::cos(j), 0.2 * std::sin(j), 0., 0.});
    solve_coulomb(r.problem, CoulombFriction(0.1), solver_parameters(), whole, r.offset, velocity, impulse,
                  slips, given);
    double       apart = 0., gap = 0., largest = 0.;
    unsigned int n_closed = 0;
    for (unsigned int j = 0; j < n_constraints; ++j)
      {
        const ContactProblem::Constraint &constraint = r.problem.constraints[j];
        const Vector3                     n          = constraint.normal;
        const double                      normal     = dot(impulse[j], n);
        const double rate = dot(r.problem.combine(constraint, velocity) + r.offset[j], n);
        apart   = std::max(apart, size(impulse[j] - normal * (n + given[j] - dot(given[j], n) * n)));
        gap     = std::max(gap, normal > 0. ? std::abs(rate) : -rate);
        largest = std::max(largest, normal);
        n_closed += normal > 0.;
      }
    check.that("given tractions: some pairs close, others do not",
               n_closed > 10 && n_closed < n_constraints - 10);
    check.below("given tractions: tangential impulse, share of the largest", apart / largest, 1e-12);
    check.below("given tractions: gap's rate, m/s", gap, allowed);
  }

  /// A coefficient that falls with the pressure: impulse over area and time step.
  void friction_of_pressure(tests::Check &check)
  {
    constexpr double     friction = 0.3, time_step = 1e-6; // s
    std::mt19937         random(29);
    const RandomProblem  r = make_problem(n_constraints, random);
    Strips               whole(r.problem);
    std::vector<Vector3> velocity = r.velocity, impulse(n_constraints, Vector3{});
    std::vector<char>    slips;
    PairFriction         pairs;
    pairs.of_pressure = [](const double pressure) {
      return 1. / (1. + pressure / 50e6);
    };
    solve_coulomb(r.problem, CoulombFriction(friction), solver_parameters(), whole, r.offset, velocity,
                  impulse, slips, {}, pairs, time_step);
    unsigned int n_slip = 0;
    double       off = 0., least = 1., most = 0.;
    for (unsigned int j = 0; j < n_constraints; ++j)
      {
        const auto  &c      = r.problem.constraints[j];
        const double normal = dot(impulse[j], c.normal);
        if (!slips[j] || normal <= 0.)
          continue;
        const double ratio  = size(impulse[j] - normal * c.normal) / normal,
                     factor = pairs.of_pressure(normal / (c.area * time_step));
        ++n_slip;
        off   = std::max(off, std::abs(ratio / (friction * factor) - 1.));
        least = std::min(least, factor);
        most  = std::max(most, factor);
      }
    check.that("friction of pressure: many pairs slip", n_slip > 10);
    check.that("friction of pressure: factors from below 0.3 to above 0.6", least < 0.3 && most > 0.6);
    check.below("friction of pressure: share of the friction", off, 1e-4);
  }

  struct Solution
  {
    std::vector<Vector3> velocity, impulse;
    unsigned int         sweeps;
    double               change; ///< of the last sweep, share of the largest impulse
  };

  /// By one rank, from these impulses.
  Solution solve(const RandomProblem           &r,
                 const FrictionLaw             &friction,
                 const std::vector<Vector3>    &start,
                 const CoulombSolverParameters &parameters = solver_parameters())
  {
    Strips            whole(r.problem);
    std::vector<char> slips;
    Solution          s{r.velocity, start, 0, 0.};
    const auto        result =
      solve_coulomb(r.problem, friction, parameters, whole, r.offset, s.velocity, s.impulse, slips);
    s.sweeps = result.sweeps;
    s.change = result.change;
    return s;
  }

  /// What all problems with one friction coefficient have shown.
  struct Found
  {
    Violation    worst;
    unsigned int cold = 0, warm = 0, most = 0;               ///< sweeps: sums, largest number of a cold start
    double       change         = 0.;                        ///< of the last sweep, the largest
    double       impulses_apart = 0., velocities_apart = 0.; ///< shared among the ranks or not; share, m/s
    unsigned int fewest              = n_constraints;        ///< constraints that a rank has
    bool         strips_are_of_first = true; ///< those that have one sweep, two where so many are enough
  };

  /// The same problem shared among the ranks.
  void compare_with_shared(const RandomProblem &r,
                           const FrictionLaw   &friction,
                           const Solution      &alone,
                           const bool           on_two,
                           Found               &found)
  {
    const unsigned int   half = r.problem.entries.size() / 2;
    std::vector<char>    slips;
    std::vector<Vector3> velocity = r.velocity, impulse(n_constraints, Vector3{});
    FirstRanks           ranks(MPI_COMM_WORLD);
    Strips               strips(r.problem, impulse, velocity.size(), ranks, on_two ? half : 1);
    solve_coulomb(r.problem, friction, solver_parameters(), strips, r.offset, velocity, impulse, slips);
    strips.gather(impulse);
    double largest = 0., apart = 0.;
    for (unsigned int j = 0; j < n_constraints; ++j)
      {
        largest = std::max(largest, size(alone.impulse[j]));
        apart   = std::max(apart, size(impulse[j] - alone.impulse[j]));
        if (j >= strips.begin && j < strips.end)
          for (unsigned int i = r.problem.constraints[j].begin; i < r.problem.constraints[j].end; ++i)
            {
              const unsigned int node = r.problem.entries[i].node;
              found.velocities_apart =
                std::max(found.velocities_apart, size(velocity[node] - alone.velocity[node]));
            }
      }
    found.impulses_apart          = std::max(found.impulses_apart, apart / largest);
    const unsigned int own        = strips.end - strips.begin,
                       ranks_with = dealii::Utilities::MPI::sum(own > 0 ? 1u : 0u, MPI_COMM_WORLD);
    found.strips_are_of_first =
      found.strips_are_of_first && strips.sweeps() == (own > 0) &&
      (!on_two || ranks_with == std::min(2u, dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)));
    if (!on_two)
      found.fewest = std::min(found.fewest, own);
  }

  /// Whether the velocities that came back hold the impulses' effect.
  bool velocities_hold_impulses(const RandomProblem &r, const Solution &solution)
  {
    std::vector<Vector3> expected = r.velocity;
    for (unsigned int j = 0; j < n_constraints; ++j)
      r.problem.apply(r.problem.constraints[j], solution.impulse[j], expected);
    double difference = 0.;
    for (unsigned int i = 0; i < expected.size(); ++i)
      difference = std::max(difference, size(expected[i] - solution.velocity[i]));
    return difference <= 1e-11;
  }

  /// Of the next step, whose problem is nearly the same, from the impulses of this one.
  unsigned int sweeps_of_next_step(const RandomProblem &r,
                                   const FrictionLaw   &friction,
                                   const Solution      &solution)
  {
    RandomProblem next = r;
    for (Vector3 &v : next.velocity)
      v *= 1.001;
    return solve(next, friction, solution.impulse).sweeps;
  }

  bool wrong_impulse_is_noticed(const RandomProblem &r,
                                const FrictionLaw   &friction,
                                std::vector<Vector3> impulse)
  {
    *std::max_element(impulse.begin(), impulse.end(),
                      [](const Vector3 a, const Vector3 b) { return size(a) < size(b); }) *= 1.0001;
    return violation(r, impulse, friction).largest() > allowed;
  }

  void report(Check &check, const double mu, const Found &found)
  {
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const Violation   &worst   = found.worst;
    const std::string  name    = "friction " + std::to_string(mu).substr(0, 3) + ": ";
    std::printf("%s%u open, %u stick, %u slip; sweeps: %.1f cold (most %u), %.1f warm\n", name.c_str(),
                worst.n_open, worst.n_stick, worst.n_slip, double(found.cold) / n_problems, found.most,
                double(found.warm) / n_problems);
    check.below(name + "penetration, m/s", worst.penetration, allowed);
    check.below(name + "tension, share of largest impulse", worst.tension, 0.);
    check.below(name + "rate x normal impulse, share", worst.complementarity, allowed);
    check.below(name + "beyond the cone, share", worst.cone, allowed);
    check.below(name + "slip where it sticks, m/s", worst.stick, allowed);
    check.below(name + "impulse not against slip, share", worst.direction, allowed);
    check.below(name + "shared among the ranks, impulses apart, share", found.impulses_apart, allowed);
    check.below(name + "shared among the ranks, velocities apart, m/s", found.velocities_apart, allowed);
    check.that(name + "as many ranks sweep as there is work for", found.strips_are_of_first);
    check.that(name + "each rank has a share of the constraints", found.fewest >= 150 / n_ranks);
    check.that(name + "all states occur",
               worst.n_open > 0 && (mu == 0. || worst.n_stick > 0) && worst.n_slip > 0);
    check.that(name + "sweeps end by the tolerance", found.most <= solver_parameters().max_sweeps);
    check.below(name + "change of the last sweep over the tolerance",
                found.change / solver_parameters().tolerance, 1.);
    check.that(name + "a warm start takes fewer sweeps", found.warm < found.cold);
  }

  void random_problems(Check &check, const double mu, std::mt19937 &random)
  {
    const CoulombFriction friction(mu);
    Found                 found;
    for (unsigned int k = 0; k < n_problems; ++k)
      {
        const RandomProblem r        = make_problem(n_constraints, random);
        const Solution      solution = solve(r, friction, std::vector<Vector3>(n_constraints, Vector3{}));
        found.worst.include(violation(r, solution.impulse, friction));
        found.cold += solution.sweeps;
        found.most   = std::max(found.most, solution.sweeps);
        found.change = std::max(found.change, solution.change);
        compare_with_shared(r, friction, solution, false, found);
        compare_with_shared(r, friction, solution, true, found);
        found.worst.penetration =
          std::max(found.worst.penetration, velocities_hold_impulses(r, solution) ? 0. : 1.);
        found.warm += sweeps_of_next_step(r, friction, solution);
        if (k == 0)
          check.that("friction " + std::to_string(mu) + ": an impulse wrong by 1e-4 is noticed",
                     wrong_impulse_is_noticed(r, friction, solution.impulse));
      }
    report(check, mu, found);
  }

  /// So few that each of two strips would have a node of the other at both its ends.
  void few_constraints(Check &check, std::mt19937 &random)
  {
    const RandomProblem few = make_problem(6, random);
    FirstRanks          ranks(MPI_COMM_WORLD);
    const Strips        one(few.problem, std::vector<Vector3>(6, Vector3{}), 12, ranks, 1);
    const unsigned int  own = one.end - one.begin;
    check.that("a few constraints are one rank's", dealii::Utilities::MPI::sum(own, MPI_COMM_WORLD) == 6 &&
                                                     dealii::Utilities::MPI::max(own, MPI_COMM_WORLD) >= 3);
  }

  /// Not more sweeps than the largest number, however far the impulses are from the solution.
  void largest_number_of_sweeps(Check &check, std::mt19937 &random)
  {
    CoulombSolverParameters few = solver_parameters();
    few.max_sweeps              = 3;
    const RandomProblem r       = make_problem(n_constraints, random);
    const Solution cut = solve(r, CoulombFriction(0.3), std::vector<Vector3>(n_constraints, Vector3{}), few);
    check.that("sweeps end at their largest number", cut.sweeps <= few.max_sweeps + 1);
    check.that("and the change tells that they had not come to an end", cut.change > 100. * few.tolerance);
  }
} // namespace contact_coulomb_solver

TREAD_TEST(contact_coulomb_solver)(Check &check, const tests::Arguments &)
{
  friction_of_pressure(check);
  std::mt19937 random(1);
  given_tractions(check, random);
  for (const double mu : {0., 0.3, 0.8})
    random_problems(check, mu, random);
  few_constraints(check, random);
  largest_number_of_sweeps(check, random);
}
