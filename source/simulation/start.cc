// SPDX-License-Identifier: LGPL-2.1-or-later
// How a wheel comes to stand on the rail and begins to roll.
#include <tread/base/format.h>
#include <tread/simulation/simulation.h>

#include "interruption.h"

#include <algorithm>
#include <stdexcept>

namespace tread
{
  void Simulation::prepare_start(Progress &progress)
  {
    const double             began = progress.seconds();
    reference::RollingResult half_space;
    bool                     predicts_tractions = scene.start.tractions == StartTractions::predicted;
    if (!scene.motion.creepage)
      {
        const reference::RollingEstimate estimate = reference::estimate_rolling(half_space_case(scene));
        half_space                                = estimate.fields;
        target_creepage                           = -estimate.creepage.value;
      }
    else
      target_creepage = *scene.motion.creepage;
    if (predicts_tractions && scene.motion.creepage)
      try
        {
          reference::RollingCase c = half_space_case(scene);
          c.prescribe_force        = false;
          c.creepage               = -target_creepage;
          half_space               = reference::estimate_rolling(c).fields;
        }
      catch (const std::exception &error)
        {
          predicts_tractions = false;
          progress.say(std::string("start without tractions: ") + error.what());
        }

    const auto measure_free_rolling = [&]() {
      contact.complete_state();
      free_creepage = contact.free_rolling_creepage(dynamics.positions().data()) - half_space_stretch(scene);
    };
    bool         free_rolling_known = false;
    unsigned int unloaded           = 0; // measurements in a row

    const auto after_each_measurement = [&](const unsigned int iteration, const double share) {
      if (interrupted())
        throw Interruption();
      unloaded = contact.total_impulse()[2] > 0. ? 0 : unloaded + 1;
      if (unloaded > 100)
        throw std::runtime_error(
          "the wheel finds no rail under it at the start: it sinks past what is meshed "
          "for contact; change 'Wheel/Lateral position (mm)' or 'Wheel/Tread profile'");
      if (predicts_tractions && !free_rolling_known && share <= std::max(scene.start.tolerance, 3e-4))
        {
          measure_free_rolling();
          free_rolling_known = true;
          // On a track those to the side, of spin, are left to build up: an iteration takes long to bend the
          // rail that way.
          contact.give_tractions([half_space, to_the_side = !supports, x = hub.motion.x,
                                  y = scene.first_contact().y](const Row place) {
            const Row ratio = traction_over_pressure(half_space, place[0] - x, place[1] - y);
            return Row{ratio[0], to_the_side ? ratio[1] : 0., 0., 0.};
          });
        }
      if (progress.due())
        progress.show(format("start: iteration %u, force balance %.1e of the load", iteration, share));
    };
    relaxation_iterations =
      dynamics.relax(scene.start.tolerance, scene.start.max_iterations, after_each_measurement);
    if (!free_rolling_known)
      measure_free_rolling();
    relaxation_seconds = progress.seconds() - began;
    check_rim();
    // Cells deformed by earlier wheels may have become slower or faster.
    if (!passages.empty())
      dynamics.renew_critical_time_step();
    progress.say(
      format("start: equilibrium after %.0f iterations, %.1f s; normal force %.2f kN; free rolling at %.2e",
             relaxation_iterations, relaxation_seconds, 1e-3 * contact.total_impulse()[2], free_creepage));

    contact.give_tractions({});
    hub.drive             = Drive::creepage;
    hub.motion.velocity_x = scene.motion.speed;
    hub.motion.angular_velocity =
      scene.motion.speed / scene.rolling_radius() * (1. + target_creepage + free_creepage);
    if (supports)
      dynamics.set_track_velocities();
    dynamics.set_wheel_velocities();
    contact.scale_impulses(scene.time_stepping.courant_number * dynamics.critical_time_step());
    dynamics.start();
    interval_start_time  = dynamics.time;
    interval_start_speed = hub.motion.velocity_z;
  }


  void Simulation::next_wheel(Progress &progress)
  {
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == wheel_body)
        dynamics.set_position(i, Row{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.});
    solid.plastic().forget(wheel_body, dynamics.history);
    hub.motion = WheelHub::Motion();
    hub.place(scene.path_begin(), scene.axle_height());
    hub.motion.angular_velocity = scene.motion.speed / scene.rolling_radius();
    contact.scale_impulses(0.);
    torque_released = solution_taken = false;
    checked_position                 = position();
    average                          = PatchAverage();
    last_force_sum                   = Row{};
    last_force_low                   = 1e300;
    last_force_high                  = -1e300;
    last_steps                       = 0;
    prepare_start(progress);
  }
} // namespace tread
