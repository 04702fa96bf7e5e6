// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/track/wheel_hub.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace tread
{
  void WheelHub::place(const Vector3 middle, const double yaw, const double roll)
  {
    motion.yaw  = yaw;
    motion.roll = roll;
    reference = present = WheelsetAxes::of(yaw, roll);
    motion.x = reference_x = middle[0];
    motion.y               = 0.;
    reference_y            = middle[1];
    motion.z = reference_z = middle[2];
    guidance.hold();
    settling.place();
    if (flexible)
      flexible->place();
    balance_suspension();
  }


  Vector3 WheelHub::turning() const
  {
    return motion.angular_velocity * present.y + tilting();
  }


  void WheelHub::begin_to_follow(const double time_step, const double rise, const double roll_rate)
  {
    guidance.begin(motion, time_step, rolls());
    if (rolls())
      motion.roll_rate = roll_rate;
    begin_to_rise(rise);
  }


  void WheelHub::begin_to_rise(const double speed)
  {
    motion.velocity_z = speed;
    settling.begin(motion, speed);
  }


  void WheelHub::roll_by(const double angle)
  {
    motion.roll += angle;
    present = WheelsetAxes::of(motion.yaw, motion.roll);
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


  Vector3 WheelHub::turned(const Vector3 v, const HubTurn turn) const
  {
    const double x = dot(reference.x, v), z = dot(reference.z, v);
    return (turn.cosine * x + turn.sine * z) * present.x + dot(reference.y, v) * present.y +
           (turn.cosine * z - turn.sine * x) * present.z;
  }


  std::array<HubTurn, 2> WheelHub::turns() const
  {
    if (!flexible)
      return {HubTurn(motion.angle), HubTurn(motion.angle)};
    return {HubTurn(motion.angle + flexible->twist(FlexibleAxle::own)),
            HubTurn(motion.angle + flexible->twist(FlexibleAxle::other))};
  }


  double WheelHub::static_force() const
  {
    const double moment_z = turned(reference_first_moment, HubTurn(motion.angle))[2];
    return -(parameters.mass + parameters.sprung_mass) * parameters.gravity +
           motion.angular_velocity * motion.angular_velocity * moment_z;
  }


  Vector3 WheelHub::gyroscopic_moment() const
  {
    if (!flexible)
      return gyroscopic_moment(parameters.moment_of_inertia, tilting());
    return gyroscopic_moment_of(FlexibleAxle::own) + gyroscopic_moment_of(FlexibleAxle::other);
  }


  WheelHub::OfSides WheelHub::unbalanced_on_wheels(const OfSides &on_wheels)
  {
    FlexibleAxle::OfSides<FlexibleAxle::Tilt> outside;
    for (const FlexibleAxle::Side side : {FlexibleAxle::own, FlexibleAxle::other})
      outside[side] = present.tilt(on_wheels[side] + gyroscopic_moment_of(side));
    const auto unbalanced = flexible->unbalanced(outside);
    return {{present.vector(unbalanced[FlexibleAxle::own]), present.vector(unbalanced[FlexibleAxle::other])}};
  }


  double WheelHub::move_across(const double lateral, const Vector3 moment, const double time_step)
  {
    const Motion before = motion;
    double       damped = 0.; // work
    if (rolls())
      {
        const double damper = settling.roll(motion, time_step);
        motion.roll_rate += time_step * (damper - moment[0]) / (roll_inertia() - of_turning_wheels());
        motion.roll += time_step * motion.roll_rate;
        damped = 0.5 * time_step * damper * (before.roll_rate + motion.roll_rate);
      }
    // Wheels on an axle that bends turn by themselves.
    return damped + guidance.advance(motion, before,
                                     {lateral, dot(moment, present.z), moment[0], parameters.mass,
                                      parameters.yaw_inertia - of_turning_wheels(), rolls()},
                                     time_step);
  }


  void WheelHub::advance(const Vector3  force,
                         const Vector3  moment_about_middle,
                         const double   time_step,
                         const OfSides &on_wheels)
  {
    const Motion before = motion;
    // A wheel that is tilted on its axle turns about its own.
    double moment = dot(axle(), moment_about_middle);
    if (flexible)
      for (const FlexibleAxle::Side side : {FlexibleAxle::own, FlexibleAxle::other})
        moment += dot(tilted_axle(side) - axle(), on_wheels[side]);
    const double suspension = parameters.suspension_stiffness * (motion.z - equilibrium_z - motion.sprung_z) +
                              parameters.suspension_damping * (motion.velocity_z - motion.sprung_velocity);
    const double damper         = settling.lift(motion, time_step);
    const double carrying       = settling.carry(motion, time_step);
    const double vertical_force = force[2] + static_force() - suspension + damper + carrying;
    const double acceleration   = vertical_force / mass_up();

    motion.velocity_z += time_step * acceleration;
    const Vector3 moments = turned(reference_first_moment, HubTurn(motion.angle)); // of the rest
    // What it moves by when the axle turns; the component along z is its lever about the axle.
    const Vector3 by_turning = cross(axle(), moments);
    // The rest that balances the cells lags behind when the axle moves up: a moment.
    const double lag = -by_turning[2] * acceleration;
    // Its centrifugal force is no work from outside.
    const double centrifugal = before.angular_velocity * before.angular_velocity * moments[2];
    const auto   unbalanced  = flexible ? unbalanced_on_wheels(on_wheels) : OfSides{};
    Vector3 on_chord = moment_about_middle - unbalanced[FlexibleAxle::own] - unbalanced[FlexibleAxle::other];
    if (rolls())
      on_chord += gyroscopic_moment();
    const Vector3 tilting_before = tilting();
    const double  guiding        = move_across(
              force[1] + before.angular_velocity * before.angular_velocity * moments[1], on_chord, time_step);
    if (flexible)
      flexible->advance(
        {{present.tilt(unbalanced[FlexibleAxle::own]), present.tilt(unbalanced[FlexibleAxle::other])}},
        {{dot(tilted_axle(FlexibleAxle::own), on_wheels[FlexibleAxle::own]),
          dot(tilted_axle(FlexibleAxle::other), on_wheels[FlexibleAxle::other])}},
        present.tilt((1. / time_step) * (tilting() - tilting_before)), inertia_of_wheel(), time_step);
    // with it the angular velocity is as prescribed; includes the weight's moment
    double turning_outside =
      parameters.moment_of_inertia * (motion.angular_velocity - before.angular_velocity) / time_step -
      moment - lag;
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
    const double up =
      time_step * (vertical_force - force[2] - centrifugal) * 0.5 * (before.velocity_z + motion.velocity_z);
    const double turn =
      time_step * turning_outside * 0.5 * (before.angular_velocity + motion.angular_velocity);
    work += along + up + turn + guiding;
    gross += std::abs(along) + std::abs(up) + std::abs(turn) + std::abs(guiding);
    if (may_tilt())
      present = WheelsetAxes::of(motion.yaw, motion.roll);
  }


  Vector3 WheelHub::position_of(const Vector3 arm, const std::array<HubTurn, 2> &turns) const
  {
    if (!flexible)
      return middle() + turned(arm, turns[FlexibleAxle::own]);
    const auto    side = dot(reference.y, arm) > 0. ? FlexibleAxle::own : FlexibleAxle::other;
    const Vector3 from = middle_of(side), way = middle() + turned(arm, turns[side]) - from;
    const Vector3 tilt = present.vector(flexible->tilt(side));
    // Rodrigues.
    const double angle = std::sqrt(dot(tilt, tilt));
    if (angle == 0.)
      return from + way;
    const Vector3 about = (1. / angle) * tilt;
    return from + std::cos(angle) * way + std::sin(angle) * cross(about, way) +
           (1. - std::cos(angle)) * dot(about, way) * about;
  }


  Vector3 WheelHub::velocity_at(const Vector3 x) const
  {
    const Vector3 of_chord = velocity() + cross(turning(), x - middle());
    if (!flexible)
      return of_chord;
    const FlexibleAxle::Side side = side_of(x);
    const double             spin = motion.angular_velocity + flexible->twist_rate(side);
    return of_chord + cross(spin * tilted_axle(side) - motion.angular_velocity * present.y +
                              present.vector(flexible->tilt_rate(side)),
                            x - middle_of(side));
  }


  double WheelHub::kinetic_energy(const double time_back) const
  {
    const Vector3 moments =
      turned(reference_first_moment, HubTurn(motion.angle - time_back * motion.angular_velocity));
    const double in_plane = motion.velocity_x * motion.velocity_x + motion.velocity_y * motion.velocity_y;
    return 0.5 * (parameters.mass * in_plane + mass_up() * motion.velocity_z * motion.velocity_z) +
           motion.angular_velocity * dot(velocity(), cross(axle(), moments)) +
           0.5 * parameters.moment_of_inertia * motion.angular_velocity * motion.angular_velocity +
           0.5 * parameters.yaw_inertia * motion.yaw_rate * motion.yaw_rate +
           (rolls() ? 0.5 * roll_inertia() * motion.roll_rate * motion.roll_rate : 0.) +
           (flexible ? flexible->kinetic_energy(present.tilt(tilting()), inertia_of_wheel()) : 0.);
  }


  void WheelHub::serialize(Archive &archive)
  {
    archive.same(drive, drive_torque, motion, reference, present, reference_x, reference_y, reference_z,
                 equilibrium_z, work, gross);
    guidance.serialize(archive);
    settling.serialize(archive);
    if (flexible)
      flexible->serialize(archive);
  }
} // namespace tread
