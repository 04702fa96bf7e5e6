// SPDX-License-Identifier: LGPL-2.1-or-later
// What a simulation says at the end of a passage and of the run.
#include <tread/base/format.h>
#include <tread/base/version.h>
#include <tread/output/quality.h>
#include <tread/scene/measured_profiles.h>
#include <tread/scene/parts.h>
#include <tread/scene/steady_damage_tables.h>
#include <tread/scene/wheelset_summary.h>
#include <tread/simulation/simulation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <new>
#include <tuple>

namespace tread
{
  namespace
  {
    /// Traction over the friction bound from which nearly the whole patch slips: in Carter's strip (1926),
    /// traction 1 - (1 - creepage)^2 of the bound, a tenth of the length adheres here, and the last hundredth
    /// of traction is a tenth of the creepage.
    constexpr double nearly_sliding = 0.99;

    /// Amplitude of the tangential over the normal force from which a run is not called steady. Waves of the
    /// cells make up to a hundredth.
    constexpr double large_ripple = 0.03;

    /// @param stress Pa; @param x, y, depth m
    std::string line_of_stress(const std::string &what,
                               const double       stress,
                               const double       x,
                               const double       y,
                               const double       depth)
    {
      return format("%-46s %7.1f MPa at x = %.2f mm, y = %.2f mm, depth %.2f mm\n", what.c_str(),
                    1e-6 * stress, 1e3 * x, 1e3 * y, 1e3 * depth);
    }

    /// The largest plastic strain of the rail's and the first wheel's cells.
    /// @returns a line for the screen, empty if nothing can yield.
    std::string add_plastic_strain(Summary                                               &summary,
                                   const ExplicitDynamics                                &dynamics,
                                   const unsigned int                                     wheel,
                                   const std::function<double(const dealii::Point<3> &)> &depth_in_rail,
                                   const MPI_Comm                                         comm)
    {
      using dealii::Utilities::MPI::max;
      const Mesh  &mesh  = dynamics.mesh;
      const Solid &solid = dynamics.solid;
      if (dealii::Utilities::MPI::sum(solid.plastic().n_cells(), comm) == 0)
        return "";
      const std::vector<double> strains = solid.plastic().equivalent_plastic_strain(dynamics.state.history);
      std::string               line;
      for (const auto &[body, key, name] : {std::tuple(rail_body, "largest_plastic_strain", "rail"),
                                            std::tuple(wheel, "wheel_largest_plastic_strain", "wheel")})
        {
          std::vector<unsigned int> cells;
          double                    own = -1.; // of this rank
          for (unsigned int c = 0; c < mesh.cells.size(); ++c)
            if (mesh.cells[c].body == body && solid.plastic().contains(c))
              {
                cells.push_back(c);
                own = std::max(own, strains[c]);
              }
          const double largest = max(own, comm);
          if (largest < 0.) // no cell of this body can yield
            continue;
          summary.set(key, largest);
          line += format("%s %.3f %% in the %s", line.empty() ? "largest equivalent plastic strain" : ",",
                         100. * largest, name);
          if (body != rail_body || largest == 0.)
            continue;
          // Of equal cells, such as a row along the path, the foremost, whatever rank has it.
          constexpr double      far = 1e30;
          std::array<double, 3> place{{-far, -far, -far}};
          for (const unsigned int c : cells)
            if (strains[c] == largest)
              {
                dealii::Point<3> centre;
                for (const unsigned int i : mesh.cells[c].nodes)
                  centre += mesh.nodes[i] / 8.;
                place = std::max(place, {{centre[0], centre[1], depth_in_rail(centre)}});
              }
          const auto places = dealii::Utilities::MPI::all_gather(comm, place);
          place             = *std::max_element(places.begin(), places.end());
          for (unsigned int d = 0; d < 3; ++d)
            summary.set(std::string(key) + std::array{"_x_m", "_y_m", "_depth_m"}[d], place[d]);
          line += format(" (x = %.2f mm, y = %.2f mm, depth %.2f mm)", 1e3 * place[0], 1e3 * place[1],
                         1e3 * place[2]);
        }
      return line.empty() ? line : line + "\n";
    }
  } // namespace


  bool Simulation::is_in_middle(const dealii::Point<3> &p) const
  {
    constexpr double half_length = 5e-3;
    return std::abs(p[0] - 0.5 * (scene.path_begin() + scene.path_end())) <= half_length;
  }


