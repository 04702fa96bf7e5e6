// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_mesh_mesh_h
#define tread_mesh_mesh_h

#include <tread/base/shared_nodes.h>
#include <tread/mesh/body.h>
#include <tread/mesh/cell_address.h>

#include <mpi.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace tread
{
  /// Level of time steps of a cell that may take steps so many times as long as the smallest cell: the
  /// largest whole l up to max_level with 2^l not above that, but for a tenth. Cells of an octree's levels
  /// differ a little in shape, and those that are 1.95 times as slow would be evaluated twice as often for
  /// that. The steps are found for the levels as they are, so that the tenth costs no stability: at worst all
  /// steps are a tenth smaller. A twentieth would leave more cells a level too low, a fifth could cost a
  /// fifth of the steps' length.
  inline unsigned int level_of_steps(const double times_as_slow, const unsigned int max_level)
  {
    constexpr double passes = 1.1;
    unsigned int     level  = 0;
    while (level < max_level && std::ldexp(1., level + 1) <= passes * times_as_slow)
      ++level;
    return level;
  }


  /// The hexahedra of all bodies on this rank, and what holds them together: plain arrays for
  /// the explicit kernels, made from deal.II's distributed octree.
  ///
  /// Nodes are numbered by the level of time steps that they will likely have, hanging nodes last, and in the
  /// order in which the cells meet them, cells along the octree's space-filling curve: neighbours are near in
  /// memory, and what a step moves lies together.
  struct Mesh
  {
    static constexpr unsigned int nodes_per_cell = 8;

    struct Cell
    {
      std::array<unsigned int, 8> nodes; ///< deal.II's (lexicographic) order
      unsigned int                body;
      unsigned int material; ///< the number of its body, or behind all bodies' one of the others
      CellAddress  address;

      bool has_own_material() const ///< of its body
      {
        return material == body;
      }
    };

    /// A quadrilateral of the boundary, nodes around it counter-clockwise seen from outside.
    struct Face
    {
      std::array<unsigned int, 4> nodes;
      unsigned int                cell, body;
      Boundary                    boundary;
    };

    /// A node at the mean of its parents: the four nodes of a larger face around it, or the two nodes of a
    /// larger edge, each of which is listed twice.
    struct HangingNode
    {
      static constexpr double     weight = 0.25; ///< of each parent
      unsigned int                node;
      std::array<unsigned int, 4> parents;
    };

    MPI_Comm                      comm;
    std::vector<std::string>      body_names;
    std::vector<dealii::Point<3>> nodes;       ///< reference positions, m
    std::vector<unsigned int>     node_bodies; ///< body of each node
    std::vector<Cell>             cells;
    std::vector<Face>             faces;
    std::vector<HangingNode>      hanging_nodes;
    SharedNodes                   shared_nodes;
    std::uint64_t                 n_global_cells, n_global_nodes, n_global_hanging_nodes;

    /// An identifier of a node that does not depend on the ranks: body and reference position in nm.
    std::array<long long, 4> node_key(const unsigned int node) const;

    /// Reference positions of a cell's nodes, m.
    std::array<dealii::Point<3>, 8> corners(const unsigned int cell) const
    {
      std::array<dealii::Point<3>, 8> points;
      for (unsigned int a = 0; a < 8; ++a)
        points[a] = nodes[cells[cell].nodes[a]];
      return points;
    }

    /// The nodes of a part of a body's boundary on this rank. Collective among neighbours.
    std::vector<unsigned int> boundary_nodes(const unsigned int body, const Boundary boundary) const;

    /// Memory of this rank's cells and nodes, bytes.
    std::size_t memory_consumption() const
    {
      return cells.size() * sizeof(Cell) + nodes.size() * (sizeof(nodes[0]) + sizeof(node_bodies[0]) + 1) +
             hanging_nodes.size() * sizeof(HangingNode);
    }

    /// Approximate total time that a cell of a body with these corners (reference positions, m) will take,
    /// over that of one step of a parallelepiped (@see Element::relative_cost).
    /// @param level of time steps that follows from its size.
    using CellCost = std::function<double(unsigned int                                        body,
                                          const std::array<dealii::Point<3>, nodes_per_cell> &corners,
                                          unsigned int                                        level)>;

    /// Refine each body by its own rule and distribute the cells over the ranks of comm.
    /// @param max_level of time steps with which the cells will be run.
    /// @param cost quantity to be divided equally among the ranks if this pays; none: number of cells.
    /// @param is_small each rank may hold the whole mesh while it is made, which takes less time than parts.
    /// @throws std::runtime_error if a body has a cell that is turned inside out.
    Mesh(const MPI_Comm           comm,
         const std::vector<Body> &bodies,
         const unsigned int       max_level = 0,
         const CellCost          &cost      = {},
         const bool               is_small  = false);

    /// Parents receive the forces (or masses) of their hanging nodes.
    void condense_hanging_nodes(Vector3 *field) const
    {
      condense(hanging_nodes, field);
    }

    static void condense(const std::vector<HangingNode> &nodes, Vector3 *field)
    {
      for (const HangingNode &h : nodes)
        {
          const Vector3 share = HangingNode::weight * field[h.node];
          for (const unsigned int parent : h.parents)
            field[parent] += share;
          field[h.node] = Vector3{};
        }
    }

    /// Hanging nodes follow their parents.
    void distribute_hanging_nodes(Vector3 *field) const
    {
      distribute(hanging_nodes, field);
    }

    static void distribute(const std::vector<HangingNode> &nodes, Vector3 *field)
    {
      for (const HangingNode &h : nodes)
        field[h.node] = HangingNode::weight * ((field[h.parents[0]] + field[h.parents[1]]) +
                                               (field[h.parents[2]] + field[h.parents[3]]));
    }

  private:
    void renumber(const std::vector<unsigned int> &level_of_node, std::vector<std::uint64_t> &global_ids);
  };
} // namespace tread

#endif
