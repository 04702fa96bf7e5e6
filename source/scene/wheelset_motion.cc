// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/csv_table.h>
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/base/median.h>
#include <tread/scene/wheelset_motion.h>

// clang-format off
#include <math.h> // isnan without a namespace, which pchip.hpp of Boost 1.74 asks for
#include <boost/math/interpolators/pchip.hpp>
// clang-format on

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace tread
{
  WheelsetMotion::WheelsetMotion(const std::string &file)
  {
    struct Column
    {
      const char *name;
      double      in_si;
      Curve      *curve;
    };
    const std::array<Column, 4> columns{{{"lateral_shift_mm", 1e-3, &shift},
                                         {"yaw_mrad", 1e-3, &yaw},
                                         {"roll_mrad", 1e-3, &roll},
                                         {"angular_velocity_rad_per_s", 1., &angular_velocity}}};
    const std::string           parameter = "'Guidance/File': ";
    const auto                  is_known  = [&](const std::string &name) {
      return name == "time_s" ||
             std::any_of(columns.begin(), columns.end(), [&](const Column &c) { return name == c.name; });
    };
    const CsvTable table = [&] {
      try
        {
          return CsvTable(
            file,
            [&](const std::string &name) {
              if (!is_known(name))
                throw InputError(parameter + "'" + file + "' has a column '" + name +
                                 "'; it may have time_s, lateral_shift_mm, yaw_mrad, roll_mrad and "
                                 "angular_velocity_rad_per_s");
              return true;
            },
            parameter + "cannot read '" + file + "'");
        }
      catch (const InputError &error)
        {
          const std::string text = error.what();
          throw InputError((text.rfind(parameter, 0) == 0 ? "" : parameter) + text);
        }
    }();
    const std::vector<double> &time = table.column("time_s");
    if (time.size() < 4)
      throw InputError(parameter + "'" + file + "' has " + std::to_string(time.size()) +
                       " rows; four are the least");
    if (time.front() > 0.)
      throw InputError(parameter + "'" + file + "' begins at " + text_of(time.front()) +
                       " s, after the start of the run at 0");
    constexpr double shortest = 1e-9; // s
    for (std::size_t row = 1; row < time.size(); ++row)
      if (!(time[row] - time[row - 1] >= shortest))
        throw InputError(parameter + "'" + file + "', row " + std::to_string(row + 1) + ": time_s " +
                         text_of(time[row]) + " does not follow " + text_of(time[row - 1]));
    constexpr double largest = 1e6; // of any number: none of a wheelset comes near
    for (const std::string &name : table.names())
      for (std::size_t row = 0; row < time.size(); ++row)
        if (const double value = table.column(name)[row]; !(std::abs(value) <= largest))
          throw InputError(parameter + "'" + file + "', row " + std::to_string(row + 1) + ": " + name + " " +
                           text_of(value) + " is larger than " + text_of(largest));
    // A gap among samples that are otherwise evenly spread is a piece that is missing.
    std::vector<double> steps;
    for (std::size_t row = 1; row < time.size(); ++row)
      steps.push_back(time[row] - time[row - 1]);
    const double     usual       = median(steps);
    constexpr double largest_gap = 20.; // times the median
    for (std::size_t k = 0; k < steps.size(); ++k)
      if (steps[k] > largest_gap * usual)
        throw InputError(parameter + "'" + file + "', row " + std::to_string(k + 2) + ": a gap of " +
                         text_of(steps[k]) + " s after rows " + text_of(usual) + " s apart");
    last       = time.back();
    bool moves = false;
    for (const Column &column : columns)
      if (table.has(column.name))
        {
          std::vector<double> values = table.column(column.name), times = time;
          for (double &value : values)
            value *= column.in_si;
          if (column.curve == &shift)
            for (std::size_t row = 1; row < time.size(); ++row)
              lateral_speed = std::max(lateral_speed,
                                       std::abs(values[row] - values[row - 1]) / (time[row] - time[row - 1]));
          const double final = values.back();
          const auto   curve = std::make_shared<boost::math::interpolators::pchip<std::vector<double>>>(
            std::move(times), std::move(values));
          *column.curve = [curve, final, end = last](const double t) {
            return t < end ? (*curve)(t) : final;
          };
          moves = true;
        }
    if (!moves)
      throw InputError(parameter + "'" + file + "' has nothing beside time_s");
  }


  Across WheelsetMotion::at(const double time, const Across &otherwise) const
  {
    Across now = otherwise;
    if (shift)
      now.y = shift(time);
    if (yaw)
      now.yaw = yaw(time);
    if (roll)
      now.roll = roll(time);
    if (angular_velocity)
      now.angular_velocity = angular_velocity(time);
    return now;
  }
} // namespace tread
