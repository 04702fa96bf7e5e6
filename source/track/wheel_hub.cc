// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/track/wheel_hub.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace tread
{
  double SettlingOfHub::mass() const
  {
    const double per_radian = time / (2. * std::numbers::pi);
    return std::max(stiffness * per_radian * per_radian, carried_mass);
  }


  double SettlingOfHub::damping() const
  {
    return std::sqrt(stiffness * (mass() + cell_mass));
  }


  double SettlingOfHub::companion_mass() const
  {
    return 4. * (mass() + cell_mass);
  }


  void WheelHub::place(const Vector3 middle, const double yaw, const double roll)
  {
    motion.yaw  = yaw;
    motion.roll = roll;
    reference = present = frame(yaw, roll);
    motion.x = reference_x = middle[0];
    motion.y               = 0.;
    reference_y            = middle[1];
    motion.z = reference_z = middle[2];
    guidance               = Guidance::rigid;
    companions             = Companions();
    if (flexible)
      flexible->place();
    balance_suspension();
  }


  WheelHub::Frame WheelHub::frame(const double yaw, const double roll)
  {
    const double c = std::cos(yaw), s = std::sin(yaw), cr = std::cos(roll), sr = std::sin(roll);
    return {Vector3{c, cr * s, -sr * s, 0.}, Vector3{-s, cr * c, -sr * c, 0.}, Vector3{0., sr, cr, 0.}};
  }


  Vector3 WheelHub::turning() const
  {
    return motion.angular_velocity * present.y + tilting();
  }


  void WheelHub::follow(const std::function<Across(double)> &given)
  {
    guidance      = Guidance::file;
    guidance_time = 0.;
    across        = given;
  }


  void WheelHub::begin_to_follow(const double time_step, const double rise, const double roll_rate)
  {
    const Across now = across(0.), next = across(time_step);
    motion.velocity_y = (next.y - now.y) / time_step;
    motion.yaw_rate   = (next.yaw - now.yaw) / time_step;
    motion.roll_rate  = rolls() ? roll_rate : (next.roll - now.roll) / time_step;
    begin_to_rise(rise);
  }


  void WheelHub::begin_to_rise(const double speed)
  {
    motion.velocity_z = speed;
    companions        = {speed, motion.roll_rate};
    if (parameters.settling && curvature_of_way) // the suspension carries the load, and nothing else
      motion.sprung_velocity = speed;
  }


  void WheelHub::ride(const std::function<double(const double)> &curvature)
  {
    curvature_of_way = curvature;
  }


  double WheelHub::carrying_force(const double time_step)
  {
    if (!parameters.settling || !curvature_of_way)
      return 0.;
    const double acceleration = curvature_of_way(motion.x) * motion.velocity_x * motion.velocity_x;
    companions.up += time_step * acceleration;
    motion.sprung_velocity += time_step * acceleration;
    return (parameters.settling->mass() + parameters.settling->cell_mass) * acceleration;
  }


  void WheelHub::roll_by(const double angle)
  {
    motion.roll += angle;
    present = frame(motion.yaw, motion.roll);
  }


  void WheelHub::release(const GuidanceSprings &on)
  {
    guidance      = Guidance::springs;
    guidance_time = 0.;
    springs       = on;
    released_yaw  = motion.yaw;
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


  Vector3 WheelHub::turned(const Vector3 v, const Turn turn) const
  {
    const double x = dot(reference.x, v), z = dot(reference.z, v);
    return (turn.cosine * x + turn.sine * z) * present.x + dot(reference.y, v) * present.y +
           (turn.cosine * z - turn.sine * x) * present.z;
  }


  std::array<WheelHub::Turn, 2> WheelHub::turns() const
  {
    if (!flexible)
      return {Turn(motion.angle), Turn(motion.angle)};
    return {Turn(motion.angle + flexible->twist(FlexibleAxle::own)),
            Turn(motion.angle + flexible->twist(FlexibleAxle::other))};
  }


  double WheelHub::static_force() const
  {
    const double moment_z = turned(reference_first_moment, Turn(motion.angle))[2];
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
      outside[side] = in_chord(on_wheels[side] + gyroscopic_moment_of(side));
    const auto unbalanced = flexible->unbalanced(outside);
    return {{in_space(unbalanced[FlexibleAxle::own]), in_space(unbalanced[FlexibleAxle::other])}};
  }


  double WheelHub::guide(const double lateral, const Vector3 moment, const double time_step)
  {
    const Motion before = motion;
    // Wheels on an axle that bends turn by themselves.
    const double yaw_inertia = parameters.yaw_inertia - of_turning_wheels();
    double       settling    = 0.; // work
    if (rolls())
      {
        const double damper = settling_force(motion.roll_rate, companions.roll, per_roll(), time_step);
        motion.roll_rate += time_step * (damper - moment[0]) / (roll_inertia() - of_turning_wheels());
        motion.roll += time_step * motion.roll_rate;
        settling = 0.5 * time_step * damper * (before.roll_rate + motion.roll_rate);
      }
    if (guidance == Guidance::rigid)
      {
        lateral_guidance = -lateral;
        return settling;
      }
    const double yaw_moment  = dot(moment, present.z);
    double       yaw_support = 0.; // moment of guidance
    if (guidance == Guidance::file)
      {
        const Across next = across(guidance_time + time_step);
        motion.velocity_y = (next.y - motion.y) / time_step;
        motion.yaw_rate   = (next.yaw - motion.yaw) / time_step;
        if (!rolls())
          motion.roll_rate = (next.roll - motion.roll) / time_step;
        lateral_guidance = parameters.mass * (motion.velocity_y - before.velocity_y) / time_step - lateral;
        yaw_support      = yaw_inertia * (motion.yaw_rate - before.yaw_rate) / time_step - yaw_moment;
        // Free rolling may lie beside what theory takes for it.
        if (next.angular_velocity)
          motion.angular_velocity += *next.angular_velocity - *across(guidance_time).angular_velocity;
      }
    else
      {
        if (!springs.force)
          springs.force = -lateral;
        if (!springs.moment)
          springs.moment = -yaw_moment;
        lateral_guidance =
          *springs.force - springs.stiffness * motion.y - springs.damping * motion.velocity_y;
        yaw_support = *springs.moment - springs.yaw_stiffness * (motion.yaw - released_yaw) -
                      springs.yaw_damping * motion.yaw_rate;
        motion.velocity_y += time_step * (lateral + lateral_guidance) / parameters.mass;
        if (yaw_inertia > 0.)
          motion.yaw_rate += time_step * (yaw_moment + yaw_support) / yaw_inertia;
      }
    guidance_time += time_step;
    motion.y += time_step * motion.velocity_y;
    motion.yaw += time_step * motion.yaw_rate;
    if (!rolls())
      motion.roll += time_step * motion.roll_rate;
    const double roll_support = rolls() ? 0. : moment[0]; // about -x, against that of the cells
    return settling + 0.5 * time_step *
                        (lateral_guidance * (before.velocity_y + motion.velocity_y) +
                         yaw_support * (before.yaw_rate + motion.yaw_rate) +
                         roll_support * (before.roll_rate + motion.roll_rate));
  }


  double WheelHub::settling_force(const double velocity,
                                  double      &companion,
                                  const double scale,
                                  const double time_step) const
  {
    if (!parameters.settling)
      return 0.;
    const double force = scale * parameters.settling->damping() * (companion - velocity);
    companion -= time_step * force / (scale * parameters.settling->companion_mass());
    return force;
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
    const double damper         = settling_force(motion.velocity_z, companions.up, 1., time_step);
    const double carrying       = carrying_force(time_step);
    const double vertical_force = force[2] + static_force() - suspension + damper + carrying;
    const double acceleration   = vertical_force / mass_up();

    motion.velocity_z += time_step * acceleration;
    const Vector3 moments = turned(reference_first_moment, Turn(motion.angle)); // of the rest
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
    const double  guiding =
      guide(force[1] + before.angular_velocity * before.angular_velocity * moments[1], on_chord, time_step);
    if (flexible)
      flexible->advance(
        {{in_chord(unbalanced[FlexibleAxle::own]), in_chord(unbalanced[FlexibleAxle::other])}},
        {{dot(tilted_axle(FlexibleAxle::own), on_wheels[FlexibleAxle::own]),
          dot(tilted_axle(FlexibleAxle::other), on_wheels[FlexibleAxle::other])}},
        in_chord((1. / time_step) * (tilting() - tilting_before)), inertia_of_wheel(), time_step);
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
    present = guidance == Guidance::rigid && !rolls() ? present : frame(motion.yaw, motion.roll);
  }


  Vector3 WheelHub::position_of(const Vector3 arm, const std::array<Turn, 2> &turns) const
  {
    if (!flexible)
      return middle() + turned(arm, turns[FlexibleAxle::own]);
    const auto    side = dot(reference.y, arm) > 0. ? FlexibleAxle::own : FlexibleAxle::other;
    const Vector3 from = middle_of(side), way = middle() + turned(arm, turns[side]) - from;
    const Vector3 tilt = in_space(flexible->tilt(side));
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
                              in_space(flexible->tilt_rate(side)),
                            x - middle_of(side));
  }


  double WheelHub::kinetic_energy(const double time_back) const
  {
    const Vector3 moments =
      turned(reference_first_moment, Turn(motion.angle - time_back * motion.angular_velocity));
    const double in_plane = motion.velocity_x * motion.velocity_x + motion.velocity_y * motion.velocity_y;
    return 0.5 * (parameters.mass * in_plane + mass_up() * motion.velocity_z * motion.velocity_z) +
           motion.angular_velocity * dot(velocity(), cross(axle(), moments)) +
           0.5 * parameters.moment_of_inertia * motion.angular_velocity * motion.angular_velocity +
           0.5 * parameters.yaw_inertia * motion.yaw_rate * motion.yaw_rate +
           (rolls() ? 0.5 * roll_inertia() * motion.roll_rate * motion.roll_rate : 0.) +
           (flexible ? flexible->kinetic_energy(in_chord(tilting()), inertia_of_wheel()) : 0.);
  }


  void WheelHub::serialize(Archive &archive)
  {
    archive.same(drive, drive_torque, motion, companions, reference, present, reference_x, reference_y,
                 reference_z, equilibrium_z, work, gross, guidance, guidance_time, lateral_guidance, springs,
                 released_yaw);
    if (flexible)
      flexible->serialize(archive);
  }
} // namespace tread
