// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_regime_wear_rate_h
#define tread_analysis_regime_wear_rate_h

#include <tread/analysis/damage_index.h>
#include <tread/base/input_error.h>
#include <tread/reference/t_gamma.h>

#include <deal.II/base/utilities.h>

#include <vector>

namespace tread
{
  /// Wear by the regimes of T-gamma over area. The figures by default are those of a wheel of R8T on a rail
  /// of 900A (Braghin, Lewis, Dwyer-Joyce and Bruni 2006), whose formula of the last regime is printed
  /// without the rate from which it goes on.
  class RegimeWearRate : public DamageIndex
  {
  public:
    static constexpr const char *key = "regime_wear_rate_kg_per_m3";
    static constexpr const char *about =
      "Mass that a surface loses for each metre rolled and square metre in contact, by T-gamma over area and "
      "'Damage/Regime borders (N per mm2)'";

    static void declare(Section &section)
    {
      section.declare("Regime borders (N per mm2)", "10.4, 77.2", ListOf(Number(0., 1e6), 0, 2),
                      "T-gamma over the area in contact at which wear goes from mild to severe, and "
                      "from severe to catastrophic; by default of a wheel of R8T on a rail of 900A.");
      section.declare("Regime slopes (ug per m N)", "5.3, 61.9", ListOf(Number(0., 1e6), 0, 2),
                      "Mass lost for each metre rolled and newton of T-gamma in the mild regime and, "
                      "from the border on, in the catastrophic one; between them it stays.");
    }

    static std::shared_ptr<const DamageIndex> make(const dealii::ParameterHandler &section)
    {
      const auto pair = [&](const char *name, const double unit) {
        const std::vector<double> list =
          dealii::Utilities::string_to_double(dealii::Utilities::split_string_list(section.get(name)));
        require(list.size() == 2, std::string("'Damage/") + name + "' has two numbers");
        return std::array<double, 2>{{unit * list[0], unit * list[1]}};
      };
      const reference::WearRegimes regimes{pair("Regime borders (N per mm2)", 1e6),
                                           pair("Regime slopes (ug per m N)", 1e-9)};
      require(regimes.borders[0] < regimes.borders[1],
              "'Damage/Regime borders (N per mm2)' must rise from the first to the second");
      return std::make_shared<RegimeWearRate>(regimes);
    }

    explicit RegimeWearRate(const reference::WearRegimes &regimes)
      : regimes(regimes)
    {
    }

    std::optional<double> value(const Load &load) const override
    {
      return load.area > 0. ? std::optional(regimes.rate(load.t_gamma / load.area)) : std::nullopt;
    }

  private:
    reference::WearRegimes regimes;
  };
} // namespace tread

#endif
