// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/run_folder.h>

#include <deal.II/base/mpi.h>

#include <cstdio>
#include <filesystem>
#include <iomanip>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace tread
{
  namespace
  {
    std::string history_header()
    {
      return "time_s,position_m,normal_force_N,longitudinal_force_N,lateral_force_N,traction_coefficient,"
             "creepage,"
             "contact_area_m2,adhesion_share,max_pressure_Pa,external_work_J,kinetic_energy_J,internal_"
             "energy_J,"
             "hourglass_energy_J,frictional_work_J,contact_loss_J,damping_work_J,plastic_work_J,energy_"
             "residual_J\n";
    }
  } // namespace


  RunFolder::RunFolder(const std::string &path, const MPI_Comm comm)
    : folder(path)
    , comm(comm)
    , writes_tables(dealii::Utilities::MPI::this_mpi_process(comm) == 0)
  {
    std::string problem;
    if (writes_tables)
      {
        std::error_code error;
        std::filesystem::create_directories(folder, error);
        const std::string probe = folder + "/.probe";
        if (error || !(std::ofstream(probe) << "x" << std::flush))
          problem = "'Output/Directory': cannot write into '" + folder + "'" +
                    (error ? " (" + error.message() + ")" : "");
        std::filesystem::remove(probe, error);
      }
    problem = dealii::Utilities::MPI::broadcast(comm, problem, 0);
    if (!problem.empty())
      throw std::runtime_error(problem);
  }


  void RunFolder::remove_results() const
  {
    if (!writes_tables)
      return;
    std::error_code                    ignored;
    std::vector<std::filesystem::path> old;
    for (const auto &entry : std::filesystem::directory_iterator(folder, ignored))
      {
        const std::string       name = entry.path().filename();
        static const std::regex own(
          "(summary\\.json|history\\.csv|patch\\.csv|patch_averaged\\.csv|reference_patch\\.csv|rail_cells\\."
          "csv|"
          "rail_surface\\.csv|"
          "checkpoint-[01]|checkpoint\\.last|(volume|surface)(\\.pvd|-[0-9]{4,}\\.vtu))");
        if (std::regex_match(name, own) && entry.is_regular_file(ignored))
          old.push_back(entry.path());
      }
    for (const std::filesystem::path &path : old)
      std::filesystem::remove(path, ignored);
  }


  void RunFolder::write(const std::string &name, const std::string &text) const
  {
    if (!writes_tables)
      return;
    const std::string temporary = path(name) + ".part";
    {
      std::ofstream file(temporary);
      file << text << std::flush;
      if (!file)
        throw std::runtime_error("cannot write '" + path(name) + "': is the disk full?");
    }
    std::filesystem::rename(temporary, path(name));
  }


  void RunFolder::write_patch(const std::string &name, const std::vector<PatchNode> &patch) const
  {
    std::ostringstream text;
    text
      << "x_mm,y_mm,z_mm,area_mm2,pressure_MPa,shear_x_MPa,shear_y_MPa,slip_x_m_per_s,slip_y_m_per_s,state\n"
      << std::setprecision(9);
    for (const PatchNode &node : patch)
      text << 1e3 * node.position[0] << ',' << 1e3 * node.position[1] << ',' << 1e3 * node.position[2] << ','
           << 1e6 * node.area << ',' << 1e-6 * node.pressure << ',' << 1e-6 * node.shear[0] << ','
           << 1e-6 * node.shear[1] << ',' << node.slip[0] << ',' << node.slip[1] << ','
           << (node.adhesion ? "adhesion" : "slip") << '\n';
    write(name, text.str());
  }


  void RunFolder::write_passages(const std::vector<Passage> &passages) const
  {
    std::ostringstream text;
    text << "passage,settlement_um,shift_um,equivalent_plastic_strain_percent,residual_von_mises_MPa,"
            "plastic_work_J,frictional_work_J,traction_coefficient,max_pressure_MPa,energy_residual_share\n"
         << std::setprecision(9);
    for (std::size_t i = 0; i < passages.size(); ++i)
      {
        const Passage &p = passages[i];
        text << i + 1 << ',' << 1e6 * p.settlement << ',' << 1e6 * p.shift << ',' << 100. * p.plastic_strain
             << ',' << 1e-6 * p.residual_stress << ',' << p.plastic_work << ',' << p.frictional_work << ','
             << p.traction_coefficient << ',' << 1e-6 * p.max_pressure << ',' << p.energy_residual_share
             << '\n';
      }
    write("passages.csv", text.str());
  }


  void RunFolder::open_history(const bool resume, const double time)
  {
    if (resume)
      for (const bool surface : {false, true})
        {
          // All ranks number the pictures alike, also those made before.
          std::ifstream     collection(path(surface ? "surface.pvd" : "volume.pvd"));
          const std::string text((std::istreambuf_iterator<char>(collection)),
                                 std::istreambuf_iterator<char>());
          const std::regex  entry("timestep=\"([^\"]*)\"[^>]*file=\"([^\"]*)\"");
          for (std::sregex_iterator i(text.begin(), text.end(), entry), end; i != end; ++i)
            if (std::stod((*i)[1]) <= time * (1. + 1e-9))
              (surface ? surface_files : volume_files).emplace_back(std::stod((*i)[1]), (*i)[2]);
        }
    if (!writes_tables)
      return;
    std::string kept = history_header();
    if (resume)
      {
        std::ifstream old(path("history.csv"));
        std::string   line;
        std::getline(old, line);
        while (std::getline(old, line))
          if (!line.empty() && std::atof(line.c_str()) <= time * (1. + 1e-12))
            kept += line + '\n';
      }
    write("history.csv", kept);
    history.open(path("history.csv"), std::ios::app);
    history << std::setprecision(12);
  }


  void RunFolder::append(const HistoryRow &row)
  {
    if (!writes_tables)
      return;
    const EnergyLedger &e = row.energy;
    history << row.time << ',' << row.position << ',' << row.force[2] << ',' << row.force[0] << ','
            << row.force[1] << ',' << (row.force[2] > 0. ? row.force[0] / row.force[2] : 0.) << ','
            << row.creepage << ',' << row.patch.area << ',' << row.patch.adhesion_share << ','
            << row.patch.max_pressure << ',' << e.external_work << ',' << e.kinetic << ',' << e.strain << ','
            << e.hourglass << ',' << e.friction << ',' << e.contact << ',' << e.damping << ',' << e.plastic
            << ',' << e.residual() << '\n'
            << std::flush;
    if (!history)
      throw std::runtime_error("cannot write '" + path("history.csv") + "': is the disk full?");
  }
} // namespace tread
