// SPDX-License-Identifier: LGPL-2.1-or-later
// Damping dissipates the correct energy: a pulsating cube has one frequency and decays at a rate that is
// known for damping in proportion to stiffness and to mass; the ledger counts exactly the energy that the
// motion loses.
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include "boxes.h"
#include "check.h"

#include <algorithm>
#include <cmath>

using namespace tread;
using dealii::Point;

namespace dynamics_damping
{
  constexpr double edge = 0.01; // m

  struct Decay
  {
    double rate;     ///< of the energy, 1/s
    double counted;  ///< damping work over the energy lost
    double residual; ///< over the damping work
    double largest;  ///< residual of all steps, over the damping work at the end
  };

  /// @param share of the time step of the critical one; damping in time steps and in 1/s.
  Decay decay(const double       share,
              const double       damping_steps,
              const double       mass_damping,
              double            &beta,
              const unsigned int steps_between_samples = 1)
  {
    const Mesh            mesh(MPI_COMM_SELF,
                               {tests::make_box("cube", Point<3>(), Point<3>(edge, edge, edge), {{1, 1, 1}})});
    const ElasticMaterial steel;
    const Solid           solid(mesh, {steel}, SolidParameters());
    DynamicsParameters    parameters;
    parameters.courant_number                = share;
    parameters.damping_steps                 = damping_steps;
    parameters.mass_damping                  = mass_damping;
    parameters.gravity                       = 0.;
    parameters.steps_between_damping_samples = steps_between_samples;
    ExplicitDynamics dynamics(mesh, solid, parameters);
    double           energy = 0.;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      {
        const double per_m = 1e-3 / edge; // small strain: 1 mm/s at the faces makes some 1e-8
        for (unsigned int d = 0; d < 3; ++d)
          dynamics.state.v[i][d] = per_m * (mesh.nodes[i][d] - 0.5 * edge);
        energy += 0.5 * dynamics.true_masses()[i] * dot(dynamics.state.v[i], dynamics.state.v[i]);
      }
    dynamics.start();
    beta = damping_steps * dynamics.state.time_step;
    // U = V (9 lambda + 6 mu)/2 e^2, K = rho V (3 edge^2/4)/2 (de/dt)^2.
    const double frequency =
      std::sqrt(4. * (3. * steel.lame() + 2. * steel.shear_modulus()) / steel.density) / edge;
    const double duration = 20. * dealii::numbers::PI / frequency; // ten whole periods
    double       largest  = 0.;
    while (dynamics.state.time < duration)
      {
        dynamics.step();
        largest = std::max(largest, std::abs(dynamics.ledger().residual()));
      }
    const EnergyLedger ledger = dynamics.ledger();
    const double       lost   = -(ledger.kinetic + ledger.strain + ledger.hourglass);
    std::printf("%u steps, %.4g nJ at first, lost %.4g nJ, damping %.4g nJ\n",
                unsigned(dynamics.state.n_steps), 1e9 * energy, 1e9 * lost, 1e9 * ledger.damping);
    return {-std::log(1. - lost / energy) / dynamics.state.time, ledger.damping / lost,
            ledger.residual() / ledger.damping, largest / ledger.damping};
  }

  /// Bulk viscosity of a cube whose edges change at the same rate, from the forces on its corners: that of
  /// von Neumann & Richtmyer (1950) and Landshoff (1955), b1 rho c h tr + b2 rho h^2 tr^2 in compression.
  void check_bulk_viscosity(tests::Check &check)
  {
    constexpr double      linear = 0.06, quadratic = 1.2;
    const ElasticMaterial steel;
    const Mesh            mesh(MPI_COMM_SELF,
                               {tests::make_box("cube", Point<3>(), Point<3>(edge, edge, edge), {{1, 1, 1}})});
    for (const double density_scale : {1., 4.})
      for (const double trace : {3e4, -3e4}) // 1/s: both parts are of the same order
        {
          SolidParameters parameters;
          parameters.linear_bulk_viscosity    = linear;
          parameters.quadratic_bulk_viscosity = quadratic;
          parameters.density_scale            = density_scale;
          const Solid solid(mesh, {steel}, parameters);
          NodalField  x(mesh.nodes.size()), v(mesh.nodes.size()), force(mesh.nodes.size(), Vector3{});
          for (unsigned int i = 0; i < x.size(); ++i)
            for (unsigned int d = 0; d < 3; ++d)
              {
                x[i][d] = mesh.nodes[i][d];
                v[i][d] = trace / 3. * mesh.nodes[i][d];
              }
          solid.add_internal_forces(x.data(), v.data(), force.data());
          const double density = density_scale * steel.density;
          const double tension = linear * density * steel.pressure_wave_speed() * edge * trace -
                                 (trace < 0. ? quadratic * density * edge * edge * trace * trace : 0.);
          double worst = 0.;
          for (unsigned int i = 0; i < x.size(); ++i)
            for (unsigned int d = 0; d < 3; ++d)
              {
                // A quarter of each face's force, inwards for a tension.
                const double expected =
                  (mesh.nodes[i][d] > 0.5 * edge ? -0.25 : 0.25) * edge * edge * tension;
                worst = std::max(worst, std::abs(force[i][d] / expected - 1.));
              }
          check.below("bulk viscosity, density times " + std::to_string(int(density_scale)) +
                        (trace < 0. ? ", compressed: share" : ", expanded: share"),
                      worst, 1e-12);
        }
  }
} // namespace dynamics_damping


TREAD_TEST(dynamics_damping)(tests::Check &check, const tests::Arguments &)
{
  const ElasticMaterial steel;
  const double square = 4. * (3. * steel.lame() + 2. * steel.shear_modulus()) / (steel.density * edge * edge);
  double       beta   = 0.;
  // Central differences with Omega dt = 0.2 and less shift frequency and rate by (Omega dt)^2/8 or 0.5 %.
  const Decay of_stiffness = decay(.1, .05, 0., beta);
  check.relative("stiffness damping: rate of decay, 1/ms", 1e-3 * of_stiffness.rate, 1e-3 * beta * square,
                 0.01);
  check.relative("stiffness damping: counted over lost", of_stiffness.counted, 1., 1e-6);
  check.below("stiffness damping: residual over the damping", of_stiffness.residual, 1e-6);
  // In between power is taken to change in a straight line, from the last sample to the row.
  const Decay sampled = decay(.02, .05, 0., beta, 7);
  check.below("sampled in every 7th step: largest residual of all steps over the damping", sampled.largest,
              5e-4);
  const double alpha   = 2000.;
  const Decay  of_mass = decay(.05, 0., alpha, beta);
  check.relative("mass damping: rate of decay, 1/ms", 1e-3 * of_mass.rate, 1e-3 * alpha, 0.01);
  // It is counted with the velocities before a step, (Omega dt)^2/4 or 0.25 % too much.
  check.relative("mass damping: counted over lost", of_mass.counted, 1., 0.005);
  check.below("mass damping: residual over the damping", of_mass.residual, 0.005);
  const Decay both = decay(.1, .05, alpha, beta);
  check.relative("both: rate of decay, 1/ms", 1e-3 * both.rate, 1e-3 * (alpha + beta * square), 0.01);
  // At the Courant number of runs, where each step counts.
  const Decay fast = decay(.9, .1, 0., beta);
  check.below("Courant number 0.9: residual over the damping", fast.residual, 1e-5);
  check_bulk_viscosity(check);
}
