// SPDX-License-Identifier: LGPL-2.1-or-later
/// Receptance of a rail of full section on its track by hammer blows in the time domain, over a sleeper and
/// at mid-span, on a cross-section, on the rail top and on 120 mm of the rail, beside that of the Timoshenko
/// beam, whose pads are as given or in series with the foot: a table in CSV, amplitudes in nm/N.
/// Arguments: rail, cell size and longest row (mm), number of supports, pads, their stiffness and damping,
/// duration, decay of forces and displacements (1/s).
#include <deal.II/base/mpi.h>

#include <receptance.h>

#include <cstdio>
#include <cstdlib>
#include <string>

using namespace tread;

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc != 10)
    {
      std::fprintf(stderr,
                   "usage: %s 54E1|60E1 CELL_MM ROW_MM SUPPORTS points|areas PAD_MN_M PAD_KNS_M MS DECAY\n",
                   argv[0]);
      return 2;
    }
  const RailProfile profile =
    std::string(argv[1]) == "54E1" ? RailProfile::rail_54e1() : RailProfile::rail_60e1();
  const double       cell = 1e-3 * std::atof(argv[2]), row = 1e-3 * std::atof(argv[3]);
  const unsigned int n = std::atoi(argv[4]);
  TrackParameters    track;
  track.springs.pad_stiffness = 1e6 * std::atof(argv[6]);
  track.springs.pad_damping   = 1e3 * std::atof(argv[7]);
  if (std::string(argv[5]) == "points")
    {
      track.pad_width     = .02;
      track.points_along  = 1;
      track.points_across = 2;
    }
  else
    track.pad_width = .13;
  const double           duration = 1e-3 * std::atof(argv[8]);
  const tests::Lines     lines{30., 4., 394, std::atof(argv[9])};
  constexpr unsigned int max_level = 2;
  constexpr double       spread    = .06; // m
  const double compliance = tests::foot_compliance(tests::full_section(profile, 3, cell, row, 0.), track);
  const auto   soft_foot  = tests::softened(track.layers(0), compliance);
  std::fprintf(stderr, "compliance of the foot %.3g nm/N, pad with it %.0f MN/m\n", 1e9 * compliance,
               1e-6 * soft_foot.pad_stiffness);
  std::vector<std::string>       names;
  std::vector<tests::Receptance> columns;
  DynamicsParameters             parameters;
  parameters.gravity = 0.;
  for (const double x : {0., .3})
    for (const unsigned int kind : {0u, 1u, 2u})
      {
        tests::TrackRail rail(MPI_COMM_SELF, tests::full_section(profile, n, cell, row, x), n, track,
                              parameters, {}, false, max_level);
        const auto patch = kind == 0 ? rail.sections(x) : kind == 1 ? rail.top(x) : rail.sections(x, spread);
        const std::string name = std::string(x == 0. ? "sleeper_" : "mid_span_") +
                                 std::vector<const char *>{"section", "top", "spread"}[kind];
        columns.push_back(tests::by_hammer(rail, patch, duration, lines));
        names.push_back(name + "_cells_nm_N");
        columns.push_back(tests::by_beam(rail.beam(.0125), rail.beam_loads(patch), lines));
        names.push_back(name + "_beam_nm_N");
        columns.push_back(tests::by_beam(rail.beam(.0125, soft_foot), rail.beam_loads(patch), lines));
        names.push_back(name + "_beam_and_foot_nm_N");
        std::fprintf(stderr, "%s: %zu cells, time step %.3g us, gain of levels %.2f, %.1f ms\n", name.c_str(),
                     rail.mesh->cells.size(), 1e6 * rail.dynamics->state.time_step,
                     rail.dynamics->ideal_gain_of_levels(), 1e3 * rail.dynamics->state.time);
      }
  std::printf("frequency_Hz");
  for (const std::string &name : names)
    std::printf(",%s", name.c_str());
  for (unsigned int k = 0; k < lines.n; ++k)
    {
      std::printf("\n%.1f", columns[0].frequency(k));
      for (const tests::Receptance &column : columns)
        std::printf(",%.6g", 1e9 * std::abs(column.values[k]));
    }
  std::printf("\n");
  return 0;
}
