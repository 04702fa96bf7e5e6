// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_solid_fully_integrated_h
#define tread_solid_fully_integrated_h

#include <tread/solid/element.h>

namespace tread
{
  /// 2 x 2 x 2 Gauss points, without hourglass control.
  class FullyIntegrated : public Element
  {
  public:
    static constexpr const char *name        = "fully-integrated";
    static constexpr const char *description = "the cross-check";
    static constexpr bool        can_yield = false, has_bulk_viscosity = false, has_hourglass_modes = false;
    static constexpr double      largest_poisson_ratio = 0.45; ///< at 0.49 pressure is a third too high

    explicit FullyIntegrated(const SolidParameters &parameters)
      : density_scale(parameters.density_scale)
      , force_quantum(parameters.force_quantum())
    {
    }

    double highest_frequency_bound(const HexahedronIntegrals &cell,
                                   const ElasticMaterial     &material,
                                   const double               hourglass_factor) const override;
    double relative_cost(const std::array<dealii::Point<3>, 8> &corners) const override;
    std::vector<std::unique_ptr<const CellGroup>> make_groups(
      const Mesh                      &mesh,
      const ElasticMaterial           &material,
      const std::vector<unsigned int> &cells) const override;

  private:
    double  density_scale;
    Quantum force_quantum;
  };
} // namespace tread

#endif
