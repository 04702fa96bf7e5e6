// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_t_gamma_damage_h
#define tread_analysis_t_gamma_damage_h

#include <tread/analysis/damage_index.h>
#include <tread/base/format.h>
#include <tread/base/input_error.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace tread
{
  /// Damage of a passage as a function of T-gamma, linear between points that the user gives: below a
  /// threshold none, then cracks begin, and where much is worn off they do not come to grow (Burstow 2004).
  class TGammaDamage : public DamageIndex
  {
  public:
    static constexpr const char *key = "t_gamma_damage";
    static constexpr const char *about =
      "Damage of one passage by 'Damage/Function T-gammas (N)' and 'Function damages'";

    static void declare(Section &section)
    {
      section.declare("Function T-gammas (N)", "", ListOf(Number(0., 1e6), 0, 100),
                      "Points of a function that says what damage a passage does by its T-gamma, from "
                      "low to high; empty: none.");
      section.declare("Function damages", "", ListOf(Number(-1e6, 1e6), 0, 100),
                      "Damage of a passage at each of 'Function T-gammas (N)', linear between them; "
                      "below 0 where wear takes cracks away.");
    }

    static std::shared_ptr<const DamageIndex> make(const dealii::ParameterHandler &section)
    {
      const auto list = [&](const char *name) {
        return dealii::Utilities::string_to_double(dealii::Utilities::split_string_list(section.get(name)));
      };
      auto index = std::make_shared<TGammaDamage>(list("Function T-gammas (N)"), list("Function damages"));
      return index->t_gammas.empty() ? nullptr : index;
    }

    /// @param t_gammas N, rising; @param damages at them @throws InputError
    TGammaDamage(const std::vector<double> &t_gammas, const std::vector<double> &damages)
      : t_gammas(t_gammas)
      , damages(damages)
    {
      require(std::adjacent_find(t_gammas.begin(), t_gammas.end(), std::greater_equal<>()) == t_gammas.end(),
              "'Damage/Function T-gammas (N)' must rise from number to number");
      require(damages.size() == t_gammas.size(),
              format("'Damage/Function T-gammas (N)' has %zu numbers, 'Function damages' has %zu",
                     t_gammas.size(), damages.size()));
    }

    /// Before the first point and behind the last it stays.
    std::optional<double> value(const Load &load) const override
    {
      const std::size_t k =
        std::upper_bound(t_gammas.begin(), t_gammas.end(), load.t_gamma) - t_gammas.begin();
      if (k == 0 || k == t_gammas.size())
        return k == 0 ? damages.front() : damages.back();
      return damages[k - 1] + (damages[k] - damages[k - 1]) * (load.t_gamma - t_gammas[k - 1]) /
                                (t_gammas[k] - t_gammas[k - 1]);
    }

  private:
    std::vector<double> t_gammas, damages;
  };
} // namespace tread

#endif
