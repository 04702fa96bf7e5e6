// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_simulation_checkpoint_h
#define tread_simulation_checkpoint_h

#include <tread/output/run_folder.h>
#include <tread/scene/parameter_file.h>

#include <mpi.h>

#include <map>
#include <string>
#include <vector>

namespace tread
{
  class Scene;
  class Simulation;
  struct WindowPlace;

  /// The files from which a run is resumed: the whole state in one of two, written in turn; checkpoint.last
  /// names the one that is complete. Each class stores its own state by serialize(). Nodes and cells are
  /// stored by position, so a run may resume on any number of ranks. On the same number of ranks it continues
  /// to the last bit as if it had not been interrupted.
  ///
  /// A file is one line (layout, number of bytes that follow, their CRC-32), the parameters of the run, how
  /// far its tables and pictures had grown, and what each rank stored.
  class Checkpoint
  {
  public:
    Checkpoint(RunFolder &folder, const Scene &scene, const MPI_Comm comm);

    /// Collective. @throws std::runtime_error with one line, on all ranks, if it cannot be written.
    void write(Simulation &simulation);

    /// Collective. @throws InputError with one line, on all ranks, if there is no checkpoint, if it is
    /// damaged or was written by another version, or if it belongs to other parameters.
    /// @param simulation that was just made, with its cells fine at window()
    void read(Simulation &simulation);

    /// Where the cells of the simulation that was stored are fine. Collective. @throws InputError likewise
    WindowPlace window();

    /// Of a complete run, which has no checkpoint to go on from. Collective. @throws InputError if it has
    /// other parameters.
    void require_parameters_of_run() const;

    /// Whether the complete run in the folder has rolled less than the scene asks for, on a way that was
    /// meshed for more. Collective.
    bool run_may_go_on() const;

  private:
    /// What a file has behind its first line, cut where its texts end.
    struct Content
    {
      std::string parameters, progress, window, state;
    };
    /// Of the slot that checkpoint.last names, on all ranks.
    Content last_content();
    /// What follows the first line of a slot, on all ranks.
    std::string content_of(const std::string &name) const;
    /// Parameters with which a run must go on: not those of what is written, of which only the columns of
    /// tables that grow stay, and not those of what is found at its end.
    std::vector<ParameterFile::Setting> settings_that_stay() const;
    using Values = std::map<std::string, std::string>;
    /// They, and checksums of the files that were read, by their names.
    Values parameters() const;
    /// Of the run in the folder. @throws InputError. Of rank 0 alone.
    std::vector<ParameterFile::Setting> parameters_of_run() const;
    std::string                         damaged() const; ///< what is said of the file that was read
    /// @param of_checkpoint parameters() as JSON @throws InputError with the first one that differs.
    void require_same_parameters(const std::string &of_checkpoint) const;

    RunFolder   &folder;
    const Scene &scene;
    MPI_Comm     comm;
    unsigned int next_slot = 0;
    std::string  last; ///< name of the file that was read
  };
} // namespace tread

#endif
