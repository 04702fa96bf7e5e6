// SPDX-License-Identifier: LGPL-2.1-or-later
#include "edges.h"

#include <algorithm>
#include <cmath>

namespace tread::reference
{
  double Edges::area(const Grid &grid) const
  {
    double sum = 0.;
    for (std::size_t j = 0; j < lead.size(); ++j)
      sum += std::max(0., lead[j] - trail[j]) * grid.dy;
    return sum;
  }

  Edges ellipse_edges(const Grid &grid, const double semi_axis_x, const double semi_axis_y)
  {
    // integral of sqrt(1 - t^2) from 0
    const auto integral = [](const double y) {
      const double t = std::clamp(y, -1., 1.);
      return 0.5 * (t * std::sqrt(1. - t * t) + std::asin(t));
    };
    Edges edges;
    edges.semi_axis_x = semi_axis_x;
    edges.semi_axis_y = semi_axis_y;
    for (unsigned int j = 0; j < grid.n_y; ++j)
      {
        const double low = (grid.y(j) - 0.5 * grid.dy) / semi_axis_y, width = grid.dy / semi_axis_y;
        const double mean = semi_axis_x * (integral(low + width) - integral(low)) / width;
        edges.lead.push_back(mean > 0. ? mean : -1.);
        edges.trail.push_back(mean > 0. ? -mean : 0.);
      }
    return edges;
  }

  Edges pressure_edges(const Grid &grid, const std::vector<double> &pressure)
  {
    // Amount, in elements along the edge, by which the area of Hertz's ellipse would be too large without it
    // (0.05 to 0.1).
    constexpr double          excess = 0.07;
    std::vector<unsigned int> in_column(grid.n_x, 0);
    Edges                     edges;
    for (unsigned int j = 0; j < grid.n_y; ++j)
      {
        const double *row   = pressure.data() + std::size_t(j) * grid.n_x;
        int           first = 0, last = static_cast<int>(grid.n_x) - 1;
        while (first <= last && !(row[first] > 0.))
          ++first;
        while (last > first && !(row[last] > 0.))
          --last;
        if (first > last)
          {
            edges.lead.push_back(-1.);
            edges.trail.push_back(0.);
            continue;
          }
        // outer edge of an element, moved towards the zero of the square within one element of it
        const auto edge = [&](const int outermost, const int inwards) {
          const double here = grid.x(outermost) - 0.5 * inwards * grid.dx;
          if (last - first < 5)
            return here;
          const int    near = outermost + inwards, far = outermost + 3 * inwards;
          const double near_square = row[near] * row[near], far_square = row[far] * row[far];
          if (!(far_square > near_square))
            return here;
          const double beyond = 2. * near_square / (far_square - near_square) - excess;
          return grid.x(near) - inwards * grid.dx * std::clamp(beyond, 0.5, 2.5);
        };
        edges.trail.push_back(edge(first, 1));
        edges.lead.push_back(edge(last, -1));
        edges.semi_axis_x = std::max(edges.semi_axis_x, 0.5 * (edges.lead[j] - edges.trail[j]));
        for (int i = first; i <= last; ++i)
          in_column[i] += row[i] > 0. ? 1 : 0;
      }
    edges.semi_axis_y = 0.5 * grid.dy * *std::max_element(in_column.begin(), in_column.end());
    return edges;
  }

  LeadingEdge leading_edge(const Grid                &grid,
                           const std::vector<double> &pressure,
                           const std::vector<double> &lead)
  {
    constexpr double slope = 1.93;  // of kappa at m = 0, from Carter's problem
    constexpr double share = 0.306; // of the last element in the force of the last two at m = 0
    LeadingEdge      result{pressure, std::vector<double>(pressure.size(), 0.)};
    for (unsigned int j = 0; j < grid.n_y; ++j)
      {
        double      *row  = result.bound.data() + std::size_t(j) * grid.n_x;
        const double left = grid.x_first - 0.5 * grid.dx;
        int          i    = static_cast<int>(std::floor((lead[j] - left) / grid.dx + 1. / 6.));
        if (i < 2 || i >= static_cast<int>(grid.n_x))
          continue;
        double m = (lead[j] - left) / grid.dx - i - 5. / 6.;
        if (m < -0.97) // as good as nothing
          {
            --i;
            m = 0.;
          }
        // rows of fewer than three elements, at the sides of the patch, stay as they are
        if (i < 2 || !(row[i - 1] > 0.) || !(row[i - 2] > 0.))
          continue;
        double sum = row[i - 1];
        for (unsigned int k = i; k < grid.n_x; ++k)
          {
            sum += row[k];
            row[k] = 0.;
          }
        row[i]                                           = sum * share * (1. + m);
        row[i - 1]                                       = sum - row[i];
        result.compliance[std::size_t(j) * grid.n_x + i] = -slope * m / (1. + m);
      }
    return result;
  }
} // namespace tread::reference
