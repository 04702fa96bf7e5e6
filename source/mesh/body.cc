// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/mesh/body.h>

#include <stdexcept>

namespace tread
{
  namespace
  {
    /// Between the charts of both pieces, across the path, m. It rounds coordinates to 1e-14 m.
    constexpr double apart = 64.;

    bool is_of_second(const dealii::Point<3> &p)
    {
      return p[1] > 0.5 * apart;
    }

    dealii::Point<3> in_second(const dealii::Point<3> &p)
    {
      return {p[0], p[1] - apart, p[2]};
    }

    /// A function of the chart that is that of the piece in which a point lies. @param otherwise where a
    /// piece has none
    template <typename Value>
    std::function<Value(const dealii::Point<3> &)> of_either(
      const std::function<Value(const dealii::Point<3> &)> &first,
      const std::function<Value(const dealii::Point<3> &)> &second,
      const std::function<Value(const dealii::Point<3> &)> &otherwise)
    {
      return [=](const dealii::Point<3> &p) {
        const bool  of_second = is_of_second(p);
        const auto &own       = of_second ? second : first;
        return (own ? own : otherwise)(of_second ? in_second(p) : p);
      };
    }
  } // namespace


  Body join(const Body &first, const Body &second)
  {
    if (first.manifold || second.manifold)
      throw std::invalid_argument("pieces with curved charts cannot be joined");
    Body               body     = first;
    const unsigned int n_before = first.vertices.size();
    for (const dealii::Point<3> &vertex : second.vertices)
      body.vertices.emplace_back(vertex[0], vertex[1] + apart, vertex[2]);
    for (dealii::CellData<3> cell : second.cells)
      {
        for (unsigned int &vertex : cell.vertices)
          vertex += n_before;
        body.cells.push_back(cell);
      }
    using Point   = dealii::Point<3>;
    body.to_space = of_either<Point>(first.to_space, second.to_space, [](const Point &p) { return p; });
    body.wanted_cell_size =
      of_either<double>(first.wanted_cell_size, second.wanted_cell_size, first.wanted_cell_size);
    body.path_stretch =
      of_either<double>(first.path_stretch, second.path_stretch, [](const Point &) { return 1.; });
    body.boundary_at = of_either<Boundary>(first.boundary_at, second.boundary_at, first.boundary_at);
    body.in_reach    = of_either<bool>(first.in_reach, second.in_reach, [](const Point &) { return true; });
    return body;
  }
} // namespace tread
