// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/wheelset_contact.h>
#include <tread/base/csv_table.h>
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/geometry/rail_slices.h>
#include <tread/output/progress.h>
#include <tread/reference/all_cores.h>
#include <tread/tools/answer_table.h>
#include <tread/tools/position_files.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>

namespace tread
{
  namespace
  {
    /// A row of the table. Lengths in m, angles in rad.
    struct PositionRow
    {
      std::string rail, wheel = "S1002", deviation; ///< of the wheel from round; empty: none
      double      smoothing = 0.;                   ///< of a scan of it
      double      s = 0., shift = 0., yaw = 0., roll = 0., pitch = 0.;
      double      load = 0., height = 0.; ///< N; m over the radius, where no load is given
      double      radius = 0.46, back_distance = 1.36, back_position = -70e-3;
      double      rail_y = 0.75, rail_z = 0.;
      double      friction = 0.3, speed = 2., turning = 0.; ///< -, m/s, rad/s; 0: rolls freely at the radius
      double      young = 210e9, poisson = 0.3;
      double      distance = 8e-3, element_x = 0., element_y = 0.;

      std::string surfaces() const
      {
        return format("%.17g %.17g %.17g %.17g %.17g %.17g ", radius, back_distance, back_position, rail_y,
                      rail_z, smoothing) +
               rail + '\n' + wheel + '\n' + deviation;
      }
    };

    struct NumberColumn
    {
      const char *name;
      double PositionRow::*value;
      double               unit;
      bool                 required;
      double               least, most; ///< in the unit of the table
    };
    const std::vector<NumberColumn> &number_columns()
    {
      constexpr double                       mm = 1e-3, any = 1e9, tiny = 1e-9;
      static const std::vector<NumberColumn> list{
        {"s_mm", &PositionRow::s, mm, true, -any, any},
        {"y_ws_mm", &PositionRow::shift, mm, true, -100., 100.},
        {"load_N", &PositionRow::load, 1., false, tiny, any},
        {"height_mm", &PositionRow::height, mm, false, -100., 100.},
        {"yaw_rad", &PositionRow::yaw, 1., false, -0.09, 0.09},
        {"roll_rad", &PositionRow::roll, 1., false, -0.09, 0.09},
        {"pitch_rad", &PositionRow::pitch, 1., false, -any, any},
        {"radius_mm", &PositionRow::radius, mm, false, 10., 2000.},
        {"flange_back_distance_mm", &PositionRow::back_distance, mm, false, 0., 3000.},
        {"flange_back_mm", &PositionRow::back_position, mm, false, -200., 0.},
        {"rail_y_mm", &PositionRow::rail_y, mm, false, -3000., 3000.},
        {"rail_z_mm", &PositionRow::rail_z, mm, false, -1000., 1000.},
        {"wheel_deviation_smoothing_mm", &PositionRow::smoothing, mm, false, 0., 100.},
        {"friction", &PositionRow::friction, 1., false, 0., 10.},
        {"speed_m_per_s", &PositionRow::speed, 1., false, tiny, 1000.},
        {"angular_velocity_rad_per_s", &PositionRow::turning, 1., false, 0., 1e6},
        {"young_Pa", &PositionRow::young, 1., false, tiny, 1e15},
        {"poisson", &PositionRow::poisson, 1., false, 0., 0.499},
        {"patch_distance_mm", &PositionRow::distance, mm, false, 0., 100.},
        {"element_x_mm", &PositionRow::element_x, mm, false, 0., 100.},
        {"element_y_mm", &PositionRow::element_y, mm, false, 0., 100.}};
      return list;
    }

    bool is_word(const std::string &name)
    {
      return name == "rail" || name == "wheel" || name == "wheel_deviation";
    }

    std::vector<PositionRow> read_positions(const std::string &file, std::string &not_read)
    {
      const CsvTable table(
        file,
        [&](const std::string &name) {
          const bool known =
            is_word(name) || std::any_of(number_columns().begin(), number_columns().end(),
                                         [&](const NumberColumn &c) { return c.name == name; });
          if (!known)
            not_read += (not_read.empty() ? "" : ", ") + name;
          return known;
        },
        "tread positions: cannot read '" + file + "'", is_word);
      if (table.n_rows() == 0)
        throw InputError("'" + file + "' has no rows");
      if (table.has("load_N") == table.has("height_mm"))
        throw InputError("'" + file + "' needs one of the columns load_N and height_mm");
      std::vector<PositionRow> rows(table.n_rows());
      for (const NumberColumn &c : number_columns())
        if (c.required || table.has(c.name))
          for (std::size_t row = 0; row < rows.size(); ++row)
            {
              const double value = table.column(c.name)[row];
              if (!(value >= c.least && value <= c.most))
                throw InputError("'" + file + "', row " + std::to_string(row + 1) + ": " + c.name + " is " +
                                 text_of(value) + "; allowed: " + text_of(c.least) + " to " +
                                 text_of(c.most));
              rows[row].*c.value = c.unit * value;
            }
      const std::filesystem::path folder = std::filesystem::path(file).parent_path();
      // Words that are the names of files beside the table are these files.
      const auto beside = [&](const std::string &name, const std::size_t row) {
        const std::string word = table.words(name)[row];
        return std::filesystem::is_regular_file(folder / word) ? (folder / word).string() : word;
      };
      for (std::size_t row = 0; row < rows.size(); ++row)
        {
          rows[row].rail = (folder / table.words("rail")[row]).string();
          if (table.has("wheel"))
            rows[row].wheel = beside("wheel", row);
          if (table.has("wheel_deviation"))
            rows[row].deviation = beside("wheel_deviation", row);
        }
      return rows;
    }

