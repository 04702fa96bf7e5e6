// SPDX-License-Identifier: LGPL-2.1-or-later
// What a run would cost.
#include <tread/base/format.h>
#include <tread/recorders/history.h>
#include <tread/scene/assumptions.h>
#include <tread/scene/doubts.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/parts.h>
#include <tread/simulation/doubts.h>
#include <tread/simulation/simulation.h>

#include <deal.II/base/mpi.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <utility>
#include <vector>

namespace tread
{
  namespace
  {
    /// Iterations of the start: found with predicted tractions, growing with the number of cells of a patch,
    /// and on a track, which bends. With the default tolerances.
    double iterations_of_start(const Scene &scene)
    {
      constexpr double on_track = 3000., on_base = 900., of_cell = 0.63e-3; // m
      return scene.track.has_supports() && scene.rail.ends != EndKind::endless
               ? on_track
               : on_base * std::sqrt(of_cell / scene.mesh.finest_cell);
    }

    /// Seconds of half-space solutions before and after a run, and of its tables.
    constexpr double beside_steps = 0.8;

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
      const double h     = scene.mesh.finest_cell,
                   width = 2. * (scene.is_positioned() ? scene.mesh.fine_half_width : fine_half_width(scene));
      double longest     = 0.; // of the ways along which all are fine at once, m
      for (const Scene::Range &window : windows(scene))
        longest = std::max(longest, window.end - window.begin);
      return all_over_finest * 2. * scene.n_wheels() * scene.mesh.fine_layers * std::max(1., width / h) *
             (longest + (has_window(scene) ? 2. * window_margin(scene) : 0.)) /
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
    for (const std::string &doubt : doubts(scene))
      std::printf("WARNING: %s\n", doubt.c_str());
    std::printf(
      "cells                %10.2g million at least, by 'Mesh/Finest cell (mm)' %g: too many to make their "
      "mesh for this answer\n",
      1e-6 * cells, 1e3 * scene.mesh.finest_cell);
    std::printf("steps                %12.3g\n", steps_over_travel_time * scene.motion.rolled_distance /
                                                   scene.motion.speed * wave_speed / scene.mesh.finest_cell);
    std::printf("cells and nodes use  %12.0f MB at least\n", 1e-6 * bytes_of_cell * cells);
    std::printf("inertia error        %12.2g   (speed / wave speed)^2 at density scale %g\n",
                inertia_error_estimate(scene), scene.general.density_scale);
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


  namespace
  {
    /// What a mesh of the scene costs, found by making it and rolling for a moment.
    struct PaceOfMesh
    {
      double made = 0., iteration = 0.,
             row                   = 0.; ///< s: mesh and all that belongs to it; of the start; of a row
      double                forces = 0., others = 0.; ///< s of a step: the due cells' forces, all else
      double                step   = 0.;              ///< s of the motion
      double                memory = 0., largest_process = 0.; ///< bytes, the latter of all processes so far
      std::uint64_t         steps = 0; ///< of the whole way, as if all were on this mesh
      std::uint64_t         cells = 0, unknowns = 0;
      double                gain     = 1.; ///< of levels
      unsigned int          n_levels = 1;
      std::array<double, 4> gains{};                             ///< of so many levels
      std::vector<std::pair<double, AddedMass>> of_longer_steps; ///< time step (s), what it adds
    };

    /// Bring a wheel onto the rail as far as some iterations do, and set it rolling.
    void begin_to_roll(Model &model, const unsigned int iterations)
    {
      try
        {
          model.dynamics.relax(0., iterations, [](const unsigned int, const double) {});
        }
      catch (const std::runtime_error &) // no equilibrium so soon
        {
        }
      for (RollingWheel &wheel : model.wheels)
        {
          wheel.hub.motion.velocity_x = model.scene.motion.speed;
          wheel.hub.motion.angular_velocity =
            model.scene.motion.speed / model.scene.stance().rolling_radius();
        }
      model.dynamics.set_rigid_velocities();
      model.contact.scale_impulses(model.scene.time_stepping.courant_number *
                                   model.dynamics.critical_step().seconds());
      model.dynamics.start();
    }

    /// Call work(n) with more and more repetitions until they take long enough to be timed. Collective.
    /// @returns seconds of one
    double seconds_of(const MPI_Comm comm, const unsigned int at_once, const std::function<void()> &work)
    {
      constexpr double long_enough = 0.15; // s
      const double     start       = MPI_Wtime();
      unsigned int     n           = 0;
      double           seconds     = 0.;
      while (n < 3 * at_once || seconds < long_enough)
        {
          for (unsigned int k = 0; k < at_once; ++k, ++n)
            work();
          seconds = dealii::Utilities::MPI::max(MPI_Wtime() - start, comm);
        }
      return seconds / n;
    }

