// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/sections/contact.h>

#include <algorithm>
#include <numbers>
#include <string>

namespace tread
{
  void ContactSection::declare(ParameterTable &table)
  {
    Section section(table, "Contact");
    // Of the tables of factors, whose columns are parameters of their own.
    constexpr unsigned int most_rows   = 10000;
    const auto             add_factors = [&](const std::string &name, std::vector<double> &factors,
                                 const std::string &of_these) {
      section.add(name, factors,
                              "Factors on the friction coefficient at these " + of_these + ", one for each.",
                              Number(0., 100.), most_rows);
    };

    section.add("Friction coefficient", friction_coefficient,
                "Without slip; that of Coulomb's law is the same at any slip speed. 0 is frictionless.",
                Number(0., 2.));
    section.choose("Friction law", friction_law, friction_laws(),
                   "How the friction coefficient depends on the slip speed of each node.");
    declare_friction_laws(section);
    section.add(
      "Friction places (mm)", friction_places,
      "Where along the rail the friction coefficient is multiplied by 'Friction factors': x, ascending, "
      "separated by commas; linear in between, constant beyond. As for leaves or a lubricated spot.",
      Number(-1e6, 1e6), most_rows);
    add_factors("Friction factors", friction_factors, "places");
    section.add("Friction pressures (MPa)", friction_pressures,
                "Pressures of a node at which its friction coefficient is multiplied by 'Friction pressure "
                "factors': ascending, separated by commas; linear in between, constant beyond. As for layers "
                "that shear at a limit, or elastic asperities.",
                Number(0., 1e6), most_rows);
    add_factors("Friction pressure factors", pressure_factors, "pressures");
    section.add("Friction temperatures (C)", temperatures,
                "Temperatures of the surfaces at which the friction coefficient is multiplied by 'Friction "
                "temperature factors': ascending, separated by commas; linear in between, constant beyond. "
                "'Damage/Rail temperature (C)' and 'Wheel temperature (C)' are those before friction heats "
                "them; needs 'Damage/Record'.",
                Number(-100., 1500.), most_rows);
    add_factors("Friction temperature factors", temperature_factors, "temperatures");
    section.add(
      "Friction across (mm)", across_places,
      "Where across the rail the friction coefficient is multiplied by 'Friction across factors': y from "
      "the middle of the rail's top, the gauge side at y < 0; ascending, separated by commas; linear in "
      "between, constant beyond. As for a lubricated gauge corner.",
      Number(-200., 200.), most_rows);
    add_factors("Friction across factors", across_factors, "places");
    section.add(
      "Friction inclinations (deg)", inclinations,
      "The same by the inclination of the rail's surface in the track, positive where it falls to the "
      "gauge side: 0 on the top, 60 to 80 on the gauge face.",
      Number(-90., 90.), most_rows);
    add_factors("Friction inclination factors", inclination_factors, "inclinations");
    section.add(
      "Tolerance", solver.tolerance,
      "Sweeps over the contact nodes end when no impulse changes by more than this share of the largest.",
      Number(1e-15, 0.1));
    section.add("Largest number of sweeps", solver.max_sweeps, "Limit of the sweeps in one time step.",
                WholeNumber(1, 100000));
  }


  namespace
  {
    /// Of values at ascending places, linear in between and constant beyond; 1 if there are none.
    double interpolated(const std::vector<double> &places, const std::vector<double> &values, const double x)
    {
      if (places.empty() || values.size() != places.size()) // check() refuses these
        return 1.;
      const auto after = std::upper_bound(places.begin(), places.end(), x);
      if (after == places.begin())
        return values.front();
      if (after == places.end())
        return values.back();
      const std::size_t k     = after - places.begin();
      const double      share = (x - places[k - 1]) / (places[k] - places[k - 1]);
      return (1. - share) * values[k - 1] + share * values[k];
    }
  } // namespace


  double ContactSection::friction_factor(const double x) const
  {
    return interpolated(friction_places, friction_factors, x);
  }


  double ContactSection::pressure_factor(const double pressure) const
  {
    return interpolated(friction_pressures, pressure_factors, pressure);
  }


  double ContactSection::temperature_factor(const double temperature) const
  {
    return interpolated(temperatures, temperature_factors, temperature);
  }


  double ContactSection::factor_across(const double y, const double inclination) const
  {
    return interpolated(across_places, across_factors, y) *
           interpolated(inclinations, inclination_factors, inclination);
  }


  bool ContactSection::friction_varies(const double from, const double to) const
  {
    const double first  = friction_factor(from);
    bool         varies = friction_factor(to) != first;
    for (const double place : friction_places)
      varies = varies || (place > from && place < to && friction_factor(place) != first);
    return varies;
  }


  void ContactSection::check() const
  {
    const auto check_table = [](const std::vector<double> &places, const std::string &name, const double unit,
                                const std::vector<double> &factors, const std::string &of_factors,
                                const std::string &each) {
      require(places.size() == factors.size(),
              "'Contact/" + name + "' has " + std::to_string(places.size()) + " entries and 'Contact/" +
                of_factors + "' " + std::to_string(factors.size()) + ": each " + each + " has a factor");
      for (std::size_t k = 1; k < places.size(); ++k)
        require(places[k - 1] < places[k], "'Contact/" + name + "': " + text_of(places[k - 1] / unit) +
                                             " must be below " + text_of(places[k] / unit) +
                                             ", which follows it");
    };
    check_table(friction_places, "Friction places (mm)", 1e-3, friction_factors, "Friction factors", "place");
    check_table(friction_pressures, "Friction pressures (MPa)", 1e6, pressure_factors,
                "Friction pressure factors", "pressure");
    check_table(temperatures, "Friction temperatures (C)", 1., temperature_factors,
                "Friction temperature factors", "temperature");
    check_table(across_places, "Friction across (mm)", 1e-3, across_factors, "Friction across factors",
                "place");
    check_table(inclinations, "Friction inclinations (deg)", std::numbers::pi / 180., inclination_factors,
                "Friction inclination factors", "inclination");
  }
} // namespace tread
