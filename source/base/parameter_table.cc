// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/parameter_table.h>

#include <algorithm>

namespace tread
{
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
} // namespace tread