    /// The masses that some longer steps would add.
    std::vector<std::pair<double, AddedMass>> longer_steps(const Model &model, const double step)
    {
      std::vector<std::pair<double, AddedMass>> list;
      const auto                                masses = model.solid.cell_masses(model.mesh);
      for (const double factor : {1.25, 1.5, 2., 2.5, 3., 4.})
        {
          std::vector<double> sums(4, 0.); // of the rail and of wheels: own, added
          for (unsigned int c = 0; c < masses.size(); ++c)
            if (const unsigned int body = model.mesh.cells[c].body;
                body <= wheel_body(model.scene.n_wheels() - 1))
              {
                double own = 0.;
                for (const double of_node : masses[c])
                  own += of_node;
                const double ratio =
                  model.solid.cell_frequencies()[c] / highest_frequency_for(model.scene, factor * step);
                sums[2 * (body != rail_body)] += own;
                sums[2 * (body != rail_body) + 1] += own * std::max(0., ratio * ratio - 1.);
              }
          dealii::Utilities::MPI::sum(sums, model.comm, sums);
          list.emplace_back(
            factor * step,
            AddedMass{sums[1], sums[1] / sums[0], sums[3], sums[3] / sums[2],
                      added_mass_error_estimate(model.scene, (sums[1] + sums[3]) / model.scene.n_wheels())});
        }
      return list;
    }

    PaceOfMesh pace_of(const Scene &scene, const MPI_Comm comm, const WindowPlace &window)
    {
      PaceOfMesh   pace;
      const double began = MPI_Wtime();
      Model        model(scene, comm, window);
      auto        &dynamics = model.dynamics;
      pace.step             = scene.time_stepping.courant_number * dynamics.critical_step().seconds();
      pace.made             = dealii::Utilities::MPI::max(MPI_Wtime() - began, comm);
      pace.steps            = model.remaining_steps();
      pace.cells            = model.mesh.n_global_cells;
      pace.unknowns         = 3ull * (model.mesh.n_global_nodes - model.mesh.n_global_hanging_nodes);
      pace.memory           = model.memory_of_cells_and_nodes();
      pace.gain             = dynamics.ideal_gain_of_levels();
      pace.n_levels         = dynamics.max_level() + 1;
      for (unsigned int level = 0; level < pace.gains.size(); ++level)
        pace.gains[level] = dynamics.ideal_gain_of_levels(level);
      static_cast<void>(History(model)); // which refuses cells to record that lie outside the rail
      if (!scene.general.quasi_static && scene.time_stepping.least_step == 0.)
        pace.of_longer_steps = longer_steps(model, pace.step);

      NodalField       force(model.mesh.nodes.size(), Vector3{});
      const NodalField x      = dynamics.state.positions();
      const double     forces = seconds_of(
            comm, 1, [&]() { model.solid.add_internal_forces(x.data(), dynamics.state.v.data(), force.data()); });
      constexpr double   of_start = 0.15; // s
      const unsigned int iterations =
        std::min(400., std::max(50., of_start / dealii::Utilities::MPI::max(forces, comm)));
      const double start = MPI_Wtime();
      begin_to_roll(model, iterations);
      pace.iteration              = dealii::Utilities::MPI::max(MPI_Wtime() - start, comm) / iterations;
      pace.row                    = seconds_of(comm, 1, [&]() { dynamics.ledger(); });
      const StepTimes     before  = dynamics.times();
      const std::uint64_t so_far  = dynamics.state.n_steps;
      const double        of_step = seconds_of(comm, 1u << dynamics.max_level(), [&]() { dynamics.step(); });
      pace.forces = dealii::Utilities::MPI::max((dynamics.times().internal_forces - before.internal_forces) /
                                                  (dynamics.state.n_steps - so_far),
                                                comm);
      pace.others = of_step - pace.forces;
      rusage usage;
      getrusage(RUSAGE_SELF, &usage);
      constexpr double bytes = 1024.; // of a unit on Linux
      pace.largest_process   = dealii::Utilities::MPI::sum(bytes * double(usage.ru_maxrss), comm);
      return pace;
    }

    /// Windows that have cubes of the finest size where the first one has none, or have none where it has
    /// some: the place of the first of them, and the share of the way in all of them.
    struct OtherWindows
    {
      WindowPlace first;
      double      share = 0.; ///< 0: all are alike
    };

