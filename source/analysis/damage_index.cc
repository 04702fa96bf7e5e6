// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/damage_index.h>
#include <tread/analysis/friction_used_index.h>
#include <tread/analysis/regime_wear_rate.h>
#include <tread/analysis/shakedown_load_index.h>
#include <tread/analysis/surface_fatigue.h>
#include <tread/analysis/t_gamma_damage.h>
#include <tread/analysis/t_gamma_per_area.h>

namespace tread
{
  namespace
  {
    template <typename Index>
    DamageIndexEntry index_entry()
    {
      return {Index::key, Index::about, &Index::declare, &Index::make};
    }
  } // namespace


  const std::vector<DamageIndexEntry> &damage_indices()
  {
    static const std::vector<DamageIndexEntry> indices{
      index_entry<FrictionUsedIndex>(), index_entry<ShakedownLoadIndex>(), index_entry<SurfaceFatigueIndex>(),
      index_entry<TGammaPerArea>(),     index_entry<RegimeWearRate>(),     index_entry<TGammaDamage>()};
    return indices;
  }


  void declare_damage_indices(dealii::ParameterHandler &section)
  {
    for (const DamageIndexEntry &index : damage_indices())
      index.declare(section);
  }
} // namespace tread
