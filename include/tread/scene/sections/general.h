// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_general_h
#define tread_scene_sections_general_h

#include <tread/base/section.h>

namespace tread
{
  /// Section `Scene`: what holds for all of it.
  struct GeneralSection
  {
    std::string title;
    bool        quasi_static  = true;
    double      density_scale = 1.; ///< factor on the density of the cells
    bool        reproducible  = false;

    void declare(ParameterTable &table);
    void check() const;
  };
} // namespace tread

#endif
