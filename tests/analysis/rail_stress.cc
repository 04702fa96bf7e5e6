// SPDX-License-Identifier: LGPL-2.1-or-later
// Largest von Mises stress under a path, and stress of chosen cells, in a block that is stretched by a known
// field: cells of two sizes, on several ranks.
#include <tread/analysis/rail_stress.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"
#include "check.h"
#include "reopened.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

using namespace tread;
using dealii::Point;

namespace
{
  constexpr double length = 0.06, coarse = 5e-3, fine = 2.5e-3;

  /// Stretch along x: u_x = rise X^2/2 (1 - slope Z) from the front or the rear end, X the distance from it.
  struct Field
  {
    double rise;
    bool   from_rear;

    static constexpr double slope = 40.;

    double displacement(const Point<3> &p) const
    {
      const double s = from_rear ? length - p[0] : p[0];
      return (from_rear ? -1. : 1.) * 0.5 * rise * s * s * (1. - slope * p[2]);
    }

    /// Of the cell with this centre and edge. Means of the trilinear field's gradient, then Cauchy's stress
    /// of Hencky's law.
    double von_mises(const double x, const double z, const double edge) const
    {
      const double s = from_rear ? length - x : x;
      const double a = s - 0.5 * edge, b = s + 0.5 * edge;
      const double sign = from_rear ? -1. : 1.;

      dealii::Tensor<2, 3> F, E;
      F[0][0] = 1. + rise * s * (1. - slope * z);
      F[0][2] = -sign * 0.5 * rise * slope * 0.5 * (a * a + b * b);
      F[1][1] = F[2][2] = 1.;
      E                 = 0.5 * (transpose(F) * F);
      for (unsigned int i = 0; i < 3; ++i)
        E[i][i] -= 0.5;
      const ElasticMaterial      steel;
      const double               mu = steel.shear_modulus(), lambda = steel.lame();
      const dealii::Tensor<2, 3> square = E * E;
      dealii::Tensor<2, 3>       S      = (2. * mu - 2. * lambda * trace(E)) * E - 6. * mu * square;
      for (unsigned int i = 0; i < 3; ++i)
        S[i][i] += lambda * (trace(E) - trace(square));
      const dealii::Tensor<2, 3> stress = F * S * transpose(F) / determinant(F);
      return tread::von_mises(
        {{stress[0][0], stress[1][1], stress[2][2], stress[0][1], stress[1][2], stress[2][0]}});
    }
  };

  void take(ExplicitDynamics &dynamics, const Field &field, const double time)
  {
    for (unsigned int i = 0; i < dynamics.v.size(); ++i)
      {
        Vector3 x = dynamics.position(i);
        x[0]      = dynamics.mesh.nodes[i][0] + field.displacement(dynamics.mesh.nodes[i]);
        dynamics.set_position(i, x);
      }
    dynamics.time = time;
  }

