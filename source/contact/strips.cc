// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/contact/strips.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <stdexcept>

namespace tread
{
  namespace
  {
    /// Messages of this size leave at once, whatever the receiver does: MPI holds longer ones until it asks.
    constexpr std::size_t numbers_at_once = 384;
  } // namespace


  Strips::Strips(const ContactProblem &problem)
    : begin(0)
    , end_lower(0)
    , begin_upper(problem.constraints.size())
    , end(begin_upper)
    , first_acting(0)
    , end_acting(end)
    , comm(MPI_COMM_SELF)
    , sweeping(MPI_COMM_SELF)
    , begin_of_strip({0, end})
  {
  }


  Strips::Strips(const ContactProblem       &problem,
                 const std::vector<Vector3> &impulse,
                 const unsigned int          n_nodes,
                 FirstRanks                 &ranks,
                 const unsigned int          least_work)
    : Strips(problem)
  {
    comm                       = ranks.all();
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
    const unsigned int n       = problem.constraints.size();
    // Sweeps look at those without an impulse twice, and at the others some more times.
    constexpr unsigned int    more_sweeps = 3;
    std::vector<unsigned int> work(n + 1, 0); // of the constraints before each
    for (unsigned int j = 0; j < n; ++j)
      work[j + 1] = work[j] + (problem.constraints[j].end - problem.constraints[j].begin) *
                                (dot(impulse[j], problem.constraints[j].normal) > 0. ? more_sweeps : 1);
    for (unsigned int n_strips = std::clamp(work[n] / std::max(1u, least_work), 1u, n_ranks);; --n_strips)
      {
        begin_of_strip.assign(n_ranks + 1, n);
        for (unsigned int strip = 0; strip < n_strips; ++strip)
          begin_of_strip[strip] =
            std::lower_bound(work.begin(), work.end(), std::uint64_t(work[n]) * strip / n_strips) -
            work.begin();
        if (divide(problem, n_nodes))
          {
            let_sweep(ranks);
            return;
          }
      }
  }


  Strips::Strips(const ContactProblem            &problem,
                 const std::vector<unsigned int> &begin_of_strip,
                 const unsigned int               n_nodes,
                 FirstRanks                      &ranks)
    : Strips(problem)
  {
    comm                 = ranks.all();
    this->begin_of_strip = begin_of_strip;
    if (!divide(problem, n_nodes))
      throw std::invalid_argument("these strips are too thin for the pairs");
    let_sweep(ranks);
  }


  void Strips::let_sweep(FirstRanks &ranks)
  {
    // Those that begin where all end are empty.
    const auto empty = std::lower_bound(begin_of_strip.begin(), begin_of_strip.end(), begin_of_strip.back());
    n_sweeping       = std::max<std::ptrdiff_t>(1, empty - begin_of_strip.begin());
    sweeping         = ranks.first(n_sweeping);
  }


  bool Strips::divide(const ContactProblem &problem, const unsigned int n_nodes)
  {
    const unsigned int n_strips  = begin_of_strip.size() - 1; // the last ones may be empty
    const auto         for_nodes = [&](const unsigned int strip, const auto &loop) {
      for (unsigned int j = begin_of_strip[strip]; j < begin_of_strip[strip + 1]; ++j)
        for (unsigned int i = problem.constraints[j].begin; i < problem.constraints[j].end; ++i)
          loop(j, problem.entries[i].node);
    };
    std::vector<unsigned int> first(n_nodes, n_strips), last(n_nodes, 0); // strips that have a node
    if (n_strips > 1)
      for (unsigned int strip = 0; strip < n_strips; ++strip)
        for_nodes(strip, [&](const unsigned int, const unsigned int node) {
          first[node] = std::min(first[node], strip);
          last[node]  = strip;
        });

    const unsigned int this_rank = dealii::Utilities::MPI::this_mpi_process(comm);
    begin = end_lower = begin_of_strip[this_rank];
    begin_upper = end = begin_of_strip[this_rank + 1];
    first_acting      = begin;
    end_acting        = end;
    lower = upper                  = Neighbour();
    unsigned int end_of_lower_part = 0;
    for (unsigned int strip = 0; strip + 1 < n_strips; ++strip)
      {
        unsigned int begin_of_upper_part = begin_of_strip[strip + 1];
        bool         too_thin            = false;
        for_nodes(strip, [&](const unsigned int j, const unsigned int node) {
          if (last[node] > strip)
            begin_of_upper_part = std::min(begin_of_upper_part, j);
          too_thin |= last[node] > strip + 1;
        });
        if (too_thin || end_of_lower_part > begin_of_upper_part)
          return false;
        end_of_lower_part = begin_of_strip[strip + 1];
        for_nodes(strip + 1, [&](const unsigned int j, const unsigned int node) {
          if (first[node] == strip)
            end_of_lower_part = j + 1;
        });

        if (strip != this_rank && strip + 1 != this_rank)
          continue;
        Neighbour &neighbour = strip == this_rank ? upper : lower;
        neighbour.rank       = strip == this_rank ? strip + 1 : strip;
        for (unsigned int node = 0; node < n_nodes; ++node)
          if (first[node] == strip && last[node] == strip + 1)
            neighbour.nodes.push_back(node);
        if (strip == this_rank)
          {
            begin_upper = begin_of_upper_part;
            end_acting  = end_of_lower_part;
          }
        else
          {
            end_lower    = end_of_lower_part;
            first_acting = begin_of_upper_part;
          }
      }
    return true;
  }


