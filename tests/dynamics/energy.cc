// SPDX-License-Identifier: LGPL-2.1-or-later
// The energy ledger must close: the work of prescribed forces and weight equals kinetic, strain and hourglass
// energy plus the energy dissipated by damping.
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/parts/added_mass.h>
#include <tread/dynamics/parts/nodes.h>
#include <tread/dynamics/parts/wheel.h>
#include <tread/solid/fully_integrated.h>
#include <tread/solid/one_point.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include "check.h"
#include "driven_ring.h"
#include "fields.h"

#include <algorithm>

using namespace tread;
using dealii::Point;

namespace dynamics_energy
{
  struct Case
  {
    const char *name;
    double      damping_steps, viscosity, gravity;
    std::string type;
  };

  /// A ring that a hub drives at 60 rad/s under its suspension, loaded at its lowest point: the hub's part of
  /// the ledger. @param step_factor by which mass added to the fastest cells makes the step longer
  void hub_energy(tests::Check  &check,
                  const Drive    drive,
                  const double   density_scale,
                  const double   mass_damping,
                  const Guidance guidance    = Guidance::rigid,
                  const double   step_factor = 1.)
  {
    const Mesh      mesh(MPI_COMM_WORLD, {tests::make_driven_ring()});
    SolidParameters solid_parameters;
    solid_parameters.density_scale = density_scale;
    if (step_factor > 1.)
      {
        const Solid untouched(mesh, {ElasticMaterial()}, solid_parameters);
        double      fastest = 0.;
        for (const double frequency : untouched.cell_frequencies())
          fastest = std::max(fastest, frequency);
        solid_parameters.highest_frequency = dealii::Utilities::MPI::max(fastest, mesh.comm) / step_factor;
      }
    const Solid        solid(mesh, {ElasticMaterial()}, solid_parameters);
    DynamicsParameters parameters;
    parameters.density_scale                 = density_scale;
    parameters.mass_damping                  = mass_damping;
    parameters.steps_between_damping_samples = 1;
    ExplicitDynamics dynamics(mesh, solid, parameters);
    WheelHub         hub(tests::sprung_hub());
    hub.motion.velocity_x       = 27.6;
    hub.motion.angular_velocity = 60.;
    hub.drive                   = drive;
    hub.drive_torque            = 20000.;
    // A wheelset's middle lies beside its wheel.
    if (guidance != Guidance::rigid)
      hub.place(Vector3{0., -.7, 0., 0.});
    hub.parameters.yaw_inertia = 90.;
    // 0.3 mm, 2 and 1 mrad, at 150 Hz.
    const auto waves = [](const double time) -> Across {
      const double wave = 1. - std::cos(2. * dealii::numbers::PI * 150. * time);
      return {.15e-3 * wave, 1e-3 * wave, .5e-3 * wave, 60. + wave};
    };
    if (guidance == Guidance::file)
      hub.guidance.follow(waves);
    else if (guidance == Guidance::springs)
      hub.guidance.release({3e7, 1e4, 2e7, 1e3, 3e5, 5e4}, hub.motion.yaw);
    const CarriesBody &carrier = dynamics.add<WheelOnHub>(hub, 0, 60.);
    if (solid.may_add_mass())
      dynamics.add<AddedMassOnWheel>(carrier);
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      dynamics.state.v[i] = hub.velocity_at(dynamics.state.position(i));
    const std::vector<char> hanging        = tests::which_hang(mesh);
    NodalField             &external_force = dynamics.add<NodeLoads>().force;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (!hanging[i] && mesh.nodes[i][2] < -.46 + 1e-3)
        external_force[i] = Vector3{-500., 200., 5000., 0.};
    dynamics.start();
    double       worst = 0., worst_of_damping = 0.;
    EnergyLedger ledger;
    for (unsigned int n = 1; n <= 3000; ++n)
      {
        dynamics.step();
        if (n > 500 && n % 130 == 0)
          {
            ledger           = dynamics.ledger();
            worst            = std::max(worst, std::abs(ledger.residual_share()));
            worst_of_damping = std::max(worst_of_damping, std::abs(ledger.residual() / ledger.damping));
          }
      }
    std::printf(
      "hub: %u steps, work %.5g J (gross %.5g), kinetic %.5g, strain %.4g, hourglass %.4g, damping %.4g, "
      "residual %.2g J\n",
      unsigned(dynamics.state.n_steps), ledger.external_work, ledger.gross_work, ledger.kinetic,
      ledger.strain, ledger.hourglass, ledger.damping, ledger.residual());
    const std::string name = std::string("hub, ") + (drive == Drive::torque ? "torque" : "creepage") +
                             ", density times " + std::to_string(int(density_scale)) + ", mass damping " +
                             std::to_string(int(mass_damping)) +
                             (guidance == Guidance::file      ? ", moved across"
                              : guidance == Guidance::springs ? ", free across"
                                                              : "") +
                             (step_factor > 1. ? ", mass added to the fastest cells" : "");
    if (guidance != Guidance::rigid)
      std::printf("moved by %.3g mm, yaw %.3g mrad, roll %.3g mrad\n", 1e3 * hub.motion.y,
                  1e3 * hub.motion.yaw, 1e3 * hub.motion.roll);
    // A ledger begins with its start, whatever was before; what the cells hold is held still.
    const double held = dealii::Utilities::MPI::sum(
      solid.strain_energy(dynamics.state.positions().data()).hourglass, mesh.comm);
    dynamics.start();
    const EnergyLedger anew = dynamics.ledger();
    check.below(name + ": work after another start, share", anew.external_work / ledger.gross_work, 1e-12);
    check.below(name + ": strain and hourglass energy gained since then, J",
                std::abs(anew.strain) + std::abs(anew.hourglass), 1e-12);
    check.relative(name + ": hourglass energy held, J", anew.stored_hourglass, held, 1e-9);
    // A torque and a file make kilojoules of kinetic energy, and mass added on one side hundreds of joules,
    // which damping is no measure for.
    if (drive == Drive::torque || guidance != Guidance::rigid || step_factor > 1.)
      check.below(name + ": residual/gross work", worst, guidance == Guidance::rigid ? 5e-6 : 6e-5);
    else
      check.below(name + ": residual/damping", worst_of_damping, 0.01);
  }

