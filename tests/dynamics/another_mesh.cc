// SPDX-License-Identifier: LGPL-2.1-or-later
// A motion goes on with other cells: a wheel that turns as a rigid body goes on turning as one, and no energy
// is lost, though arcs have other nodes and other masses than chords.
#include <tread/base/archive.h>
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/parts/wheel.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include "check.h"
#include "driven_ring.h"
#include "fields.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

using namespace tread;

namespace dynamics_another_mesh
{
  /// Round where cells are halved, though its coarse cells have straight edges. @param is_refined at its
  /// lowest point
  Body round_ring(const bool is_refined)
  {
    Body body = tests::make_driven_ring();
    if (!is_refined)
      body.wanted_cell_size = [](const dealii::Point<3> &) {
        return std::numeric_limits<double>::max();
      };
    body.to_space = [](const dealii::Point<3> &p) {
      constexpr double of_cell = 2. * dealii::numbers::PI / 36;
      const double angle = std::atan2(p[0], -p[2]), middle = (std::floor(angle / of_cell) + 0.5) * of_cell,
                   longer = std::cos(angle - middle) / std::cos(0.5 * of_cell);
      return dealii::Point<3>(longer * p[0], p[1], longer * p[2]);
    };
    return body;
  }

  /// A ring that turns about a skew axle which moves on, with all that belongs to it.
  struct Turning
  {
    Mesh             mesh;
    Solid            solid;
    WheelHub         hub;
    ExplicitDynamics dynamics;

    Turning(const Body &ring, const double density_scale)
      : mesh(MPI_COMM_WORLD, {ring})
      , solid(mesh,
              {ElasticMaterial()},
              [&] {
                SolidParameters p;
                p.density_scale = density_scale;
                return p;
              }())
      , hub(tests::sprung_hub())
      , dynamics(mesh, solid, [&] {
        DynamicsParameters p;
        p.density_scale = density_scale;
        return p;
      }())
    {
      constexpr double yaw = 0.2, roll = -0.1; // rad
      hub.place(Vector3{}, yaw, roll);
      hub.motion.velocity_x       = 30.;
      hub.motion.angular_velocity = 60.;
      hub.motion.angle            = 0.3;
      dynamics.add<WheelOnHub>(hub, 0, 60.);
    }
  };

  Vector3 reference_of(const Turning &wheel, const unsigned int node)
  {
    const dealii::Point<3> &p = wheel.mesh.nodes[node];
    return Vector3{p[0], p[1], p[2], 0.};
  }

  /// Velocity of a node that is fixed to the hub, at the instant of the velocities, m/s.
  Vector3 half_a_step_ago(const Turning &wheel, const unsigned int node)
  {
    const State  &state = wheel.dynamics.state;
    const Vector3 x     = state.position(node);
    return wheel.hub.velocity_at(x -
                                 0.5 * state.time_step * (wheel.hub.velocity_at(x) - wheel.hub.velocity()));
  }
} // namespace dynamics_another_mesh


TREAD_TEST(dynamics_another_mesh)(tests::Check &check, const tests::Arguments &)
{
  using namespace dynamics_another_mesh;
  for (const double density_scale : {1., 25.})
    for (const bool is_refined : {true, false})
      {
        const std::string name = std::string(is_refined ? "finer" : "coarser") + " cells, density times " +
                                 (density_scale > 1. ? "25: " : "1: ");
        Turning before(round_ring(!is_refined), density_scale), behind(round_ring(is_refined), density_scale);
        State  &state    = before.dynamics.state;
        const auto place = [&] {
          for (unsigned int i = 0; i < state.v.size(); ++i)
            state.set_position(i, before.hub.position_of(reference_of(before, i)));
        };
        place();
        before.dynamics.start(); // finds the time step
        for (unsigned int i = 0; i < state.v.size(); ++i)
          state.v[i] = half_a_step_ago(before, i);
        place(); // what is kept are positions ahead of these by the damping's time
        Archive kept(MPI_COMM_WORLD);
        before.dynamics.serialize_parts(kept);
        Archive found(MPI_COMM_WORLD, kept.stored_by_all());
        behind.dynamics.serialize_parts(found);
        behind.dynamics.go_on_from(before.dynamics);

        const State &now = behind.dynamics.state;
        double       off = 0., off_speed = 0., moved = 0.;
        for (unsigned int i = 0; i < now.v.size(); ++i)
          {
            const Vector3 x = now.position(i);
            off             = std::max(off, tests::size(x - behind.hub.position_of(reference_of(behind, i))));
            off_speed       = std::max(off_speed, tests::size(now.v[i] - half_a_step_ago(behind, i)));
            moved           = std::max(moved, tests::size(x - reference_of(behind, i)));
          }
        using dealii::Utilities::MPI::max;
        check.below(name + "nodes off the rigid wheel's, m", max(off, MPI_COMM_WORLD), 1e-12);
        check.below(name + "velocities off the rigid wheel's, m/s", max(off_speed, MPI_COMM_WORLD), 1e-4);
        check.that(name + "the wheel has turned", max(moved, MPI_COMM_WORLD) > 0.1);
        const EnergyLedger ledger = behind.dynamics.ledger();
        const double       mass =
          behind.dynamics.masses_of_bodies()[0].own - before.dynamics.masses_of_bodies()[0].own;
        check.that(name + "mass comes or goes", (is_refined ? mass : -mass) > 0.01);
        // Forces act over half a step, which is not as long with other cells.
        check.below(name + "energy lost over that of the mass that comes",
                    std::abs(ledger.window) / (std::abs(mass) * density_scale * 30. * 30.),
                    density_scale > 1. ? 2e-3 : 2e-5);
      }
}
