// SPDX-License-Identifier: LGPL-2.1-or-later
// Waves that reach the end of a rail: what comes back from absorbing ends beside what symmetric ends reflect.
// A longitudinal pulse against the closed form of the layer; a hammer blow on a bar on its track against the
// same bar so long that nothing comes back; energy; and all ranks together against each alone.
#include <tread/dynamics/parts/nodes.h>
#include <tread/track/rail_ends.h>

#include <deal.II/base/mpi.h>

#include "check.h"
#include "fields.h"
#include "receptance.h"

#include <algorithm>

using namespace tread;

namespace track_ends
{
  void absorb(tests::TrackRail &rail, const double length)
  {
    const AbsorbingEnds ends{-rail.end, rail.end, length, tests::steel().shear_wave_speed()};
    rail.dynamics->add<DampedNodes>(0, [&](const dealii::Point<3> &p) { return ends.rate(p[0]); });
  }

  double energy(const tests::TrackRail &rail)
  {
    const EnergyLedger ledger = rail.dynamics->ledger();
    return ledger.kinetic + ledger.strain + ledger.hourglass + ledger.springs;
  }

  TrackParameters points()
  {
    TrackParameters track;
    track.pad_width     = .05;
    track.points_along  = 1;
    track.points_across = 2;
    return track;
  }

  DynamicsParameters weightless()
  {
    DynamicsParameters parameters;
    parameters.gravity = 0.;
    return parameters;
  }

  /// Share of the energy of longitudinal waves that is left when they have been at the end and come back:
  /// four periods of a tone, whose waves are short beside the layer.
  double left_of_pulse(const double absorbing_length)
  {
    constexpr unsigned int n_supports = 11;
    constexpr double       frequency = 6e3, periods = 4.; // Hz
    DynamicsParameters     parameters = weightless();
    parameters.damping_steps          = 0.;
    // Pads feel the bar's bulging.
    TrackParameters undamped     = points();
    undamped.springs.pad_damping = undamped.springs.ballast_damping = 0.;
    tests::TrackRail rail(MPI_COMM_SELF, tests::bar(n_supports, 24), n_supports, undamped, parameters, {});
    if (absorbing_length > 0.)
      absorb(rail, absorbing_length);
    return tests::left_of_tone(rail, frequency, periods,
                               2. * rail.end / tests::bar_wave_speed() + periods / frequency,
                               [&]() { return energy(rail); });
  }

  tests::Receptance strike(const unsigned int n_supports, const double absorbing_length)
  {
    tests::TrackRail rail(MPI_COMM_SELF, tests::bar(n_supports, 12), n_supports, points(), weightless(), {});
    if (absorbing_length > 0.)
      absorb(rail, absorbing_length);
    return tests::by_hammer(rail, rail.sections(0.), .02, {30., 10., 198, 200.});
  }

  struct History
  {
    std::vector<double> displacements;
    EnergyLedger        ledger;
    double              time_step;
  };

  /// @param levels of time steps above the smallest one
  History run(const MPI_Comm     comm,
              const unsigned int levels         = 2,
              const double       courant_number = DynamicsParameters().courant_number,
              const unsigned int n_steps        = 3000)
  {
    tests::RailForTrack bar = tests::bar(5, 12);
    tests::refine_near(bar.body, dealii::Point<3>(-1.4, 0.02, -bar.height), 0.05, 0.016);
    TrackParameters track         = points();
    track.points_across           = 2;
    DynamicsParameters parameters = weightless();
    parameters.courant_number     = courant_number;
    tests::TrackRail rail(comm, bar, 5, track, parameters, {}, false, levels);
    absorb(rail, .9);
    const auto struck = rail.sections(.3);
    rail.dynamics->start();
    History history;
    history.time_step = rail.dynamics->state.time_step;
    for (unsigned int n = 0; n < n_steps; ++n)
      {
        rail.load(struck, tests::blow(n));
        rail.dynamics->step();
        if (n % 100 == 99)
          history.displacements.push_back(rail.displacement(struck));
      }
    history.ledger = rail.dynamics->ledger();
    return history;
  }
} // namespace track_ends


TREAD_TEST(track_ends)(tests::Check &check, const tests::Arguments &)
{
  const History together = run(MPI_COMM_WORLD);
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    {
      const History alone = run(MPI_COMM_SELF);
      check.relative("time step (us)", 1e6 * together.time_step, 1e6 * alone.time_step, 1e-12);
      check.below("displacements on other ranks",
                  tests::difference(together.displacements, alone.displacements), 1e-10);
      check.relative("damping on other ranks (J)", together.ledger.damping, alone.ledger.damping, 1e-10);
      return;
    }
  check.below("energy residual/gross work", together.ledger.residual_share(), 1e-3);
  // One level with the same step.
  const double  courant_number = DynamicsParameters().courant_number;
  const History of_one_step =
    run(MPI_COMM_SELF, 0,
        courant_number * together.time_step / run(MPI_COMM_SELF, 0, courant_number, 0).time_step);
  check.relative("time step of levels (us)", 1e6 * together.time_step, 1e6 * of_one_step.time_step, 1e-12);
  check.relative("levels of time steps: damping (J)", together.ledger.damping, of_one_step.ledger.damping,
                 1e-3);
  check.below("levels of time steps: displacements",
              tests::difference(together.displacements, of_one_step.displacements), 1e-3);

  // Bar waves have c_s/c_0 = 1/sqrt(2 (1 + nu)).
  const double kept = std::exp(-2. * AbsorbingEnds::strength / 3. / std::sqrt(2.6));
  for (const double length : {0., .6, 1.2})
    {
      const double left = left_of_pulse(length);
      if (length == 0.)
        check.relative("longitudinal pulse, symmetric: energy that comes back (%)", 100. * left, 100., .01);
      else
        check.absolute("longitudinal pulse, " + std::to_string(int(1e3 * length)) +
                         " mm: energy that comes back (%)",
                       100. * left, 100. * kept, 1.);
    }

  // Nothing comes back from the ends of 61 spans while the record counts, 20 ms at a decay of 200 1/s.
  const tests::Receptance endless = strike(61, 0.);
  const auto              band    = [&](const tests::Receptance &r, const double from, const double to) {
    return 100. * tests::reflected(r, endless, from, to);
  };
  for (const unsigned int n : {5u, 9u})
    {
      const tests::Receptance symmetric = strike(n, 0.), absorbing = strike(n, .6);
      const std::string       name = std::to_string(n) + " spans: ";
      for (const auto &[what, r] : {std::pair("symmetric", symmetric), std::pair("absorbing", absorbing)})
        std::printf(
          "%s%s: share reflected at 100 to 300 Hz %.3f, 300 to 700 Hz %.3f, 700 to 1200 Hz %.3f, 1200 to "
          "2000 Hz %.3f %%\n",
          name.c_str(), what, band(r, 100., 300.), band(r, 300., 700.), band(r, 700., 1200.),
          band(r, 1200., 2000.));
      check.below(name + "absorbing over symmetric, 100 to 2000 Hz",
                  band(absorbing, 100., 2000.) / band(symmetric, 100., 2000.), n == 5 ? .2 : .1);
      check.below(name + "absorbing over symmetric, 100 to 300 Hz",
                  band(absorbing, 100., 300.) / band(symmetric, 100., 300.), .7);
      check.that(name + "symmetric ends reflect", band(symmetric, 100., 2000.) > 1.);
    }
}
