// SPDX-License-Identifier: LGPL-2.1-or-later
// A hammer blow on a rail of cells on its supports, in the time domain: the receptance against that of the
// Timoshenko beam on the same supports. Over a sleeper and at mid-span, with stiff pads, where rail on pads
// and pinned-pinned resonance lie close, and with soft ones, where they are apart.
#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include "check.h"
#include "track_rail.h"

#include <algorithm>
#include <complex>

using namespace tread;
using Complex = std::complex<double>;

namespace
{
  constexpr unsigned int n_supports = 7;
  constexpr double       lowest = 30., step = 8.; // Hz
  constexpr unsigned int n_lines = 197;           // up to 1.6 kHz

  double frequency(const unsigned int line)
  {
    return lowest + step * line;
  }

  std::vector<Complex> by_hammer(const TrackParameters &track, const double x)
  {
    DynamicsParameters parameters;
    parameters.gravity = 0.;
    tests::TrackRail rail(MPI_COMM_SELF, n_supports, track, parameters, 16, {x});
    rail.dynamics->start();
    const double         pulse = 0.4e-3, duration = 0.06, blow = 1e3;
    std::vector<Complex> force(n_lines, 0.), displacement(n_lines, 0.), turn(n_lines), phase(n_lines, 1.);
    for (unsigned int k = 0; k < n_lines; ++k)
      turn[k] = std::polar(1., -2. * dealii::numbers::PI * frequency(k) * rail.dynamics->time_step);
    while (rail.dynamics->time < duration)
      {
        const double s = rail.dynamics->time / pulse;
        const double f = s < 1. ? 0.5 * (1. - std::cos(2. * dealii::numbers::PI * s)) * blow : 0.;
        if (s < 1.1)
          rail.load(x, f);
        for (unsigned int k = 0; k < n_lines; ++k)
          {
            force[k] += f * phase[k];
            displacement[k] -= rail.supports->probe_displacement(0) * phase[k];
            phase[k] *= turn[k];
          }
        rail.dynamics->step();
      }
    for (unsigned int k = 0; k < n_lines; ++k)
      displacement[k] /= force[k];
    return displacement;
  }

  std::vector<Complex> by_beam(const TrackParameters &track, const double x)
  {
    std::vector<double> positions;
    for (int i = -int(n_supports / 2); i <= int(n_supports / 2); ++i)
      positions.push_back(tests::TrackRail::spacing * i);
    const double                   end = .5 * n_supports * tests::TrackRail::spacing;
    const reference::SupportedBeam beam(tests::TrackRail::section(), track.layers(), positions, -end, end,
                                        .0125);
    std::vector<Complex>           receptance;
    for (unsigned int k = 0; k < n_lines; ++k)
      receptance.push_back(beam.respond({{x, 1.}}, 2. * dealii::numbers::PI * frequency(k)).deflection(x));
    return receptance;
  }

  /// Frequency (Hz) of the largest (sign 1) or smallest (-1) amplitude in a band, by a parabola through three
  /// lines of its logarithm.
  double extreme(const std::vector<Complex> &receptance,
                 const double                from,
                 const double                to,
                 const double                sign)
  {
    const auto value = [&](const unsigned int k) {
      return sign * std::log(std::abs(receptance[k]));
    };
    unsigned int best = 0;
    for (unsigned int k = 1; k + 1 < n_lines; ++k)
      if (frequency(k) >= from && frequency(k) <= to && (best == 0 || value(k) > value(best)))
        best = k;
    const double left = value(best - 1), middle = value(best), right = value(best + 1);
    return frequency(best) + .5 * step * (left - right) / (left - 2. * middle + right);
  }

  /// Root mean square of the difference over that of the reference, in a band.
  double deviation(const std::vector<Complex> &a,
                   const std::vector<Complex> &b,
                   const double                from,
                   const double                to)
  {
    double difference = 0., scale = 0.;
    for (unsigned int k = 0; k < n_lines; ++k)
      if (frequency(k) >= from && frequency(k) <= to)
        {
          difference += std::norm(a[k] - b[k]);
          scale += std::norm(b[k]);
        }
    return std::sqrt(difference / scale);
  }
} // namespace


int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  tests::Check                             check;
  TrackParameters                          track;
  track.pad_width     = .05;
  track.points_along  = 1;
  track.points_across = 2;
  struct Extreme
  {
    bool        stiff_pads;
    double      x;
    const char *what;
    double      from, to, sign; // Hz; 1: peak, -1: dip
  };
  const std::vector<Extreme> extremes{{true, 0., "peak, rail and sleepers on ballast", 40., 100., 1.},
                                      {true, 0., "dip, sleepers between pads and ballast", 300., 600., -1.},
                                      {true, 0., "dip over a sleeper", 1000., 1350., -1.},
                                      {true, .3, "peak, rail and sleepers on ballast", 40., 100., 1.},
                                      {true, .3, "pinned-pinned peak", 800., 1000., 1.},
                                      {false, 0., "peak, rail on pads", 300., 430., 1.},
                                      {false, 0., "dip over a sleeper", 900., 1080., -1.},
                                      {false, .3, "peak, rail on pads", 300., 430., 1.},
                                      {false, .3, "pinned-pinned peak", 860., 1000., 1.}};
  for (const double pad : {1300e6, 200e6})
    {
      track.pad_stiffness    = pad;
      track.pad_damping      = pad > 1e9 ? 45e3 : 15e3;
      const std::string pads = pad > 1e9 ? "stiff pads" : "soft pads";
      for (const double x : {0., .3})
        {
          const std::string name   = pads + (x == 0. ? ", over a sleeper" : ", at mid-span");
          const auto        hammer = by_hammer(track, x), beam = by_beam(track, x);
          for (const Extreme &e : extremes)
            if (e.stiff_pads == (pad > 1e9) && e.x == x)
              check.relative(name + ": " + e.what + " (Hz)", extreme(hammer, e.from, e.to, e.sign),
                             extreme(beam, e.from, e.to, e.sign), .03);
          if (pad > 1e9)
            check.below(name + ": deviation below 800 Hz, share", deviation(hammer, beam, 30., 800.), .1);
        }
    }
  return check.exit_code();
}
