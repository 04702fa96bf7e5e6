// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_shakedown_load_index_h
#define tread_analysis_shakedown_load_index_h

#include <tread/analysis/damage_index.h>

namespace tread
{
  /// One coordinate of the shakedown map (Johnson 1989); the other one is FrictionUsedIndex.
  class ShakedownLoadIndex : public DamageIndex
  {
  public:
    static constexpr const char *key   = "shakedown_load_factor";
    static constexpr const char *about = "Largest pressure over 'Damage/Shear strength (MPa)', p0/k: where "
                                         "the load lies along the shakedown map";

    std::optional<double> value(const Load &load) const override
    {
      return load.shear_strength > 0. ? std::optional(load.max_pressure / load.shear_strength) : std::nullopt;
    }
  };
} // namespace tread

#endif
