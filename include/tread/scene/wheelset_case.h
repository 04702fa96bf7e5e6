// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_wheelset_case_h
#define tread_scene_wheelset_case_h

#include <tread/analysis/wheelset_contact.h>
#include <tread/scene/scene.h>

namespace tread
{
  /// How the wheel of a scene rolls, as half-space theory sees it. @pre scene.is_positioned()
  WheelRolling wheel_rolling(const Scene &scene);
} // namespace tread

#endif
