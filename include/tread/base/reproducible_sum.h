// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_reproducible_sum_h
#define tread_base_reproducible_sum_h

#include <tread/base/simd.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace tread
{
  /// Rounds to the nearest multiple of a power of two. Sums of such numbers are exact as long as they stay
  /// below 2^53 quanta, hence the same in any order. Halves and quarters of them still are, of two bits less.
  ///
  /// A sum with 1.5 * 2^52 quanta has no room for smaller digits, and the difference is exact; numbers beyond
  /// 2^51 quanta lose no more than they lose in a sum with others of their size, but that depends on the
  /// order.
  class Quantum
  {
  public:
    /// @param quantum a power of two; 0: numbers stay as they are.
    explicit constexpr Quantum(const double quantum = 0.)
      : shift(0x1.8p52 * quantum)
    {
    }

    /// @param x a number or a vector of numbers
    template <typename T>
    T round(const T x) const
    {
      return (x + shift) - shift;
    }

  private:
    double shift;
  };


  /// Takes the place of a Quantum where nothing is rounded and not even the additions of 0 are to be made.
  struct NoRounding
  {
    template <typename T>
    T round(const T x) const
    {
      return x;
    }
  };


  /// A sum that does not depend on the order of its terms, nor on how they are divided among partial sums, to
  /// the last bit (after Demmel & Nguyen 2013; Ahrens, Demmel & Nguyen 2020, with bins that are fixed
  /// before).
  ///
  /// Each term is divided among three bins of 26 bits, each of which sums exactly. It may have up to 2^41
  /// units, and what is below 2^-63 units is rounded off. Up to 2^26 terms may be added one by one; sums may
  /// be added without end. T is double or a vector of lanes.
  template <typename T = double>
  class ReproducibleSum
  {
  public:
    /// @param unit a power of two, of which there need be one or a few in the sum.
    explicit ReproducibleSum(const double unit = 1.)
      : unit(unit)
    {
    }

    void add(T term)
    {
      for (unsigned int k = 0; k < n_bins; ++k)
        {
          const T part = quantum(k).round(term);
          bins[k] += part;
          term -= part;
        }
    }

    /// Another sum with the same unit.
    void add(const ReproducibleSum &other)
    {
      for (unsigned int k = 0; k < n_bins; ++k)
        bins[k] += other.bins[k];
      carry();
    }

    ReproducibleSum operator-() const
    {
      ReproducibleSum negative(*this);
      for (T &bin : negative.bins)
        bin = -bin;
      return negative;
    }

    /// The sum of all lanes.
    ReproducibleSum<double> of_lanes() const
    {
      ReproducibleSum<double> sum(unit);
      for (unsigned int l = 0; l < n_lanes; ++l)
        {
          ReproducibleSum<double> lane(unit);
          for (unsigned int k = 0; k < n_bins; ++k)
            lane.bins[k] = bins[k][l];
          sum.add(lane);
        }
      return sum;
    }

    /// The sum, rounded once.
    T value() const
    {
      ReproducibleSum copy(*this);
      copy.carry();
      return copy.bins[0] + (copy.bins[1] + copy.bins[2]); // the smaller bins together fit into one number
    }

    /// The sum of what all ranks have. Collective.
    T value(const MPI_Comm comm) const
    {
      static_assert(std::is_same_v<T, double>);
      ReproducibleSum all(*this);
      all.carry();
      dealii::Utilities::MPI::sum(all.bins, comm, all.bins);
      return all.value();
    }

    /// Append what is to be summed over the ranks, and, of a sum that was put there, its value. @param bins
    /// of all ranks, moved to what comes behind
    void put_into(std::vector<double> &sent)
    {
      carry();
      sent.insert(sent.end(), bins, bins + n_bins);
    }
    double value_from(const double *&of_all) const
    {
      ReproducibleSum all(unit);
      std::copy(of_all, of_all + n_bins, all.bins);
      of_all += n_bins;
      return all.value();
    }

    /// Store or restore this rank's share of a sum over the ranks.
    template <typename Archive>
    void serialize(Archive &archive)
    {
      carry();
      archive.shares(bins[0], bins[1], bins[2]);
    }

  private:
    template <typename>
    friend class ReproducibleSum;

    static constexpr unsigned int n_bins = 3;

    Quantum quantum(const unsigned int k) const
    {
      constexpr double quanta[n_bins] = {0x1p-10, 0x1p-36, 0x1p-62};
      return Quantum(unit * quanta[k]);
    }

    /// Move to the larger bins what the smaller ones hold for them.
    void carry()
    {
      for (unsigned int k = n_bins - 1; k > 0; --k)
        {
          const T part = quantum(k - 1).round(bins[k]);
          bins[k - 1] += part;
          bins[k] -= part;
        }
    }

    double unit;
    T      bins[n_bins] = {};
  };


  /// What value(comm) gives for each of these sums, in one operation of all ranks. Collective.
  template <std::size_t n>
  std::array<double, n> values_of(std::array<ReproducibleSum<double>, n> sums, const MPI_Comm comm)
  {
    std::vector<double> bins;
    for (ReproducibleSum<double> &sum : sums)
      sum.put_into(bins);
    dealii::Utilities::MPI::sum(bins, comm, bins);
    std::array<double, n> values;
    const double         *next = bins.data();
    for (std::size_t k = 0; k < n; ++k)
      values[k] = sums[k].value_from(next);
    return values;
  }


  /// Sum of term(i) for i below n over all ranks, with 50 bits below the largest of all terms, the same for
  /// any division of the terms among the ranks. Each term is asked for twice. Collective.
  template <typename Term>
  double reproducible_sum(const std::size_t n, const Term &term, const MPI_Comm comm)
  {
    double largest = 0.;
    for (std::size_t i = 0; i < n; ++i)
      largest = std::max(largest, std::abs(term(i)));
    largest = dealii::Utilities::MPI::max(largest, comm);
    if (largest == 0. || !std::isfinite(largest))
      return largest;
    // The largest term may have 2^26 quanta of the first bin, and there may be 2^27 like it.
    constexpr int           below_largest = 16;
    ReproducibleSum<double> sum(std::ldexp(1., std::ilogb(largest) + 1 - below_largest));
    for (std::size_t i = 0; i < n; ++i)
      sum.add(term(i));
    return sum.value(comm);
  }
} // namespace tread

#endif
