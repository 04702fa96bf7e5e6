// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/scene.h>

namespace tread
{
  Scene::Scene()
  {
    // In this order the parameters are printed.
    general.declare(handler);
    wheel.declare(handler);
    wheelset.declare(handler);
    guidance.declare(handler);
    rail.declare(handler);
    defect.declare(handler);
    mesh.declare(handler);
    solid.declare(handler);
    contact.declare(handler);
    track.declare(handler);
    vehicle.declare(handler);
    motion.declare(handler);
    further_wheels.declare(handler);
    time_stepping.declare(handler);
    start.declare(handler);
    output.declare(handler);
    peak_stress.declare(handler);
    ratcheting.declare(handler);
    damage.declare(handler);
    profile_wear.declare(handler);
    watchdogs.declare(handler);
  }
} // namespace tread