  /// A hub that is thrown up under its sprung mass: both swing against each other about their common middle.
  void sprung_hub_alone(tests::Check &check)
  {
    WheelHubParameters parameters = tests::sprung_hub();
    parameters.gravity            = 0.;
    WheelHub hub(parameters);
    hub.place(Vector3{});
    hub.motion.velocity_z = .2;
    const double step = 2e-6, end = 0.02, hub_mass = parameters.mass, above = parameters.sprung_mass;
    for (unsigned int n = 0; n < end / step; ++n)
      hub.advance(Vector3{}, Vector3{}, step);
    const double reduced   = hub_mass * above / (hub_mass + above),
                 decay     = .5 * parameters.suspension_damping / reduced,
                 frequency = std::sqrt(parameters.suspension_stiffness / reduced - decay * decay);
    check.relative("sprung hub: from the mass above, mm", 1e3 * (hub.motion.z - hub.motion.sprung_z),
                   1e3 * .2 / frequency * std::exp(-decay * end) * std::sin(frequency * end), 1e-3);
    check.relative("sprung hub: momentum, kg m/s",
                   hub_mass * hub.motion.velocity_z + above * hub.motion.sprung_velocity, .2 * hub_mass,
                   1e-12);
  }

  /// A hub that settles on springs, up and about x: both as fast, with m x'' = -k x - c (x' - w) and 4 m w' =
  /// c (x' - w), c^2 = k m. Cells that it carries count as mass for damper and companion.
  void settling_hub(tests::Check &check)
  {
    constexpr double   stiffness = 2e9, time = 3e-4, arm = .75, lift = 5e-5, roll = 4e-5;
    WheelHubParameters parameters = tests::sprung_hub();
    parameters.gravity            = 0.;
    parameters.sprung_mass = parameters.suspension_stiffness = parameters.suspension_damping = 0.;
    parameters.yaw_inertia = parameters.roll_inertia = 90.;
    parameters.settling                              = {stiffness, time, arm};
    WheelHub hub(parameters);
    hub.place(Vector3{0., 0., lift, 0.}, 0., roll);
    const double per_roll = stiffness * arm * arm,
                 energy   = .5 * (stiffness * lift * lift + per_roll * roll * roll);
    const double step     = 1e-8;
    const auto   n_steps  = static_cast<unsigned int>(.4 * time / step);
    for (unsigned int n = 0; n < n_steps; ++n)
      hub.advance(Vector3{0., 0., -stiffness * hub.motion.z, 0.},
                  Vector3{per_roll * hub.motion.roll, 0., 0., 0.}, step);
    // By the roots of (s^2 + s + 1)(s + 1/4) - s/4, after 0.4 periods.
    constexpr double left = -0.130485;
    check.relative("settling hub: what is left of a lift", hub.motion.z / lift, left, 2e-3);
    check.relative("settling hub: what is left of a roll", hub.motion.roll / roll, left, 2e-3);
    const double held =
      .5 * (stiffness * hub.motion.z * hub.motion.z + per_roll * hub.motion.roll * hub.motion.roll);
    check.relative("settling hub: work of its dampers, mJ", 1e3 * hub.external_work(),
                   1e3 * (hub.kinetic_energy(0.) + held - energy), 2e-3);

    // On springs whose other end rises evenly it rises with it, and they carry nothing.
    WheelHub rising(parameters);
    rising.place(Vector3{});
    constexpr double speed   = .02;
    double           carried = 0.;
    for (unsigned int n = 0; n < 10 * n_steps; ++n)
      {
        carried = stiffness * (speed * n * step - rising.motion.z);
        rising.advance(Vector3{0., 0., carried, 0.}, Vector3{}, step);
      }
    check.below("settling hub that rises: what its springs carry over the damper's force at rest",
                std::abs(carried) / (parameters.settling->damping() * speed), 0.01);
    check.relative("settling hub that rises: speed, mm/s", 1e3 * rising.motion.velocity_z, 1e3 * speed, 0.01);

    const double  mass = stiffness * time * time / (4. * std::numbers::pi * std::numbers::pi);
    SettlingOfHub settling{stiffness, time, arm};
    check.relative("settling hub: mass, kg", settling.mass(), mass, 1e-12);
    settling.cell_mass = 3.;
    check.relative("settling hub with cells: damping, kN s/m", 1e-3 * settling.damping(),
                   1e-3 * std::sqrt(stiffness * (mass + 3.)), 1e-12);
    check.relative("settling hub with cells: mass of the companion, kg", settling.companion_mass(),
                   4. * (mass + 3.), 1e-12);
    settling.carried_mass = 2. * mass;
    check.relative("settling hub: mass where carried nodes have more, kg", settling.mass(), 2. * mass, 1e-12);
  }

