// SPDX-License-Identifier: LGPL-2.1-or-later
// Two free blocks fly into each other obliquely, with friction and meshes that do not match: momentum,
// energy, ranks.
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include "check.h"
#include "fields.h"

#include <algorithm>
#include <array>
#include <map>

using namespace tread;
using tests::Check;
using tests::size;
using dealii::Point;

namespace contact_momentum
{
  constexpr unsigned int n_steps = 1600;
  constexpr double       edge = 0.02, face = 0.02 / 5.; // of the blocks, and of their smaller faces, m

  struct Momentum
  {
    Vector3 linear{}, angular{}; ///< of both bodies, N s and N m s
    Vector3 of_body[2] = {};     ///< linear
    double  kinetic    = 0.;     ///< J
  };

  struct Result
  {
    Momentum     before, after;
    EnergyLedger energy;
    Vector3      impulse{};           ///< total on the master
    double       largest_energy = 0.; ///< kinetic and strain energy over that at the start
    unsigned int n_touching     = 0;  ///< steps with contact
    bool         touches_at_end = true;
    std::map<std::array<long long, 4>, Vector3> velocities; ///< of owned nodes, by Mesh::node_key()
  };

  Momentum momentum(const ExplicitDynamics &dynamics)
  {
    Momentum m;
    for (unsigned int i = 0; i < dynamics.state.v.size(); ++i)
      if (dynamics.mesh.shared_nodes.is_owned(i))
        {
          const double mass = dynamics.true_masses()[i];
          m.of_body[dynamics.mesh.node_bodies[i]] += mass * dynamics.state.v[i];
          m.angular += mass * cross(dynamics.state.position(i), dynamics.state.v[i]);
          m.kinetic += 0.5 * mass * dot(dynamics.state.v[i], dynamics.state.v[i]);
        }
    const MPI_Comm comm = dynamics.mesh.comm;
    for (Vector3 &of_body : m.of_body)
      of_body = tests::sum_over_ranks(of_body, comm);
    m.angular = tests::sum_over_ranks(m.angular, comm);
    m.linear  = m.of_body[0] + m.of_body[1];
    m.kinetic = dealii::Utilities::MPI::sum(m.kinetic, comm);
    return m;
  }

  Result run(const MPI_Comm comm, const unsigned int slave, const double sliding_share)
  {
    const Body lower = tests::make_box("lower", Point<3>(0., 0., -0.02), Point<3>(0.02, 0.02, 0.),
                                       {{3, 3, 3}}, {{tests::Side::top, Boundary::contact}});
    // An edge strikes first, the block turns, and its whole face follows.
    const double tilt  = 0.01;
    const Body   upper = tests::turned(
        tests::turned(tests::make_box("upper", Point<3>(0., 0., 0.), Point<3>(0.018, 0.017, 0.015), {{5, 4, 4}},
                                      {{tests::Side::bottom, Boundary::contact}}),
                      Point<3>(0., 1., 0.), tilt),
        Point<3>(0., 0., 1.), 0.3, dealii::Tensor<1, 3>({0.004, -0.001, 0.018 * std::sin(tilt) + 2e-6}));
    const Mesh      mesh(comm, {lower, upper});
    SolidParameters solid_parameters;
    solid_parameters.surface_damping = 0.; // whose work is sampled every so many steps
    const Solid        solid(mesh, {ElasticMaterial(), ElasticMaterial()}, solid_parameters);
    DynamicsParameters dynamics_parameters;
    dynamics_parameters.gravity        = 0.;
    dynamics_parameters.damping_steps  = 0.;
    dynamics_parameters.courant_number = 0.2; // see the ledger below
    ExplicitDynamics  dynamics(mesh, solid, dynamics_parameters);
    ContactParameters contact_parameters;
    contact_parameters.slave_body    = slave;
    contact_parameters.sliding_share = sliding_share;
    // Sweeps that end elsewhere on other ranks must not hide behind the tolerance.
    contact_parameters.solver.tolerance  = 1e-13;
    contact_parameters.solver.max_sweeps = 1000;
    Contact contact(mesh, contact_parameters, std::make_shared<CoulombFriction>(0.3));
    dynamics.attach_contact(contact);

    for (unsigned int i = 0; i < dynamics.state.v.size(); ++i)
      dynamics.state.v[i] = mesh.node_bodies[i] == 0 ? Vector3{-1., 0., 2., 0.} : Vector3{3., 1., -5., 0.};
    dynamics.start();

    Result result;
    result.before       = momentum(dynamics);
    double last_kinetic = 0., strain = 0.;
    for (unsigned int n = 0; n < n_steps; ++n)
      {
        dynamics.step();
        const Vector3 impulse = contact.total_impulse();
        result.impulse += impulse;
        result.touches_at_end = size(impulse) > 0.;
        result.n_touching += result.touches_at_end;
        // Kinetic energy half a step before and after the instant of the strain energy.
        const double kinetic = momentum(dynamics).kinetic;
        if (n % 20 == 1)
          result.largest_energy =
            std::max(result.largest_energy, 0.5 * (last_kinetic + kinetic) - result.before.kinetic + strain);
        if (n % 20 == 0)
          {
            const EnergyLedger energy = dynamics.ledger();
            strain                    = energy.strain + energy.hourglass;
          }
        last_kinetic = kinetic;
      }
    result.after  = momentum(dynamics);
    result.energy = dynamics.ledger();
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.shared_nodes.is_owned(i))
        result.velocities[mesh.node_key(i)] = dynamics.state.v[i];
    return result;
  }
} // namespace contact_momentum

