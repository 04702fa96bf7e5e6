// SPDX-License-Identifier: LGPL-2.1-or-later
// Longitudinal impact of two bars: waves of uniform stress, known in closed form (St. Venant 1867).
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"
#include "check.h"

using namespace tread;
using tests::Check;
using dealii::Point;

namespace contact_bars
{
  constexpr double edge = 0.004; // of the square cross-section, m

  struct Bars
  {
    std::string  name;
    double       length[2];
    unsigned int n_along[2], n_across[2];
  };

  struct Impact
  {
    double stress, duration, restitution, energy_loss; ///< Pa, s, -, share
    double gap;                                        ///< largest of nodes that touch, after any step, m
  };

  Impact run(const Bars &bars, const double relative_speed, const ElasticMaterial &material)
  {
    const Mesh         mesh(MPI_COMM_WORLD,
                            {tests::make_box("left", Point<3>(-bars.length[0], 0., 0.), Point<3>(0., edge, edge),
                                             {{bars.n_along[0], bars.n_across[0], bars.n_across[0]}},
                                             {{tests::Side::right, Boundary::contact}}),
                             tests::make_box("right", Point<3>(0., 0., 0.), Point<3>(bars.length[1], edge, edge),
                                             {{bars.n_along[1], bars.n_across[1], bars.n_across[1]}},
                                             {{tests::Side::left, Boundary::contact}})});
    const Solid        solid(mesh, {material, material}, SolidParameters());
    DynamicsParameters dynamics_parameters;
    dynamics_parameters.gravity = 0.;
    dynamics_parameters.damping_steps =
      0.; // a tenth of a step takes 4 % of the energy out of these sharp fronts
    ExplicitDynamics dynamics(mesh, solid, dynamics_parameters);
    Contact          contact(mesh, ContactParameters(), std::make_shared<CoulombFriction>(0.3));
    dynamics.attach_contact(contact);

    const std::vector<unsigned int> &body_of = mesh.node_bodies;
    for (unsigned int i = 0; i < dynamics.state.v.size(); ++i)
      dynamics.state.v[i] = Vector3{(body_of[i] == 0 ? 0.5 : -0.5) * relative_speed, 0., 0., 0.};
    // A third of what they approach in a step.
    for (unsigned int i = 0; i < dynamics.state.v.size(); ++i)
      if (body_of[i] == 1)
        dynamics.state.set_position(i, dynamics.state.position(i) + Vector3{1e-7, 0., 0., 0.});
    dynamics.start();

    // Between a tenth and nine tenths of the shorter bar's round trip the stress is uniform.
    const double round_trip = 2. * std::min(bars.length[0], bars.length[1]) / material.pressure_wave_speed();
    double       last = 0., plateau = 0., gap = 0.;
    const double start_kinetic = 0.25 * material.density * edge * edge * (bars.length[0] + bars.length[1]) *
                                 0.5 * relative_speed * relative_speed;
    while (dynamics.state.time < 3. * round_trip)
      {
        const double begin = dynamics.state.time;
        dynamics.step();
        const double now = contact.total_impulse()[0];
        for (const ContactNodeState &state : contact.active_nodes())
          gap = std::max(gap, std::abs(state.gap));
        // Bars of unlike lengths stay together without stress, so the end is where it falls below half.
        if (now > 0.25 * material.density * material.pressure_wave_speed() * relative_speed * edge * edge *
                    dynamics.state.time_step)
          last = dynamics.state.time;
        if (begin > 0.1 * round_trip && begin < 0.9 * round_trip)
          plateau += now;
      }
    const double steps = std::floor(0.9 * round_trip / dynamics.state.time_step) -
                         std::floor(0.1 * round_trip / dynamics.state.time_step);
    Vector3 momentum[2] = {};
    double  mass[2]     = {};
    for (unsigned int i = 0; i < dynamics.state.v.size(); ++i)
      {
        momentum[body_of[i]] += dynamics.true_masses()[i] * dynamics.state.v[i];
        mass[body_of[i]] += dynamics.true_masses()[i];
      }
    const EnergyLedger energy = dynamics.ledger();
    return {plateau / (steps * dynamics.state.time_step * edge * edge), last,
            (momentum[1][0] / mass[1] - momentum[0][0] / mass[0]) / relative_speed,
            (energy.contact + energy.damping) / start_kinetic, gap};
  }
} // namespace contact_bars

TREAD_TEST(contact_bars)(Check &check, const tests::Arguments &)
{
  ElasticMaterial material;
  material.poisson_ratio = 0.;
  const double speed = 2., c = material.pressure_wave_speed();
  const double stress = material.density * c * speed / 2., duration = 0.2 / c;
  check.relative("closed form: stress, MPa", 1e-6 * stress, 40.47, 2e-4);
  check.relative("closed form: duration, us", 1e6 * duration, 38.54, 2e-4);

  // The nodes that meet are massive: the impact loses their energy, half a cell of each bar or 0.5 % in all,
  // and waves that lag behind the front on these meshes stay as vibration with about as much.
  for (const Bars &bars : {Bars{"alike, 1:1", {0.1, 0.1}, {100, 100}, {1, 1}},
                           Bars{"alike, 2:3 across, slave coarse", {0.1, 0.1}, {100, 150}, {2, 3}},
                           Bars{"alike, 3:2 across, slave fine", {0.1, 0.1}, {150, 100}, {3, 2}},
                           Bars{"lengths 1:2", {0.1, 0.2}, {100, 200}, {1, 1}},
                           Bars{"lengths 2:1, 2:3 across", {0.2, 0.1}, {200, 150}, {2, 3}}})
    {
      const Impact impact = run(bars, speed, material);
      const bool   alike  = bars.length[0] == bars.length[1];
      std::printf("%s: energy lost in contact and damping: %.2f %%\n", bars.name.c_str(),
                  100. * impact.energy_loss);
      check.relative(bars.name + ": stress, MPa", 1e-6 * impact.stress, 1e-6 * stress, 5e-4);
      check.relative(bars.name + ": duration, us", 1e6 * impact.duration, 1e6 * duration, 0.02);
      // The solver leaves 1e-7 of the speed of approach over a step, 1e-14 m.
      check.below(bars.name + ": gap of nodes that touch, um", 1e6 * impact.gap, 1e-7);
      check.relative(bars.name + ": restitution", impact.restitution, alike ? 1. : 0.5, 0.02);
    }
  // The same comparison must notice a speed that is wrong by 3 %.
  const Impact wrong = run({"", {0.1, 0.1}, {100, 100}, {1, 1}}, 1.03 * speed, material);
  check.that("a speed wrong by 3 % is noticed", std::abs(wrong.stress / stress - 1.) > 0.02);
}
