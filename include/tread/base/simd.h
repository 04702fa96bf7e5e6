// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_simd_h
#define tread_base_simd_h

#include <cmath>
#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

namespace tread
{
  /// Number of cells that one kernel call works on: the doubles in one vector register.
#if defined(TREAD_LANES)
  inline constexpr unsigned int n_lanes = TREAD_LANES;
#elif defined(__AVX512F__)
  inline constexpr unsigned int n_lanes = 8;
#elif defined(__AVX__)
  inline constexpr unsigned int n_lanes = 4;
#else
  inline constexpr unsigned int n_lanes = 2;
#endif

  /// One double for each of n_lanes cells.
  typedef double Lanes __attribute__((vector_size(8 * n_lanes)));

  /// The quantities of one node: three components and one that pads to 32 bytes.
  typedef double Vector3 __attribute__((vector_size(32)));

  /// Put what of the memory fills pages of 2 MB into such where the system leaves that to programs (Linux):
  /// the cells' arrays go through the processor's caches in every step, and looking up where pages of 4 kB
  /// are takes a twentieth of the time. Arrays do not begin at such a page, so that they do not all compete
  /// for the same lines of the caches.
  inline void ask_for_huge_pages(void *memory, std::size_t size)
  {
#ifdef MADV_HUGEPAGE
    constexpr std::size_t huge_page = std::size_t(1) << 21, page = 4096;
    if (size < 2 * huge_page)
      return;
    void *begin = memory;
    if (std::align(page, huge_page, begin, size))
      madvise(begin, size / page * page, MADV_HUGEPAGE); // what cannot be had is not needed
#else
    (void)memory, (void)size;
#endif
  }

  /// Memory aligned to cache lines.
  template <typename T>
  struct AlignedAllocator
  {
    using value_type   = T;
    AlignedAllocator() = default;
    template <typename U>
    AlignedAllocator(const AlignedAllocator<U> &)
    {
    }
    T *allocate(const std::size_t n)
    {
      void *const memory = ::operator new(n * sizeof(T), std::align_val_t(64));
      ask_for_huge_pages(memory, n * sizeof(T));
      return static_cast<T *>(memory);
    }
    void deallocate(T *p, std::size_t)
    {
      ::operator delete(p, std::align_val_t(64));
    }
    template <typename U>
    bool operator==(const AlignedAllocator<U> &) const
    {
      return true;
    }
  };

  template <typename T>
  using AlignedVector = std::vector<T, AlignedAllocator<T>>;
  /// Nodal fields are arrays of Vector3.
  using NodalField = AlignedVector<Vector3>;

  inline double dot(const Vector3 a, const Vector3 b)
  {
    const Vector3 c = a * b;
    return c[0] + c[1] + c[2];
  }

  inline double norm(const Vector3 a)
  {
    return std::sqrt(dot(a, a));
  }

  inline Vector3 cross(const Vector3 a, const Vector3 b)
  {
    // In the order z, x, y, then turned.
    const Vector3 c =
      a * __builtin_shufflevector(b, b, 1, 2, 0, 3) - __builtin_shufflevector(a, a, 1, 2, 0, 3) * b;
    return __builtin_shufflevector(c, c, 1, 2, 0, 3);
  }

  inline Lanes broadcast(const double value)
  {
    return Lanes{} + value;
  }

