// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_fatigue_h
#define tread_reference_fatigue_h

namespace tread::reference
{
  /// Surface fatigue index: how far the friction used lies above what the shakedown map of an elliptic patch
  /// allows for its load, beyond 0 the surface is expected to ratchet (Ekberg, Kabo and Andersson 2002, with
  /// the boundary of Johnson 1989 for friction that is large and a patch that slides).
  /// @param friction_used tangential over normal force [-]; @param area pi a b of the semi-axes, m^2; @param
  /// shear_strength yield stress in shear, Pa; @param normal_force N
  inline double surface_fatigue_index(const double friction_used,
                                      const double area,
                                      const double shear_strength,
                                      const double normal_force)
  {
    return friction_used - 2. * area * shear_strength / (3. * normal_force);
  }
} // namespace tread::reference

#endif
