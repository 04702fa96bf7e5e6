// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_profile_wear_h
#define tread_scene_sections_profile_wear_h

#include <tread/base/section.h>

namespace tread
{
  /// Section `Profile wear`: passages that change the profiles (`tread wear`). SI units.
  struct ProfileWearSection
  {
    double       passages   = 1e5; ///< of wheels over the rail
    double       turns      = 0.;  ///< of the wheel
    double       smoothing  = 2e-3;
    double       spacing    = 0.25e-3;
    double       change     = 0.1; ///< of the pressure in a step
    double       least_step = 0.1e-6;
    unsigned int states     = 4;

    void declare(ParameterTable &table);
    /// @throws InputError
    void check() const;
  };
} // namespace tread

#endif
