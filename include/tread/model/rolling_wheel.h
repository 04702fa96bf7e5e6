// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_model_rolling_wheel_h
#define tread_model_rolling_wheel_h

#include <tread/analysis/wheelset_contact.h>
#include <tread/base/archive.h>
#include <tread/scene/half_space_case.h>
#include <tread/scene/scene.h>
#include <tread/track/wheel_hub.h>

namespace tread
{
  /// One wheel on its way over the rail: its body and hub, and how it is driven.
  class RollingWheel
  {
  public:
    /// @param number of the wheel in the scene; 0 runs ahead of the others.
    RollingWheel(const Scene &scene, const unsigned int number);

    /// Put the wheel where its path begins, at rest but for its nominal angular velocity.
    void place(const Scene &scene);

    /// Angular velocity x rolling radius over speed, - 1, counted from free rolling.
    double creepage(const Scene &scene) const;

    /// Where the wheelset stands in the track at present. @pre scene.is_positioned()
    WheelsetPosition position(const Scene &scene) const;
    /// How the wheelset turns and moves across the track at present. @pre scene.is_positioned()
    WheelsetRates rates(const Scene &scene) const;

    /// Store or restore all but the hub, which belongs to the dynamics.
    void serialize(Archive &archive);

    unsigned int number, body;
    WheelHub     hub;
    double       target_creepage = 0., free_creepage = 0.;
  };
} // namespace tread

#endif
