// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_t_gamma_per_area_h
#define tread_analysis_t_gamma_per_area_h

#include <tread/analysis/damage_index.h>

namespace tread
{
  /// By which wear in twin discs falls into regimes (Lewis and Dwyer-Joyce 2004).
  class TGammaPerArea : public DamageIndex
  {
  public:
    static constexpr const char *key   = "t_gamma_per_area_Pa";
    static constexpr const char *about = "T-gamma over the area in contact";

    std::optional<double> value(const Load &load) const override
    {
      return load.area > 0. ? std::optional(load.t_gamma / load.area) : std::nullopt;
    }
  };
} // namespace tread

#endif
