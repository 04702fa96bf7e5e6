// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/output/summary_keys.h>
#include <tread/recorders/impact_record.h>

#include <utility>

namespace tread
{
  namespace
  {
    const bool keys_of_impacts_are_known = know_summary_keys(
      SummaryGroup::impacts,
      {{"largest_normal_force_N",
        "Largest normal force on the first wheel, mean over an interval of the history"},
       {"largest_normal_force_x_m", "Where the wheel was at the end of that interval"},
       {"largest_normal_force_over_static", "This force over the static load of a wheel"},
       {"largest_normal_force_at_end",
        "Whether it is that of the last interval: a run that had gone on might have exceeded it"},
       {"least_normal_force_N",
        "Least normal force on the first wheel, mean over an interval of the history"},
       {"least_normal_force_x_m", "Where the wheel was at the end of that interval"},
       {"least_normal_force_over_static", "This force over the static load of a wheel"},
       {"least_normal_force_at_end",
        "Whether it is that of the last interval: a run that had gone on might have fallen below it"},
       {"airborne_s", "How long the first wheel was in the air: intervals of the history without any force"},
       {"largest_pad_force_N", "Largest compressive force in the pad of a recorded support at the end of an "
                               "interval of the history"},
       {"largest_pad_force_x_m", "Where the first wheel was then"},
       {"largest_pad_force_support", "Number of that support"},
       {"largest_pad_force_at_end", "Whether it is that of the last interval"},
       {"largest_ballast_force_N", "Largest compressive force in the ballast under a recorded support at the "
                                   "end of an interval of the history"},
       {"largest_ballast_force_x_m", "Where the first wheel was then"},
       {"largest_ballast_force_support", "Number of that support"},
       {"largest_ballast_force_at_end", "Whether it is that of the last interval"}});
  } // namespace


  void ImpactRecord::add(const HistoryRow &row, const double seconds)
  {
    // Of a wheelset with both wheels the own one, whose rail has the defect.
    const double force = row.wheels.front().force[2] - row.wheels.front().other_force[2];
    if (!has_rows || force > largest.value)
      largest = {force, row.position, 0};
    if (!has_rows || force < least.value)
      least = {force, row.position, 0};
    if (!(force > 0.))
      airborne += seconds;
    for (std::size_t i = 0; i < row.supports.size(); ++i)
      {
        if (!has_supports || row.supports[i].pad_force > pad.value)
          pad = {row.supports[i].pad_force, row.position, supports[i]};
        if (!has_supports || row.supports[i].ballast_force > ballast.value)
          ballast = {row.supports[i].ballast_force, row.position, supports[i]};
        has_supports = true;
      }
    has_rows = true;
    last_x   = row.position;
  }


  void ImpactRecord::add_to(Summary &summary) const
  {
    if (!has_rows)
      return;
    for (const auto &[name, extreme] : {std::pair("largest", largest), std::pair("least", least)})
      {
        const std::string prefix = std::string(name) + "_normal_force_";
        summary.set(prefix + "N", extreme.value);
        summary.set(prefix + "x_m", extreme.x);
        summary.set(prefix + "over_static", extreme.value / static_load);
        summary.set(prefix + "at_end", is_at_end(extreme));
      }
    summary.set("airborne_s", airborne);
    if (!has_supports)
      return;
    for (const auto &[name, extreme] : {std::pair("pad", pad), std::pair("ballast", ballast)})
      {
        const std::string prefix = "largest_" + std::string(name) + "_force_";
        summary.set(prefix + "N", extreme.value);
        summary.set(prefix + "x_m", extreme.x);
        summary.set(prefix + "support", extreme.support);
        summary.set(prefix + "at_end", is_at_end(extreme));
      }
  }


  std::string ImpactRecord::words() const
  {
    if (!has_rows)
      return "";
    const auto at = [&](const Extreme &e) {
      return format("with the wheel at x = %.1f mm%s\n", 1e3 * e.x,
                    is_at_end(e) ? ": the end of the run, no peak" : "");
    };
    const auto contact = [&](const char *name, const Extreme &e) {
      return format("%s contact force %9.2f kN, %.3f of the static load, ", name, 1e-3 * e.value,
                    e.value / static_load) +
             at(e);
    };
    const auto support = [&](const char *name, const Extreme &e) {
      return format("largest force in %-8s %7.2f kN, at support %d, ", name, 1e-3 * e.value, e.support) +
             at(e);
    };
    return contact("largest", largest) + contact("least  ", least) +
           (airborne > 0. ? format("the wheel was in the air for %.3f ms\n", 1e3 * airborne) : "") +
           (has_supports ? support("a pad", pad) + support("ballast", ballast) : "");
  }


  void ImpactRecord::finish(Report &report)
  {
    add_to(report.summary);
    report.extremes += words();
  }


  void ImpactRecord::serialize(Archive &archive)
  {
    archive.same(has_rows, has_supports, largest, least, pad, ballast, airborne, last_x);
  }
} // namespace tread
