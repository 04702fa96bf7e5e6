// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/track/rail_base.h>

#include <cmath>

namespace tread
{
  void RailBase::place()
  {
    state.displacement = state.velocity = Vector3{};
    state.held.reset();
  }


  void RailBase::advance(const Vector3 force, const double time_step)
  {
    if (!state.held)
      state.held = -force;
    const SpringAndDamper *along[] = {nullptr, &parameters.lateral, &parameters.vertical};
    for (unsigned int d = 1; d < 3; ++d)
      {
        const double before = state.velocity[d];
        const double support =
          (*state.held)[d] - along[d]->stiffness * state.displacement[d] - along[d]->damping * before;
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
