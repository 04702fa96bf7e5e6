// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_guidance_h
#define tread_scene_sections_guidance_h

#include <tread/base/section.h>
#include <tread/track/wheel_hub.h>

namespace tread
{
  template <>
  const std::vector<Choice<Guidance>> &choices();

  /// Section `Guidance`. SI units.
  struct GuidanceSection
  {
    Guidance        kind = Guidance::rigid;
    std::string     file;
    GuidanceSprings springs;
    double          yaw_inertia = 0.;

    void declare(ParameterTable &table);
    /// @param has_both_wheels whether the wheelset rolls. @throws InputError
    void check(const bool has_both_wheels) const;
  };
} // namespace tread

#endif
