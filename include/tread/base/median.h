// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_median_h
#define tread_base_median_h

#include <algorithm>
#include <vector>

namespace tread
{
  /// Of an even number of values the upper one of both middle ones; 0 of none.
  inline double median(std::vector<double> values)
  {
    if (values.empty())
      return 0.;
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  }
} // namespace tread

#endif
