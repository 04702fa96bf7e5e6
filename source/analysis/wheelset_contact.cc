// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/wheelset_contact.h>
#include <tread/base/format.h>
#include <tread/geometry/contact_points.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tread
{
  namespace
  {
    Vector3d cross(const Vector3d &a, const Vector3d &b)
    {
      return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }

    double dot(const Vector3d &a, const Vector3d &b)
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }

    Vector3d difference(const Vector3d &a, const Vector3d &b)
    {
      return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    }

    /// Wheel and rail as heights over the plane of a patch. One object per thread: it begins each search
    /// where the last one ended.
    class Heights
    {
    public:
      Heights(const WheelOnRail         &surfaces,
              const WheelsetPosition    &position,
              const WheelOnRail::Region &region)
        : surfaces(surfaces)
        , position(position)
        , origin(region.reference)
        , cosine(std::cos(region.angle))
        , sine(std::sin(region.angle))
        , wheel_s(0.5 * (region.s_begin + region.s_end))
        , wheel_angle(surfaces.outline(position, wheel_s)->angle)
        , rail_s(surfaces.rail().parameter(region.reference[1]))
      {
      }

      Vector3d along() const
      {
        return {0., cosine, sine};
      }
      Vector3d normal() const
      {
        return {0., -sine, cosine};
      }

      /// Position along s of a point of the track.
      double along(const Vector3d &p) const
      {
        return (p[1] - origin[1]) * cosine + (p[2] - origin[2]) * sine;
      }
      double above(const Vector3d &p) const
      {
        return (p[2] - origin[2]) * cosine - (p[1] - origin[1]) * sine;
      }

      /// Height and inclination in the track of the rail at s.
      std::array<double, 2> rail(const double s) const
      {
        const ProfileCurve &curve = surfaces.rail().curve();
        for (unsigned int i = 0; i < 50; ++i)
          {
            const ProfileCurve::Place p     = curve.at(rail_s);
            const double              error = s - ((p.y - origin[1]) * cosine + (p.z - origin[2]) * sine);
            const double              slope = std::max(0.1, p.dy * cosine + p.dz * sine);
            rail_s = std::clamp(rail_s + std::clamp(error / slope, -1e-3, 1e-3), 0., curve.length());
            if (std::abs(error) < 1e-14)
              break;
          }
        const ProfileCurve::Place p = curve.at(rail_s);
        return {(p.z - origin[2]) * cosine - (p.y - origin[1]) * sine, std::atan2(p.dz, p.dy)};
      }

      double wheel(const double x, const double s) const
      {
        double height = 0.;
        for (unsigned int i = 0; i < 50; ++i)
          {
            const WheelOnRail::SurfacePoint p = surfaces.surface(position, wheel_s, wheel_angle);
            height                            = above(p.place);
            const double miss_x = x - (p.place[0] - origin[0]), miss_s = s - along(p.place);
            if (std::abs(miss_x) + std::abs(miss_s) < 1e-13)
              break;
            const double s_by_s      = p.by_s[1] * cosine + p.by_s[2] * sine,
                         s_by_angle  = p.by_angle[1] * cosine + p.by_angle[2] * sine;
            const double determinant = p.by_s[0] * s_by_angle - p.by_angle[0] * s_by_s;
            const double step_s      = (miss_x * s_by_angle - miss_s * p.by_angle[0]) / determinant,
                         step_angle  = (miss_s * p.by_s[0] - miss_x * s_by_s) / determinant;
            constexpr double longest = 2e-3; // m, for profiles with corners
            wheel_s =
              std::clamp(wheel_s + std::clamp(step_s, -longest, longest), 0., surfaces.wheel().length());
            wheel_angle = std::clamp(wheel_angle + step_angle, -0.5, 0.5);
          }
        return height;
      }

      /// The wheel's parameter at the place looked at last.
      double last_wheel_s() const
      {
        return wheel_s;
      }
      double last_wheel_angle() const
      {
        return wheel_angle;
      }

      double gap(const double x, const double s) const
      {
        return wheel(x, s) - rail(s)[0];
      }

    private:
      const WheelOnRail     &surfaces;
      const WheelsetPosition position;
      const Vector3d         origin;
      const double           cosine, sine;
      mutable double         wheel_s, wheel_angle, rail_s;
    };

    /// Elements over all of the overlap, one of them centred on the reference point.
    reference::Grid grid_over(const WheelOnRail         &surfaces,
                              const WheelRolling        &rolling,
                              const WheelsetPosition    &position,
                              const WheelOnRail::Region &region,
                              const Heights             &heights)
    {
      double                 x_low = 0., x_high = 0., s_low = 0., s_high = 0.;
      constexpr unsigned int n = 200;
      for (unsigned int i = 0; i <= n; ++i)
        {
          const double s     = region.s_begin + (region.s_end - region.s_begin) * i / n;
          const auto   point = surfaces.outline(position, s);
          if (!point)
            continue;
          const double x = point->place[0] - region.reference[0], along = heights.along(point->place);
          s_low  = std::min(s_low, along);
          s_high = std::max(s_high, along);
          // Along x the wheel's surface has the curvature cos(angle)/r.
          const double radius = (surfaces.radius() - surfaces.wheel().at(s).z) / std::cos(region.angle);
          const double half   = std::sqrt(2. * radius * std::max(0., -heights.gap(x, along)));
          x_low               = std::min(x_low, x - half);
          x_high              = std::max(x_high, x + half);
        }
      // The patch is about 0.7 times as long and as wide as the overlap: 60 elements along, 40 across.
      const double dx  = rolling.element_x > 0. ? rolling.element_x : (x_high - x_low) / 84.,
                   ds  = rolling.element_y > 0. ? rolling.element_y : (s_high - s_low) / 56.;
      const auto cells = [](const double length, const double size) {
        return static_cast<unsigned int>(std::ceil(length / size)) + 1;
      };
      const unsigned int before_x = cells(-x_low, dx), before_s = cells(-s_low, ds);
      reference::Grid    grid;
      grid.dx      = dx;
      grid.dy      = ds;
      grid.n_x     = before_x + cells(x_high, dx) + 1;
      grid.n_y     = before_s + cells(s_high, ds) + 1;
      grid.x_first = -(before_x * dx);
      grid.y_first = -(before_s * ds);
      return grid;
    }

    /// The wheelset on a straight axle on which a wheel of a flexible one would stand as it does.
    struct Straightened
    {
      WheelsetPosition position;
      double           ahead; ///< of the middle of the other, m
    };
    Straightened straightened(const WheelOnRail                &surfaces,
                              const WheelsetPosition           &position,
                              const WheelsetRates::AgainstLine &wheel)
    {
      WheelsetPosition straight = position;
      straight.yaw += wheel.tilt_z;
      straight.roll -= wheel.tilt_x;
      const Vector3d before = WheelOnRail::axle(position), after = WheelOnRail::axle(straight);
      straight.shift += surfaces.wheel_origin_y() * (before[1] - after[1]);
      straight.height += surfaces.wheel_origin_y() * (before[2] - after[2]);
      return {straight, surfaces.wheel_origin_y() * (before[0] - after[0])};
    }

    WheelPatch solve_patch(const WheelOnRail         &surfaces,
                           const WheelRolling        &rolling,
                           const Straightened        &straight,
                           const WheelOnRail::Region &region)
    {
      const WheelsetPosition &position = straight.position;
      WheelPatch              patch;
      const Heights           heights(surfaces, position, region);
      patch.region = region;

      // Velocity of the wheel's undeformed surface on the normal of the reference point; the rail is at rest.
      const double at_origin = heights.wheel(0., 0.), wheel_s = heights.last_wheel_s(),
                   wheel_angle = heights.last_wheel_angle();
      const Vector3d axle = WheelOnRail::axle(position), normal = heights.normal();
      Vector3d       arm = difference(region.reference, WheelOnRail::middle(position, surfaces.radius()));
      for (unsigned int d = 0; d < 3; ++d)
        arm[d] += at_origin * normal[d];
      // The motion across the track goes along the surfaces, not into them.
      const Vector3d upright{0., std::sin(position.roll), std::cos(position.roll)},
        horizontal = cross(axle, upright);
      Vector3d frame, tilting, of_wheel, turning; // rad/s
      Vector3d arm_of_wheel = arm;
      for (unsigned int d = 0; d < 3; ++d)
        {
          frame[d]    = rolling.yaw_rate * upright[d];
          tilting[d]  = rolling.own.tilt_rate_x * horizontal[d] + rolling.own.tilt_rate_z * upright[d];
          of_wheel[d] = (rolling.angular_velocity + rolling.own.spin) * axle[d];
          arm_of_wheel[d] -= surfaces.wheel_origin_y() * axle[d];
        }
      frame[0] -= rolling.roll_rate;
      const Vector3d by_frame = cross(frame, arm), by_tilting = cross(tilting, arm_of_wheel),
                     by_turning = cross(of_wheel, arm);
      Vector3d across, velocity;
      for (unsigned int d = 0; d < 3; ++d)
        {
          across[d]  = by_frame[d] + by_tilting[d] + (d == 1 ? rolling.across_speed : 0.);
          turning[d] = of_wheel[d] + frame[d] + tilting[d];
        }
      patch.rise = -dot(across, normal) / normal[2];
      for (unsigned int d = 0; d < 3; ++d)
        velocity[d] = by_turning[d] + across[d];
      velocity[0] += rolling.speed;
      velocity[1] += rolling.lateral_speed;
      velocity[2] += patch.rise;
      const double V         = rolling.speed - 0.5 * velocity[0];
      patch.wheel_s          = wheel_s;
      patch.wheel_angle      = wheel_angle;
      patch.rolling_radius   = surfaces.radius() - surfaces.wheel().at(wheel_s).z;
      patch.rolling_speed    = V;
      patch.creepage         = velocity[0] / V;
      patch.lateral_creepage = dot(velocity, heights.along()) / V;
      patch.spin             = dot(turning, normal) / V;

      reference::PlanarCase c;
      c.grid = grid_over(surfaces, rolling, position, region, heights);
      c.gap  = [&heights](const double x, const double s) {
        return heights.gap(x, s);
      };
      static_cast<reference::Friction &>(c) = rolling.friction_along
                                                ? rolling.friction_along(region.reference[0] + straight.ahead)
                                                : reference::Friction(rolling);
      c.speed                               = V;
      c.longitudinal                        = patch.creepage;
      c.lateral                             = patch.lateral_creepage;
      c.spin                                = patch.spin;
      c.wheel                               = rolling.wheel;
      c.rail                                = rolling.rail;
      c.order                               = rolling.order;
      if (rolling.slip_follows_surface)
        c.more_slip = [&heights, at_origin, by_x = turning[0] / V, by_s = dot(turning, heights.along()) / V](
                        const double, const double s) -> std::array<double, 2> {
          const double height = heights.wheel(0., s) - at_origin;
          return {by_s * height, -by_x * height};
        };
      patch.solution       = reference::solve_planar(c);
      patch.region.overlap = patch.solution.overlap;
      patch.wheel_radius   = surfaces.wheel().radius(wheel_s);
      patch.rail_radius    = surfaces.rail().curve().radius(surfaces.rail().parameter(region.reference[1]));
      patch.turn = std::abs(heights.rail(patch.solution.y_end)[1] - heights.rail(patch.solution.y_begin)[1]);
      return patch;
    }
  } // namespace


  Vector3d WheelPatch::along() const
  {
    return {0., (is_of_other_wheel ? -1. : 1.) * std::cos(region.angle), std::sin(region.angle)};
  }


  Vector3d WheelPatch::normal() const
  {
    return {0., (is_of_other_wheel ? 1. : -1.) * std::sin(region.angle), std::cos(region.angle)};
  }


  Vector3d WheelPatch::force() const
  {
    const Vector3d s = along(), n = normal();
    return {solution.longitudinal_force, s[1] * solution.lateral_force + n[1] * solution.normal_force,
            s[2] * solution.lateral_force + n[2] * solution.normal_force};
  }


  namespace
  {
    /// WheelPatch::sink_by_others of all patches (Boussinesq 1885, Johnson 1985, eq. 3.19).
    void add_sink_by_others(std::vector<WheelPatch> &patches, const reference::ElasticPair &pair)
    {
      const double compliance = (1. - pair.poisson) / (dealii::numbers::PI * pair.shear);
      for (WheelPatch &patch : patches)
        for (const WheelPatch &other : patches)
          if (&other != &patch)
            {
              const double distance = std::hypot(patch.region.reference[1] - other.region.reference[1],
                                                 patch.region.reference[2] - other.region.reference[2],
                                                 patch.region.reference[0] - other.region.reference[0]);
              patch.sink_by_others += compliance * other.solution.normal_force *
                                      std::max(0., std::cos(patch.angle() - other.angle())) / distance;
            }
    }
  } // namespace


  WheelContact contact_at_height(const WheelOnRail      &surfaces,
                                 const WheelRolling     &rolling,
                                 const WheelsetPosition &position)
  {
    WheelContact contact;
    contact.position            = position;
    contact.turns               = 1;
    const Straightened straight = straightened(surfaces, position, rolling.own);
    for (const WheelOnRail::Region &region : surfaces.overlaps(straight.position, rolling.separation))
      {
        contact.patches.push_back(solve_patch(surfaces, rolling, straight, region));
        contact.patches.back().region.reference[0] += straight.ahead;
        const Vector3d force = contact.patches.back().force();
        for (unsigned int d = 0; d < 3; ++d)
          contact.force[d] += force[d];
      }
    add_sink_by_others(contact.patches, reference::combine(rolling.wheel, rolling.rail));
    return contact;
  }


  std::vector<std::string> climbing_patches(const WheelOnRail             &surfaces,
                                            const std::vector<WheelPatch> &patches)
  {
    std::vector<std::string> lines;
    for (std::size_t k = 0; k < patches.size(); ++k)
      if (surfaces.is_beyond_flank(patches[k].wheel_s))
        lines.push_back(format("patch %u lies between the steepest part of the flange and its tip: the wheel "
                               "climbs out of the track; lower 'Wheelset/Lateral shift (mm)'",
                               static_cast<unsigned int>(k + 1)));
    return lines;
  }


  WheelContact contact_under_load(const WheelOnRail  &surfaces,
                                  const WheelRolling &rolling,
                                  WheelsetPosition    position,
                                  const double        load)
  {
    // By Hertz the force grows with the power 3/2 of the approach: its power 2/3 is next to linear in the
    // height.
    constexpr double   tolerance = 1e-6; // of the load
    constexpr unsigned most      = 40;
    constexpr double   deepest   = 3e-3; // m
    const auto         linear    = [](const double force) {
      return std::copysign(std::pow(std::abs(force), 2. / 3.), force);
    };
    position.height = 0.;
    const WheelOnRail::Nearest touch =
      surfaces.nearest(straightened(surfaces, position, rolling.own).position);
    const double inclination = std::atan(surfaces.rail().slope(touch.point.place[1]));
    const double wanted      = linear(load);
    double       low = 0., high = deepest; // depths below touching that carry too little, and too much
    double       before = 0., value_before = -wanted;
    double       depth = 20e-6 * std::pow(1e-4 * load, 2. / 3.) / std::cos(inclination);
    for (unsigned int turn = 1; turn <= most && depth < deepest; ++turn)
      {
        position.height      = -touch.gap - depth;
        WheelContact contact = contact_at_height(surfaces, rolling, position);
        contact.turns        = turn;
        if (std::abs(contact.force[2] - load) <= tolerance * load)
          return contact;
        const double value        = linear(contact.force[2]) - wanted;
        (value < 0. ? low : high) = depth;
        // The secant through the last two, where it stays between the bounds.
        double next =
          value == value_before ? high : depth - value * (depth - before) / (value - value_before);
        if (!(next > low && next < high))
          next = high < deepest ? 0.5 * (low + high) : 2. * depth;
        before       = depth;
        value_before = value;
        depth        = next;
      }
    throw std::runtime_error("no height of the wheelset is found at which the wheel carries " +
                             text_of(1e-3 * load) + " kN");
  }


  WheelRolling WheelRolling::mirrored() const
  {
    WheelRolling other                  = *this;
    static_cast<WheelsetRates &>(other) = WheelsetRates::mirrored();
    other.lateral_speed                 = 0. - lateral_speed;
    return other;
  }


  WheelContact of_other_wheel(const WheelContact &mirrored)
  {
    WheelContact contact = mirrored;
    contact.position     = mirrored.position.mirrored();
    contact.force[1]     = 0. - mirrored.force[1];
    for (WheelPatch &patch : contact.patches)
      {
        patch.is_of_other_wheel   = true;
        patch.region.reference[1] = 0. - patch.region.reference[1];
      }
    return contact;
  }


  namespace
  {
    /// Moment of all forces about the middle of the axle that pushes the side of this wheel down, N m.
    double roll_moment(const WheelOnRail &surfaces, const WheelContact &contact)
    {
      const Vector3d middle = WheelOnRail::middle(contact.position, surfaces.radius());
      double         moment = 0.;
      for (const WheelPatch &patch : contact.patches)
        moment -= cross(difference(patch.region.reference, middle), patch.force())[0];
      return moment;
    }
  } // namespace


  BothWheels contact_of_both_wheels(const WheelOnRail  &surfaces,
                                    const WheelRolling &rolling,
                                    WheelsetPosition    position,
                                    const double        load)
  {
    // Both wheels give their height for a load and a roll; the roll that makes the heights equal follows from
    // the rigid contacts' distance but for the inclinations, and so does the shift of load that balances.
    constexpr double       height_tolerance = 1e-9, share_tolerance = 1e-5; // m, of the load
    constexpr unsigned int most  = 30;
    const double           lever = surfaces.wheel_origin_y();
    position.roll                = touching_wheelset(surfaces, position).position.roll;
    double shifted               = 0.; // load from the other to the own wheel
    for (unsigned int turn = 1; turn <= most; ++turn)
      {
        BothWheels both{
          contact_under_load(surfaces, rolling, position, 0.5 * load + shifted),
          contact_under_load(surfaces, rolling.mirrored(), position.mirrored(), 0.5 * load - shifted)};
        const double higher = both.other.position.height - both.own.position.height;
        const double moment = roll_moment(surfaces, both.own) - roll_moment(surfaces, both.other);
        if (std::abs(higher) <= height_tolerance && std::abs(moment) <= share_tolerance * load * lever)
          {
            both.own.turns += both.other.turns;
            return both;
          }
        position.roll += 0.5 * higher / lever;
        shifted += 0.5 * moment / lever;
        if (std::abs(shifted) >= 0.5 * load)
          break;
      }
    throw std::runtime_error("no roll of the wheelset is found at which both wheels carry " +
                             format("%g kN without a moment", 1e-3 * load));
  }
} // namespace tread
