// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/output/run_folder.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iomanip>
#include <iterator>
#include <regex>
#include <stdexcept>

namespace tread
{
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


  bool RunFolder::is_own(const std::string &name)
  {
    static const std::regex own(
      "(summary\\.json|run\\.h5|(history|patch(es|_averaged)?(_wheel_[0-9]+)?|reference_patch|subsurface|"
      "transient|"
      "rail_cells|"
      "rail_surface|strip|peak_stress(_wheel)?|rail_seats|cells|passages|dynamic|spectrum|modes|"
      "receptance)\\.csv|(dynamic|sleeper_stress)\\.json|sleeper_stress\\.vtu|"
      "checkpoint-[01]|checkpoint\\.last|"
      "(volume|surface|modes)(\\.pvd|-[0-9]{4,}\\.vtu))(\\.part)?");
    return std::regex_match(name, own);
  }


  void RunFolder::remove_results() const
  {
    if (!writes_tables)
      return;
    std::error_code                    ignored;
    std::vector<std::filesystem::path> old;
    for (const auto &entry : std::filesystem::directory_iterator(folder, ignored))
      {
        const std::string name = entry.path().filename();
        if (is_own(name) && entry.is_regular_file(ignored))
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
    write_table(name, patch_columns(), patch);
  }


  void RunFolder::write_passages(const std::vector<Passage> &passages) const
  {
    write_table("passages.csv", passage_columns(), passages);
  }


  void RunFolder::write_peaks(const std::string &name, const StressPeaks::Answer &answer) const
  {
    std::vector<StressPeaks::Layer> rows;
    if (answer.surface.peak.value > 0.)
      rows.push_back(answer.surface);
    rows.insert(rows.end(), answer.layers.begin(), answer.layers.end());
    write_table(name, peak_columns(), rows);
  }


  void RunFolder::write_strip(const std::vector<StripColumn> &columns) const
  {
    write_table("strip.csv", strip_columns(), columns);
  }


  void RunFolder::write_rail_seats(const std::vector<RailSeatPoint> &points) const
  {
    write_table("rail_seats.csv", rail_seat_columns(), points);
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
        const auto n_commas = [](const std::string &text) {
          return std::count(text.begin(), text.end(), ',');
        };
        double last = 0., widest = 0.; // instants, and what lies between them
        while (std::getline(old, line))
          if (const double when = std::atof(line.c_str()); !line.empty() && when <= time)
            {
              if (n_commas(line) != n_commas(header))
                throw InputError("--resume: '" + path(name) + "' has a damaged row");
              if (last > 0.)
                widest = std::max(widest, when - last);
              last = when;
              kept += line + '\n';
            }
        // Nothing is known of an interval of which there is no second row.
        if (widest > 0. && time - last > 2. * widest)
          throw InputError("--resume: '" + path(name) + "' ends at " +
                           format("%g ms, before the checkpoint of %g ms", 1e3 * last, 1e3 * time) +
                           ": rows are missing");
      }
    write(name, kept);
    table.open(path(name), std::ios::app);
    table << std::setprecision(12);
  }


  void RunFolder::open_histories(const bool          resume,
                                 const double        time,
                                 const HistoryParts &parts,
                                 const std::size_t   n_cells)
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
    of_history = history_columns(parts);
    of_cells   = cell_columns(n_cells);
    open_table(history, "history.csv", heading(of_history), resume, time);
    if (n_cells > 0)
      open_table(cell_history, "cells.csv", heading(of_cells), resume, time);
  }


  void RunFolder::append(const HistoryRow &row)
  {
    if (!writes_tables)
      return;
    const auto append_to = [&](std::ofstream &table, const Columns<HistoryRow> &columns, const char *name) {
      write_row(table, columns, row);
      table << std::flush;
      if (!table)
        throw std::runtime_error("cannot write '" + path(name) + "': is the disk full?");
    };
    append_to(history, of_history, "history.csv");
    if (!row.cells.empty())
      append_to(cell_history, of_cells, "cells.csv");
  }


  void RunFolder::open_patches(const bool resume, const double time, const unsigned int n_wheels)
  {
    if (!writes_tables)
      return;
    patch_histories.resize(n_wheels);
    for (unsigned int wheel = 0; wheel < n_wheels; ++wheel)
      open_table(patch_histories[wheel], table_of_wheel("patches", wheel), heading(patches_columns()), resume,
                 time);
  }


  void RunFolder::append_patch(const unsigned int            wheel,
                               const double                  time,
                               const double                  position,
                               const std::vector<PatchNode> &patch)
  {
    if (!writes_tables)
      return;
    std::ofstream &table = patch_histories.at(wheel);
    for (const PatchNode &node : patch)
      write_row(table, patches_columns(), {time, position, node});
    table << std::flush;
    if (!table)
      throw std::runtime_error("cannot write '" + path(table_of_wheel("patches", wheel)) +
                               "': is the disk full?");
  }
} // namespace tread
