// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_first_ranks_h
#define tread_base_first_ranks_h

#include <mpi.h>

#include <map>

namespace tread
{
  /// Communicators of the first ranks of another one, for what is too small to be shared by all.
  class FirstRanks
  {
  public:
    explicit FirstRanks(const MPI_Comm all)
      : of_all(all)
    {
    }
    ~FirstRanks()
    {
      for (auto &[n, comm] : made)
        if (comm != MPI_COMM_NULL)
          MPI_Comm_free(&comm);
    }
    FirstRanks(const FirstRanks &)            = delete;
    FirstRanks &operator=(const FirstRanks &) = delete;

    MPI_Comm all() const
    {
      return of_all;
    }

    /// That of the first n ranks; MPI_COMM_NULL on the others. Collective over all where n is a new one.
    MPI_Comm first(const unsigned int n)
    {
      const auto [place, is_new] = made.try_emplace(n, MPI_COMM_NULL);
      if (is_new)
        {
          int rank;
          MPI_Comm_rank(of_all, &rank);
          MPI_Comm_split(of_all, static_cast<unsigned int>(rank) < n ? 0 : MPI_UNDEFINED, rank,
                         &place->second);
        }
      return place->second;
    }

  private:
    MPI_Comm                         of_all;
    std::map<unsigned int, MPI_Comm> made; ///< by their numbers of ranks
  };
} // namespace tread

#endif
