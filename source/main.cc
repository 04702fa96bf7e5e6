// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/version.h>
#include <tread/scene/scene.h>
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

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
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
  struct CommandLine
  {
    std::string                 scene;
    std::vector<std::string>    settings;
    std::string                 output, batch, positions, wear;
    tread::DynamicForceRequest  dynamic;
    tread::ModesRequest         modes;
    tread::SleeperStressRequest sleeper;
    tread::ContactPointsRequest points;
    std::string                 print_parameters; ///< how; empty: not
    bool                        print_columns = false;
    bool                        overwrite     = false;
    bool                        resume = false, reference_only = false, dry_run = false, quiet = false;
  };

  /// @returns what the user asked for; nothing if it was help or the version, which is then printed.
  /// @throws InputError
  std::optional<CommandLine> parse(const int argc, char **argv, const bool speaks)
  {
    CommandLine line;
    CLI::App    app("tread: a railway wheel rolls over a rail\n"
                       "tread SCENE.prm [options]            mpirun -np N tread SCENE.prm [options]");
    app.set_version_flag("--version", "tread " + tread::version());
    app.add_option("SCENE.prm", line.scene, "parameter file");
    app
      .add_option("-s", line.settings,
                  "\"Section/Name=value\": set a parameter; may be repeated, each time for another one")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--output", line.output, "folder of the results; of --batch and --positions, their table");
    app.add_flag("--print-parameters{prm}", line.print_parameters,
                 "print all parameters with units, ranges and meaning, and stop; =json: as JSON");
    CLI::Option *columns = app.add_flag("--print-columns", line.print_columns,
                                        "print the columns of all tables and the keys of summary.json with "
                                        "units and meaning as JSON, and stop");
    app.add_flag("--quiet", line.quiet, "print errors only; summary.json has the warnings");
    app.add_flag("--overwrite", line.overwrite,
                 "replace the results of another scene's finished run in the folder");
    CLI::Option_group *how = app.add_option_group("How to run the scene");
    how->add_flag("--resume", line.resume, "go on from the last checkpoint in the folder of the results");
    how->add_flag("--reference-only", line.reference_only,
                  "print and write the half-space answer of the scene in a second; roll nothing");
    CLI::Option *modes = how->add_flag("--modes", line.modes.wanted,
                                       "write eigenmodes and receptances of wheel and track; roll nothing");
    CLI::Option *points =
      how->add_flag("--contact-points", line.points.wanted,
                    "table over the lateral shift of a rigid wheelset, or over the way of "
                    "a wheel on slices; roll nothing");
    how->add_flag("--dry-run", line.dry_run, "print size and cost of the run; run and write nothing");
    how->require_option(0, 1);
    app.add_option("--up-to", line.modes.up_to, "highest frequency of the modes, Hz (2000)")->needs(modes);
    const std::array<CLI::Option *, 3> over_shift{
      app.add_option("--shift-to", line.points.to_mm, "largest lateral shift, mm (10)"),
      app.add_option("--shift-step", line.points.step_mm, "between lateral shifts, mm (0.25)"),
      app.add_option("--other-side", line.points.other_side,
                     "scene whose wheel and rail stand on the other side of the track (the same, mirrored)")};
    for (CLI::Option *option : over_shift)
      option->needs(points);
    CLI::Option *defect = app.add_option("--dynamic-force", line.dynamic.run,
                                         "folder of a run: what the defect adds to its forces, with spectra"),
                *smooth = app.add_option("--smooth-twin", line.dynamic.smooth_twin,
                                         "folder of the run without the defect");
    defect->needs(smooth);
    smooth->needs(defect);
    app.add_option("--window", line.dynamic.window, "of the spectra: rectangular or Hann")->needs(defect);
    app.add_option("--from", line.dynamic.from_mm, "first position that counts, mm")->needs(defect);
    app.add_option("--to", line.dynamic.to_mm, "last position that counts, mm")->needs(defect);
    CLI::Option *seat =
      app.add_option("--sleeper-stress", line.sleeper.run,
                     "folder of a run: static stress of a sleeper at the largest force in its pad");
    seat->excludes(defect);
    app.add_option("--support", line.sleeper.support, "its number; without it, that with the largest force")
      ->needs(seat);
    app.add_option("--bottom", line.sleeper.bottom, "of the sleeper: fixed or ballast")->needs(seat);
    app.add_option("--cell-size", line.sleeper.cell_size_mm, "largest edge of the sleeper's cells, mm")
      ->needs(seat);
    CLI::Option *wear =
      app.add_option("--wear", line.wear,
                     "table of contacts of a wheelset: wear the profiles of the scene by them, passage after "
                     "passage, by half-space theory");
    CLI::Option *batch = app.add_option("--batch", line.batch,
                                        "table of half-space cases: solve each of its rows, on all cores");
    batch->excludes(defect)->excludes(seat);
    CLI::Option *positions =
      app.add_option("--positions", line.positions,
                     "table of positions of a wheel over a rail of slices, such as a crossing: half-space "
                     "contact in each");
    positions->excludes(defect)->excludes(seat)->excludes(batch);
    for (CLI::Option *option : {defect, seat, batch, positions, columns})
      wear->excludes(option);
    columns->excludes(defect)->excludes(seat)->excludes(batch)->excludes(positions);
    try
      {
        app.parse(argc, argv);
      }
    catch (const CLI::Success &asked)
      {
        if (speaks)
          app.exit(asked);
        return {};
      }
    catch (const CLI::ParseError &error)
      {
        throw tread::InputError(std::string(error.what()) + "; tread --help lists all options");
      }
    line.points.is_over_shift = std::any_of(over_shift.begin(), over_shift.end(),
                                            [](const CLI::Option *option) { return option->count() > 0; });
    tread::require(line.wear.empty() || !(line.reference_only || line.modes.wanted || line.points.wanted),
                   "--wear excludes --reference-only, --modes and --contact-points");
    if (!line.print_parameters.empty() && line.print_parameters != "prm" && line.print_parameters != "json")
      throw tread::InputError("--print-parameters cannot be '" + line.print_parameters +
                              "'; allowed: prm, json");
    tread::Scene::refuse_repeated(line.settings);
    const bool asks_of_scene = !line.settings.empty() || !line.print_parameters.empty() || line.resume ||
                               line.reference_only || line.modes.wanted || line.points.wanted ||
                               line.dry_run || line.overwrite;
    struct Tool
    {
      std::string name, reads;
      bool        is_asked;
    };
    for (const Tool &tool : {Tool{"--batch", "a table of cases", !line.batch.empty()},
                             Tool{"--positions", "a table of positions", !line.positions.empty()},
                             Tool{"--dynamic-force", "what two runs left", !line.dynamic.run.empty()},
                             Tool{"--sleeper-stress", "what a run left", !line.sleeper.run.empty()},
                             Tool{"--print-columns", "nothing", line.print_columns}})
      if (tool.is_asked)
        {
          tread::require(line.scene.empty(), tool.name + " reads " + tool.reads + "; it takes no scene");
          tread::require(!asks_of_scene,
                         tool.name + " reads " + tool.reads +
                           "; -s, --print-parameters, --resume, --overwrite, --reference-only, --modes, "
                           "--contact-points and --dry-run are for a scene");
        }
    return line;
  }

  int run(const int argc, char **argv, const MPI_Comm comm)
  {
    const bool                 speaks = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    std::optional<CommandLine> asked  = parse(argc, argv, speaks);
    if (!asked)
      return 0;
    CommandLine &line   = *asked;
    const bool   prints = !line.print_parameters.empty() || line.print_columns;
    if (line.quiet && !prints && !std::freopen("/dev/null", "w", stdout))
      throw std::runtime_error("cannot write to /dev/null");
    if (line.print_columns)
      {
        if (speaks)
          tread::print_columns(std::cout);
        return 0;
      }
    if (!line.batch.empty())
      {
        tread::write_batch(line.batch, line.output, comm);
        return 0;
      }
    if (!line.positions.empty())
      {
        tread::write_positions(line.positions, line.output, comm);
        return 0;
      }
    if (!line.dynamic.run.empty())
      {
        line.dynamic.output = line.output;
        tread::write_dynamic_force(line.dynamic, comm);
        return 0;
      }
    if (!line.sleeper.run.empty())
      {
        line.sleeper.output = line.output;
        tread::write_sleeper_stress(line.sleeper, comm);
        return 0;
      }
    if (line.scene.empty() && line.print_parameters.empty())
      throw tread::InputError("no scene given; tread --help shows how, prm/ holds scenes to start from");
    tread::Scene scene;
    if (line.points.wanted)
      scene.read_surfaces(line.scene, line.settings);
    else
      scene.read(line.scene, line.settings,
                 line.reference_only || !line.wear.empty() ? tread::SceneUse::half_space
                                                           : tread::SceneUse::roll);
    if (!line.print_parameters.empty())
      {
        if (speaks && line.print_parameters == "json")
          scene.print_json(std::cout);
        else if (speaks)
          scene.print(std::cout, true);
        return 0;
      }
    // Beside the results of the run, never over them.
    const auto folder_of = [&](const char *ending) {
      return line.output.empty() ? scene.output.directory + ending : line.output;
    };
    if (!line.dry_run && !line.resume && !line.overwrite)
      {
        const std::string held = tread::held_by_other_scene(folder_of(line.points.wanted ? "-contact-points"
                                                                      : line.reference_only ? "-reference"
                                                                      : !line.wear.empty()  ? "-wear"
                                                                      : line.modes.wanted   ? "-modes"
                                                                                            : ""),
                                                            line.scene, scene.general.title);
        tread::require(dealii::Utilities::MPI::broadcast(comm, held.empty(), 0), held);
      }
    if (line.points.wanted)
      {
        if (scene.rail.is_sliced())
          {
            tread::require(!line.points.is_over_shift,
                           "--shift-to, --shift-step and --other-side are for a rail that is the same "
                           "everywhere: over 'Rail/Shape' slices --contact-points follows the way of the "
                           "scene, at its lateral shift");
            tread::write_contact_way(scene, folder_of("-contact-points"), comm);
          }
        else
          tread::write_contact_points(scene, line.points, folder_of("-contact-points"), comm);
        return 0;
      }
    if (!line.wear.empty())
      {
        scene.damage.record = true; // that is what it is about
        if (line.dry_run)
          {
            tread::estimate_profile_wear(scene, line.wear, comm);
            return 0;
          }
        return tread::write_profile_wear(scene, line.wear, folder_of("-wear"), line.resume, comm) ? 0 : 130;
      }
    if (line.reference_only)
      {
        (scene.is_positioned() ? tread::run_wheelset_reference
                               : tread::run_reference_only)(scene, folder_of("-reference"), comm);
        return 0;
      }
    if (scene.is_positioned())
      {
        tread::require(!line.modes.wanted,
                       "--modes is for an upright wheel: 'Wheelset' must have no position");
        scene.check_placed_mesh();
      }
    if (line.modes.wanted)
      {
        tread::write_modes(scene, line.modes, folder_of("-modes"), comm);
        return 0;
      }
    tread::require_memory(scene, comm);
    if (line.dry_run && tread::estimate_without_mesh(scene, comm))
      return 0;
    if (line.dry_run)
      {
        tread::estimate(tread::Model(scene, comm, {}));
        return 0;
      }
    return tread::run(scene, comm, folder_of(""), line.resume) ? 0 : 130;
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
