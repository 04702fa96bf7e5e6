// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_vehicle_h
#define tread_scene_sections_vehicle_h

#include <tread/base/section.h>

namespace tread
{
  /// Section `Vehicle`. SI units.
  struct VehicleSection
  {
    double sprung_mass = 13400., suspension_stiffness = 1150e3, suspension_damping = 2500., gravity = 9.81;
    std::optional<double> wheel_load; ///< N; sets the sprung mass
    std::optional<double> axle_load;  ///< kg on both wheels; sets the sprung mass

    void declare(ParameterTable &table);
  };
} // namespace tread

#endif
