// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/sleeper_stress.h>
#include <tread/base/csv_table.h>
#include <tread/base/format.h>
#include <tread/output/run_folder.h>
#include <tread/scene/scene.h>
#include <tread/tools/sleeper_stress_files.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

namespace tread
{
  namespace
  {
    constexpr const char *table_name = "rail_seats.csv";

    /// The rows of a support in rail_seats.csv.
    struct RecordedSeat
    {
      int                 support = 0;
      double              time = 0., wheel_x = 0.; ///< s, m
      std::vector<double> x, y, pressure;          ///< m, Pa

      double sum() const
      {
        double all = 0.;
        for (const double p : pressure)
          all += p;
        return all;
      }
    };

    double number_of(const std::string &text, const std::string &where)
    {
      double value = std::numeric_limits<double>::quiet_NaN();
      try
        {
          value = dealii::Utilities::string_to_double(text);
        }
      catch (const dealii::ExceptionBase &)
        {
        }
      if (!std::isfinite(value))
        throw InputError(where + "'" + text + "' is no number");
      return value;
    }

    std::vector<RecordedSeat> read_seats(const std::string &folder)
    {
      if (!std::filesystem::is_directory(folder))
        throw InputError("no folder '" + folder + "'");
      const std::string name = folder + "/" + table_name;
      const CsvTable    table(
           name, [](const std::string &) { return true; },
           "tread sleeper-stress: '" + folder + "' has no " + table_name +
             ", which a run on discrete supports writes for those in 'Output/Supports'");
      const std::vector<double> &support = table.column("support"), &time = table.column("time_s"),
                                &wheel_x = table.column("wheel_x_mm"), &x = table.column("x_mm"),
                                &y = table.column("y_mm"), &pressure = table.column("pressure_MPa");
      std::vector<RecordedSeat> seats;
      for (std::size_t row = 0; row < table.n_rows(); ++row)
        {
          if (const int number = std::lround(support[row]); seats.empty() || seats.back().support != number)
            {
              seats.emplace_back();
              seats.back().support = number;
              seats.back().time    = time[row];
              seats.back().wheel_x = 1e-3 * wheel_x[row];
            }
          seats.back().x.push_back(1e-3 * x[row]);
          seats.back().y.push_back(1e-3 * y[row]);
          seats.back().pressure.push_back(1e6 * pressure[row]);
        }
      if (seats.empty())
        throw InputError(name + " has no rows");
      return seats;
    }

    /// Whether the run ended with the largest force of its supports, on this one.
    bool largest_force_at_end(const nlohmann::json &summary, const int support)
    {
      return summary.value("largest_pad_force_at_end", false) &&
             summary.value("largest_pad_force_support", support - 1) == support;
    }

    /// What makes the instant of the largest force doubtful, in lines.
    std::string doubts(const nlohmann::json &summary, const RecordedSeat &seat, const double start)
    {
      constexpr double near_start = 0.5e-3; // m of the wheel's way
      std::string      lines;
      if (largest_force_at_end(summary, seat.support))
        lines += "WARNING: the force on this support was still growing when the run ended\n";
      if (!summary.value("completed", true))
        lines += "WARNING: the run was interrupted, and larger forces may come later\n";
      if (std::abs(seat.wheel_x - start) < near_start)
        lines += "WARNING: the force on this support was largest when the run began\n";
      return lines;
    }

    const RecordedSeat &chosen(const std::vector<RecordedSeat> &seats, const SleeperStressRequest &request)
    {
      if (request.support.empty())
        return *std::max_element(
          seats.begin(), seats.end(),
          [](const RecordedSeat &a, const RecordedSeat &b) { return a.sum() < b.sum(); });
      std::string all;
      for (const RecordedSeat &seat : seats)
        {
          if (std::to_string(seat.support) == request.support)
            return seat;
          all += (all.empty() ? "" : ", ") + std::to_string(seat.support);
        }
      throw InputError("--support cannot be '" + request.support + "'; " + request.run + "/" + table_name +
                       " has " + all);
    }

    /// Parameters of the run by their path.
    class Parameters
    {
    public:
      explicit Parameters(const std::string &run)
        : run(run)
        , list(Scene::parameters_in(run + "/parameters.prm"))
      {
      }

      const std::string &text(const std::string &path) const
      {
        for (const ParameterFile::Setting &parameter : list)
          if (parameter.path == path)
            return parameter.value;
        throw InputError(run + "/parameters.prm has no '" + path + "'");
      }

