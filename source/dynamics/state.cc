// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/state.h>
#include <tread/solid/solid.h>

#include <algorithm>
#include <utility>

namespace tread
{
  State::State(const Mesh &mesh, PlasticHistory virgin)
    : v(mesh.nodes.size(), Vector3{})
    , x_damped(mesh.nodes.size())
    , force(mesh.nodes.size(), Vector3{})
    , history(std::move(virgin))
  {
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      x_damped[i] = Vector3{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.};
  }


  NodalField State::positions() const
  {
    NodalField x(v.size());
    for (unsigned int i = 0; i < v.size(); ++i)
      x[i] = position(i);
    return x;
  }


  void State::set_damping_time(const double beta)
  {
    for (unsigned int i = 0; i < v.size(); ++i)
      x_damped[i] += (beta - damping_time) * v[i];
    damping_time = beta;
  }


  namespace
  {
    /// Store what of_node(i) gives of this rank's own nodes, or restore it by set(i, value) for all nodes.
    /// Collective.
    template <typename Value, typename OfNode, typename Set>
    void serialize_by_node(Archive &archive, const Mesh &mesh, const OfNode &of_node, const Set &set)
    {
      struct Kept
      {
        Archive::Key key;
        Value        value;
      };
      if (!archive.restores())
        {
          std::vector<Kept> own;
          for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
            if (mesh.shared_nodes.is_owned(i))
              own.push_back({mesh.node_key(i), of_node(i)});
          archive.records(own);
          return;
        }
      std::vector<Kept> all    = archive.records(std::vector<Kept>());
      const auto        by_key = [](const Kept &a, const Kept &b) {
        return a.key < b.key;
      };
      const auto before = [](const Kept &node, const Archive::Key &key) {
        return node.key < key;
      };
      std::sort(all.begin(), all.end(), by_key);
      for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
        {
          const Archive::Key key  = mesh.node_key(i);
          const auto         node = std::lower_bound(all.begin(), all.end(), key, before);
          if (node == all.end() || node->key != key)
            archive.miss();
          else
            set(i, node->value);
        }
    }
  } // namespace


  void State::serialize(Archive &archive, const Mesh &mesh, const Solid &solid, const double damping_time)
  {
    struct Motion
    {
      double x_damped[3], v[3];
    };
    archive.same(time, n_steps);
    serialize_by_node<Motion>(
      archive, mesh,
      [&](const unsigned int i) {
        return Motion{{x_damped[i][0], x_damped[i][1], x_damped[i][2]}, {v[i][0], v[i][1], v[i][2]}};
      },
      [&](const unsigned int i, const Motion &node) {
        x_damped[i] = Vector3{node.x_damped[0], node.x_damped[1], node.x_damped[2], 0.};
        v[i]        = Vector3{node.v[0], node.v[1], node.v[2], 0.};
      });
    if (archive.restores())
      this->damping_time = damping_time;
    solid.plastic().serialize(archive, history);
    for (auto &[name, values] : fields)
      serialize_by_node<double>(
        archive, mesh, [&values = values](const unsigned int i) { return values[i]; },
        [&values = values](const unsigned int i, const double value) { values[i] = value; });
  }
} // namespace tread
