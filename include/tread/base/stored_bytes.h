// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_stored_bytes_h
#define tread_base_stored_bytes_h

#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace tread
{
  /// What was stored has other values than those that are asked for.
  class OtherStoredLayout : public std::runtime_error
  {
  public:
    OtherStoredLayout()
      : std::runtime_error("the stored state has another layout")
    {
    }
  };

  /// What one rank stores in an archive, one value after the other, and how far it is read. Values are
  /// numbers, enumerations, structures of these, and vectors and maps of such. All read() throw
  /// OtherStoredLayout if the next values are of another size or not all there; no more room is made than
  /// there are bytes for.
  class StoredBytes
  {
  public:
    explicit StoredBytes(std::string bytes = {})
      : bytes(std::move(bytes))
    {
    }

    const std::string &all() const
    {
      return bytes;
    }
    bool is_read() const
    {
      return next == bytes.size();
    }

    template <typename T>
    void write(const T &value)
    {
      static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
      put(&value, 1, sizeof value);
    }

    template <typename T>
    void read(T &value)
    {
      static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
      if (get_number(sizeof value) != 1)
        throw OtherStoredLayout();
      get_values(&value, sizeof value);
    }

    /// Another byte than 0 or 1 would be neither true nor false.
    void read(bool &value)
    {
      unsigned char stored;
      read(stored);
      if (stored > 1)
        throw OtherStoredLayout();
      value = stored == 1;
    }

    template <typename T, typename A>
    void write(const std::vector<T, A> &values)
    {
      if constexpr (std::is_trivially_copyable_v<T>)
        put(values.data(), values.size(), sizeof(T));
      else
        {
          put(nullptr, values.size(), 0);
          for (const T &value : values)
            write(value);
        }
    }

    template <typename T, typename A>
    void read(std::vector<T, A> &values)
    {
      constexpr bool plain = std::is_trivially_copyable_v<T>;
      values.resize(get_number(plain ? sizeof(T) : 0));
      if constexpr (plain)
        get_values(values.data(), values.size() * sizeof(T));
      else
        for (T &value : values)
          read(value);
    }

    template <typename K, typename T>
    void write(const std::map<K, T> &values)
    {
      put(nullptr, values.size(), 0);
      for (const auto &[key, value] : values)
        {
          write(key);
          write(value);
        }
    }

    template <typename K, typename T>
    void read(std::map<K, T> &values)
    {
      values.clear();
      for (std::size_t n = get_number(0); n > 0; --n)
        {
          K key;
          read(key);
          read(values[key]);
        }
    }

  private:
    void put(const void *values, const std::size_t n, const std::size_t size);
    /// @returns the number n of values, which must be of this size and all be there; get_values() copies
    /// them.
    std::size_t get_number(const std::size_t size);
    void        get_values(void *values, const std::size_t n_bytes);

    std::string bytes;
    std::size_t next = 0; ///< to be read
  };
} // namespace tread

#endif
