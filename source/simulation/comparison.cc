// SPDX-License-Identifier: LGPL-2.1-or-later
// What a run answers, beside half-space theory.
#include <tread/base/format.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/surface_laws.h>
#include <tread/scene/wheelset_summary.h>
#include <tread/simulation/comparison.h>

#include <cmath>
#include <exception>
#include <new>
#include <utility>

namespace tread
{
  namespace
  {
    /// Traction over the friction bound from which nearly the whole patch slips: in Carter's strip (1926),
    /// traction 1 - (1 - creepage)^2 of the bound, a tenth of the length adheres here, and the last hundredth
    /// of traction is a tenth of the creepage.
    constexpr double nearly_sliding = 0.99;


    /// Compare the answer with Kalker's solution for the forces that act. If (nearly) the whole patch slips,
    /// or friction depends on slip, the forces say little about the creepage, and the solution is that for
    /// the creepage. @returns the half-space patch.
    std::vector<PatchNode> compare_with_kalker(const Scene         &scene,
                                               Summary             &summary,
                                               const ContactAnswer &answer)
    {
      const double         normal = answer.force[2], traction = answer.force[0];
      const PatchMeasures &patch = answer.patch;
      // Forces in the contact's own plane: where it is inclined, that on the wheel has a part of the
      // pressure's.
      const bool all_slips = !(patch.adhesion_share > 0.) ||
                             std::hypot(patch.longitudinal_force, patch.lateral_force) >=
                               nearly_sliding * scene.contact.friction_coefficient *
                                 scene.contact.friction_factor(scene.path_end()) * patch.normal_force;
      // Where friction falls with slip, a force belongs to several creepages; where it depends on the
      // pressure, forces do not tell how near to sliding a patch is.
      const bool by_creepage = all_slips || !friction_law(scene)->is_constant() ||
                               !scene.contact.friction_pressures.empty() ||
                               !scene.contact.temperatures.empty() || scene.contact.varies_across();
      reference::RollingCase c = half_space_case(scene, normal, by_creepage ? 0. : traction / normal);
      c.prescribe_force        = !by_creepage;
      c.creepage               = -answer.creepage;
      require_half_space(scene);
      const reference::RollingEstimate half_space = reference::estimate_rolling(c);
      compare(summary, answer, half_space, c.prescribe_force);
      return patch_nodes(half_space.fields, scene.shapes().first_contact.y);
    }


    /// In words, that friction changes where a patch under this force (N) ends, or on the way there; or
    /// nothing.
    std::string friction_varies_at_end(const Scene &scene, const double normal_force)
    {
      const double half_length =
        scene.stance().ellipse(normal_force > 0. ? normal_force : scene.static_load()).semi_axis_x;
      return scene.contact.friction_varies(scene.path_end() - EndOfWay::length - half_length,
                                           scene.path_end() + half_length)
               ? format("'Contact/Friction factors' change in the patch at the end or on its last %g mm",
                        1e3 * EndOfWay::length)
               : "";
    }


    /// Why rolling does not become steady, or nothing.
    std::string nothing_steady(const Scene &scene)
    {
      if (scene.shapes().defect)
        return "no comparison with steady rolling: there is a defect on the rail";
      if (!scene.shapes().is_round())
        return "no comparison with steady rolling: the wheel is not round";
      if (scene.shapes().has_uneven_mesh())
        return "no comparison with steady rolling: the running surface of 'Rail/Mesh file' changes along the "
               "path";
      return "";
    }


