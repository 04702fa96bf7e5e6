// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/summary.h>

#include <cstdio>
#include <map>

namespace tread
{
  void Summary::compare(const std::string &name,
                        const std::string &label,
                        const double       scale,
                        const double       value,
                        const std::string &source,
                        const double       reference_value)
  {
    json[name]                      = value;
    json["reference"][name][source] = {
      {"value", reference_value},
      {"source", source},
      {"relative_difference", reference_value != 0. ? value / reference_value - 1. : 0.}};
    lines.push_back({label, source, scale * value, scale * reference_value});
  }


  std::string Summary::table() const
  {
    // One row a label; Hertz and the half-space solver are columns.
    std::vector<std::string>                           labels;
    std::map<std::string, std::map<std::string, Line>> rows;
    for (const Line &line : lines)
      {
        if (rows.find(line.label) == rows.end())
          labels.push_back(line.label);
        rows[line.label][line.source] = line;
      }
    std::string text;
    char        buffer[256];
    std::snprintf(buffer, sizeof buffer, "%-32s %12s %12s %8s %12s %8s\n", "", "computed", "Hertz", "diff.",
                  "half-space", "diff.");
    text += buffer;
    for (const std::string &label : labels)
      {
        const auto &columns = rows[label];
        std::snprintf(buffer, sizeof buffer, "%-32s %12.5g", label.c_str(), columns.begin()->second.value);
        text += buffer;
        for (const char *source : {"Hertz", "half-space"})
          if (const auto column = columns.find(source); column != columns.end())
            {
              const Line &line = column->second;
              std::snprintf(buffer, sizeof buffer, " %12.5g", line.reference);
              text += buffer;
              if (line.reference != 0.)
                std::snprintf(buffer, sizeof buffer, " %+7.2f%%", 100. * (line.value / line.reference - 1.));
              else
                std::snprintf(buffer, sizeof buffer, " %8s", "");
              text += buffer;
            }
          else
            {
              std::snprintf(buffer, sizeof buffer, " %12s %8s", "", "");
              text += buffer;
            }
        text += "\n";
      }
    return text;
  }
} // namespace tread
