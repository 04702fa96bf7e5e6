// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/parts/added_mass.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace tread
{
  namespace
  {
    Vector3 off_axle(const RigidMotion &motion, const Vector3 &arm)
    {
      return arm - dot(motion.axle, arm) * motion.axle;
    }
  } // namespace


  AddedMassOnWheel::AddedMassOnWheel(const PartOf &part_of, const CarriesBody &carrier)
    : of(part_of)
    , carrier(carrier)
    , omega(carrier.angular_velocity())
  {
    // What the carrier moves itself has no inertia of its own.
    std::vector<char> is_carried(of.mesh.nodes.size(), false);
    for (const unsigned int i : carrier.carried())
      is_carried[i] = true;
    for (unsigned int i = 0; i < of.added_mass.size(); ++i)
      if (of.mesh.node_bodies[i] == carrier.body() && of.added_mass[i] > 0. && !is_carried[i])
        nodes.push_back({i, of.added_mass[i]});
  }


  void AddedMassOnWheel::add_loads(Step &step)
  {
    before = carrier.motion();
    sums   = SumsOfAddedMass{};
    for (const auto &[i, mass] : nodes)
      if (step.inverse_mass[i] > 0.)
        {
          const Vector3 arm = step.state.position(i) - before.middle, off = off_axle(before, arm);
          step.state.force[i] -= of.quanta.force.round((mass * omega * omega) * off);
          if (!of.mesh.shared_nodes.is_owned(i))
            continue;
          sums.arms += of.quanta.moments.round(mass * off);
          if (before.tilts)
            sums.products += of.quanta.moments.round((mass * dot(before.axle, arm)) * off);
        }
  }


  void AddedMassOnWheel::advance_with(Step &step, const SumsOfAddedMass &of_all_ranks)
  {
    // The force acts on mass that is not there, so the axle feels nothing of it. What it does with the
    // axle's motion in this step is no change of its potential about the axle, and counts as work from
    // outside.
    const RigidMotion now  = carrier.motion();
    const double      work = -omega * omega *
                        (0.5 * step.state.time_step * dot(of_all_ranks.arms, before.velocity + now.velocity) +
                         dot(of_all_ranks.products, now.axle - before.axle));
    if (dealii::Utilities::MPI::this_mpi_process(of.mesh.comm) == 0)
      {
        step.totals.external_work.add(work);
        step.totals.gross_work.add(std::abs(work));
      }
  }


  double AddedMassOnWheel::potential(const double time_step) const
  {
    const RigidMotion       motion = carrier.motion();
    const double            back   = 0.5 * time_step;
    ReproducibleSum<double> sum;
    for (const auto &[i, mass] : nodes)
      if (of.mesh.shared_nodes.is_owned(i))
        {
          const Vector3 arm = of.state.position(i) - back * of.state.v[i] -
                              (motion.middle - back * motion.velocity),
                        off = off_axle(motion, arm);
          sum.add(0.5 * omega * omega * mass * dot(off, off));
        }
    return sum.value(of.mesh.comm);
  }
} // namespace tread
