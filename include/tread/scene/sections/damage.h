// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_damage_h
#define tread_scene_sections_damage_h

#include <tread/analysis/damage_index.h>
#include <tread/analysis/wear_law.h>
#include <tread/base/section.h>

#include <optional>
#include <string>

namespace tread
{
  /// Section `Damage`: what is recorded of friction on both surfaces, and the laws for wear and heat.
  struct DamageSection
  {
    bool                  record        = false;
    std::string           wear_law      = "none"; ///< a name of wear_laws()
    double                conductivity  = 50.;    ///< W/(m K)
    double                heat_capacity = 450.;   ///< J/(kg K)
    std::optional<double> wheel_share;            ///< of the heat; none: so that both have one temperature
    double                rail_temperature = 20., wheel_temperature = 20.; ///< degrees C
    double                shear_strength = 0.; ///< Pa; 0: from the rail's yield stress

    void declare(ParameterTable &table);
  };
} // namespace tread

#endif
