// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/run_folder.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
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
    std::string history_header(const std::vector<int> &supports)
    {
      std::string header =
        "time_s,position_m,normal_force_N,longitudinal_force_N,lateral_force_N,traction_coefficient,"
        "creepage,"
        "contact_area_m2,adhesion_share,max_pressure_Pa,external_work_J,kinetic_energy_J,internal_"
        "energy_J,"
        "hourglass_energy_J,frictional_work_J,contact_loss_J,damping_work_J,plastic_work_J,energy_"
        "residual_J,axle_box_acceleration_m_per_s2";
      if (!supports.empty())
        header += ",spring_energy_J";
      for (const int number : supports)
        for (const char *quantity : {"pad_N", "ballast_N", "seat_pressure_Pa", "least_seat_pressure_Pa",
                                     "rail_m", "rail_at_next_mid_span_m"})
          header += ",support_" + std::to_string(number) + "_" + quantity;
      return header;
    }

    std::string cells_header(const std::size_t n_cells)
    {
      std::string header = "time_s,position_m";
      for (std::size_t i = 1; i <= n_cells; ++i)
        for (const char *quantity : {"von_mises_Pa", "equivalent_plastic_strain"})
          header += ",cell_" + std::to_string(i) + "_" + quantity;
      return header;
    }
  } // namespace


  RunFolder::RunFolder(const std::string &path, const MPI_Comm comm)
    : folder(path)
    , comm(comm)
    , writes_tables(dealii::Utilities::MPI::this_mpi_process(comm) == 0)
  {
    const std::string problem = dealii::Utilities::MPI::broadcast(comm, writes_tables ? take_lock() : "", 0);
    if (!problem.empty())
      throw std::runtime_error(problem);
  }


  RunFolder::~RunFolder()
  {
    if (lock < 0)
      return;
    unlink(path(".lock").c_str());
    close(lock);
  }


  std::string RunFolder::take_lock()
  {
    const std::string cannot = "'Output/Directory': cannot write into '" + folder + "'";
    std::error_code   error;
    std::filesystem::create_directories(folder, error);
    if (error)
      return cannot + " (" + error.message() + ")";
    lock = open(path(".lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (lock < 0)
      return cannot + " (" + std::strerror(errno) + ")";

    // The system lets go of the lock however the run ends. Some file systems know no locks: then there is
    // none.
    const bool  taken  = flock(lock, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    struct stat status = {};
    fstat(lock, &status);
    const bool removed = status.st_nlink == 0; // by the run that had it, since it was opened here
    if (!taken && !removed && ::write(lock, "locked by a run\n", 16) == 16)
      return "";
    const std::string full = std::strerror(errno);
    if (!taken && !removed)
      unlink(path(".lock").c_str());
    close(lock);
    lock = -1;
    return taken || removed ? "'Output/Directory': another run writes into '" + folder + "'"
                            : cannot + " (" + full + ")";
  }


  bool RunFolder::is_complete() const
  {
    bool complete = false;
    if (writes_tables)
      {
        std::ifstream file(path("summary.json"));
        const auto    summary = nlohmann::json::parse(file, nullptr, false);
        complete              = summary.is_object() && summary.value("completed", nlohmann::json()) == true;
      }
    return dealii::Utilities::MPI::broadcast(comm, complete, 0);
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
          "(summary\\.json|(history|patch|patch_averaged|reference_patch|subsurface|transient|rail_cells|"
          "rail_surface|strip|cells|passages|dynamic|spectrum)\\.csv|dynamic\\.json|"
          "checkpoint-[01]|checkpoint\\.last|(volume|surface)(\\.pvd|-[0-9]{4,}\\.vtu))(\\.part)?");
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
    std::ofstream     file(temporary, std::ios::binary);
    file << text;
    file.close();
    std::error_code error;
    if (file)
      std::filesystem::rename(temporary, path(name), error);
    if (!file || error)
      {
        std::filesystem::remove(temporary, error);
        throw std::runtime_error("cannot write '" + path(name) + "': is the disk full?");
      }
  }


  std::string RunFolder::gather(const std::string &bytes) const
  {
    constexpr int tag = 4711;
    if (!writes_tables)
      {
        MPI_Send(bytes.data(), bytes.size(), MPI_CHAR, 0, tag, comm);
        return "";
      }
    std::string        all     = bytes;
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
    for (unsigned int rank = 1; rank < n_ranks; ++rank)
      {
        MPI_Status status;
        int        size;
        MPI_Probe(rank, tag, comm, &status);
        MPI_Get_count(&status, MPI_CHAR, &size);
        const std::size_t begin = all.size();
        all.resize(begin + size);
        MPI_Recv(all.data() + begin, size, MPI_CHAR, rank, tag, comm, MPI_STATUS_IGNORE);
      }
    return all;
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
            "plastic_work_J,frictional_work_J,traction_coefficient,max_pressure_MPa,energy_residual_share,"
            "energy_residual_of_dissipated\n"
         << std::setprecision(9);
    for (std::size_t i = 0; i < passages.size(); ++i)
      {
        const Passage &p = passages[i];
        text << i + 1 << ',' << 1e6 * p.settlement << ',' << 1e6 * p.shift << ',' << 100. * p.plastic_strain
             << ',' << 1e-6 * p.residual_stress << ',' << p.plastic_work << ',' << p.frictional_work << ','
             << p.traction_coefficient << ',' << 1e-6 * p.max_pressure << ',' << p.energy_residual_share
             << ',' << p.energy_residual_of_dissipated << '\n';
      }
    write("passages.csv", text.str());
  }


  void RunFolder::write_strip(const std::vector<StripColumn> &columns) const
  {
    std::ostringstream text;
    text << "x_mm,von_mises_MPa,y_mm,depth_mm,time_s,wheel_x_mm,surface_von_mises_MPa,surface_y_mm,"
            "surface_time_s,surface_wheel_x_mm,equivalent_plastic_strain_percent\n"
         << std::setprecision(9);
    for (const StripColumn &c : columns)
      text << 1e3 * c.x << ',' << 1e-6 * c.largest.stress << ',' << 1e3 * c.y << ',' << 1e3 * c.depth << ','
           << c.largest.time << ',' << 1e3 * c.largest.wheel_x << ',' << 1e-6 * c.at_surface.stress << ','
           << 1e3 * c.y_at_surface << ',' << c.at_surface.time << ',' << 1e3 * c.at_surface.wheel_x << ','
           << 100. * c.equivalent_plastic_strain << '\n';
    write("strip.csv", text.str());
  }


  void RunFolder::open_table(std::ofstream     &table,
                             const std::string &name,
                             const std::string &header,
                             const bool         resume,
                             const double       time) const
  {
    std::string kept = header + "\n";
    if (resume)
      {
        std::ifstream old(path(name));
        std::string   line;
        std::getline(old, line);
        while (std::getline(old, line))
          if (!line.empty() && std::atof(line.c_str()) <= time)
            kept += line + '\n';
      }
    write(name, kept);
    table.open(path(name), std::ios::app);
    table << std::setprecision(12);
  }


  void RunFolder::open_histories(const bool              resume,
                                 const double            time,
                                 const std::vector<int> &supports,
                                 const std::size_t       n_cells)
  {
    if (!writes_tables)
      return;
    if (resume)
      for (const bool surface : {false, true})
        {
          std::ifstream     collection(path(surface ? "surface.pvd" : "volume.pvd"));
          const std::string text((std::istreambuf_iterator<char>(collection)),
                                 std::istreambuf_iterator<char>());
          const std::regex  entry("timestep=\"([^\"]*)\"[^>]*file=\"([^\"]*)\"");
          for (std::sregex_iterator i(text.begin(), text.end(), entry), end; i != end; ++i)
            if (std::stod((*i)[1]) <= time)
              (surface ? surface_files : volume_files).emplace_back(std::stod((*i)[1]), (*i)[2]);
        }
    open_table(history, "history.csv", history_header(supports), resume, time);
    if (n_cells > 0)
      open_table(cell_history, "cells.csv", cells_header(n_cells), resume, time);
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
            << ',' << e.residual() << ',' << row.axle_box_acceleration;
    if (!row.supports.empty())
      history << ',' << e.springs;
    for (const SupportRecord &s : row.supports)
      history << ',' << s.pad_force << ',' << s.ballast_force << ',' << s.seat_pressure << ','
              << s.least_seat_pressure << ',' << s.rail_over_support << ',' << s.rail_at_mid_span;
    history << '\n' << std::flush;
    if (!history)
      throw std::runtime_error("cannot write '" + path("history.csv") + "': is the disk full?");
    if (row.cells.empty())
      return;
    cell_history << row.time << ',' << row.position;
    for (const CellRecord &cell : row.cells)
      cell_history << ',' << cell.von_mises << ',' << cell.equivalent_plastic_strain;
    cell_history << '\n' << std::flush;
    if (!cell_history)
      throw std::runtime_error("cannot write '" + path("cells.csv") + "': is the disk full?");
  }
} // namespace tread
