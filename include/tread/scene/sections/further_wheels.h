// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_further_wheels_h
#define tread_scene_sections_further_wheels_h

#include <tread/base/section.h>

#include <vector>

namespace tread
{
  /// Section `Further wheels`: those that follow the first one on the same rail. SI units.
  struct FurtherWheelsSection
  {
    std::vector<double> distances;             ///< from the first wheel's axle backwards
    std::vector<double> traction_coefficients; ///< none: as the first wheel's

    void declare(ParameterTable &table);
    /// @param least_distance between two axles, m. @throws InputError
    void check(double least_distance) const;
  };
} // namespace tread

#endif
