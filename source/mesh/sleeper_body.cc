// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/mesh/sleeper_body.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

namespace tread
{
  Body make_sleeper(const SleeperBox &box)
  {
    if (!(box.width > 0. && box.height > 0. && box.y_begin < box.y_end && box.coarsest_cell_size > 0.))
      throw std::invalid_argument("a sleeper needs a positive length, width and height");
    const dealii::Point<3> low(box.x - 0.5 * box.width, box.y_begin, box.top - box.height),
      high(box.x + 0.5 * box.width, box.y_end, box.top);
    // Two layers at least: one has no bending but that of hourglass control.
    constexpr unsigned int    least = 2;
    std::vector<unsigned int> n;
    for (unsigned int d = 0; d < 3; ++d)
      n.push_back(
        std::max<unsigned int>(least, std::ceil((high[d] - low[d]) / box.coarsest_cell_size - 1e-9)));
    dealii::Triangulation<3> grid;
    dealii::GridGenerator::subdivided_hyper_rectangle(grid, n, low, high);

    Body body;
    body.name                                        = "sleeper";
    std::tie(body.vertices, body.cells, std::ignore) = dealii::GridTools::get_coarse_mesh_description(grid);
    body.wanted_cell_size                            = [](const dealii::Point<3> &) {
      return std::numeric_limits<double>::max();
    };
    const double tolerance = 1e-6 * box.height;
    body.boundary_at       = [box, tolerance](const dealii::Point<3> &p) {
      if (std::abs(p[2] - box.top + box.height) < tolerance)
        return Boundary::support;
      if (std::abs(p[1] - box.y_begin) < tolerance)
        return Boundary::end;
      return Boundary::free;
    };
    return body;
  }
} // namespace tread
