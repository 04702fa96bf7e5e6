// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/dynamic_force.h>
#include <tread/base/csv_table.h>
#include <tread/base/file_text.h>
#include <tread/base/format.h>
#include <tread/output/run_folder.h>
#include <tread/scene/scene.h>
#include <tread/tools/dynamic_force_files.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <sstream>

namespace tread
{
  namespace
  {
    ForceHistory read_forces(const std::string &folder)
    {
      if (!std::filesystem::is_directory(folder))
        throw InputError("no folder '" + folder + "'");
      const std::string name     = folder + "/history.csv";
      const auto        is_force = [](const std::string &column) {
        return column.size() > 2 && column.compare(column.size() - 2, 2, "_N") == 0;
      };
      const CsvTable table(
        name,
        [&](const std::string &column) {
          return column == "time_s" || column == "position_m" || is_force(column);
        },
        "cannot read '" + name + "': is '" + folder + "' the folder of a run?");
      ForceHistory history;
      history.name     = name;
      history.time     = table.column("time_s");
      history.position = table.column("position_m");
      for (const std::string &column : table.names())
        if (is_force(column))
          {
            history.columns.push_back(column);
            history.force.push_back(table.column(column));
          }
      if (history.columns.empty())
        throw InputError(history.name + " has no column of a force, whose name ends with _N");
      return history;
    }

    /// A twin differs from its run by the defect, or by what the wheel is not round by, alone. @returns a
    /// warning where that is not so, or not sure; else ""
    std::string compare_parameters(const std::string &run, const std::string &twin)
    {
      const std::vector<ParameterFile::Setting> of_run  = Scene::parameters_in(run + "/parameters.prm"),
                                                of_twin = Scene::parameters_in(twin + "/parameters.prm");
      bool has_cause                                    = false;
      for (std::size_t i = 0; i < of_run.size(); ++i)
        {
          const std::string &path = of_run[i].path;
          // What makes a rail, or a wheel, unsmooth, and its value where it does not.
          for (const auto &[cause, smooth] :
               {std::pair("Defect/Shape", "none"), std::pair("Wheel/Deviation", "")})
            if (path == cause)
              {
                require(of_twin[i].value == smooth,
                        "no smooth twin: '" + path + "' is '" + of_twin[i].value + "' in " + twin);
                has_cause |= of_run[i].value != smooth;
              }
          const bool may_be_unlike = path.starts_with("Defect/") || path.starts_with("Output/") ||
                                     path.starts_with("Wheel/Deviation") || path == "Scene/Title";
          if (!may_be_unlike && !ParameterTable::same_value(of_run[i].value, of_twin[i].value))
            throw InputError("no smooth twin: '" + path + "' is '" + of_run[i].value + "' in " + run +
                             " and '" + of_twin[i].value + "' in " + twin);
        }
      require(has_cause,
              "nothing to find the effect of: 'Defect/Shape' is 'none' and 'Wheel/Deviation' is empty in " +
                run);
      const FilesCompared files = compare_files(files_in_comments(text_of_file(run + "/parameters.prm")),
                                                files_in_comments(text_of_file(twin + "/parameters.prm")),
                                                {"Defect/", "Wheel/Deviation"});
      require(files.unlike.empty(), "no smooth twin: " + files.unlike);
      if (!files.unknown.empty())
        return "whether " + run + " and " + twin + " have read the same file of '" + files.unknown +
               "' is not known: parameters.prm of one of them does not say what it contained";
      const auto of_twin_is = [&](const std::string &path, const std::string &value) {
        return std::any_of(of_twin.begin(), of_twin.end(), [&](const ParameterFile::Setting &parameter) {
          return parameter.path == path && ParameterTable::same_value(parameter.value, value);
        });
      };
      // See settles().
      if (of_twin_is("Scene/Quasi-static", "true") && of_twin_is("Track/Foundation", "rigid") &&
          of_twin_is("Defect/Length (mm)", "0"))
        return "the axle of " + twin + " settles under its load, as in steady rolling, and that of " + run +
               " has its inertia: 'Scene/Quasi-static' should be false for both";
      return "";
    }

    /// What its summary says of a history: @throws InputError if rows were changed since
    /// @returns a warning where the run did not come to its end, or ""
    std::string doubt_of_history(const std::string &folder)
    {
      const nlohmann::json summary = summary_in(folder);
      if (summary.value("completed", nlohmann::json()) != true)
        return folder + " has no summary of a completed run: its history ends where it was interrupted";
      if (const auto written = summary.find("history_crc32"); written != summary.end())
        require(*written == checksum(text_of_file(folder + "/history.csv")),
                "'" + folder + "/history.csv' is not what its run wrote: rows are missing or changed");
      return "";
    }