  void Simulation::make_growth()
  {
    std::vector<char> judged(mesh.cells.size(), false), of_rail(mesh.nodes.size(), false);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      judged[c] = solid.plastic().contains(c) && mesh.cells[c].body == rail_body &&
                  is_in_middle(mesh.nodes[mesh.cells[c].nodes[0]]);
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      of_rail[i] = mesh.node_bodies[i] == rail_body;
    std::function<bool(const dealii::Point<3> &)> uniform;
    if (scene.ratcheting.uniform)
      uniform = [this](const dealii::Point<3> &p) {
        return is_in_middle(p);
      };
    growth = std::make_unique<PassageGrowth>(scene.ratcheting, mesh, solid, dynamics.state, judged, of_rail,
                                             uniform);
  }


  void Simulation::end_passage(RunFolder &folder, Progress &progress)
  {
    using dealii::Utilities::MPI::max;
    using dealii::Utilities::MPI::sum;
    if (interval_steps > 0)
      end_interval(folder);
    const double number = (passages.empty() ? 0. : passages.back().number) + skipped + 1.;
    growth->note(number);
    constexpr double on_line    = 1e-6;
    const auto       is_on_path = [&](const dealii::Point<3> &p) {
      return scene.is_positioned() ? scene.placed_wheel().is_on_path(p, scene.mesh.finest_cell)
                                         : std::abs(p[1]) < on_line && std::abs(p[2]) < on_line;
    };
    ReproducibleSum<double> settled, shifted;
    double                  n_nodes = 0., strain = 0., residual = 0.;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (const dealii::Point<3> &p = mesh.nodes[i]; mesh.node_bodies[i] == rail_body &&
                                                     mesh.shared_nodes.is_owned(i) && is_in_middle(p) &&
                                                     is_on_path(p))
        {
          settled.add(p[2] - dynamics.state.position(i)[2]);
          shifted.add(dynamics.state.position(i)[0] - p[0]);
          n_nodes += 1.;
        }
    const std::vector<std::array<double, 6>> stress =
      solid.cauchy_stress(dynamics.state.positions().data(), dynamics.state.history);
    const std::vector<double> strains = solid.plastic().equivalent_plastic_strain(dynamics.state.history);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (solid.plastic().contains(c) && mesh.cells[c].body == rail_body &&
          is_in_middle(mesh.nodes[mesh.cells[c].nodes[0]]))
        {
          strain   = std::max(strain, strains[c]);
          residual = std::max(residual, von_mises(stress[c]));
        }
    n_nodes                   = sum(n_nodes, comm); // 0: not a number, instead of a settlement of 0
    const Vector3      force  = last_force_on(wheels.front());
    const EnergyLedger energy = dynamics.ledger();
    passages.push_back({number, double(skipped), settled.value(comm) / n_nodes, shifted.value(comm) / n_nodes,
                        max(strain, comm), growth->net_strain(), growth->rate(), max(residual, comm),
                        energy.plastic, energy.friction, force[2] > 0. ? force[0] / force[2] : 0.,
                        measure(solution_patches().front()).max_pressure, energy.residual_share(),
                        energy.of_dissipated(energy.residual())});
    folder.write_passages(passages);
    progress.say(format("passage %u of %u: settlement %.2f um, largest plastic strain %.3f %%, net %.3f %%",
                        static_cast<unsigned int>(number), scene.motion.passages,
                        1e6 * passages.back().settlement, 100. * passages.back().plastic_strain,
                        100. * growth->net_strain()));
  }


  std::string Simulation::add_growth(Summary &summary, std::vector<std::string> &warnings) const
  {
    if (!growth || passages.empty())
      return "";
    const double strain = growth->net_strain(), per_passage = growth->rate();
    summary.set("passages_rolled", passages.size());
    summary.set("net_plastic_strain", strain);
    summary.set("net_plastic_strain_of_last_passage", per_passage);
    if (!(strain > 0.))
      return ""; // nothing has yielded anywhere
    const dealii::Point<3> place = growth->place();
    const double           depth = scene.depth_in_rail(place);
    summary.set("net_plastic_strain_y_m", place[1]);
    summary.set("net_plastic_strain_depth_m", depth);
    std::string line =
      format("net plastic strain of the rail %.3f %% after %.0f passages (y = %.2f mm, depth %.2f mm), "
             "%.3g %% in the last one",
             100. * strain, passages.back().number, 1e3 * place[1], 1e3 * depth, 100. * per_passage);
    if (growth->n_jumps() > 0)
      {
        summary.set("passages_left_out", growth->n_skipped());
        summary.set("jumps", growth->n_jumps());
        summary.set("net_plastic_strain_error_estimate", growth->error_of_strain());
        line += format("; %u passages left out in %u jumps, off by %.3g %% at most by its own estimate",
                       growth->n_skipped(), growth->n_jumps(), 100. * growth->error_of_strain());
        constexpr double too_much = 0.1;
        if (growth->error_of_strain() > too_much * strain)
          warnings.push_back(
            format("the jumps over passages may be off by %.3g %% of the net plastic strain: lower "
                   "'Ratcheting/Change in a jump (%%)'",
                   100. * growth->error_of_strain() / strain));
      }
    else if (scene.ratcheting.jumps)
      warnings.push_back("no passages were left out: the change per passage was never regular, see "
                         "'Ratcheting/Irregularity (%)'");
    if (growth->has_failed())
      {
        summary.set("passages_to_failure", passages.back().number);
        line += format("\nthe rail's steel reaches its strain at failure, %g %%, in passage %.0f",
                       100. * scene.ratcheting.strain_at_failure, passages.back().number);
      }
    return line + "\n";
  }