      double number(const std::string &path, const double factor = 1.) const
      {
        return factor * number_of(text(path), run + "/parameters.prm: '" + path + "': ");
      }

    private:
      const std::string                   run;
      std::vector<ParameterFile::Setting> list;
    };

    SeatPressures pressures_of(const RecordedSeat &seat, const Parameters &parameters, const std::string &run)
    {
      SeatPressures p;
      p.n_along    = std::lround(parameters.number("Track/Points along"));
      p.n_across   = std::lround(parameters.number("Track/Points across"));
      p.pad_length = parameters.number("Track/Pad length (mm)", 1e-3);
      p.pad_width  = parameters.number("Track/Pad width (mm)", 1e-3);
      p.pressure   = seat.pressure;
      // Rounding of nine digits.
      constexpr double same_place = 1e-6;
      bool             fits       = seat.pressure.size() == std::size_t(p.n_along) * p.n_across;
      for (std::size_t i = 0; fits && i < seat.x.size(); ++i)
        fits = std::abs(seat.x[i] - p.pad_length * ((i / p.n_across + 0.5) / p.n_along - 0.5)) < same_place &&
               std::abs(seat.y[i] - p.pad_width * ((i % p.n_across + 0.5) / p.n_across - 0.5)) < same_place;
      if (!fits)
        throw InputError(run + "/" + table_name + ": the points of support " + std::to_string(seat.support) +
                         " are not those of the pad in parameters.prm");
      return p;
    }

    /// What is to be said of a solid sleeper that is not as heavy as the one that the run moved.
    std::string other_mass(const double mass, const double of_scene)
    {
      constexpr double same = 0.01;
      return std::abs(mass - of_scene) <= same * of_scene
               ? ""
               : format(
                   " by shape and density ('Track/Sleeper mass (kg)' of the run is %g: the static stress "
                   "does not depend on either)",
                   of_scene);
    }

    nlohmann::ordered_json place_of(const dealii::Point<3> &p)
    {
      return {p[0], p[1], p[2]};
    }
  } // namespace


