// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_mesh_even_lines_h
#define tread_mesh_even_lines_h

#include <algorithm>
#include <cmath>
#include <vector>

namespace tread
{
  /// n + 1 evenly spaced values.
  inline std::vector<double> even_lines(const double begin, const double end, const unsigned int n)
  {
    std::vector<double> lines(n + 1);
    for (unsigned int i = 0; i <= n; ++i)
      lines[i] = begin + (end - begin) * i / n;
    return lines;
  }

  /// Rows of cells of about this size.
  inline unsigned int rows_of(const double length, const double size, const unsigned int least)
  {
    return std::max(least, static_cast<unsigned int>(std::lround(length / size)));
  }
} // namespace tread

#endif
