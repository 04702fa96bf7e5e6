// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact patch test: uniform pressure must pass through an interface whose meshes do not match (Taylor &
// Papadopoulos 1991), also where cells of one surface change their size and nodes hang.
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/parts/nodes.h>

#include <deal.II/base/mpi.h>

#include "check.h"
#include "fields.h"

#include <algorithm>

using namespace tread;
using tests::Check;
using tests::size;
using dealii::Point;

namespace contact_patch_test
{
  constexpr double edge = 0.02, pressure = 100e6; // m, Pa

  struct Case
  {
    std::string  name;
    unsigned int n_lower, n_upper; ///< cells an edge
    unsigned int slave;            ///< 0: lower
    double       tilt;             ///< of everything in space, rad
    int          refined = -1;     ///< this body has smaller cells in a half of the interface
  };

  /// Largest deviation of the contact pressure from the reference, share.
  double deviation(const std::vector<ContactNodeState> &states, const double damaged = 1.)
  {
    double largest = 0.;
    for (unsigned int i = 0; i < states.size(); ++i)
      {
        const double p = dot(states[i].impulse, states[i].normal) / states[i].area * (i == 0 ? damaged : 1.);
        largest        = std::max(largest, std::abs(p / pressure - 1.));
      }
    return largest;
  }

  const Point<3> axis(0.6, 0., 0.8); // about which everything is tilted

  std::vector<Body> bodies(const Case &test)
  {
    const Body lower = tests::turned(
      tests::make_box("lower", Point<3>(0., 0., -edge), Point<3>(edge, edge, 0.),
                      {{test.n_lower, test.n_lower, test.n_lower}},
                      {{tests::Side::bottom, Boundary::support}, {tests::Side::top, Boundary::contact}}),
      axis, test.tilt);
    const Body upper = tests::turned(
      tests::make_box("upper", Point<3>(0., 0., 0.), Point<3>(edge, edge, edge),
                      {{test.n_upper, test.n_upper, test.n_upper}},
                      {{tests::Side::bottom, Boundary::contact}, {tests::Side::top, Boundary::end}}),
      axis, test.tilt);
    std::vector<Body> both{lower, upper};
    if (test.refined >= 0)
      {
        const double cell                   = edge / (test.refined == 0 ? test.n_lower : test.n_upper);
        both[test.refined].wanted_cell_size = [cell](const Point<3> &p) {
          return p[0] < 0.49 * edge && std::abs(p[2]) < 1.01 * cell ? 0.6 * cell : edge;
        };
      }
    return both;
  }

  /// The pressure on the top of the upper body. @returns the loads, N
  const NodalField &load_top(const Case &test, const Vector3 up, const Mesh &mesh, ExplicitDynamics &dynamics)
  {
    NodalField &external_force = dynamics.add<NodeLoads>().force;
    for (const Mesh::Face &face : mesh.faces)
      if (face.body == 1 && face.boundary == Boundary::end)
        for (const unsigned int i : face.nodes) // all faces of the top are equal squares
          external_force[i] -= (pressure * edge * edge / (4. * test.n_upper * test.n_upper)) * up;
    mesh.shared_nodes.sum(external_force.data());
    return external_force;
  }

  /// On each body, N and N m.
  struct ContactForces
  {
    Vector3 force[2] = {}, moment[2] = {};
  };

  /// The forces that contact exerts in equilibrium, by difference.
  ContactForces contact_forces(const Mesh             &mesh,
                               const Solid            &solid,
                               const ExplicitDynamics &dynamics,
                               const NodalField       &external_force,
                               Contact                &contact)
  {
    NodalField       without(mesh.nodes.size(), Vector3{});
    const NodalField at_rest(mesh.nodes.size(), Vector3{});
    solid.add_internal_forces(dynamics.state.positions().data(), at_rest.data(), without.data());
    mesh.condense_hanging_nodes(without.data());
    mesh.shared_nodes.sum(without.data());
    for (unsigned int i = 0; i < without.size(); ++i)
      without[i] += external_force[i];
    NodalField          with = without;
    std::vector<double> nothing;
    contact.refresh(dynamics.state.positions().data(), at_rest.data(), 1.);
    contact.predict(at_rest.data(), without.data(), 1., nothing);
    contact.solve(1., with.data());

    ContactForces sum;
    for (unsigned int i = 0; i < with.size(); ++i)
      if (mesh.shared_nodes.is_owned(i))
        {
          sum.force[mesh.node_bodies[i]] += with[i] - without[i];
          sum.moment[mesh.node_bodies[i]] += cross(dynamics.state.position(i), with[i] - without[i]);
        }
    for (unsigned int b = 0; b < 2; ++b)
      {
        sum.force[b]  = tests::sum_over_ranks(sum.force[b], mesh.comm);
        sum.moment[b] = tests::sum_over_ranks(sum.moment[b], mesh.comm);
      }
    return sum;
  }