    /// Slices, or the same profile at every x.
    std::shared_ptr<const Surface> rail_surface(const std::string &file)
    {
      if (has_rail_slices(file))
        return std::make_shared<SlicedRail>(read_rail_slices(file));
      try
        {
          return std::make_shared<PrismSurface>(measured_rail_curve(file));
        }
      catch (const std::runtime_error &error)
        {
          throw InputError(error.what());
        }
    }

    WheelOnRail surfaces_of(const PositionRow &row)
    {
      TrackGauge gauge;
      gauge.back_distance = row.back_distance;
      gauge.back_position = row.back_position;
      const auto wheel    = [&] {
        try
          {
            return wheel_curve(row.wheel);
          }
        catch (const std::runtime_error &error)
          {
            throw InputError("wheel '" + row.wheel + "': " + error.what());
          }
      };
      const ProfileCurve                    round = wheel();
      std::shared_ptr<const WheelDeviation> deviation;
      if (!row.deviation.empty())
        deviation = wheel_deviation(
          row.deviation, [&] { return round; }, row.radius, row.smoothing);
      return WheelOnRail(WheelSurface(round, deviation), rail_surface(row.rail), row.radius, gauge,
                         WheelOnRail::RailOrigin{row.rail_y, row.rail_z});
    }

    WheelContact solve(const WheelOnRail &surfaces, const PositionRow &row)
    {
      WheelRolling rolling;
      rolling.friction = row.friction;
      rolling.wheel = rolling.rail = {row.young, row.poisson};
      rolling.speed                = row.speed;
      rolling.angular_velocity     = row.turning > 0. ? row.turning : row.speed / row.radius;
      rolling.separation           = row.distance;
      rolling.element_x            = row.element_x;
      rolling.element_y            = row.element_y;
      const WheelsetPosition position{row.shift, row.yaw, row.roll, row.height, row.s, row.pitch};
      return row.load > 0. ? contact_under_load(surfaces, rolling, position, row.load)
                           : contact_at_height(surfaces, rolling, position);
    }

    const char *const head =
      "row,s_mm,y_ws_mm,height_mm,patch,x_mm,y_mm,z_mm,angle_rad,normal_force_N,longitudinal_force_N,"
      "lateral_force_N,max_pressure_Pa,area_mm2,length_mm,width_mm,overlap_mm,vertical_force_N,part\n";

    std::string rows_of(const std::size_t                  number,
                        const PositionRow                 &row,
                        const std::optional<WheelContact> &contact)
    {
      const std::string first = format("%zu,%.9g,%.9g,", number, 1e3 * row.s, 1e3 * row.shift);
      if (!contact)
        return first + "nan,0,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,\n";
      if (contact->patches.empty())
        return first + format("%.9g,0,nan,nan,nan,nan,0,0,0,0,0,0,0,0,0,\n", 1e3 * contact->position.height);
      std::string  text;
      unsigned int patch = 0;
      for (const WheelPatch &p : contact->patches)
        {
          const reference::PlanarResult &s = p.solution;
          text += first +
                  format("%.9g,%u,%.7f,%.7f,%.7f,%.7f,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,",
                         1e3 * contact->position.height, ++patch, 1e3 * p.region.reference[0],
                         1e3 * p.region.reference[1], 1e3 * p.region.reference[2], p.angle(), s.normal_force,
                         s.longitudinal_force, s.lateral_force, s.max_pressure, 1e6 * s.area,
                         1e3 * (s.x_end - s.x_begin), 1e3 * (s.y_end - s.y_begin), 1e3 * s.overlap,
                         contact->force[2]) +
                  p.body + '\n';
        }
      return text;
    }
  } // namespace


  void write_positions(const std::string &positions, const std::string &output, const MPI_Comm comm)
  {
    check_answer_table("tread positions", positions, output, comm);
    Progress                       progress(true);
    std::string                    not_read;
    const std::vector<PositionRow> rows = read_positions(positions, not_read);
    if (!not_read.empty())
      progress.say("note: columns that mean nothing here, left out: " + not_read);
    std::map<std::string, WheelOnRail> surfaces;
    for (const PositionRow &row : rows)
      if (surfaces.find(row.surfaces()) == surfaces.end())
        {
          const WheelOnRail &here = surfaces.emplace(row.surfaces(), surfaces_of(row)).first->second;
          progress.say(here.rail_surface().in_words() + "; " + here.wheel_surface().in_words());
          for (const std::string &doubt : here.rail_surface().doubts())
            progress.say("warning: " + doubt);
        }

    std::vector<std::optional<WheelContact>> answers(rows.size());
    std::vector<std::string>                 reasons(rows.size());
    reference::on_all_cores(rows.size(), 0, [&] {
      return [&, own = surfaces](const std::size_t k) {
        try
          {
            answers[k] = solve(own.at(rows[k].surfaces()), rows[k]);
          }
        catch (const std::exception &error)
          {
            reasons[k] = error.what();
          }
      };
    });

    write_answer_table(output, [&](std::ostream &file) {
      file << head;
      for (std::size_t k = 0; k < rows.size(); ++k)
        file << rows_of(k + 1, rows[k], answers[k]);
    });
    progress.say(
      format("%zu positions in %.2f s. Results in %s", rows.size(), progress.seconds(), output.c_str()));
    const auto is_missing = [&](const auto &answer) {
      return !answer.has_value();
    };
    if (const auto failed = std::count_if(answers.begin(), answers.end(), is_missing))
      {
        const std::size_t first = std::find_if(answers.begin(), answers.end(), is_missing) - answers.begin();
        throw std::runtime_error(
          format("%zu of %zu positions were not solved, in their rows stands nan; the first is row %zu: ",
                 static_cast<std::size_t>(failed), rows.size(), first + 1) +
          reasons[first]);
      }
  }
} // namespace tread
