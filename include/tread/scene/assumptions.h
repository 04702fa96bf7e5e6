// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_assumptions_h
#define tread_scene_assumptions_h

#include <tread/scene/scene.h>

#include <string>
#include <vector>

namespace tread
{
  /// Rolling speed over the speed of Rayleigh waves in the scaled material, squared: the order of
  /// the relative error that the inertia of rolling makes in a quasi-static scene.
  double inertia_error_estimate(const Scene &scene);

  /// Whether there is a defect, or the scene is the smooth twin of one with it: a twin keeps its length, and
  /// has the same cells and inertia.
  bool is_about_defect(const Scene &scene);

  /// Whether the axle follows the load of its wheels without the inertia of their mass: steady rolling.
  bool settles(const Scene &scene);

  /// Numerical assumptions that are not part of the physics of the scene (scaled density, mass damping,
  /// predicted start), one line each. @param has_tractions at the start: those that were predicted are laid
  /// on
  std::vector<std::string> assumptions(const Scene &scene, const bool has_tractions);
  /// The same before the start, as the scene wants it.
  std::vector<std::string> assumptions(const Scene &scene);
} // namespace tread

#endif
