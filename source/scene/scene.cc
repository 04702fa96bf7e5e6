// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/scene.h>

namespace tread
{
  Scene::Scene()
  {
    // In this order the parameters are printed.
    general.declare(input.table());
    wheel.declare(input.table());
    wheelset.declare(input.table());
    guidance.declare(input.table());
    rail.declare(input.table());
    defect.declare(input.table());
    mesh.declare(input.table());
    solid.declare(input.table());
    contact.declare(input.table());
    track.declare(input.table());
    vehicle.declare(input.table());
    motion.declare(input.table());
    further_wheels.declare(input.table());
    time_stepping.declare(input.table());
    start.declare(input.table());
    output.declare(input.table());
    peak_stress.declare(input.table());
    ratcheting.declare(input.table());
    damage.declare(input.table());
    profile_wear.declare(input.table());
    watchdogs.declare(input.table());
  }
} // namespace tread
