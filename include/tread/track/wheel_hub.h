// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_track_wheel_hub_h
#define tread_track_wheel_hub_h

#include <tread/base/archive.h>
#include <tread/base/simd.h>

#include <vector>

namespace tread
{
  /// How the axle is driven.
  enum class Drive
  {
    creepage,        ///< the angular velocity is prescribed by the creepage
    torque,          ///< a torque acts on the axle
    angular_velocity ///< it is prescribed as such, of a wheelset in a given position
  };

  struct WheelHubParameters
  {
    double mass = 0.; ///< of the wheel, kg; the share of the cells is subtracted when they are attached
    double moment_of_inertia    = 0.;   ///< of the wheel about the axle, kg m^2
    double sprung_mass          = 0.;   ///< kg
    double suspension_stiffness = 0.;   ///< N/m
    double suspension_damping   = 0.;   ///< N s/m
    double gravity              = 9.81; ///< m/s^2
  };

  /// The rigid part of a wheel: it carries the flexible cells on its surface, rests under the
  /// primary suspension with the sprung mass, runs along x at constant speed, moves in z and
  /// turns about its axle, which is y or stands in a yaw and a roll. Positive angular velocity rolls towards
  /// +x.
  class WheelHub
  {
  public:
    struct Motion
    {
      double x = 0., z = 0., angle = 0.;
      double velocity_x = 0., velocity_z = 0., angular_velocity = 0.;
      double sprung_z = 0., sprung_velocity = 0.; ///< sprung mass from its equilibrium
    };

    explicit WheelHub(const WheelHubParameters &parameters)
      : parameters(parameters)
    {
    }

    /// Put the middle of the wheel into its reference position (x, y, z), m. @param axle unit vector, of
    /// which the component along y is positive.
    void place(const Vector3 middle, const Vector3 axle = Vector3{0., 1., 0., 0.});

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

    /// One central-difference step under the force (N) and the moment about the axle (N m) that
    /// the flexible cells exert.
    void advance(const Vector3 force, const double moment, const double time_step);

    /// Vertical force of everything but the cells, at rest and in steady rotation, N (negative: down).
    double static_force() const;

    /// Present position of the wheel's middle, m.
    Vector3 middle() const
    {
      return Vector3{motion.x, reference_y, motion.z, 0.};
    }
    Vector3 velocity() const
    {
      return Vector3{motion.velocity_x, 0., motion.velocity_z, 0.};
    }
    /// Unit vector, which does not change.
    Vector3 axle() const
    {
      return axle_direction;
    }
    /// The part of an arm (m) at right angles to the axle.
    Vector3 off_axle(const Vector3 arm) const
    {
      return arm - dot(axle_direction, arm) * axle_direction;
    }

    /// Position of a point that is fixed to the hub, from its reference position relative to the middle.
    Vector3 position_of(const Vector3 reference) const;

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

    /// Work done so far on hub and cells by drive, guidance, suspension and weight, J.
    double external_work() const
    {
      return work;
    }

    /// Sum of the absolute amounts of that work, J: the scale for energy residuals.
    double gross_work() const
    {
      return gross;
    }

    /// Store or restore the state: all but parameters and balance, which place() and take_out() set.
    void serialize(Archive &archive);

    Drive              drive        = Drive::creepage;
    double             drive_torque = 0.; ///< N m, used when drive == torque
    Motion             motion;
    WheelHubParameters parameters;

  private:
    /// A vector turned about the axle.
    Vector3 turned(const Vector3 v, const double angle) const;

    Vector3 axle_direction{0., 1., 0., 0.};
    double  reference_x = 0., reference_y = 0., reference_z = 0., equilibrium_z = 0., work = 0., gross = 0.;
    Vector3 reference_first_moment{}; ///< of the rigid rest
  };
} // namespace tread

#endif
