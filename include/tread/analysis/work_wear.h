// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_work_wear_h
#define tread_analysis_work_wear_h

#include <tread/analysis/wear_law.h>

namespace tread
{
  /// Volume in proportion to the work of friction, which is T-gamma over the distance rolled (Bolton and
  /// Clayton 1984).
  class WorkWear : public WearLaw
  {
  public:
    static constexpr const char *name        = "friction work";
    static constexpr const char *description = "in proportion to the work of friction";

    static void declare(Section &section)
    {
      section.needs({section.path("Wear law"), {name}})
        .declare("Wear per work (mm3 per kJ)", "1", Number(1e-9, 1e6),
                 "Of 'Wear law' friction work: volume that each surface loses.");
    }

    static std::shared_ptr<const WearLaw> make(const dealii::ParameterHandler &section)
    {
      constexpr double in_si = 1e-12; // m^3/J
      return std::make_shared<WorkWear>(in_si * section.get_double("Wear per work (mm3 per kJ)"));
    }

    /// @param per_work m^3/J
    explicit WorkWear(const double per_work)
      : per_work(per_work)
    {
    }

    double volume(const Sliding &sliding) const override
    {
      return per_work * sliding.work;
    }

  private:
    double per_work;
  };
} // namespace tread

#endif
