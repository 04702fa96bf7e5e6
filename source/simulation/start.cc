// SPDX-License-Identifier: LGPL-2.1-or-later
// How a wheel comes to stand on the rail and begins to roll.
#include <tread/base/format.h>
#include <tread/dynamics/parts/rail_base.h>
#include <tread/dynamics/parts/rail_on_beam.h>
#include <tread/scene/wheelset_case.h>
#include <tread/simulation/simulation.h>
#include <tread/track/supports.h>

#include "interruption.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

namespace tread
{
  namespace
  {
    /// Measurements in a row without any load on a wheel after which none is to be expected: 2000 iterations,
    /// as many as a whole start takes.
    constexpr unsigned int most_unloaded = 100;

    /// Balance of forces, share of the load, at which predicted tractions are laid on: the pressure is then
    /// what it will be but for this share, and what the tractions change settles with the rest.
    constexpr double balance_for_tractions = 3e-4;
  } // namespace


  void Simulation::prepare_start(Progress &progress)
  {
    const double           began = progress.seconds();
    std::vector<Tractions> tractions;
    for (RollingWheel &wheel : model.wheels)
      {
        const auto own  = model.wheels.begin() + wheel.number;
        const auto like = std::find_if(model.wheels.begin(), own, [&](const RollingWheel &before) {
          const auto friction = [&](const RollingWheel &w) {
            return scene.contact.friction_factor(scene.path_begin(w.number));
          };
          return scene.traction_coefficient(before.number) == scene.traction_coefficient(wheel.number) &&
                 friction(before) == friction(wheel);
        });
        if (like == own)
          tractions.push_back(predict_rolling(wheel, progress));
        else
          {
            tractions.push_back(tractions[like->number]);
            wheel.target_creepage = like->target_creepage;
          }
      }
    starts_with_tractions =
      std::all_of(tractions.begin(), tractions.end(), [](const Tractions &known) { return bool(known); });

    const auto measure_free_rolling = [&]() {
      model.contact.complete_state();
      // Earlier wheels have left the surface stretched where they began and ended, and in the middle of the
      // path, where passages are compared, displaced alike: there a wheel rolls freely as the first one did.
      if (passages && passages->any_has_ended() && !scene.ratcheting.uniform)
        return;
      const NodalField x       = model.dynamics.state.positions();
      const double     stretch = half_space_stretch(scene);
      for (RollingWheel &wheel : model.wheels)
        wheel.free_creepage = model.contact.free_rolling_creepage(x.data(), wheel.body) - stretch;
    };
    bool         free_rolling_known = false;
    unsigned int unloaded           = 0; // measurements in a row
    TimeLeft     time_left(scene.start.tolerance);

    const auto after_each_measurement = [&](const unsigned int iteration, const double share) {
      if (interrupted())
        throw Interruption();
      const bool all_loaded =
        std::all_of(model.wheels.begin(), model.wheels.end(), [&](const RollingWheel &wheel) {
          return model.contact.total_impulse_on(wheel.body)[2] > 0.;
        });
      unloaded = all_loaded ? 0 : unloaded + 1;
      if (unloaded > most_unloaded)
        throw std::runtime_error(
          "the wheel finds no rail under it at the start: it sinks past what is meshed "
          "for contact; change 'Wheel/Lateral position (mm)' or 'Wheel/Tread profile'");
      if (starts_with_tractions && !free_rolling_known &&
          share <= std::max(scene.start.tolerance, balance_for_tractions))
        {
          measure_free_rolling();
          free_rolling_known = true;
          // On a track those to the side, of spin, are left to build up: an iteration takes long to bend the
          // rail that way.
          model.contact.prescribed.give_tractions(
            [tractions, to_the_side = !model.supports, this](const Vector3 place) {
              const auto distance = [&](const RollingWheel &wheel) {
                return std::abs(place[0] - wheel.hub.motion.x);
              };
              const RollingWheel &nearest = *std::min_element(
                model.wheels.begin(), model.wheels.end(),
                [&](const RollingWheel &a, const RollingWheel &b) { return distance(a) < distance(b); });
              const Vector3 ratio =
                tractions[nearest.number](place - Vector3{nearest.hub.motion.x, 0., 0., 0.});
              return to_the_side ? ratio : Vector3{ratio[0], 0., 0., 0.};
            });
        }
      time_left.add(progress.seconds(), share);
      if (progress.due())
        {
          const std::optional<double> left = time_left.seconds();
          progress.show(format("start: iteration %u, force balance %.1e of the load", iteration, share) +
                        (left ? format("  about %.0f s left", *left) : ""));
        }
    };
    relaxation_iterations = model.find_equilibrium(after_each_measurement);
    if (!free_rolling_known)
      measure_free_rolling();
    relaxation_seconds = progress.seconds() - began;
    model.check_rim();
    // Cells deformed by earlier wheels may have become slower or faster.
    if (passages && passages->any_has_ended())
      model.dynamics.critical_step().renew();
    std::string forces;
    for (const RollingWheel &wheel : model.wheels)
      forces +=
        format(forces.empty() ? "%.2f" : ", %.2f", 1e-3 * model.contact.total_impulse_on(wheel.body)[2]);
    progress.say(
      format("start: equilibrium after %.0f iterations, %.1f s; normal force %s kN; free rolling at %.2e",
             relaxation_iterations, relaxation_seconds, forces.c_str(), model.wheels.front().free_creepage));

    model.contact.prescribed.give_tractions({});
    for (RollingWheel &wheel : model.wheels)
      {
        wheel.hub.drive             = Drive::creepage;
        wheel.hub.motion.velocity_x = scene.motion.speed;
        if (scene.guidance.kind == Guidance::file)
          {
            const PlacedWheel::Rise rise = scene.placed_wheel().rise();
            wheel.hub.begin_to_follow(scene.time_stepping.courant_number *
                                        model.dynamics.critical_step().seconds(),
                                      rise.speed, rise.roll_rate);
          }
        else if (scene.rail.is_sliced())
          wheel.hub.begin_to_rise(scene.placed_wheel().rise().speed);
        wheel.hub.motion.angular_velocity = scene.motion.speed / scene.stance().rolling_radius() *
                                            (1. + wheel.target_creepage + wheel.free_creepage);
      }
    if (model.supports || model.rail_on_beam)
      model.dynamics.set_bending_velocities();
    model.dynamics.set_rigid_velocities();
    model.contact.scale_impulses(scene.time_stepping.courant_number *
                                 model.dynamics.critical_step().seconds());
    model.dynamics.start();
    for (const auto &recorder : recorders)
      recorder->start();
  }


