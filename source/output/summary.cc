// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/summary.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace tread
{
  void Summary::compare(const std::string &name,
                        const std::string &label,
                        const double       scale,
                        const double       value,
                        const std::string &source,
                        const double       reference_value,
                        const double       negligible)
  {
    std::optional<double> difference;
    if (std::abs(reference_value) > negligible)
      difference = value / reference_value - 1.;
    json[name]                      = value;
    json["reference"][name][source] = {{"value", reference_value},
                                       {"source", source},
                                       {"relative_difference", nullptr}};
    if (difference)
      json["reference"][name][source]["relative_difference"] = *difference;
    lines.push_back({label, source, scale * value, scale * reference_value, difference});
  }


  void Summary::show(const std::string &name,
                     const std::string &label,
                     const double       scale,
                     const double       value)
  {
    set(name, value);
    lines.push_back({label, "", scale * value, 0., {}});
  }


  std::string Summary::table() const
  {
    // One row a label, one column a source.
    std::vector<std::string>                           sources;
    std::vector<std::string>                           labels;
    std::map<std::string, std::map<std::string, Line>> rows;
    for (const Line &line : lines)
      {
        if (rows.find(line.label) == rows.end())
          labels.push_back(line.label);
        rows[line.label][line.source] = line;
        if (!line.source.empty() && std::find(sources.begin(), sources.end(), line.source) == sources.end())
          sources.push_back(line.source);
      }
    std::string text;
    char        buffer[256];
    std::snprintf(buffer, sizeof buffer, "%-32s %12s", "", "computed");
    text += buffer;
    for (const std::string &source : sources)
      {
        std::snprintf(buffer, sizeof buffer, " %12s %8s", source.c_str(), "diff.");
        text += buffer;
      }
    text += "\n";
    for (const std::string &label : labels)
      {
        const auto &columns = rows[label];
        std::snprintf(buffer, sizeof buffer, "%-32s %12.5g", label.c_str(), columns.begin()->second.value);
        text += buffer;
        for (const std::string &source : sources)
          if (const auto column = columns.find(source); column != columns.end())
            {
              const Line &line = column->second;
              std::snprintf(buffer, sizeof buffer, " %12.5g", line.reference);
              text += buffer;
              if (line.difference)
                std::snprintf(buffer, sizeof buffer, " %+7.2f%%", 100. * *line.difference);
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
