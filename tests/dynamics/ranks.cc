// SPDX-License-Identifier: LGPL-2.1-or-later
// The same history on any number of ranks: the result that all ranks compute together is compared with that
// of each rank alone.
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/parts/nodes.h>
#include <tread/dynamics/parts/wheel.h>
#include <tread/solid/fully_integrated.h>
#include <tread/solid/one_point.h>

#include <deal.II/base/mpi.h>

#include "check.h"
#include "driven_ring.h"
#include "fields.h"

#include <algorithm>
#include <array>
#include <map>

using namespace tread;
using dealii::Point;

namespace dynamics_ranks
{
  struct History
  {
    /// Displacement (m) and velocity (m/s) by Mesh::node_key(): the numbers of nodes differ between ranks.
    std::map<std::array<long long, 4>, std::array<double, 6>> nodes;
    std::vector<double>                                       tip; ///< kinetic + strain energy (J) on the way
    WheelHub::Motion                                          hub;
    unsigned int                                              n_cells = 0, n_hanging = 0;
    double largest_share = 0.;                     ///< of what the cells cost, over the mean of the ranks
    double imbalance = 0., counted_imbalance = 0.; ///< imbalance_of_cost(), and step by step
  };

  struct Case
  {
    const char  *name;
    bool         with_hub;
    std::string  type;
    bool         reproducible;
    unsigned int max_level;
  };

  /// What the dearest rank's cells cost over the mean of the ranks, each step with the cells of its levels.
  double step_by_step(const Mesh           &mesh,
                      const Solid          &solid,
                      const Mesh::CellCost &cost,
                      const unsigned int    n_steps)
  {
    double slowest = 0., mean = 0.;
    for (unsigned int step = 0; step < n_steps; ++step)
      {
        double of_rank = 0.;
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          if (step % (1u << solid.cell_levels()[c]) == 0)
            of_rank += cost(mesh.cells[c].body, mesh.corners(c), 0);
        const auto of_ranks = dealii::Utilities::MPI::min_max_avg(of_rank, mesh.comm);
        slowest += of_ranks.max;
        mean += of_ranks.avg;
      }
    return slowest / mean;
  }

  History run(const MPI_Comm comm, const Case &c, const unsigned int n_steps)
  {
    const bool        with_hub = c.with_hub;
    const std::string type     = c.type;
    Body              body;
    if (with_hub)
      body = tests::make_driven_ring();
    else
      {
        body = tests::make_box("block", Point<3>(), Point<3>(.06, .03, .03), {{6, 3, 3}},
                               {{tests::Side::left, Boundary::support}});
        tests::refine_near(body, Point<3>(.06, .03, .03), .012, .005);
      }
    // One end of the body costs four times as much as the rest, over a million steps, so that sharing it
    // pays.
    const auto cost = [](const unsigned int, const auto &corners, const unsigned int) {
      return corners[0][0] > .03 ? 4e6 : 1e6;
    };
    const Mesh mesh(comm, {body}, c.max_level, cost);
    double     share = 0.;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      share += cost(0, mesh.corners(c), 0);
    const auto      shares = dealii::Utilities::MPI::min_max_avg(share, comm);
    SolidParameters solid_parameters;
    solid_parameters.element      = type;
    solid_parameters.reproducible = c.reproducible;
    solid_parameters.max_level    = c.max_level;
    if (type == OnePoint::name)
      {
        solid_parameters.linear_bulk_viscosity    = .06;
        solid_parameters.quadratic_bulk_viscosity = 1.2;
      }
    const Solid        solid(mesh, {ElasticMaterial()}, solid_parameters);
    DynamicsParameters parameters;
    parameters.courant_number = 0.7;
    if (c.max_level > 0)
      parameters.mass_damping = 50.;
    ExplicitDynamics dynamics(mesh, solid, parameters);

    WheelHub hub(tests::sprung_hub());
    if (with_hub)
      {
        hub.motion.velocity_x       = 30.;
        hub.motion.angular_velocity = 60.;
        hub.drive                   = Drive::torque;
        hub.drive_torque            = 5000.;
        dynamics.add<WheelOnHub>(hub, 0, 60.);
        for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
          dynamics.state.v[i] = hub.velocity_at(dynamics.state.position(i));
      }
    else
      dynamics.fix_nodes(dynamics.support_nodes(0));

    const std::vector<char> hanging        = tests::which_hang(mesh);
    NodalField             &external_force = dynamics.add<NodeLoads>().force;
    const double            extreme        = with_hub ? -.46 + 1e-3 : .03 - 1e-9;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (!hanging[i] && (with_hub ? mesh.nodes[i][2] < extreme : mesh.nodes[i][2] > extreme))
        external_force[i] = Vector3{300., -200., 1000., 0.};

    dynamics.start();
    History history;
    for (unsigned int n = 1; n <= n_steps; ++n)
      {
        dynamics.step();
        if (n % (n_steps / 20) == 0)
          {
            const EnergyLedger ledger = dynamics.ledger();
            history.tip.push_back(ledger.kinetic + ledger.strain + ledger.hourglass);
            history.tip.push_back(ledger.external_work);
            history.tip.push_back(ledger.damping);
          }
      }
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      history.nodes[mesh.node_key(i)] = {
        {dynamics.state.position(i)[0] - mesh.nodes[i][0], dynamics.state.position(i)[1] - mesh.nodes[i][1],
         dynamics.state.position(i)[2] - mesh.nodes[i][2], dynamics.state.v[i][0], dynamics.state.v[i][1],
         dynamics.state.v[i][2]}};
    history.hub       = hub.motion;
    history.n_cells   = mesh.n_global_cells;
    history.n_hanging = mesh.n_global_hanging_nodes;

    history.largest_share     = shares.max / shares.avg;
    history.imbalance         = dynamics.imbalance_of_cost(cost);
    history.counted_imbalance = step_by_step(mesh, solid, cost, 8);
    std::printf("shares of the ranks: %g to %g\n", shares.min, shares.max);
    return history;
  }

