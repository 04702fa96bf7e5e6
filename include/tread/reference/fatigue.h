// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_fatigue_h
#define tread_reference_fatigue_h

namespace tread::reference
{
  /// Surface fatigue index: how far the friction used lies above what the shakedown map allows at the largest
  /// pressure, beyond 0 the surface is expected to ratchet (Ekberg, Kabo and Andersson 2002, who write k/p0
  /// as 2 pi a b k / (3 N) for Hertz's ellipse, with the boundary of Johnson 1989 for friction that is large
  /// and a patch that slides).
  /// @param friction_used tangential over normal force [-]; @param max_pressure p0, Pa; @param shear_strength
  /// k, yield stress in shear, Pa
  inline double surface_fatigue_index(const double friction_used,
                                      const double max_pressure,
                                      const double shear_strength)
  {
    return friction_used - shear_strength / max_pressure;
  }
} // namespace tread::reference

#endif
