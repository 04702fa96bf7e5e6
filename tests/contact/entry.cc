// SPDX-License-Identifier: LGPL-2.1-or-later
// Nodes that come to touch within a step slip until they do, and adhere for the rest of it.
#include <tread/dynamics/explicit_dynamics.h>

#include "boxes.h"
#include "check.h"

using namespace tread;
using tests::Check;
using dealii::Point;

namespace contact_entry
{
  struct Result
  {
    double along, across, down; ///< velocities of the block's nodes after the step over those before
    double largest_slip = 0.;   ///< of pairs while they touch, m/s
    bool   all_adhere   = true;
    double n_touching;
  };

  /// A block that approaches a plane and moves along it. @param share of the step that passes before it
  /// touches.
  Result approach(const double share, const unsigned int slave)
  {
    constexpr double gap = 1e-6, size = 0.02, along = 0.01, across = -0.007; // m, m/s
    ElasticMaterial  material;
    material.young_modulus = 1e7;
    material.density       = 1000.;
    const Mesh mesh(
      MPI_COMM_WORLD,
      {tests::make_box("plane", Point<3>(-size, -size, -size), Point<3>(2. * size, 2. * size, 0.),
                       {{3, 3, 1}}, {{tests::Side::top, Boundary::contact}}),
       tests::make_box("block", Point<3>(0., 0., gap), Point<3>(size, size, size), {{1, 1, 1}},
                       {{tests::Side::bottom, Boundary::contact}})});
    const Solid        solid(mesh, {material, material}, SolidParameters());
    DynamicsParameters dynamics_parameters;
    dynamics_parameters.gravity       = 0.;
    dynamics_parameters.damping_steps = 0.;
    ExplicitDynamics          dynamics(mesh, solid, dynamics_parameters);
    std::vector<unsigned int> plane;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == 0)
        plane.push_back(i);
    dynamics.fix_nodes(plane);
    ContactParameters contact_parameters;
    contact_parameters.slave_body        = slave;
    contact_parameters.solver.tolerance  = 1e-13;
    contact_parameters.solver.max_sweeps = 1000;
    Contact contact(mesh, contact_parameters, std::make_shared<CoulombFriction>(5.));
    dynamics.attach_contact(contact);
    dynamics.start();
    const double down = -gap / (share * dynamics.state.time_step);
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == 1)
        dynamics.state.v[i] = Vector3{along, across, down, 0.};
    dynamics.step();
    Result result{0., 0., 0., 0., true, 0.};
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == 1 && mesh.nodes[i][2] < 0.5 * size)
        {
          result.along += 0.25 * dynamics.state.v[i][0] / along;
          result.across += 0.25 * dynamics.state.v[i][1] / across;
          result.down += 0.25 * dynamics.state.v[i][2] / down;
        }
    for (const ContactNodeState &node : contact.active_nodes())
      {
        result.n_touching += 1.;
        result.all_adhere   = result.all_adhere && node.adhesion;
        result.largest_slip = std::max(result.largest_slip, norm(node.slip));
      }
    return result;
  }
} // namespace contact_entry


TREAD_TEST(contact_entry)(Check &check, const tests::Arguments &)
{
  for (const double share : {0.1, 0.3, 0.85})
    {
      char name[60];
      std::snprintf(name, sizeof name, "touches after %g of the step: ", share);
      const Result r = approach(share, 1);
      // Forces of cells begin with the next step; what is left is the sweeps' tolerance.
      check.relative(std::string(name) + "velocity down", r.down, share, 1e-9);
      check.relative(std::string(name) + "velocity along", r.along, share, 1e-9);
      check.relative(std::string(name) + "velocity across", r.across, share, 1e-9);
      check.absolute(std::string(name) + "nodes that touch", r.n_touching, 4., 0.);
      check.that(std::string(name) + "all adhere", r.all_adhere);
      check.below(std::string(name) + "their slip while they touch, m/s", r.largest_slip, 1e-12);
    }
  const Result later = approach(1.2, 1);
  check.relative("touches in the next step: velocity along", later.along, 1., 1e-12);
  check.absolute("touches in the next step: nodes that touch", later.n_touching, 0., 0.);
}
