// SPDX-License-Identifier: LGPL-2.1-or-later
// A hammer blow on a rail of cells on its supports, in the time domain: the receptance against that of the
// Timoshenko beam on the same supports. A bar, over a sleeper and at mid-span, with stiff pads, where rail on
// pads and pinned-pinned resonance lie close, and with soft ones, where they are apart; and the full
// sections.
#include "receptance.h"

#include <deal.II/base/mpi.h>

#include "check.h"

using namespace tread;

namespace track_receptance
{
  struct Extreme
  {
    bool        stiff_pads;
    double      x;
    const char *what;
    double      from, to, sign; // Hz; 1: peak, -1: dip
    double      allowed;
  };

  void bar(tests::Check &check)
  {
    TrackParameters track;
    track.pad_width                       = .05;
    track.points_along                    = 1;
    track.points_across                   = 2;
    constexpr unsigned int     n_supports = 7;
    const tests::Lines         lines{30., 8., 197, 100.}; // up to 1.6 kHz
    const std::vector<Extreme> extremes{
      {true, 0., "peak, rail and sleepers on ballast", 40., 100., 1., .003},
      {true, 0., "dip, sleepers between pads and ballast", 300., 600., -1., .006},
      {true, 0., "dip over a sleeper", 1000., 1350., -1., .02},
      {true, .3, "peak, rail and sleepers on ballast", 40., 100., 1., .003},
      {true, .3, "pinned-pinned peak", 800., 1000., 1., .015},
      {false, 0., "peak, rail on pads", 300., 430., 1., .005},
      {false, 0., "dip over a sleeper", 900., 1080., -1., .02},
      {false, .3, "peak, rail on pads", 300., 430., 1., .005},
      {false, .3, "dip below pinned-pinned", 700., 880., -1., .012},
      {false, .3, "pinned-pinned peak", 860., 1000., 1., .015}};
    for (const double pad : {1300e6, 200e6})
      {
        track.springs.pad_stiffness = pad;
        track.springs.pad_damping   = pad > 1e9 ? 45e3 : 15e3;
        const std::string pads      = pad > 1e9 ? "stiff pads" : "soft pads";
        // Points on the bar's base dent it.
        const auto layers =
          tests::softened(track.layers(0), tests::foot_compliance(tests::bar(3, 16), track));
        for (const double x : {0., .3})
          {
            const std::string  name = "bar, " + pads + (x == 0. ? ", over a sleeper" : ", at mid-span");
            DynamicsParameters parameters;
            parameters.gravity = 0.;
            tests::TrackRail rail(MPI_COMM_SELF, tests::bar(n_supports, 16), n_supports, track, parameters,
                                  {});
            const auto       struck = rail.sections(x);
            const auto       cells  = tests::by_hammer(rail, struck, .06, lines);
            const auto       beam = tests::by_beam(rail.beam(.0125, layers), rail.beam_loads(struck), lines);
            for (const Extreme &e : extremes)
              if (e.stiff_pads == (pad > 1e9) && e.x == x)
                check.relative(name + ": " + e.what + " (Hz)", cells.extreme(e.from, e.to, e.sign),
                               beam.extreme(e.from, e.to, e.sign), e.allowed);
            if (pad > 1e9)
              check.below(name + ": deviation below 800 Hz, share", cells.deviation(beam, 30., 800.), .05);
          }
      }
  }

  /// Over a sleeper with pads of their true size; the dip in which sleepers swing between pads and ballast
  /// lies where pads and foot together are as stiff. At mid-span with pads that are points, as pinned-pinned
  /// is defined.
  void full_section(tests::Check &check, const RailProfile &profile, const double pinned)
  {
    constexpr unsigned int n_supports = 9;
    constexpr double       cell = .0125, row = .04, duration = .02;
    const tests::Lines     lines{200., 8., 176, 200.};
    const std::string     &name = profile.name();
    DynamicsParameters     parameters;
    parameters.gravity = 0.;
    TrackParameters areas;
    areas.pad_width = .13;
    {
      tests::TrackRail rail(MPI_COMM_SELF, tests::full_section(profile, n_supports, cell, row, 0.),
                            n_supports, areas, parameters, {}, false, 2);
      const auto       struck = rail.sections(0.);
      const auto       loads  = rail.beam_loads(struck);
      const auto       cells  = tests::by_hammer(rail, struck, duration, lines);
      const auto       beam   = tests::by_beam(rail.beam(.0125), loads, lines);
      const double     foot   = tests::foot_compliance(tests::full_section(profile, 3, cell, row, 0.), areas);
      const auto       softened =
        tests::by_beam(rail.beam(.0125, tests::softened(areas.layers(0), foot)), loads, lines);
      std::printf("%s: %zu cells, %llu steps, compliance of the foot %.3f nm/N\n", name.c_str(),
                  rail.mesh->cells.size(), static_cast<unsigned long long>(rail.dynamics->state.n_steps),
                  1e9 * foot);
      check.relative(name + ", over a sleeper: peak, rail on pads (Hz)", cells.extreme(700., 1000., 1.),
                     beam.extreme(700., 1000., 1.), .03);
      check.relative(name + ", over a sleeper: pinned-pinned dip (Hz)", cells.extreme(1050., 1350., -1.),
                     beam.extreme(1050., 1350., -1.), .03);
      check.relative(name + ", over a sleeper: dip, sleepers between pads with the foot and ballast (Hz)",
                     cells.extreme(300., 600., -1.), softened.extreme(300., 600., -1.), .03);
    }
    {
      TrackParameters points = areas;
      points.pad_width       = .02; // near the web
      points.points_along    = 1;
      points.points_across   = 2;
      tests::TrackRail rail(MPI_COMM_SELF, tests::full_section(profile, n_supports, cell, row, .3),
                            n_supports, points, parameters, {}, false, 2);
      const auto       struck = rail.sections(.3);
      const auto       cells  = tests::by_hammer(rail, struck, duration, lines);
      const auto       beam   = tests::by_beam(rail.beam(.0125), rail.beam_loads(struck), lines);
      check.relative(name + ", at mid-span: pinned-pinned peak (Hz)", cells.extreme(950., 1150., 1.),
                     beam.extreme(950., 1150., 1.), .015);
      check.relative(name + ", at mid-span: pinned-pinned peak beside Timoshenko's frequency (Hz)",
                     cells.extreme(950., 1150., 1.), pinned, .02);
    }
  }
} // namespace track_receptance


TREAD_TEST(track_receptance)(tests::Check &check, const tests::Arguments &arguments)
{
  const std::string what = arguments.empty() ? "" : arguments.front();
  // Timoshenko's frequencies for a half wave of one spacing, shear coefficient 0.4.
  if (what == "bar")
    bar(check);
  else if (what == "54E1")
    full_section(check, RailProfile::rail_54e1(), 1015.);
  else if (what == "60E1")
    full_section(check, RailProfile::rail_60e1(), 1067.);
}