  /// Ranks add what they know of a node in one order, so that all copies of it have the same bits.
  void copies_are_the_same(tests::Check &check)
  {
    using namespace dealii::Utilities::MPI;
    const Mesh   mesh(MPI_COMM_WORLD,
                      {tests::make_box("block", Point<3>(), Point<3>(.06, .06, .06), {{6, 6, 6}})});
    NodalField   field(mesh.nodes.size());
    const double rank = this_mpi_process(mesh.comm);
    for (unsigned int i = 0; i < field.size(); ++i)
      for (unsigned int d = 0; d < 3; ++d)
        field[i][d] = std::sin((1. + rank) * (17. + 1e3 * mesh.nodes[i][d]));
    mesh.shared_nodes.sum(field.data());
    std::map<std::array<long long, 4>, std::array<double, 3>> own;
    for (const unsigned int i : mesh.shared_nodes.nodes())
      own[mesh.node_key(i)] = {{field[i][0], field[i][1], field[i][2]}};
    unsigned int n_copies = 0, n_other = 0;
    for (const auto &of_rank : all_gather(mesh.comm, own))
      for (const auto &[key, value] : of_rank)
        if (const auto here = own.find(key); here != own.end())
          {
            ++n_copies;
            n_other += here->second != value;
          }
    check.absolute("copies of nodes with other bits", sum(n_other, mesh.comm), 0., 0.);
    check.that("there are copies", n_mpi_processes(mesh.comm) == 1 || n_copies > 2 * own.size() - 1);
  }

