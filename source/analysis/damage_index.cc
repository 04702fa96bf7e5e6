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
    /// Of an index with parameters.
    template <typename Index>
    DamageIndexEntry index_entry()
    {
      return {Index::key, Index::about, &Index::declare, &Index::make};
    }

    template <typename Index>
    DamageIndexEntry index_without_parameters()
    {
      return {Index::key, Index::about, [](Section &) {},
              [](const dealii::ParameterHandler &) -> std::shared_ptr<const DamageIndex> {
                return std::make_shared<Index>();
              }};
    }
  } // namespace


  const std::vector<DamageIndexEntry> &damage_indices()
  {
    static const std::vector<DamageIndexEntry> indices{index_without_parameters<FrictionUsedIndex>(),
                                                       index_without_parameters<ShakedownLoadIndex>(),
                                                       index_without_parameters<SurfaceFatigueIndex>(),
                                                       index_without_parameters<TGammaPerArea>(),
                                                       index_entry<RegimeWearRate>(),
                                                       index_entry<TGammaDamage>()};
    return indices;
  }


  std::vector<std::pair<std::string, double>> damage_of(const DamageIndices     &indices,
                                                        const DamageIndex::Load &load)
  {
    std::vector<std::pair<std::string, double>> values;
    if (load.normal_force > 0.)
      for (const auto &[key, index] : indices)
        if (const std::optional<double> value = index->value(load))
          values.emplace_back(key, *value);
    return values;
  }


  void declare_damage_indices(Section &section)
  {
    for (const DamageIndexEntry &index : damage_indices())
      index.declare(section);
  }
} // namespace tread
