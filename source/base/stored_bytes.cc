// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/stored_bytes.h>

#include <cstdint>
#include <cstring>

namespace tread
{
  namespace
  {
    /// Stands before each group of values.
    struct GroupOfValues
    {
      std::uint64_t number, size; ///< of values; bytes of each, 0 where each has a group of its own
    };
  } // namespace


  void StoredBytes::put(const void *values, const std::size_t n, const std::size_t size)
  {
    const GroupOfValues group{n, size};
    bytes.append(reinterpret_cast<const char *>(&group), sizeof group);
    if (n * size > 0)
      bytes.append(static_cast<const char *>(values), n * size);
  }


  std::size_t StoredBytes::get_number(const std::size_t size)
  {
    GroupOfValues group;
    get_values(&group, sizeof group);
    const std::size_t least = size > 0 ? size : sizeof(GroupOfValues);
    if (group.size != size || group.number > (bytes.size() - next) / least)
      throw OtherStoredLayout();
    return group.number;
  }


  void StoredBytes::get_values(void *values, const std::size_t n_bytes)
  {
    if (bytes.size() - next < n_bytes)
      throw OtherStoredLayout();
    if (n_bytes > 0)
      std::memcpy(values, bytes.data() + next, n_bytes);
    next += n_bytes;
  }
} // namespace tread
