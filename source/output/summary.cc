// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/summary.h>
#include <tread/output/summary_keys.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <map>

namespace tread
{
  namespace
  {
    const bool keys_of_references_are_known = know_summary_keys(
      SummaryGroup::references,
      {{"max_pressure_Pa_half_space_uncertainty",
        "How far the half-space's largest pressure may lie from the limit of small elements; likewise behind "
        "the names of other figures"},
       {"reference", "Figures of the summary with what they are compared with: by name and source"},
       {"reference/max_pressure_Pa/Hertz/value",
        "What the figure is compared with: of Hertz's ellipse under the normal force (the load of a wheel "
        "that has lifted off), or of the half-space in steady rolling"},
       {"reference/max_pressure_Pa/Hertz/source", "Hertz or half-space"},
       {"reference/max_pressure_Pa/Hertz/relative_difference",
        "Figure less this value, over the value; null where the value is as good as zero"},
       {"reference/max_pressure_Pa/Hertz/uncertainty",
        "Of a half-space's value: how far it may lie from the limit of small elements"}});
  } // namespace


  void Summary::require_meaning(const std::string &name)
  {
    Assert(!about_summary_key(name).empty(), dealii::ExcMessage("no call of know_summary_keys() says what '" +
                                                                name + "' of summary.json means"));
    (void)name;
  }


  void Summary::compare(const std::string          &name,
                        const std::string          &label,
                        const double                scale,
                        const double                value,
                        const std::string          &source,
                        const double                reference_value,
                        const double                negligible,
                        const std::optional<double> uncertainty)
  {
    require_meaning(name);
    std::optional<double> difference;
    if (std::abs(reference_value) > negligible)
      difference = value / reference_value - 1.;
    json[name]                      = value;
    json["reference"][name][source] = {{"value", reference_value},
                                       {"source", source},
                                       {"relative_difference", nullptr}};
    if (difference)
      json["reference"][name][source]["relative_difference"] = *difference;
    Line line{label, source, scale * value, scale * reference_value, difference, {}};
    if (uncertainty)
      {
        json["reference"][name][source]["uncertainty"] = *uncertainty;
        std::string key                                = name + "_" + source + "_uncertainty";
        std::replace(key.begin(), key.end(), '-', '_');
        std::transform(key.begin() + name.size(), key.end(), key.begin() + name.size(),
                       [](const unsigned char c) { return std::tolower(c); });
        json[key]        = *uncertainty;
        line.uncertainty = scale * *uncertainty;
      }
    lines.push_back(line);
  }


  void Summary::show(const std::string &name,
                     const std::string &label,
                     const double       scale,
                     const double       value,
                     const std::string &after)
  {
    set(name, value);
    auto place = lines.end();
    if (!after.empty())
      place = std::find_if(lines.begin(), lines.end(), [&](const Line &line) { return line.label == after; });
    lines.insert(place == lines.end() ? place : place + 1, {label, "", scale * value, 0., {}, {}});
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
    const auto uncertain = [&](const std::string &source) {
      return std::any_of(lines.begin(), lines.end(),
                         [&](const Line &line) { return line.source == source && line.uncertainty; });
    };
    std::string text;
    char        buffer[256];
    std::snprintf(buffer, sizeof buffer, "%-32s %12s", "", "computed");
    text += buffer;
    for (const std::string &source : sources)
      {
        std::snprintf(buffer, sizeof buffer, " %12s%s %8s", source.c_str(),
                      uncertain(source) ? "   +-     " : "", "diff.");
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
              if (line.uncertainty)
                std::snprintf(buffer, sizeof buffer, " +-%-7.2g", *line.uncertainty);
              else
                std::snprintf(buffer, sizeof buffer, "%s", uncertain(source) ? "          " : "");
              text += buffer;
              if (line.difference)
                std::snprintf(buffer, sizeof buffer, " %+7.2f%%", 100. * *line.difference);
              else
                std::snprintf(buffer, sizeof buffer, " %8s", "");
              text += buffer;
            }
          else
            {
              std::snprintf(buffer, sizeof buffer, " %12s%s %8s", "", uncertain(source) ? "          " : "",
                            "");
              text += buffer;
            }
        text += "\n";
      }
    return text;
  }
} // namespace tread
