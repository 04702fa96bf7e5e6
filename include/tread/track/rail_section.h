// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_track_rail_section_h
#define tread_track_rail_section_h

#include <array>
#include <vector>

namespace tread
{
  /// A cross-section made of quadrilaterals, as a beam sees it: axes y across and z upwards.
  struct RailSectionProperties
  {
    double area = 0.;              ///< m^2
    double y = 0., z = 0.;         ///< of the centroid, m
    double about_y           = 0.; ///< second moment of area of vertical bending, m^4
    double about_z           = 0.; ///< of lateral bending, m^4
    double shear_coefficient = 0;  ///< kappa of a vertical shear force
  };

  /// @param quadrilaterals corners (y, z), m, around each of them in either sense. They fit at their edges.
  /// The shear coefficient is that of the energy of the shear stresses of Saint-Venant's flexure without
  /// Poisson's ratio, which changes it by per cents (Love 1927, 229 to 233; 5/6 for a rectangle), by
  /// bilinear finite elements. @throws std::invalid_argument if there are none
  RailSectionProperties rail_section_properties(
    const std::vector<std::array<std::array<double, 2>, 4>> &quadrilaterals);
} // namespace tread

#endif
