// SPDX-License-Identifier: LGPL-2.1-or-later
// What a program sends and where it waits: a library that is loaded before MPI (LD_PRELOAD) and counts the
// calls of each rank through MPI's profiling interface, from MPI_Pcontrol(1) to MPI_Pcontrol(0): over the
// time steps. Written to the file TREAD_MESSAGES when MPI ends, a line for each rank: messages and bytes sent
// to single ranks, waits for them, collective operations, the doublings from one rank to all of theirs, and
// the bytes that each rank gives to them.
#include <mpi.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace
{
  struct Counts
  {
    long long messages = 0, bytes = 0, waits = 0, collectives = 0, doublings = 0, collective_bytes = 0;
  };
  Counts counts;
  bool   counts_now = false;

  long long bytes_of(const int n, MPI_Datatype type)
  {
    int size;
    PMPI_Type_size(type, &size);
    return static_cast<long long>(n) * size;
  }

  void sent(const int n, MPI_Datatype type)
  {
    if (!counts_now)
      return;
    ++counts.messages;
    counts.bytes += bytes_of(n, type);
  }

  /// From one rank to twice as many, and so on.
  int doublings_of(MPI_Comm comm)
  {
    int n_ranks, n = 0;
    PMPI_Comm_size(comm, &n_ranks);
    while ((1 << n) < n_ranks)
      ++n;
    return n;
  }

  void all_together(MPI_Comm comm, const long long bytes)
  {
    if (!counts_now)
      return;
    ++counts.collectives;
    counts.doublings += doublings_of(comm);
    counts.collective_bytes += bytes;
  }
} // namespace

extern "C"
{
  int MPI_Pcontrol(const int level, ...)
  {
    counts_now = level > 0;
    return PMPI_Pcontrol(level);
  }

  int MPI_Send(const void *data, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm)
  {
    sent(n, type);
    return PMPI_Send(data, n, type, to, tag, comm);
  }

  int MPI_Isend(const void  *data,
                int          n,
                MPI_Datatype type,
                int          to,
                int          tag,
                MPI_Comm     comm,
                MPI_Request *request)
  {
    sent(n, type);
    return PMPI_Isend(data, n, type, to, tag, comm, request);
  }

  int MPI_Recv(void *data, int n, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Status *status)
  {
    counts.waits += counts_now;
    return PMPI_Recv(data, n, type, from, tag, comm, status);
  }

  int MPI_Wait(MPI_Request *request, MPI_Status *status)
  {
    counts.waits += counts_now;
    return PMPI_Wait(request, status);
  }

  int MPI_Waitall(int n, MPI_Request *requests, MPI_Status *statuses)
  {
    counts.waits +=
      counts_now && std::any_of(requests, requests + n, [](MPI_Request r) { return r != MPI_REQUEST_NULL; });
    return PMPI_Waitall(n, requests, statuses);
  }

  int MPI_Barrier(MPI_Comm comm)
  {
    all_together(comm, 0);
    return PMPI_Barrier(comm);
  }

  int MPI_Bcast(void *data, int n, MPI_Datatype type, int root, MPI_Comm comm)
  {
    all_together(comm, bytes_of(n, type));
    return PMPI_Bcast(data, n, type, root, comm);
  }

  int MPI_Reduce(const void *give, void *take, int n, MPI_Datatype type, MPI_Op op, int root, MPI_Comm comm)
  {
    all_together(comm, bytes_of(n, type));
    return PMPI_Reduce(give, take, n, type, op, root, comm);
  }

  int MPI_Allreduce(const void *give, void *take, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm)
  {
    all_together(comm, bytes_of(n, type));
    return PMPI_Allreduce(give, take, n, type, op, comm);
  }

  int MPI_Allgather(const void  *give,
                    int          n,
                    MPI_Datatype type,
                    void        *take,
                    int          n_taken,
                    MPI_Datatype type_taken,
                    MPI_Comm     comm)
  {
    all_together(comm, bytes_of(n, type));
    return PMPI_Allgather(give, n, type, take, n_taken, type_taken, comm);
  }

  int MPI_Allgatherv(const void  *give,
                     int          n,
                     MPI_Datatype type,
                     void        *take,
                     const int   *n_taken,
                     const int   *places,
                     MPI_Datatype type_taken,
                     MPI_Comm     comm)
  {
    all_together(comm, bytes_of(n, type));
    return PMPI_Allgatherv(give, n, type, take, n_taken, places, type_taken, comm);
  }

  int MPI_Alltoallv(const void  *give,
                    const int   *n,
                    const int   *places,
                    MPI_Datatype type,
                    void        *take,
                    const int   *n_taken,
                    const int   *places_taken,
                    MPI_Datatype type_taken,
                    MPI_Comm     comm)
  {
    int n_ranks;
    PMPI_Comm_size(comm, &n_ranks);
    long long bytes = 0;
    for (int rank = 0; rank < n_ranks; ++rank)
      bytes += bytes_of(n[rank], type);
    all_together(comm, bytes);
    return PMPI_Alltoallv(give, n, places, type, take, n_taken, places_taken, type_taken, comm);
  }

  int MPI_Finalize()
  {
    int rank, n_ranks;
    PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
    PMPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
    const long long        own[] = {counts.messages,    counts.bytes,     counts.waits,
                                    counts.collectives, counts.doublings, counts.collective_bytes};
    constexpr int          n     = sizeof own / sizeof *own;
    std::vector<long long> all(n * n_ranks);
    PMPI_Gather(own, n, MPI_LONG_LONG, all.data(), n, MPI_LONG_LONG, 0, MPI_COMM_WORLD);
    if (const char *path = std::getenv("TREAD_MESSAGES"); path && rank == 0)
      if (std::FILE *file = std::fopen(path, "w"))
        {
          std::fputs("rank,messages,bytes,waits,collectives,doublings,collective_bytes\n", file);
          for (int r = 0; r < n_ranks; ++r)
            {
              std::fprintf(file, "%d", r);
              for (int k = 0; k < n; ++k)
                std::fprintf(file, ",%lld", all[n * r + k]);
              std::fputc('\n', file);
            }
          std::fclose(file);
        }
    return PMPI_Finalize();
  }
}
