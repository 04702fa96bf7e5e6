// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_contact_surfaces_h
#define tread_contact_contact_surfaces_h

#include <tread/mesh/mesh.h>

#include <array>
#include <vector>

namespace tread
{
  /// The contact faces of all bodies, the same on every rank and numbered by position, so that
  /// what is computed from them does not depend on how the cells are distributed.
  ///
  /// Cells may change their size along the path. Faces with a node that hangs on an edge along it, or on one
  /// of which only a part can touch, are left out: they rim the fine zone, and contact that reaches them is
  /// an error of the scene.
  class ContactSurfaces
  {
  public:
    struct Node
    {
      unsigned int body;
      bool         at_rim;    ///< at the lateral border of the faces, or of a face that was left out
      int          owner;     ///< rank
      int          local;     ///< node number on this rank, -1 if it has no copy
      Vector3      reference; ///< position, m
    };

    struct Face
    {
      std::array<unsigned int, 4> nodes; ///< counter-clockwise seen from outside
      unsigned int                body;
      unsigned int
        edge_along; ///< 0 or 1: the edges from corner 0 or 1, and those opposite, are along the path
    };

    explicit ContactSurfaces(const Mesh &mesh);

    /// A node in the middle of its parents, two of a larger face, which it follows.
    struct HangingNode
    {
      unsigned int                node;
      std::array<unsigned int, 2> parents;
    };

    MPI_Comm                 comm;
    std::vector<Node>        nodes;
    std::vector<Face>        faces;
    std::vector<HangingNode> hanging_nodes;

    /// Copy the rows of the surface nodes from their owners to every rank. Collective.
    /// @param field nodal field of this rank; @param rows one a surface node.
    void replicate(const Vector3 *field, std::vector<Vector3> &rows) const;

  private:
    std::vector<std::vector<unsigned int>> nodes_of_rank;
  };
} // namespace tread

#endif
