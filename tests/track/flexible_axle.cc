// SPDX-License-Identifier: LGPL-2.1-or-later
// A wheelset on a flexible axle without cells: moments on its wheels, which begin to act at one instant, make
// it swing about the deflection of an Euler-Bernoulli beam, with the frequencies of two discs on a shaft. A
// light hub that is carried along the height of its rail.
#include <tread/track/wheel_hub.h>

#include "check.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace tread;

namespace track_flexible_axle
{
  constexpr double torsion = 3e6, bending = 6.6e6, half_length = 0.75; // N m/rad, N m^2, m
  constexpr double polar = 60., yaw_inertia = 700., step = 2e-6; // of a wheel and of the wheelset, kg m^2; s

  WheelHubParameters parameters(const double damping_time = 0.)
  {
    WheelHubParameters p;
    p.mass              = 1200.;
    p.moment_of_inertia = 2. * polar;
    p.gravity           = 0.;
    p.yaw_inertia = p.roll_inertia = yaw_inertia;
    p.axle                         = {torsion, bending, damping_time, half_length};
    return p;
  }

  /// Free to move, after a step without loads.
  WheelHub free_hub(const double damping_time = 0., const double angular_velocity = 0.)
  {
    WheelHub hub(parameters(damping_time));
    hub.place(Vector3{});
    hub.guidance.release({0., 0., 0., 0., 0., 0.}, hub.motion.yaw);
    hub.motion.angular_velocity = angular_velocity;
    hub.advance(Vector3{}, Vector3{}, step);
    return hub;
  }

  /// Largest difference of what `found` gives from (1 - cos(frequency t)) times `amplitude`, over this, in
  /// three periods under constant moments on both wheels and a moment on the whole.
  template <typename Found>
  double worst_swing(WheelHub                &hub,
                     const WheelHub::OfSides &moments,
                     const Vector3            on_whole,
                     const double             amplitude,
                     const double             frequency,
                     const Found             &found)
  {
    double    worst = 0.;
    const int n     = 3. * 2. * M_PI / frequency / step;
    for (int k = 1; k <= n; ++k)
      {
        hub.advance(Vector3{}, on_whole, step, moments);
        worst =
          std::max(worst, std::abs(found() / amplitude - (1. - std::cos(frequency * (k + 0.5) * step))));
      }
    return worst;
  }

  void frequencies(tests::Check &check)
  {
    const double moment = 5e3, diametral = 0.5 * polar, of_beam = bending / half_length; // 2 E I / L
    {
      WheelHub hub = free_hub();
      check.below("twist: difference from two discs on a shaft, share of the static one",
                  worst_swing(hub, {{Vector3{0., moment, 0., 0.}, Vector3{0., -moment, 0., 0.}}}, Vector3{},
                              moment / torsion, std::sqrt(2. * torsion / polar),
                              [&] { return 2. * hub.flexible_axle()->twist(FlexibleAxle::own); }),
                  5e-3);
      check.absolute("twist: of both wheels together, rad", hub.motion.angle, 0., 1e-15);
    }
    for (const bool about_x : {true, false})
      {
        const std::string name   = about_x ? "bent upwards" : "bent forwards";
        const Vector3     vector = about_x ? Vector3{moment, 0., 0., 0.} : Vector3{0., 0., moment, 0.};
        WheelHub          hub    = free_hub();
        const auto        tilt   = [&](const FlexibleAxle::Side side) {
          const FlexibleAxle::Tilt of = hub.flexible_axle()->tilt(side);
          return about_x ? of.x : of.z;
        };
        check.below(name + " into an arc: difference from discs on a beam, share of the static tilt",
                    worst_swing(hub, {{vector, -vector}}, Vector3{}, moment / of_beam,
                                std::sqrt(of_beam / diametral), [&] { return tilt(FlexibleAxle::own); }),
                    5e-3);
        check.absolute(name + " into an arc: other wheel over the own one",
                       tilt(FlexibleAxle::other) / tilt(FlexibleAxle::own), -1., 1e-12);
        // Forces at the wheels keep the whole from turning; it turns against its wheels.
        hub                   = free_hub();
        const double of_chord = yaw_inertia - 2. * diametral;
        check.below(name + " into an S: likewise",
                    worst_swing(hub, {{vector, vector}}, Vector3{}, moment / (3. * of_beam),
                                std::sqrt(3. * of_beam * (1. / diametral + 2. / of_chord)),
                                [&] { return tilt(FlexibleAxle::own); }),
                    5e-3);
        const FlexibleAxle::Tilt rate = hub.flexible_axle()->tilt_rate(FlexibleAxle::own);
        check.absolute(name + " into an S: angular momentum, N m s",
                       about_x ? -yaw_inertia * hub.motion.roll_rate + 2. * diametral * rate.x
                               : yaw_inertia * hub.motion.yaw_rate + 2. * diametral * rate.z,
                       0., 1e-9);
      }
  }

