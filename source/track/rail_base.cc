// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/track/rail_base.h>

#include <cmath>

namespace tread
{
  void CoRunningBase::place()
  {
    state.displacement = state.velocity = Vector3{};
    state.held.reset();
  }


  void CoRunningBase::advance(const Load &load, const double time_step)
  {
    if (!state.held)
      state.held = -load.force;
    const SpringAndDamper *along[] = {nullptr, &track.lateral, &track.vertical};
    for (unsigned int d = 1; d < 3; ++d)
      {
        const double before = state.velocity[d];
        const double support =
          (*state.held)[d] - along[d]->stiffness * state.displacement[d] - along[d]->damping * before;
        state.velocity[d] += time_step * (load.force[d] + support) / track.mass;
        state.displacement[d] += time_step * state.velocity[d];
        const double work = 0.5 * time_step * support * (before + state.velocity[d]);
        state.work += work;
        state.gross += std::abs(work);
      }
  }


  void CoRunningBase::serialize(Archive &archive)
  {
    archive.same(state);
  }
} // namespace tread
