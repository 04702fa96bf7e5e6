// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/parameter_table.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace tread
{
  Need::Need(const std::string &path, const std::vector<std::string> &values, const std::string &words)
    : path(path)
    , words(words)
    , all{{{path, values}}}
  {
    if (words.empty() && !values.empty())
      {
        const std::string first = boost::algorithm::join(std::vector(values.begin(), values.end() - 1), ", ");
        this->words             = first + (first.empty() ? "" : " or ") + values.back();
      }
  }


  Need Need::of_fact(const std::string &path, const std::string &words, const std::string &fact)
  {
    Need need(path, {}, words);
    need.all.clear();
    need.fact = fact;
    return need;
  }


  Need &Need::and_has(const std::string &path, const std::vector<std::string> &values)
  {
    all.push_back({{path, values}});
    return *this;
  }


  Need &Need::or_has(const std::string &path, const std::vector<std::string> &values)
  {
    all.back().push_back({path, values});
    return *this;
  }


  Need &Need::or_else(const Need &other)
  {
    others.push_back(other);
    return *this;
  }


  std::string Need::in_words() const
  {
    return "'" + path + "' " + words;
  }


  std::string Need::in_full() const
  {
    std::string text = in_words();
    for (const Need &other : others)
      text += ", or " + other.in_words();
    return text;
  }


  std::string Parameter::documentation() const
  {
    std::string text;
    for (auto need = needs.begin(); need != needs.end(); ++need)
      if (std::none_of(need + 1, needs.end(), [&](const Need &later) { return later.path == need->path; }))
        text += (text.empty() ? " Needs " : " and ") + need->in_full();
    return meaning + text + (text.empty() ? "" : ".");
  }


  const Parameter *ParameterTable::find(const std::string &path) const
  {
    const auto found = std::find_if(declared.begin(), declared.end(),
                                    [&](const Parameter &parameter) { return parameter.path() == path; });
    return found == declared.end() ? nullptr : &*found;
  }


  std::string ParameterTable::value(const Parameter &parameter) const
  {
    return values.get({parameter.section}, parameter.name);
  }


  bool ParameterTable::set(const Parameter &parameter, const std::string &text)
  {
    bool is_allowed = true;
    values.enter_subsection(parameter.section);
    try
      {
        values.set(parameter.name, text);
      }
    catch (const dealii::ExceptionBase &)
      {
        is_allowed = false;
      }
    values.leave_subsection();
    return is_allowed;
  }


  bool ParameterTable::same_value(const std::string &a, const std::string &b)
  {
    char        *end_a, *end_b;
    const double number_a = std::strtod(a.c_str(), &end_a), number_b = std::strtod(b.c_str(), &end_b);
    return a == b || (!a.empty() && !b.empty() && *end_a == 0 && *end_b == 0 && number_a == number_b);
  }


  const Need *ParameterTable::unmet_need(const Parameter                                &parameter,
                                         const std::function<bool(const std::string &)> &is_true) const
  {
    const auto has = [&](const Need::Value &wanted) {
      const Parameter *const decides = find(wanted.path);
      if (!decides)
        throw std::logic_error("'" + parameter.path() + "' needs '" + wanted.path + "', which there is not");
      const std::vector<std::string> &values = wanted.values;
      return values.empty() ? is_changed(*decides)
                            : std::find(values.begin(), values.end(), value(*decides)) != values.end();
    };
    const auto has_one = [&](const std::vector<Need::Value> &wanted) {
      return std::any_of(wanted.begin(), wanted.end(), has);
    };
    const std::function<bool(const Need &)> is_met = [&](const Need &need) {
      return ((need.fact.empty() || is_true(need.fact)) &&
              std::all_of(need.all.begin(), need.all.end(), has_one)) ||
             std::any_of(need.others.begin(), need.others.end(), is_met);
    };
    const Need *unmet = nullptr;
    for (const Need &need : parameter.needs)
      if ((!unmet || need.path == unmet->path) && !is_met(need))
        unmet = &need;
    return unmet;
  }
} // namespace tread
