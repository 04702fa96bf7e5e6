// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_sections_watchdogs_h
#define tread_scene_sections_watchdogs_h

#include <tread/base/section.h>
#include <tread/output/quality.h>

namespace tread
{
  /// Section `Watchdogs`: from where on a run is warned of at its end, and from where on it is stopped.
  struct WatchdogSection
  {
    QualityLimits warn;
    double        stop_at_residual   = 0.5; ///< of what is dissipated or, if that is more, stored as strain
    double        stop_at_strain     = 0.5; ///< Green-Lagrange, Frobenius' norm
    double        stop_at_volume     = 0.3; ///< over the undeformed one
    double        stop_at_node_speed = 1e3; ///< m/s

    void declare(ParameterTable &table);
  };
} // namespace tread

#endif