  std::vector<PatchNode> Simulation::compare_with_half_space(Summary             &summary,
                                                             const ContactAnswer &answer) const
  {
    const double         normal = answer.force[2], traction = answer.force[0];
    const PatchMeasures &patch = answer.patch;
    // Forces in the contact's own plane: where it is inclined, that on the wheel has a part of the
    // pressure's.
    const bool all_slips = !(patch.adhesion_share > 0.) ||
                           std::hypot(patch.longitudinal_force, patch.lateral_force) >=
                             nearly_sliding * scene.contact.friction_coefficient *
                               scene.contact.friction_factor(scene.path_end()) * patch.normal_force;
    // Where friction falls with slip, a force belongs to several creepages; where it depends on the pressure,
    // forces do not tell how near to sliding a patch is.
    const bool by_creepage = all_slips || !scene.friction_law()->is_constant() ||
                             !scene.contact.friction_pressures.empty() ||
                             !scene.contact.temperatures.empty() || scene.contact.varies_across();
    reference::RollingCase c = half_space_case(scene, normal, by_creepage ? 0. : traction / normal);
    c.prescribe_force        = !by_creepage;
    c.creepage               = -answer.creepage;
    const reference::RollingEstimate half_space = reference::estimate_rolling(c);
    compare(summary, answer, half_space, c.prescribe_force);
    return patch_nodes(half_space.fields, scene.first_contact().y);
  }


  std::string Simulation::friction_varies_at_end(const double normal_force) const
  {
    const double half_length =
      hertz(scene, normal_force > 0. ? normal_force : scene.static_load()).semi_axis_x;
    return scene.contact.friction_varies(scene.path_end() - last_way - half_length,
                                         scene.path_end() + half_length)
             ? format("'Contact/Friction factors' change in the patch at the end or on its last %g mm",
                      1e3 * last_way)
             : "";
  }


  std::string Simulation::compare_with_steady_rolling(Summary                &summary,
                                                      const ContactAnswer    &answer,
                                                      std::vector<PatchNode> &patch) const
  {
    if (scene.has_defect())
      return "no comparison with steady rolling: there is a defect on the rail";
    if (!scene.is_round())
      return "no comparison with steady rolling: the wheel is not round";
    if (scene.has_uneven_mesh())
      return "no comparison with steady rolling: the running surface of 'Rail/Mesh file' changes along the "
             "path";
    if (!(answer.force[2] > 0.))
      return "";
    if ((!scene.contact.friction_pressures.empty() || scene.contact.varies_across()) &&
        !scene.friction_law()->is_constant())
      return "no comparison with steady rolling: half-space theory has no answer for factors on the friction "
             "coefficient by pressure or across the rail with 'Contact/Friction law' " +
             scene.contact.friction_law;
    if (const std::string varies = friction_varies_at_end(answer.force[2]); !varies.empty())
      return "no comparison with steady rolling: " + varies;
    try
      {
        patch = compare_with_half_space(summary, answer);
      }
    catch (const std::bad_alloc &)
      {
        throw; // no fault of the input
      }
    catch (const std::exception &error)
      {
        return std::string("no half-space reference: ") + error.what();
      }
    return "";
  }


  std::vector<WheelPatch> Simulation::computed_patches() const
  {
    const RollingWheel     &wheel   = wheels.front();
    std::vector<WheelPatch> patches = placed().patches();
    for (unsigned int k = 0; k < patches.size(); ++k)
      {
        const PatchMeasures      m = wheel.averages_of_patches[k].measures();
        reference::PlanarResult &s = patches[k].solution;
        s.normal_force             = m.normal_force;
        s.longitudinal_force       = m.longitudinal_force;
        s.lateral_force            = m.lateral_force;
        s.spin_moment              = m.spin_moment;
        s.max_pressure             = m.max_pressure;
        s.area                     = m.area;
        s.adhesion_share           = m.adhesion_share;
        s.max_shear                = m.max_shear;
        s.max_slip                 = m.max_slip;
        s.frictional_power         = m.frictional_power;
        s.x_begin                  = m.x_middle - m.semi_axis_x;
        s.x_end                    = m.x_middle + m.semi_axis_x;
        s.y_begin                  = m.y_middle - m.semi_axis_y;
        s.y_end                    = m.y_middle + m.semi_axis_y;
      }
    return patches;
  }


