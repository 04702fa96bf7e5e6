// SPDX-License-Identifier: LGPL-2.1-or-later
// What a run would cost.
#include <tread/base/format.h>
#include <tread/simulation/doubts.h>
#include <tread/simulation/simulation.h>

#include <deal.II/base/mpi.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

namespace tread
{
  namespace
  {
    /// Time of a run over that of its internal forces. On an idle machine and two ranks it was 1.4 to 1.5 for
    /// wheels on the track of prm/tutorial (89 000 cells) and 1.7 to 2.4 for the half-space scenes of 1.3 mm
    /// (10 000 cells), where contact and waiting for each other weigh more. The upper part of that is
    /// promised.
    constexpr double all_over_forces = 2.2;

    /// Steps that take as long as the start. In the same runs the start took 270 to 1200 of them; where a
    /// wheel starts with traction on a track it takes up to 8000.
    constexpr double relaxation_steps = 1200.;

    /// Least memory of a cell while the mesh is made: 1.1 kB were found, that of deal.II's mesh included.
    constexpr double bytes_of_cell = 900.;

    /// Cells of all sizes over those of the finest size: 4.2 to 5 were found in meshes of 12 000 to 406 000
    /// cells.
    constexpr double all_over_finest = 2.5;

    /// Bytes that the processes of this machine may use: its memory, or less where a container is bounded.
    double memory_of_machine()
    {
      double memory = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
      for (const char *const file :
           {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"})
        if (double limit; std::ifstream(file) >> limit) // "max": no bound
          memory = std::min(memory, limit);
      return memory;
    }

    /// Cells that make a mesh in a few seconds: some 200 000 a second were found.
    constexpr double quickly_made = 6e5;

    /// From the finest cells of wheels and paths.
    double least_cells(const Scene &scene)
    {
      const double h = scene.mesh.finest_cell,
                   width =
                     2. * (scene.is_positioned() ? scene.mesh.fine_half_width : scene.fine_half_width());
      return all_over_finest * 2. * scene.n_wheels() * scene.mesh.fine_layers * std::max(1., width / h) *
             (scene.mesh.window ? scene.window_length() + 2. * scene.window_margin()
                                : scene.motion.rolled_distance) /
             std::max(h, scene.mesh.path_cell);
    }
  } // namespace


  bool estimate_without_mesh(const Scene &scene, const MPI_Comm comm)
  {
    const double cells = least_cells(scene);
    if (cells < quickly_made)
      return false;
    if (dealii::Utilities::MPI::this_mpi_process(comm) != 0)
      return true;
    // As cell_cost() counts them.
    constexpr double steps_over_travel_time = 1.2;
    const double     wave_speed =
      scene.rail.material.elastic().pressure_wave_speed() / std::sqrt(scene.general.density_scale);
    for (const std::string &unused : scene.unused_parameters())
      std::printf("WARNING: %s\n", unused.c_str());
    for (const std::string &doubt : scene.doubts())
      std::printf("WARNING: %s\n", doubt.c_str());
    std::printf(
      "cells                %10.2g million at least, by 'Mesh/Finest cell (mm)' %g: too many to make their "
      "mesh for this answer\n",
      1e-6 * cells, 1e3 * scene.mesh.finest_cell);
    std::printf("steps                %12.3g\n", steps_over_travel_time * scene.motion.rolled_distance /
                                                   scene.motion.speed * wave_speed / scene.mesh.finest_cell);
    std::printf("cells and nodes use  %12.0f MB at least\n", 1e-6 * bytes_of_cell * cells);
    std::printf("inertia error        %12.2g   (speed / wave speed)^2 at density scale %g\n",
                scene.inertia_error_estimate(), scene.general.density_scale);
    std::printf(
      "estimated time       none: larger cells have one, and half their size takes sixteen times as long\n");
    return true;
  }


  void require_memory(const Scene &scene, const MPI_Comm comm)
  {
    const double cells = least_cells(scene);
    MPI_Comm     of_machine;
    MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &of_machine);
    const double share = double(dealii::Utilities::MPI::n_mpi_processes(of_machine)) /
                         dealii::Utilities::MPI::n_mpi_processes(comm);
    MPI_Comm_free(&of_machine);
    const double needed = share * bytes_of_cell * cells, available = memory_of_machine();
    const bool   fits = needed < available;
    if (dealii::Utilities::MPI::logical_or(!fits, comm))
      throw InputError(format("'Mesh/Finest cell (mm)' %g makes at least %.3g million cells, which "
                              "need %.3g GB; a machine with %.3g GB is too small",
                              1e3 * scene.mesh.finest_cell, 1e-6 * cells, 1e-9 * needed, 1e-9 * available));
  }


