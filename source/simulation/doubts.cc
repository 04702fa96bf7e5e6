// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/scene/doubts.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/measured_profiles.h>
#include <tread/scene/surface_laws.h>
#include <tread/simulation/doubts.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace tread
{
  namespace
  {
    /// Amplitude of the tangential over the normal force from which a run is not called steady. Waves of the
    /// cells make up to a hundredth.
    constexpr double large_ripple = 0.03;

    /// A line if springs, dampers and masses make the time step much shorter than the cells do; else none.
    std::string slow_step(const ExplicitDynamics &dynamics)
    {
      constexpr double much   = 3.;
      const double     slower = dynamics.critical_step().slowed_by_supports();
      return slower > much
               ? format("the cells would allow a time step %.3g times as long: springs, dampers or "
                        "masses in section 'Track' are far from those of a track",
                        slower)
               : "";
    }
  } // namespace


  std::string unseen_detail(const Scene &scene)
  {
    // Waves of two cells' length and amplitude A, pressed flat, take a pressure of pi E* A / (2 cells)
    // (Westergaard 1939; Johnson 1985, section 13.2). A kink of curvature between the arcs of a standard head
    // makes a few per cent of Hertz's.
    constexpr double large  = 0.1;
    const double     detail = detail_within_cells(scene), load = scene.static_load();
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


  std::vector<std::string> doubts_at_start(const Model &model)
  {
    std::vector<std::string> list = MeasuredProfiles(model.scene).warnings(false);
    for (const std::string &doubt : doubts(model.scene))
      list.push_back(doubt);
    for (const std::string &doubt : {unseen_detail(model.scene), slow_step(model.dynamics)})
      if (!doubt.empty())
        list.push_back(doubt);
    return list;
  }


  std::vector<std::string> doubts_at_end(const Model    &model,
                                         const EndOfWay &end_of_way,
                                         const double    averaged)
  {
    const Scene             &scene = model.scene;
    std::vector<std::string> warnings;
    // What the torque aims at comes when the wheel has gathered the creepage for it.
    constexpr double far_from_aim = 0.05; // of it
    if (scene.motion.drive == Drive::torque && !scene.has_impacts())
      for (const RollingWheel &wheel : model.wheels)
        {
          const Vector3 force = end_of_way.force_on(wheel);
          const double  aim = scene.traction_coefficient(wheel.number), found = force[0] / force[2];
          if (force[2] > 0. && std::abs(found - aim) > far_from_aim * std::abs(aim))
            warnings.push_back(
              format("the drive aims at a traction coefficient of %.3g and has reached %.3g: a "
                     "longer 'Motion/Rolled distance (mm)' lets the wheel gather its creepage",
                     aim, found));
        }
    constexpr double far_from_load = 0.005; // of it
    if (const double normal_force = end_of_way.force_on(model.wheels.front())[2]; !scene.has_impacts())
      if (const double load = scene.stance().n_loads() * scene.static_load();
          std::abs(normal_force - load) > far_from_load * load)
        warnings.push_back(
          normal_force > 0.
            ? format("the contact carries %.2f kN of a load of %.2f kN: the wheel is not in equilibrium; a "
                     "lower 'Start/Tolerance', a longer way, or steel that hardens more",
                     1e-3 * normal_force, 1e-3 * load)
            : format("at the end nothing presses the wheel on the rail, of a load of %.2f kN: it has left it",
                     1e-3 * load));
    if (averaged < EndOfWay::length)
      warnings.push_back(
        format("means over the last %.0f mm are those over %.2f mm, since the run went on: roll at "
               "least %.0f mm more",
               1e3 * EndOfWay::length, 1e3 * averaged, 1e3 * EndOfWay::length));
    // The patch at the end is compared as one on the finest cells.
    const double semi_axis = scene.stance().ellipse(scene.static_load()).semi_axis_x;
    if (const Scene::Range patch{scene.path_end() - semi_axis, scene.path_end() + semi_axis};
        !scene.has_impacts() && !is_finest(scene, patch.begin, patch.end))
      warnings.push_back(
        format("the patch at the end, from %.4g to %.4g mm, lies outside the cubes of 'Mesh/Fine from (mm)' "
               "to 'Fine to (mm)', from %.4g to %.4g mm: its figures are those of longer cells",
               1e3 * patch.begin, 1e3 * patch.end, 1e3 * cubes(scene).begin, 1e3 * cubes(scene).end));
    const bool varies = scene.contact.friction_varies(scene.path_end() - 2. * EndOfWay::length,
                                                      scene.path_end() + EndOfWay::length);
    if (const double share = end_of_way.ripple().share();
        share > large_ripple && !scene.has_impacts() && !varies)
      warnings.push_back(
        format(
          "the tangential force swings by %.1f %% of the normal force (above %g %%): rolling is not steady",
          100. * share, 100. * large_ripple) +
        (friction_law(scene)->is_constant() ? ""
                                            : "; friction that falls with slip makes it oscillate by itself "
                                              "where 'Contact/Friction memory (mm)' is "
                                              "too short"));
    return warnings;
  }
} // namespace tread