  void statics(tests::Check &check)
  {
    // A moment on one wheel alone: L / (3 E I) there and -L / (6 E I) at the other end.
    WheelHub     hub    = free_hub(3e-3);
    const double moment = 5e3, length = 2. * half_length;
    for (unsigned int k = 0; k < 100000; ++k)
      hub.advance(Vector3{}, Vector3{}, step, {{Vector3{moment, 0., 0., 0.}, Vector3{}}});
    check.relative("moment on one wheel: its tilt, mrad",
                   1e3 * hub.flexible_axle()->tilt(FlexibleAxle::own).x,
                   1e3 * moment * length / (3. * bending), 2e-4);
    check.relative("moment on one wheel: tilt of the other, mrad",
                   1e3 * hub.flexible_axle()->tilt(FlexibleAxle::other).x,
                   -1e3 * moment * length / (6. * bending), 4e-4);
  }

  void energy_and_motion(tests::Check &check)
  {
    // Turning wheels: gyroscopic moments couple all, and work nothing.
    WheelHub     hub   = free_hub(20e-6, 80.);
    const double start = hub.kinetic_energy(0.);
    double       done = 0., greatest = 0., worst_velocity = 0.;
    for (unsigned int k = 0; k < 20000; ++k)
      {
        const double            t = k * step;
        const WheelHub::OfSides moments{
          {Vector3{4e3 * std::sin(900. * t), 3e3 * std::sin(300. * t), 2e3, 0.},
           Vector3{-1e3, -2e3 * std::sin(300. * t), 3e3 * std::sin(700. * t), 0.}}};
        const auto power = [&] {
          double of_all = 0.;
          for (const FlexibleAxle::Side side : {FlexibleAxle::own, FlexibleAxle::other})
            {
              // Velocities beside the middle of a wheel tell how it turns.
              const Vector3 middle   = hub.middle_of(side);
              const auto    relative = [&](const Vector3 way) {
                return hub.velocity_at(middle + way) - hub.velocity_at(middle);
              };
              const Vector3 turning{10. * relative(Vector3{0., 0.1, 0., 0.})[2],
                                    relative(Vector3{0., 0., 1., 0.})[0],
                                    relative(Vector3{1., 0., 0., 0.})[1], 0.};
              of_all += dot(moments[side], turning);
            }
          return of_all;
        };
        // Moments on the wheels are a part of those on the whole; the drive leaves the mean turning as it is.
        const double  before = power();
        const Vector3 place{0.1, -0.7, -0.45, 0.}, was = hub.position_of(place);
        hub.drive = Drive::torque;
        hub.advance(Vector3{}, moments[0] + moments[1], step, moments);
        done += 0.5 * step * (before + power());
        greatest             = std::max(greatest, std::abs(done));
        const Vector3 is     = hub.position_of(place);
        const Vector3 slower = hub.velocity_at(0.5 * (was + is)) - (1. / step) * (is - was);
        worst_velocity       = std::max(worst_velocity, std::sqrt(dot(slower, slower)));
      }
    const FlexibleAxle &axle = *hub.flexible_axle();
    check.that("the axle is twisted and bent", std::abs(axle.tilt(FlexibleAxle::own).x) > 1e-5 &&
                                                 std::abs(axle.tilt(FlexibleAxle::other).z) > 1e-5 &&
                                                 std::abs(axle.twist(FlexibleAxle::own)) > 1e-5);
    check.below("kinetic energy but for the work on it, share",
                std::abs(hub.kinetic_energy(0.) - start - done - hub.external_work()) / greatest, 2e-3);
    check.below("velocity beside how far a place of a wheel moves in a step, m/s", worst_velocity, 1e-3);
  }

  /// A light hub rises with the cells that it moves as the height of its rail does, which bends more and more
  /// along the way.
  void carried(tests::Check &check)
  {
    constexpr double speed = 20., bend = 0.02, place = 0.3, cells = 7.; // m/s; 1/m for each metre; m; kg
    constexpr double acceleration = bend * place * speed * speed;
    for (const bool rides : {false, true})
      {
        WheelHubParameters p;
        p.mass     = 1200.;
        p.gravity  = 0.;
        p.settling = SettlingOfHub{1e9, 1e-3, half_length, 5., cells};
        WheelHub hub(p);
        hub.place(Vector3{place, 0., 0., 0.});
        if (rides)
          hub.settling.ride([](const double x) { return bend * x; });
        hub.motion.x          = place;
        hub.motion.velocity_x = speed;
        hub.advance(Vector3{}, Vector3{}, step);
        const double      up   = rides ? step * acceleration : 0.;
        const std::string name = rides ? "hub that rides: " : "hub on a level way: ";
        check.absolute(name + "it rises with what carries its cells, mm/s", 1e3 * hub.motion.velocity_z,
                       1e3 * up * (1. + cells / p.settling->mass()), 1e-12);
        check.absolute(name + "the sprung mass with it, mm/s", 1e3 * hub.motion.sprung_velocity, 1e3 * up,
                       1e-12);
      }
  }
} // namespace track_flexible_axle


TREAD_TEST(track_flexible_axle)(tests::Check &check, const tests::Arguments &)
{
  frequencies(check);
  statics(check);
  energy_and_motion(check);
  carried(check);
}
