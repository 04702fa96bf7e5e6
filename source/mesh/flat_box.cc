// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/mesh/flat_box.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tread
{
  Body make_flat_box(const FlatBox   &box,
                     const double     coarsest,
                     const double     contact_half_width,
                     const FineZones &zones)
  {
    if (!(box.x_begin < box.x_end && box.half_width > 0. && box.depth > 0.))
      throw std::invalid_argument("a rail needs a positive length, width and height");

    // The coarse grid starts at x = 0 where it can, so that a symmetric zone gets a symmetric mesh.
    const double anchor = (box.x_begin <= 0. && 0. <= box.x_end) ? 0. : 0.5 * (box.x_begin + box.x_end);
    // If rows may be longer than others, all rows of cubes are regular anyway.
    std::vector<CoarseSide> sides{{box.half_width, zones.any().reach()}, {box.depth, zones.any().depth}};
    if (zones.any().path_stretch <= 1.)
      {
        sides.push_back({anchor - box.x_begin, anchor - zones.x_begin()});
        sides.push_back({box.x_end - anchor, zones.x_end() - anchor});
      }
    const double size = coarse_cell_size(zones.any().finest_cell_size, coarsest, sides);

    const PathLines           path = path_lines(box.x_begin, box.x_end, size, zones, 1.);
    const std::vector<double> x    = path.lines;
    const std::vector<double> y    = coarse_lines(-box.half_width, box.half_width, 0., size);
    const std::vector<double> z    = coarse_lines(-box.depth, 0., 0., size);
    const unsigned int        n_x = x.size(), n_y = y.size(), n_z = z.size();
    const auto                index = [n_x, n_y](unsigned int i, unsigned int j, unsigned int k) {
      return i + n_x * (j + n_y * k);
    };

    Body body;
    for (unsigned int k = 0; k < n_z; ++k)
      for (unsigned int j = 0; j < n_y; ++j)
        for (unsigned int i = 0; i < n_x; ++i)
          body.vertices.emplace_back(x[i], y[j], z[k]);
    for (unsigned int k = 0; k + 1 < n_z; ++k)
      for (unsigned int j = 0; j + 1 < n_y; ++j)
        for (unsigned int i = 0; i + 1 < n_x; ++i)
          {
            dealii::CellData<3> cell;
            for (unsigned int v = 0; v < 8; ++v)
              cell.vertices[v] = index(i + v % 2, j + v / 2 % 2, k + v / 4);
            body.cells.push_back(cell);
          }

    body.wanted_cell_size = [zones](const dealii::Point<3> &p) {
      return zones.wanted_size(p[0], p[1], -p[2]);
    };

    if (zones.any().path_stretch > 1.)
      body.path_stretch = [path](const dealii::Point<3> &p) {
        return std::max(1., path.stretch(p[0]));
      };

    const double tolerance = 1e-3 * size;
    body.boundary_at       = [box, contact_half_width, tolerance](const dealii::Point<3> &p) {
      if (std::abs(p[2]) < tolerance)
        return std::abs(p[1]) <= contact_half_width ? Boundary::contact : Boundary::free;
      if (std::abs(p[2] + box.depth) < tolerance)
        return Boundary::support;
      if (std::min(std::abs(p[0] - box.x_begin), std::abs(p[0] - box.x_end)) < tolerance)
        return Boundary::end;
      return Boundary::free;
    };
    return body;
  }
} // namespace tread
