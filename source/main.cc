// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/checks.h>
#include <tread/simulation/simulation.h>
#include <tread/tools/batch_files.h>
#include <tread/tools/contact_points_files.h>
#include <tread/tools/contact_way_files.h>
#include <tread/tools/dynamic_force_files.h>
#include <tread/tools/modes_files.h>
#include <tread/tools/position_files.h>
#include <tread/tools/print_columns.h>
#include <tread/tools/reference_only.h>
#include <tread/tools/sleeper_stress_files.h>
#include <tread/tools/wear_files.h>
#include <tread/tools/wheelset_reference.h>

#include <deal.II/base/mpi.h>

#include "command_line.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <thread>

namespace
{
  using tread::Command;
  using tread::CommandLine;

  /// What parameters and columns print. @returns whether the command is one of them
  bool print(const CommandLine &line, const bool speaks)
  {
    if (line.command == Command::columns && speaks)
      tread::print_columns(std::cout);
    if (line.command == Command::parameters)
      {
        tread::Scene scene;
        scene.read(line.scene, line.settings, tread::SceneUse::roll);
        if (speaks && line.schema)
          scene.parameters().print_schema(std::cout);
        else if (speaks && line.json)
          scene.parameters().print_json(std::cout);
        else if (speaks)
          scene.parameters().print(std::cout, true);
      }
    return line.command == Command::columns || line.command == Command::parameters;
  }

  /// The commands that read no scene. @returns whether the command is one of them
  bool process(CommandLine &line, const MPI_Comm comm)
  {
    switch (line.command)
      {
      case Command::batch:
        tread::write_batch(line.table, line.output, comm);
        return true;
      case Command::positions:
        tread::write_positions(line.table, line.output, comm);
        return true;
      case Command::dynamic_force:
        line.dynamic.output = line.output;
        tread::write_dynamic_force(line.dynamic, comm);
        return true;
      case Command::sleeper_stress:
        line.sleeper.output = line.output;
        tread::write_sleeper_stress(line.sleeper, comm);
        return true;
      default:
        return false;
      }
  }

  /// Behind the folder of a run: what else is made of its scene lies beside its results, never over them.
  std::string ending_of(const Command command)
  {
    return command == Command::contact_points ? "-contact-points"
           : command == Command::reference    ? "-reference"
           : command == Command::wear         ? "-wear"
           : command == Command::modes        ? "-modes"
                                              : "";
  }

  /// @returns the program's exit code
  int roll(const tread::Scene &scene, const CommandLine &line, const std::string &folder, const MPI_Comm comm)
  {
    tread::require_memory(scene, comm);
    if (line.dry_run)
      {
        if (!tread::estimate_without_mesh(scene, comm))
          tread::estimate(scene, comm);
        return 0;
      }
    return tread::run(scene, comm, folder, line.resume) ? 0 : 130;
  }

  void write_points(const tread::Scene &scene,
                    const CommandLine  &line,
                    const std::string  &folder,
                    const MPI_Comm      comm)
  {
    if (!scene.rail.is_sliced())
      {
        tread::write_contact_points(scene, line.points, folder, comm);
        return;
      }
    tread::require(!line.points.is_over_shift,
                   "--shift-to, --shift-step and --other-side are for a rail that is the same "
                   "everywhere: over 'Rail/Shape' slices contact points follow the way of the "
                   "scene, at its lateral shift");
    tread::write_contact_way(scene, folder, comm);
  }

  int run(const int argc, char **argv, const MPI_Comm comm)
  {
    const bool                 speaks = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    std::optional<CommandLine> asked  = tread::parse_command_line(argc, argv, speaks);
    if (!asked)
      return 0;
    CommandLine &line = *asked;
    if (print(line, speaks))
      return 0;
    if (line.quiet && !std::freopen("/dev/null", "w", stdout))
      throw std::runtime_error("cannot write to /dev/null");
    if (process(line, comm))
      return 0;
    tread::Scene scene;
    if (line.command == Command::contact_points)
      scene.read_surfaces(line.scene, line.settings);
    else
      scene.read(line.scene, line.settings,
                 line.command == Command::reference || line.command == Command::wear
                   ? tread::SceneUse::half_space
                   : tread::SceneUse::roll);
    const std::string folder =
      line.output.empty() ? scene.output.directory + ending_of(line.command) : line.output;
    if (!line.dry_run && !line.resume && !line.overwrite)
      {
        const std::string held = tread::held_by_other_scene(folder, line.scene, scene.general.title);
        tread::require(dealii::Utilities::MPI::broadcast(comm, held.empty(), 0), held);
      }
    if (line.command == Command::contact_points)
      write_points(scene, line, folder, comm);
    else if (line.command == Command::wear)
      {
        scene.damage.record = true; // that is what it is about
        if (!line.dry_run)
          return tread::write_profile_wear(scene, line.table, folder, line.resume, comm) ? 0 : 130;
        tread::estimate_profile_wear(scene, line.table, comm);
      }
    else if (line.command == Command::reference)
      (scene.is_positioned() ? tread::run_wheelset_reference : tread::run_reference_only)(scene, folder,
                                                                                          comm);
    else
      {
        if (scene.is_positioned())
          {
            tread::require(line.command == Command::run,
                           "modes are those of an upright wheel: 'Wheelset' must have no position");
            check_placed_mesh(scene);
          }
        if (line.command == Command::run)
          return roll(scene, line, folder, comm);
        tread::write_modes(scene, line.modes, folder, comm);
      }
    return 0;
  }

  /// An error found by all ranks is printed once. Otherwise each failing rank prints its error and ends the
  /// others, which might wait for it forever.
  int fail(const std::string &what, const int code, const MPI_Comm errors)
  {
    std::string text = what;
    std::replace(text.begin(), text.end(), '\n', ' ');
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(errors);
    MPI_Request        request;
    int                all_failed = 0;
    MPI_Ibarrier(errors, &request);
    for (const double start = MPI_Wtime(); !all_failed && MPI_Wtime() - start < 5.;
         std::this_thread::sleep_for(std::chrono::milliseconds(1)))
      MPI_Test(&request, &all_failed, MPI_STATUS_IGNORE);
    if (all_failed && rank != 0)
      return code;
    std::cerr << "tread: " << (all_failed ? "" : "rank " + std::to_string(rank) + ": ") << text << std::endl;
    if (!all_failed)
      MPI_Abort(MPI_COMM_WORLD, code);
    return code;
  }
} // namespace


int main(int argc, char **argv)
{
  // Libraries below would take our options for theirs.
  int                                      n_words = 1;
  char                                    *words[] = {argv[0], nullptr}, **all_words = words;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_words, all_words, 1);
  MPI_Comm                                 errors; // nothing else waits on it
  MPI_Comm_dup(MPI_COMM_WORLD, &errors);
  std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow is an error like a full disk
  int code;
  try
    {
      code = run(argc, argv, MPI_COMM_WORLD);
    }
  catch (const tread::InputError &error)
    {
      code = fail(error.what(), 1, errors);
    }
  catch (const std::bad_alloc &)
    {
      code = fail("out of memory: the machine, or a limit of this shell (ulimit -v), has no more; larger "
                  "'Mesh/Finest cell (mm)', a shorter path, or fewer ranks",
                  2, errors);
    }
  catch (const std::exception &error)
    {
      code = fail(error.what(), 2, errors);
    }
  MPI_Comm_free(&errors);
  return code;
}
