// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/file_text.h>
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
#include <regex>
#include <sstream>
#include <stdexcept>

namespace tread
{
  nlohmann::json summary_in(const std::string &folder)
  {
    const auto summary = nlohmann::json::parse(text_of_file(folder + "/summary.json"), nullptr, false);
    return summary.is_object() ? summary : nlohmann::json::object();
  }


  RunFolder::RunFolder(const std::string &path, const MPI_Comm comm, const PictureFormat format)
    : folder(path)
    , comm(comm)
    , picture_format(format)
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
    lock = ::open(path(".lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0666);
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
    const bool complete = writes_tables && summary_in(folder).value("completed", nlohmann::json()) == true;
    return dealii::Utilities::MPI::broadcast(comm, complete, 0);
  }


  bool RunFolder::is_own(const std::string &name)
  {
    // Besides the tables of a run: those of other commands, and what is no table.
    static const std::regex own(
      "summary\\.json|run\\.h5|(subsurface|transient|dynamic|spectrum|modes|receptance|"
      "(rail|wheel)_wear|wear_(steps|patches)|worn_(rail|wheel)_[0-9]+)\\.csv|"
      "worn_[0-9]+\\.prm|wear\\.checkpoint|(dynamic|sleeper_stress)\\.json|"
      "sleeper_stress\\.vtu|checkpoint-[01]|checkpoint\\.last|"
      "(volume|surface|modes)(\\.pvd|\\.xdmf|\\.h5|-[0-9]{4,}\\.(vtu|h5))");
    const std::string whole = name.ends_with(".part") ? name.substr(0, name.size() - 5) : name;
    return is_table_of_a_run(whole) || std::regex_match(whole, own);
  }


  namespace
  {
    /// Remove the files of a folder, and nothing else that is in it, whose names are such.
    void remove_files(const std::string &folder, const std::function<bool(const std::string &)> &are_such)
    {
      std::error_code                    ignored;
      std::vector<std::filesystem::path> old;
      for (const auto &entry : std::filesystem::directory_iterator(folder, ignored))
        if (are_such(entry.path().filename()) && entry.is_regular_file(ignored))
          old.push_back(entry.path());
      for (const std::filesystem::path &path : old)
        std::filesystem::remove(path, ignored);
    }
  } // namespace


  void RunFolder::remove_results() const
  {
    if (writes_tables)
      remove_files(folder, is_own);
  }


  void RunFolder::remove_solution() const
  {
    if (!writes_tables)
      return;
    std::error_code ignored;
    std::filesystem::remove(path("summary.json"), ignored);
    static const std::regex of_the_way(
      "(history|cells|patches(_wheel_[0-9]+)?|passages|measured_(rail|wheel))\\.csv");
    remove_files(folder, [](const std::string &name) {
      return name == "run.h5" || (is_table_of_a_run(name) && !std::regex_match(name, of_the_way));
    });
  }


  void RunFolder::write_through(const std::string                              &name,
                                const std::function<void(const std::string &)> &write) const
  {
    const std::string temporary = path(name) + ".part";
    try
      {
        // What is there is left from a run that was killed, or a trap.
        unlink(temporary.c_str());
        const int made =
          ::open(temporary.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (made < 0 || close(made) != 0)
          throw std::runtime_error(name);
        write(temporary);
        std::filesystem::rename(temporary, path(name));
      }
    catch (const std::exception &)
      {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw std::runtime_error("cannot write '" + path(name) +
                                 "': is the disk full, or a limit of file sizes (ulimit -f) reached?");
      }
  }


  void RunFolder::write(const std::string &name, const std::string &text) const
  {
    if (!writes_tables)
      return;
    write_through(name, [&](const std::string &temporary) {
      std::ofstream file(temporary, std::ios::binary);
      file << text;
      file.close();
      if (!file)
        throw std::runtime_error(name);
    });
  }


  namespace
  {
    constexpr int         tag_of_bytes    = 4711;
    constexpr std::size_t largest_message = std::size_t(1) << 24; // bytes

    void send_bytes(const std::string &bytes, const MPI_Comm comm)
    {
      const std::uint64_t size = bytes.size();
      MPI_Send(&size, 1, MPI_UINT64_T, 0, tag_of_bytes, comm);
      for (std::size_t begin = 0; begin < size; begin += largest_message)
        MPI_Send(bytes.data() + begin, std::min<std::size_t>(largest_message, size - begin), MPI_CHAR, 0,
                 tag_of_bytes, comm);
    }

    /// Call sink(piece) for one piece of what each other rank sends after the other.
    /// @param piece room for the largest message, so that nothing that waits for others can fail
    void receive_bytes(const MPI_Comm                                  comm,
                       std::string                                    &piece,
                       const std::function<void(const std::string &)> &sink)
    {
      const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
      for (unsigned int rank = 1; rank < n_ranks; ++rank)
        {
          std::uint64_t size;
          MPI_Recv(&size, 1, MPI_UINT64_T, rank, tag_of_bytes, comm, MPI_STATUS_IGNORE);
          for (std::size_t begin = 0; begin < size; begin += largest_message)
            {
              piece.resize(std::min<std::size_t>(largest_message, size - begin));
              MPI_Recv(piece.data(), piece.size(), MPI_CHAR, rank, tag_of_bytes, comm, MPI_STATUS_IGNORE);
              sink(piece);
            }
        }
    }
  } // namespace


  std::string RunFolder::gather(const std::string &bytes) const
  {
    if (!writes_tables)
      {
        send_bytes(bytes, comm);
        return "";
      }
    std::string all = bytes;
    std::string room;
    receive_bytes(comm, room, [&](const std::string &piece) { all += piece; });
    return all;
  }


  void RunFolder::write_of_all(const std::string &name,
                               const std::string &word,
                               const std::string &text,
                               const std::string &bytes) const
  {
    if (!writes_tables)
      {
        send_bytes(bytes, comm);
        return;
      }
    bool        received = false;
    std::string room;
    room.reserve(largest_message);
    try
      {
        write_through(name, [&](const std::string &temporary) {
          std::ofstream      file(temporary, std::ios::binary);
          boost::crc_32_type crc;
          std::uint64_t      size = 0;
          const auto         head = [&]() {
            file << word << ' ' << std::setw(20) << size << ' ' << std::setw(10) << crc.checksum() << '\n';
          };
          const auto put = [&](const std::string &piece) {
            file.write(piece.data(), piece.size());
            crc.process_bytes(piece.data(), piece.size());
            size += piece.size();
          };
          head(); // its place
          put(text);
          put(bytes);
          received = true;
          receive_bytes(comm, room, put);
          file.seekp(0);
          head();
          file.close();
          if (!file)
            throw std::runtime_error(name);
        });
      }
    catch (const std::exception &)
      {
        if (!received) // or the others would wait
          receive_bytes(comm, room, [](const std::string &) {});
        throw;
      }
  }


  void RunFolder::open_with(const std::string &name, const std::string &header)
  {
    const auto        mark = kept.find(name);
    const std::string text =
      mark != kept.end() ? text_of_file(path(name)).substr(0, mark->second.first) : header + "\n";
    GrowingTable &table = growing[name];
    table.count(text);
    if (mark != kept.end() && TableMark(table.size, table.checksum.checksum()) != mark->second)
      throw InputError("--resume: '" + path(name) +
                       "' is not what it was when the checkpoint was made: rows are missing or changed");
    write(name, text);
    table.file.open(path(name), std::ios::app);
  }


  void RunFolder::append_to(const std::string &name, const std::string &rows)
  {
    GrowingTable &table = growing.at(name);
    table.file << rows << std::flush;
    if (!table.file)
      throw std::runtime_error("cannot write '" + path(name) +
                               "': is the disk full, or a limit of file sizes (ulimit -f) reached?");
    table.count(rows);
  }


  std::uint32_t RunFolder::history_checksum() const
  {
    return writes_tables ? growing.at("history.csv").checksum.checksum() : 0;
  }


  std::string RunFolder::progress() const
  {
    std::map<std::string, TableMark> tables;
    for (const auto &[name, table] : growing)
      tables[name] = {table.size, table.checksum.checksum()};
    // Those that this part of the run does not write stay where they are.
    tables.insert(kept.begin(), kept.end());
    nlohmann::json all;
    all["tables"]   = tables;
    all["pictures"] = nlohmann::json::object();
    for (const auto &[stem, series] : pictures)
      all["pictures"][stem] = nlohmann::json::array({series.files, series.grids});
    return all.dump();
  }


  void RunFolder::continue_from(const std::string &progress)
  {
    if (!writes_tables)
      return;
    const auto all = nlohmann::json::parse(progress);
    all.at("tables").get_to(kept);
    for (const auto &[stem, stored] : all.at("pictures").items())
      {
        Series    &series = pictures[stem];
        const auto files  = stored.at(0).get<decltype(series.files)>();
        const auto grids  = stored.at(1).get<decltype(series.grids)>();
        for (std::size_t i = 0; i < files.size(); ++i)
          if (std::filesystem::exists(path(files[i].second)))
            {
              series.files.push_back(files[i]);
              if (!grids.empty())
                series.grids.push_back(grids.at(i));
            }
      }
  }
} // namespace tread
