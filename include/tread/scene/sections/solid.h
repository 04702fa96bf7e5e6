// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_solid_h
#define tread_scene_sections_solid_h

#include <tread/base/section.h>
#include <tread/dynamics/dynamics_parameters.h>
#include <tread/solid/element.h>

namespace tread
{
  /// Section `Solid`.
  struct SolidSection : ElementParameters
  {
    double stiffness_damping = DynamicsParameters().damping_steps; ///< time steps
    double mass_damping      = DynamicsParameters().mass_damping;  ///< 1/s

    void declare(ParameterTable &table);
    /// @throws InputError
    void check() const;
  };
} // namespace tread

#endif
