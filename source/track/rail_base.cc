// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/track/rail_base.h>

#include <cmath>

namespace tread
{
  void RailBase::place()
  {
    const double work = state.work, gross = state.gross;
    state       = State();
    state.work  = work;
    state.gross = gross;
  }


  void RailBase::advance(const Vector3 force, const double time_step)
  {
    if (!state.is_held)
      {
        state.held    = Vector3{0., -force[1], -force[2], 0.};
        state.is_held = true;
      }
    const SpringAndDamper *along[] = {nullptr, &parameters.lateral, &parameters.vertical};
    for (unsigned int d = 1; d < 3; ++d)
      {
        const double before = state.velocity[d], support = state.held[d] -
                                                           along[d]->stiffness * state.displacement[d] -
                                                           along[d]->damping * before;
        state.velocity[d] += time_step * (force[d] + support) / parameters.mass;
        state.displacement[d] += time_step * state.velocity[d];
        const double work = 0.5 * time_step * support * (before + state.velocity[d]);
        state.work += work;
        state.gross += std::abs(work);
      }
  }


  void RailBase::serialize(Archive &archive)
  {
    archive.same(state);
  }
} // namespace tread
