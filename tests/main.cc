// SPDX-License-Identifier: LGPL-2.1-or-later
// The main function of all tests: PROGRAM TEST [PART]... runs one, PROGRAM alone lists them. Compiled with
// TREAD_TESTS_WITHOUT_MPI it serves those of the reference library, which is there without deal.II.
#include "check.h"

#ifndef TREAD_TESTS_WITHOUT_MPI
#include <deal.II/base/mpi.h>
#endif

#include <algorithm>
#include <exception>
#include <stdexcept>

using namespace tread;

namespace
{
  /// 0 when everything was as it must be, otherwise 1. Rank 0 prints all comparisons; another rank speaks
  /// only when one of its own fails.
  int run(tests::Arguments arguments, const unsigned int rank, const unsigned int n_ranks)
  {
    const auto &all   = tests::all_tests();
    const auto  found = arguments.empty() ? all.end() : all.find(arguments.front());
    if (found == all.end())
      {
        if (!arguments.empty())
          std::fprintf(stderr, "no test '%s'; there are:\n", arguments[0].c_str());
        for (const auto &[name, test] : all)
          std::fprintf(arguments.empty() ? stdout : stderr, "%s\n", name.c_str());
        return arguments.empty() ? 0 : 1;
      }
    arguments.erase(arguments.begin());
    tests::Check check;
    try
      {
        if (rank != 0 && !std::freopen("/dev/null", "w", stdout))
          throw std::runtime_error("cannot open /dev/null");
        found->second(check, arguments);
      }
    catch (const std::exception &error)
      {
        std::string text = error.what();
        std::replace(text.begin(), text.end(), '\n', ' ');
        std::fflush(stdout);
        std::fprintf(stderr, "rank %u: %s\n", rank, text.c_str());
#ifndef TREAD_TESTS_WITHOUT_MPI
        if (n_ranks > 1) // the others may wait for this one
          MPI_Abort(MPI_COMM_WORLD, 1);
#endif
        return 1;
      }
    const int code = check.exit_code();
    if (rank != 0 && code != 0)
      std::fprintf(stderr, "rank %u of %u: failed first: %s\n", rank, n_ranks, check.first_failure().c_str());
    return code;
  }
} // namespace


int main(int argc, char **argv)
{
#ifdef TREAD_TESTS_WITHOUT_MPI
  return run({argv + 1, argv + argc}, 0, 1);
#else
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  return run({argv + 1, argv + argc}, dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
             dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
#endif
}