  Simulation::Tractions Simulation::predict_rolling(RollingWheel &wheel, Progress &progress) const
  {
    const bool predicts_tractions = scene.start.tractions == StartTractions::predicted;
    if (scene.is_positioned())
      {
        wheel.target_creepage =
          given_angular_velocity(scene) * scene.stance().rolling_radius() / scene.motion.speed - 1.;
        return predicts_tractions ? [this](const Vector3 &place) {
          return traction_over_pressure(scene.placed_wheel(), place);
        } : Tractions();
      }
    const auto of_patch =
      [y = scene.shapes().first_contact.y](const reference::RollingResult &fields) -> Tractions {
      return [fields, y](const Vector3 &place) {
        return traction_over_pressure(fields, place[0], place[1] - y);
      };
    };
    if (!scene.motion.creepage)
      {
        reference::RollingCase c = half_space_case(scene, wheel.number);
        set_friction(c, scene, scene.path_begin(wheel.number));
        try
          {
            const reference::RollingEstimate estimate = half_space_answer(scene, c, wheel.number);
            wheel.target_creepage                     = -estimate.creepage.value;
            return predicts_tractions ? of_patch(estimate.fields) : Tractions();
          }
        catch (const InputError &error)
          {
            throw InputError(std::string("the creepage cannot be predicted: ") + error.what() +
                             "; or give 'Motion/Creepage' a number");
          }
      }
    wheel.target_creepage = *scene.motion.creepage;
    if (predicts_tractions)
      try
        {
          reference::RollingCase c = half_space_case(scene, wheel.number);
          c.prescribe_force        = false;
          c.creepage               = -wheel.target_creepage;
          set_friction(c, scene, scene.path_begin(wheel.number));
          return of_patch(half_space_answer(scene, c, wheel.number).fields);
        }
      catch (const std::bad_alloc &)
        {
          throw; // no fault of the input
        }
      catch (const std::exception &error)
        {
          progress.say(std::string("start without tractions: ") + error.what());
        }
    return {};
  }


  void Simulation::next_passage(Progress &progress)
  {
    for (RollingWheel &wheel : model.wheels)
      {
        // On a track the rail is bent where the wheel before stood: it begins straight again, and finds its
        // residual stresses and strains anew from what the cells remember.
        for (unsigned int i = 0; i < model.mesh.nodes.size(); ++i)
          if (model.supports || model.rail_base || model.rail_on_beam ||
              model.mesh.node_bodies[i] == wheel.body)
            model.dynamics.state.set_position(
              i, Vector3{model.mesh.nodes[i][0], model.mesh.nodes[i][1], model.mesh.nodes[i][2], 0.});
        model.solid.plastic().forget(wheel.body, model.dynamics.state.history);
        wheel.place(scene);
      }
    if (model.supports)
      model.supports->set_at_rest(model.dynamics.state.positions().data());
    if (model.rail_base)
      model.rail_base->place();
    if (model.rail_on_beam)
      model.rail_on_beam->place();
    for (const auto &recorder : recorders)
      recorder->begin_passage();
    model.contact.scale_impulses(0.);
    forget_solution();
    torque_released  = false;
    checked_position = model.position();
    prepare_start(progress);
  }
} // namespace tread