  void write_sleeper_stress(const SleeperStressRequest &request, const MPI_Comm comm)
  {
    if (request.bottom != "fixed" && request.bottom != "ballast")
      throw InputError("--bottom cannot be '" + request.bottom + "'; allowed: fixed, ballast");
    SleeperStressParameters p;
    if (!request.cell_size_mm.empty())
      {
        // Finer ones do not fit into the memory of a workstation.
        constexpr double least = 2., most = 50.;
        const double     size = number_of(request.cell_size_mm, "--cell-size: ");
        if (size < least || size > most)
          throw InputError("--cell-size cannot be '" + request.cell_size_mm + "'; allowed: 2 to 50 mm");
        p.cell_size = 1e-3 * size;
      }
    const std::vector<RecordedSeat> seats = read_seats(request.run);
    const RecordedSeat             &seat  = chosen(seats, request);
    const Parameters                parameters(request.run);
    const SeatPressures             pressures = pressures_of(seat, parameters, request.run);
    p.young_modulus                           = parameters.number("Track/Sleeper Young's modulus (GPa)", 1e9);
    p.poisson_ratio                           = parameters.number("Track/Sleeper Poisson's ratio");
    if (request.bottom == "ballast")
      {
        if (parameters.text("Track/Foundation") != "two-layer")
          throw InputError("--bottom ballast: " + request.run + " has no ballast, only '" +
                           parameters.text("Track/Foundation") + "'");
        if (!parameters.text("Track/Support file").empty())
          throw InputError("--bottom ballast: " + request.run +
                           " has 'Track/Support file', whose ballast is not looked up");
        p.ballast_stiffness = parameters.number("Track/Ballast stiffness (MN per m)", 1e6);
      }
    const SleeperShape shape = SleeperShape::ns90();
    const double       mass  = shape.volume() * parameters.number("Track/Sleeper density (kg per m3)");

    const double of_scene = parameters.number("Track/Sleeper mass (kg)");

    // The shape is that of one sleeper, whatever the run's weighs.
    constexpr double         differs = 0.02; // share
    std::vector<std::string> warnings;
    if (const double of_run = parameters.number("Track/Sleeper mass (kg)");
        parameters.text("Track/Foundation") == "two-layer" && std::abs(mass / of_run - 1.) > differs)
      warnings.push_back(
        format("half the sleeper of the run weighs %.4g kg ('Track/Sleeper mass (kg)'), that of an NS 90 "
               "at 'Track/Sleeper density (kg per m3)' %.4g kg: the stress is that in an NS 90",
               of_run, mass));
    const RunFolder folder(request.output.empty() ? request.run : request.output, comm);
    SleeperStress   s;
    try
      {
        s = sleeper_stress(shape, pressures, p, comm, folder.path("sleeper_stress.vtu"));
      }
    catch (const std::invalid_argument &error)
      {
        throw InputError(error.what());
      }
    const nlohmann::json summary = summary_in(request.run);
    const auto [least, largest]  = std::minmax_element(pressures.pressure.begin(), pressures.pressure.end());

    nlohmann::ordered_json json;
    json["run"]                   = request.run;
    json["support"]               = seat.support;
    json["time_s"]                = seat.time;
    json["wheel_x_m"]             = seat.wheel_x;
    json["at_end_of_run"]         = largest_force_at_end(summary, seat.support);
    json["run_completed"]         = summary.value("completed", true);
    json["bottom"]                = request.bottom;
    json["max_von_mises_Pa"]      = s.max_von_mises;
    json["max_von_mises_place_m"] = place_of(s.place);
    json["max_tension_Pa"]        = s.max_tension;
    json["max_tension_place_m"]   = place_of(s.tension_place);
    json["places_counted_from"]   = "middle of the rail seat: x along the rail, y outwards, z upwards";
    json["seat_force_N"]          = pressures.force();
    json["max_seat_pressure_Pa"]  = *largest;
    json["min_seat_pressure_Pa"]  = *least;
    json["nodal_force_N"]         = s.force;
    json["seat_moment_x_Nm"]      = pressures.moment_x();
    json["nodal_moment_x_Nm"]     = s.moment_x;
    json["seat_moment_y_Nm"]      = pressures.moment_y();
    json["nodal_moment_y_Nm"]     = s.moment_y;
    json["bottom_force_N"]        = s.bottom_force;
    if (p.ballast_stiffness)
      {
        json["max_bottom_pressure_Pa"] = s.largest_bottom_pressure;
        json["min_bottom_pressure_Pa"] = s.least_bottom_pressure;
      }
    json["mean_seat_settlement_m"] = s.mean_seat_settlement;
    json["half_sleeper_mass_kg"]   = mass;
    json["scene_sleeper_mass_kg"]  = of_scene;
    json["warnings"]               = warnings;
    json["young_modulus_Pa"]       = p.young_modulus;
    json["poisson_ratio"]          = p.poisson_ratio;
    json["order_of_elements"]      = p.degree;
    json["cell_size_m"]            = p.cell_size;
    json["seat_cell_m"]            = {s.seat_cell_along, s.seat_cell_across};
    json["cells"]                  = s.cells;
    json["unknowns"]               = s.unknowns;
    json["iterations"]             = s.iterations;
    json["ranks"]                  = dealii::Utilities::MPI::n_mpi_processes(comm);
    folder.write("sleeper_stress.json",
                 json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      for (const std::string &warning : warnings)
        std::printf("WARNING: %s\n", warning.c_str());
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      std::printf(
        "%ssupport %d of %s at %.6g s, wheel at %.2f mm: %.4g kN on the rail seat, %.4g to %.4g MPa\n"
        "half a sleeper of %.1f kg%s, bottom %s: %zu cells, %zu unknowns, %u iterations\n"
        "largest von Mises stress %.4g MPa at (%.1f, %.1f, %.1f) mm from the middle of the seat\n"
        "largest tension          %.4g MPa at (%.1f, %.1f, %.1f) mm\n"
        "force on the bottom %.6g kN\n"
        "Results in %s: sleeper_stress.json; for ParaView: sleeper_stress.vtu\n",
        doubts(summary, seat, parameters.number("Motion/Start (mm)", 1e-3)).c_str(), seat.support,
        request.run.c_str(), seat.time, 1e3 * seat.wheel_x, 1e-3 * pressures.force(), 1e-6 * *least,
        1e-6 * *largest, mass, other_mass(mass, of_scene).c_str(),
        request.bottom == "fixed" ? "fixed" : "on ballast", s.cells, s.unknowns, s.iterations,
        1e-6 * s.max_von_mises, 1e3 * s.place[0], 1e3 * s.place[1], 1e3 * s.place[2], 1e-6 * s.max_tension,
        1e3 * s.tension_place[0], 1e3 * s.tension_place[1], 1e3 * s.tension_place[2], 1e-3 * s.bottom_force,
        folder.path("").c_str());
  }
} // namespace tread
