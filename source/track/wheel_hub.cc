// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/track/wheel_hub.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace tread
{
  void WheelHub::place(const Vector3 middle, const Vector3 axle)
  {
    axle_direction = axle;
    motion.x = reference_x = middle[0];
    reference_y            = middle[1];
    motion.z = reference_z = middle[2];
    balance_suspension();
  }


  void WheelHub::take_out(const double mass, const double moment_of_inertia, const Vector3 first_moment)
  {
    parameters.mass -= mass;
    parameters.moment_of_inertia -= moment_of_inertia;
    reference_first_moment = -off_axle(first_moment);
    if (!(parameters.mass > 0. && parameters.moment_of_inertia > 0.))
      throw std::invalid_argument(
        "'Wheel/Mass (kg)' or 'Wheel/Moment of inertia (kg m2)' is too small: the meshed part "
        "alone has " +
        std::to_string(mass) + " kg and " + std::to_string(moment_of_inertia) + " kg m2");
  }


  Vector3 WheelHub::turned(const Vector3 v, const double angle) const
  {
    // Rodrigues' formula
    const Vector3 along = dot(axle_direction, v) * axle_direction;
    return along + std::cos(angle) * (v - along) + std::sin(angle) * cross(axle_direction, v);
  }


  double WheelHub::static_force() const
  {
    const double moment_z = turned(reference_first_moment, motion.angle)[2];
    return -(parameters.mass + parameters.sprung_mass) * parameters.gravity +
           motion.angular_velocity * motion.angular_velocity * moment_z;
  }


  void WheelHub::advance(const Vector3 force, const double moment, const double time_step)
  {
    const Motion before     = motion;
    const double suspension = parameters.suspension_stiffness * (motion.z - equilibrium_z - motion.sprung_z) +
                              parameters.suspension_damping * (motion.velocity_z - motion.sprung_velocity);
    const double vertical_force = force[2] + static_force() - suspension;
    const double acceleration   = vertical_force / parameters.mass;

    motion.velocity_z += time_step * acceleration;
    const Vector3 moments = turned(reference_first_moment, motion.angle); // of the rest
    // What it moves by when the axle turns; the component along z is its lever about the axle.
    const Vector3 by_turning = cross(axle_direction, moments);
    // The rest that balances the cells lags behind when the axle moves up: a moment.
    const double lag = -by_turning[2] * acceleration;
    double       turning_outside =
      -moment - lag; // with it the angular velocity stays; includes the weight's moment
    if (drive == Drive::torque)
      {
        turning_outside = drive_torque - by_turning[2] * parameters.gravity;
        motion.angular_velocity +=
          time_step * (moment + turning_outside + lag) / parameters.moment_of_inertia;
      }
    if (parameters.sprung_mass > 0.)
      motion.sprung_velocity += time_step * suspension / parameters.sprung_mass;

    motion.x += time_step * motion.velocity_x;
    motion.z += time_step * motion.velocity_z;
    motion.angle += time_step * motion.angular_velocity;
    motion.sprung_z += time_step * motion.sprung_velocity;

    // The guidance holds the hub's speed against the cells and the pull of the balancing part, which changes
    // its momentum along x, angular velocity times first moment, by turning and by turning faster.
    const double pull   = before.angular_velocity * before.angular_velocity * moments[0];
    const double faster = by_turning[0] * (motion.angular_velocity - before.angular_velocity);
    const double along  = (faster - time_step * (force[0] + pull)) * motion.velocity_x;
    // Its centrifugal force is no work from outside.
    const double centrifugal = before.angular_velocity * before.angular_velocity * moments[2];
    const double up =
      time_step * (vertical_force - force[2] - centrifugal) * 0.5 * (before.velocity_z + motion.velocity_z);
    const double turn =
      time_step * turning_outside * 0.5 * (before.angular_velocity + motion.angular_velocity);
    work += along + up + turn;
    gross += std::abs(along) + std::abs(up) + std::abs(turn);
  }


  Vector3 WheelHub::position_of(const Vector3 reference) const
  {
    return middle() + turned(reference, motion.angle);
  }


  Vector3 WheelHub::velocity_at(const Vector3 x) const
  {
    return velocity() + motion.angular_velocity * cross(axle_direction, x - middle());
  }


  double WheelHub::kinetic_energy(const double time_back) const
  {
    const Vector3 moments =
      turned(reference_first_moment, motion.angle - time_back * motion.angular_velocity);
    return 0.5 * parameters.mass * dot(velocity(), velocity()) +
           motion.angular_velocity * dot(velocity(), cross(axle_direction, moments)) +
           0.5 * parameters.moment_of_inertia * motion.angular_velocity * motion.angular_velocity;
  }


  void WheelHub::serialize(Archive &archive)
  {
    archive.same(drive, drive_torque, motion, axle_direction, reference_x, reference_y, reference_z,
                 equilibrium_z, work, gross);
  }
} // namespace tread