  /// A hub alone on its guidance: damped oscillations across the track and in yaw.
  void free_hub(tests::Check &check)
  {
    WheelHubParameters parameters = tests::sprung_hub();
    parameters.gravity            = 0.;
    parameters.yaw_inertia        = 90.;
    WheelHub hub(parameters);
    hub.place(Vector3{}, .02, .01);
    const GuidanceSprings springs{4e6, 5e3, 3e6, 2e3, 0., 0.};
    hub.guidance.release(springs, hub.motion.yaw);
    hub.motion.velocity_y = .1;
    hub.motion.yaw_rate   = .3;
    const double step = 2e-7, end = 0.05;
    const double energy = .5 * parameters.mass * .1 * .1 + .5 * parameters.yaw_inertia * .3 * .3;
    for (unsigned int n = 0; n < end / step; ++n)
      hub.advance(Vector3{}, Vector3{}, step);
    // x'' + 2 d x' + w^2 x = 0 from x = 0
    const auto at_end = [&](const double speed, const double inertia, const double stiffness,
                            const double damping) {
      const double d = .5 * damping / inertia, w = std::sqrt(stiffness / inertia - d * d);
      return speed / w * std::exp(-d * end) * std::sin(w * end);
    };
    check.relative("free hub: lateral shift, mm", 1e3 * hub.motion.y,
                   1e3 * at_end(.1, parameters.mass, springs.stiffness, springs.damping), 4e-4);
    check.relative("free hub: yaw, mrad", 1e3 * (hub.motion.yaw - .02),
                   1e3 * at_end(.3, parameters.yaw_inertia, springs.yaw_stiffness, springs.yaw_damping),
                   4e-4);
    check.relative("free hub: work of the guidance, J", hub.external_work(), hub.kinetic_energy(0.) - energy,
                   1e-12);
    check.relative("free hub: the axle turns with the yaw", -hub.axle()[0], std::sin(hub.motion.yaw), 1e-14);
  }
} // namespace dynamics_energy


