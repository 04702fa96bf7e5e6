// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_solid_h
#define tread_scene_sections_solid_h

#include <tread/base/section.h>
#include <tread/solid/solid.h>

namespace tread
{
  /// Section `Solid`.
  struct SolidSection
  {
    std::string element               = elements().front().name;
    double      hourglass_coefficient = 1.;
    bool        matched_surface       = true;
    double      surface_damping       = 0.5;
    double      stiffness_damping     = 0.1; ///< time steps
    double      mass_damping          = 0.;  ///< 1/s
    double      linear_bulk_viscosity = 0., quadratic_bulk_viscosity = 0.;

    bool has_bulk_viscosity() const
    {
      return linear_bulk_viscosity != 0. || quadratic_bulk_viscosity != 0.;
    }

    void declare(ParameterTable &table);
    /// @throws InputError
    void check() const;
  };
} // namespace tread

#endif
