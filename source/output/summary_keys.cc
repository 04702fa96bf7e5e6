// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/summary_keys.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>
#include <utility>

namespace tread
{
  namespace
  {
    using Call = std::pair<SummaryGroup, SummaryKeys>;

    /// What was made known, in whatever order the files of a program are linked.
    std::vector<Call> &calls()
    {
      static std::vector<Call> list;
      return list;
    }


    // Keys that several places set. Others are beside what sets them.

    const std::string over_last_way = "mean over the last 10 mm of the path",
                      largest_patch = "; of a wheelset in a position the largest of its patches",
                      all_patches   = "; of a wheelset in a position the sum of its patches";

    /// Of each wheel; the keys of further ones have its number in their names.
    struct WheelKey
    {
      std::string name, about;
      std::string of_first = ""; ///< what is to be added of the plain key
    };
    const std::vector<WheelKey> of_wheel{
      {"normal_force_N", "Vertical force on the wheel, " + over_last_way,
       " (half-space solver: the load); of a wheelset in a position of all its patches together"},
      {"longitudinal_force_N", "Force on the wheel along the rail, positive forward, " + over_last_way},
      {"lateral_force_N", "Force on the wheel across the rail, positive to the field side, " + over_last_way,
       "; of a wheelset in a position positive to its own side"},
      {"traction_coefficient", "Longitudinal over normal force, 0 without a normal force"},
      {"creepage", "Angular velocity x rolling radius over speed, less 1, counted from free rolling, at the "
                   "end of the run; positive when driving"},
      {"free_rolling_creepage",
       "At which the loaded wheel rolls freely, by the difference of both surfaces' stretch along the rail "
       "at the start, beyond that of half-spaces; creepages are counted from it"},
      {"max_pressure_Pa", "Largest pressure of a node, " + over_a_cell, largest_patch},
      {"patch_area_m2", "Area in contact, " + over_a_cell, all_patches},
      {"adhesion_share", "Share of the area that sticks, " + over_a_cell},
      {"max_slip_m_per_s",
       "Largest micro-slip of a node, the velocity of the wheel over the rail, " + over_a_cell,
       largest_patch},
      {"frictional_power_W", "Power that friction takes in the patch, " + over_a_cell, all_patches}};

    /// Of the first wheel, or of the second, which stands for all further ones.
    SummaryKeys keys_of_wheel(const bool is_first)
    {
      SummaryKeys keys;
      for (const WheelKey &key : of_wheel)
        keys.push_back(is_first ? SummaryKey{key.name, key.about + key.of_first}
                                : SummaryKey{"wheel_2_" + key.name, key.about});
      return keys;
    }

    const bool common_keys_are_known =
      know_summary_keys(
        SummaryGroup::run,
        {{"title", "'Scene/Title'"},
         {"method", "How it was solved: explicit finite elements, or half-space solver (tread reference)"},
         {"completed", "Whether the end was reached: false after an interruption, and where contact was "
                       "about to leave the faces meshed for it"}}) &&
      know_summary_keys(SummaryGroup::wheels, keys_of_wheel(true)) &&
      know_summary_keys(SummaryGroup::further_wheels, keys_of_wheel(false)) &&
      know_summary_keys(
        SummaryGroup::first_wheel,
        {{"friction_coefficient",
          "'Contact/Friction coefficient', which factors of places, slip and pressure may change"},
         {"max_shear_Pa", "Largest shear stress of a node, " + over_a_cell + largest_patch}}) &&
      know_summary_keys(
        SummaryGroup::words,
        {{"warnings",
          "Measures of quality beyond their thresholds and other reasons to doubt the figures, in words"}}) &&
      know_summary_keys(
        SummaryGroup::cost,
        {{"wall_s", "Wall time without the generation of the mesh, with that of a resumed run before "
                    "(half-space solver: of the whole answer)"},
         {"ranks", "Processes of MPI"},
         {"version", "Of the program"},
         {"files", "Files that the run has read: a list with the parameter that names each ('parameter file' "
                   "for the scene's own text), its path, and bytes and crc32 of its content"}}) &&
      know_summary_keys(
        SummaryGroup::damage,
        {{"t_gamma_N",
          "Frictional power over the rolling speed: T-gamma, spin included, summed over all patches"},
         {"max_flash_temperature_K",
          "Largest rise of temperature by the heat of friction, of rail and wheels, in all steps"}});


    /// @throws std::logic_error if one was described twice
    SummaryKeys all_keys()
    {
      std::vector<Call> sorted = calls();
      std::sort(sorted.begin(), sorted.end());
      SummaryKeys           all;
      std::set<std::string> names;
      for (const auto &[group, keys] : sorted)
        for (const SummaryKey &key : keys)
          {
            if (!names.insert(key.name).second)
              throw std::logic_error("'" + key.name + "' of summary.json is described twice");
            all.push_back(key);
          }
      return all;
    }

    /// A key as the list has it.
    std::string without_numbers(const std::string &key)
    {
      static const std::regex further_wheel("^wheel_[0-9]+_"), cell("^cell_[0-9]+_"),
        source("^reference/[^/]*/[^/]*/"), uncertainty("^.*_half_space_uncertainty$");
      std::string text = std::regex_replace(key, further_wheel, "wheel_2_");
      text             = std::regex_replace(text, cell, "cell_1_");
      text             = std::regex_replace(text, source, "reference/max_pressure_Pa/Hertz/");
      return std::regex_replace(text, uncertainty, "max_pressure_Pa_half_space_uncertainty");
    }

    /// Some have their unit, or that of the figure to which they belong, within the name.
    std::string unit_of_key(const std::string &key)
    {
      static const std::regex within(
        "^(wall_s)_.*$|^(.*)_half_space_uncertainty$|^reference/([^/]*)/[^/]*/(?:value|uncertainty)$");
      return unit_of_heading(std::regex_replace(key, within, "$1$2$3"));
    }
  } // namespace


  bool know_summary_keys(const SummaryGroup group, const SummaryKeys &keys)
  {
    calls().emplace_back(group, keys);
    return true;
  }


  TableDescription keys_of_summary()
  {
    TableDescription table{"summary.json", {}};
    for (const SummaryKey &key : all_keys())
      table.columns.push_back({key.name, unit_of_key(key.name), key.about});
    return table;
  }


  std::string about_summary_key(const std::string &key)
  {
    static const std::map<std::string, std::string> meanings = []() {
      std::map<std::string, std::string> of_names;
      for (const SummaryKey &known : all_keys())
        of_names[known.name] = known.about;
      return of_names;
    }();
    const auto found = meanings.find(without_numbers(key));
    return found == meanings.end() ? "" : found->second;
  }
} // namespace tread
