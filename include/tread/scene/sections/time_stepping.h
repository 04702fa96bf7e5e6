// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_time_stepping_h
#define tread_scene_sections_time_stepping_h

#include <tread/base/section.h>

namespace tread
{
  /// Section `Time stepping`.
  struct TimeSteppingSection
  {
    double       courant_number = 0.95; ///< without levels, @see DynamicsParameters
    unsigned int levels         = 1;
    double       least_step     = 0.; ///< s, which the fastest cells are given mass for; 0: none

    void declare(ParameterTable &table);
  };
} // namespace tread

#endif
