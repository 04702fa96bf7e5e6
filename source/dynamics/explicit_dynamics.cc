// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/went_wrong.h>
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tread
{
  ExplicitDynamics::ExplicitDynamics(const Mesh               &mesh,
                                     const Solid              &solid,
                                     const DynamicsParameters &parameters)
    : MovingBodies(mesh, solid, parameters)
    , critical(*this)
    , books(*this)
  {
  }


  void ExplicitDynamics::set_rigid_velocities()
  {
    const double step = parameters.courant_number * critical.seconds();
    for (const CarriesBody *carrier : parts.carriers())
      carrier->set_velocities(
        state, [&](const unsigned int i) { return 0.5 * std::ldexp(step, levels.of_node[i]); });
  }


  void ExplicitDynamics::set_bending_velocities()
  {
    const auto constrain = [&](NodalField &v) {
      hold_guided_nodes(v);
      mesh.distribute_hanging_nodes(v.data());
    };
    const std::vector<MovingLoad> loads = parts.loads_of_carriers();
    for (const auto &part : parts)
      if (const std::vector<double> up = part->follow(state, loads, constrain); !up.empty())
        for (std::size_t k = 0; k < loads.size(); ++k)
          parts.carriers()[k]->rise(up[k]);
  }


  void ExplicitDynamics::set_inertia()
  {
    levels.slow_shares_known = false;
    state.time_step          = parameters.courant_number * critical.seconds();
    inverse_mass             = free_inverse_masses();
    loads_of_shared.clear();
    for (const unsigned int i : mesh.shared_nodes.nodes())
      loads_of_shared.push_back({i, levels.of_node[i], Vector3{}});
    if (contact)
      {
        contact->set_inverse_masses(inverse_mass);
        contact->refresh(state.positions().data(), state.v.data(), state.time_step);
        matched_surface.select(contact->nodes_near());
      }
    std::size_t most = 0;
    for (const SlowShares &shares : levels.slow_shares)
      most = std::max(most, shares.nodes.size());
    force_before.resize(most);
    hold_guided_nodes(state.v);
  }


  void ExplicitDynamics::start()
  {
    for (const auto &part : parts)
      part->start();
    set_inertia();
    prepare_step();
    books.start();
  }


  void ExplicitDynamics::serialize(Archive &archive)
  {
    critical.serialize(archive);
    parts.serialize(archive);
    if (archive.restores())
      set_inertia(); // before the contact, as it looks for the pairs that may touch
    books.serialize(archive);
    archive.largest(spent.internal_forces, spent.contact, spent.search, spent.communication, spent.nodes);
    state.serialize(archive, mesh, solid, parameters.damping_steps * state.time_step);
    levels.serialize(archive, mesh);
    if (contact)
      {
        contact->serialize(archive);
        matched_surface.serialize(archive);
      }
    if (archive.restores())
      prepare_step();
  }


  void ExplicitDynamics::check_stability() const
  {
    double       fastest = 0.; // squared
    unsigned int worst   = 0;
    for (unsigned int i = 0; i < state.v.size(); ++i)
      if (const double speed2 = dot(state.v[i], state.v[i]); !(speed2 <= fastest)) // NaN is found as well
        {
          fastest = speed2 == speed2 ? speed2 : std::numeric_limits<double>::max();
          worst   = i;
        }
    const double largest = dealii::Utilities::MPI::max(fastest, mesh.comm);
    if (largest <= parameters.stop_at.node_speed * parameters.stop_at.node_speed)
      return;
    const bool             is_here = fastest == largest && !state.v.empty();
    const dealii::Point<3> place   = is_here ? mesh.nodes[worst] : dealii::Point<3>();
    throw WentWrong(
      format("unstable: nodes move faster than %g m/s after %llu steps, most of all that which was ",
             parameters.stop_at.node_speed, (unsigned long long)state.n_steps) +
      place_of_worst(is_here, place, is_here ? mesh.node_bodies[worst] : 0) +
      format("; lower 'Time stepping/Courant number' (%f, at most 1)", parameters.courant_number));
  }
} // namespace tread
