// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/solid/surface_layer.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace tread
{
  namespace
  {
    using Vector = dealii::Tensor<1, 3>;

    /// Largest cosine between two edges, and largest share by which opposite edges may differ, of
    /// a cell that counts as a box. The theory is one of boxes; a cell that is sheared by so much is met
    /// where profiles bend sharply.
    constexpr double most_sheared = 0.2, most_tapered = 0.3;

    /// The cell's own direction (0, 1, 2) along which it has this face; none if the face's nodes do not lie
    /// on one side of the cell.
    std::optional<unsigned int> direction_of(const Mesh::Cell &cell, const Mesh::Face &face)
    {
      for (unsigned int d = 0; d < 3; ++d)
        for (const unsigned int side : {0u, 1u})
          {
            bool all = true;
            for (unsigned int a = 0; a < 8; ++a)
              if (((a >> d) & 1) == side)
                all =
                  all && std::find(face.nodes.begin(), face.nodes.end(), cell.nodes[a]) != face.nodes.end();
            if (all)
              return d;
          }
      return {};
    }

    /// Mean edge along a direction of the cell; none where its four edges differ too much.
    std::optional<Vector> mean_edge(const std::array<dealii::Point<3>, 8> &corners, const unsigned int d)
    {
      Vector mean;
      for (unsigned int a = 0; a < 8; ++a)
        mean += (linear_pattern(d, a) / 4.) * corners[a];
      for (unsigned int a = 0; a < 8; ++a)
        if (((a >> d) & 1) == 0)
          {
            const Vector edge = corners[a + (1u << d)] - corners[a];
            if ((edge - mean).norm() > most_tapered * mean.norm())
              return {};
          }
      return mean;
    }

    /// Two directions that are orthogonal to each other and to the normal and as near to the edges as to
    /// their mirror images.
    std::array<Vector, 2> orthogonal(const Vector &first, const Vector &second)
    {
      const Vector a = first / first.norm(), b = second / second.norm();
      const Vector sum = (a + b) / (a + b).norm(), difference = (a - b) / (a - b).norm();
      return {{(sum + difference) / std::sqrt(2.), (sum - difference) / std::sqrt(2.)}};
    }
  } // namespace


  SurfaceLayer::SurfaceLayer(const Mesh                         &mesh,
                             const std::vector<ElasticMaterial> &materials,
                             const double                        hourglass_coefficient)
  {
    constexpr std::int32_t none = -1, several = -2;
    number.assign(mesh.cells.size(), none);
    std::vector<SurfaceWeights> weights;
    for (const ElasticMaterial &material : materials)
      weights.emplace_back(material.poisson_ratio, hourglass_coefficient);

    std::map<unsigned int, unsigned int> normal_of_cell;
    for (const Mesh::Face &face : mesh.faces)
      if (face.boundary == Boundary::contact)
        {
          const std::optional<unsigned int> direction = direction_of(mesh.cells[face.cell], face);
          const bool                        is_first  = normal_of_cell.count(face.cell) == 0;
          if (!direction || !is_first)
            number[face.cell] = several; // an edge of the surface
          else
            normal_of_cell[face.cell] = *direction;
        }
    for (const auto &[c, normal] : normal_of_cell)
      {
        if (number[c] == several)
          continue;
        const auto         corners = mesh.corners(c);
        const unsigned int first = (normal + 1) % 3, second = (normal + 2) % 3;
        const auto         edge_0 = mean_edge(corners, first), edge_1 = mean_edge(corners, second),
                   edge_2 = mean_edge(corners, normal);
        if (!edge_0 || !edge_1 || !edge_2)
          continue;
        const Vector up = cross_product_3d(*edge_0, *edge_1) / cross_product_3d(*edge_0, *edge_1).norm();
        if (std::abs(*edge_0 * *edge_1) > most_sheared * edge_0->norm() * edge_1->norm() ||
            std::abs(up * *edge_2) < std::sqrt(1. - most_sheared * most_sheared) * edge_2->norm())
          continue;
        const std::optional<HourglassWeights> of_box =
          weights[mesh.cells[c].material].of_box({{edge_0->norm(), edge_1->norm(), std::abs(up * *edge_2)}});
        if (!of_box)
          continue;
        SurfaceCell cell;
        cell.stiffness = hourglass_stiffness(HexahedronIntegrals(corners), materials[mesh.cells[c].material],
                                             hourglass_coefficient);
        const auto         along  = orthogonal(*edge_0, *edge_1);
        const unsigned int own[3] = {first, second, normal};
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            cell.axes[i][j] = along[i][j];
        for (unsigned int i = 0; i < 3; ++i)
          {
            for (unsigned int m = 0; m < 3; ++m)
              cell.weights[own[m]][i] = (*of_box)[m][i];
            cell.weights[3][i] = (*of_box)[3][i];
          }
        number[c] = cells.size();
        cells.push_back(cell);
      }
    std::replace(number.begin(), number.end(), several, none);
  }


  double SurfaceLayer::stiffening_of(const unsigned int cell, const double damping) const
  {
    double factor = 1.;
    if (const SurfaceCell *surface = find(cell))
      for (const auto &mode : surface->weights)
        for (const double weight : mode)
          factor = std::max(factor, weight + 2. * damping); // dt^2 K + 2 dt C <= 4
    return factor;
  }
} // namespace tread
