// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_watchdogs_h
#define tread_scene_sections_watchdogs_h

#include <tread/base/section.h>
#include <tread/dynamics/dynamics_parameters.h>
#include <tread/output/quality.h>

namespace tread
{
  /// Section `Watchdogs`: from where on a run is warned of at its end, and from where on it is stopped.
  struct WatchdogSection
  {
    QualityLimits warn;
    MotionLimits  stop_at;
    double        stop_at_residual = 0.5; ///< of what is dissipated or, if that is more, stored as strain

    void declare(ParameterTable &table);
  };
} // namespace tread

#endif