    OtherWindows other_windows(const Scene &scene)
    {
      OtherWindows found;
      if (!has_window(scene) || !has_cubes(scene))
        return found;
      const auto   in_turn    = windows(scene);
      const double margin     = window_margin(scene);
      const auto   with_cubes = [&](const Scene::Range &window) {
        return cubes(scene).begin < window.end + margin && cubes(scene).end > window.begin - margin;
      };
      for (unsigned int k = 1; k < in_turn.size(); ++k)
        if (with_cubes(in_turn[k]) != with_cubes(in_turn[0]))
          {
            if (found.share == 0.)
              found.first = {k, in_turn[k].begin - in_turn.front().begin};
            found.share += (in_turn[k].end - in_turn[k].begin) / (in_turn.back().end - in_turn.front().begin);
          }
      return found;
    }
  } // namespace


  void estimate(const Scene &scene, const MPI_Comm comm)
  {
    const PaceOfMesh   pace      = pace_of(scene, comm, {});
    const OtherWindows others    = other_windows(scene);
    const PaceOfMesh   in_others = others.share > 0. ? pace_of(scene, comm, others.first) : pace;
    const double       share     = others.share;
    const unsigned int n_windows = windows(scene).size();
    const auto         seconds   = [&](const double density_scale, const double gain_of_levels) {
      const double longer = std::sqrt(density_scale / scene.general.density_scale);
      const auto   of     = [&](const PaceOfMesh &mesh) {
        return mesh.steps / longer * (mesh.forces * mesh.gain / gain_of_levels + mesh.others);
      };
      const double rows = scene.motion.rolled_distance / scene.output.history_interval;
      return pace.made * n_windows +
             scene.motion.passages * (iterations_of_start(scene) * pace.iteration + (1. - share) * of(pace) +
                                      share * of(in_others) + rows * pace.row) +
             beside_steps;
    };
    std::vector<std::string> found = doubts(scene);
    if (const std::string unseen = unseen_detail(scene); !unseen.empty())
      found.push_back(unseen);
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      {
        for (const std::string &unused : scene.unused_parameters())
          std::printf("WARNING: %s\n", unused.c_str());
        if (const std::string defect = defect_in_words(scene); !defect.empty())
          std::printf("%s\n", defect.c_str());
        for (const std::string &doubt : found)
          std::printf("WARNING: %s\n", doubt.c_str());
        if (has_window(scene))
          std::printf(
            "window of fine cells %12u places; cells, memory and time step are those of the first one\n",
            n_windows);
        std::printf("cells                %12llu\n", (unsigned long long)pace.cells);
        std::printf("unknowns             %12llu\n", (unsigned long long)pace.unknowns);
        std::printf("time step            %12.4g s\n", pace.step);
        if (pace.n_levels > 1)
          std::printf("levels of time steps %12u     cell updates fall to 1/%.2f\n", pace.n_levels,
                      pace.gain);
        std::printf("steps                %12.0f\n", (1. - share) * pace.steps + share * in_others.steps);
        std::printf("cells and nodes use  %12.0f MB\n", pace.memory / 1e6);
        std::printf("all processes use    %12.0f MB by now; a run some 30 %% more\n",
                    std::max(pace.largest_process, in_others.largest_process) / 1e6);
        std::printf("inertia error        %12.2g   (speed / wave speed)^2 at density scale %g\n",
                    inertia_error_estimate(scene), scene.general.density_scale);
        std::printf(
          "estimated time       %12.3g s on %u rank(s); a step takes %.3g ms, of which forces %.3g\n",
          seconds(scene.general.density_scale, pace.gain), dealii::Utilities::MPI::n_mpi_processes(comm),
          1e3 * (pace.forces + pace.others), 1e3 * pace.forces);
        std::printf("with 'Levels'        %12s", "");
        for (unsigned int levels = 1; levels <= pace.gains.size(); ++levels)
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
            for (const double gain_of_levels : pace.gains)
              std::printf("%9.1f", seconds(scale, gain_of_levels));
            std::printf("   %.2g\n", inertia_error_estimate(scene) * scale / scene.general.density_scale);
          }
        if (!pace.of_longer_steps.empty())
          std::printf("with 'Least step (us)'    kg added to the rail, to the wheels, on this mesh   "
                      "inertia of that at 1 kHz over the contact's stiffness\n");
        for (const auto &[step, added] : pace.of_longer_steps)
          std::printf("  %-22.3g %12.3g %20.3g   %.2g %%\n", 1e6 * step, added.rail, added.wheels,
                      100. * added.error_estimate);
      }
  }
} // namespace tread
