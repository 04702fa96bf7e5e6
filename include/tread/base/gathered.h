// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_gathered_h
#define tread_base_gathered_h

#include <deal.II/base/mpi.h>

#include <numeric>
#include <type_traits>
#include <vector>

namespace tread
{
  /// The data of all ranks, in the order of the ranks. Collective.
  template <typename T>
  std::vector<T> gathered(const std::vector<T> &own, const MPI_Comm comm)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    const int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm), n_own = own.size() * sizeof(T);
    if (n_ranks == 1)
      return own;
    std::vector<int> counts(n_ranks), offsets(n_ranks);
    MPI_Allgather(&n_own, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
    std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
    std::vector<T> all((offsets.back() + counts.back()) / sizeof(T));
    MPI_Allgatherv(own.data(), n_own, MPI_BYTE, all.data(), counts.data(), offsets.data(), MPI_BYTE, comm);
    return all;
  }
} // namespace tread

#endif
