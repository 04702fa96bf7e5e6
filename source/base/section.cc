// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/section.h>

#include <deal.II/base/utilities.h>

#include <array>
#include <memory>
#include <numbers>

namespace tread
{
  namespace
  {
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


  Section::Section(ParameterTable &table, const std::string &name)
    : table(table)
    , name(name)
  {
    table.values.enter_subsection(name);
  }


  Section::~Section()
  {
    table.values.leave_subsection();
  }


  void Section::add(const std::string &name, double &value, const std::string &meaning, const Number &range)
  {
    const Unit unit = unit_of(name);
    declare(name, in_file(value, unit), range, meaning,
            [&value, unit](const std::string &text) { value = in_si(text, unit); });
  }


  void Section::add(const std::string   &name,
                    std::vector<double> &values,
                    const std::string   &meaning,
                    const Number        &range,
                    const unsigned int   at_most)
  {
    const Unit  unit = unit_of(name);
    std::string list;
    for (const double value : values)
      list += (list.empty() ? "" : ",") + in_file(value, unit);
    declare(name, list, ListOf(range, values.empty() ? 0 : 1, at_most), meaning,
            [&values, unit](const std::string &text) {
              values.clear();
              for (const std::string &part : dealii::Utilities::split_string_list(text))
                values.push_back(in_si(part, unit));
            });
  }


  void Section::add(const std::string &name,
                    std::vector<int>  &values,
                    const std::string &meaning,
                    const WholeNumber &range,
                    const unsigned int at_most)
  {
    std::string list;
    for (const int value : values)
      list += (list.empty() ? "" : ",") + std::to_string(value);
    declare(name, list, ListOf(range, values.empty() ? 0 : 1, at_most), meaning,
            [&values](const std::string &text) {
              values = dealii::Utilities::string_to_int(dealii::Utilities::split_string_list(text));
            });
  }


  void Section::add(const std::string     &name,
                    std::optional<double> &value,
                    const std::string     &word,
                    const std::string     &meaning,
                    const Number          &range)
  {
    const Unit unit = unit_of(name);
    declare(name, value ? in_file(*value, unit) : word, WordOrNumber(word, range), meaning,
            [&value, word, unit](const std::string &text) {
              value = text == word ? std::optional<double>() : in_si(text, unit);
            });
  }


  void Section::add(const std::string &name,
                    unsigned int      &value,
                    const std::string &meaning,
                    const WholeNumber &range)
  {
    declare(name, std::to_string(value), range, meaning,
            [&value](const std::string &text) { value = dealii::Utilities::string_to_int(text); });
  }


  void Section::add(const std::string &name, bool &value, const std::string &meaning)
  {
    declare(name, value ? "true" : "false", TrueOrFalse(), meaning,
            [&value](const std::string &text) { value = text == "true"; });
  }


  void Section::add(const std::string  &name,
                    std::string        &value,
                    const std::string  &meaning,
                    const AllowedTexts &allowed)
  {
    declare(name, value, allowed, meaning, [&value](const std::string &text) { value = text; });
  }


  void Section::declare(const std::string                              &parameter,
                        const std::string                              &value,
                        const AllowedTexts                             &allowed,
                        const std::string                              &meaning,
                        const std::function<void(const std::string &)> &take)
  {
    std::vector<Need> all = of_all;
    all.insert(all.end(), of_next.begin(), of_next.end());
    of_next.clear();
    const Parameter record{name, parameter, value, meaning, allowed.copy(), all};
    table.values.declare_entry(parameter, value, allowed, record.documentation());
    if (take)
      table.values.add_action(parameter, take);
    if (!table.find(name + "/" + parameter)) // laws of one kind may share some
      table.declared.push_back(record);
  }
} // namespace tread
