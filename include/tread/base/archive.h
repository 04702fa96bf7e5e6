// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_archive_h
#define tread_base_archive_h

#include <tread/base/stored_bytes.h>

#include <mpi.h>

#include <array>
#include <cstddef>
#include <string>
#include <typeinfo>
#include <vector>

namespace tread
{
  /// The state of a run on its way to a file or back. A class that has state names it once, in a member
  /// function serialize(Archive &), which serves for both ways and which all ranks call together:
  ///
  ///     void WheelHub::serialize(Archive &archive)
  ///     {
  ///       archive.same(motion, drive);
  ///     }
  ///
  /// How a value is named says what becomes of it on another number of ranks. Each rank stores a part, and
  /// each rank reads all parts.
  class Archive
  {
  public:
    /// A name of a node or cell that does not depend on ranks: body and reference position in nm.
    using Key = std::array<long long, 4>;

    /// To store.
    explicit Archive(const MPI_Comm comm);

    /// To restore. @param parts what stored() gave on each rank, in the order of the ranks.
    /// @throws OtherStoredLayout if these are no such parts.
    Archive(const MPI_Comm comm, const std::string &parts);

    bool restores() const
    {
      return is_restoring;
    }

    /// What all ranks know alike: numbers, enumerations, structures of these, and vectors and maps of such.
    /// The first rank's are stored. @throws OtherStoredLayout if what was stored is of another size.
    template <typename... T>
    void same(T &...values)
    {
      if (is_restoring)
        (parts[0].read(values), ...);
      else if (this_rank == 0)
        (parts[0].write(values), ...);
    }

    /// The same for vectors of which the scene determines how many values they have. @throws
    /// OtherStoredLayout also if another number was stored.
    template <typename... T>
    void same_number(std::vector<T> &...values)
    {
      (keep_number(values), ...);
    }

    /// What comes next belongs to something of this kind. @throws OtherStoredLayout if what was stored does
    /// not
    void kind(const std::type_info &type);

    /// Shares of sums over the ranks. On as many ranks as before each gets its own back; on others the first
    /// has the whole sum.
    template <typename... T>
    void shares(T &...values)
    {
      (share(values), ...);
    }

    /// Numbers of which the largest rank's counts, such as seconds. On as many ranks as before each gets its
    /// own back; on others all have the largest.
    template <typename... T>
    void largest(T &...values)
    {
      (maximum(values), ...);
    }

    /// What is of use to this rank alone and can be found anew. @returns whether values are what was stored:
    /// they stay as they are on another number of ranks, or if their number has changed on any. Collective.
    template <typename T, typename A>
    bool own(std::vector<T, A> &values)
    {
      if (!is_restoring)
        {
          parts[0].write(values);
          return true;
        }
      std::vector<T, A> of_rank;
      for (unsigned int rank = 0; rank < parts.size(); ++rank)
        {
          std::vector<T, A> stored;
          parts[rank].read(stored);
          if (rank == this_rank)
            of_rank.swap(stored);
        }
      const bool found = on_all_ranks(same_ranks && of_rank.size() == values.size());
      if (found)
        values.swap(of_rank);
      return found;
    }

    /// Things that are spread over the ranks, each with its key. @returns those of all ranks when restoring:
    /// the class finds again what this rank has now, and tells of those that it does not find by miss().
    template <typename Record>
    std::vector<Record> records(const std::vector<Record> &of_this_rank)
    {
      if (!is_restoring)
        {
          parts[0].write(of_this_rank);
          return {};
        }
      std::vector<Record> all;
      for (unsigned int rank = 0; rank < parts.size(); ++rank)
        {
          std::vector<Record> stored;
          parts[rank].read(stored);
          all.insert(all.end(), stored.begin(), stored.end());
        }
      return all;
    }

    /// Something of this rank is not in the archive: it belongs to another mesh.
    void miss()
    {
      has_missed = true;
    }

    /// Whether everything was found on all ranks, and nothing is left over. Collective.
    bool found_all() const;

    /// The part of this rank, in bytes.
    std::string stored() const;
    /// The parts of all ranks, from which another archive restores. Collective.
    std::string stored_by_all() const;

  private:
    bool on_all_ranks(const bool holds) const;
    void share(double &value);
    void maximum(double &value);

    template <typename T>
    void keep_number(std::vector<T> &values)
    {
      const std::size_t number = values.size();
      same(values);
      if (values.size() != number)
        throw OtherStoredLayout();
    }

    MPI_Comm                 comm;
    unsigned int             this_rank;
    bool                     is_restoring, same_ranks = true, has_missed = false;
    std::vector<StoredBytes> parts; ///< when storing: this rank's alone
  };
} // namespace tread

#endif
