// SPDX-License-Identifier: LGPL-2.1-or-later
// A rail on supports, with hanging nodes under a pad, is struck while its weight comes on: energy is
// accounted for, and all ranks together compute what each computes alone.
#include <deal.II/base/mpi.h>

#include "check.h"
#include "fields.h"
#include "track_rail.h"

#include <algorithm>

using namespace tread;

namespace track_ranks
{
  struct History
  {
    std::vector<double> forces, displacements, energies; ///< N, m, J
    double              worst_residual = 0.;             ///< share of the gross work
    EnergyLedger        ledger;
    double              time_step;
    std::uint64_t       n_hanging;
    double largest_force = 0., off_whole = 0.; ///< of supports on nodes, and off whole newtons (N)
  };

  History run(const MPI_Comm comm, const TrackParameters &track, const bool solid_sleepers)
  {
    tests::RailForTrack bar = tests::bar(3, 12);
    tests::refine_near(bar.body, dealii::Point<3>(0., 0.02, -bar.height), 0.05, 0.016);
    tests::TrackRail rail(comm, bar, 3, track, DynamicsParameters(), {.3}, solid_sleepers);
    const auto       struck = rail.sections(.3);
    rail.dynamics->start();
    History history;
    history.time_step = rail.dynamics->state.time_step;
    history.n_hanging = rail.mesh->n_global_hanging_nodes;
    for (unsigned int n = 1; n <= 4000; ++n)
      {
        rail.load(struck, tests::blow(n));
        rail.dynamics->step();
        if (n % 130 == 0)
          {
            history.ledger = rail.dynamics->ledger();
            history.worst_residual =
              std::max(history.worst_residual, std::abs(history.ledger.residual_share()));
            for (unsigned int s = 0; s < 3; ++s)
              for (const Supports::Layer layer : {Supports::pad, Supports::ballast})
                history.forces.push_back(rail.supports->force(s, layer));
            history.displacements.push_back(rail.supports->probe_displacement(0));
            history.displacements.push_back(rail.supports->rail_displacement(1));
            for (const double energy :
                 {history.ledger.external_work, history.ledger.kinetic, history.ledger.strain,
                  history.ledger.springs, history.ledger.damping})
              history.energies.push_back(energy);
          }
      }
    // What the last springs give to the nodes, in whole newtons.
    rail.supports->set_quanta(Quantum(1.), Quantum(1.));
    NodalField force(rail.mesh->nodes.size(), Vector3{});
    rail.supports->add_forces(force.data());
    for (const Vector3 &f : force)
      {
        history.largest_force = std::max(history.largest_force, std::abs(f[2]));
        history.off_whole     = std::max(history.off_whole, std::abs(f[2] - std::round(f[2])));
      }
    return history;
  }
} // namespace track_ranks


TREAD_TEST(track_ranks)(tests::Check &check, const tests::Arguments &)
{
  TrackParameters track;
  track.pad_width = .05;
  for (const unsigned int kind : {0u, 1u, 2u})
    {
      const std::string name = kind == 0 ? "one layer: " : kind == 1 ? "mass sleepers: " : "solid sleepers: ";
      track.two_layers       = kind > 0;
      const History together = run(MPI_COMM_WORLD, track, kind == 2),
                    alone    = run(MPI_COMM_SELF, track, kind == 2);
      const EnergyLedger &l  = alone.ledger;
      std::printf("%stime step %.3g us, work %.4g J, kinetic %.4g, strain %.4g, springs %.4g, damping %.4g\n",
                  name.c_str(), 1e6 * alone.time_step, l.external_work, l.kinetic, l.strain, l.springs,
                  l.damping);
      check.that(name + "has hanging nodes", alone.n_hanging > 0);
      // 1e-3 is what a run is judged by (verification list, 40).
      check.below(name + "energy residual/gross work", alone.worst_residual, 1e-3);
      check.that(name + "forces of supports are rounded, so that sums over ranks have no order",
                 alone.largest_force >= 1. && alone.off_whole == 0.);
      check.that(name + "dampers have taken energy", l.damping > .05 * l.external_work);
      check.relative(name + "time step (us)", 1e6 * together.time_step, 1e6 * alone.time_step, 1e-12);
      // Sums over ranks differ in order: 1e-16 a step, and rounding of positions (1e-16 m) over displacements
      // of mm.
      check.below(name + "forces on other ranks", tests::difference(together.forces, alone.forces), 1e-10);
      check.below(name + "displacements on other ranks",
                  tests::difference(together.displacements, alone.displacements), 1e-10);
      check.below(name + "energies on other ranks", tests::difference(together.energies, alone.energies),
                  1e-10);
    }
}
