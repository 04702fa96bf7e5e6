// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/explicit_dynamics.h>

#include <cmath>

namespace tread
{
  namespace
  {
    /// Part of the way that the steady share of slow cells' forces goes to their present value when these are
    /// evaluated.
    constexpr double follow = 0.5;
  } // namespace


  void ExplicitDynamics::add_forces_due(const unsigned int due)
  {
    const auto add_matched = [&](const unsigned int level) {
      books.totals.external_work.add(-matched_surface.advance(
        state.x_damped.data(), state.v.data(), state.force.data(), surface_damping_time(),
        state.damping_time + 0.5 * std::ldexp(state.time_step, level), Levels{level, level, true}));
    };
    books.totals.plastic.add(solid.update_internal_forces(
      state.x_damped.data(), state.v.data(), state.force.data(), state.history, Levels{0, 0, true}));
    add_matched(0);
    Mesh::condense(levels.hanging[0].loaded, state.force.data());
    for (unsigned int level = 1; level <= max_level(); ++level)
      {
        SlowShares &shares = levels.slow_shares[level];
        if (level > due)
          {
            shares.for_nodes_up_to(due, [&](const std::size_t k, const double own) {
              state.force[shares.nodes[k]] += own * shares.steady[k];
            });
            continue;
          }
        for (std::size_t k = 0; k < shares.nodes.size(); ++k)
          force_before[k] = state.force[shares.nodes[k]];
        solid.add_elastic_forces(state.x_damped.data(), state.v.data(), state.force.data(),
                                 Levels{level, level, true});
        add_matched(level);
        Mesh::condense(levels.hanging[level].loaded, state.force.data());
        if (levels.reproducible)
          give_to_owners(shares);
        const double factor = std::ldexp(1., level);
        shares.for_nodes_up_to(level - 1, [&](const std::size_t k, const double own) {
          Vector3      &here = state.force[shares.nodes[k]];
          const Vector3 now  = (1. / factor) * (here - force_before[k]);
          const Vector3 change =
            quanta.force.round((levels.slow_shares_known ? follow : 1.) * (now - shares.steady[k]));
          shares.steady[k] += change;
          // The steady part acts on average half of (factor - own) steps late: what that takes from a
          // force that changes is given at once, or motion would be fed with energy.
          here -=
            (factor - own) * (levels.slow_shares_known ? shares.steady[k] - 0.5 * change : shares.steady[k]);
        });
      }
    levels.slow_shares_known = true;
  }


  void ExplicitDynamics::give_to_owners(const SlowShares &shares)
  {
    if (mesh.shared_nodes.nodes().empty())
      return;
    given_to_owners.assign(state.v.size(), Vector3{});
    for (const std::size_t k : shares.with_copies)
      {
        Vector3 &here                    = state.force[shares.nodes[k]];
        given_to_owners[shares.nodes[k]] = here - force_before[k];
        here                             = force_before[k];
      }
    mesh.shared_nodes.sum(given_to_owners.data());
    for (const std::size_t k : shares.with_copies)
      if (const unsigned int i = shares.nodes[k]; mesh.shared_nodes.is_owned(i))
        state.force[i] += given_to_owners[i];
  }


  unsigned int ExplicitDynamics::level_due() const
  {
    unsigned int level = max_level();
    while (state.n_steps % (std::uint64_t(1) << level) != 0)
      --level;
    return level;
  }


  void ExplicitDynamics::place_hanging_nodes()
  {
    if (synchronised())
      {
        for (Vector3 *field : {state.v.data(), state.x_damped.data()})
          mesh.distribute_hanging_nodes(field);
        return;
      }
    for (unsigned int level = 0; level <= level_due(); ++level)
      {
        Mesh::distribute(levels.hanging[level].placed, state.x_damped.data());
        if (solid.needs_velocity())
          Mesh::distribute(levels.hanging[level].placed, state.v.data());
      }
    Mesh::distribute(levels.hanging_at_contact, state.x_damped.data());
    Mesh::distribute(levels.hanging_at_contact, state.v.data());
  }
} // namespace tread