  std::string Simulation::add_wheelset(Summary &summary, const bool completed) const
  {
    const PlacedWheel  &half_space_wheel = placed();
    const RollingWheel &wheel            = wheels.front();
    const Vector3       force            = last_force_on(wheel);
    WheelContact        computed;
    const Placement     at = placement_at_solution.value_or(placement_now());
    computed.position      = at.position;
    computed.force         = {force[0], force[1], force[2]};
    computed.patches       = computed_patches();
    summarise_wheelset(summary, scene, "explicit finite elements", computed, at.rates.angular_velocity,
                       completed);
    summary.set("free_rolling_creepage", wheel.free_creepage);
    const double rail_y = half_space_wheel.surfaces.rail_origin_y();
    summary.set("patches", patches_as_json(computed.patches, rail_y));
    if (!no_half_space.empty())
      {
        summary.show("normal_force_N", "vertical force, kN", 1e-3, force[2]);
        summary.show("longitudinal_force_N", "longitudinal force, kN", 1e-3, force[0]);
        summary.show("lateral_force_N", "lateral force in the track, kN", 1e-3, force[1]);
        summary.show("frictional_power_W", "frictional power, W", 1., frictional_power(computed));
        return table_of_patches(computed.patches, rail_y) + "\n";
      }
    const Vector3d &half_space = half_space_wheel.contact.force;
    // As good as nothing beside the force that is given.
    const double negligible = 0.01 * scene.wheelset.n_wheels() * scene.static_load();
    summary.compare("normal_force_N", "vertical force, kN", 1e-3, force[2], "half-space", half_space[2]);
    summary.compare("longitudinal_force_N", "longitudinal force, kN", 1e-3, force[0], "half-space",
                    half_space[0], negligible);
    summary.compare("lateral_force_N", "lateral force in the track, kN", 1e-3, force[1], "half-space",
                    half_space[1], negligible);
    summary.compare("frictional_power_W", "frictional power, W", 1., frictional_power(computed), "half-space",
                    frictional_power(half_space_wheel.contact));
    summary.set("half_space_patches", patches_as_json(half_space_wheel.patches(), rail_y));
    std::string text = table_of_patches(computed.patches, rail_y, half_space_wheel.patches()) + "\n";
    for (const std::string &limit : limits_of_half_space(half_space_wheel.patches()))
      text += "half-space: " + limit + "\n";
    return text;
  }


