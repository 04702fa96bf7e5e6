// SPDX-License-Identifier: LGPL-2.1-or-later
// Sums that are the same to the last bit in any order and on any number of ranks, against long double.
#include <tread/base/reproducible_sum.h>

#include <deal.II/base/mpi.h>

#include "check.h"

#include <algorithm>
#include <random>
#include <vector>

using namespace tread;

namespace base_reproducible_sum
{
  constexpr unsigned int n_terms = 20000, n_orders = 20;

  /// Of very different size and both signs, so that an ordinary sum depends on their order.
  std::vector<double> random_terms(const double scale)
  {
    std::mt19937                           generator(4);
    std::uniform_real_distribution<double> mantissa(-1., 1.), exponent(-30., 0.);
    std::vector<double>                    terms(n_terms);
    for (double &term : terms)
      term = scale * mantissa(generator) * std::exp2(exponent(generator));
    return terms;
  }


  double exact(const std::vector<double> &terms)
  {
    long double sum = 0.;
    for (const double term : terms)
      sum += term;
    return sum;
  }


  /// In so many partial sums of random length.
  double in_parts(const std::vector<double> &terms, std::mt19937 &generator)
  {
    ReproducibleSum<double> total, part;
    for (const double term : terms)
      {
        if (generator() % 100 == 0)
          {
            total.add(part);
            part = ReproducibleSum<double>();
          }
        part.add(term);
      }
    total.add(part);
    return total.value();
  }


  void random_orders(tests::Check &check)
  {
    std::mt19937 generator(7);
    for (const double scale : {1e-6, 1., 1e6})
      {
        std::vector<double> terms     = random_terms(scale);
        const double        reference = exact(terms), first = in_parts(terms, generator);
        double              plain = 0., largest = 0.;
        unsigned int        n_equal = 0, n_plain_equal = 0;
        for (const double term : terms)
          {
            plain += term;
            largest = std::max(largest, std::abs(term));
          }
        for (unsigned int order = 0; order < n_orders; ++order)
          {
            std::shuffle(terms.begin(), terms.end(), generator);
            double other = 0.;
            for (const double term : terms)
              other += term;
            n_equal += in_parts(terms, generator) == first;
            n_plain_equal += other == plain;
          }
        check.that("an ordinary sum depends on the order", n_plain_equal < n_orders);
        check.that("a reproducible one does not", n_equal == n_orders);
        // Each term may lose half of 2^-62.
        check.absolute("its value", first, reference, n_terms * 0x1p-63 + 0x1p-52 * std::abs(reference));
      }
  }


  void lanes(tests::Check &check)
  {
    const std::vector<double> terms = random_terms(1.);
    ReproducibleSum<double>   one_by_one;
    ReproducibleSum<Lanes>    together;
    for (unsigned int i = 0; i < n_terms; i += n_lanes)
      {
        Lanes some;
        for (unsigned int l = 0; l < n_lanes; ++l)
          {
            some[l] = terms[i + l];
            one_by_one.add(terms[i + l]);
          }
        together.add(some);
      }
    check.that("lanes", one_by_one.value() == together.of_lanes().value());
  }


  void ranks(tests::Check &check)
  {
    const unsigned int n_ranks   = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
                       this_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    for (const double scale : {1e-20, 1., 1e20})
      {
        const std::vector<double> terms = random_terms(scale);
        std::vector<double>       own;
        for (unsigned int i = 0; i < n_terms; ++i)
          if (i * i % n_ranks == this_rank || (n_ranks > 1 && i * i % n_ranks > 1 && this_rank == 0))
            own.push_back(terms[i]);
        const auto all = [&](const std::size_t i) {
          return terms[i];
        };
        const auto some = [&](const std::size_t i) {
          return own[i];
        };
        const unsigned int n_own =
          dealii::Utilities::MPI::sum(static_cast<unsigned int>(own.size()), MPI_COMM_WORLD);
        check.that("each term is on one rank", n_own == n_terms);
        const double alone  = reproducible_sum(n_terms, all, MPI_COMM_SELF),
                     shared = reproducible_sum(own.size(), some, MPI_COMM_WORLD);
        check.that("all ranks together have the sum of one alone", shared == alone);
        check.absolute("its value over the largest term", alone / scale, exact(terms) / scale,
                       n_terms * 1e-20 + 1e-16);
      }
    const auto nothing = [](const std::size_t) {
      return 0.;
    };
    check.that("nothing", reproducible_sum(3, nothing, MPI_COMM_WORLD) == 0.);
  }


  void rounding(tests::Check &check)
  {
    const Quantum quantum(0x1p-26);
    check.absolute("rounded to a multiple, in quanta", 0x1p26 * quantum.round(1. + 0x1.8p-27), 0x1p26 + 1.,
                   0.);
    check.absolute("of the other sign", 0x1p26 * quantum.round(-1. - 0x1.8p-27), -0x1p26 - 1., 0.);
    check.absolute("a number too large for it, relative", quantum.round(1e12) / 1e12, 1., 0x1p-50);
    check.that("without a quantum", Quantum().round(1. / 3.) == 1. / 3.);
    std::mt19937        generator(3);
    std::vector<double> terms = random_terms(1e3);
    for (double &term : terms)
      term = quantum.round(term);
    double first = 0.;
    for (const double term : terms)
      first += 0.25 * term;
    bool equal = true;
    for (unsigned int order = 0; order < n_orders; ++order)
      {
        std::shuffle(terms.begin(), terms.end(), generator);
        double sum = 0.;
        for (const double term : terms)
          sum += 0.25 * term;
        equal = equal && sum == first;
      }
    check.that("quarters of rounded numbers have the same sum in any order", equal);
  }
} // namespace base_reproducible_sum


TREAD_TEST(base_reproducible_sum)(tests::Check &check, const tests::Arguments &)
{
  rounding(check);
  random_orders(check);
  lanes(check);
  ranks(check);
}
