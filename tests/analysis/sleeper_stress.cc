// SPDX-License-Identifier: LGPL-2.1-or-later
// Half a sleeper under the pressures on its rail seat: a block in uniform compression, resultants, iterations
// on finer meshes. On several ranks.
#include <tread/analysis/sleeper_stress.h>

#include <deal.II/base/mpi.h>

#include "check.h"

using namespace tread;

TREAD_TEST(analysis_sleeper_stress)(tests::Check &check, const tests::Arguments &)
{
  const MPI_Comm comm = MPI_COMM_WORLD;

  // A block that is pressed over its whole top and slides on springs: stress p, shortening p h / E, and the
  // springs yield by F / k. Linear and quadratic elements contain this field: what is left is the solver's.
  constexpr double    width = 0.15, length = 0.26, height = 0.2, pressure = 3e6, ballast = 45e6;
  const SleeperShape  block{{{0., width, width, height}, {length, width, width, height}}, 0.5 * length};
  const SeatPressures uniform{3, 4, width, length, std::vector<double>(12, pressure)};
  for (const unsigned int degree : {1u, 2u})
    {
      SleeperStressParameters p;
      p.cell_size               = 0.03;
      p.degree                  = degree;
      p.ballast_stiffness       = ballast;
      const SleeperStress s     = sleeper_stress(block, uniform, p, comm);
      const std::string   name  = "block, order " + std::to_string(degree) + ": ";
      const double        force = pressure * width * length;
      check.relative(name + "volume", s.volume, width * length * height, 1e-12);
      check.relative(name + "largest von Mises stress, MPa", 1e-6 * s.max_von_mises, 1e-6 * pressure, 1e-7);
      check.below(name + "largest tension over the pressure", s.max_tension / pressure, 1e-7);
      check.relative(name + "settlement of the seat, um", 1e6 * s.mean_seat_settlement,
                     1e6 * (force / ballast + pressure * height / p.young_modulus), 1e-8);
      check.relative(name + "least pressure of the bottom, MPa", 1e-6 * s.least_bottom_pressure,
                     1e-6 * pressure, 1e-7);
      check.relative(name + "force on the bottom, kN", 1e-3 * s.bottom_force, 1e-3 * force, 1e-8);
    }

  // Uneven pressures on the sleeper itself.
  SeatPressures uneven{3, 4, 0.15, 0.13, {}};
  for (unsigned int i = 0; i < 12; ++i)
    uneven.pressure.push_back(1e6 * (1. + 0.2 * i + (i % 5 == 0 ? 0.7 : 0.)));
  const SleeperShape shape = SleeperShape::ns90();
  check.relative("half an NS90, kg", 2520. * shape.volume(), 140., 0.005);
  // The preconditioner's iterations are counted on one rank. Cells of 10 mm take nine tenths of the time.
  const bool   alone            = dealii::Utilities::MPI::n_mpi_processes(comm) == 1;
  unsigned int first_iterations = 0;
  for (const double cell : alone ? std::vector<double>{0.04, 0.02, 0.01} : std::vector<double>{0.04, 0.02})
    {
      SleeperStressParameters p;
      p.cell_size              = cell;
      p.degree                 = 1;
      const SleeperStress s    = sleeper_stress(shape, uneven, p, comm);
      const std::string   name = std::to_string(int(1e3 * cell + 0.5)) + " mm: ";
      check.relative(name + "volume", s.volume, shape.volume(), 1e-10);
      check.relative(name + "nodal forces, kN", 1e-3 * s.force, 1e-3 * uneven.force(), 1e-10);
      check.relative(name + "their moment about x, N m", s.moment_x, uneven.moment_x(), 1e-9);
      check.relative(name + "their moment about y, N m", s.moment_y, uneven.moment_y(), 1e-9);
      check.relative(name + "force on the bottom, kN", 1e-3 * s.bottom_force, 1e-3 * uneven.force(), 1e-8);
      check.relative(name + "moment on the bottom about y, N m", s.bottom_moment_y, -uneven.moment_y(), 1e-7);
      std::printf("%s%zu unknowns, %u iterations, largest von Mises stress %.9g MPa\n", name.c_str(),
                  s.unknowns, s.iterations, 1e-6 * s.max_von_mises);
      if (cell == 0.04)
        {
          // Found on one rank.
          check.relative(name + "largest von Mises stress as on one rank, MPa", 1e-6 * s.max_von_mises,
                         2.00090396, 1e-8);
          continue; // two levels of the preconditioner, of which the lower one is solved directly
        }
      if (first_iterations == 0)
        first_iterations = s.iterations;
      check.that(name + "at most 1.3 times the iterations with cells of 20 mm",
                 s.iterations <= 1.3 * first_iterations);
    }

  check.refuses("a pad beyond the top", "longer than the sleeper's top is wide", [&] {
    sleeper_stress(shape, {3, 4, 0.25, 0.13, std::vector<double>(12, 1e6)}, {}, comm);
  });
}