    /// Compare with Kalker where half-space theory knows steady rolling. @param patch of the half-space;
    /// @returns why nothing is compared, or nothing
    std::string compare_with_steady_rolling(const Scene            &scene,
                                            Summary                &summary,
                                            const ContactAnswer    &answer,
                                            std::vector<PatchNode> &patch)
    {
      if (const std::string unsteady = nothing_steady(scene); !unsteady.empty())
        return unsteady;
      if (!(answer.force[2] > 0.))
        return "";
      if ((!scene.contact.friction_pressures.empty() || scene.contact.varies_across()) &&
          !friction_law(scene)->is_constant())
        return "no comparison with steady rolling: half-space theory has no answer for factors on the "
               "friction "
               "coefficient by pressure or across the rail with 'Contact/Friction law' " +
               scene.contact.friction_law;
      if (const std::string varies = friction_varies_at_end(scene, answer.force[2]); !varies.empty())
        return "no comparison with steady rolling: " + varies;
      try
        {
          patch = compare_with_kalker(scene, summary, answer);
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


    /// The patches of a wheelset in a given position in the half-space solver's terms: means while the wheel
    /// rolls over a cell.
    std::vector<WheelPatch> computed_patches(const RunAnswer &run)
    {
      std::vector<WheelPatch> patches = run.model.wheelset.placed().patches();
      for (unsigned int k = 0; k < patches.size(); ++k)
        {
          const PatchMeasures      m = run.solution.average_of_patch(k).measures();
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


    /// The first entries of the summary of a wheelset in a given position. @param has_half_space whether the
    /// half-space's stand beside them. @returns a table of its patches for the screen, and what the
    /// half-space cannot tell of them.
    std::string add_wheelset(const RunAnswer &run, Summary &summary, const bool has_half_space)
    {
      const Model        &model            = run.model;
      const Scene        &scene            = model.scene;
      const PlacedWheel  &half_space_wheel = model.wheelset.placed();
      const RollingWheel &wheel            = model.wheels.front();
      const Vector3       force            = run.end_of_way.force_on(wheel);
      WheelContact        computed;
      const Placement at = model.wheelset.has_moved() ? *model.wheelset.moved_to() : model.placement_now();
      computed.position  = at.position;
      computed.force     = {force[0], force[1], force[2]};
      computed.patches   = computed_patches(run);
      summarise_wheelset(summary, scene, "explicit finite elements", computed, at.rates.angular_velocity,
                         run.completed);
      summary.set("free_rolling_creepage", wheel.free_creepage);
      const double rail_y = half_space_wheel.surfaces.rail_origin_y();
      summary.set("patches", patches_as_json(computed.patches, rail_y, scene));
      if (!has_half_space)
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
      summary.compare("frictional_power_W", "frictional power, W", 1., frictional_power(computed),
                      "half-space", frictional_power(half_space_wheel.contact));
      summary.set("half_space_patches", patches_as_json(half_space_wheel.patches(), rail_y, scene));
      std::string text = table_of_patches(computed.patches, rail_y, half_space_wheel.patches()) + "\n";
      for (const std::string &limit : limits_of_half_space(half_space_wheel.patches()))
        text += "half-space: " + limit + "\n";
      return text;
    }
  } // namespace


  Compared compare_with_half_space(const RunAnswer &run, Summary &summary)
  {
    const Scene        &scene = run.model.scene;
    const RollingWheel &wheel = run.model.wheels.front();
    const Vector3       force = run.end_of_way.force_on(wheel);
    Compared            compared;
    if (scene.is_positioned())
      {
        compared.note             = nothing_steady(scene);
        const bool has_half_space = compared.note.empty() && run.model.wheelset.problem().empty();
        compared.by_patch         = add_wheelset(run, summary, has_half_space);
        if (has_half_space)
          compared.reference_patch = table_nodes(run.model.wheelset.placed());
        if (const std::string varies = friction_varies_at_end(scene, force[2] / scene.wheelset.n_wheels());
            has_half_space && !varies.empty())
          compared.note = "the half-space beside is in steady rolling, but " + varies;
        return compared;
      }
    const ContactAnswer answer{force, wheel.creepage(scene),
                               run.solution.measures(wheel, run.patches.front())};
    summarise(summary, scene, "explicit finite elements", answer, run.completed);
    summary.show("free_rolling_creepage", "  counted from free rolling at", 1e3, wheel.free_creepage,
                 "creepage, 1e-3");
    if (run.completed || !scene.shapes().are_smooth())
      compared.note = compare_with_steady_rolling(scene, summary, answer, compared.reference_patch);
    return compared;
  }


  std::string add_further_wheels(const RunAnswer &run, Summary &summary)
  {
    std::string lines;
    for (const RollingWheel &wheel : run.model.wheels)
      {
        if (wheel.number == 0)
          continue;
        const std::string   prefix   = "wheel_" + std::to_string(wheel.number + 1) + "_";
        const Vector3       force    = run.end_of_way.force_on(wheel);
        const PatchMeasures patch    = run.solution.measures(wheel, run.patches[wheel.number]);
        const double        traction = force[2] > 0. ? force[0] / force[2] : 0.;
        for (const auto &[name, value] :
             {std::pair("normal_force_N", force[2]), std::pair("longitudinal_force_N", force[0]),
              std::pair("lateral_force_N", force[1]), std::pair("traction_coefficient", traction),
              std::pair("creepage", wheel.creepage(run.model.scene)),
              std::pair("free_rolling_creepage", wheel.free_creepage),
              std::pair("max_pressure_Pa", patch.max_pressure), std::pair("patch_area_m2", patch.area),
              std::pair("adhesion_share", patch.adhesion_share),
              std::pair("max_slip_m_per_s", patch.max_slip),
              std::pair("frictional_power_W", patch.frictional_power)})
          summary.set(prefix + name, value);
        lines += format("wheel %u: normal force %.2f kN, traction coefficient %.4f, creepage %.4fe-3, "
                        "maximum pressure %.1f MPa, adhesion %.1f %%\n",
                        wheel.number + 1, 1e-3 * force[2], traction, 1e3 * wheel.creepage(run.model.scene),
                        1e-6 * patch.max_pressure, 100. * patch.adhesion_share);
      }
    return lines.empty() ? lines : lines + "\n";
  }
} // namespace tread