TREAD_TEST(dynamics_energy)(tests::Check &check, const tests::Arguments &)
{
  const ElasticMaterial steel;
  hub_energy(check, Drive::torque, 1., 0.);
  hub_energy(check, Drive::creepage, 1., 0.);
  hub_energy(check, Drive::torque, 4., 0.);
  // The reaction of mass damping acts on the hub, which moves 1e4 times as fast as the nodes do on top of it.
  hub_energy(check, Drive::creepage, 1., 2000.);
  hub_energy(check, Drive::creepage, 1., 0., Guidance::file);
  hub_energy(check, Drive::creepage, 4., 2000., Guidance::file);
  hub_energy(check, Drive::torque, 1., 0., Guidance::springs);
  hub_energy(check, Drive::torque, 1., 0., Guidance::rigid, 2.);
  hub_energy(check, Drive::creepage, 1., 0., Guidance::rigid, 2.);
  hub_energy(check, Drive::creepage, 1., 0., Guidance::file, 2.);
  hub_energy(check, Drive::torque, 1., 0., Guidance::springs, 2.);
  free_hub(check);
  sprung_hub_alone(check);
  settling_hub(check);
  Body body = tests::make_box("block", Point<3>(), Point<3>(.06, .02, .02), {{6, 2, 2}},
                              {{tests::Side::left, Boundary::support}});
  tests::refine_near(body, Point<3>(.06, .02, .02), .012, .005);
  const Mesh mesh(MPI_COMM_WORLD, {body});
  check.that("mesh has hanging nodes", mesh.n_global_hanging_nodes > 0);

  // The nodes of the end face that do not hang share the load alike: what the ledger sums does not depend on
  // how.
  const std::vector<char> hanging = tests::which_hang(mesh);

  for (const Case &c : {Case{"no damping", 0., 0., 0., OnePoint::name},
                        Case{"stiffness damping 0.1", .1, 0., 0., OnePoint::name},
                        Case{"stiffness damping 1", 1., 0., 0., OnePoint::name},
                        Case{"stiffness damping 0.1, fully integrated", .1, 0., 0., FullyIntegrated::name},
                        Case{"bulk viscosity", 0., 1., 0., OnePoint::name},
                        Case{"both and weight", .1, 1., 9.81e4, OnePoint::name}})
    {
      SolidParameters solid_parameters;
      solid_parameters.element                  = c.type;
      solid_parameters.linear_bulk_viscosity    = .06 * c.viscosity;
      solid_parameters.quadratic_bulk_viscosity = 1.2 * c.viscosity;
      DynamicsParameters parameters;
      parameters.damping_steps                 = c.damping_steps;
      parameters.gravity                       = c.gravity;
      parameters.steps_between_damping_samples = 1;
      const Solid      solid(mesh, {steel}, solid_parameters);
      ExplicitDynamics dynamics(mesh, solid, parameters);
      dynamics.fix_nodes(dynamics.support_nodes(0));
      NodalField &external_force = dynamics.add<NodeLoads>().force;
      dynamics.start();

      // A push that starts and ends smoothly within half a period of the first bending mode, then free
      // ringing.
      const double duration = 100e-6, force = 500.;
      double       worst = 0., damping = 0., last_damping = 0., gross = 0.;
      bool         damping_grows = true;
      EnergyLedger ledger;
      while (dynamics.state.time < 1000e-6)
        {
          const double s = dynamics.state.time / duration;
          const double f = s < 1. ? 0.5 * (1. - std::cos(2. * dealii::numbers::PI * s)) * force : 0.;
          for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
            if (!hanging[i] && mesh.nodes[i][0] > .06 - 1e-9)
              external_force[i] = Vector3{.5 * f, 0., f, 0.};
          dynamics.step();
          // Not a multiple of the steps between the ledger's own samples of damping, and rarer than these.
          if (dynamics.state.n_steps % 130 == 0)
            {
              ledger = dynamics.ledger();
              if (s >= 1.)
                worst = std::max(worst, std::abs(ledger.residual_share()));
              damping_grows = damping_grows && ledger.damping >= last_damping - 1e-6 * ledger.gross_work;
              last_damping  = ledger.damping;
            }
        }
      damping = ledger.damping;
      gross   = ledger.gross_work;
      std::printf(
        "%s: %u steps, work %.4g mJ (gross %.4g), kinetic %.4g, strain %.4g, hourglass %.4g, damping %.4g, "
        "residual %.2g mJ\n",
        c.name, unsigned(dynamics.state.n_steps), 1e3 * ledger.external_work, 1e3 * gross,
        1e3 * ledger.kinetic, 1e3 * ledger.strain, 1e3 * ledger.hourglass, 1e3 * damping,
        1e3 * ledger.residual());
      // All of this work is the push's; without damping the ledger closes to 1e-7 of it.
      check.below(std::string(c.name) + ": residual/gross work", worst, 2e-5);
      if (c.damping_steps > 0. || c.viscosity > 0.)
        {
          check.that(std::string(c.name) + ": damping takes energy", damping > 1e-3 * gross);
          check.that(std::string(c.name) + ": damping never gives", damping_grows);
        }
      else
        check.below(std::string(c.name) + ": damping/gross work", damping / gross, 0.);
    }
}
