// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/version.h>
#include <tread/scene/scene.h>
#include <tread/simulation/simulation.h>
#include <tread/tools/dynamic_force_files.h>
#include <tread/tools/reference_only.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <exception>
#include <iostream>
#include <map>
#include <thread>

namespace
{
  const char *usage = R"(tread: a railway wheel rolls over a rail

  tread SCENE.prm [options]            mpirun -np N tread SCENE.prm [options]

  -s "Section/Name=value"   set a parameter; may be repeated
  --output DIR              folder of the results
  --resume                  go on from the last checkpoint in that folder
  --reference-only          print and write the half-space answer of the scene in a second; roll nothing
  --dry-run                 print size and cost of the run; run and write nothing
  --dynamic-force RUN --smooth-twin TWIN [--window Hann] [--from MM] [--to MM]
                            what a defect adds: forces of the run in one folder minus those of the run without
                            the defect in another, with spectra
  --print-parameters        print all parameters with units, ranges and meaning, and stop
  --version, --help
)";

  struct CommandLine
  {
    std::string                scene;
    std::vector<std::string>   settings;
    std::string                output;
    tread::DynamicForceRequest dynamic;
    bool resume = false, reference_only = false, dry_run = false, print_parameters = false;
  };

  CommandLine parse(const int argc, char **argv)
  {
    CommandLine                                line;
    const std::map<std::string, std::string *> dynamic_force{{"--dynamic-force", &line.dynamic.run},
                                                             {"--smooth-twin", &line.dynamic.smooth_twin},
                                                             {"--window", &line.dynamic.window},
                                                             {"--from", &line.dynamic.from_mm},
                                                             {"--to", &line.dynamic.to_mm}};
    for (int i = 1; i < argc; ++i)
      {
        const std::string argument = argv[i];
        const auto        value    = [&]() -> std::string {
          if (i + 1 >= argc)
            throw tread::SceneError(argument + " needs a value");
          return argv[++i];
        };
        if (argument == "-s")
          line.settings.push_back(value());
        else if (argument == "--output")
          line.output = value();
        else if (const auto option = dynamic_force.find(argument); option != dynamic_force.end())
          *option->second = value();
        else if (argument == "--resume")
          line.resume = true;
        else if (argument == "--reference-only")
          line.reference_only = true;
        else if (argument == "--dry-run")
          line.dry_run = true;
        else if (argument == "--print-parameters")
          line.print_parameters = true;
        else if (!argument.empty() && argument[0] == '-')
          throw tread::SceneError("unknown option '" + argument + "'; tread --help lists all");
        else if (!line.scene.empty())
          throw tread::SceneError("more than one scene: '" + line.scene + "' and '" + argument + "'");
        else
          line.scene = argument;
      }
    if (line.resume + line.reference_only + line.dry_run > 1)
      throw tread::SceneError("only one of --resume, --reference-only and --dry-run can be asked for");
    if (line.dynamic.run.empty() != line.dynamic.smooth_twin.empty())
      throw tread::SceneError("--dynamic-force and --smooth-twin need each other: folders of two runs");
    if (!line.dynamic.run.empty() && !line.scene.empty())
      throw tread::SceneError("--dynamic-force reads two runs; it takes no scene");
    if (!line.dynamic.run.empty() && (line.resume || line.reference_only || line.dry_run))
      throw tread::SceneError(
        "--dynamic-force reads what two runs left; --resume, --reference-only and --dry-run are for a scene");
    return line;
  }

  int run(const int argc, char **argv, const MPI_Comm comm)
  {
    const bool speaks = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    for (int i = 1; i < argc; ++i)
      if (std::strcmp(argv[i], "--help") == 0 || std::strcmp(argv[i], "-h") == 0 ||
          std::strcmp(argv[i], "--version") == 0)
        {
          if (speaks)
            std::cout << (std::strcmp(argv[i], "--version") == 0 ? "tread " + tread::version() + "\n"
                                                                 : std::string(usage));
          return 0;
        }
    CommandLine line = parse(argc, argv);
    if (!line.dynamic.run.empty())
      {
        line.dynamic.output = line.output;
        tread::write_dynamic_force(line.dynamic, comm);
        return 0;
      }
    if (line.scene.empty() && !line.print_parameters)
      throw tread::SceneError("no scene given; tread --help shows how, prm/ holds scenes to start from");
    tread::Scene scene;
    scene.read(line.scene, line.settings);
    if (line.print_parameters)
      {
        if (speaks)
          scene.print(std::cout, true);
        return 0;
      }
    if (line.reference_only)
      {
        // beside the results of the run, never over them
        tread::run_reference_only(scene, line.output.empty() ? scene.output + "-reference" : line.output,
                                  comm);
        return 0;
      }
    tread::Simulation simulation(scene, comm);
    if (line.dry_run)
      {
        simulation.estimate();
        return 0;
      }
    return simulation.run(line.output.empty() ? scene.output : line.output, line.resume) ? 0 : 130;
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
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  MPI_Comm                                 errors; // nothing else waits on it
  MPI_Comm_dup(MPI_COMM_WORLD, &errors);
  int code;
  try
    {
      code = run(argc, argv, MPI_COMM_WORLD);
    }
  catch (const tread::SceneError &error)
    {
      code = fail(error.what(), 1, errors);
    }
  catch (const std::exception &error)
    {
      code = fail(error.what(), 2, errors);
    }
  MPI_Comm_free(&errors);
  return code;
}
