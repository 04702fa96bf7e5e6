// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_damage_index_h
#define tread_analysis_damage_index_h

#include <tread/base/section.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tread
{
  /// What a patch does to the surfaces, as one number.
  ///
  /// A new index is a header like friction_used_index.h, its line in damage_index.cc and a test.
  class DamageIndex
  {
  public:
    virtual ~DamageIndex() = default;

    /// What is known of a patch that carries a load.
    struct Load
    {
      double normal_force     = 0.; ///< N, above 0
      double tangential_force = 0.; ///< N
      double area             = 0.; ///< in contact, m^2
      double max_pressure     = 0.; ///< Pa
      double t_gamma          = 0.; ///< frictional power over speed, N
      double shear_strength   = 0.; ///< yield stress in shear, Pa; 0: not known
    };

    /// None where the load does not say enough.
    virtual std::optional<double> value(const Load &load) const = 0;
  };

  /// What a summary and a scene have to know of an index.
  struct DamageIndexEntry
  {
    std::string key, about; ///< in summary.json
    /// Add the parameters that only this index has to the section `Damage`.
    void (*declare)(Section &section);
    /// @param section with the values of its own parameters; null: it was not asked for
    std::shared_ptr<const DamageIndex> (*make)(const dealii::ParameterHandler &section);
  };

  /// Indices that were asked for, with their keys.
  using DamageIndices = std::vector<std::pair<std::string, std::shared_ptr<const DamageIndex>>>;

  /// Keys and values of those that the load says enough for; none without a normal force.
  std::vector<std::pair<std::string, double>> damage_of(const DamageIndices     &indices,
                                                        const DamageIndex::Load &load);

  /// All indices, in the order of the summary.
  const std::vector<DamageIndexEntry> &damage_indices();

  /// Add the parameters that single indices have to the section `Damage`, which was entered.
  void declare_damage_indices(Section &section);
} // namespace tread

#endif
