// SPDX-License-Identifier: LGPL-2.1-or-later
// A block on an inclined plane (gravity is vertical, so the plane is tilted): sticks or slides as Coulomb
// says.
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"
#include "check.h"

using namespace tread;
using tests::Check;
using dealii::Point;

namespace contact_incline
{
  constexpr double gravity = 9.81, slope = 0.35; // m/s^2, rad
  constexpr double length = 0.08, height = 0.02; // of the block, m

  struct Case
  {
    double       friction, tolerance; ///< of the solver
    unsigned int slave;
    bool         elastic_plane;
    unsigned int steps_before, steps; ///< the first ones are not looked at
  };

  struct Result
  {
    double slide, acceleration, drift, friction_loss, normal_impulse, seconds; ///< m, m/s^2, m, J, N s, s
    double mass;
    unsigned int n_steps;
  };

  Result run(const Case &test)
  {
    // Soft and light, so that steps are long.
    ElasticMaterial material;
    material.young_modulus = 3e7;
    material.density       = 1000.;
    const Point<3> axis(0., 1., 0.);
    const Mesh     mesh(
          MPI_COMM_WORLD,
          {tests::turned(
             tests::make_box("plane", Point<3>(0., -0.06, -0.03), Point<3>(0.9, 0.06, 0.), {{60, 7, 1}},
                             {{tests::Side::bottom, Boundary::support}, {tests::Side::top, Boundary::contact}}),
             axis, slope),
           tests::turned(tests::make_box("block", Point<3>(0.05, -0.04, 0.),
                                         Point<3>(0.05 + length, 0.04, height), {{6, 6, 2}},
                                         {{tests::Side::bottom, Boundary::contact}}),
                         axis, slope)});
    const Solid        solid(mesh, {material, material}, SolidParameters());
    DynamicsParameters dynamics_parameters;
    dynamics_parameters.gravity       = gravity;
    dynamics_parameters.damping_steps = 0.5;
    ExplicitDynamics dynamics(mesh, solid, dynamics_parameters);
    if (test.elastic_plane)
      dynamics.fix_nodes(dynamics.support_nodes(0));
    else
      for (const Mesh::Cell &cell : mesh.cells)
        if (cell.body == 0)
          dynamics.fix_nodes(std::vector<unsigned int>(cell.nodes.begin(), cell.nodes.end()));
    ContactParameters contact_parameters;
    contact_parameters.slave_body        = test.slave;
    contact_parameters.solver.tolerance  = test.tolerance;
    contact_parameters.solver.max_sweeps = 1000;
    Contact contact(mesh, contact_parameters, std::make_shared<CoulombFriction>(test.friction));
    dynamics.attach_contact(contact);
    dynamics.start();

    const Vector3 down{std::cos(slope), 0., -std::sin(slope), 0.};
    Result        result{0., 0., 0., 0., 0., 0., 0., 0};
    const auto    mean = [&](const NodalField &field) {
      double sum  = 0.;
      result.mass = 0.;
      for (unsigned int i = 0; i < field.size(); ++i)
        if (mesh.node_bodies[i] == 1)
          {
            sum += dynamics.true_masses()[i] * dot(field[i], down);
            result.mass += dynamics.true_masses()[i];
          }
      return sum / result.mass;
    };
    // Nodes of the block that touch, for the drift in stick.
    std::vector<unsigned int> touching;
    for (const Mesh::Face &face : mesh.faces)
      if (face.body == 1 && face.boundary == Boundary::contact)
        touching.insert(touching.end(), face.nodes.begin(), face.nodes.end());

    for (unsigned int n = 0; n < test.steps_before; ++n)
      dynamics.step();
    const double v0 = mean(dynamics.state.v), x0 = mean(dynamics.state.positions()), t0 = dynamics.state.time,
                 loss0      = dynamics.ledger().friction;
    const NodalField before = dynamics.state.positions();
    for (unsigned int n = 0; n < test.steps; ++n)
      {
        dynamics.step();
        const Vector3 p = contact.total_impulse();
        result.normal_impulse += std::abs(p[2] * std::cos(slope) + p[0] * std::sin(slope));
      }
    result.seconds       = dynamics.state.time - t0;
    result.slide         = mean(dynamics.state.positions()) - x0;
    result.acceleration  = (mean(dynamics.state.v) - v0) / result.seconds;
    result.friction_loss = dynamics.ledger().friction - loss0;
    result.n_steps       = dynamics.state.n_steps;
    for (const unsigned int i : touching)
      result.drift = std::max(result.drift, std::abs(dot(dynamics.state.position(i) - before[i], down)));
    return result;
  }
} // namespace contact_incline

TREAD_TEST(contact_incline)(Check &check, const tests::Arguments &)
{
  for (const bool elastic : {false, true})
    for (const unsigned int slave : {1u, 0u})
      {
        const std::string name = std::string(elastic ? "elastic plane, " : "rigid plane, ") +
                                 (slave ? "slave block: " : "slave plane: ");
        // The plane's own weight and the block's landing ring off within some thousand steps.
        const double friction = 0.2;
        const Result r        = run({friction, 1e-8, slave, elastic, 500, elastic ? 7000u : 9000u});
        const double a        = gravity * (std::sin(slope) - friction * std::cos(slope));
        const double normal   = r.mass * gravity * std::cos(slope);
        std::printf("%sslid %.1f mm in %.1f ms\n", name.c_str(), 1e3 * r.slide, 1e3 * r.seconds);
        // Vibration that lasts; the weight itself is exact.
        check.relative(name + "acceleration, m/s2", r.acceleration, a, 0.01);
        check.relative(name + "normal force, N", r.normal_impulse / r.seconds, normal, 0.01);
        check.relative(name + "friction loss, mJ", 1e3 * r.friction_loss, 1e3 * friction * normal * r.slide,
                       0.01);
        check.that(name + "it slid over more than one face", r.slide > 0.015);
        check.that(
          name + "friction wrong by 2 % is noticed",
          std::abs(r.acceleration / (gravity * (std::sin(slope) - 1.02 * friction * std::cos(slope))) - 1.) >
            0.01);
      }
  // tan(slope) = 0.365.
  for (const double friction : {0.40, 0.8})
    for (const unsigned int slave : {1u, 0u})
      {
        const std::string name = "friction " + std::to_string(friction).substr(0, 4) +
                                 (slave ? ", slave block: " : ", slave plane: ");
        const Result r = run({friction, 1e-14, slave, false, 5000, 10000});
        // Stick is a condition on velocities: what creeps is what the solver leaves, here round-off.
        check.below(name + "drift in 1e4 steps, share of length", r.drift / length, 1e-9);
        check.below(name + "friction loss, share of weight x height",
                    r.friction_loss / (r.mass * gravity * height), 1e-9);
      }
  const Result loose = run({0.40, 1e-5, 1, false, 5000, 10000});
  check.below("usual tolerance: drift in 1e4 steps, share of length", loose.drift / length, 1e-6);
}
