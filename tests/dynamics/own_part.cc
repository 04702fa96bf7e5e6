// SPDX-License-Identifier: LGPL-2.1-or-later
// How a part is added: a magnet that pulls the upper face of a body. Beside what stands here, a program that
// has it needs a function in the list of model/parts.cc. A cube that flies towards it has the energy that the
// magnet's potential has lost.
#include <tread/base/reproducible_sum.h>
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/part.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"
#include "check.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace tread;
using dealii::Point;

namespace dynamics_own_part
{
  // The part.

  /// A magnet above a body. It pulls each node of the body's uppermost face upwards with a force that falls
  /// with the square of the distance.
  class Magnet : public Part
  {
  public:
    /// @param height z of the magnet, m; @param strength of a node, N m^2. Collective.
    Magnet(const PartOf &part_of, const unsigned int body, const double height, const double strength)
      : of(part_of)
      , height(height)
      , strength(strength)
    {
      const auto is_of_body = [&](const unsigned int i) {
        return of.mesh.node_bodies[i] == body && of.true_mass[i] > 0.; // hanging nodes have none
      };
      double top = std::numeric_limits<double>::lowest();
      for (unsigned int i = 0; i < of.mesh.nodes.size(); ++i)
        if (is_of_body(i))
          top = std::max(top, of.mesh.nodes[i][2]);
      top                 = dealii::Utilities::MPI::max(top, of.mesh.comm);
      constexpr double nm = 1e-9;
      for (unsigned int i = 0; i < of.mesh.nodes.size(); ++i)
        if (is_of_body(i) && of.mesh.nodes[i][2] > top - nm)
          nodes.push_back(i);
    }

    std::vector<unsigned int> nodes_of_every_step() const override
    {
      return nodes;
    }
    void add_forces(NodalField &force) override
    {
      add_spring_forces(force);
    }
    void add_spring_forces(NodalField &force) const override
    {
      for (const unsigned int i : nodes)
        if (of.mesh.shared_nodes.is_owned(i)) // the sum over the ranks tells the copies
          force[i][2] += of.quanta.force.round(strength / (distance(i) * distance(i)));
    }
    double spring_energy() const override
    {
      ReproducibleSum<double> energy;
      for (const unsigned int i : nodes)
        if (of.mesh.shared_nodes.is_owned(i))
          energy.add(-strength / distance(i));
      return energy.value(of.mesh.comm);
    }
    /// Its stiffness is negative. The sums take its amount, which is on the safe side.
    void add_row_sums(NodalField &rows) const override
    {
      for (const unsigned int i : nodes)
        if (of.mesh.shared_nodes.is_owned(i))
          rows[i][0] += of.quanta.stiffness.round(2. * strength / std::pow(distance(i), 3));
    }

  private:
    double distance(const unsigned int i) const ///< m
    {
      return height - of.state.position(i)[2];
    }

    const PartOf              of;
    const double              height, strength;
    std::vector<unsigned int> nodes; ///< of this rank
  };
} // namespace dynamics_own_part


TREAD_TEST(dynamics_own_part)(tests::Check &check, const tests::Arguments &)
{
  constexpr double      edge = 10e-3, gap = 1e-3, force = 100.; // m, m, N at first
  constexpr unsigned    n = 4, n_face = (n + 1) * (n + 1);
  const Mesh            mesh(MPI_COMM_WORLD,
                             {tests::make_box("cube", Point<3>(), Point<3>(edge, edge, edge), {{n, n, n}})});
  const ElasticMaterial steel;
  const Solid           solid(mesh, {steel}, SolidParameters());
  DynamicsParameters    parameters;
  parameters.gravity                       = 0.;
  parameters.steps_between_damping_samples = 1;
  ExplicitDynamics dynamics(mesh, solid, parameters);
  const double     strength = force / n_face * gap * gap;
  dynamics.add<Magnet>(0u, edge + gap, strength);
  dynamics.start();
  for (unsigned int step = 0; step < 700; ++step)
    dynamics.step();

  // The cube as a whole, half a step back, where its velocities are.
  double way = 0., velocity = 0., mass = 0.;
  for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
    if (mesh.shared_nodes.is_owned(i))
      {
        const double m = dynamics.true_masses()[i];
        mass += m;
        velocity += m * dynamics.state.v[i][2];
        way += m * (dynamics.state.position(i)[2] - mesh.nodes[i][2]);
      }
  for (double *sum : {&way, &velocity, &mass})
    *sum = dealii::Utilities::MPI::sum(*sum, mesh.comm);
  velocity /= mass;
  way = way / mass - 0.5 * dynamics.state.time_step * velocity;
  std::printf("%u steps, %.3g ms: it has come %.4g of %.4g mm nearer, at %.4g m/s\n",
              unsigned(dynamics.state.n_steps), 1e3 * dynamics.state.time, 1e3 * way, 1e3 * gap, velocity);
  check.that("it has come nearer by a tenth of the gap or more", way > 0.1 * gap);
  check.relative("mass of the cube, g", 1e3 * mass, 1e3 * steel.density * std::pow(edge, 3), 1e-9);
  // What the face comes nearer is what the cube does but for its strain, some 1e-6.
  const double gained = n_face * strength * (1. / (gap - way) - 1. / gap);
  check.relative("energy of the flight, mJ: what the magnet's potential has lost",
                 1e3 * 0.5 * mass * velocity * velocity, 1e3 * gained, 2e-3);

  const EnergyLedger ledger = dynamics.ledger();
  const double       now    = way + 0.5 * dynamics.state.time_step * velocity;
  check.relative("the ledger's potential, mJ", 1e3 * ledger.springs,
                 -1e3 * n_face * strength * (1. / (gap - now) - 1. / gap), 2e-3);
  check.below("energy residual over the kinetic energy", std::abs(ledger.residual()) / ledger.kinetic, 1e-4);
}
