// SPDX-License-Identifier: LGPL-2.1-or-later
// A round block falls onto a plate that has contact faces on a strip only: inside the strip, at its border
// and outside it.
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"
#include "check.h"

#include <cmath>

using namespace tread;
using dealii::Point;

namespace contact_rim
{
  constexpr double border = 10e-3; // of the strip, m

  /// Whether anything was touched, and where at the rim.
  struct Result
  {
    bool                   touched = false;
    std::optional<Vector3> at_rim;
  };

  std::vector<Body> bodies(const double y)
  {
    Body plate = tests::make_box("plate", Point<3>(0., -0.02, -0.01), Point<3>(0.04, 0.02, 0.), {{16, 16, 2}},
                                 {{tests::Side::bottom, Boundary::support}});
    plate.boundary_at = [before = plate.boundary_at](const Point<3> &p) {
      return p[2] > -1e-9 && std::abs(p[1]) < border ? Boundary::contact : before(p);
    };
    Body round     = tests::make_box("round", Point<3>(0.01, y - 0.012, 0.), Point<3>(0.03, y + 0.012, 0.01),
                                     {{7, 11, 3}}, {{tests::Side::bottom, Boundary::contact}});
    round.to_space = [y](const Point<3> &p) {
      return Point<3>(p[0], p[1], p[2] + 1e-6 + 10. * (p[1] - y) * (p[1] - y));
    };
    return {plate, round};
  }

  Result fall(const MPI_Comm comm, const double y, const unsigned int slave = ContactParameters().slave_body)
  {
    const Mesh         mesh(comm, bodies(y));
    const Solid        solid(mesh, {ElasticMaterial(), ElasticMaterial()}, SolidParameters());
    DynamicsParameters parameters;
    parameters.gravity = 0.;
    ExplicitDynamics  dynamics(mesh, solid, parameters);
    ContactParameters contact_parameters;
    contact_parameters.slave_body = slave;
    Contact contact(mesh, contact_parameters, std::make_shared<CoulombFriction>(0.3));
    dynamics.fix_nodes(dynamics.support_nodes(0));
    dynamics.attach_contact(contact);
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == 1)
        dynamics.state.v[i] = Vector3{0., 0., -1., 0.};
    dynamics.start();
    Result result;
    for (unsigned int step = 0; step < 60; ++step)
      {
        dynamics.step();
        result.touched = result.touched || contact.total_impulse()[2] > 0.;
        if (!result.at_rim)
          result.at_rim = contact.contact_at_rim();
      }
    return result;
  }
} // namespace contact_rim

TREAD_TEST(contact_rim)(tests::Check &check, const tests::Arguments &)
{
  const Mesh            mesh(MPI_COMM_WORLD, bodies(0.));
  const ContactSurfaces surfaces(mesh);
  unsigned int          n_rim = 0, n_wrong = 0;
  for (const ContactSurfaces::Node &node : surfaces.nodes)
    if (node.body == 0)
      {
        n_rim += node.at_rim;
        n_wrong += node.at_rim != (std::abs(std::abs(node.reference[1]) - border) < 1e-9);
      }
  check.absolute("nodes at the strip's two borders", n_rim, 2 * 17, 0.);
  check.absolute("others taken for such, or such not found", n_wrong, 0., 0.);

  const Result inside = fall(MPI_COMM_WORLD, 2e-3), at_border = fall(MPI_COMM_WORLD, 9.5e-3),
               beside = fall(MPI_COMM_WORLD, 0.03);
  check.that("inside the strip: touches", inside.touched);
  check.that("inside the strip: not at the rim", !inside.at_rim);
  check.that("near its border: touches the rim", at_border.at_rim.has_value());
  if (at_border.at_rim)
    check.absolute("near its border: where, mm", 1e3 * (*at_border.at_rim)[1], 1e3 * border, 0.01);
  check.that("near its border, the plate as master: touches the rim",
             fall(MPI_COMM_WORLD, 9.3e-3, 1).at_rim.has_value());
  check.that("inside the strip, the plate as master: not at the rim", !fall(MPI_COMM_WORLD, 2e-3, 1).at_rim);
  check.that("beside the strip nothing is touched", !beside.touched && !beside.at_rim);
}
