// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/csv_table.h>
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/base/text_file.h>
#include <tread/geometry/slice_list.h>
#include <tread/geometry/wheel_deviation.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tread
{
  namespace
  {
    constexpr double millimetre = 1e-3;

    /// The unit of a column of angles, by its name; 0: it has none.
    double unit_of_angle(const std::string &name)
    {
      if (name == "angle_deg" || name == "theta_deg")
        return std::numbers::pi / 180.;
      return name == "angle_rad" || name == "theta_rad" ? 1. : 0.;
    }

    /// The place across in mm that a column of a wide table is for: "y-30", "y+5", "y7.5_mm".
    std::optional<double> place_in(std::string name)
    {
      if (name.ends_with("_mm"))
        name.resize(name.size() - 3);
      if (name.size() < 2 || name[0] != 'y')
        return {};
      return number_in(name.substr(name[1] == '+' ? 2 : 1));
    }

    /// Lines over their angle, from low to high.
    void sort(DeviationLines &scan)
    {
      if (scan.angles.size() > 1 && scan.angles[1] < scan.angles[0])
        {
          std::reverse(scan.angles.begin(), scan.angles.end());
          std::reverse(scan.dz.begin(), scan.dz.end());
        }
    }

    DeviationLines from_wide(const CsvTable &table, const std::string &angle)
    {
      DeviationLines scan{table.file, {}, {}, {}};
      for (const double value : table.column(angle))
        scan.angles.push_back(unit_of_angle(angle) * value);
      scan.dz.resize(scan.angles.size());
      for (const std::string &name : table.names())
        if (const std::optional<double> y = place_in(name))
          {
            scan.y.push_back(millimetre * *y);
            for (std::size_t i = 0; i < scan.dz.size(); ++i)
              scan.dz[i].push_back(millimetre * table.column(name)[i]);
          }
      return scan;
    }

    /// A row for each point: lines follow each other, all with the same places.
    DeviationLines from_long(const CsvTable &table, const std::string &angle)
    {
      DeviationLines             scan{table.file, {}, {}, {}};
      const std::vector<double> &angles = table.column(angle), &y = table.column("y_mm"),
                                &dz = table.column("dz_mm");
      for (std::size_t row = 0; row < angles.size(); ++row)
        {
          const double here = unit_of_angle(angle) * angles[row];
          if (scan.angles.empty() || here != scan.angles.back())
            {
              scan.angles.push_back(here);
              scan.dz.emplace_back();
            }
          const std::size_t j = scan.dz.back().size();
          if (scan.dz.size() == 1)
            scan.y.push_back(millimetre * y[row]);
          else
            require(j < scan.y.size() && std::abs(scan.y[j] - millimetre * y[row]) < 1e-9,
                    "'" + table.file + "', row " + std::to_string(row + 1) + ": y_mm is " + text_of(y[row]) +
                      (j < scan.y.size() ? " where the first line has " + text_of(scan.y[j] / millimetre)
                                         : " beyond the last place of the first line") +
                      "; all lines of a scan must have the same places across");
          scan.dz.back().push_back(millimetre * dz[row]);
        }
      for (std::size_t i = 0; i < scan.dz.size(); ++i)
        require(scan.dz[i].size() == scan.y.size(),
                "'" + table.file + "': the line at " + text_of(scan.angles[i] / unit_of_angle(angle)) +
                  " has " + std::to_string(scan.dz[i].size()) + " places, the first line " +
                  std::to_string(scan.y.size()));
      return scan;
    }

    DeviationLines read_scan_table(const std::string &file)
    {
      const CsvTable table(
        file,
        [&file](const std::string &name) {
          require(unit_of_angle(name) > 0. || name == "y_mm" || name == "dz_mm" || place_in(name),
                  "'" + file + "': the column '" + name +
                    "' is none of a scan, which has angle_deg or angle_rad, y_mm and dz_mm, or in place of "
                    "these two a "
                    "column for each place across, such as y+5: give it such a name, or remove it");
          return true;
        },
        "cannot read '" + file + "'");
      std::vector<std::string> angles, places;
      for (const std::string &name : table.names())
        {
          if (unit_of_angle(name) > 0.)
            angles.push_back(name);
          if (place_in(name))
            places.push_back(name);
        }
      const bool is_long = table.has("y_mm") && table.has("dz_mm");
      require(angles.size() == 1 && is_long == places.empty(),
              "'" + file +
                "': a scan has the columns angle_deg or angle_rad, y_mm and dz_mm, or angle_deg or angle_rad "
                "and a column of dz in mm for each place across, such as y-30 and y+5");
      require(table.n_rows() > 0, "'" + file + "' has no rows");
      DeviationLines scan = is_long ? from_long(table, angles[0]) : from_wide(table, angles[0]);
      sort(scan);
      return scan;
    }

    /// Sections whose z points down, as CONTACT has them; each is the round wheel with what it has more.
    DeviationLines read_wheel_slices(const std::string &file, const ProfileCurve &profile)
    {
      const SliceList      list = read_slice_list(file);
      const CurveFromAbove round(profile);
      DeviationLines       scan{file, {}, {}, {}, true};
      // Over a part of the tread that all have.
      double begin = round.begin(), end = round.end();
      for (const SliceList::Entry &entry : list.entries)
        {
          require(entry.features.empty(),
                  "'" + file + "': features of a wheel's slices (NFEAT) are not available; they must be 0");
          require(entry.points.size() >= 4,
                  "'" + file + "': the slice at " + text_of(entry.along) + " rad has less than four points");
          double low = entry.points.front().first, high = low;
          for (const auto &[y, z] : entry.points)
            {
              low  = std::min(low, y);
              high = std::max(high, y);
            }
          begin = std::max(begin, low);
          end   = std::min(end, high);
        }
      // The flank of a flange is left as it is: there dz along the radius means nothing.
      constexpr double flank = -35e-3, spacing = 0.5e-3;
      begin = std::max(begin, flank);
      require(end > begin, "'" + file + "': its slices have no part of the tread in common");
      const auto n = static_cast<unsigned int>(std::ceil((end - begin) / spacing));
      for (unsigned int k = 0; k <= n; ++k)
        scan.y.push_back(begin + (end - begin) * k / n);
      for (const SliceList::Entry &entry : list.entries)
        {
          std::vector<dealii::Point<2>> points;
          for (const auto &[y, z] : entry.points)
            points.emplace_back(y, -z);
          if (points.front()[0] > points.back()[0])
            std::reverse(points.begin(), points.end());
          const CurveFromAbove slice{ProfileCurve(points)};
          scan.angles.push_back(entry.along);
          scan.dz.emplace_back();
          for (const double y : scan.y)
            {
              const double inside = std::clamp(y, slice.begin(), slice.end());
              scan.dz.back().push_back(round.height(y) - slice.height(inside));
            }
        }
      if (list.approximates && scan.dz.size() >= 4)
        {
          // The slices are the control points of a cubic B-spline whose knots lie at their angles (Piegl and
          // Tiller 1997, section 2.2); it passes beside them.
          const auto        given = scan.dz;
          const std::size_t last  = given.size() - 1;
          const auto        way   = [&](const std::size_t i) {
            return scan.angles[i + 1] - scan.angles[i];
          };
          for (std::size_t i = 1; i < last; ++i)
            {
              const double before = way(i - 1), behind = way(i), both = before + behind;
              const double first  = behind * behind / (((i > 1 ? way(i - 2) : before) + both) * both),
                           second = before * before / ((both + (i + 1 < last ? way(i + 1) : behind)) * both);
              for (std::size_t j = 0; j < scan.y.size(); ++j)
                scan.dz[i][j] =
                  first * given[i - 1][j] + (1. - first - second) * given[i][j] + second * given[i + 1][j];
            }
        }
      return scan;
    }
  } // namespace


  DeviationLines read_deviation_lines(const std::string &file, const std::function<ProfileCurve()> &profile)
  {
    if (file.ends_with(".slcw"))
      return read_wheel_slices(file, profile());
    if (file.ends_with(".csv"))
      return read_scan_table(file);
    throw InputError("'" + file +
                     "': the deviation of a wheel is a file that ends in .csv or .slcw, "
                     "\"flat: length_mm=... depth_mm=...\" or \"waves: ORDER=AMPLITUDE_MM@CREST_DEG "
                     "...\"");
  }
} // namespace tread
