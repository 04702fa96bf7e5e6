// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/wheelset_contact.h>
#include <tread/base/format.h>
#include <tread/geometry/contact_points.h>
#include <tread/geometry/patch_surfaces.h>
#include <tread/reference/errors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <optional>
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

    /// Where a patch can lie in its plane, from the reference point.
    using Range = WheelOnRail::Region::Box;

    /// All of the overlap.
    Range range_of_overlap(const WheelOnRail         &surfaces,
                           const WheelsetPosition    &position,
                           const WheelOnRail::Region &region,
                           const PatchSurfaces       &heights)
    {
      if (region.box)
        return *region.box;
      Range                  range;
      constexpr unsigned int n = 200;
      for (unsigned int i = 0; i <= n; ++i)
        {
          const double s     = region.s_begin + (region.s_end - region.s_begin) * i / n;
          const auto   point = surfaces.outline(position, s);
          if (!point)
            continue;
          const double x = point->place[0] - region.reference[0], along = heights.along(point->place);
          range.s_low  = std::min(range.s_low, along);
          range.s_high = std::max(range.s_high, along);
          // Along x the wheel's surface has the curvature cos(angle)/r.
          const double radius  = (surfaces.radius() - surfaces.wheel().at(s).z) / std::cos(region.angle);
          const double overlap = heights.rail(0., along).height - heights.above(point->place);
          const double half    = std::sqrt(2. * radius * std::max(0., overlap));
          range.x_low          = std::min(range.x_low, x - half);
          range.x_high         = std::max(range.x_high, x + half);
        }
      return range;
    }

    /// Elements over the range, one of them centred on the reference point.
    reference::Grid grid_over(const WheelRolling &rolling, const Range &range)
    {
      // The patch is about 0.7 times as long and as wide as the overlap: 60 elements along, 40 across.
      const double dx  = rolling.element_x > 0. ? rolling.element_x : (range.x_high - range.x_low) / 84.,
                   ds  = rolling.element_y > 0. ? rolling.element_y : (range.s_high - range.s_low) / 56.;
      const auto cells = [](const double length, const double size) {
        return static_cast<unsigned int>(std::ceil(length / size)) + 1;
      };
      const unsigned int before_x = cells(-range.x_low, dx), before_s = cells(-range.s_low, ds);
      reference::Grid    grid;
      grid.dx      = dx;
      grid.dy      = ds;
      grid.n_x     = before_x + cells(range.x_high, dx) + 1;
      grid.n_y     = before_s + cells(range.s_high, ds) + 1;
      grid.x_first = -(before_x * dx);
      grid.y_first = -(before_s * ds);
      return grid;
    }

    /// The solution on a grid that holds the patch. @throws std::runtime_error where the patch reaches the
    /// end of a profile
    reference::PlanarResult solve_within(reference::PlanarCase c,
                                         const PatchSurfaces  &heights,
                                         const WheelRolling   &rolling,
                                         Range                 range)
    {
      constexpr unsigned int  most_turns = 4;
      constexpr double        wider      = 1.3;
      reference::PlanarResult result;
      for (unsigned int turn = 1;; ++turn)
        try
          {
            c.grid = grid_over(rolling, range);
            result = reference::solve_planar(c);
            break;
          }
        catch (const reference::ReachesBorder &)
          {
            if (turn == most_turns)
              throw;
            for (double *end : {&range.x_low, &range.x_high, &range.s_low, &range.s_high})
              *end *= wider;
          }
      const reference::Grid &grid     = result.grid;
      const auto             is_empty = [&](const std::size_t e) {
        return result.state[e] == reference::ElementState::exterior;
      };
      for (unsigned int j = 1; j + 1 < grid.n_y; ++j)
        for (unsigned int i = 0; i < grid.n_x; ++i)
          for (const unsigned int beside : {j - 1, j + 1})
            if (!is_empty(j * grid.n_x + i) && is_empty(beside * grid.n_x + i))
              if (const double x = grid.x(i), s = grid.y(beside); !heights.exists(x, s))
                throw std::runtime_error(std::string("contact reaches the end of the profile of the ") +
                                         (heights.rail(x, s).exists ? "wheel" : "rail") +
                                         ", beyond which nothing is known of it");
      if (!heights.is_constant())
        for (unsigned int j = 0; j < grid.n_y; ++j)
          for (unsigned int i = 1; i + 1 < grid.n_x; ++i)
            for (const unsigned int beside : {i - 1, i + 1})
              if (!is_empty(j * grid.n_x + i) && is_empty(j * grid.n_x + beside) &&
                  heights.is_beyond_end(grid.x(beside)))
                throw std::runtime_error("contact reaches the end of the rail's slices, beyond which nothing "
                                         "is known of it");
      return result;
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
      const PatchSurfaces     heights(surfaces, position, region);
      patch.region = region;

      // Velocity of the wheel's undeformed surface on the normal of the reference point; the rail is at rest.
      const PatchSurfaces::WheelPlace at_reference = heights.wheel(0., 0.);
      const double                    at_origin = at_reference.height, wheel_s = at_reference.profile_s,
                   wheel_angle = at_reference.angle;
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
      const double V                     = rolling.speed - 0.5 * velocity[0];
      patch.wheel_s                      = wheel_s;
      patch.wheel_angle                  = wheel_angle;
      const ProfileCurve::Place on_wheel = surfaces.wheel().at(wheel_s);
      patch.rolling_radius               = surfaces.radius() - on_wheel.z +
                             surfaces.wheel_surface().deviation(wheel_angle - position.pitch, on_wheel.y).dz;
      patch.rolling_speed    = V;
      patch.creepage         = velocity[0] / V;
      patch.lateral_creepage = dot(velocity, heights.along()) / V;
      patch.spin             = dot(turning, normal) / V;

      reference::PlanarCase c;
      c.gap = [&heights](const double x, const double s) {
        return heights.gap(x, s);
      };
      static_cast<reference::Friction &>(c) = rolling.friction_along
                                                ? rolling.friction_along(region.reference[0] + straight.ahead)
                                                : reference::Friction(rolling);
      if (rolling.factor_across)
        c.place_factor = [&, c_ = std::cos(region.angle), s_ = std::sin(region.angle)](const double x,
                                                                                       const double s) {
          const PatchSurfaces::RailPlace place = heights.rail(x, s);
          return rolling.factor_across(
            region.reference[1] + s * c_ - place.height * s_ - surfaces.rail_origin_y(), place.angle);
        };
      c.speed        = V;
      c.longitudinal = patch.creepage;
      c.lateral      = patch.lateral_creepage;
      c.spin         = patch.spin;
      c.wheel        = rolling.wheel;
      c.rail         = rolling.rail;
      c.order        = rolling.order;
      if (rolling.slip_follows_surface)
        c.more_slip = [&heights, at_origin, by_x = turning[0] / V, by_s = dot(turning, heights.along()) / V](
                        const double, const double s) -> std::array<double, 2> {
          const double height = heights.wheel(0., s).height - at_origin;
          return {by_s * height, -by_x * height};
        };
      patch.solution =
        solve_within(c, heights, rolling, range_of_overlap(surfaces, position, region, heights));
      patch.region.overlap = patch.solution.overlap;
      patch.wheel_radius   = surfaces.wheel().radius(wheel_s);
      patch.rail_radius    = heights.rail_radius();
      patch.turn           = std::abs(heights.rail(0., patch.solution.y_end).angle -
                                      heights.rail(0., patch.solution.y_begin).angle);
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


  std::vector<PatchNode> elements_in_contact(const WheelPatch &patch)
  {
    std::vector<PatchNode>         nodes;
    const reference::PlanarResult &s    = patch.solution;
    const reference::Grid         &grid = s.grid;
    for (std::size_t e = 0; e < grid.size(); ++e)
      if (s.state[e] != reference::ElementState::exterior)
        nodes.push_back({Vector3{grid.x(e % grid.n_x), grid.y(e / grid.n_x), 0., 0.},
                         grid.element_area(),
                         s.pressure[e],
                         {s.shear_x[e], s.shear_y[e]},
                         {s.slip_x[e], s.slip_y[e]},
                         s.state[e] == reference::ElementState::adhesion});
    return nodes;
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
        contact.patches.back().body = surfaces.rail_surface().body(
          position.along + region.reference[0], region.reference[1] - surfaces.rail_origin_y());
        const Vector3d force = contact.patches.back().force();
        for (unsigned int d = 0; d < 3; ++d)
          contact.force[d] += force[d];
      }
    add_sink_by_others(contact.patches, reference::combine(rolling.wheel, rolling.rail));
    return contact;
  }


  void require_other_wheel_clear(const WheelOnRail &surfaces, const WheelsetPosition &position)
  {
    constexpr double deepest = 6e-3; // m, 4 mrad of roll
    double           gap     = 0.;
    try
      {
        gap = surfaces.nearest(position.mirrored()).gap;
      }
    catch (const std::runtime_error &error)
      {
        throw std::runtime_error(std::string("the wheelset's other wheel: ") + error.what());
      }
    if (gap < -deepest)
      throw std::runtime_error(
        format("the wheelset's other wheel would stand %.1f mm deep in its rail there: no track lets a "
               "wheelset go so far to this side, or the roll is another one",
               -1e3 * gap));
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


  namespace
  {
    /// Seeks the depth below touching at which a wheel carries a load. A depth without an answer shortens the
    /// step that led to it.
    class DepthSearch
    {
    public:
      /// @param load N; @param first depth, m
      DepthSearch(const double load, const double first)
        : load(load)
        , wanted(linear(load))
        , next(first)
        , value_before(-wanted)
      {
      }

      double depth() const
      {
        return next;
      }
      bool goes_on() const
      {
        return !found && turns < most && failures_in_a_row < most_failures && next < deepest && !is_at_jump();
      }
      const std::optional<WheelContact> &answer() const
      {
        return found;
      }
      /// Whether the force is too small on one side of a depth and too large on the other.
      bool is_at_jump() const
      {
        return low > 0. && high < deepest && high - low < same_depth;
      }
      /// Why there was no answer at the last depth without one.
      const std::string &reason() const
      {
        return why;
      }

      void add(WheelContact contact)
      {
        ++turns;
        failures_in_a_row  = 0;
        contact.turns      = turns;
        const double force = contact.force[2];
        const double error = std::abs(force - load);
        if (!best || error < std::abs(best->force[2] - load))
          best = contact;
        const double value        = linear(force) - wanted;
        (value < 0. ? low : high) = next;
        if (error <= tolerance * load)
          found = contact;
        // Elements come and go: what jumps by less than this is the same answer.
        else if (is_at_jump() && std::abs(best->force[2] - load) <= small_jump * load)
          found = best;
        // The secant through the last two, where it stays between the bounds.
        double then = value == value_before ? high : next - value * (next - before) / (value - value_before);
        if (!(then > low && then < high) || stays_at_one_end())
          then = high < deepest ? 0.5 * (low + high) : 2. * next;
        before       = next;
        value_before = value;
        next         = then;
      }

      void add_failure(const std::string &reason)
      {
        ++turns;
        // Shares of the step, then depths beside it: what fails may be a single one.
        constexpr std::array<double, most_failures> shares{{0.5, 0.75, 0.25, 0.9, 0.1, 1.05, 1.2, 0.02}};
        if (failures_in_a_row == 0)
          tried = next;
        why  = reason;
        next = before + shares[failures_in_a_row++] * (tried - before);
      }

    private:
      /// By Hertz the force grows with the power 3/2 of the approach: its power 2/3 is next to linear in it.
      static double linear(const double force)
      {
        return std::copysign(std::pow(std::abs(force), 2. / 3.), force);
      }

      /// Whether one bound has come nearer for several turns in a row by little: bisection is faster then.
      bool stays_at_one_end()
      {
        constexpr unsigned int patience = 3;
        const double           width    = high - low;
        slow                            = high < deepest && width > 0.5 * width_before ? slow + 1 : 0;
        width_before                    = width;
        return slow >= patience;
      }

      static constexpr double       tolerance = 1e-6, small_jump = 1e-4; // of the load
      static constexpr unsigned int most = 80, most_failures = 8;
      static constexpr double       deepest = 3e-3, same_depth = 1e-12; // m

      const double                load, wanted;
      double                      next;                     ///< depth, m
      double                      low = 0., high = deepest; ///< depths that carry too little, and too much
      double                      before = 0., value_before, tried = 0., width_before = deepest;
      unsigned int                turns = 0, failures_in_a_row = 0, slow = 0;
      std::optional<WheelContact> best, found;
      std::string                 why;
    };
  } // namespace


  WheelContact contact_under_load(const WheelOnRail  &surfaces,
                                  const WheelRolling &rolling,
                                  WheelsetPosition    position,
                                  const double        load)
  {
    position.height = 0.;
    const WheelOnRail::Nearest touch =
      surfaces.nearest(straightened(surfaces, position, rolling.own).position);
    const double first = 20e-6 * std::pow(1e-4 * load, 2. / 3.) / std::cos(touch.inclination);

    // Overlaps that are taken together are solved as one: where they meet, the force may jump over the load.
    // There they are kept apart for a little longer, or else taken together a little sooner.
    WheelRolling apart = rolling;
    for (const double factor : {1., 0.85, 0.7, 0.55, 1.2, 1.5, 2., 3.})
      {
        apart.separation = factor * rolling.separation;
        DepthSearch search(load, first);
        while (search.goes_on())
          {
            position.height = -touch.gap - search.depth();
            try
              {
                search.add(contact_at_height(surfaces, apart, position));
              }
            catch (const std::bad_alloc &)
              {
                throw;
              }
            catch (const reference::FrictionTooSteep &) // at any depth
              {
                throw;
              }
            catch (const std::exception &error)
              {
                search.add_failure(error.what());
              }
          }
        if (search.answer())
          return *search.answer();
        if (!search.is_at_jump())
          throw std::runtime_error(
            "no height of the wheelset is found at which the wheel carries " + text_of(1e-3 * load) + " kN" +
            (search.reason().empty() ? "" : " (the last one that was tried: " + search.reason() + ")"));
      }
    throw std::runtime_error("no height of the wheelset is found at which the wheel carries " +
                             text_of(1e-3 * load) + " kN: there its force jumps");
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