  /// Read the rows of n_lanes nodes and transpose them: lane i of (x, y, z) belongs to node[i].
  template <typename L>
  inline void gather(const Vector3 *rows, const unsigned int *node, L &x, L &y, L &z)
  {
    if constexpr (sizeof(L) == 64)
      {
        const auto pair = [&](const unsigned int i) {
          return __builtin_shufflevector(rows[node[i]], rows[node[i + 4]], 0, 1, 2, 3, 4, 5, 6, 7);
        };
        const auto a = pair(0), b = pair(1), c = pair(2), d = pair(3);
        const auto ab_even = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
        const auto ab_odd  = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
        const auto cd_even = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
        const auto cd_odd  = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
        x                  = __builtin_shufflevector(ab_even, cd_even, 0, 1, 8, 9, 4, 5, 12, 13);
        y                  = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 8, 9, 4, 5, 12, 13);
        z                  = __builtin_shufflevector(ab_even, cd_even, 2, 3, 10, 11, 6, 7, 14, 15);
      }
    else if constexpr (sizeof(L) == 32)
      {
        const Vector3 a = rows[node[0]], b = rows[node[1]], c = rows[node[2]], d = rows[node[3]];
        const auto    ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6);
        const auto    ab_odd  = __builtin_shufflevector(a, b, 1, 5, 3, 7);
        const auto    cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6);
        const auto    cd_odd  = __builtin_shufflevector(c, d, 1, 5, 3, 7);
        x                     = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
        y                     = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
        z                     = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
      }
    else
      for (unsigned int i = 0; i < n_lanes; ++i)
        {
          x[i] = rows[node[i]][0];
          y[i] = rows[node[i]][1];
          z[i] = rows[node[i]][2];
        }
  }

  /// Inverse of gather(): add lane i of (x, y, z) to the row of node[i]. Lanes are added one
  /// after the other, so that cells of one batch may share nodes.
  template <typename L>
  inline void scatter_add(Vector3 *rows, const unsigned int *node, const L x, const L y, const L z)
  {
    if constexpr (sizeof(L) == 64)
      {
        const L    zero{};
        const auto xy_even    = __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14);
        const auto xy_odd     = __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15);
        const auto z_even     = __builtin_shufflevector(z, zero, 0, 8, 2, 10, 4, 12, 6, 14);
        const auto z_odd      = __builtin_shufflevector(z, zero, 1, 9, 3, 11, 5, 13, 7, 15);
        const L    rows_of[4] = {__builtin_shufflevector(xy_even, z_even, 0, 1, 8, 9, 4, 5, 12, 13),
                                 __builtin_shufflevector(xy_odd, z_odd, 0, 1, 8, 9, 4, 5, 12, 13),
                                 __builtin_shufflevector(xy_even, z_even, 2, 3, 10, 11, 6, 7, 14, 15),
                                 __builtin_shufflevector(xy_odd, z_odd, 2, 3, 10, 11, 6, 7, 14, 15)};
        for (unsigned int i = 0; i < 4; ++i)
          rows[node[i]] += __builtin_shufflevector(rows_of[i], rows_of[i], 0, 1, 2, 3);
        for (unsigned int i = 0; i < 4; ++i)
          rows[node[i + 4]] += __builtin_shufflevector(rows_of[i], rows_of[i], 4, 5, 6, 7);
      }
    else if constexpr (sizeof(L) == 32)
      {
        const L    zero{};
        const auto xy_even = __builtin_shufflevector(x, y, 0, 4, 2, 6);
        const auto xy_odd  = __builtin_shufflevector(x, y, 1, 5, 3, 7);
        const auto z_even  = __builtin_shufflevector(z, zero, 0, 4, 2, 6);
        const auto z_odd   = __builtin_shufflevector(z, zero, 1, 5, 3, 7);
        rows[node[0]] += __builtin_shufflevector(xy_even, z_even, 0, 1, 4, 5);
        rows[node[1]] += __builtin_shufflevector(xy_odd, z_odd, 0, 1, 4, 5);
        rows[node[2]] += __builtin_shufflevector(xy_even, z_even, 2, 3, 6, 7);
        rows[node[3]] += __builtin_shufflevector(xy_odd, z_odd, 2, 3, 6, 7);
      }
    else
      for (unsigned int i = 0; i < n_lanes; ++i)
        {
          rows[node[i]][0] += x[i];
          rows[node[i]][1] += y[i];
          rows[node[i]][2] += z[i];
        }
  }
} // namespace tread

#endif
