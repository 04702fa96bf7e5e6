// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_output_run_folder_h
#define tread_output_run_folder_h

#include <tread/analysis/contact_patch.h>
#include <tread/analysis/rail_stress.h>
#include <tread/dynamics/explicit_dynamics.h>

#include <mpi.h>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace tread
{
  /// Forces and displacements of one support, SI units.
  struct SupportRecord
  {
    double pad_force, ballast_force; ///< compression at the end of the interval
    double seat_pressure;            ///< largest of the pad's points
    double least_seat_pressure;      ///< smallest of them; negative where the pad pulls
    double rail_over_support;        ///< displacement of the rail's foot, upwards
    double rail_at_mid_span;         ///< the same half a spacing ahead
  };

  /// One row of history.csv and of cells.csv, SI units.
  struct HistoryRow
  {
    double                     time, position;
    Row                        force; ///< on the wheel, mean over the interval
    double                     creepage;
    PatchMeasures              patch;
    EnergyLedger               energy;
    double                     axle_box_acceleration; ///< vertical, mean over the interval
    std::vector<SupportRecord> supports;              ///< as many as were passed to open_histories
    std::vector<CellRecord>    cells;                 ///< likewise
  };

  /// Residual state of the rail after a wheel, SI units: averages over the nodes in the middle of the rolled
  /// distance, 10 mm long and on the line y = 0, and the largest values of the cells below them.
  struct Passage
  {
    double settlement, shift;     ///< of the surface since the virgin state: downwards, along x (m)
    double plastic_strain;        ///< largest equivalent plastic strain
    double residual_stress;       ///< largest equivalent (von Mises) stress
    double plastic_work;          ///< of rail and wheel in this passage, J
    double frictional_work;       ///< J
    double traction_coefficient;  ///< mean over the last 10 mm
    double max_pressure;          ///< at the solution instant, Pa
    double energy_residual_share; ///< of the work done in this passage
    double energy_residual_of_dissipated;
  };

  /// The folder of a run and the files in it, all written by rank 0.
  /// Every write is checked: a full disk is an error, not a short file.
  class RunFolder
  {
  public:
    /// Make the folder and lock it. @throws std::runtime_error with one line, on all ranks, if it cannot be
    /// written or another run writes into it.
    RunFolder(const std::string &path, const MPI_Comm comm);
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

    /// Write text to a file of the folder through a temporary one, so that it is either complete or absent.
    void write(const std::string &name, const std::string &text) const;

    /// The bytes of all ranks one after the other, on rank 0. Collective.
    std::string gather(const std::string &bytes) const;

    void write_patch(const std::string &name, const std::vector<PatchNode> &patch) const;

    /// rail_cells.csv: reference position, stress and plastic strain of the cells of a body whose top is at
    /// z = 0, down to the depth (m) and as wide as it is deep; rail_surface.csv: reference position and
    /// displacement of the nodes of its contact surface. Collective.
    void write_rail_tables(const ExplicitDynamics &dynamics,
                           const unsigned int      body,
                           const double            depth) const;

    /// passages.csv: one row for each passage of a wheel so far.
    void write_passages(const std::vector<Passage> &passages) const;

    /// strip.csv: one row for each column of cells under the path.
    void write_strip(const std::vector<StripColumn> &columns) const;

    /// Begin new files history.csv and, if there are cells, cells.csv; when resuming, continue after the last
    /// row not later than time. @param supports numbers of those whose forces the rows contain.
    void open_histories(const bool              resume,
                        const double            time,
                        const std::vector<int> &supports,
                        const std::size_t       n_cells);
    void append(const HistoryRow &row);

    /// Write the present state of the bodies: displacement without the hub's rigid motion, velocity, stress.
    /// Collective.
    void write_volume(const ExplicitDynamics &dynamics, const WheelHub &hub, const unsigned int wheel_body);

    /// Write a body's contact surface with pressure, shear, slip and state. Collective.
    void write_surface(const ExplicitDynamics &dynamics, const Contact &contact, const unsigned int body);

    /// Write the square elements of a half-space solution with the same fields.
    void write_surface(const std::vector<PatchNode> &elements, const double element_size);

  private:
    /// On rank 0: one of the tables that grow row by row.
    void open_table(std::ofstream     &table,
                    const std::string &name,
                    const std::string &header,
                    const bool         resume,
                    const double       time) const;

    /// On rank 0. @returns an error in one line; empty if the folder is this run's.
    std::string take_lock();

    /// Write a picture and the list of all pictures with their times.
    void add_picture(const std::string                           &stem,
                     const std::string                           &pieces,
                     const double                                 time,
                     std::vector<std::pair<double, std::string>> &files) const;

    std::string                                 folder;
    MPI_Comm                                    comm;
    bool                                        writes_tables;
    int                                         lock = -1; ///< file descriptor
    std::ofstream                               history, cell_history;
    std::vector<std::pair<double, std::string>> volume_files, surface_files;
  };
} // namespace tread

#endif
