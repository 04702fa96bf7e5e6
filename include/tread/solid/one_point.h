// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_solid_one_point_h
#define tread_solid_one_point_h

#include <tread/solid/element.h>

namespace tread
{
  /// Uniform strain with hourglass stiffness (Flanagan & Belytschko 1981). Parallelepipeds have a shorter
  /// kernel.
  class OnePoint : public Element
  {
  public:
    static constexpr const char *name        = "one-point";
    static constexpr const char *description = "uniform strain with hourglass stiffness, fast";
    static constexpr bool        can_yield = true, has_bulk_viscosity = true, has_hourglass_modes = true;
    static constexpr double      largest_poisson_ratio = 0.5;

    explicit OnePoint(const SolidParameters &parameters)
      : parameters(parameters)
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
    SolidParameters parameters;
  };
} // namespace tread

#endif