  void check_strip(tests::Check &check, ExplicitDynamics &dynamics)
  {
    const MPI_Comm    comm = dynamics.mesh.comm;
    const StripExtent extent{-1., 1., 0., 6e-3, 8e-3, [](const Point<3> &p) {
                               return -p[2];
                             }};
    const Field       first{0.1, false}, second{0.15, true};
    StressStrip       strip(dynamics.mesh, 0, extent);
    take(dynamics, first, 1.);
    strip.sample(dynamics, 10.);

    // A strip that goes on from what the first has stored.
    StressStrip resumed(dynamics.mesh, 0, extent);
    Archive     stored(comm);
    strip.serialize(stored);
    Archive archive(comm, tests::parts_of(stored, comm));
    resumed.serialize(archive);
    take(dynamics, second, 2.);
    strip.sample(dynamics, 20.);
    resumed.sample(dynamics, 20.);
    const auto columns = strip.columns(dynamics), again = resumed.columns(dynamics);
    if (dealii::Utilities::MPI::this_mpi_process(comm) != 0)
      return;

    check.that("a column for each cell at the surface along the path", columns.size() == 24);
    double place = 0., surface = 0., largest = 0., resumption = 0.;
    bool   times = true, depths = true;
    for (unsigned int i = 0; i < columns.size(); ++i)
      {
        const StripColumn &column = columns[i];
        const double       x = (i + 0.5) * fine, x_below = (i / 2 + 0.5) * coarse;
        place                 = std::max(place, std::abs(column.x / x - 1.));
        double     at_surface = 0., most = 0., depth = 0., time = 0.;
        const auto look = [&](const double centre, const double z, const double edge) {
          const double values[2] = {first.von_mises(centre, z, edge), second.von_mises(centre, z, edge)};
          for (unsigned int k = 0; k < 2; ++k)
            {
              if (z == -0.5 * fine)
                at_surface = std::max(at_surface, values[k]);
              if (values[k] > most)
                {
                  most  = values[k];
                  depth = -z;
                  time  = k + 1.;
                }
            }
        };
        look(x, -0.5 * fine, fine);
        look(x, -1.5 * fine, fine);
        look(x_below, -1.5 * coarse, coarse);
        surface    = std::max(surface, std::abs(column.at_surface.stress / at_surface - 1.));
        largest    = std::max(largest, std::abs(column.largest.stress / most - 1.));
        times      = times && column.largest.time == time && column.largest.wheel_x == 10. * time;
        depths     = depths && std::abs(column.depth - depth) < 1e-9;
        resumption = std::max(resumption, std::abs(again[i].largest.stress / column.largest.stress - 1.));
      }
    // Round-off of positions (1e-17 m) over strains of 1e-4 in cells of 2.5 mm.
    check.below("middles of the columns, share", place, 1e-12);
    check.below("largest at the surface, share", surface, 1e-9);
    check.below("largest at any depth, share", largest, 1e-9);
    check.that("its time and the wheel's place", times);
    check.that("its depth", depths);
    check.below("restored and gone on, share", resumption, 1e-15);
  }

  void check_probes(tests::Check &check, ExplicitDynamics &dynamics)
  {
    const Field field{0.1, false};
    take(dynamics, field, 3.);
    // In a cell of each size, and on a corner that eight cells share: any of them.
    const CellProbes probes(
      dynamics.mesh, 0,
      {Point<3>(31.2e-3, 1e-3, -1e-3), Point<3>(31e-3, 1e-3, -12e-3), Point<3>(30e-3, 0., -2.5e-3)});
    const auto records = probes.record(dynamics);
    check.absolute("centre of a fine cell: x, mm", 1e3 * probes.centres()[0][0], 31.25, 1e-6);
    check.absolute("centre of a fine cell: z, mm", 1e3 * probes.centres()[0][2], -1.25, 1e-6);
    check.absolute("centre of a coarse cell: x, mm", 1e3 * probes.centres()[1][0], 32.5, 1e-6);
    check.absolute("centre of a coarse cell: z, mm", 1e3 * probes.centres()[1][2], -12.5, 1e-6);
    check.absolute("cell beside a corner: x from it, mm", std::abs(1e3 * probes.centres()[2][0] - 30.), 1.25,
                   1e-6);
    const double edges[3] = {fine, coarse, fine};
    for (unsigned int i = 0; i < 3; ++i)
      check.relative("von Mises stress of cell " + std::to_string(i + 1), records[i].von_mises,
                     field.von_mises(probes.centres()[i][0], probes.centres()[i][2], edges[i]), 1e-9);
    const std::string said = tests::complaint<std::out_of_range>([&] {
      CellProbes(dynamics.mesh, 0, {Point<3>(31e-3, 0., -1e-3), Point<3>(31e-3, 0., 1e-3)});
    });
    check.that("a point above the block is refused by its number", said == "2");
  }
} // namespace

void run_test(tests::Check &check, const tests::Arguments &)
{
  Body body = tests::make_box("block", Point<3>(0., -0.015, -0.02), Point<3>(length, 0.015, 0.), {{12, 6, 4}},
                              {{tests::Side::left, Boundary::end},
                               {tests::Side::right, Boundary::end},
                               {tests::Side::bottom, Boundary::support},
                               {tests::Side::top, Boundary::contact}});
  body.wanted_cell_size = [](const Point<3> &p) {
    return p[2] > -0.9 * coarse ? fine : std::numeric_limits<double>::max();
  };
  const Mesh       mesh(MPI_COMM_WORLD, {body});
  const Solid      solid(mesh, {ElasticMaterial()}, SolidParameters());
  ExplicitDynamics dynamics(mesh, solid, DynamicsParameters());
  check_strip(check, dynamics);
  check_probes(check, dynamics);
}
