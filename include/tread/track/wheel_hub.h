// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_track_wheel_hub_h
#define tread_track_wheel_hub_h

#include <tread/base/archive.h>
#include <tread/base/simd.h>
#include <tread/track/flexible_axle.h>
#include <tread/track/hub_guidance.h>
#include <tread/track/hub_motion.h>
#include <tread/track/hub_settling.h>
#include <tread/track/wheel_hub_parameters.h>

#include <array>
#include <optional>

namespace tread
{
  /// The rigid part of a wheel: it carries the flexible cells on its surface, rests under the
  /// primary suspension with the sprung mass, runs along x at constant speed, moves in z and
  /// turns about its axle, which is y or stands in a yaw and a roll. Positive angular velocity rolls towards
  /// +x. Across the track it moves as its guidance lets it. With a roll inertia it rolls freely, and the
  /// gyroscopic moments of its turning about the axle couple yaw and roll; without one they are left out, as
  /// the roll that they would cause is held. Products of inertia of the rigid rest are left out. On a
  /// flexible axle the two wheels turn against this motion, which then is that of the chord between their
  /// middles.
  class WheelHub
  {
  public:
    using Motion = HubMotion;

    explicit WheelHub(const WheelHubParameters &parameters)
      : parameters(parameters)
      , settling(parameters.settling)
    {
      if (parameters.axle)
        flexible.emplace(*parameters.axle);
    }

    /// Put the middle of the wheel into its reference position (x, y, z), m, and the axle into a yaw and a
    /// roll (rad).
    void place(const Vector3 middle, const double yaw = 0., const double roll = 0.);

    /// Take the velocities of the motion that is followed. @param time_step over which they are differences,
    /// s. @param rise vertical velocity with it, m/s; @param roll_rate of a hub that rolls, rad/s
    void begin_to_follow(const double time_step, const double rise, const double roll_rate);

    /// Rise from now on with the rail. @param speed m/s
    void begin_to_rise(const double speed);

    /// Whether the roll follows from the forces.
    bool rolls() const
    {
      return parameters.roll_inertia > 0.;
    }
    /// Whether the axle's direction may change as the wheel moves.
    bool may_tilt() const
    {
      return !guidance.is_rigid() || rolls();
    }
    /// Turn the axle about x, rad.
    void roll_by(const double angle);

    /// Define the present position of the axle as the equilibrium of the suspension.
    void balance_suspension()
    {
      equilibrium_z = motion.z;
    }

    /// Subtract the share of the cells from mass and inertia: mass (kg), moment of inertia about the axle (kg
    /// m^2) and first moment about the middle in the reference configuration (kg m), of which the part along
    /// the axle is left out. The whole wheel is balanced, so
    /// the rigid remainder has the opposite first moment and, with a flexible sector, balances the
    /// centrifugal force.
    void take_out(const double mass, const double moment_of_inertia, const Vector3 first_moment);

    /// Moments about the middles of both wheels (N m).
    using OfSides = FlexibleAxle::OfSides<Vector3>;

    /// One central-difference step under the force (N) and the moment about the middle (N m) that
    /// the flexible cells exert. @param on_wheels of a flexible axle: what carried nodes exert on its wheels
    void advance(const Vector3  force,
                 const Vector3  moment,
                 const double   time_step,
                 const OfSides &on_wheels = {});

    /// The axle between both wheels; nullptr: it is rigid.
    const FlexibleAxle *flexible_axle() const
    {
      return flexible ? &*flexible : nullptr;
    }
    /// The side of a point at present. @pre flexible_axle()
    FlexibleAxle::Side side_of(const Vector3 x) const
    {
      return dot(present.y, x - middle()) > 0. ? FlexibleAxle::own : FlexibleAxle::other;
    }
    /// Present middle of a wheel, m. @pre flexible_axle()
    Vector3 middle_of(const FlexibleAxle::Side side) const
    {
      return middle() + (side == FlexibleAxle::own ? 1. : -1.) * flexible->half_length() * present.y;
    }

    /// Vertical force of everything but the cells, at rest and in steady rotation, N (negative: down).
    double static_force() const;

    /// Present position of the wheel's middle, m.
    Vector3 middle() const
    {
      return Vector3{motion.x, reference_y + motion.y, motion.z, 0.};
    }
    Vector3 velocity() const
    {
      return Vector3{motion.velocity_x, motion.velocity_y, motion.velocity_z, 0.};
    }
    /// Unit vector, towards the own side.
    Vector3 axle() const
    {
      return present.y;
    }
    /// Angular velocity about the axle and of the axle itself, rad/s.
    Vector3 turning() const;
    /// The part of an arm (m) at right angles to the axle.
    Vector3 off_axle(const Vector3 arm) const
    {
      return arm - dot(axle(), arm) * axle();
    }

