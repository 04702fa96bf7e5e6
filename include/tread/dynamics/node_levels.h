// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_dynamics_node_levels_h
#define tread_dynamics_node_levels_h

#include <tread/base/archive.h>
#include <tread/mesh/mesh.h>
#include <tread/solid/solid.h>

#include <cmath>
#include <vector>

namespace tread
{
  /// Forces of the cells of a level on nodes that move in smaller steps. If these forces acted only as
  /// occasional impulses, they would excite the nodes of a prestressed body. The steady part of the force
  /// therefore acts in each step of a node, and only the difference from the present force acts as an
  /// impulse.
  struct SlowShares
  {
    std::vector<unsigned int> nodes;        ///< by their own levels
    std::vector<std::size_t>  end_of_level; ///< in nodes
    NodalField                steady;       ///< N
    /// Of shares that do not depend on the ranks: nodes with copies elsewhere, places in nodes. One rank has
    /// the whole share of each, the others none.
    std::vector<std::size_t> with_copies;

    /// Call work(k, 2^own level) for nodes[k] up to an own level.
    template <typename Work>
    void for_nodes_up_to(const unsigned int level, const Work &work) const
    {
      std::size_t k = 0;
      for (unsigned int own = 0; own < end_of_level.size() && own <= level; ++own)
        for (const double factor = std::ldexp(1., own); k < end_of_level[own]; ++k)
          work(k, factor);
    }
  };

  /// In which time steps the nodes of this rank move: a node of level l in every 2^l-th, with its fastest
  /// cell.
  class NodeLevels
  {
  public:
    /// Nodes [begin, end) of one level, all of them of bodies with the same carrier or none, and this rank's
    /// own.
    struct Run
    {
      unsigned int begin, end;
      int          carrier; ///< its number, -1: none
      bool         is_owned;
    };

    /// Hanging nodes by the levels of cells around them on this rank.
    struct HangingNodes
    {
      std::vector<Mesh::HangingNode> loaded; ///< by cells of this level
      std::vector<Mesh::HangingNode> placed; ///< needed at this level, and at no lower one
    };

    NodeLevels() = default;

    /// @param smallest_steps nodes of level 0, besides those of contact surfaces.
    /// @param carrier_of_body number of the part that carries a body, -1: none.
    /// With a solid whose forces do not depend on the ranks steady shares do not either. Collective.
    NodeLevels(const Mesh                      &mesh,
               const Solid                     &solid,
               const std::vector<unsigned int> &smallest_steps,
               const std::vector<int>          &carrier_of_body);

    unsigned int max_level() const
    {
      return runs.size() - 1;
    }

    /// Store or restore the steady shares of slow cells' forces. On other ranks the owner of a node gets the
    /// sum. Collective.
    void serialize(Archive &archive, const Mesh &mesh);

    std::vector<unsigned int>      of_node;
    std::vector<std::vector<Run>>  runs;    ///< by level; hanging nodes, which are placed, are in none
    std::vector<HangingNodes>      hanging; ///< by level
    std::vector<Mesh::HangingNode> hanging_at_contact;
    std::vector<SlowShares>        slow_shares; ///< by level
    bool                           slow_shares_known = false;
    bool                           reproducible      = false; ///< slow shares do not depend on the ranks

    /// Memory of this rank's nodes in this object, bytes.
    std::size_t memory_consumption() const;

  private:
    /// By node of the mesh; null: it does not hang.
    using Hangs = std::vector<const Mesh::HangingNode *>;

    void set_levels(const Mesh &mesh, const Solid &solid, const std::vector<unsigned int> &smallest_steps);
    void set_hanging_nodes(const Mesh &mesh, const Solid &solid, const Hangs &hangs);
    void set_slow_shares(const Mesh &mesh, const Solid &solid, const Hangs &hangs);
    void set_runs(const Mesh &mesh, const std::vector<int> &carrier_of_body, const Hangs &hangs);
  };
} // namespace tread

#endif
