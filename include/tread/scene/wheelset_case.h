// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_wheelset_case_h
#define tread_scene_wheelset_case_h

#include <tread/analysis/wheelset_contact.h>
#include <tread/scene/scene.h>

namespace tread
{
  /// How the wheel of a scene rolls, as half-space theory sees it. @pre scene.is_positioned()
  /// @param x of the wheelset on the rail (m), where friction changes along it
  WheelRolling wheel_rolling(const Scene &scene, const double x);

  /// About the axle, counted from free rolling, rad/s. @pre as above
  double given_angular_velocity(const Scene &scene);
} // namespace tread

#endif
