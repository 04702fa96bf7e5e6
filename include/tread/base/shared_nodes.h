// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_shared_nodes_h
#define tread_base_shared_nodes_h

#include <tread/base/simd.h>

#include <mpi.h>

#include <cstdint>
#include <vector>

namespace tread
{
  /// Nodes of which several ranks hold a copy, and the sum of their forces over these ranks. Every rank adds
  /// the partial sums in the order of the ranks, so that all copies remain identical to the last bit.
  class SharedNodes
  {
  public:
    SharedNodes() = default;

    /// @param global_ids of the nodes that this rank holds, each once, by local number.
    SharedNodes(const MPI_Comm comm, const std::vector<std::uint64_t> &global_ids);

    /// Replace the rows of shared nodes by their sums over all ranks. Collective among neighbours.
    void sum(Vector3 *field) const;

    /// The lowest rank that holds the node counts it in global sums.
    bool is_owned(const unsigned int node) const
    {
      return owned.empty() || owned[node];
    }

    /// The nodes of this rank that have a copy elsewhere.
    const std::vector<unsigned int> &nodes() const
    {
      return shared;
    }

  private:
    struct Neighbour
    {
      int                       rank;
      std::vector<unsigned int> nodes; ///< local numbers, in the order of global ids
    };

    MPI_Comm                    comm      = MPI_COMM_SELF;
    int                         this_rank = 0;
    std::vector<Neighbour>      neighbours; ///< ascending ranks
    std::vector<unsigned int>   shared;     ///< all nodes that have a copy elsewhere
    std::vector<char>           owned;
    mutable std::vector<double> send_buffer, receive_buffer;
    mutable NodalField          own_values;
  };
} // namespace tread

#endif
