// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_checks_h
#define tread_scene_checks_h

#include <tread/scene/scene.h>

#include <string>

namespace tread
{
  // What of a scene does not make sense. All throw InputError, one line that names the parameters.

  /// All checks of a scene. @param use what is wanted of it
  void check_sections(const Scene &scene, const SceneUse use);

  // By topic.

  void check_motion(const Scene &scene);
  void check_peak_stress(const Scene &scene);
  void check_window(const Scene &scene);
  void check_plasticity(const Scene &scene);
  void check_ratcheting(const Scene &scene);
  void check_numerics(const Scene &scene);
  void check_friction_by_temperature(const Scene &scene);
  void check_track(const Scene &scene);
  /// That the rail goes on beyond the path.
  void check_rail_ends(const Scene &scene);
  /// Where it begins and ends, and that cells can show it; not how far it reaches across.
  void check_defect(const Scene &scene);
  /// @pre scene.is_positioned()
  void check_wheelset(const Scene &scene);
  /// What finite elements need beyond the half-space's answer. @pre scene.is_positioned()
  void check_placed_mesh(const Scene &scene);
  /// Of a rail from a mesh file.
  void check_mesh_rail(const Scene &scene);

  // What other checks say of them.

  /// Whether the measured head ends, at one side, before what is searched for contact.
  bool has_narrow_head(const Scene &scene);
  /// The change of the running surface of a rail from a mesh file, for messages.
  std::string uneven_in_words(const Scene &scene);
  /// Of a law of friction that falls with slip: a memory that is too short to keep slip from oscillating by
  /// itself, one line; empty: none.
  std::string short_memory(const Scene &scene);
} // namespace tread

#endif
