// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_output_run_folder_h
#define tread_output_run_folder_h

#include <tread/analysis/contact_patch.h>
#include <tread/analysis/surface_damage.h>
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/output/columns.h>
#include <tread/output/picture.h>
#include <tread/track/wheel_hub.h>

#include <boost/crc.hpp>
#include <mpi.h>
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <fstream>
#include <functional>
#include <iomanip>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace tread
{
  /// What the summary.json of a run's folder has; an empty object if there is none.
  nlohmann::json summary_in(const std::string &folder);

  /// The folder of a run and the files in it, all written by rank 0.
  /// Every write is checked: a full disk is an error, not a short file. No link in the folder is followed, so
  /// that nothing is written outside.
  class RunFolder
  {
  public:
    /// Make the folder and lock it. @param format of pictures. @throws std::runtime_error with one line, on
    /// all ranks, if it cannot be written or another run writes into it.
    RunFolder(const std::string &path, const MPI_Comm comm, const PictureFormat format = PictureFormat::vtu);
    ~RunFolder();
    RunFolder(const RunFolder &)            = delete;
    RunFolder &operator=(const RunFolder &) = delete;

    std::string path(const std::string &name) const
    {
      return folder + "/" + name;
    }

    /// Whether the summary in the folder is that of a completed run. Collective.
    bool is_complete() const;

    /// Remove all files of an earlier run that could be mistaken for those of the new one.
    void remove_results() const;

    /// Remove what tells of the solution instant of a run that is complete, the summary first: it goes on.
    void remove_solution() const;

    /// Write text to a file of the folder through a temporary one, so that it is either complete or absent.
    void write(const std::string &name, const std::string &text) const;

    /// The bytes of all ranks one after the other, on rank 0. Collective.
    std::string gather(const std::string &bytes) const;

    /// Write a line with a word and the size and the checksum of what follows it, a text, and the bytes of
    /// all ranks one after the other. Rank 0 holds no more of them than its own and one message. Collective;
    /// @throws std::runtime_error on rank 0 alone, when all have been heard.
    void write_of_all(const std::string &name,
                      const std::string &word,
                      const std::string &text,
                      const std::string &bytes) const;

    /// A table with its heading, nine digits a number.
    template <typename Record>
    void write_table(const std::string         &name,
                     const Columns<Record>     &columns,
                     const std::vector<Record> &rows) const
    {
      std::ostringstream text;
      text << heading(columns) << '\n' << std::setprecision(9);
      for (const Record &row : rows)
        write_row(text, columns, row);
      write(name, text.str());
    }

    /// Name of a wheel's table: that of the first one has no number. @param number from 0
    static std::string table_of_wheel(const std::string &stem, const unsigned int number)
    {
      return stem + (number > 0 ? "_wheel_" + std::to_string(number + 1) : "") + ".csv";
    }

    /// rail_cells.csv: reference position, stress and plastic strain of the cells of a body whose top is at
    /// z = 0, down to the depth (m) and as wide as it is deep; rail_surface.csv: reference position,
    /// displacement and stress of the nodes of its contact surface. Collective.
    /// @param stresses by node of the mesh, of NodalStresses
    void write_rail_tables(const ExplicitDynamics                    &dynamics,
                           const std::vector<StressRecovery::Stress> &stresses,
                           const unsigned int                         body,
                           const double                               depth) const;

    /// run.h5: all tables of the folder, compressed, with the units of their columns, the summary and the
    /// parameters; through a temporary file. By HDF5's own interface, as deal.II's has no compression.
    /// @param parameters Section/Name and value
    void write_hdf5(const std::string                                      &summary,
                    const std::vector<std::pair<std::string, std::string>> &parameters) const;

    /// CRC-32 of history.csv as it stands, by which readers see whether it was changed since. On rank 0.
    std::uint32_t history_checksum() const;

    /// How far the tables that grow and the series of pictures have come, for a checkpoint. On rank 0.
    std::string progress() const;
    /// Go on from there: tables that are opened and pictures that are written afterwards continue those of
    /// before. Pictures that have been removed are left out. On rank 0. @throws nlohmann::json::exception
    void continue_from(const std::string &progress);

    /// Begin a table that grows, or continue that of the run that is resumed. @throws InputError if it is not
    /// what it was
    template <typename Record>
    void open_table(const std::string &name, const Columns<Record> &columns)
    {
      if (writes_tables)
        open_with(name, heading(columns));
    }
    /// Add rows to it, twelve digits a number, on the disk at once. @throws std::runtime_error
    template <typename Record>
    void append(const std::string &name, const Columns<Record> &columns, const std::vector<Record> &rows)
    {
      if (!writes_tables)
        return;
      std::ostringstream text;
      text << std::setprecision(12);
      for (const Record &row : rows)
        write_row(text, columns, row);
      append_to(name, text.str());
    }

    /// Write the present state of the bodies: displacement without the hubs' rigid motion, velocity, stress.
    /// Collective. @param stresses by node of the mesh, of NodalStresses; @param hubs of the bodies that are
    /// wheels
    void write_volume(const ExplicitDynamics                         &dynamics,
                      const std::vector<StressRecovery::Stress>      &stresses,
                      const std::map<unsigned int, const WheelHub *> &hubs);

    /// Write a body's contact surface with pressure, shear, slip, state and stress. Collective.
    /// @param damage by surface node; empty: none
    void write_surface(const ExplicitDynamics                    &dynamics,
                       const Contact                             &contact,
                       const std::vector<StressRecovery::Stress> &stresses,
                       const std::vector<SurfacePlace>           &damage,
                       const unsigned int                         body);

    /// Write the square elements of a half-space solution with the same fields. Collective.
    void write_surface(const std::vector<PatchNode> &elements, const double element_size);

    /// Name of the list of pictures of the volume or the surface.
    std::string list_of_pictures(const std::string &stem) const
    {
      return stem + (picture_format == PictureFormat::vtu ? ".pvd" : ".xdmf");
    }

    /// At the end of a run: put pictures of HDF5 into one file for the volume and one for the surface. Until
    /// then each has its own, so that a run that is killed while it writes one loses no other.
    void join_pictures() const;

  private:
    /// Whether a file of this name is a result of a run.
    static bool is_own(const std::string &name);
    void        open_with(const std::string &name, const std::string &header);
    void        append_to(const std::string &name, const std::string &rows);

    /// On rank 0. @returns an error in one line; empty if the folder is this run's.
    std::string take_lock();

    /// Write a file by this, given a temporary name, so that it is either complete or absent. @throws
    /// std::runtime_error if it throws
    void write_through(const std::string &name, const std::function<void(const std::string &)> &write) const;

    /// Pictures with their times (s) and files, and of HDF5 their descriptions.
    struct Series
    {
      std::vector<std::pair<double, std::string>> files;
      std::vector<std::string>                    grids;
    };
    /// Write a picture and the list of all of its series. Collective. @param of_rank its part
    void add_picture(const std::string &stem, const Picture &of_rank, const double time);

    std::string   folder;
    MPI_Comm      comm;
    PictureFormat picture_format;
    bool          writes_tables;
    int           lock = -1; ///< file descriptor
    /// A table that grows, with the number and the CRC-32 of its bytes.
    struct GrowingTable
    {
      std::ofstream      file;
      std::uint64_t      size = 0;
      boost::crc_32_type checksum;

      void count(const std::string &text)
      {
        size += text.size();
        checksum.process_bytes(text.data(), text.size());
      }
    };
    std::map<std::string, GrowingTable> growing; ///< by their names
    /// How far a table had been written when a checkpoint was made: number and CRC-32 of its bytes.
    using TableMark = std::pair<std::uint64_t, std::uint32_t>;
    std::map<std::string, TableMark> kept;     ///< of the run that is resumed, by their names
    std::map<std::string, Series>    pictures; ///< of the volume and of the surface
  };
} // namespace tread

#endif
