// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/scene/scene.h>

namespace tread
{
  Scene::Scene()
  {
    // In this order the parameters are printed.
    general.declare(input.entries());
    wheel.declare(input.entries());
    wheelset.declare(input.entries());
    guidance.declare(input.entries());
    rail.declare(input.entries());
    defect.declare(input.entries());
    mesh.declare(input.entries());
    solid.declare(input.entries());
    contact.declare(input.entries());
    track.declare(input.entries());
    vehicle.declare(input.entries());
    motion.declare(input.entries());
    further_wheels.declare(input.entries());
    time_stepping.declare(input.entries());
    start.declare(input.entries());
    output.declare(input.entries());
    peak_stress.declare(input.entries());
    ratcheting.declare(input.entries());
    damage.declare(input.entries());
    profile_wear.declare(input.entries());
    watchdogs.declare(input.entries());
  }
} // namespace tread