    double millimetres(const std::string &text, const std::string &option, const double otherwise)
    {
      if (text.empty())
        return otherwise;
      double value = std::numeric_limits<double>::quiet_NaN();
      try
        {
          value = 1e-3 * dealii::Utilities::string_to_double(text);
        }
      catch (const dealii::ExceptionBase &)
        {
        }
      if (!std::isfinite(value))
        throw InputError(option + " cannot be '" + text + "'; allowed: a position of the wheel in mm");
      return value;
    }

    std::string forces_text(const DynamicForces &dynamic)
    {
      std::ostringstream text;
      text << "time_s,position_m" << std::setprecision(9);
      for (const DynamicForce &force : dynamic.forces)
        text << ',' << force.column;
      for (std::size_t i = 0; i < dynamic.time.size(); ++i)
        {
          text << '\n' << dynamic.time[i] << ',' << dynamic.position[i];
          for (const DynamicForce &force : dynamic.forces)
            text << ',' << force.values[i];
        }
      text << '\n';
      return text.str();
    }

    std::string spectra_text(const DynamicForces &dynamic)
    {
      const AmplitudeSpectrum &first = dynamic.forces.front().spectrum;
      std::ostringstream       text;
      text << "frequency_Hz,wavelength_m" << std::setprecision(9);
      for (const DynamicForce &force : dynamic.forces)
        text << ',' << force.column;
      for (std::size_t i = 1; i < first.amplitude.size(); ++i)
        {
          const double frequency = i * first.interval;
          text << '\n' << frequency << ',' << dynamic.speed / frequency;
          for (const DynamicForce &force : dynamic.forces)
            text << ',' << force.spectrum.amplitude[i];
        }
      text << '\n';
      return text.str();
    }

    /// What the defect adds should be over when the section ends: a spectrum takes it for one that goes on,
    /// unless its window fades.
    std::vector<std::string> doubts(const DynamicForces &dynamic, const Window window)
    {
      constexpr double         large = 0.1; // of the peak
      std::vector<std::string> list;
      if (window != Window::rectangular)
        return list;
      for (const DynamicForce &force : dynamic.forces)
        if (const double share = force.at_the_end / std::abs(force.peak); share > large)
          list.push_back(
            format("%s still swings by %.0f %% of its peak at the end of the section: its spectrum "
                   "has side lobes; roll farther, end the section elsewhere or take --window Hann",
                   force.column.c_str(), 100. * share));
      return list;
    }

    std::string figures_text(const DynamicForces            &dynamic,
                             const DynamicForceRequest      &request,
                             const std::vector<std::string> &warnings)
    {
      const AmplitudeSpectrum &first = dynamic.forces.front().spectrum;
      nlohmann::ordered_json   json;
      json["run"]                   = request.run;
      json["smooth_twin"]           = request.smooth_twin;
      json["speed_m_per_s"]         = dynamic.speed;
      json["from_m"]                = dynamic.position.front();
      json["to_m"]                  = dynamic.position.back();
      json["interpolation"]         = "linear in time";
      json["window"]                = request.window;
      json["record_s"]              = first.record;
      json["resolution_Hz"]         = first.resolution;
      json["frequency_interval_Hz"] = first.interval;
      for (const DynamicForce &force : dynamic.forces)
        {
          nlohmann::ordered_json &entry        = json["forces"][force.column];
          entry["peak_N"]                      = force.peak;
          entry["largest_increase_N"]          = force.increase;
          entry["largest_increase_position_m"] = force.increase_position;
          entry["largest_decrease_N"]          = force.decrease;
          entry["largest_decrease_position_m"] = force.decrease_position;
          entry["peak_time_s"]                 = force.peak_time;
          entry["peak_position_m"]             = force.peak_position;
          entry["force_at_peak_N"]             = force.force_at_peak;
          entry["smooth_mean_N"]               = force.smooth_mean;
          entry["oscillations"]                = nlohmann::ordered_json::array();
          for (const Oscillation &line : force.oscillations)
            {
              nlohmann::ordered_json each = {{"frequency_Hz", line.frequency},
                                             {"wavelength_m", dynamic.speed / line.frequency},
                                             {"amplitude_N", line.amplitude},
                                             {"logarithmic_decrement", nullptr}};
              if (std::isfinite(line.decay_rate))
                each["logarithmic_decrement"] = line.logarithmic_decrement();
              entry["oscillations"].push_back(each);
            }
        }
      json["warnings"] = warnings;
      return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    }

