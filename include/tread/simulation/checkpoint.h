// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_simulation_checkpoint_h
#define tread_simulation_checkpoint_h

#include <tread/output/run_folder.h>

#include <mpi.h>

namespace tread
{
  class ExplicitDynamics;
  class Simulation;

  /// The whole state of a run in one of two files, written in turn; checkpoint.last names the one that is
  /// complete. Nodes are stored by position, so a run may resume on any number of ranks. On the same number
  /// of ranks it continues to the last bit as if it had not been interrupted.
  class Checkpoint
  {
  public:
    Checkpoint(const RunFolder &folder, const MPI_Comm comm);

    /// Collective.
    void write(Simulation &simulation);

    /// Collective. @throws SceneError if there is none, or if it belongs to other parameters.
    void read(Simulation &simulation);

  private:
    template <typename Archive>
    static void        state(Archive &archive, Simulation &simulation);
    static std::string fingerprint(const Simulation &simulation);
    /// Data that this rank sums or keeps for its own cells alone: a part of the whole, in bytes.
    static std::string own_part(const ExplicitDynamics &dynamics);
    void               restore_parts(ExplicitDynamics &dynamics, const std::string &parts) const;

    const RunFolder &folder;
    MPI_Comm         comm;
    unsigned int     next_slot = 0;
  };
} // namespace tread

#endif
