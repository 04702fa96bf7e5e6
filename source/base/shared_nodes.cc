// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/shared_nodes.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>

#include <algorithm>
#include <map>
#include <numeric>

namespace tread
{
  SharedNodes::SharedNodes(const MPI_Comm comm, const std::vector<std::uint64_t> &global_ids)
    : comm(comm)
    , this_rank(dealii::Utilities::MPI::this_mpi_process(comm))
    , owned(global_ids.size(), true)
  {
    using dealii::Utilities::MPI::some_to_some;
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
    if (n_ranks == 1)
      return;

    // A directory spread over the ranks knows who holds which node.
    std::map<unsigned int, std::vector<std::uint64_t>> to_directory;
    for (const std::uint64_t id : global_ids)
      to_directory[id % n_ranks].push_back(id);
    std::map<std::uint64_t, std::vector<unsigned int>> holders;
    for (const auto &[rank, ids] : some_to_some(comm, to_directory))
      for (const std::uint64_t id : ids)
        holders[id].push_back(rank);

    std::map<unsigned int, std::vector<std::pair<std::uint64_t, unsigned int>>> from_directory;
    for (const auto &[id, ranks] : holders)
      if (ranks.size() > 1)
        for (const unsigned int holder : ranks)
          for (const unsigned int other : ranks)
            if (other != holder)
              from_directory[holder].emplace_back(id, other);

    std::map<std::uint64_t, unsigned int> local;
    for (unsigned int i = 0; i < global_ids.size(); ++i)
      local[global_ids[i]] = i;
    std::map<unsigned int, std::vector<std::pair<std::uint64_t, unsigned int>>> by_rank;
    for (const auto &[directory, entries] : some_to_some(comm, from_directory))
      for (const auto &[id, other] : entries)
        by_rank[other].emplace_back(id, local.at(id));

    for (auto &[rank, entries] : by_rank)
      {
        std::sort(entries.begin(), entries.end());
        Neighbour neighbour{static_cast<int>(rank), {}};
        for (const auto &[id, node] : entries)
          {
            neighbour.nodes.push_back(node);
            shared.push_back(node);
            if (neighbour.rank < this_rank)
              owned[node] = false;
          }
        neighbours.push_back(std::move(neighbour));
      }
    std::sort(shared.begin(), shared.end());
    shared.erase(std::unique(shared.begin(), shared.end()), shared.end());

    std::size_t n_exchanged = 0;
    for (const Neighbour &neighbour : neighbours)
      n_exchanged += neighbour.nodes.size();
    send_buffer.resize(3 * n_exchanged);
    receive_buffer.resize(3 * n_exchanged);
    own_values.resize(shared.size());
  }


  void SharedNodes::sum(Vector3 *field) const
  {
    if (neighbours.empty())
      return;

    std::vector<MPI_Request> requests;
    double                  *send = send_buffer.data(), *receive = receive_buffer.data();
    for (const Neighbour &neighbour : neighbours)
      {
        const int n = 3 * neighbour.nodes.size();
        requests.emplace_back();
        MPI_Irecv(receive, n, MPI_DOUBLE, neighbour.rank, 17, comm, &requests.back());
        for (unsigned int i = 0; i < neighbour.nodes.size(); ++i)
          for (unsigned int d = 0; d < 3; ++d)
            send[3 * i + d] = field[neighbour.nodes[i]][d];
        requests.emplace_back();
        MPI_Isend(send, n, MPI_DOUBLE, neighbour.rank, 17, comm, &requests.back());
        send += n;
        receive += n;
      }
    for (unsigned int i = 0; i < shared.size(); ++i)
      {
        own_values[i]    = field[shared[i]];
        field[shared[i]] = Vector3{};
      }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);

    bool       own_added = false;
    const auto add_own   = [&]() {
      for (unsigned int i = 0; i < shared.size(); ++i)
        field[shared[i]] += own_values[i];
      own_added = true;
    };
    const double *received = receive_buffer.data();
    for (const Neighbour &neighbour : neighbours)
      {
        if (!own_added && neighbour.rank > this_rank)
          add_own();
        for (const unsigned int node : neighbour.nodes)
          {
            field[node] += Vector3{received[0], received[1], received[2], 0.};
            received += 3;
          }
      }
    if (!own_added)
      add_own();
  }
} // namespace tread
