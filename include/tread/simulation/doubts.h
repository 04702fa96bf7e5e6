// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_simulation_doubts_h
#define tread_simulation_doubts_h

#include <tread/model/model.h>
#include <tread/recorders/end_of_way.h>

#include <string>
#include <vector>

namespace tread
{
  /// A warning where profiles have detail that the mesh does not see; empty: none.
  std::string unseen_detail(const Scene &scene);

  /// What casts doubt on a run before it rolls, for the screen at the start and for the summary.
  std::vector<std::string> doubts_at_start(const Model &model);

  /// Why the answer at the end is perhaps not that of steady rolling. @param averaged way (m) since the run
  /// went on
  std::vector<std::string> doubts_at_end(const Model    &model,
                                         const EndOfWay &end_of_way,
                                         const double    averaged);
} // namespace tread

#endif
