// SPDX-License-Identifier: LGPL-2.1-or-later
// Without external forces linear and angular momentum must be conserved to round-off and energy within the
// bounds of central differences, for a vibrating block with hanging nodes and for a spinning ring.
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/solid/fully_integrated.h>
#include <tread/solid/one_point.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"
#include "check.h"

#include <algorithm>
#include <cstdint>

using namespace tread;
using dealii::Point;

namespace dynamics_conservation
{
  struct Sums
  {
    double momentum[3] = {0., 0., 0.}, angular[3] = {0., 0., 0.};
    double energy         = 0.; ///< J
    double momentum_scale = 0., angular_scale = 0.;
  };

  Sums sums_of(const ExplicitDynamics &dynamics)
  {
    const Mesh &mesh = dynamics.mesh;
    Sums        sums;
    // Energy at the instant of the velocities, half a step back: there central differences keep it to second
    // order.
    NodalField middle(dynamics.state.v.size());
    for (unsigned int i = 0; i < middle.size(); ++i)
      {
        const Vector3 x = dynamics.state.position(i), v = dynamics.state.v[i];
        const double  m = dynamics.true_masses()[i];
        middle[i]       = x - 0.5 * dynamics.state.time_step * v;
        if (!mesh.shared_nodes.is_owned(i))
          continue;
        for (unsigned int d = 0; d < 3; ++d)
          {
            const unsigned int e = (d + 1) % 3, f = (d + 2) % 3;
            sums.momentum[d] += m * v[d];
            sums.angular[d] += m * (x[e] * v[f] - x[f] * v[e]);
          }
        sums.energy += 0.5 * m * dot(v, v);
        sums.momentum_scale += m * std::sqrt(dot(v, v));
        sums.angular_scale += m * std::sqrt(dot(x, x) * dot(v, v));
      }
    const StrainEnergy strain = dynamics.solid.strain_energy(middle.data());
    sums.energy += strain.strain + strain.hourglass;
    for (double *value :
         {&sums.momentum[0], &sums.momentum[1], &sums.momentum[2], &sums.angular[0], &sums.angular[1],
          &sums.angular[2], &sums.energy, &sums.momentum_scale, &sums.angular_scale})
      *value = dealii::Utilities::MPI::sum(*value, mesh.comm);
    return sums;
  }

  /// Random numbers in [-1, 1] that depend on the place only, so that all ranks agree on them.
  Vector3 random_at(const Point<3> &p)
  {
    Vector3 value{};
    for (unsigned int d = 0; d < 3; ++d)
      {
        std::uint64_t state = std::llround(p[0] * 1e7) * 73856093ll + std::llround(p[1] * 1e7) * 19349663ll +
                              std::llround(p[2] * 1e7) * 83492791ll + 7919ll * (d + 1);
        for (unsigned int round = 0; round < 3; ++round)
          {
            state ^= state >> 33;
            state *= 0xff51afd7ed558ccdull;
          }
        value[d] = (state >> 11) * (2. / 9007199254740992.) - 1.;
      }
    return value;
  }

  void run(tests::Check      &check,
           ExplicitDynamics  &dynamics,
           const unsigned int n_steps,
           const double       allowed_energy,
           const std::string &name)
  {
    dynamics.start();
    const Sums start    = sums_of(dynamics);
    double     momentum = 0., angular = 0., energy = 0.;
    for (unsigned int n = 1; n <= n_steps; ++n)
      {
        dynamics.step();
        if (n % 20 == 0)
          {
            const Sums now = sums_of(dynamics);
            for (unsigned int d = 0; d < 3; ++d)
              {
                momentum =
                  std::max(momentum, std::abs(now.momentum[d] - start.momentum[d]) / start.momentum_scale);
                angular =
                  std::max(angular, std::abs(now.angular[d] - start.angular[d]) / start.angular_scale);
              }
            energy = std::max(energy, std::abs(now.energy / start.energy - 1.));
          }
      }
    std::printf("%s: %u steps of %.3g us, energy %.5g J\n", name.c_str(), n_steps,
                1e6 * dynamics.state.time_step, start.energy);
    // Forces cancel in pairs up to 1e-16 of each; thousands of steps and hundreds of nodes add at random.
    check.below(name + ": drift of momentum", momentum, 1e-12);
    check.below(name + ": drift of angular momentum", angular, 1e-12);
    check.below(name + ": change of energy", energy, allowed_energy);
  }
} // namespace dynamics_conservation


TREAD_TEST(dynamics_conservation)(tests::Check &check, const tests::Arguments &)
{
  const ElasticMaterial steel;
  DynamicsParameters    parameters;
  parameters.gravity       = 0.;
  parameters.damping_steps = 0.; // damping forces act along x + beta v, so they turn a body a little
  {
    Body body = tests::make_box("block", Point<3>(), Point<3>(.04, .03, .03), {{4, 3, 3}});
    tests::refine_near(body, Point<3>(.04, .03, .03), .012, .005);
    const Mesh mesh(MPI_COMM_WORLD, {body});
    check.that("block: has hanging nodes", mesh.n_global_hanging_nodes > 0);
    for (const std::string type : {OnePoint::name, FullyIntegrated::name})
      {
        SolidParameters solid_parameters;
        solid_parameters.element = type;
        const Solid      solid(mesh, {steel}, solid_parameters);
        ExplicitDynamics dynamics(mesh, solid, parameters);
        for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
          {
            // A turn of 300 rad/s about a skew axis, a translation and 2 m/s of noise.
            const Vector3 r = dynamics.state.position(i) - Vector3{.02, .015, .015, 0.};
            dynamics.state.v[i] =
              2. * random_at(mesh.nodes[i]) + Vector3{5., -3., 2., 0.} +
              300. * Vector3{-.6 * r[1] + .5 * r[2], .6 * r[0] - .6 * r[2], -.5 * r[0] + .6 * r[1], 0.};
          }
        mesh.distribute_hanging_nodes(dynamics.state.v.data());
        // Random velocities excite every mode up to omega dt = 1.8, where energy swings by (omega dt)^2/8 of
        // the strain part; turn and translation hold most of the energy and hundreds of modes average, which
        // leaves some 1e-3 of the whole.
        run(check, dynamics, 4000, 0.01,
            type == OnePoint::name ? "block, one point" : "block, fully integrated");
      }
  }
  {
    // A rim of a wheel's size that turns once: 400 rad/s, a stress of 260 MPa and the ringing of a sudden
    // start.
    const Mesh       mesh(MPI_COMM_WORLD, {tests::make_ring(.46, .40, .06, {{72, 2, 2}})});
    const Solid      solid(mesh, {steel}, SolidParameters());
    ExplicitDynamics dynamics(mesh, solid, parameters);
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      dynamics.state.v[i] =
        400. * Vector3{dynamics.state.position(i)[2], 0., -dynamics.state.position(i)[0], 0.};
    dynamics.start();
    const unsigned int n_steps = std::ceil(2. * 3.14159 / 400. / dynamics.state.time_step);
    // Mostly the breathing mode is excited, omega dt = 0.04: energy swings by some 1e-4 of the strain energy,
    // which is 1e-3 of the kinetic one. A drift of 1e-6 a turn would be seen.
    run(check, dynamics, n_steps, 3e-6, "ring");
  }
}
