// SPDX-License-Identifier: LGPL-2.1-or-later
// A block on a plane is pushed aside and released: after stick it returns, after slip it remains at its new
// position.
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/parts/nodes.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"
#include "check.h"

using namespace tread;
using tests::Check;
using dealii::Point;

namespace contact_return
{
  constexpr double gravity = 9.81, friction = 0.5, height = 0.02;

  struct Result
  {
    double pushed, residual, friction_loss; ///< mean displacement under the full push and after release, m; J
    double push_time, mass;                 ///< s, kg
  };

  /// @param share of the push in friction x weight; it rises over `ramp` steps if positive, else it is there
  /// at once.
  Result run(const double       share,
             const unsigned int slave,
             const unsigned int ramp,
             const unsigned int hold,
             const unsigned int free_steps)
  {
    ElasticMaterial material;
    material.young_modulus = 1e7;
    material.density       = 1000.;
    const Mesh mesh(
      MPI_COMM_WORLD,
      {tests::make_box("plane", Point<3>(-0.1, -0.06, -0.03), Point<3>(0.2, 0.06, 0.), {{17, 7, 1}},
                       {{tests::Side::bottom, Boundary::support}, {tests::Side::top, Boundary::contact}}),
       tests::make_box("block", Point<3>(-0.04, -0.04, 0.), Point<3>(0.04, 0.04, height), {{6, 6, 2}},
                       {{tests::Side::bottom, Boundary::contact}})});
    const Solid        solid(mesh, {material, material}, SolidParameters());
    DynamicsParameters dynamics_parameters;
    dynamics_parameters.gravity       = gravity;
    dynamics_parameters.damping_steps = 2.; // rings off within some hundred steps
    ExplicitDynamics dynamics(mesh, solid, dynamics_parameters);
    for (const Mesh::Cell &cell : mesh.cells)
      if (cell.body == 0)
        dynamics.fix_nodes(std::vector<unsigned int>(cell.nodes.begin(), cell.nodes.end()));
    ContactParameters contact_parameters;
    contact_parameters.slave_body        = slave;
    contact_parameters.solver.tolerance  = 1e-13;
    contact_parameters.solver.max_sweeps = 1000;
    Contact contact(mesh, contact_parameters, std::make_shared<CoulombFriction>(friction));
    dynamics.attach_contact(contact);

    Result     result{0., 0., 0., 0., 0.};
    const auto mean_x = [&] {
      double sum  = 0.;
      result.mass = 0.;
      for (unsigned int i = 0; i < dynamics.state.v.size(); ++i)
        if (mesh.node_bodies[i] == 1)
          {
            sum += dynamics.true_masses()[i] * dynamics.state.position(i)[0];
            result.mass += dynamics.true_masses()[i];
          }
      return sum / result.mass;
    };
    NodalField &external_force = dynamics.add<NodeLoads>().force;
    const auto  push = [&](const double factor) { // on every node by its mass, so that the block hardly tips
      for (unsigned int i = 0; i < dynamics.state.v.size(); ++i)
        if (mesh.node_bodies[i] == 1)
          external_force[i] =
            Vector3{factor * share * friction * gravity * dynamics.true_masses()[i], 0., 0., 0.};
    };

    dynamics.start();
    for (unsigned int n = 0; n < 4000; ++n)
      dynamics.step();
    const double x0 = mean_x(), loss0 = dynamics.ledger().friction;
    for (unsigned int n = 0; n < ramp; ++n)
      {
        push(double(n) / ramp);
        dynamics.step();
      }
    push(1.);
    for (unsigned int n = 0; n < hold; ++n)
      dynamics.step();
    result.pushed    = mean_x() - x0;
    result.push_time = hold * dynamics.state.time_step;
    for (unsigned int n = 0; n < ramp; ++n)
      {
        push(1. - double(n) / ramp);
        dynamics.step();
      }
    push(0.);
    for (unsigned int n = 0; n < free_steps; ++n)
      dynamics.step();
    result.residual      = mean_x() - x0;
    result.friction_loss = dynamics.ledger().friction - loss0;
    return result;
  }
} // namespace contact_return

TREAD_TEST(contact_return)(Check &check, const tests::Arguments &)
{
  for (const unsigned int slave : {1u, 0u})
    {
      const std::string name  = slave ? "slave block: " : "slave plane: ";
      const Result      stick = run(0.3, slave, 2000, 2000, 6000);
      // Uniform body force on a block that sticks below: mean shear displacement f h^2/(3 G), more as its
      // ends are free. Where few nodes of the plane carry the multipliers, the block's many are held in the
      // mean only: softer.
      const double shear = 0.3 * friction * gravity * 1000. * height * height / (3. * 1e7 / 2.6);
      std::printf("%sstick: %.3f um when pushed (shear alone %.3f um), %.3e um after\n", name.c_str(),
                  1e6 * stick.pushed, 1e6 * shear, 1e6 * stick.residual);
      check.relative(name + "stick: displacement when pushed, um", 1e6 * stick.pushed, 1e6 * shear,
                     slave ? 0.1 : 1.);
      // What is left is vibration that has not died out yet, and the solver's tolerance.
      check.below(name + "stick: left after release, share", stick.residual / stick.pushed, 1e-6);
      check.below(name + "stick: friction loss, share of work of the push",
                  stick.friction_loss / (0.5 * 0.3 * friction * gravity * stick.mass * stick.pushed), 1e-6);

      const Result slip = run(2., slave, 0, 1000, 6000);
      // Accelerates by (2 - 1) f g while pushed, then is braked by f g: as far again.
      const double a = friction * gravity, t = slip.push_time;
      std::printf("%sslip: %.3f mm when pushed, %.3f mm after\n", name.c_str(), 1e3 * slip.pushed,
                  1e3 * slip.residual);
      // Shear and tipping at start and stop: micrometres.
      check.relative(name + "slip: displacement when pushed, mm", 1e3 * slip.pushed, 1e3 * 0.5 * a * t * t,
                     0.02);
      check.relative(name + "slip: left after release, mm", 1e3 * slip.residual, 1e3 * a * t * t, 0.02);
      check.relative(name + "slip: friction loss, mJ", 1e3 * slip.friction_loss,
                     1e3 * friction * slip.mass * gravity * slip.residual, 5e-5);
      check.that(name + "slip is not taken for stick",
                 std::abs(slip.residual) > 1e-6 * std::abs(slip.pushed));
    }
}
