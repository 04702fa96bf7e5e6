// SPDX-License-Identifier: LGPL-2.1-or-later
// Where the cells of a mesh file do not meet face to face: nodes that lie on or within cells to which they do
// not belong.
#ifndef tread_mesh_mesh_file_tears_h
#define tread_mesh_mesh_file_tears_h

#include <deal.II/base/point.h>
#include <deal.II/grid/tria_description.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace tread::mesh_tears
{
  /// A node that lies on, within or close beside a cell that is not its own.
  struct StrayNode
  {
    unsigned int vertex, cell;
    double       beyond; ///< share of the cell by which it lies outside; negative: within
    double       gap;    ///< the same in m
  };

  /// Where a point lies in the coordinates of a cell, which are 0 to 1 within. None far outside, or where the
  /// cell is degenerate.
  inline std::optional<dealii::Point<3>> unit_place(const std::array<dealii::Point<3>, 8> &corners,
                                                    const dealii::Point<3>                &p)
  {
    constexpr unsigned int most_steps = 20;
    constexpr double       converged = 1e-9, far = 3.; // of the cell
    dealii::Point<3>       unit(0.5, 0.5, 0.5);
    for (unsigned int step = 0; step < most_steps; ++step)
      {
        dealii::Tensor<1, 3> off = -p;
        dealii::Tensor<1, 3> along[3];
        for (unsigned int v = 0; v < 8; ++v)
          {
            double share[3], slope[3];
            for (unsigned int d = 0; d < 3; ++d)
              {
                share[d] = v >> d & 1u ? unit[d] : 1. - unit[d];
                slope[d] = v >> d & 1u ? 1. : -1.;
              }
            off += share[0] * share[1] * share[2] * corners[v];
            along[0] += slope[0] * share[1] * share[2] * corners[v];
            along[1] += share[0] * slope[1] * share[2] * corners[v];
            along[2] += share[0] * share[1] * slope[2] * corners[v];
          }
        const double determinant = dealii::cross_product_3d(along[0], along[1]) * along[2];
        if (!(determinant > 0.))
          return {};
        const dealii::Tensor<1, 3> change({dealii::cross_product_3d(along[1], along[2]) * off / determinant,
                                           dealii::cross_product_3d(along[2], along[0]) * off / determinant,
                                           dealii::cross_product_3d(along[0], along[1]) * off / determinant});
        unit -= change;
        if (!(unit.norm() < far))
          return {};
        if (change.norm() < converged)
          return unit;
      }
    return {};
  }

  /// Nodes in boxes that are about as large as cells.
  class NodesInBoxes
  {
  public:
    NodesInBoxes(const std::vector<dealii::Point<3>> &vertices, const double size)
      : vertices(vertices)
      , low(vertices.front())
      , high(vertices.front())
    {
      for (const dealii::Point<3> &p : vertices)
        for (unsigned int d = 0; d < 3; ++d)
          {
            low[d]  = std::min(low[d], p[d]);
            high[d] = std::max(high[d], p[d]);
          }
      constexpr double most = 1024.;
      for (unsigned int d = 0; d < 3; ++d)
        n[d] = std::clamp((high[d] - low[d]) / size, 1., most);
      while (n[0] * n[1] * n[2] > 64 + 4 * vertices.size())
        {
          std::size_t &largest = *std::max_element(n.begin(), n.end());
          largest              = (largest + 1) / 2;
        }
      begin_of.assign(n[0] * n[1] * n[2] + 1, 0);
      for (const dealii::Point<3> &p : vertices)
        ++begin_of[box(p) + 1];
      for (std::size_t i = 1; i < begin_of.size(); ++i)
        begin_of[i] += begin_of[i - 1];
      std::vector<unsigned int> next(begin_of.begin(), begin_of.end() - 1);
      members.resize(vertices.size());
      for (unsigned int v = 0; v < vertices.size(); ++v)
        members[next[box(vertices[v])]++] = v;
    }

    /// Call a function with each node between two corners.
    template <typename Function>
    void for_each(const dealii::Point<3> &from, const dealii::Point<3> &to, const Function &function) const
    {
      for (std::size_t k = place(from, 2); k <= place(to, 2); ++k)
        for (std::size_t j = place(from, 1); j <= place(to, 1); ++j)
          for (std::size_t i = place(from, 0); i <= place(to, 0); ++i)
            {
              const std::size_t b = i + n[0] * (j + n[1] * k);
              for (unsigned int m = begin_of[b]; m < begin_of[b + 1]; ++m)
                {
                  const dealii::Point<3> &p = vertices[members[m]];
                  if (p[0] >= from[0] && p[0] <= to[0] && p[1] >= from[1] && p[1] <= to[1] &&
                      p[2] >= from[2] && p[2] <= to[2])
                    function(members[m]);
                }
            }
    }

  private:
    std::size_t place(const dealii::Point<3> &p, const unsigned int d) const
    {
      const double extent = high[d] - low[d];
      return extent > 0.
               ? static_cast<std::size_t>(std::clamp((p[d] - low[d]) / extent * n[d], 0., n[d] - 0.5))
               : 0;
    }
    std::size_t box(const dealii::Point<3> &p) const
    {
      return place(p, 0) + n[0] * (place(p, 1) + n[1] * place(p, 2));
    }

    const std::vector<dealii::Point<3>> &vertices;
    dealii::Point<3>                     low, high;
    std::array<std::size_t, 3>           n{};
    std::vector<unsigned int>            begin_of; // of each box among the members
    std::vector<unsigned int>            members;
  };

  /// Nodes that lie up to so far outside of cells that are not their own, as a share of the cell, and those
  /// within. Where cells meet face to face there are none. Nodes of a cell that shares a face are not taken:
  /// it may be thin.
  /// @param neighbours cells that share a face with each
  /// @param torn the first node that lies less far outside than this is enough: it alone is returned
  inline std::vector<StrayNode> stray_nodes(const std::vector<dealii::Point<3>>            &vertices,
                                            const std::vector<dealii::CellData<3>>         &cells,
                                            const std::vector<std::array<unsigned int, 6>> &neighbours,
                                            const unsigned int                              no_neighbour,
                                            const double                                    torn,
                                            const double                                    furthest)
  {
    double sum = 0.;
    for (const auto &cell : cells)
      sum += vertices[cell.vertices[0]].distance(vertices[cell.vertices[7]]);
    const NodesInBoxes     nodes(vertices, sum / cells.size());
    std::vector<StrayNode> found;
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const auto                     &own = cells[c].vertices;
        std::array<dealii::Point<3>, 8> corners;
        dealii::Point<3>                from = vertices[own[0]], to = from;
        for (unsigned int v = 0; v < 8; ++v)
          {
            corners[v] = vertices[own[v]];
            for (unsigned int d = 0; d < 3; ++d)
              {
                from[d] = std::min(from[d], corners[v][d]);
                to[d]   = std::max(to[d], corners[v][d]);
              }
          }
        const dealii::Tensor<1, 3> around = furthest * from.distance(to) * dealii::Tensor<1, 3>({1., 1., 1.});
        std::optional<StrayNode>   worst;
        nodes.for_each(from - around, to + around, [&](const unsigned int vertex) {
          if (std::find(own.begin(), own.end(), vertex) != own.end())
            return;
          const auto unit = unit_place(corners, vertices[vertex]);
          if (!unit)
            return;
          unsigned int direction = 0;
          double       beyond    = -1.;
          for (unsigned int d = 0; d < 3; ++d)
            if (const double now = std::max(-(*unit)[d], (*unit)[d] - 1.); now > beyond)
              {
                beyond    = now;
                direction = d;
              }
          if (beyond > furthest)
            return;
          for (const unsigned int other : neighbours[c])
            if (other != no_neighbour && beyond > 0.)
              if (const auto &theirs = cells[other].vertices;
                  std::find(theirs.begin(), theirs.end(), vertex) != theirs.end())
                return; // of a neighbour that is thin
          const StrayNode stray{vertex, c, beyond,
                                std::max(beyond, 0.) * corners[0].distance(corners[1u << direction])};
          if (beyond > torn)
            found.push_back(stray);
          else if (!worst || beyond < worst->beyond)
            worst = stray;
        });
        if (worst)
          return {*worst};
      }
    return found;
  }
} // namespace tread::mesh_tears

#endif
