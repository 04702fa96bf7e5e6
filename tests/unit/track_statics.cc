// SPDX-License-Identifier: LGPL-2.1-or-later
// A rail of cells at rest on its supports against the Timoshenko beam: deflection and share of each support.
#include <deal.II/base/mpi.h>

#include "check.h"
#include "track_rail.h"

using namespace tread;

namespace
{
  void statics(tests::Check          &check,
               const std::string     &name,
               const TrackParameters &track,
               const double           x,
               const double           allowed)
  {
    constexpr unsigned int n    = 11;
    constexpr double       load = 116.8e3;
    DynamicsParameters     parameters;
    parameters.gravity = 0.;
    tests::TrackRail rail(MPI_COMM_WORLD, n, track, parameters, 20, {x});
    rail.load(x, load);
    const unsigned int iterations = rail.dynamics->relax(1e-5, 100000, {});
    std::printf("%s: %u iterations\n", name.c_str(), iterations);

    const double                   end = .5 * n * rail.spacing;
    const reference::SupportedBeam beam(rail.section(), track.layers(), rail.positions, -end, end, .05);
    const auto                     response = beam.respond({{x, load}});
    check.relative(name + ": deflection (mm)", -1e3 * rail.supports->probe_displacement(0),
                   1e3 * response.deflection(x).real(), allowed);
    double sum = 0.;
    for (unsigned int i = 0; i < n; ++i)
      sum += rail.supports->force(i, Supports::pad);
    check.relative(name + ": supports carry the load", sum, load, 1e-4);
    for (unsigned int i = 5; i < 9; ++i)
      check.absolute(name + ": share of support " + std::to_string(i - 5) + " (%)",
                     100. * rail.supports->force(i, Supports::pad) / load,
                     100. * response.pad_force(i).real() / load, 100. * allowed);
    if (track.two_layers)
      check.relative(name + ": ballast carries what the pad does (kN)",
                     1e-3 * rail.supports->force(5, Supports::ballast),
                     1e-3 * rail.supports->force(5, Supports::pad), 1e-9);
  }
} // namespace


int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0 &&
      !std::freopen("/dev/null", "w", stdout))
    return 1;
  tests::Check    check;
  TrackParameters track;
  track.pad_width     = .05;
  track.points_along  = 1;
  track.points_across = 2;
  statics(check, "over a sleeper", track, 0., .03);
  statics(check, "at mid-span", track, .3, .03);
  track.two_layers    = false;
  track.pad_stiffness = 43.5e6;
  statics(check, "one layer, mid-span", track, .3, .03);
  track           = TrackParameters();
  track.pad_width = .05;
  statics(check, "12 points", track, 0., .03);
  return check.exit_code();
}