  Simulation::Rolled Simulation::add_size(Summary &summary, const double normal_force) const
  {
    summary.set("contact_unconverged_steps", contact.n_unconverged_steps());
    summary.set("cells", mesh.n_global_cells);
    const auto n_plastic_cells = dealii::Utilities::MPI::sum(solid.plastic().n_cells(), comm);
    summary.set("plastic_cells", n_plastic_cells);
    summary.set("unknowns", 3 * (mesh.n_global_nodes - mesh.n_global_hanging_nodes));
    summary.set("steps", dynamics.state.n_steps);
    summary.set("time_step_s", dynamics.state.time_step);
    summary.set("density_scale", scene.general.density_scale);
    summary.set("inertia_error_estimate", scene.inertia_error_estimate());
    summary.set("passages", scene.motion.passages);

    const double                  distance = position() - scene.path_begin();
    const reference::HertzEllipse ellipse =
      hertz(scene, normal_force > 0. ? normal_force / scene.wheelset.n_wheels() : scene.static_load());
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


  std::string Simulation::add_further_wheels(Summary                                   &summary,
                                             const std::vector<std::vector<PatchNode>> &patches) const
  {
    std::string lines;
    for (const RollingWheel &wheel : wheels)
      {
        if (wheel.number == 0)
          continue;
        const std::string   prefix   = "wheel_" + std::to_string(wheel.number + 1) + "_";
        const Vector3       force    = last_force_on(wheel);
        const PatchMeasures patch    = wheel.averaged_measures(patches[wheel.number]);
        const double        traction = force[2] > 0. ? force[0] / force[2] : 0.;
        for (const auto &[name, value] :
             {std::pair("normal_force_N", force[2]), std::pair("longitudinal_force_N", force[0]),
              std::pair("lateral_force_N", force[1]), std::pair("traction_coefficient", traction),
              std::pair("creepage", wheel.creepage(scene)),
              std::pair("free_rolling_creepage", wheel.free_creepage),
              std::pair("max_pressure_Pa", patch.max_pressure), std::pair("patch_area_m2", patch.area),
              std::pair("adhesion_share", patch.adhesion_share),
              std::pair("max_slip_m_per_s", patch.max_slip),
              std::pair("frictional_power_W", patch.frictional_power)})
          summary.set(prefix + name, value);
        lines += format("wheel %u: normal force %.2f kN, traction coefficient %.4f, creepage %.4fe-3, "
                        "maximum pressure %.1f MPa, adhesion %.1f %%\n",
                        wheel.number + 1, 1e-3 * force[2], traction, 1e3 * wheel.creepage(scene),
                        1e-6 * patch.max_pressure, 100. * patch.adhesion_share);
      }
    return lines.empty() ? lines : lines + "\n";
  }


  void Simulation::add_cost(Summary &summary) const
  {
    using dealii::Utilities::MPI::max;
    const StepTimes &times           = dynamics.times();
    const double     internal_forces = max(times.internal_forces, comm);
    summary.set("wall_s", max(wall_seconds, comm));
    summary.set("wall_s_start", max(relaxation_seconds, comm));
    summary.set("wall_s_internal_forces", internal_forces);
    summary.set("wall_s_contact", max(times.contact + times.search, comm));
    summary.set("wall_s_communication", max(times.communication, comm));
    summary.set("wall_s_nodes", max(times.nodes, comm));
    const double updates = mesh.n_global_cells / dynamics.ideal_gain_of_levels() * dynamics.state.n_steps;
    summary.set("element_updates", updates);
    summary.set("element_updates_per_s", updates / std::max(1e-9, internal_forces));
    summary.set("cells_and_nodes_bytes", memory_of_cells_and_nodes());
    summary.set("ranks", dealii::Utilities::MPI::n_mpi_processes(comm));
    summary.set("version", version());
    summary.set("files", as_json(scene.files_read()));
  }


  std::string Simulation::add_recorded(Summary &summary, RunFolder &folder) const
  {
    std::string lines;
    if (strip)
      {
        const std::vector<StripColumn> columns = strip->columns(dynamics);
        const auto                     most =
          std::max_element(columns.begin(), columns.end(), [](const StripColumn &a, const StripColumn &b) {
            return a.largest.stress < b.largest.stress;
          });
        if (most != columns.end())
          for (const auto &[name, value] : std::vector<std::pair<const char *, double>>{
                 {"strip_max_von_mises_Pa", most->largest.stress},
                 {"strip_max_von_mises_x_m", most->x},
                 {"strip_max_von_mises_y_m", most->y},
                 {"strip_max_von_mises_depth_m", most->depth},
                 {"strip_max_von_mises_time_s", most->largest.time}})
            summary.set(name, value);
        if (most != columns.end() && !rail_peaks)
          lines = line_of_stress("largest von Mises stress of the rail's cells", most->largest.stress,
                                 most->x, most->y, most->depth);
        folder.write_strip(columns);
      }
    if (seats)
      folder.write_rail_seats(seats->points());
    for (std::size_t i = 0; probes && i < probes->centres().size(); ++i)
      {
        const dealii::Point<3> &centre = probes->centres()[i];
        const std::string       name   = "cell_" + std::to_string(i + 1);
        summary.set(name + "_x_m", centre[0]);
        summary.set(name + "_y_m", centre[1]);
        summary.set(name + "_depth_m", scene.depth_in_rail(centre));
      }
    return lines;
  }


  void Simulation::add_damage(Summary &summary, RunFolder &folder, std::vector<std::string> &warnings) const
  {
    if (!damage)
      return;
    const std::vector<SurfacePlace> rail = damage->places(rail_body, [](const Vector3 &p) { return p[0]; });
    folder.write_surface_damage("rail_surface_damage.csv", rail);
    double hottest = max_temperature(rail);
    for (const RollingWheel &wheel : wheels)
      {
        const Vector3                   axle   = wheel.hub.start();
        const std::vector<SurfacePlace> places = damage->places(
          wheel.body, [&](const Vector3 &p) { return std::atan2(p[0] - axle[0], axle[2] - p[2]); });
        folder.write_surface_damage(RunFolder::table_of_wheel("wheel_surface_damage", wheel.number), places);
        hottest = std::max(hottest, max_temperature(places));
      }
    summary.set("max_flash_temperature_K", hottest);
    if (const std::string doubt = doubt_of_temperature(scene, hottest); !doubt.empty())
      warnings.push_back(doubt);
    if (!scene.wear_law())
      return;
    double volume = 0.;
    for (const SurfacePlace &place : rail)
      volume += place.area * place.wear_depth;
    summary.set("wear_volume_m3", volume);
  }


  std::string Simulation::add_peaks(Summary                  &summary,
                                    RunFolder                &folder,
                                    std::vector<std::string> &warnings) const
  {
    std::string lines;
    if (!rail_peaks)
      return lines;
    // Slow cells are looked at when all nodes are at the same instant.
    const double last_instant =
      dynamics.state.time - (std::uint64_t(1) << dynamics.max_level()) * dynamics.state.time_step;
    bool       still_grows = false;
    const auto add         = [&](const std::string &name, const Peak &peak, const bool with_depth) {
      summary.set(name + "_Pa", peak.value);
      summary.set(name + "_x_m", peak.x);
      summary.set(name + "_y_m", peak.y);
      if (with_depth)
        summary.set(name + "_depth_m", peak.depth);
      summary.set(name + "_time_s", peak.time);
      still_grows = still_grows || peak.time >= last_instant;
    };
    for (const bool of_rail : {true, false})
      {
        const StressPeaks::Answer answer = (of_rail ? rail_peaks : wheel_peaks)->answer(dynamics);
        const std::string         prefix = of_rail ? "peak_" : "wheel_peak_";
        Peak                      highest;
        for (const StressPeaks::Layer &layer : answer.layers)
          {
            highest     = std::max(highest, layer.peak);
            still_grows = still_grows || layer.peak.time >= last_instant;
          }
        add(prefix + "von_mises", highest, true);
        add(prefix + "surface_von_mises", answer.surface.peak, false);
        if (of_rail)
          {
            if (answer.from_tractions.value > 0.)
              add("peak_surface_von_mises_from_tractions", answer.from_tractions, false);
            add("peak_pressure", answer.pressure, false);
            add("peak_shear", answer.shear, false);
          }
        const std::string body = of_rail ? "of the rail's" : "of the wheel's";
        for (const auto &[where, peak] : {std::pair(" surface", answer.surface.peak), {" cells", highest}})
          lines += line_of_stress("largest von Mises stress " + body + where, peak.value, peak.x, peak.y,
                                  peak.depth);
        folder.write_peaks(of_rail ? "peak_stress.csv" : "peak_stress_wheel.csv", answer);
      }
    if (still_grows)
      warnings.push_back(
        "a largest stress of the region of 'Peak stress' is that of the last instant of the run, and "
        "grew until then: roll farther");
    return lines;
  }


  std::string Simulation::slow_step() const
  {
    constexpr double much   = 3.;
    const double     slower = dynamics.slowed_by_supports();
    return slower > much ? format("the cells would allow a time step %.3g times as long: springs, dampers or "
                                  "masses in section 'Track' are far from those of a track",
                                  slower)
                         : "";
  }


  std::string Simulation::unseen_detail() const
  {
    // Waves of two cells' length and amplitude A, pressed flat, take a pressure of pi E* A / (2 cells)
    // (Westergaard 1939; Johnson 1985, section 13.2). A kink of curvature between the arcs of a standard head
    // makes a few per cent of Hertz's.
    constexpr double large  = 0.1;
    const double     detail = scene.detail_within_cells(), load = scene.static_load();
    if (!(detail > 0. && load > 0.))
      return "";
    const reference::RollingCase touching = half_space_case(scene, load, 0.);
    const double                 modulus  = reference::combine(touching.wheel, touching.rail).hertz_modulus(),
                 share                    = dealii::numbers::PI * modulus * std::sqrt(2.) * detail /
                         (2. * scene.mesh.finest_cell * hertz(touching).max_pressure);
    if (!(share > large))
      return "";
    return format(
      "the profiles of wheel and rail have detail of %.2g um within a finest cell, which a pressure of %.0f "
      "%% "
      "of Hertz's presses flat (above %g %%): the cells do not see the surface that half-space theory does; "
      "smooth the measured profile, or use smaller cells",
      1e6 * detail, 100. * share, 100. * large);
  }


  std::vector<std::string> Simulation::doubts_at_start() const
  {
    std::vector<std::string> doubts = MeasuredProfiles(scene).warnings(false);
    for (const std::string &doubt : scene.doubts())
      doubts.push_back(doubt);
    for (const std::string &doubt : {unseen_detail(), slow_step()})
      if (!doubt.empty())
        doubts.push_back(doubt);
    return doubts;
  }


  void Simulation::add_doubts(std::vector<std::string> &warnings) const
  {
    for (const std::string &doubt : doubts_at_start())
      warnings.push_back(doubt);
    // What the torque aims at comes when the wheel has gathered the creepage for it.
    constexpr double far_from_aim = 0.05; // of it
    if (scene.motion.drive == Drive::torque && !scene.has_impacts())
      for (const RollingWheel &wheel : wheels)
        {
          const Vector3 force = last_force_on(wheel);
          const double  aim = scene.traction_coefficient(wheel.number), found = force[0] / force[2];
          if (force[2] > 0. && std::abs(found - aim) > far_from_aim * std::abs(aim))
            warnings.push_back(
              format("the drive aims at a traction coefficient of %.3g and has reached %.3g: a "
                     "longer 'Motion/Rolled distance (mm)' lets the wheel gather its creepage",
                     aim, found));
        }
    constexpr double far_from_load = 0.005; // of it
    if (const double normal_force = last_force_on(wheels.front())[2]; !scene.has_impacts())
      if (const double load = (scene.is_positioned() ? scene.wheelset.n_wheels() : 1) * scene.static_load();
          std::abs(normal_force - load) > far_from_load * load)
        warnings.push_back(
          normal_force > 0.
            ? format("the contact carries %.2f kN of a load of %.2f kN: the wheel is not in equilibrium; a "
                     "lower 'Start/Tolerance', a longer way, or steel that hardens more",
                     1e-3 * normal_force, 1e-3 * load)
            : format("at the end nothing presses the wheel on the rail, of a load of %.2f kN: it has left it",
                     1e-3 * load));
    if (const double averaged = position() - went_on_at; averaged < last_way)
      warnings.push_back(
        format("means over the last %.0f mm are those over %.2f mm, since the run went on: roll at "
               "least %.0f mm more",
               1e3 * last_way, 1e3 * averaged, 1e3 * last_way));
    // The patch at the end is compared as one on the finest cells.
    const double semi_axis = hertz(scene, scene.static_load()).semi_axis_x;
    if (const Scene::Range patch{scene.path_end() - semi_axis, scene.path_end() + semi_axis};
        !scene.has_impacts() && !scene.is_finest(patch.begin, patch.end))
      warnings.push_back(
        format("the patch at the end, from %.4g to %.4g mm, lies outside the cubes of 'Mesh/Fine from (mm)' "
               "to 'Fine to (mm)', from %.4g to %.4g mm: its figures are those of longer cells",
               1e3 * patch.begin, 1e3 * patch.end, 1e3 * scene.cubes().begin, 1e3 * scene.cubes().end));
    const bool varies =
      scene.contact.friction_varies(scene.path_end() - 2. * last_way, scene.path_end() + last_way);
    if (const double share = ripple.share(); share > large_ripple && !scene.has_impacts() && !varies)
      warnings.push_back(
        format(
          "the tangential force swings by %.1f %% of the normal force (above %g %%): rolling is not steady",
          100. * share, 100. * large_ripple) +
        (scene.friction_law()->is_constant() ? ""
                                             : "; friction that falls with slip makes it oscillate by itself "
                                               "where 'Contact/Friction memory (mm)' is "
                                               "too short"));
  }


  void Simulation::finish(RunFolder &folder, const End end)
  {
    const bool          completed     = end == End::complete;
    const EnergyLedger  energy        = dynamics.ledger();
    const RollingWheel &wheel         = wheels.front();
    const auto          patches       = solution_patches();
    const bool          averaged      = wheel.average.n_steps() > 0;
    const Vector3       force         = last_force_on(wheel);
    const double        normal        = force[2]; // 0 while the wheel is in the air
    const double        normal_ripple = last_steps > 0 ? wheel.ripple(normal) : 0.;
    const double        traction      = normal > 0. ? force[0] / normal : 0.;

    Summary             summary;
    const ContactAnswer answer{force, wheel.creepage(scene), wheel.averaged_measures(patches.front())};
    std::string         by_patch;
    if (scene.is_positioned())
      by_patch = add_wheelset(summary, completed);
    else
      {
        summarise(summary, scene, "explicit finite elements", answer, completed);
        summary.show("free_rolling_creepage", "  counted from free rolling at", 1e3, wheel.free_creepage,
                     "creepage, 1e-3");
      }
    summary.set("normal_force_ripple_share", normal_ripple);
    summary.set("tangential_force_ripple_share", ripple.share());

    std::string            note;
    std::vector<PatchNode> reference_patch;
    if (scene.is_positioned())
      {
        if (no_half_space.empty())
          reference_patch = placed().table_nodes();
        if (const std::string varies = friction_varies_at_end(normal / scene.wheelset.n_wheels());
            !varies.empty())
          note = "the half-space beside is in steady rolling, but " + varies;
      }
    else if (completed || !scene.rolls_smoothly())
      note = compare_with_steady_rolling(summary, answer, reference_patch);
    if (!note.empty())
      summary.set("note", note);

    summary.set("assumptions", scene.assumptions(starts_with_tractions));
    summary.set("unused_parameters", scene.unused_parameters());
    Quality quality;
    quality.energy = energy;
    quality.limits = scene.watchdogs.warn;
    if (averaged)
      quality.slip_chatter = wheel.average.slip_chatter();
    quality.contact_unconverged =
      dynamics.state.n_steps > 0 ? double(contact.n_unconverged_steps()) / dynamics.state.n_steps : 0.;
    quality.add_to(summary);
    if (scene.mesh.window)
      {
        summary.set("windows", window.number + 1);
        summary.set("window_loss_J", energy.window);
      }
    if (scene.has_impacts())
      impacts.add_to(summary, scene.static_load());
    const Rolled      rolled         = add_size(summary, normal);
    const std::string further_wheels = add_further_wheels(summary, patches);
    add_cost(summary);
    std::vector<std::string> warnings = quality.warnings();
    if (!no_half_space.empty())
      warnings.push_back(
        "no half-space answer where the wheelset has arrived, and positions, angles and creepages of "
        "'patches' are those of the start: " +
        no_half_space);
    if (scene.is_positioned())
      for (const std::string &warning : climbing_patches(placed().surfaces, placed().patches()))
        warnings.push_back(warning);
    if (completed)
      add_doubts(warnings);
    if (completed && scene.rolls_smoothly() && !rolled.long_enough())
      warnings.push_back(
        format("only %.1f patch lengths rolled since the %s: steady rolling takes %g or more",
               rolled.patch_lengths, torque_released ? "torque acts" : "start", rolled.lengths_to_be_steady));
    constexpr double large_loss = 0.02;
    if (const double loss = energy.of_dissipated(energy.window); std::abs(loss) > large_loss)
      warnings.push_back(
        format("the changes of the window of fine cells %s %.1f %% of what was dissipated: a larger "
               "'Mesh/Window margin (mm)' or 'Window length (mm)', or 'Scene/Density scale' 1",
               loss > 0. ? "took" : "gave", 100. * std::abs(loss)));
    add_damage(summary, folder, warnings);
    const std::string stresses       = add_recorded(summary, folder) + add_peaks(summary, folder, warnings);
    const std::string grown          = add_growth(summary, warnings);
    const std::string plastic_strain = add_plastic_strain(
      summary, dynamics, wheels.front().body,
      [&](const dealii::Point<3> &place) { return scene.depth_in_rail(place); }, comm);
    MeasuredProfiles(scene).summarise(summary);
    summary.set("warnings", warnings);
    summary.set("history_crc32", folder.history_checksum());
    if (averaged)
      for (const RollingWheel &of_table : wheels)
        folder.write_patch(RunFolder::table_of_wheel("patch_averaged", of_table.number),
                           of_table.average.nodes());
    if (!reference_patch.empty())
      folder.write_patch("reference_patch.csv", reference_patch);
    std::vector<std::pair<std::string, std::string>> parameters;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      for (const Scene::Parameter &parameter : Scene::parameters_in(folder.path("parameters.prm")))
        parameters.emplace_back(parameter.path, parameter.value);
    folder.write_hdf5(summary.text(), parameters);
    // Last but for the pictures, which are there: it says that the run is complete.
    folder.write("summary.json", summary.text());
    if (completed && !scene.motion.may_go_on()) // pictures that may follow have files of their own
      folder.join_pictures();

    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      {
        if (scene.has_impacts())
          std::printf("\n%s%s", impacts.lines(scene.static_load()).c_str(), stresses.c_str());
        // Where nothing is steady, the figures of one instant say little.
        if (scene.rolls_smoothly())
          std::printf("\n%s force %.2f kN (ripple %.2f %%), traction coefficient %.4f\n\n%s%s",
                      scene.is_positioned() ? "vertical" : "normal", 1e-3 * normal, 100. * normal_ripple,
                      traction, by_patch.c_str(), summary.table().c_str());
        std::printf("\n%s%s%s%s%s%s", further_wheels.c_str(), plastic_strain.c_str(), grown.c_str(),
                    quality.lines().c_str(), note.c_str(), note.empty() ? "" : "\n");
        for (const std::string &warning : warnings)
          std::printf("WARNING: %s\n", warning.c_str());
        const std::string pictures =
          (scene.output.write_volume ? folder.list_of_pictures("volume") + ", " : "") +
          folder.list_of_pictures("surface");
        std::printf("%s in %.1f s. Results in %s: summary.json, history.csv, run.h5%s%s\n",
                    completed                 ? "finished"
                    : end == End::interrupted ? "INTERRUPTED: stopped"
                                              : "STOPPED",
                    wall_seconds, folder.path("").c_str(),
                    solution_taken ? (", patch.csv; for ParaView: " + pictures).c_str() : "",
                    end == End::interrupted ? "; go on with --resume" : "");
      }
  }
} // namespace tread
