// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_start_h
#define tread_scene_sections_start_h

#include <tread/base/section.h>

namespace tread
{
  enum class StartTractions
  {
    none,
    predicted
  };

  template <>
  const std::vector<Choice<StartTractions>> &choices();

  /// Section `Start`.
  struct StartSection
  {
    StartTractions tractions      = StartTractions::predicted;
    double         tolerance      = 1e-5; ///< of the force balance, share of the largest force
    unsigned int   max_iterations = 20000;

    void declare(ParameterTable &table);
  };
} // namespace tread

#endif
