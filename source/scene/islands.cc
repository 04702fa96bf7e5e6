// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/islands.h>

#include <algorithm>
#include <limits>

namespace tread
{
  std::vector<Island> islands_of(const reference::Grid &grid, const std::vector<double> &pressure)
  {
    std::vector<Island> islands;
    std::vector<bool>   seen(pressure.size(), false);
    for (std::size_t first = 0; first < pressure.size(); ++first)
      {
        if (seen[first] || !(pressure[first] > 0.))
          continue;
        constexpr double         far = std::numeric_limits<double>::max();
        Island                   island{far, -far, far, -far, 0.};
        std::vector<std::size_t> open{first};
        seen[first] = true;
        while (!open.empty())
          {
            const std::size_t e = open.back();
            open.pop_back();
            const int i = e % grid.n_x, j = e / grid.n_x;
            island.x_begin = std::min(island.x_begin, grid.x(i) - 0.5 * grid.dx);
            island.x_end   = std::max(island.x_end, grid.x(i) + 0.5 * grid.dx);
            island.y_begin = std::min(island.y_begin, grid.y(j) - 0.5 * grid.dy);
            island.y_end   = std::max(island.y_end, grid.y(j) + 0.5 * grid.dy);
            island.force += pressure[e] * grid.element_area();
            for (int dj = -1; dj <= 1; ++dj)
              for (int di = -1; di <= 1; ++di)
                {
                  const int         ni = i + di, nj = j + dj;
                  const std::size_t n = std::size_t(nj) * grid.n_x + ni;
                  if (ni < 0 || nj < 0 || ni >= int(grid.n_x) || nj >= int(grid.n_y) || seen[n] ||
                      !(pressure[n] > 0.))
                    continue;
                  seen[n] = true;
                  open.push_back(n);
                }
          }
        islands.push_back(island);
      }
    return islands;
  }
} // namespace tread
