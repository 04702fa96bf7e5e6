// SPDX-License-Identifier: LGPL-2.1-or-later
// How a motion goes on with other cells.
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/mesh/moved_fields.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace tread
{
  Vector3 ExplicitDynamics::turning_in_half_a_step(const unsigned int node,
                                                   const Vector3     &velocity,
                                                   const double       time_step) const
  {
    const int carrier = carrier_of(node);
    if (carrier < 0)
      return Vector3{};
    const RigidMotion &motion = parts.motions()[carrier];
    return 0.5 * std::ldexp(time_step, levels.of_node[node]) *
           cross(motion.turning, velocity - motion.velocity);
  }


  void ExplicitDynamics::take_nodes(ExplicitDynamics &before)
  {
    before.parts.find_motions();
    parts.find_motions();
    const unsigned int n = before.mesh.nodes.size();
    NodalField         x = before.state.positions(), v(n), reference(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        // Nodes of other levels have their velocities of another instant.
        v[i] =
          before.state.v[i] + before.turning_in_half_a_step(i, before.state.v[i], before.state.time_step);
        reference[i] = Vector3{before.mesh.nodes[i][0], before.mesh.nodes[i][1], before.mesh.nodes[i][2], 0.};
      }
    before.mesh.distribute_hanging_nodes(x.data());
    before.mesh.distribute_hanging_nodes(v.data());
    std::vector<NodalField>         others; // numbers of others on nodes, in [0]
    std::vector<const NodalField *> fields{&x, &v, &reference};
    for (const auto &[name, values] : before.state.fields)
      {
        others.emplace_back(n, Vector3{});
        for (unsigned int i = 0; i < n; ++i)
          others.back()[i][0] = values[i];
      }
    for (const NodalField &other : others)
      fields.push_back(&other);
    const std::vector<NodalField> moved = moved_fields(before.mesh, fields, mesh);

    state.set_damping_time(0.);
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      {
        // Where one mesh has a chord and the other the surface.
        Vector3   off     = Vector3{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.} - moved[2][i];
        const int carrier = carrier_of(i);
        state.v[i]        = moved[1][i];
        if (carrier >= 0)
          {
            off = parts.carriers()[carrier]->turned(off);
            state.v[i] += cross(parts.motions()[carrier].turning, off);
          }
        state.set_position(i, moved[0][i] + off);
      }
    std::size_t next = 3;
    for (const auto &[name, values] : before.state.fields)
      {
        std::vector<double> &here = state.fields[name];
        here.resize(mesh.nodes.size());
        for (unsigned int i = 0; i < here.size(); ++i)
          here[i] = moved[next][i][0];
        ++next;
      }
    // The time step is that of the cells as they are now.
    const double time_step = parameters.courant_number * critical.seconds();
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      state.v[i] -= turning_in_half_a_step(i, state.v[i], time_step);
  }


  double ExplicitDynamics::energy_of_changing_mass() const
  {
    ReproducibleSum<double> sum;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      {
        if (!(inverse_mass[i] > 0. && mesh.shared_nodes.is_owned(i)))
          continue;
        sum.add(parameters.gravity * true_mass[i] * state.position(i)[2]);
        if (const int carrier = carrier_of(i); carrier >= 0)
          {
            const RigidMotion &motion = parts.motions()[carrier];
            const Vector3      arm    = state.position(i) - motion.middle,
                          off_axle    = arm - dot(motion.axle, arm) * motion.axle,
                          v           = motion.velocity + cross(motion.turning, arm);
            const double nominal      = parts.carriers()[carrier]->angular_velocity();
            // What moves rigidly with it, and the potential that holds it on its circle.
            sum.add(0.5 * (1. / inverse_mass[i] - true_mass[i]) *
                    (dot(v, v) + nominal * nominal * dot(off_axle, off_axle)));
          }
      }
    return sum.value(mesh.comm);
  }


  void ExplicitDynamics::go_on_from(ExplicitDynamics &before)
  {
    state.time    = before.state.time;
    state.n_steps = before.state.n_steps;
    if (!synchronised())
      throw std::logic_error("a motion goes on after " + std::to_string(state.n_steps) +
                             " steps with cells that are due every " + std::to_string(1u << max_level()));
    const double unaccounted = before.ledger().residual(), damping_power = before.books.begin_sample().power;
    take_nodes(before);
    if (contact)
      contact->go_on_from(*before.contact);

    // Before what is near the contact is chosen anew, with the inertia.
    Archive kept(mesh.comm);
    before.matched_surface.serialize(kept);
    Archive found(mesh.comm, kept.stored_by_all());
    matched_surface.serialize(found);
    set_inertia();
    prepare_step();

    books.go_on_from(before.books, damping_power);
    spent = before.spent;
    // A chord has less mass than the arc. The hub makes up for it, but not for what density scaling makes of
    // it: that comes with the speed of the wheel, and is no loss of its cells' motion. Nor is the height at
    // which mass comes and goes.
    const double added = energy_of_changing_mass() - before.energy_of_changing_mass(),
                 lost  = ledger().residual() - unaccounted + added;
    books.count_window(lost, added);
  }
} // namespace tread
