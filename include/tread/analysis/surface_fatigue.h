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
      "Friction used less what the shakedown map allows, 2 pi a b k / (3 N), with Hertz's semi-axes under "
      "the normal force (of a wheelset in a position half of the patch's extents) and 'Damage/Shear strength "
      "(MPa)'";

    std::optional<double> value(const Load &load) const override
    {
      if (!(load.shear_strength > 0.))
        return std::nullopt;
      return reference::surface_fatigue_index(load.tangential_force / load.normal_force, load.ellipse_area,
                                              load.shear_strength, load.normal_force);
    }
  };
} // namespace tread

#endif
