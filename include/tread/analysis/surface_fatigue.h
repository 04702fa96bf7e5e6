// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_surface_fatigue_h
#define tread_analysis_surface_fatigue_h

#include <tread/analysis/damage_index.h>
#include <tread/reference/fatigue.h>

namespace tread
{
  /// @see reference::surface_fatigue_index
  class SurfaceFatigueIndex : public DamageIndex
  {
  public:
    static constexpr const char *key = "surface_fatigue_index";
    static constexpr const char *about =
      "Friction used less what the shakedown map allows, the shear strength over the largest pressure, k/p0 "
      "(of Hertz's ellipse 2 pi a b k / (3 N))";

    std::optional<double> value(const Load &load) const override
    {
      if (!(load.shear_strength > 0.))
        return std::nullopt;
      return reference::surface_fatigue_index(load.tangential_force / load.normal_force, load.max_pressure,
                                              load.shear_strength);
    }
  };
} // namespace tread

#endif