  void estimate(const Model &model)
  {
    const Scene            &scene    = model.scene;
    const ExplicitDynamics &dynamics = model.dynamics;
    const MPI_Comm          comm     = model.comm;
    const double            step     = scene.time_stepping.courant_number * dynamics.critical_time_step();
    const std::uint64_t     steps    = model.remaining_steps();
    // A few force evaluations tell this machine's pace.
    NodalField       force(model.mesh.nodes.size(), Vector3{});
    const NodalField x     = dynamics.state.positions();
    const auto       start = MPI_Wtime();
    unsigned int     n     = 0;
    for (; n < 3 || MPI_Wtime() - start < 0.3; ++n)
      model.solid.add_internal_forces(x.data(), dynamics.state.v.data(), force.data());
    const double           seconds = dealii::Utilities::MPI::max((MPI_Wtime() - start) / n, comm);
    const double           memory = model.memory_of_cells_and_nodes(), gain = dynamics.ideal_gain_of_levels();
    constexpr unsigned int n_choices = 4; // of levels
    std::array<double, n_choices> gains;
    for (unsigned int level = 0; level < n_choices; ++level)
      gains[level] = dynamics.ideal_gain_of_levels(level);
    const auto time = [&](const double density_scale, const double gain_of_levels) {
      return all_over_forces * seconds *
             (steps * std::sqrt(scene.general.density_scale / density_scale) / gain_of_levels +
              relaxation_steps);
    };
    std::vector<std::string> doubts = scene.doubts();
    if (const std::string unseen = unseen_detail(scene); !unseen.empty())
      doubts.push_back(unseen);
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      {
        for (const std::string &unused : scene.unused_parameters())
          std::printf("WARNING: %s\n", unused.c_str());
        if (const std::string defect = scene.defect_in_words(); !defect.empty())
          std::printf("%s\n", defect.c_str());
        for (const std::string &doubt : doubts)
          std::printf("WARNING: %s\n", doubt.c_str());
        if (scene.mesh.window)
          std::printf(
            "window of fine cells %12u places; what follows is of the first one, without the changes\n",
            scene.n_windows());
        std::printf("cells                %12llu\n", (unsigned long long)model.mesh.n_global_cells);
        std::printf("unknowns             %12llu\n",
                    3ull * (model.mesh.n_global_nodes - model.mesh.n_global_hanging_nodes));
        std::printf("time step            %12.4g s\n", step);
        if (dynamics.max_level() > 0)
          std::printf("levels of time steps %12u     cell updates fall to 1/%.2f\n", dynamics.max_level() + 1,
                      gain);
        std::printf("steps                %12llu\n", (unsigned long long)steps);
        std::printf("cells and nodes use  %12.0f MB\n", memory / 1e6);
        std::printf("inertia error        %12.2g   (speed / wave speed)^2 at density scale %g\n",
                    scene.inertia_error_estimate(), scene.general.density_scale);
        std::printf(
          "estimated time       %12.0f s on %u rank(s), about %.1f times that of the internal forces\n",
          time(scene.general.density_scale, gain), dealii::Utilities::MPI::n_mpi_processes(comm),
          all_over_forces);
        std::printf("with 'Levels'        %12s", "");
        for (unsigned int levels = 1; levels <= n_choices; ++levels)
          std::printf("%9u", levels);
        std::printf("   inertia error\n");
        std::vector<double> scales{scene.general.density_scale};
        if (scene.general.quasi_static)
          scales.insert(scales.end(), {1., 4., 9., 25.});
        std::sort(scales.begin(), scales.end());
        scales.erase(std::unique(scales.begin(), scales.end()), scales.end());
        for (const double scale : scales)
          {
            std::printf("'Density scale' %4g: s            ", scale);
            for (const double gain_of_levels : gains)
              std::printf("%9.0f", time(scale, gain_of_levels));
            std::printf("   %.2g\n", scene.inertia_error_estimate() * scale / scene.general.density_scale);
          }
      }
  }
} // namespace tread
