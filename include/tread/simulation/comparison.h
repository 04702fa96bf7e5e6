// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_simulation_comparison_h
#define tread_simulation_comparison_h

#include <tread/model/model.h>
#include <tread/recorders/end_of_way.h>
#include <tread/recorders/solution.h>

#include <string>
#include <vector>

namespace tread
{
  /// What a run answers, from what was recorded at the solution instant.
  struct RunAnswer
  {
    const Model                               &model;
    const EndOfWay                            &end_of_way;
    const Solution                            &solution;
    const std::vector<std::vector<PatchNode>> &patches; ///< of Solution
    bool                                       completed;
  };

  /// What the screen and the tables have of the half-space beside it.
  struct Compared
  {
    std::string            by_patch        = {}; ///< table of the patches of a wheelset in a given position
    std::string            note            = {}; ///< why nothing is compared, or what it is compared with
    std::vector<PatchNode> reference_patch = {};
  };

  /// Add the answer of the first wheel or wheelset to the summary, beside that of half-space theory where it
  /// has one. Collective.
  Compared compare_with_half_space(const RunAnswer &run, Summary &summary);

  /// Add the answers of all other wheels. @returns a line for each on the screen.
  std::string add_further_wheels(const RunAnswer &run, Summary &summary);
} // namespace tread

#endif