TREAD_TEST(contact_momentum)(Check &check, const tests::Arguments &)
{
  for (const unsigned int slave : {0u, 1u})
    {
      const std::string name     = slave == 0 ? "slave below: " : "slave above: ";
      const Result      r        = run(MPI_COMM_WORLD, slave, 0.02);
      const double      transfer = size(r.impulse);
      std::printf("%scontact in %u steps, impulse %.4f N s, kinetic energy %.4f -> %.4f J, friction %.3e J, "
                  "normal %.3e J, "
                  "strain %.3e J\n",
                  name.c_str(), r.n_touching, transfer, r.before.kinetic, r.after.kinetic, r.energy.friction,
                  r.energy.contact, r.energy.strain);
      check.that(name + "they touch and part", r.n_touching > 20 && !r.touches_at_end);
      // Round-off of 1600 steps, each of the coupling's rows summing to zero within a bit or two.
      check.below(name + "change of linear momentum, share of impulse",
                  size(r.after.linear - r.before.linear) / transfer, 1e-13);
      check.below(name + "momentum of master - impulse, share",
                  size(r.after.of_body[1 - slave] - r.before.of_body[1 - slave] - r.impulse) / transfer,
                  1e-12);
      // The coupling's arms are exact when it is integrated; sliding by up to a share of a face before it is
      // integrated anew leaves a couple of impulse x slide.
      check.below(name + "change of angular momentum, share of impulse x edge",
                  size(r.after.angular - r.before.angular) / (transfer * edge), 0.02 * face / edge);
      const Result finer = run(MPI_COMM_WORLD, slave, 0.002);
      // Ten times less of it; the rest are gaps and turned normals within a step, about twice as much.
      check.below(name + "the same, search ten times as often",
                  size(finer.after.angular - finer.before.angular) / (transfer * edge),
                  3. * 0.002 * face / edge);
      // The blocks' oscillation while they strike takes part in the same (omega dt)^2/2, see below.
      check.below(name + "gain of energy, share", std::max(0., r.largest_energy) / r.before.kinetic, 1e-3);
      check.that(name + "energy is lost in the end", r.after.kinetic < r.before.kinetic);
      check.that(name + "friction takes energy", r.energy.friction > 0.);
      // Strain energy at n and kinetic energy at n - 1/2 miss each other by (omega dt)^2/2 of what vibrates,
      // here 4 % of the kinetic energy with frequencies up to 0.4/dt.
      check.below(name + "residual of the energy ledger, share", r.energy.residual() / r.before.kinetic,
                  1e-3);
      check.below(name + "work of contact on the nodes - that of the pairs, over what was dissipated",
                  r.energy.of_dissipated(r.energy.contact_on_nodes - r.energy.friction - r.energy.contact),
                  1e-10);
      check.below(name + "the residual over what was dissipated", r.energy.of_dissipated(r.energy.residual()),
                  5e-6);
      check.that(name + "a wrong impulse of 1e-10 is noticed",
                 size(r.after.of_body[1 - slave] - r.before.of_body[1 - slave] - (1. + 1e-10) * r.impulse) /
                     transfer >
                   1e-12);

      // The same alone on each rank.
      const Result alone      = run(MPI_COMM_SELF, slave, 0.02);
      double       difference = 0.;
      for (const auto &[key, v] : r.velocities)
        difference = std::max(difference, size(v - alone.velocities.at(key)));
      difference = dealii::Utilities::MPI::max(difference, MPI_COMM_WORLD);
      // Sums in another order differ by round-off, which contact and friction amplify.
      check.below(name + "velocities on all ranks - on one, m/s", difference, 1e-10 * 7.);
      check.relative(name + "friction loss on all ranks", r.energy.friction, alone.energy.friction, 1e-10);
    }
}
