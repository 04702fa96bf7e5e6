// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/parts/rail_base.h>

namespace tread
{
  RailOnBase::RailOnBase(const PartOf &part_of, RailBase &base, const unsigned int body)
    : of(part_of)
    , base(base)
    , nodes(of.mesh.boundary_nodes(body, Boundary::support))
  {
  }


  SumsOfRailBase RailOnBase::sums_of_rank(const State &state) const
  {
    SumsOfRailBase sums{};
    for (const unsigned int i : nodes)
      if (of.mesh.shared_nodes.is_owned(i))
        sums.force += of.quanta.on_hubs.round(state.force[i]);
    return sums;
  }


  void RailOnBase::place_nodes(State &state) const
  {
    for (const unsigned int i : nodes)
      {
        const dealii::Point<3> &p = of.mesh.nodes[i];
        state.v[i]                = base.velocity();
        state.set_position(i, Vector3{p[0], p[1], p[2], 0.} + base.displacement());
      }
  }
} // namespace tread
