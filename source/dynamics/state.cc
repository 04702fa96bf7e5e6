// SPDX-License-Identifier: LGPL-2.1-or-later
// The state of the dynamics, stored and restored.
#include <tread/dynamics/explicit_dynamics.h>

#include <algorithm>

namespace tread
{
  void ExplicitDynamics::serialize(Archive &archive)
  {
    archive.same(critical_step, highest_of_step, bound_found_stable);
    for (Wheel &wheel : wheels)
      {
        wheel.hub->serialize(archive);
        archive.same(wheel.nominal_angular_velocity);
      }
    if (rail_base)
      rail_base->serialize(archive);
    if (archive.restores())
      set_inertia(); // before the contact, as it looks for the pairs that may touch
    archive.same(time, n_steps);
    archive.same(start_kinetic, start_potential, start_strain, start_hub_work, start_springs,
                 start_dissipated);
    for (ReproducibleSum<double> *total :
         {&totals.external_work, &totals.gross_work, &totals.friction, &totals.contact, &totals.damping,
          &totals.plastic, &totals.contact_on_nodes})
      total->serialize(archive);
    archive.same(last_damping_power, last_damping_step, damping_is_sampled);
    archive.largest(times.internal_forces, times.contact, times.search, times.communication, times.nodes);
    serialize_nodes(archive);
    solid.plastic().serialize(archive, history);
    levels.serialize(archive, mesh);
    if (supports)
      supports->serialize(archive);
    if (contact)
      {
        contact->serialize(archive);
        matched_surface.serialize(archive);
      }
    if (archive.restores())
      prepare_step();
  }


  void ExplicitDynamics::serialize_nodes(Archive &archive)
  {
    struct KeptNode
    {
      Archive::Key key;
      double       x_damped[3], v[3];
    };
    if (!archive.restores())
      {
        std::vector<KeptNode> own;
        for (unsigned int i = 0; i < v.size(); ++i)
          if (mesh.shared_nodes.is_owned(i))
            own.push_back({mesh.node_key(i),
                           {x_damped[i][0], x_damped[i][1], x_damped[i][2]},
                           {v[i][0], v[i][1], v[i][2]}});
        archive.records(own);
        return;
      }
    std::vector<KeptNode> all    = archive.records(std::vector<KeptNode>());
    const auto            by_key = [](const KeptNode &a, const KeptNode &b) {
      return a.key < b.key;
    };
    const auto before = [](const KeptNode &node, const Archive::Key &key) {
      return node.key < key;
    };
    std::sort(all.begin(), all.end(), by_key);
    damping_time = parameters.damping_steps * time_step;
    for (unsigned int i = 0; i < v.size(); ++i)
      {
        const Archive::Key key  = mesh.node_key(i);
        const auto         node = std::lower_bound(all.begin(), all.end(), key, before);
        if (node == all.end() || node->key != key)
          {
            archive.miss();
            continue;
          }
        x_damped[i] = Vector3{node->x_damped[0], node->x_damped[1], node->x_damped[2], 0.};
        v[i]        = Vector3{node->v[0], node->v[1], node->v[2], 0.};
      }
  }
} // namespace tread
