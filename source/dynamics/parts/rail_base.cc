// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/parts/rail_base.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace tread
{
  RailOnBase::RailOnBase(const PartOf &part_of, RailBase &base, const unsigned int body)
    : of(part_of)
    , base(base)
    , body(body)
    , nodes(of.mesh.boundary_nodes(body, Boundary::support))
  {
    using dealii::Utilities::MPI::max;
    using dealii::Utilities::MPI::min;
    double low = std::numeric_limits<double>::max(), high = -low, lowest = low;
    for (const unsigned int i : nodes)
      {
        const dealii::Point<3> &p = of.mesh.nodes[i];
        low                       = std::min(low, p[0]);
        high                      = std::max(high, p[0]);
        lowest                    = std::min(lowest, p[2]);
      }
    middle = 0.5 * (min(low, of.mesh.comm) + max(high, of.mesh.comm));
    bottom = min(lowest, of.mesh.comm);
  }


  SumsOfRailBase RailOnBase::sums_of_rank(const State &state) const
  {
    SumsOfRailBase sums{};
    for (const unsigned int i : nodes)
      if (of.mesh.shared_nodes.is_owned(i))
        {
          const Vector3          &force = state.force[i];
          const dealii::Point<3> &p     = of.mesh.nodes[i];
          sums.force += of.quanta.on_hubs.round(force);
          sums.moment += of.quanta.on_hubs.round(force[2] * (p[0] - middle) - force[0] * (p[2] - bottom));
        }
    return sums;
  }


  void RailOnBase::place_nodes(State &state) const
  {
    const RailBase::Motion velocity = base.velocity(), displacement = base.displacement();
    for (const unsigned int i : nodes)
      {
        const dealii::Point<3> &p = of.mesh.nodes[i];
        state.v[i]                = at(i, velocity);
        state.set_position(i, Vector3{p[0], p[1], p[2], 0.} + at(i, displacement));
      }
  }


  std::vector<double> RailOnBase::follow(State                         &state,
                                         const std::vector<MovingLoad> &loads,
                                         const std::function<void(NodalField &)> &)
  {
    if (loads.size() != 1 || !base.follow(loads[0].force, loads[0].velocity_x))
      return {};
    const RailBase::Motion velocity = base.velocity();
    for (unsigned int i = 0; i < state.v.size(); ++i)
      if (of.mesh.node_bodies[i] == body)
        state.v[i] += at(i, velocity);
    return {velocity.shift[2] + velocity.slope * (loads[0].x - middle)};
  }
} // namespace tread
