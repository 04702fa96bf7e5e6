// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_mesh_body_h
#define tread_mesh_body_h

#include <deal.II/base/point.h>
#include <deal.II/grid/manifold.h>
#include <deal.II/grid/tria_description.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tread
{
  /// What the boundary of a body is used for; the numbers are deal.II boundary ids.
  enum class Boundary : dealii::types::boundary_id
  {
    free    = 0, ///< no traction
    contact = 1, ///< may touch another body
    support = 2, ///< held: by the foundation (rail) or by the rigid hub (wheel)
    end     = 3, ///< cut faces at both ends of a rail or of a wheel sector
    side    = 4  ///< keeps its y: a plane of symmetry along the rail, of meshes from files
  };

  /// A body before refinement: coarse hexahedra, and the rules by which the octree
  /// refines them and puts the nodes onto the true surfaces. Lengths in m.
  struct Body
  {
    std::string                      name;
    std::vector<dealii::Point<3>>    vertices; ///< of the coarse cells, in chart coordinates
    std::vector<dealii::CellData<3>> cells;    ///< vertex numbers from 0, deal.II's (lexicographic) order;
                                            ///< material_id 0: the body's own material, k: the k-th other one

    /// How new vertices are placed while refining; null: straight in chart coordinates.
    std::shared_ptr<const dealii::Manifold<3>> manifold;

    /// From chart coordinates to the reference position, applied to every vertex after
    /// the last refinement; null: the chart is the space itself.
    std::function<dealii::Point<3>(const dealii::Point<3> &)> to_space;

    /// Largest admissible edge length at a point (chart coordinates).
    std::function<double(const dealii::Point<3> &)> wanted_cell_size;

    /// Cells that should not be larger than even_size are refined as if all coarse cells had edges of
    /// even_edge: with unlike edges they would have several levels, and hanging nodes in the midst of a
    /// contact. 0: by their own edges (m).
    double even_size = 0., even_edge = 0.;

    /// Factor by which a cell may be longer along the path than the wanted size, at its centre (chart
    /// coordinates); edges along the path join the vertices 2i and 2i+1 of a cell. Null: 1.
    std::function<double(const dealii::Point<3> &)> path_stretch;

    /// What the boundary is used for at the centre of a coarse boundary face (chart coordinates).
    std::function<Boundary(const dealii::Point<3> &)> boundary_at;

    /// Whether another body can be met at the centre of a face that may touch (chart coordinates). Null:
    /// everywhere.
    std::function<bool(const dealii::Point<3> &)> in_reach;
  };

  /// Two separate pieces as one body. Both have charts in which new vertices are placed straight.
  Body join(const Body &first, const Body &second);
} // namespace tread

#endif
