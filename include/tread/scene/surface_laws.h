// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_surface_laws_h
#define tread_scene_surface_laws_h

#include <tread/scene/scene.h>

#include <memory>

namespace tread
{
  /// The law of friction that the scene names, with its parameters. @throws InputError
  std::shared_ptr<const FrictionLaw> friction_law(const Scene &scene);

  /// Factor of the friction coefficient across the rail over the patch of the static load by half-space
  /// theory, weighted with its pressure: what friction carries over what it would with a factor of 1.
  /// @pre scene.contact.varies_across()
  double mean_factor_across(const Scene &scene);

  /// Yield stress of the rail in shear, Pa; 0: not known.
  double shear_strength(const Scene &scene);

  /// Indices of damage with their parameters, in the order of damage_indices(). @throws InputError
  DamageIndices indices_of_damage(const Scene &scene);

  /// What surfaces lose, with its parameters; null: nothing.
  std::shared_ptr<const WearLaw> wear_law(const Scene &scene);
} // namespace tread

#endif
