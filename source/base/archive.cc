// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/archive.h>
#include <tread/base/gathered.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace tread
{
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
          throw OtherStoredLayout();
        std::memcpy(&size, all.data() + begin, sizeof size);
        begin += sizeof size;
        if (all.size() - begin < size)
          throw OtherStoredLayout();
        parts.emplace_back(all.substr(begin, size));
        begin += size;
      }
    if (parts.empty())
      throw OtherStoredLayout();
    same_ranks = parts.size() == dealii::Utilities::MPI::n_mpi_processes(comm);
  }


  std::string Archive::stored() const
  {
    const std::uint64_t size = parts[0].all().size();
    return std::string(reinterpret_cast<const char *>(&size), sizeof size) + parts[0].all();
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
      throw OtherStoredLayout();
  }


  bool Archive::on_all_ranks(const bool holds) const
  {
    return !dealii::Utilities::MPI::logical_or(!holds, comm);
  }


  bool Archive::found_all() const
  {
    return on_all_ranks(!has_missed && std::all_of(parts.begin(), parts.end(),
                                                   [](const StoredBytes &part) { return part.is_read(); }));
  }


  void Archive::share(double &value)
  {
    if (!is_restoring)
      {
        parts[0].write(value);
        return;
      }
    double sum = 0., of_rank = 0.;
    for (unsigned int rank = 0; rank < parts.size(); ++rank)
      {
        double stored;
        parts[rank].read(stored);
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
        parts[0].write(value);
        return;
      }
    double most = 0., of_rank = 0.;
    for (unsigned int rank = 0; rank < parts.size(); ++rank)
      {
        double stored;
        parts[rank].read(stored);
        most = std::max(most, stored);
        if (rank == this_rank)
          of_rank = stored;
      }
    value = same_ranks ? of_rank : most;
  }
} // namespace tread