  /// Largest deviation of the cells' stresses from uniaxial pressure, share.
  double stress_deviation(const Solid            &solid,
                          const ExplicitDynamics &dynamics,
                          const Vector3           up,
                          const MPI_Comm          comm)
  {
    double largest = 0.;
    for (const std::array<double, 6> &s : solid.cauchy_stress(dynamics.state.positions().data()))
      {
        const double tensor[3][3] = {{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}};
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            largest = std::max(largest, std::abs(tensor[i][j] + pressure * up[i] * up[j]) / pressure);
      }
    return dealii::Utilities::MPI::max(largest, comm);
  }

  void run(const Case &test, const MPI_Comm comm, Check &check)
  {
    const Mesh      mesh(comm, bodies(test));
    ElasticMaterial material;
    material.poisson_ratio = 0.; // then uniaxial stress is exact with the bottom held in all directions
    const Solid        solid(mesh, {material, material}, SolidParameters());
    DynamicsParameters dynamics_parameters;
    dynamics_parameters.gravity = 0.;
    ExplicitDynamics dynamics(mesh, solid, dynamics_parameters);
    dynamics.fix_nodes(dynamics.support_nodes(0));
    if (test.refined >= 0) // not alike on both sides: the upper body would creep along the interface
      dynamics.guide_nodes(dynamics.boundary_nodes(1, Boundary::end), 0);

    ContactParameters contact_parameters;
    contact_parameters.slave_body        = test.slave;
    contact_parameters.solver.tolerance  = 1e-12;
    contact_parameters.solver.max_sweeps = 1000;
    Contact contact(mesh, contact_parameters, std::make_shared<CoulombFriction>(0.));
    dynamics.attach_contact(contact);

    const Point<3>     up_point = tests::turn(Point<3>(0., 0., 1.), axis, test.tilt);
    const Vector3      up{up_point[0], up_point[1], up_point[2], 0.};
    const NodalField  &external_force = load_top(test, up, mesh, dynamics);
    constexpr double   balance        = 1e-9; // of the relaxation, share of the load
    const unsigned int iterations     = dynamics.relax(balance, 20000, nullptr);
    const auto [force, moment]        = contact_forces(mesh, solid, dynamics, external_force, contact);
    const double load                 = pressure * edge * edge;

    const std::vector<ContactNodeState> states = contact.active_nodes();
    const unsigned int                  n      = test.slave == 0 ? test.n_lower : test.n_upper;
    // Of the 2 n + 1 nodes where the size changes n hang and have no row.
    const unsigned int n_rows =
      test.refined == int(test.slave) ? (n + 1) * (2 * n + 1) - n + (n / 2) * (n + 1) : (n + 1) * (n + 1);
    std::printf("%s: %u iterations\n", test.name.c_str(), iterations);
    check.absolute(test.name + ": loaded slave nodes", states.size(), n_rows, 0.);
    // Exact but for the relaxation (1e-9 of the load; single nodes and cells have a larger share of it) and
    // the strain of 5e-4 that turns the reference area into the present one.
    check.below(test.name + ": contact pressure, share", deviation(states), 1e-6);
    check.below(test.name + ": cell stresses, share", stress_deviation(solid, dynamics, up, comm), 1e-6);
    check.below(test.name + ": load - contact force, share", size(force[1] - load * up) / load, 1e-7);
    // Where faces touch in slivers, entries below 1e-10 of a row are left to its slave node.
    check.below(test.name + ": total impulse - contact force, share",
                size(contact.total_impulse() - force[1 - test.slave]) / load,
                test.refined >= 0 ? 1e-10 : 1e-12);
    // Every entry of a row is scaled and summed once: some 1e-16 for each of the nodes.
    check.below(test.name + ": sum of forces, share", size(force[0] + force[1]) / load, 1e-13);
    // Gaps are closed only as well as the bodies are in balance.
    check.below(test.name + ": sum of moments, share of load x edge",
                size(moment[0] + moment[1]) / (load * edge), 1e-9);
    check.that(test.name + ": 0.1 % at one node is noticed", deviation(states, 1.001) > 1e-6);
  }
} // namespace contact_patch_test

TREAD_TEST(contact_patch_test)(Check &check, const tests::Arguments &)
{
  for (const Case &test :
       {Case{"1:1", 4, 4, 0, 0.}, Case{"2:3, slave below", 2, 3, 0, 0.},
        Case{"2:3, slave above", 2, 3, 1, 0.}, Case{"2:3 tilted, slave below", 2, 3, 0, 0.7},
        Case{"2:3 tilted, slave above", 2, 3, 1, 0.7}, Case{"1:7, slave below", 1, 7, 0, 0.},
        Case{"1:7, slave above", 1, 7, 1, 0.}, Case{"4:3, refined slave below", 4, 3, 0, 0., 0},
        Case{"4:3, refined master below", 4, 3, 1, 0., 0}, Case{"3:4, refined slave above", 3, 4, 1, 0., 1}})
    run(test, MPI_COMM_WORLD, check);
}
