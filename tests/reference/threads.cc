// SPDX-License-Identifier: LGPL-2.1-or-later
// The C interface of the half-space solver from several threads at once: many cases by one call, calls beside
// each other, and a solver of its own for each thread. Answers have the same bits as those of one thread.
// contrib/sanitize.sh threads runs this under ThreadSanitizer.
#include <tread/half_space.h>

#include "check.h"

#include <cstring>
#include <string>
#include <thread>
#include <vector>

namespace reference_threads
{
  constexpr unsigned int threads = 4;

  /// Elliptic contacts of several sizes of grid, so that threads plan transforms of several lengths beside
  /// each other; every seventh case is wrong, and its message is made.
  std::vector<tread_half_space_case> cases()
  {
    std::vector<tread_half_space_case> all;
    for (unsigned int k = 0; k < 42; ++k)
      {
        tread_half_space_case c{};
        c.curvature_x      = 1.;
        c.curvature_y      = 0.5 + 0.1 * (k % 11);
        c.normal_force     = 1e5;
        c.friction         = k % 7 == 6 ? -1. : 0.3;
        c.young            = 210e9;
        c.poisson          = 0.3;
        c.creepage         = -1e-4 * k;
        c.lateral_creepage = 5e-5 * (k % 5);
        c.spin             = 0.05 * (k % 3);
        c.slip_order       = 1 + k % 2;
        c.element_x = c.element_y = 0.5e-3 + 0.05e-3 * (k % 6);
        all.push_back(c);
      }
    return all;
  }

  unsigned int differing(const std::vector<tread_half_space_answer> &a,
                         const std::vector<tread_half_space_answer> &b)
  {
    unsigned int n = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
      n += std::memcmp(&a[k], &b[k], sizeof a[k]) != 0;
    return n;
  }
} // namespace reference_threads

TREAD_TEST(reference_threads)(tread::tests::Check &check, const tread::tests::Arguments &)
{
  const std::vector<tread_half_space_case> problems = cases();
  const auto solve_all = [&](const unsigned int n_threads, std::vector<tread_half_space_answer> &answers) {
    answers.resize(problems.size());
    return tread_half_space_solve_all(problems.data(), problems.size(), n_threads, answers.data());
  };
  std::vector<tread_half_space_answer> serial, parallel;
  const std::size_t                    wrong = problems.size() / 7;
  check.that("one thread: every seventh case is wrong", solve_all(1, serial) == wrong);
  check.that("several threads: as many", solve_all(threads, parallel) == wrong);
  check.that("several threads: the same bits", differing(parallel, serial) == 0);

  // Calls beside each other, each with threads of its own.
  {
    std::vector<std::vector<tread_half_space_answer>> answers(2);
    std::vector<std::thread>                          callers;
    for (auto &own : answers)
      callers.emplace_back([&] { solve_all(2, own); });
    for (std::thread &caller : callers)
      caller.join();
    check.that("two calls at once: the same bits",
               differing(answers[0], serial) + differing(answers[1], serial) == 0);
  }

  // A solver for each thread, with its fields and messages.
  {
    std::vector<std::vector<tread_half_space_answer>> answers(
      threads, std::vector<tread_half_space_answer>(problems.size()));
    std::vector<unsigned int> faults(threads, 0);
    std::vector<std::thread>  users;
    for (unsigned int t = 0; t < threads; ++t)
      users.emplace_back([&, t] {
        tread_half_space *solver = tread_half_space_create();
        for (std::size_t n = 0; n < problems.size(); ++n)
          {
            // Each begins elsewhere, so that different cases are solved at a time.
            const std::size_t     k      = (n + t * problems.size() / threads) % problems.size();
            const int             status = tread_half_space_solve(solver, &problems[k], &answers[t][k]);
            tread_half_space_grid grid;
            if (status != TREAD_HALF_SPACE_SOLVED)
              {
                faults[t] += std::string(tread_half_space_message(solver)).rfind("friction = -1", 0) != 0;
                continue;
              }
            tread_half_space_get_grid(solver, &grid);
            std::vector<double> shear(std::size_t(grid.n_x) * grid.n_y);
            tread_half_space_get_field(solver, TREAD_HALF_SPACE_SHEAR_X, shear.data());
            double sum = 0.;
            for (const double value : shear)
              sum += value * grid.element_x * grid.element_y;
            faults[t] += !(std::abs(sum - answers[t][k].longitudinal_force) < 1e-6 * 3e4);
          }
        tread_half_space_destroy(solver);
      });
    for (std::thread &user : users)
      user.join();
    for (unsigned int t = 0; t < threads; ++t)
      {
        const std::string name = "solver of thread " + std::to_string(t);
        check.that(name + ": the same bits", differing(answers[t], serial) == 0);
        check.that(name + ": its own messages and fields, which sum up to its force", faults[t] == 0);
      }
  }
}
