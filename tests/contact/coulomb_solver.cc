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

namespace
{
  struct RandomProblem
  {
    ContactProblem       problem;
    std::vector<double>  gap_rate;
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
        r.gap_rate.push_back(between(-0.1, 1.)); // m/s
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
        const Vector3 u           = r.problem.combine(c, velocity);
        const double  rate        = dot(u, c.normal) + r.gap_rate[j];
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
} // namespace

void run_test(Check &check, const tests::Arguments &)
{
  const unsigned int      n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  std::mt19937            random(1);
  CoulombSolverParameters parameters;
  parameters.tolerance  = 1e-10;
  parameters.max_sweeps = 2000;
  std::vector<char> slips;
  // The sweeps stop at changes of 1e-10; what is left is that over (1 - rate of convergence), at worst a
  // hundredfold. A change of an impulse by one share of the largest changes velocities by some m/s here.
  constexpr double allowed = 1e-7;

  {
    // Tangential impulses that are given: no more and no less, on normal ones that still close the gaps.
    const RandomProblem  r = make_problem(200, random);
    Strips               whole(r.problem);
    std::vector<Vector3> velocity = r.velocity, impulse(200, Vector3{}), given;
    for (unsigned int j = 0; j < 200; ++j)
      given.push_back(Vector3{0.2 * std::cos(j), 0.2 * std::sin(j), 0., 0.});
    solve_coulomb(r.problem, CoulombFriction(0.1), parameters, whole, r.gap_rate, velocity, impulse, slips,
                  given);
    double       apart = 0., gap = 0., largest = 0.;
    unsigned int n_closed = 0;
    for (unsigned int j = 0; j < 200; ++j)
      {
        const ContactProblem::Constraint &constraint = r.problem.constraints[j];
        const Vector3                     n          = constraint.normal;
        const double                      normal     = dot(impulse[j], n);
        const double rate = dot(r.problem.combine(constraint, velocity), n) + r.gap_rate[j];
        apart   = std::max(apart, size(impulse[j] - normal * (n + given[j] - dot(given[j], n) * n)));
        gap     = std::max(gap, normal > 0. ? std::abs(rate) : -rate);
        largest = std::max(largest, normal);
        n_closed += normal > 0.;
      }
    check.that("given tractions: some pairs close, others do not", n_closed > 10 && n_closed < 190);
    check.below("given tractions: tangential impulse, share of the largest", apart / largest, 1e-12);
    check.below("given tractions: gap's rate, m/s", gap, allowed);
  }

  for (const double mu : {0., 0.3, 0.8})
    {
      const CoulombFriction friction(mu);
      Violation             worst;
      unsigned int          cold = 0, warm = 0, most = 0, fewest = 200;
      double                impulses_apart = 0., moved_apart = 0.;
      for (unsigned int k = 0; k < 20; ++k)
        {
          const RandomProblem  r = make_problem(200, random);
          Strips               whole(r.problem);
          std::vector<Vector3> velocity = r.velocity, impulse(200, Vector3{});
          const auto           first =
            solve_coulomb(r.problem, friction, parameters, whole, r.gap_rate, velocity, impulse, slips);
          const Violation now   = violation(r, impulse, friction);
          worst.penetration     = std::max(worst.penetration, now.penetration);
          worst.tension         = std::max(worst.tension, now.tension);
          worst.complementarity = std::max(worst.complementarity, now.complementarity);
          worst.cone            = std::max(worst.cone, now.cone);
          worst.stick           = std::max(worst.stick, now.stick);
          worst.direction       = std::max(worst.direction, now.direction);
          worst.n_open += now.n_open;
          worst.n_stick += now.n_stick;
          worst.n_slip += now.n_slip;
          cold += first.sweeps;
          most = std::max(most, first.sweeps);

          // Shared among the ranks.
          std::vector<Vector3> shared_velocity = r.velocity, shared_impulse(200, Vector3{});
          Strips               strips(r.problem, shared_impulse, shared_velocity.size(), MPI_COMM_WORLD);
          solve_coulomb(r.problem, friction, parameters, strips, r.gap_rate, shared_velocity, shared_impulse,
                        slips);
          strips.gather(shared_impulse);
          double largest = 0., apart = 0.;
          for (unsigned int j = 0; j < impulse.size(); ++j)
            {
              largest = std::max(largest, size(impulse[j]));
              apart   = std::max(apart, size(shared_impulse[j] - impulse[j]));
              if (j >= strips.begin && j < strips.end)
                for (unsigned int i = r.problem.constraints[j].begin; i < r.problem.constraints[j].end; ++i)
                  moved_apart = std::max(moved_apart, size(shared_velocity[r.problem.entries[i].node] -
                                                           velocity[r.problem.entries[i].node]));
            }
          impulses_apart = std::max(impulses_apart, apart / largest);
          fewest         = std::min(fewest, strips.end - strips.begin);

          // The velocities that came back hold the impulses' effect.
          std::vector<Vector3> expected = r.velocity;
          for (unsigned int j = 0; j < impulse.size(); ++j)
            r.problem.apply(r.problem.constraints[j], impulse[j], expected);
          double difference = 0.;
          for (unsigned int i = 0; i < expected.size(); ++i)
            difference = std::max(difference, size(expected[i] - velocity[i]));
          worst.penetration = std::max(worst.penetration, difference > 1e-11 ? 1. : 0.);

          // The next step's problem is nearly the same.
          RandomProblem next = r;
          for (Vector3 &v : next.velocity)
            v *= 1.001;
          velocity = next.velocity;
          warm +=
            solve_coulomb(next.problem, friction, parameters, whole, next.gap_rate, velocity, impulse, slips)
              .sweeps;

          if (k == 0)
            {
              velocity = r.velocity;
              impulse.assign(200, Vector3{});
              solve_coulomb(r.problem, friction, parameters, whole, r.gap_rate, velocity, impulse, slips);
              const unsigned int active =
                std::max_element(impulse.begin(), impulse.end(),
                                 [](const Vector3 a, const Vector3 b) { return size(a) < size(b); }) -
                impulse.begin();
              impulse[active] *= 1.0001;
              check.that("friction " + std::to_string(mu) + ": an impulse wrong by 1e-4 is noticed",
                         violation(r, impulse, friction).largest() > allowed);
            }
        }
      const std::string name = "friction " + std::to_string(mu).substr(0, 3) + ": ";
      std::printf("%s%u open, %u stick, %u slip; sweeps: %.1f cold (most %u), %.1f warm\n", name.c_str(),
                  worst.n_open, worst.n_stick, worst.n_slip, cold / 20., most, warm / 20.);
      check.below(name + "penetration, m/s", worst.penetration, allowed);
      check.below(name + "tension, share of largest impulse", worst.tension, 0.);
      check.below(name + "rate x normal impulse, share", worst.complementarity, allowed);
      check.below(name + "beyond the cone, share", worst.cone, allowed);
      check.below(name + "slip where it sticks, m/s", worst.stick, allowed);
      check.below(name + "impulse not against slip, share", worst.direction, allowed);
      check.below(name + "shared among the ranks, impulses apart, share", impulses_apart, allowed);
      check.below(name + "shared among the ranks, velocities apart, m/s", moved_apart, allowed);
      check.that(name + "each rank has a share of the constraints", fewest >= 150 / n_ranks);
      check.that(name + "all states occur",
                 worst.n_open > 0 && (mu == 0. || worst.n_stick > 0) && worst.n_slip > 0);
      check.that(name + "sweeps end by the tolerance", most <= parameters.max_sweeps);
      check.that(name + "a warm start takes fewer sweeps", warm < cold);
    }
  // So few that each of two strips would have a node of the other at both its ends.
  const RandomProblem few = make_problem(6, random);
  const Strips        one(few.problem, std::vector<Vector3>(6, Vector3{}), 12, MPI_COMM_WORLD);
  const unsigned int  own = one.end - one.begin;
  check.that("a few constraints are one rank's", dealii::Utilities::MPI::sum(own, MPI_COMM_WORLD) == 6 &&
                                                   dealii::Utilities::MPI::max(own, MPI_COMM_WORLD) >= 3);
}
