// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tests_boxes_h
#define tread_tests_boxes_h

#include <tread/mesh/body.h>

#include <array>
#include <limits>

namespace tread::tests
{
  /// A box of n cells a direction; boundary of its six faces (-x, +x, -y, +y, -z, +z) as given.
  inline Body make_box(const std::string                 &name,
                       const dealii::Point<3>            &low,
                       const dealii::Point<3>            &high,
                       const std::array<unsigned int, 3> &n,
                       const std::array<Boundary, 6>     &boundaries)
  {
    Body body;
    body.name = name;
    for (unsigned int k = 0; k <= n[2]; ++k)
      for (unsigned int j = 0; j <= n[1]; ++j)
        for (unsigned int i = 0; i <= n[0]; ++i)
          body.vertices.emplace_back(low[0] + (high[0] - low[0]) * i / n[0],
                                     low[1] + (high[1] - low[1]) * j / n[1],
                                     low[2] + (high[2] - low[2]) * k / n[2]);
    const auto number = [&](const unsigned int i, const unsigned int j, const unsigned int k) {
      return i + (n[0] + 1) * (j + (n[1] + 1) * k);
    };
    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
          {
            dealii::CellData<3> cell;
            for (unsigned int v = 0; v < 8; ++v)
              cell.vertices[v] = number(i + (v & 1), j + ((v >> 1) & 1), k + ((v >> 2) & 1));
            body.cells.push_back(cell);
          }
    body.wanted_cell_size = [](const dealii::Point<3> &) { return std::numeric_limits<double>::max(); };
    body.boundary_at      = [=](const dealii::Point<3> &p) {
      for (unsigned int d = 0; d < 3; ++d)
        {
          const double tolerance = 1e-9 * (high[d] - low[d]);
          if (p[d] < low[d] + tolerance)
            return boundaries[2 * d];
          if (p[d] > high[d] - tolerance)
            return boundaries[2 * d + 1];
        }
      return Boundary::free;
    };
    return body;
  }
} // namespace tread::tests

#endif
