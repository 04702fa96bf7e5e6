// SPDX-License-Identifier: LGPL-2.1-or-later
// A rail's base that moves on springs and dampers: a block of steel on it, which a force pushes up and aside
// from one instant on, swings as a mass on these springs does.
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/parts/nodes.h>
#include <tread/dynamics/parts/rail_base.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"
#include "check.h"

#include <algorithm>
#include <cmath>

using namespace tread;
using dealii::Point;

namespace track_rail_base
{
  /// Of a mass on a spring and a damper, after a force has begun to act: m.
  double swing(const double mass, const SpringAndDamper &on, const double force, const double time)
  {
    const double decay = 0.5 * on.damping / mass, frequency = std::sqrt(on.stiffness / mass - decay * decay);
    return force / on.stiffness *
           (1. - std::exp(-decay * time) *
                   (std::cos(frequency * time) + decay / frequency * std::sin(frequency * time)));
  }
} // namespace track_rail_base


TREAD_TEST(track_rail_base)(tests::Check &check, const tests::Arguments &)
{
  constexpr double cell = 0.02, height = 3 * cell, length = 4 * cell, width = 2 * cell;
  const Mesh       mesh(MPI_COMM_WORLD, {tests::make_box("rail", Point<3>(), Point<3>(length, width, height),
                                                         {{4, 2, 3}}, {{tests::Side::bottom, Boundary::support}})});
  const Solid      solid(mesh, {ElasticMaterial()}, SolidParameters());
  DynamicsParameters parameters;
  parameters.gravity                       = 0.;
  parameters.steps_between_damping_samples = 1;
  ExplicitDynamics         dynamics(mesh, solid, parameters);
  const RailBaseParameters track{20., {100e6, 40e3}, {30e6, 15e3}};
  RailBase                 base(track);
  dynamics.add<RailOnBase>(base, 0);
  NodalField &external_force = dynamics.add<NodeLoads>().force;
  dynamics.start();

  const Vector3 force{0., -3e3, 20e3, 0.}; // N
  const auto    is_top = [&](const unsigned int i) {
    return mesh.nodes[i][2] > height - 1e-6;
  };
  double n_top = 0.;
  for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
    if (mesh.shared_nodes.is_owned(i))
      n_top += is_top(i);
  n_top = dealii::Utilities::MPI::sum(n_top, MPI_COMM_WORLD);
  for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
    if (is_top(i))
      external_force[i] = (1. / n_top) * force;

  // The mass of the nodes that the base carries, half of the lowest cells, is in that of the base.
  const double block  = ElasticMaterial().density * length * width * (height - 0.5 * cell);
  const double moving = track.mass + block, end = 6e-3; // kg, s
  double       worst_up = 0., worst_aside = 0., worst_residual = 0.;
  while (dynamics.state.time < end)
    {
      dynamics.step();
      if (dynamics.state.n_steps % 500 != 0)
        continue;
      const Vector3 moved = base.displacement();
      worst_up =
        std::max(worst_up, std::abs(moved[2] - swing(moving, track.vertical, force[2], dynamics.state.time)));
      worst_aside = std::max(
        worst_aside, std::abs(moved[1] - swing(moving, track.lateral, force[1], dynamics.state.time)));
      const EnergyLedger ledger = dynamics.ledger();
      worst_residual            = std::max(worst_residual, std::abs(ledger.residual_share()));
    }
  check.below("up: largest difference from a mass on a spring, share of the static way",
              worst_up * track.vertical.stiffness / force[2], 2e-3);
  check.below("aside: likewise", worst_aside * track.lateral.stiffness / std::abs(force[1]), 6e-3);
  check.below("energy not accounted for, share of the work", worst_residual, 1e-7);
}
