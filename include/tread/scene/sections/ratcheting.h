// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_ratcheting_h
#define tread_scene_sections_ratcheting_h

#include <tread/base/section.h>

namespace tread
{
  /// Section `Ratcheting`: plastic strain of the rail that grows from passage to passage, and jumps over
  /// passages that are not rolled.
  struct RatchetingSection
  {
    double       strain_at_failure = 0.; ///< net plastic strain, equivalent; 0: none
    bool         uniform           = false;
    bool         jumps             = false;
    unsigned int rolled_between    = 3;    ///< passages
    double       irregularity      = 0.05; ///< largest from one passage to the next, of the rate
    double       change_in_a_jump  = 0.2;  ///< largest, of the rate
    double       strain_of_a_jump  = 3e-2; ///< largest change of the net plastic strain
    unsigned int longest_jump      = 1000; ///< passages

    void declare(ParameterTable &table);
  };
} // namespace tread

#endif
