// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/archive.h>
#include <tread/base/gathered.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace tread
{
  namespace
  {
    /// Stands before each group of values.
    struct Group
    {
      std::uint64_t number, size; ///< of values; bytes of each, 0 where each has a group of its own
    };
  } // namespace


  Archive::Archive(const MPI_Comm comm)
    : comm(comm)
    , this_rank(dealii::Utilities::MPI::this_mpi_process(comm))
    , is_restoring(false)
    , parts(1)
  {
  }


  Archive::Archive(const MPI_Comm comm, const std::string &all)
    : comm(comm)
    , this_rank(dealii::Utilities::MPI::this_mpi_process(comm))
    , is_restoring(true)
  {
    for (std::size_t begin = 0; begin < all.size();)
      {
        std::uint64_t size;
        if (all.size() - begin < sizeof size)
          throw OtherLayout();
        std::memcpy(&size, all.data() + begin, sizeof size);
        begin += sizeof size;
        if (all.size() - begin < size)
          throw OtherLayout();
        parts.push_back({all.substr(begin, size)});
        begin += size;
      }
    if (parts.empty())
      throw OtherLayout();
    same_ranks = parts.size() == dealii::Utilities::MPI::n_mpi_processes(comm);
  }


  std::string Archive::stored() const
  {
    const std::uint64_t size = parts[0].bytes.size();
    return std::string(reinterpret_cast<const char *>(&size), sizeof size) + parts[0].bytes;
  }


  std::string Archive::stored_by_all() const
  {
    const std::string       own = stored();
    const std::vector<char> all = gathered(std::vector<char>(own.begin(), own.end()), comm);
    return std::string(all.begin(), all.end());
  }


  void Archive::kind(const std::type_info &type)
  {
    const std::string       name = type.name();
    const std::vector<char> wanted(name.begin(), name.end());
    std::vector<char>       found = wanted;
    same(found);
    if (found != wanted)
      throw OtherLayout();
  }


  bool Archive::on_all_ranks(const bool holds) const
  {
    return !dealii::Utilities::MPI::logical_or(!holds, comm);
  }


  bool Archive::found_all() const
  {
    return on_all_ranks(!has_missed && std::all_of(parts.begin(), parts.end(), [](const Part &part) {
      return part.next == part.bytes.size();
    }));
  }


  void Archive::require_number(const std::size_t wanted, const std::size_t stored)
  {
    if (stored != wanted)
      throw OtherLayout();
  }


  void Archive::put(const void *values, const std::size_t n, const std::size_t size)
  {
    const Group  group{n, size};
    std::string &bytes = parts[0].bytes;
    bytes.append(reinterpret_cast<const char *>(&group), sizeof group);
    if (n * size > 0)
      bytes.append(static_cast<const char *>(values), n * size);
  }


  std::size_t Archive::get_number(const unsigned int rank, const std::size_t size)
  {
    Group group;
    get_values(rank, &group, sizeof group);
    // No more values than there are bytes for are made room for.
    const Part       &part  = parts[rank];
    const std::size_t least = size > 0 ? size : sizeof(Group);
    if (group.size != size || group.number > (part.bytes.size() - part.next) / least)
      throw OtherLayout();
    return group.number;
  }


  void Archive::get_values(const unsigned int rank, void *values, const std::size_t bytes)
  {
    Part &part = parts[rank];
    if (part.bytes.size() - part.next < bytes)
      throw OtherLayout();
    if (bytes > 0)
      std::memcpy(values, part.bytes.data() + part.next, bytes);
    part.next += bytes;
  }


  void Archive::share(double &value)
  {
    if (!is_restoring)
      {
        write(value);
        return;
      }
    double sum = 0., of_rank = 0.;
    for (unsigned int rank = 0; rank < parts.size(); ++rank)
      {
        double stored;
        read(stored, rank);
        sum += stored;
        if (rank == this_rank)
          of_rank = stored;
      }
    value = same_ranks ? of_rank : this_rank == 0 ? sum : 0.;
  }


  void Archive::maximum(double &value)
  {
    if (!is_restoring)
      {
        write(value);
        return;
      }
    double most = 0., of_rank = 0.;
    for (unsigned int rank = 0; rank < parts.size(); ++rank)
      {
        double stored;
        read(stored, rank);
        most = std::max(most, stored);
        if (rank == this_rank)
          of_rank = stored;
      }
    value = same_ranks ? of_rank : most;
  }
} // namespace tread
