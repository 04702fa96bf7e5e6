// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_fastsim_h
#define tread_reference_fastsim_h

#include <tread/reference/kalker.h>

namespace tread::reference
{
  /// How FASTSIM bounds the shear.
  enum class FastsimPressure
  {
    paraboloid, ///< 2 N/(pi a b) (1 - x^2/a^2 - y^2/b^2): the original, best forces
    ellipsoid   ///< Hertz's pressure
  };

  /// FASTSIM (Kalker 1982): u = L p with flexibilities L1 = 8 a/(3 C11 G), L2 = 8 a/(3 C22 G),
  /// L3 = pi a sqrt(a/b)/(4 C23 G) for longitudinal, lateral creepage and spin. Strips are integrated from
  /// the leading to the trailing edge.
  /// @param n_strips   strips across the patch, >= 3
  /// @param n_elements elements along each strip, >= 3
  CreepForce fastsim(const CreepPatch &patch,
                     const Creepage   &creepage,
                     unsigned int      n_strips   = 50,
                     unsigned int      n_elements = 50,
                     FastsimPressure   pressure   = FastsimPressure::paraboloid);
} // namespace tread::reference

#endif
