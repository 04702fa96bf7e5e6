// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_uneven_way_h
#define tread_reference_uneven_way_h

#include <tread/reference/planar_contact.h>

#include <vector>

namespace tread::reference
{
  /// Rolling over a rail whose height changes along the way and is alike across, with a load and a creepage
  /// that change as well (Kalker 1990, section 5.2.2.5, with the normal problem solved anew in each step).
  /// Inertia plays no part. The wheel moves by one element in each step, whose number is that of the element
  /// of the way under the wheel.
  struct UnevenWay
  {
    /// Bodies, friction, undeformed gap over a rail without heights, and grid, in which an element has its
    /// centre at x = 0. Its load and its longitudinal creepage are not used.
    PlanarCase          contact;
    std::vector<double> heights; ///< of the elements along the way [m]; before and behind it as at its ends
    std::vector<double> normal_force; ///< in each step [N], > 0
    std::vector<double> longitudinal; ///< creepage xi in each step [-]; negative for a driving wheel
  };

  struct UnevenResult
  {
    std::vector<double> approach;           ///< in each step, beyond what gap and heights have [m]
    std::vector<double> longitudinal_force; ///< in each step, on the wheel [N]
    /// Work of friction per area of the rail, n_y rows of the elements along the way [J/m^2]. Elements at
    /// both ends, over which not all of the patch has passed, have less.
    std::vector<double> work;
  };

  /// The first step is that of steady rolling with its heights, load and creepage.
  /// Errors: std::invalid_argument for vectors of unlike lengths, unlike bodies, no friction or friction
  /// other than Coulomb's, forces <= 0, numbers that are none; others as solve_planar().
  UnevenResult roll_over(const UnevenWay &way);
} // namespace tread::reference

#endif
