// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_lagrange_h
#define tread_base_lagrange_h

#include <cstddef>

namespace tread
{
  /// The weight that the value at place i has, at x, in the polynomial through the values at n places.
  /// @param place the places, place(0) to place(n - 1), no two alike
  template <typename Place>
  double lagrange_weight(const Place &place, const std::size_t n, const std::size_t i, const double x)
  {
    double weight = 1.;
    for (std::size_t k = 0; k < n; ++k)
      if (k != i)
        weight *= (x - place(k)) / (place(i) - place(k));
    return weight;
  }
} // namespace tread

#endif
