// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/word_or_number.h>
#include <tread/scene/section.h>

#include <deal.II/base/utilities.h>

#include <array>
#include <memory>
#include <numbers>

namespace tread
{
  namespace
  {
    using dealii::Patterns::Double;

    /// A value in SI units is the number in the file times `times` over `over`.
    struct Unit
    {
      const char *name;
      double      times, over;
    };

    constexpr std::array<Unit, 36> units{{{"mm", 1e-3, 1.},        {"C", 1., 1.},
                                          {"%", 1., 100.},         {"m", 1., 1.},
                                          {"GPa", 1e9, 1.},        {"MPa", 1e6, 1.},
                                          {"kg", 1., 1.},          {"kg m2", 1., 1.},
                                          {"kg per m3", 1., 1.},   {"km per h", 1., 3.6},
                                          {"m per s2", 1., 1.},    {"kN per m", 1e3, 1.},
                                          {"MN per m", 1e6, 1.},   {"MN", 1e6, 1.},
                                          {"kg per m", 1., 1.},    {"N s per m", 1., 1.},
                                          {"kN s per m", 1e3, 1.}, {"1 per s", 1., 1.},
                                          {"1 per m", 1., 1.},     {"m per s", 1., 1.},
                                          {"mrad", 1e-3, 1.},      {"deg", std::numbers::pi, 180.},
                                          {"rad per s", 1., 1.},   {"minutes", 60., 1.},
                                          {"us", 1., 1e6},         {"um", 1., 1e6},
                                          {"time steps", 1., 1.},  {"semi-axes", 1., 1.},
                                          {"kN", 1e3, 1.},         {"t", 1e3, 1.},
                                          {"kN m", 1e3, 1.},       {"MN m per rad", 1e6, 1.},
                                          {"MN m2", 1e6, 1.},      {"kN m s per rad", 1e3, 1.},
                                          {"W per m K", 1., 1.},   {"J per kg K", 1., 1.}}};

    Unit unit_of(const std::string &name)
    {
      if (name.empty() || name.back() != ')')
        return {"", 1., 1.};
      const std::size_t open = name.rfind('(');
      const std::string unit = name.substr(open + 1, name.size() - open - 2);
      for (const Unit &known : units)
        if (unit == known.name)
          return known;
      throw std::logic_error("the unit of parameter '" + name + "' is not known");
    }

    /// With as many digits as a user would give, and no round-off of the conversion.
    std::string in_file(const double value, const Unit &unit)
    {
      return format("%.12g", value / unit.times * unit.over);
    }

    double in_si(const std::string &text, const Unit &unit)
    {
      return unit.times * dealii::Utilities::string_to_double(text) / unit.over;
    }
  } // namespace


  Section::Section(dealii::ParameterHandler &handler, const std::string &name)
    : handler(handler)
  {
    handler.enter_subsection(name);
  }


  Section::~Section()
  {
    handler.leave_subsection();
  }


  void Section::add(const std::string &name, double &value, const std::string &meaning, const Double &range)
  {
    const Unit unit = unit_of(name);
    declare(name, in_file(value, unit), meaning, range,
            [&value, unit](const std::string &text) { value = in_si(text, unit); });
  }


  void Section::add(const std::string   &name,
                    std::vector<double> &values,
                    const std::string   &meaning,
                    const Double        &range,
                    const unsigned int   at_most)
  {
    const Unit  unit = unit_of(name);
    std::string list;
    for (const double value : values)
      list += (list.empty() ? "" : ",") + in_file(value, unit);
    declare(name, list, meaning, dealii::Patterns::List(range, values.empty() ? 0 : 1, at_most),
            [&values, unit](const std::string &text) {
              values.clear();
              for (const std::string &part : dealii::Utilities::split_string_list(text))
                values.push_back(in_si(part, unit));
            });
  }


  void Section::add(const std::string     &name,
                    std::optional<double> &value,
                    const std::string     &word,
                    const std::string     &meaning,
                    const Double          &range)
  {
    const Unit unit = unit_of(name);
    declare(name, value ? in_file(*value, unit) : word, meaning, WordOrNumber(word, range),
            [&value, word, unit](const std::string &text) {
              value = text == word ? std::optional<double>() : in_si(text, unit);
            });
  }


  void Section::declare(const std::string                              &name,
                        const std::string                              &value,
                        const std::string                              &meaning,
                        const dealii::Patterns::PatternBase            &pattern,
                        const std::function<void(const std::string &)> &take)
  {
    handler.declare_entry(name, value, pattern, meaning);
    handler.add_action(name, take);
  }
} // namespace tread