    void print_table(const DynamicForces            &dynamic,
                     const DynamicForceRequest      &request,
                     const std::vector<std::string> &warnings)
    {
      const AmplitudeSpectrum &first = dynamic.forces.front().spectrum;
      std::printf("dynamic force of %s over %s, wheel from %.2f to %.2f mm at %.4g km/h\n"
                  "rows interpolated linearly in time, one every %.4g us\n"
                  "spectrum: %s window, record of %.4g ms, resolution %.3g Hz, a value every %.3g Hz\n\n"
                  "%-24s %10s %10s %10s %10s   %s\n",
                  request.run.c_str(), request.smooth_twin.c_str(), 1e3 * dynamic.position.front(),
                  1e3 * dynamic.position.back(), 3.6 * dynamic.speed, 1e6 * dynamic.interval,
                  request.window.c_str(), 1e3 * first.record, first.resolution, first.interval, "",
                  "most, kN", "at x, mm", "least, kN", "at x, mm",
                  "vibrations: Hz (wavelength mm, logarithmic decrement)");
      for (const DynamicForce &force : dynamic.forces)
        {
          std::printf("%-24s %+10.4g %10.2f %+10.4g %10.2f  ", force.column.c_str(), 1e-3 * force.increase,
                      1e3 * force.increase_position, 1e-3 * force.decrease, 1e3 * force.decrease_position);
          for (std::size_t i = 0; i < std::min<std::size_t>(3, force.oscillations.size()); ++i)
            {
              const Oscillation &line = force.oscillations[i];
              std::printf(" %.0f (%.3g, ", line.frequency, 1e3 * dynamic.speed / line.frequency);
              std::printf(std::isfinite(line.decay_rate) ? "%.2g)" : "-)", line.logarithmic_decrement());
            }
          std::printf("\n");
        }
      for (const std::string &warning : warnings)
        std::printf("WARNING: %s\n", warning.c_str());
    }
  } // namespace


  void write_dynamic_force(const DynamicForceRequest &request, const MPI_Comm comm)
  {
    DynamicForces dynamic;
    Window        window   = Window::rectangular;
    const double  infinity = std::numeric_limits<double>::infinity();
    const double  from     = millimetres(request.from_mm, "--from", -infinity),
                 to        = millimetres(request.to_mm, "--to", infinity);
    if (from > to)
      throw InputError("--from " + request.from_mm + " must not be above --to " + request.to_mm);
    const ForceHistory       run = read_forces(request.run), smooth_twin = read_forces(request.smooth_twin);
    std::vector<std::string> warnings;
    if (const std::string doubt = compare_parameters(request.run, request.smooth_twin); !doubt.empty())
      warnings.push_back(doubt);
    for (const std::string &of : {request.run, request.smooth_twin})
      if (const std::string doubt = doubt_of_history(of); !doubt.empty())
        warnings.push_back(doubt);
    try
      {
        window  = window_of(request.window);
        dynamic = dynamic_forces(run, smooth_twin, window, from, to);
      }
    catch (const std::invalid_argument &error)
      {
        throw InputError(error.what());
      }
    for (const auto &[option, asked, had] : {std::make_tuple("--from", from, dynamic.position.front()),
                                             std::make_tuple("--to", to, dynamic.position.back())})
      if (std::isfinite(asked) && std::abs(asked - had) > 2. * dynamic.interval * dynamic.speed)
        warnings.push_back(format("%s %.2f mm lies beyond what both runs have: the section reaches %.2f mm",
                                  option, 1e3 * asked, 1e3 * had));
    for (const std::string &doubt : doubts(dynamic, window))
      warnings.push_back(doubt);
    const RunFolder folder(request.output.empty() ? request.run : request.output, comm);
    folder.write("dynamic.csv", forces_text(dynamic));
    folder.write("spectrum.csv", spectra_text(dynamic));
    folder.write("dynamic.json", figures_text(dynamic, request, warnings));
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      {
        print_table(dynamic, request, warnings);
        std::printf("\nResults in %s: dynamic.csv, spectrum.csv, dynamic.json\n", folder.path("").c_str());
      }
  }
} // namespace tread
