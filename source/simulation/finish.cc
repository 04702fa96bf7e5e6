// SPDX-License-Identifier: LGPL-2.1-or-later
// What a simulation says at the end of the run.
#include <tread/base/format.h>
#include <tread/base/version.h>
#include <tread/output/quality.h>
#include <tread/output/summary_keys.h>
#include <tread/scene/assumptions.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/measured_profiles.h>
#include <tread/scene/parts.h>
#include <tread/scene/wheelset_summary.h>
#include <tread/simulation/comparison.h>
#include <tread/simulation/doubts.h>
#include <tread/simulation/simulation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tread
{
  namespace
  {
    const bool keys_of_finish_are_known =
      know_summary_keys(
        SummaryGroup::words,
        {{"note", "Why there is no comparison with steady rolling, or what stands against it, in words; only "
                  "where there is something to say"},
         {"assumptions",
          "What the run takes for granted, in words: scaled density, damping, the type of start, ..."},
         {"unused_parameters",
          "What the scene sets and another of its parameters leaves without effect, in words"}}) &&
      know_summary_keys(
        SummaryGroup::size,
        {{"contact_unconverged_steps",
          "Steps in which the iteration of the contact ended before 'Contact/Tolerance' was reached"},
         {"cells", "Number of cells of all bodies"},
         {"windows", "Number of places at which the window of fine cells has stood"},
         {"window_loss_J", "Energy that fine cells had and others do not carry when the window moves"},
         {"plastic_cells", "Number of cells that can yield"},
         {"unknowns", "Three for each node that does not hang"},
         {"steps", "Time steps of the shortest level, of all passages"},
         {"time_step_s", "Of the shortest level, at the end"},
         {"density_scale", "'Scene/Density scale'"},
         {"added_mass_rail_kg", "Mass that 'Time stepping/Least step (us)' added to the fastest cells of the "
                                "rail, the largest of all windows of fine cells"},
         {"added_mass_rail_share", "The same over the mass of the rail's cells"},
         {"added_mass_wheels_kg", "The same of all wheels' cells"},
         {"added_mass_wheels_share", "The same over the mass of these cells"},
         {"added_mass_error_estimate",
          "Inertia of what was added at a wheel and in the rail, at 1 kHz, over the stiffness of the "
          "contact: about the relative error of the contact force there"},
         {"inertia_error_estimate", "Relative error by inertia in steady rolling, about: density scale x "
                                    "square of the speed over that of Rayleigh waves in the slower body"},
         {"rolled_m", "How far the wheel has rolled; of several passages in the last one"},
         {"rolled_patch_lengths", "The same, from the onset of a torque on, over the length of the patch "
                                  "under the normal force, by Hertz or half-space theory"},
         {"long_enough_to_be_steady", "Whether that is enough for steady rolling: 1.5 lengths after a start "
                                      "with tractions if no cell can yield, otherwise 3"}}) &&
      know_summary_keys(SummaryGroup::passages,
                        {{"passages", "Wheels that roll over the rail one after the other: "
                                      "'Motion/Passages', or fewer where its steel failed"}}) &&
      know_summary_keys(
        SummaryGroup::cost,
        {{"wall_s_start", "Wall time of the equilibrium at the start, of the last passage"},
         {"wall_s_internal_forces",
          "Wall time of forces of cells and supports in all steps, of the slowest rank"},
         {"wall_s_contact", "Wall time of search and solution of the contact, likewise"},
         {"wall_s_communication",
          "Wall time in which ranks exchange forces and wait for each other, likewise"},
         {"wall_s_nodes", "Wall time of moving nodes and hubs, likewise"},
         {"element_updates", "Evaluations of cells in all time steps on all ranks"},
         {"element_updates_per_s", "The same over the wall time of internal forces"},
         {"cells_and_nodes_bytes", "Memory of mesh, cells and nodes on all ranks"},
         {"imbalance_of_cells", "Largest number of cells of a rank over the mean"},
         {"imbalance_of_cost",
          "What the cells of the slowest rank cost in a step over the mean of the ranks, by their kinds and "
          "levels of time steps: what the others wait for"},
         {"ranks_of_contact",
          "So many of the ranks share the sweeps over the patch, as many as have enough to do"}});
  } // namespace


  Simulation::Rolled Simulation::add_size(Summary &summary, const double normal_force) const
  {
    summary.set("contact_unconverged_steps", model.contact.n_unconverged_steps);
    summary.set("cells", model.mesh.n_global_cells);
    const auto n_plastic_cells = dealii::Utilities::MPI::sum(model.solid.plastic().n_cells(), comm);
    summary.set("plastic_cells", n_plastic_cells);
    summary.set("unknowns", 3 * (model.mesh.n_global_nodes - model.mesh.n_global_hanging_nodes));
    summary.set("steps", model.dynamics.state.n_steps);
    summary.set("time_step_s", model.dynamics.state.time_step);
    summary.set("density_scale", scene.general.density_scale);
    summary.set("inertia_error_estimate", inertia_error_estimate(scene));
    summary.set("passages", scene.motion.passages);
    if (scene.time_stepping.least_step > 0.)
      {
        summary.set("added_mass_rail_kg", added_mass.rail);
        summary.set("added_mass_rail_share", added_mass.rail_share);
        summary.set("added_mass_wheels_kg", added_mass.wheels);
        summary.set("added_mass_wheels_share", added_mass.wheels_share);
        summary.set("added_mass_error_estimate", added_mass.error_estimate);
      }

    const double                  distance = model.position() - scene.path_begin();
    const reference::HertzEllipse ellipse  = scene.stance().ellipse(
       normal_force > 0. ? normal_force / scene.wheelset.n_wheels() : scene.static_load());
    Rolled rolled;
    rolled.patch_lengths =
      (distance - (torque_released ? scene.motion.hold_distance : 0.)) / (2. * ellipse.semi_axis_x);
    // Half-space theory does not predict what yields.
    rolled.lengths_to_be_steady = starts_with_tractions && n_plastic_cells == 0 ? 1.5 : 3.;
    summary.set("rolled_m", distance);
    summary.set("rolled_patch_lengths", rolled.patch_lengths);
    summary.set("long_enough_to_be_steady", rolled.long_enough());
    return rolled;
  }


  void Simulation::add_cost(Summary &summary) const
  {
    using dealii::Utilities::MPI::max;
    const StepTimes &times           = model.dynamics.times();
    const double     internal_forces = max(times.internal_forces, comm);
    summary.set("wall_s", max(wall_seconds, comm));
    summary.set("wall_s_start", max(relaxation_seconds, comm));
    summary.set("wall_s_internal_forces", internal_forces);
    summary.set("wall_s_contact", max(times.contact + times.search, comm));
    summary.set("wall_s_communication", max(times.communication, comm));
    summary.set("wall_s_nodes", max(times.nodes, comm));
    const double updates =
      model.mesh.n_global_cells / model.dynamics.ideal_gain_of_levels() * model.dynamics.state.n_steps;
    summary.set("element_updates", updates);
    summary.set("element_updates_per_s", updates / std::max(1e-9, internal_forces));
    summary.set("cells_and_nodes_bytes", model.memory_of_cells_and_nodes());
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
    summary.set("ranks", n_ranks);
    summary.set("imbalance_of_cells",
                n_ranks * double(max(model.mesh.cells.size(), comm)) / model.mesh.n_global_cells);
    summary.set("imbalance_of_cost", model.dynamics.imbalance_of_cost(cell_cost(scene)));
    summary.set("ranks_of_contact", max(model.contact.n_sweeping_ranks(), comm));
    summary.set("version", version());
    summary.set("files", as_json(scene.parameters().files_read()));
  }


  Quality Simulation::quality(const EnergyLedger &energy) const
  {
    Quality quality;
    quality.energy = energy;
    quality.limits = scene.watchdogs.warn;
    if (solution.average().n_steps() > 0)
      quality.slip_chatter = solution.average().slip_chatter();
    const std::uint64_t n_steps = model.dynamics.state.n_steps;
    quality.contact_unconverged = n_steps > 0 ? double(model.contact.n_unconverged_steps) / n_steps : 0.;
    return quality;
  }


  void Simulation::add_warnings(Report &report, const EnergyLedger &energy, const Rolled &rolled) const
  {
    std::vector<std::string> &warnings = report.warnings;
    if (!model.wheelset.problem().empty())
      warnings.push_back(
        "no half-space answer where the wheelset has arrived, and positions, angles and creepages of "
        "'patches' are those of the start: " +
        model.wheelset.problem());
    for (const std::string &warning : model.wheelset.stance().warnings())
      warnings.push_back(warning);
    if (report.completed)
      {
        for (const std::string &doubt : doubts_at_start(model))
          warnings.push_back(doubt);
        for (const std::string &doubt : doubts_at_end(model, end_of_way, model.position() - went_on_at))
          warnings.push_back(doubt);
        if (scene.shapes().are_smooth() && !rolled.long_enough())
          warnings.push_back(format(
            "only %.1f patch lengths rolled since the %s: steady rolling takes %g or more",
            rolled.patch_lengths, torque_released ? "torque acts" : "start", rolled.lengths_to_be_steady));
      }
    if (added_mass.error_estimate > AddedMass::largest_error)
      warnings.push_back(format(
        "'Time stepping/Least step (us)' added %.3g kg to the rail's cells and %.3g kg to the wheels' in "
        "one of the windows of fine cells: its inertia is about %.3g %% of the contact force at 1 kHz",
        added_mass.rail, added_mass.wheels, 100. * added_mass.error_estimate));
    constexpr double large_loss = 0.02;
    if (const double loss = energy.of_dissipated(energy.window); std::abs(loss) > large_loss)
      warnings.push_back(
        format("the changes of the window of fine cells %s %.1f %% of what was dissipated: a larger "
               "'Mesh/Window margin (mm)' or 'Window length (mm)'%s",
               loss > 0. ? "took" : "gave", 100. * std::abs(loss),
               scene.general.density_scale != 1. ? ", or 'Scene/Density scale' 1" : ""));
  }


  void Simulation::finish(RunFolder &folder, const End end)
  {
    Report             report{folder, end == End::complete};
    Summary           &summary = report.summary;
    const EnergyLedger energy  = model.dynamics.ledger();
    const auto         patches = solution.patches();
    const double       normal  = end_of_way.force_on(model.wheels.front())[2]; // 0 while it is in the air
    const RunAnswer    answer{model, end_of_way, solution, patches, report.completed};
    const Compared     compared = compare_with_half_space(answer, summary);
    if (!compared.note.empty())
      summary.set("note", compared.note);
    summary.set("assumptions", assumptions(scene, starts_with_tractions));
    summary.set("unused_parameters", scene.unused_parameters());
    const Quality judged = quality(energy);
    judged.add_to(summary);
    report.warnings = judged.warnings();
    if (has_window(scene))
      {
        summary.set("windows", window.number + 1);
        summary.set("window_loss_J", energy.window);
      }
    const Rolled      rolled         = add_size(summary, normal);
    const std::string further_wheels = add_further_wheels(answer, summary);
    add_cost(summary);
    add_warnings(report, energy, rolled);
    for (const auto &recorder : recorders)
      recorder->finish(report);
    MeasuredProfiles(scene).summarise(summary);
    summary.set("warnings", report.warnings);
    if (!compared.reference_patch.empty())
      folder.write_table("reference_patch.csv", patch_columns(), compared.reference_patch);
    write_last(report);
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      show(report, compared, further_wheels + report.lines + judged.lines(), end);
  }


  void Simulation::write_last(const Report &report) const
  {
    const RunFolder                                 &folder = report.folder;
    std::vector<std::pair<std::string, std::string>> parameters;
    for (const ParameterFile::Setting &setting : scene.parameters().values())
      parameters.emplace_back(setting.path, setting.value);
    folder.write_hdf5(report.summary.text(), parameters);
    // Last but for the pictures, which are there: it says that the run is complete.
    folder.write("summary.json", report.summary.text());
    if (report.completed && !scene.motion.may_go_on()) // pictures that may follow have files of their own
      folder.join_pictures();
  }


  void Simulation::show(const Report      &report,
                        const Compared    &compared,
                        const std::string &below,
                        const End          end) const
  {
    const RunFolder &folder = report.folder;
    const Vector3    force  = end_of_way.force_on(model.wheels.front());
    if (scene.has_impacts())
      std::printf("\n%s", report.extremes.c_str());
    // Where nothing is steady, the figures of one instant say little.
    if (scene.shapes().are_smooth())
      std::printf("\n%s force %.2f kN (ripple %.2f %%), traction coefficient %.4f\n\n%s%s",
                  scene.stance().words().load_direction.c_str(), 1e-3 * force[2], 100. * end_of_way.normal_ripple(),
                  force[2] > 0. ? force[0] / force[2] : 0., compared.by_patch.c_str(),
                  report.summary.table().c_str());
    std::printf("\n%s%s%s", below.c_str(), compared.note.c_str(), compared.note.empty() ? "" : "\n");
    for (const std::string &warning : report.warnings)
      std::printf("WARNING: %s\n", warning.c_str());
    const std::string pictures = (scene.output.write_volume ? folder.list_of_pictures("volume") + ", " : "") +
                                 folder.list_of_pictures("surface");
    std::printf("%s in %.1f s. Results in %s: summary.json, history.csv, run.h5%s%s\n",
                end == End::complete      ? "finished"
                : end == End::interrupted ? "INTERRUPTED: stopped"
                                          : "STOPPED",
                wall_seconds, folder.path("").c_str(),
                solution.is_taken() ? (", patch.csv; for ParaView: " + pictures).c_str() : "",
                end == End::interrupted ? "; go on with --resume" : "");
  }
} // namespace tread
