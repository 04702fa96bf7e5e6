// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_peak_stress_h
#define tread_scene_sections_peak_stress_h

#include <tread/base/section.h>

namespace tread
{
  enum class PeakPlace
  {
    none,
    trailing_edge,
    range
  };

  template <>
  const std::vector<Choice<PeakPlace>> &choices();

  /// Section `Peak stress`: where the largest stresses are looked for in every step. Lengths in m.
  struct PeakStressSection
  {
    PeakPlace place = PeakPlace::none;
    double    from = 0., to = 0.; ///< x, of a range
    double    half_width = 0.;    ///< 0: that of the patch
    double    depth      = 6e-3;

    void declare(ParameterTable &table);
    bool is_wanted() const
    {
      return place != PeakPlace::none;
    }
  };
} // namespace tread

#endif
