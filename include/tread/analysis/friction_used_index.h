// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_friction_used_index_h
#define tread_analysis_friction_used_index_h

#include <tread/analysis/damage_index.h>

namespace tread
{
  /// One coordinate of the shakedown map (Johnson 1989); the other one is ShakedownLoadIndex.
  class FrictionUsedIndex : public DamageIndex
  {
  public:
    static constexpr const char *key = "friction_used";
    static constexpr const char *about =
      "Tangential over normal force: where the load lies across the shakedown map";

    std::optional<double> value(const Load &load) const override
    {
      return load.tangential_force / load.normal_force;
    }
  };
} // namespace tread

#endif
