// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/node_levels.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <tuple>

namespace tread
{
  NodeLevels::NodeLevels(const Mesh                      &mesh,
                         const Solid                     &solid,
                         const std::vector<unsigned int> &smallest_steps,
                         const std::vector<int>          &carrier_of_body)
    : reproducible(solid.reproducible())
  {
    set_levels(mesh, solid, smallest_steps);
    Hangs hangs(mesh.nodes.size(), nullptr);
    for (const Mesh::HangingNode &h : mesh.hanging_nodes)
      hangs[h.node] = &h;
    set_hanging_nodes(mesh, solid, hangs);
    set_slow_shares(mesh, solid, hangs);
    set_runs(mesh, carrier_of_body, hangs);
  }


  void NodeLevels::set_levels(const Mesh                      &mesh,
                              const Solid                     &solid,
                              const std::vector<unsigned int> &smallest_steps)
  {
    unsigned int max_level = 0;
    for (const unsigned int level : solid.cell_levels())
      max_level = std::max(max_level, level);
    max_level = dealii::Utilities::MPI::max(max_level, mesh.comm);
    runs.resize(max_level + 1);
    of_node.assign(mesh.nodes.size(), max_level);
    for (unsigned int level = max_level; level-- > 0;)
      {
        // A node moves with its fastest cell on any rank, a parent with those of its hanging nodes, too.
        NodalField marks(of_node.size(), Vector3{});
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          if (solid.cell_levels()[c] == level)
            for (const unsigned int i : mesh.cells[c].nodes)
              marks[i][0] = 1.;
        if (level == 0)
          {
            for (const Mesh::Face &face : mesh.faces)
              if (face.boundary == Boundary::contact)
                for (const unsigned int i : face.nodes)
                  marks[i][0] = 1.;
            for (const unsigned int i : smallest_steps)
              marks[i][0] = 1.;
          }
        mesh.condense_hanging_nodes(marks.data());
        mesh.shared_nodes.sum(marks.data());
        for (unsigned int i = 0; i < marks.size(); ++i)
          if (marks[i][0] > 0.)
            of_node[i] = level;
      }
  }


  void NodeLevels::set_hanging_nodes(const Mesh &mesh, const Solid &solid, const Hangs &hangs)
  {
    for (unsigned int body = 0; body < mesh.body_names.size(); ++body)
      for (const unsigned int i : mesh.boundary_nodes(body, Boundary::contact))
        if (hangs[i])
          hanging_at_contact.push_back(*hangs[i]);
    hanging.resize(runs.size());
    std::vector<char> is_placed(of_node.size(), false);
    for (unsigned int level = 0; level <= max_level(); ++level)
      {
        std::vector<char> is_loaded(of_node.size(), false);
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          if (solid.cell_levels()[c] == level)
            for (const unsigned int i : mesh.cells[c].nodes)
              if (hangs[i] && !is_loaded[i])
                {
                  hanging[level].loaded.push_back(*hangs[i]);
                  is_loaded[i] = true;
                  if (!is_placed[i])
                    hanging[level].placed.push_back(*hangs[i]);
                  is_placed[i] = true;
                }
      }
  }


  void NodeLevels::set_slow_shares(const Mesh &mesh, const Solid &solid, const Hangs &hangs)
  {
    slow_shares.resize(runs.size());
    for (unsigned int level = 1; level <= max_level(); ++level)
      {
        // Forces on hanging nodes are their parents'.
        NodalField marks(of_node.size(), Vector3{});
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          if (solid.cell_levels()[c] == level)
            for (const unsigned int i : mesh.cells[c].nodes)
              {
                if (!hangs[i])
                  marks[i][0] = 1.;
                else
                  for (const unsigned int parent : hangs[i]->parents)
                    marks[parent][0] = 1.;
              }
        mesh.shared_nodes.sum(marks.data()); // the owner, who may have a whole share, need not have a cell
        SlowShares &shares = slow_shares[level];
        for (unsigned int own = 0; own < level; ++own)
          {
            for (unsigned int i = 0; i < of_node.size(); ++i)
              if (marks[i][0] > 0. && of_node[i] == own)
                shares.nodes.push_back(i);
            shares.end_of_level.push_back(shares.nodes.size());
          }
        if (reproducible)
          for (std::size_t k = 0; k < shares.nodes.size(); ++k)
            if (std::binary_search(mesh.shared_nodes.nodes().begin(), mesh.shared_nodes.nodes().end(),
                                   shares.nodes[k]))
              shares.with_copies.push_back(k);
        shares.steady.assign(shares.nodes.size(), Vector3{});
      }
  }


  void NodeLevels::set_runs(const Mesh &mesh, const std::vector<int> &carrier_of_body, const Hangs &hangs)
  {
    const auto kind = [&](const unsigned int i) {
      return std::make_tuple(of_node[i], carrier_of_body[mesh.node_bodies[i]], mesh.shared_nodes.is_owned(i),
                             hangs[i] != nullptr);
    };
    for (unsigned int begin = 0, end = 0; begin < of_node.size(); begin = end)
      {
        while (end < of_node.size() && kind(end) == kind(begin))
          ++end;
        if (!hangs[begin])
          runs[of_node[begin]].push_back(
            {begin, end, carrier_of_body[mesh.node_bodies[begin]], mesh.shared_nodes.is_owned(begin)});
      }
  }


  void NodeLevels::serialize(Archive &archive, const Mesh &mesh)
  {
    archive.same(slow_shares_known);
    struct Share
    {
      unsigned int level;
      Archive::Key key;
      double       steady[3]; ///< N
    };
    const auto by_name = [](const Share &a, const Share &b) {
      return std::tie(a.level, a.key) < std::tie(b.level, b.key);
    };
    const auto for_shares = [&](const auto &work) {
      for (unsigned int level = 1; level <= max_level(); ++level)
        for (std::size_t k = 0; k < slow_shares[level].nodes.size(); ++k)
          work(level, slow_shares[level].nodes[k], slow_shares[level].steady[k]);
    };
    std::vector<Share> list;
    if (!archive.restores())
      for_shares([&](const unsigned int level, const unsigned int i, const Vector3 &steady) {
        list.push_back({level, mesh.node_key(i), {steady[0], steady[1], steady[2]}});
      });
    list = archive.records(list);

    bool as_divided = true;
    for (SlowShares &shares : slow_shares)
      as_divided = archive.own(shares.steady) && as_divided;
    if (as_divided)
      return;
    // The owner of a node has what all ranks had of it: what follows is linear in the shares.
    std::stable_sort(list.begin(), list.end(), by_name);
    for_shares([&](const unsigned int level, const unsigned int i, Vector3 &steady) {
      steady = Vector3{};
      const auto [begin, end] =
        std::equal_range(list.begin(), list.end(), Share{level, mesh.node_key(i), {}}, by_name);
      if (begin == end)
        archive.miss();
      if (mesh.shared_nodes.is_owned(i))
        for (auto share = begin; share != end; ++share)
          steady += Vector3{share->steady[0], share->steady[1], share->steady[2], 0.};
    });
  }


  std::size_t NodeLevels::memory_consumption() const
  {
    std::size_t bytes =
      of_node.size() * sizeof(of_node[0]) + hanging_at_contact.size() * sizeof(Mesh::HangingNode);
    for (const SlowShares &shares : slow_shares)
      bytes += shares.nodes.size() * (sizeof(unsigned int) + sizeof(Vector3));
    for (const HangingNodes &of_level : hanging)
      bytes += (of_level.loaded.size() + of_level.placed.size()) * sizeof(Mesh::HangingNode);
    return bytes;
  }
} // namespace tread