  /// A rank may hold a node of a boundary without a face of it, where the boundary ends at what it holds.
  void nodes_know_their_boundary(tests::Check &check)
  {
    constexpr unsigned int n     = 8;
    constexpr double       size  = 0.01;
    unsigned int           wrong = 0;
    for (unsigned int end = 1; end < n; ++end)
      {
        Body       body = tests::make_box("bar", Point<3>(), Point<3>(n * size, size, size), {{n, 1, 1}});
        const auto held = [x_end = end * size](const double x) {
          return x < x_end + 1e-9;
        };
        body.boundary_at = [held](const Point<3> &p) {
          return p[2] < 1e-9 && held(p[0]) ? Boundary::support : Boundary::free;
        };
        const Mesh        mesh(MPI_COMM_WORLD, {body});
        std::vector<char> found(mesh.nodes.size(), false);
        for (const unsigned int i : mesh.boundary_nodes(0, Boundary::support))
          found[i] = true;
        for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
          wrong += (mesh.nodes[i][2] < 1e-9 && held(mesh.nodes[i][0])) != bool(found[i]);
      }
    check.absolute("nodes of a boundary that a rank does not know",
                   dealii::Utilities::MPI::sum(wrong, MPI_COMM_WORLD), 0., 0.);
  }
} // namespace dynamics_ranks


TREAD_TEST(dynamics_ranks)(tests::Check &check, const tests::Arguments &)
{
  using dealii::Utilities::MPI::max;

  copies_are_the_same(check);
  nodes_know_their_boundary(check);

  // Those that are not reproducible to the last bit: sums over ranks differ in order, 1e-16 a step, and
  // rounding of positions (1e-17 m) over displacements of um.
  for (const Case &c : {Case{"block", false, OnePoint::name, false, 0},
                        Case{"block, fully integrated", false, FullyIntegrated::name, false, 0},
                        Case{"ring on a hub", true, OnePoint::name, false, 0},
                        Case{"the same bits, block, levels", false, OnePoint::name, true, 2},
                        Case{"the same bits, fully integrated", false, FullyIntegrated::name, true, 0},
                        Case{"the same bits, ring, levels", true, OnePoint::name, true, 2}})
    {
      const unsigned int n_steps  = c.reproducible ? 400 : 2000;
      const double       allowed  = c.reproducible ? 0. : 1e-10;
      const History      together = run(MPI_COMM_WORLD, c, n_steps);
      const History      alone    = run(MPI_COMM_SELF, c, n_steps);
      // Scales: the largest displacement and velocity anywhere.
      double scale[2] = {0., 0.}, error[2] = {0., 0.}, missing = 0.;
      for (const auto &[p, value] : alone.nodes)
        for (unsigned int d = 0; d < 6; ++d)
          scale[d / 3] = std::max(scale[d / 3], std::abs(value[d]));
      for (const auto &[p, value] : together.nodes)
        {
          const auto same = alone.nodes.find(p);
          if (same == alone.nodes.end())
            ++missing;
          else
            for (unsigned int d = 0; d < 6; ++d)
              error[d / 3] = std::max(error[d / 3], std::abs(value[d] - same->second[d]) / scale[d / 3]);
        }
      const std::string name = std::string(c.name) + ": ";
      std::printf("%s%u cells, %u hanging nodes, largest displacement %.4g um, velocity %.4g m/s\n",
                  name.c_str(), alone.n_cells, alone.n_hanging, 1e6 * scale[0], scale[1]);
      // Eight siblings stay together.
      check.below(name + "largest share of the cells' cost over the mean", together.largest_share, 1.15);
      check.relative(name + "imbalance of cost", together.imbalance, together.counted_imbalance, 1e-12);
      check.relative(name + "imbalance of cost of one rank", alone.imbalance, 1., 1e-12);
      check.that(name + "has hanging nodes", alone.n_hanging > 0);
      check.absolute(name + "cells", together.n_cells, alone.n_cells, 0.);
      check.absolute(name + "hanging nodes", together.n_hanging, alone.n_hanging, 0.);
      check.absolute(name + "nodes in other places", max(missing, MPI_COMM_WORLD), 0., 0.);
      check.below(name + "displacement", max(error[0], MPI_COMM_WORLD), allowed);
      check.below(name + "velocity", max(error[1], MPI_COMM_WORLD), allowed);
      check.below(name + "energies", tests::difference(together.tip, alone.tip), allowed);
      if (c.with_hub)
        {
          check.relative(name + "hub height (um)", 1e6 * together.hub.z, 1e6 * alone.hub.z, allowed);
          check.relative(name + "angular velocity (rad/s)", together.hub.angular_velocity,
                         alone.hub.angular_velocity, 1e-2 * allowed);
        }
    }
}
