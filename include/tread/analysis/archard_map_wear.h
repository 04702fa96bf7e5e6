// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_archard_map_wear_h
#define tread_analysis_archard_map_wear_h

#include <tread/analysis/wear_law.h>
#include <tread/base/format.h>
#include <tread/base/input_error.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <vector>

namespace tread
{
  /// Archard's law with a coefficient for each range of slip speed and of pressure over hardness, as maps of
  /// wear have them (Lim and Ashby 1987; of rail steels Jendel 2002).
  class ArchardMapWear : public WearLaw
  {
  public:
    static constexpr const char *name        = "Archard map";
    static constexpr const char *description = "as Archard, with a coefficient by slip speed and pressure";

    static void declare(Section &section)
    {
      const Need chosen(section.path("Wear law"), {name});
      section.needs(chosen).declare(
        "Map slip speeds (m per s)", "", ListOf(Number(0., 1e3), 0, 100),
        "Of 'Wear law' Archard map: borders between ranges of the slip speed, from low to high.");
      section.needs(chosen).declare(
        "Map pressures over hardness", "", ListOf(Number(0., 100.), 0, 100),
        "Of 'Wear law' Archard map: borders between ranges of the pressure over 'Hardness (MPa)', "
        "from low to high.");
      section.needs(chosen).declare(
        "Map wear coefficients", "", ListOf(Number(0., 1.), 0, 10201),
        "Of 'Wear law' Archard map: those of all ranges of slip speed at the lowest pressures, then "
        "those at the next ones, and so on.");
    }

    static std::shared_ptr<const WearLaw> make(const dealii::ParameterHandler &section)
    {
      const auto list = [&](const char *name) {
        return dealii::Utilities::string_to_double(dealii::Utilities::split_string_list(section.get(name)));
      };
      return std::make_shared<ArchardMapWear>(
        list("Map slip speeds (m per s)"), list("Map pressures over hardness"), list("Map wear coefficients"),
        1e6 * section.get_double("Hardness (MPa)"));
    }

    /// @param speeds borders, m/s; @param pressures borders, over the hardness; @param coefficients by
    /// pressure, then speed; @param hardness Pa @throws InputError for borders that do not rise, or another
    /// number of coefficients than of ranges
    ArchardMapWear(const std::vector<double> &speeds,
                   const std::vector<double> &pressures,
                   const std::vector<double> &coefficients,
                   const double               hardness)
      : speeds(speeds)
      , pressures(pressures)
      , coefficients(coefficients)
      , hardness(hardness)
    {
      const auto rises = [](const std::vector<double> &borders) {
        return std::adjacent_find(borders.begin(), borders.end(),
                                  [](const double a, const double b) { return a >= b; }) == borders.end();
      };
      require(rises(speeds) && rises(pressures), "'Damage/Map slip speeds (m per s)' and 'Map pressures over "
                                                 "hardness' must rise from number to number");
      const std::size_t n = (speeds.size() + 1) * (pressures.size() + 1);
      require(coefficients.size() == n,
              format("'Damage/Map wear coefficients' has %zu numbers; %zu ranges of the slip speed and %zu "
                     "of the pressure "
                     "need %zu",
                     coefficients.size(), speeds.size() + 1, pressures.size() + 1, n));
    }

    double volume(const Sliding &sliding) const override
    {
      if (!(sliding.distance > 0.))
        return 0.;
      const auto range = [](const std::vector<double> &borders, const double value) {
        return std::upper_bound(borders.begin(), borders.end(), value) - borders.begin();
      };
      const std::size_t speed = range(speeds, sliding.distance / sliding.duration),
                        pressure =
                          range(pressures, sliding.normal / sliding.distance / sliding.area / hardness);
      return coefficients[pressure * (speeds.size() + 1) + speed] / hardness * sliding.normal;
    }

  private:
    std::vector<double> speeds, pressures, coefficients;
    double              hardness;
  };
} // namespace tread

#endif
