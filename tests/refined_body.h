// SPDX-License-Identifier: LGPL-2.1-or-later
// A body refined by its own rule, and the shapes of its cells.
#ifndef tread_tests_refined_body_h
#define tread_tests_refined_body_h

#include <tread/mesh/body.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <vector>

namespace tread::tests
{
  using dealii::Point;
  using dealii::Tensor;
  using Mesh = dealii::Triangulation<3>;

  inline double largest_edge(const Mesh::cell_iterator &cell)
  {
    double length = 0.;
    for (const unsigned int line : cell->line_indices())
      length = std::max(length, cell->line(line)->vertex(0).distance(cell->line(line)->vertex(1)));
    return length;
  }

  inline double shortest_edge(const Mesh::cell_iterator &cell)
  {
    double length = 1e300;
    for (const unsigned int line : cell->line_indices())
      length = std::min(length, cell->line(line)->vertex(0).distance(cell->line(line)->vertex(1)));
    return length;
  }

  /// Refines the body by its rule. Boundary ids come from the coarse faces.
  inline void refine(const Body &body, Mesh &mesh)
  {
    mesh.create_triangulation(body.vertices, body.cells, dealii::SubCellData());
    for (const auto &cell : mesh.active_cell_iterators())
      for (const unsigned int face : cell->face_indices())
        if (cell->at_boundary(face))
          cell->face(face)->set_all_boundary_ids(
            static_cast<unsigned int>(body.boundary_at(cell->face(face)->center())));
    if (body.manifold)
      {
        mesh.set_all_manifold_ids(0);
        mesh.set_manifold(0, *body.manifold);
      }

    bool changed = true;
    while (changed)
      {
        changed = false;
        for (const auto &cell : mesh.active_cell_iterators())
          {
            double wanted = body.wanted_cell_size(cell->center());
            for (const unsigned int v : cell->vertex_indices())
              wanted = std::min(wanted, body.wanted_cell_size(cell->vertex(v)));
            if (largest_edge(cell) > 1.2 * wanted)
              {
                cell->set_refine_flag();
                changed = true;
              }
          }
        if (changed)
          mesh.execute_coarsening_and_refinement();
      }
  }

  struct Measured
  {
    unsigned int          n_cells = 0, n_fine = 0;
    double                volume = 0.;
    Tensor<1, 3>          moment;               ///< integral of the position
    double                min_jacobian = 1e300; ///< at vertices and Gauss points, over the cell's volume
    double                min_scaled   = 1e300; ///< sine-like: by the three edge lengths at the vertex
    double                fine_scaled  = 1e300; ///< the same in the fine zone
    double                edge_low = 1e300, edge_high = 0.; ///< in the fine zone, over the finest size
    double                shortest_edge = 1e300;
    std::map<int, double> areas; ///< by boundary id
  };

  /// Moves the vertices to space and measures. in_zone is asked for chart positions of cell centres.
  inline Measured measure(const Body                                  &body,
                          Mesh                                        &mesh,
                          const double                                 finest,
                          const std::function<bool(const Point<3> &)> &in_zone)
  {
    std::vector<bool> fine(mesh.n_active_cells());
    for (const auto &cell : mesh.active_cell_iterators())
      fine[cell->active_cell_index()] = in_zone(cell->center());

    if (body.to_space)
      {
        std::vector<bool> moved(mesh.n_vertices(), false);
        for (const auto &cell : mesh.active_cell_iterators())
          for (const unsigned int v : cell->vertex_indices())
            if (!moved[cell->vertex_index(v)])
              {
                moved[cell->vertex_index(v)] = true;
                cell->vertex(v)              = body.to_space(cell->vertex(v));
              }
      }

    Measured                m;
    const dealii::QGauss<3> quadrature(2); // exact for the trilinear map's determinant
    for (const auto &cell : mesh.active_cell_iterators())
      {
        const auto columns = [&](const Point<3> &q) {
          std::array<Tensor<1, 3>, 3> t;
          for (const unsigned int v : cell->vertex_indices())
            for (unsigned int d = 0; d < 3; ++d)
              {
                double gradient = 1.;
                for (unsigned int e = 0; e < 3; ++e)
                  {
                    const bool upper = (v >> e) & 1u;
                    gradient *= e == d ? (upper ? 1. : -1.) : (upper ? q[e] : 1. - q[e]);
                  }
                t[d] += gradient * cell->vertex(v);
              }
          return t;
        };
        const auto determinant = [](const std::array<Tensor<1, 3>, 3> &t) {
          return t[0] * dealii::cross_product_3d(t[1], t[2]);
        };

        double       volume = 0., lowest = 1e300, scaled = 1e300;
        Tensor<1, 3> moment;
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const Point<3> point = quadrature.point(q);
            const double   j     = determinant(columns(point));
            volume += j * quadrature.weight(q);
            lowest = std::min(lowest, j);
            for (const unsigned int v : cell->vertex_indices())
              {
                double shape = 1.;
                for (unsigned int e = 0; e < 3; ++e)
                  shape *= ((v >> e) & 1u) ? point[e] : 1. - point[e];
                moment += shape * j * quadrature.weight(q) * cell->vertex(v);
              }
          }
        for (const unsigned int v : cell->vertex_indices())
          {
            const auto   t = columns(Point<3>(v & 1u, (v >> 1) & 1u, (v >> 2) & 1u));
            const double j = determinant(t);
            lowest         = std::min(lowest, j);
            scaled         = std::min(scaled, j / (t[0].norm() * t[1].norm() * t[2].norm()));
          }
        ++m.n_cells;
        m.volume += volume;
        m.moment += moment;
        m.min_jacobian  = std::min(m.min_jacobian, lowest / std::abs(volume));
        m.min_scaled    = std::min(m.min_scaled, scaled);
        m.shortest_edge = std::min(m.shortest_edge, shortest_edge(cell));
        if (fine[cell->active_cell_index()])
          {
            ++m.n_fine;
            m.edge_low    = std::min(m.edge_low, shortest_edge(cell) / finest);
            m.edge_high   = std::max(m.edge_high, largest_edge(cell) / finest);
            m.fine_scaled = std::min(m.fine_scaled, scaled);
          }
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f))
            {
              const auto face = cell->face(f);
              const auto n    = dealii::cross_product_3d(face->vertex(3) - face->vertex(0),
                                                         face->vertex(2) - face->vertex(1));
              m.areas[face->boundary_id()] += 0.5 * n.norm();
            }
      }
    return m;
  }

  /// Largest distance from the true surface of the vertices on faces with the given id (m).
  inline double off_surface(const Mesh                                    &mesh,
                            const Boundary                                 id,
                            const std::function<double(const Point<3> &)> &distance)
  {
    double largest = 0.;
    for (const auto &cell : mesh.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f) && cell->face(f)->boundary_id() == static_cast<unsigned int>(id))
          for (const unsigned int v : cell->face(f)->vertex_indices())
            largest = std::max(largest, std::abs(distance(cell->face(f)->vertex(v))));
    return largest;
  }
} // namespace tread::tests

#endif
