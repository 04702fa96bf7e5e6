// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/track/wheel_hub.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace tread
{
  void WheelHub::place(const double x, const double z)
  {
    motion.x = reference_x = x;
    motion.z = reference_z = z;
    balance_suspension();
  }


  void WheelHub::take_out(const double mass,
                          const double moment_of_inertia,
                          const double first_moment_x,
                          const double first_moment_z)
  {
    parameters.mass -= mass;
    parameters.moment_of_inertia -= moment_of_inertia;
    reference_first_moment[0] = -first_moment_x;
    reference_first_moment[1] = -first_moment_z;
    if (!(parameters.mass > 0. && parameters.moment_of_inertia > 0.))
      throw std::invalid_argument(
        "'Wheel/Mass (kg)' or 'Wheel/Moment of inertia (kg m2)' is too small: the meshed part "
        "alone has " +
        std::to_string(mass) + " kg and " + std::to_string(moment_of_inertia) + " kg m2");
  }


  void WheelHub::first_moment(double &x, double &z, const double angle) const
  {
    const double c = std::cos(angle), s = std::sin(angle);
    x = c * reference_first_moment[0] + s * reference_first_moment[1];
    z = -s * reference_first_moment[0] + c * reference_first_moment[1];
  }


  double WheelHub::static_force() const
  {
    double moment_x, moment_z;
    first_moment(moment_x, moment_z, motion.angle);
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
    double moment_x, moment_z;
    first_moment(moment_x, moment_z, motion.angle);
    // The rest that balances the cells lags behind when the axle moves up: a moment.
    const double lag = moment_x * acceleration;
    double       turning_outside =
      -moment - lag; // with it the angular velocity stays; includes the weight's moment
    if (drive == Drive::torque)
      {
        turning_outside = drive_torque + moment_x * parameters.gravity;
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
    const double pull   = before.angular_velocity * before.angular_velocity * moment_x;
    const double faster = moment_z * (motion.angular_velocity - before.angular_velocity);
    const double along  = (faster - time_step * (force[0] + pull)) * motion.velocity_x;
    // Its centrifugal force is no work from outside.
    const double centrifugal = before.angular_velocity * before.angular_velocity * moment_z;
    const double up =
      time_step * (vertical_force - force[2] - centrifugal) * 0.5 * (before.velocity_z + motion.velocity_z);
    const double turn =
      time_step * turning_outside * 0.5 * (before.angular_velocity + motion.angular_velocity);
    work += along + up + turn;
    gross += std::abs(along) + std::abs(up) + std::abs(turn);
  }


  Vector3 WheelHub::position_of(const Vector3 reference) const
  {
    const double c = std::cos(motion.angle), s = std::sin(motion.angle);
    return Vector3{motion.x + c * reference[0] + s * reference[2], reference[1],
                   motion.z - s * reference[0] + c * reference[2], 0.};
  }


  Vector3 WheelHub::velocity_at(const Vector3 x) const
  {
    return Vector3{motion.velocity_x + motion.angular_velocity * (x[2] - motion.z), 0.,
                   motion.velocity_z - motion.angular_velocity * (x[0] - motion.x), 0.};
  }


  double WheelHub::kinetic_energy(const double time_back) const
  {
    double moment_x, moment_z;
    first_moment(moment_x, moment_z, motion.angle - time_back * motion.angular_velocity);
    return 0.5 * parameters.mass *
             (motion.velocity_x * motion.velocity_x + motion.velocity_z * motion.velocity_z) +
           motion.angular_velocity * (motion.velocity_x * moment_z - motion.velocity_z * moment_x) +
           0.5 * parameters.moment_of_inertia * motion.angular_velocity * motion.angular_velocity;
  }


  void WheelHub::serialize(Archive &archive)
  {
    archive.same(drive, drive_torque, motion, reference_x, reference_z, equilibrium_z, work, gross);
  }
} // namespace tread
