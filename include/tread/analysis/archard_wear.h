// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_archard_wear_h
#define tread_analysis_archard_wear_h

#include <tread/analysis/wear_law.h>

namespace tread
{
  /// Volume over normal force and sliding distance is a coefficient over the hardness (Archard 1953).
  class ArchardWear : public WearLaw
  {
  public:
    static constexpr const char *name        = "Archard";
    static constexpr const char *description = "in proportion to pressure and sliding distance";

    static void declare(Section &section)
    {
      section.needs({section.path("Wear law"), {name}})
        .declare("Wear coefficient", "1e-4", Number(1e-12, 1.),
                 "Of 'Wear law' Archard: volume times hardness over normal force and distance. Measured "
                 "ones of rail steel differ by a factor of a hundred with slip, pressure and lubrication.");
      section.needs({section.path("Wear law"), {name, "Archard map"}})
        .declare("Hardness (MPa)", "2800", Number(100., 1e5), "Of 'Wear law' Archard, of the softer body.");
    }

    static std::shared_ptr<const WearLaw> make(const dealii::ParameterHandler &section)
    {
      return std::make_shared<ArchardWear>(section.get_double("Wear coefficient"),
                                           1e6 * section.get_double("Hardness (MPa)"));
    }

    /// @param coefficient -; @param hardness Pa
    ArchardWear(const double coefficient, const double hardness)
      : over_hardness(coefficient / hardness)
    {
    }

    double volume(const Sliding &sliding) const override
    {
      return over_hardness * sliding.normal;
    }

  private:
    double over_hardness; ///< 1/Pa
  };
} // namespace tread

#endif