    /// Present turns of both wheels, for a loop over points; the first one's is that of a wheel alone.
    std::array<HubTurn, 2> turns() const;

    /// Position of a point that is fixed to the hub, from its reference position relative to the middle.
    Vector3 position_of(const Vector3 reference) const
    {
      return position_of(reference, turns());
    }
    Vector3 position_of(const Vector3 reference, const std::array<HubTurn, 2> &turns) const;

    /// Velocity of a point of the hub that is at x at present.
    Vector3 velocity_at(const Vector3 x) const;

    /// Kinetic energy with the angle that the hub had this many seconds ago, because velocities are those of
    /// half a step back, J.
    double kinetic_energy(const double time_back) const;

    /// Position of the wheel's middle in the reference configuration, m.
    Vector3 start() const
    {
      return Vector3{reference_x, reference_y, reference_z, 0.};
    }

    /// Work done so far on hub and cells by drive, guidance, suspension, weight and a flexible axle, J.
    double external_work() const
    {
      return work + (flexible ? flexible->work() : 0.);
    }

    /// Sum of the absolute amounts of that work, J: the scale for energy residuals.
    double gross_work() const
    {
      return gross + (flexible ? flexible->gross_work() : 0.);
    }

    /// Store or restore the state: all but parameters and balance, which place() and take_out() set.
    void serialize(Archive &archive);

    Drive              drive        = Drive::creepage;
    double             drive_torque = 0.; ///< N m, used when drive == torque
    Motion             motion;
    WheelHubParameters parameters;
    HubGuidance        guidance; ///< that leads it across the track
    HubSettling        settling; ///< where inertia is no part of the answer

  private:
    /// A vector of the reference configuration turned about the axle, and with it.
    Vector3 turned(const Vector3 reference, const HubTurn turn) const;

    /// Change the motion across the track, its roll, and angular_velocity where it is prescribed. @param
    /// lateral, moment of all but guidance (N, N m). @returns work of guidance and of the roll's damper, J
    double move_across(const double lateral, const Vector3 moment, const double time_step);
    /// Inertia against moving up, kg.
    double mass_up() const
    {
      return settling.mass().value_or(parameters.mass);
    }
    /// Part of yaw and roll inertia that is that of wheels which turn by themselves on an axle that bends, kg
    /// m^2.
    double of_turning_wheels() const
    {
      return flexible && flexible->bends() ? 2. * FlexibleAxle::about_diameter(inertia_of_wheel()) : 0.;
    }
    double roll_inertia() const
    {
      return settling.mass() ? settling.roll_inertia() + of_turning_wheels() : parameters.roll_inertia;
    }
    /// Angular velocity of the axle itself, rad/s.
    Vector3 tilting() const
    {
      return motion.yaw_rate * present.z - motion.roll_rate * Vector3{1., 0., 0., 0.};
    }
    /// What is left of the change of the angular momentum about an axle that tilts, N m. @param inertia of
    /// the part that does so, about the axle, kg m^2
    Vector3 gyroscopic_moment(const double inertia, const Vector3 tilting) const
    {
      return -inertia * motion.angular_velocity * cross(tilting, present.y);
    }
    /// Of all of the rigid part, and of one wheel on a flexible axle.
    Vector3 gyroscopic_moment() const;
    Vector3 gyroscopic_moment_of(const FlexibleAxle::Side side) const
    {
      return gyroscopic_moment(inertia_of_wheel(), tilting() + present.vector(flexible->tilt_rate(side)));
    }
    /// Moments on the wheels of a flexible axle that it does not balance, N m. @param on_wheels of the cells
    OfSides unbalanced_on_wheels(const OfSides &on_wheels);
    /// About which a wheel on a flexible axle turns, but for terms of second order in its tilt.
    Vector3 tilted_axle(const FlexibleAxle::Side side) const
    {
      return present.y + cross(present.vector(flexible->tilt(side)), present.y);
    }
    /// Inertia of one wheel of a flexible axle about it, kg m^2.
    double inertia_of_wheel() const
    {
      return 0.5 * parameters.moment_of_inertia;
    }

    WheelsetAxes reference, present;
    double  reference_x = 0., reference_y = 0., reference_z = 0., equilibrium_z = 0., work = 0., gross = 0.;
    Vector3 reference_first_moment{}; ///< of the rigid rest
    std::optional<FlexibleAxle> flexible;
  };
} // namespace tread

#endif
