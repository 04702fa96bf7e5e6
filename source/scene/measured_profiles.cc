// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/output/columns.h>
#include <tread/output/run_folder.h>
#include <tread/output/summary_keys.h>
#include <tread/reference/elastic.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/measured_profiles.h>

#include <algorithm>
#include <array>

namespace tread
{
  namespace
  {
    /// Points of a measured profile: line of its file, y and z as used, as measured (m).
    const Columns<std::array<double, 5>> &measured_profile_columns()
    {
      static const auto columns = columns_of<5>(
        {{{"line", "", "Of the profile's file that the point stands in"},
          {"y", "mm", "Point of the profile as it is used, placed and smoothed, across the track"},
          {"z", "mm", "The same upwards"},
          {"measured_y", "mm", "The same point before it was smoothed, across the track"},
          {"measured_z", "mm", "The same upwards"}}});
      return columns;
    }

    const bool measured_profiles_are_known =
      know_table(describe("measured_wheel.csv", measured_profile_columns())) &&
      know_table(describe("measured_rail.csv", measured_profile_columns())) &&
      know_summary_keys(SummaryGroup::words,
                        {{"wheel_profile_largest_change_m",
                          "By how much 'Wheel/Smoothing length (mm)' moved a point of the measured tread at "
                          "most, at right angles to it; only where it is above 0"},
                         {"rail_profile_largest_change_m",
                          "The same of 'Rail/Smoothing length (mm)' and the measured head"}});
  } // namespace


  MeasuredProfiles::MeasuredProfiles(const Scene &scene)
  {
    const auto add = [&](const std::string &body, const std::string &parameter, const std::string &file,
                         const ProfileBody kind, const ProfilePlacement &placement) {
      try
        {
          const auto       &read  = scene.parameters().files_read();
          const auto        found = std::find_if(read.begin(), read.end(), [&](const FileRead &of_scene) {
            return of_scene.parameter == parameter;
          });
          const std::string path  = found == read.end() ? file : found->path;
          profiles.push_back(
            {body, parameter, path, placement.smoothing, read_measured_profile(path, kind, placement)});
        }
      catch (const std::runtime_error &error)
        {
          throw InputError("'" + parameter + "': " + error.what());
        }
    };
    if (scene.wheel.has_measured_profile())
      add("wheel", "Wheel/Tread profile", scene.wheel.tread_profile, ProfileBody::wheel,
          scene.wheel.profile_placement);
    if (!scene.rail.measured_head.empty())
      add("rail", "Rail/Measured head", scene.rail.measured_head, ProfileBody::rail,
          scene.rail.head_placement);
    modulus =
      reference::combine(elastic_of(scene.wheel.material), elastic_of(scene.rail.material)).hertz_modulus();
    constexpr double usual_pressure = 1e9; // Pa, of a wheel whose patches are not known yet
    pressure                        = scene.is_positioned() || scene.static_load() <= 0.
                                        ? usual_pressure
                                        : scene.stance().ellipse(scene.static_load()).max_pressure;
  }


  std::vector<std::string> MeasuredProfiles::warnings(const bool with_noise) const
  {
    std::vector<std::string> words;
    for (const Named &p : profiles)
      {
        for (const std::string &remark : p.profile.remarks)
          words.push_back("'" + p.parameter + "': " + remark);
        const double share = p.profile.pressure_of_noise(modulus) / pressure;
        if (with_noise && share > MeasuredProfile::warned_noise)
          words.push_back(format("'%s': profile '%s' has noise, or is rounded, by %.2g um at points %.2g mm "
                                 "apart, which a pressure of %.0f %% of "
                                 "Hertz's presses flat (above %g %%): by about so much the largest pressure "
                                 "is wrong; smooth it by "
                                 "'%s/Smoothing length (mm)', some millimetres",
                                 p.parameter.c_str(), p.file.c_str(), 1e6 * p.profile.noise,
                                 1e3 * p.profile.spacing, 100. * share, 100. * MeasuredProfile::warned_noise,
                                 p.body == "wheel" ? "Wheel" : "Rail"));
      }
    return words;
  }


  std::vector<std::string> MeasuredProfiles::smoothing() const
  {
    std::vector<std::string> words;
    for (const Named &p : profiles)
      if (p.length > 0.)
        words.push_back(format("%s profile smoothed over %g mm: moved by %.3g um at most, at y = %.2f mm",
                               p.body.c_str(), 1e3 * p.length, 1e6 * p.profile.largest_change,
                               1e3 * p.profile.y_of_change));
    return words;
  }


  void MeasuredProfiles::summarise(Summary &summary) const
  {
    for (const Named &p : profiles)
      if (p.length > 0.)
        summary.set(p.body + "_profile_largest_change_m", p.profile.largest_change);
  }


  void MeasuredProfiles::write(const RunFolder &folder) const
  {
    for (const Named &p : profiles)
      {
        std::vector<std::array<double, 5>> rows;
        for (std::size_t i = 0; i < p.profile.points.size(); ++i)
          {
            const ProfilePoint &used = p.profile.points[i], &measured = p.profile.measured[i];
            rows.push_back({{static_cast<double>(used.line), used.y, used.z, measured.y, measured.z}});
          }
        folder.write_table("measured_" + p.body + ".csv", measured_profile_columns(), rows);
      }
  }
} // namespace tread