  void Strips::send(Neighbour &to, const std::vector<Vector3> &velocity)
  {
    if (to.nodes.empty())
      return;
    wait(to);
    to.sent.clear();
    for (const unsigned int node : to.nodes)
      for (unsigned int d = 0; d < 3; ++d)
        to.sent.push_back(velocity[node][d]);
    for (std::size_t i = 0; i < to.sent.size(); i += numbers_at_once)
      {
        to.requests.emplace_back();
        MPI_Isend(to.sent.data() + i, std::min(numbers_at_once, to.sent.size() - i), MPI_DOUBLE, to.rank, 0,
                  comm, &to.requests.back());
      }
  }


  void Strips::wait(Neighbour &to)
  {
    if (to.requests.empty())
      return;
    MPI_Waitall(to.requests.size(), to.requests.data(), MPI_STATUSES_IGNORE);
    to.requests.clear();
  }


  void Strips::receive(Neighbour &from, std::vector<Vector3> &velocity)
  {
    if (from.nodes.empty())
      return;
    receive_buffer.resize(3 * from.nodes.size());
    for (std::size_t i = 0; i < receive_buffer.size(); i += numbers_at_once)
      MPI_Recv(receive_buffer.data() + i, std::min(numbers_at_once, receive_buffer.size() - i), MPI_DOUBLE,
               from.rank, 0, comm, MPI_STATUS_IGNORE);
    const double *value = receive_buffer.data();
    for (const unsigned int node : from.nodes)
      {
        velocity[node] = Vector3{value[0], value[1], value[2], 0.};
        value += 3;
      }
  }


  void Strips::largest(double (&values)[2]) const
  {
    if (n_sweeping > 1)
      MPI_Allreduce(MPI_IN_PLACE, values, 2, MPI_DOUBLE, MPI_MAX, sweeping);
  }


  double Strips::gather(std::vector<Vector3> &values, const double own)
  {
    const unsigned int n_ranks = begin_of_strip.size() - 1;
    if (n_ranks == 1)
      return own;
    send_buffer.assign(1, own);
    for (unsigned int j = begin; j < end; ++j)
      for (unsigned int d = 0; d < 3; ++d)
        send_buffer.push_back(values[j][d]);
    counts.resize(n_ranks);
    offsets.resize(n_ranks);
    for (unsigned int rank = 0; rank < n_ranks; ++rank)
      {
        counts[rank]  = 1 + 3 * (begin_of_strip[rank + 1] - begin_of_strip[rank]);
        offsets[rank] = rank + 3 * begin_of_strip[rank];
      }
    receive_buffer.resize(n_ranks + 3 * values.size());
    MPI_Allgatherv(send_buffer.data(), send_buffer.size(), MPI_DOUBLE, receive_buffer.data(), counts.data(),
                   offsets.data(), MPI_DOUBLE, comm);
    double        most  = own;
    const double *value = receive_buffer.data();
    for (unsigned int rank = 0; rank < n_ranks; ++rank)
      {
        most = std::max(most, *value++);
        for (unsigned int j = begin_of_strip[rank]; j < begin_of_strip[rank + 1]; ++j, value += 3)
          values[j] = Vector3{value[0], value[1], value[2], 0.};
      }
    return most;
  }
} // namespace tread
