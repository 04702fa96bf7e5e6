// SPDX-License-Identifier: LGPL-2.1-or-later
// What of a run is numerical and no physics of its scene.
#include <tread/base/format.h>
#include <tread/reference/hertz.h>
#include <tread/scene/assumptions.h>
#include <tread/scene/checks.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/surface_laws.h>
#include <tread/solid/element.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  bool is_about_defect(const Scene &scene)
  {
    return scene.shapes().defect || scene.defect.length > 0.;
  }


  bool settles(const Scene &scene)
  {
    return scene.general.quasi_static && !is_about_defect(scene) && scene.shapes().is_round() &&
           !scene.shapes().has_uneven_mesh() && scene.track.foundation == Foundation::rigid;
  }


  std::vector<std::string> assumptions(const Scene &scene, const bool has_tractions)
  {
    std::vector<std::string> list;
    const double             scale = scene.general.density_scale, mass_damping = scene.solid.mass_damping;
    if (scale > 1.)
      list.push_back("density of the cells times " + text_of(scale) +
                     ": for steady rolling only, with an inertia error of about " +
                     text_of(std::round(1e4 * inertia_error_estimate(scene)) / 100.) + " %");
    if (scene.mesh.window == WindowUse::automatic && has_window(scene))
      list.push_back(
        format("cells are fine about the wheel alone, in %u windows one after the other ('Mesh/Window' "
               "false: along the whole path)",
               static_cast<unsigned int>(windows(scene).size())));
    if (scene.time_stepping.least_step > 0.)
      list.push_back("mass added to cells that would need steps below " +
                     text_of(1e6 * scene.time_stepping.least_step) +
                     " us: above some kHz the contact force is not the true one");
    if (mass_damping > 0.)
      list.push_back("mass damping of " + text_of(mass_damping) +
                     " per s: motion of the cells on top of the rigid bodies' fades by half in " +
                     text_of(std::round(1e5 * 2. * std::log(2.) / mass_damping) / 100.) + " ms");
    if (settles(scene))
      list.push_back("the axle rises and sinks until contact carries the load, within about the length of a "
                     "patch: the mass of the wheel is a load only");
    if (scene.guidance.kind != Guidance::rigid && (scale > 1. || mass_damping > 0.))
      list.push_back(
        "a wheelset that moves across its track has the inertia of the scaled, or damped, cells: "
        "for motion that is slow beside its vibration on the contact only");
    if (scene.motion.drive == Drive::torque && (scale > 1. || mass_damping > 0.))
      list.push_back(
        "the way from the torque's onset to steady rolling is that of the scaled or damped cells, "
        "not the true one");
    if (has_tractions)
      list.push_back("the start has the tractions that half-space theory predicts for steady rolling");
    else
      list.push_back(std::string("the start has no tractions") +
                     (scene.start.tractions == StartTractions::predicted
                        ? ", which half-space theory cannot predict"
                        : "") +
                     "; they build up while rolling");
    if (const auto law = friction_law(scene); !law->is_constant() && law->memory().distance == 0.)
      list.push_back(
        "friction follows the slip speed at once: where pressure times the fall of the coefficient "
        "with slip is above half the shear impedance of the steel, slip oscillates by itself "
        "('Contact/Friction memory (mm)' prevents it)");
    if (has_narrow_head(scene))
      list.push_back(
        "the head was measured up to " + text_in_mm(scene.shapes().surfaces.half_width) +
        " mm beside its middle; beyond, it has the profile's shape, as far from it as where it ends");
    // Found on a rail head: 0.7 % at 2.9 semi-axes, 2.5 % at 1.7, 6 % at 1.2, 30 % at 0.4.
    constexpr double              thick   = 3.;
    const reference::HertzEllipse ellipse = scene.stance().ellipse(scene.static_load());
    if (const double axes = std::sqrt(ellipse.semi_axis_x * ellipse.semi_axis_y);
        !scene.wheel.is_full() && scene.wheel.sector_thickness < thick * axes)
      list.push_back(
        format("the sector is %.1f mean semi-axes of the patch thick: below %g its rigid back raises the "
               "pressure",
               scene.wheel.sector_thickness / axes, thick));
    constexpr double soft_hourglass = 0.5, stiff_hourglass = 2.; // doc/verification.md, section 2.4
    if (element_named(scene.solid.element).has_hourglass_modes &&
        (scene.solid.hourglass_coefficient < soft_hourglass ||
         scene.solid.hourglass_coefficient > stiff_hourglass))
      list.push_back(format("'Solid/Hourglass coefficient' %g, of which %g to %g is examined: pressure, "
                            "creepage and slip are off by some per cent",
                            scene.solid.hourglass_coefficient, soft_hourglass, stiff_hourglass));
    if (scene.solid.stiffness_damping == 0.)
      list.push_back("no stiffness damping: micro-slip may chatter at the frequency of the cells");
    return list;
  }


  double inertia_error_estimate(const Scene &scene)
  {
    // Speed of Rayleigh waves (Viktorov 1967), the slower body's.
    const auto rayleigh = [](const ElasticMaterial &material) {
      const double nu = material.poisson_ratio;
      return material.shear_wave_speed() * (0.87 + 1.12 * nu) / (1. + nu);
    };
    const double slower =
      std::min(rayleigh(scene.rail.material.elastic()), rayleigh(scene.wheel.material.elastic()));
    return scene.general.density_scale * scene.motion.speed * scene.motion.speed / (slower * slower);
  }


  std::vector<std::string> assumptions(const Scene &scene)
  {
    return assumptions(scene, scene.start.tractions == StartTractions::predicted);
  }
} // namespace tread
