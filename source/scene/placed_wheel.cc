// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/geometry/contact_points.h>
#include <tread/mesh/profile_block.h>
#include <tread/scene/placed_wheel.h>
#include <tread/scene/wheelset_case.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace tread
{
  namespace
  {
    Vector3 vector(const Vector3d &v)
    {
      return Vector3{v[0], v[1], v[2], 0.};
    }

    const WheelPatch &most_loaded(const std::vector<WheelPatch> &patches)
    {
      return *std::max_element(patches.begin(), patches.end(), [](const WheelPatch &a, const WheelPatch &b) {
        return a.solution.normal_force < b.solution.normal_force;
      });
    }
  } // namespace


  namespace
  {
    /// Refuses a wheel whose other wheel, on the same axle at the given roll, stands deep in its rail. What a
    /// roll that is a few milliradians off lets it sink in is no error: only this wheel's rail carries.
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
  } // namespace


  std::vector<PlacedWheel::Side> PlacedWheel::solve(const Scene            &scene,
                                                    const WheelOnRail      &surfaces,
                                                    const WheelsetPosition &position,
                                                    const WheelRolling     &rolling)
  {
    const double load = scene.static_load();
    try
      {
        if (!scene.wheelset.both_wheels)
          {
            const WheelContact own = contact_under_load(surfaces, rolling, position, load);
            require_other_wheel_clear(surfaces, own.position);
            return {{own, false}};
          }
        const BothWheels both = contact_of_both_wheels(surfaces, rolling, position, 2. * load);
        return {{both.own, false}, {both.other, true}};
      }
    catch (const std::bad_alloc &)
      {
        throw; // no fault of the input
      }
    catch (const std::exception &error)
      {
        throw InputError(
          format("no half-space answer at 'Wheelset/Lateral shift (mm)' %g, 'Yaw (mrad)' %g and ",
                 1e3 * position.shift, 1e3 * position.yaw) +
          (scene.wheelset.both_wheels ? "a roll that is found: "
                                      : format("'Roll (mrad)' %g: ", 1e3 * position.roll)) +
          error.what());
      }
  }


  WheelContact PlacedWheel::together(const std::vector<Side> &sides)
  {
    WheelContact all = sides.front().contact;
    for (const Side &side : sides)
      if (side.is_mirrored)
        {
          const WheelContact other = of_other_wheel(side.contact);
          all.patches.insert(all.patches.end(), other.patches.begin(), other.patches.end());
          for (unsigned int d = 0; d < 3; ++d)
            all.force[d] += other.force[d];
        }
    return all;
  }


  PlacedWheel::PlacedWheel(const Scene &scene)
    : PlacedWheel(scene, scene.wheelset.position(), wheel_rolling(scene, scene.path_begin()))
  {
  }


  PlacedWheel::PlacedWheel(const Scene &scene, const WheelsetPosition &position, const WheelRolling &rolling)
    : surfaces(scene.wheel_on_rail())
    , sides(solve(scene, surfaces, position, rolling))
    , load(scene.static_load())
    , contact(together(sides))
  {
  }


  const WheelPatch &PlacedWheel::main_patch() const
  {
    return most_loaded(sides.front().contact.patches);
  }


  PlacedWheel::Rise PlacedWheel::rise() const
  {
    const double own = main_patch().rise;
    if (sides.size() == 1)
      return {own, 0.};
    const double other = most_loaded(sides.back().contact.patches).rise;
    // A positive roll rate takes the own side down.
    return {0.5 * (own + other), 0.5 * (other - own) / surfaces.wheel_origin_y()};
  }


  unsigned int PlacedWheel::nearest_patch(const Vector3 place) const
  {
    const auto distance = [&](const WheelPatch &patch) {
      const Vector3 arm = place - origin(patch), across = along(patch);
      const double  y    = std::clamp(dot(arm, across), patch.solution.y_begin, patch.solution.y_end);
      const Vector3 away = arm - y * across;
      return std::hypot(away[1], away[2]);
    };
    return std::min_element(
             patches().begin(), patches().end(),
             [&](const WheelPatch &a, const WheelPatch &b) { return distance(a) < distance(b); }) -
           patches().begin();
  }


  Vector3 PlacedWheel::middle() const
  {
    return vector(WheelOnRail::middle(contact.position, surfaces.radius())) -
           Vector3{0., surfaces.rail_origin_y(), 0., 0.};
  }


  Vector3 PlacedWheel::axle() const
  {
    return vector(WheelOnRail::axle(contact.position));
  }


  Vector3 PlacedWheel::origin(const WheelPatch &patch) const
  {
    return vector(patch.region.reference) - Vector3{0., surfaces.rail_origin_y(), 0., 0.};
  }


  Vector3 PlacedWheel::along(const WheelPatch &patch)
  {
    return vector(patch.along());
  }


  Vector3 PlacedWheel::normal(const WheelPatch &patch)
  {
    return vector(patch.normal());
  }


  ContactNodeState PlacedWheel::in_contact_axes(ContactNodeState state, const double wheel_x) const
  {
    const WheelPatch &patch = patches()[nearest_patch(state.position - Vector3{wheel_x, 0., 0., 0.})];
    const Vector3     s = along(patch), n = normal(patch);
    for (Vector3 *v : {&state.normal, &state.impulse, &state.slip})
      *v = Vector3{(*v)[0], dot(*v, s), dot(*v, n), 0.};
    return state;
  }


  std::vector<ContactNodeState> PlacedWheel::of_patch(const unsigned int                   number,
                                                      const std::vector<ContactNodeState> &states,
                                                      const double                         wheel_x) const
  {
    const WheelPatch             &patch = patches()[number];
    const Vector3                 x{wheel_x, 0., 0., 0.};
    std::vector<ContactNodeState> own;
    for (const ContactNodeState &state : states)
      if (nearest_patch(state.position - x) == number)
        {
          own.push_back(state);
          const Vector3 arm   = state.position - x - origin(patch);
          own.back().position = Vector3{arm[0], dot(arm, along(patch)), dot(arm, normal(patch)), 0.} + x;
        }
    return own;
  }


  Vector3 PlacedWheel::traction_over_pressure(const Vector3 place) const
  {
    const WheelPatch              &patch = patches()[nearest_patch(place)];
    const reference::PlanarResult &s     = patch.solution;
    const Vector3                  arm = place - origin(patch), across = along(patch);
    const double                   x = arm[0], y = dot(arm, across);
    // Outside the patch that of the nearest element on the way to its middle.
    const double       x_middle = 0.5 * (s.x_begin + s.x_end), y_middle = 0.5 * (s.y_begin + s.y_end);
    const unsigned int n_steps =
      std::ceil(std::max(std::abs(x - x_middle) / s.grid.dx, std::abs(y - y_middle) / s.grid.dy));
    for (unsigned int step = n_steps + 1; step-- > 0;)
      {
        const double share  = n_steps > 0 ? double(step) / n_steps : 0.;
        const double column = std::round((x_middle + share * (x - x_middle) - s.grid.x_first) / s.grid.dx),
                     row    = std::round((y_middle + share * (y - y_middle) - s.grid.y_first) / s.grid.dy);
        if (column < 0. || column >= s.grid.n_x || row < 0. || row >= s.grid.n_y)
          continue;
        const std::size_t e = s.grid.n_x * std::size_t(row) + std::size_t(column);
        if (s.pressure[e] > 0.)
          return (1. / s.pressure[e]) * (Vector3{s.shear_x[e], 0., 0., 0.} + s.shear_y[e] * across);
      }
    return Vector3{};
  }


  std::vector<PatchNode> PlacedWheel::table_nodes() const
  {
    std::vector<PatchNode> nodes;
    for (const WheelPatch &patch : patches())
      {
        const reference::PlanarResult &s    = patch.solution;
        const reference::Grid         &grid = s.grid;
        for (std::size_t e = 0; e < grid.size(); ++e)
          if (s.state[e] != reference::ElementState::exterior)
            nodes.push_back({origin(patch) + Vector3{grid.x(e % grid.n_x), 0., 0., 0.} +
                               grid.y(e / grid.n_x) * along(patch),
                             grid.element_area(),
                             s.pressure[e],
                             {s.shear_x[e], s.shear_y[e]},
                             {s.slip_x[e], s.slip_y[e]},
                             s.state[e] == reference::ElementState::adhesion});
      }
    return nodes;
  }


  reference::HertzEllipse PlacedWheel::ellipse(const double vertical_force) const
  {
    // By Hertz all lengths grow like the cube root of the force.
    const reference::PlanarResult &s     = main_patch().solution;
    const double                   scale = std::cbrt(vertical_force / load);
    reference::HertzEllipse        e;
    e.semi_axis_x   = scale * 0.5 * (s.x_end - s.x_begin);
    e.semi_axis_y   = scale * 0.5 * (s.y_end - s.y_begin);
    e.max_pressure  = scale * s.max_pressure;
    e.area          = scale * scale * s.area;
    e.mean_pressure = s.normal_force * scale / s.area;
    e.approach      = scale * scale * s.overlap;
    e.stiffness     = 1.5 * s.normal_force * scale / s.overlap;
    return e;
  }


  namespace
  {
    /// Of finest cells ahead of and behind the path: the patch, a quarter of its half length and two cells,
    /// m.
    double beyond_path(const Scene &scene, const reference::PlanarResult &s)
    {
      return 1.25 * 0.5 * (s.x_end - s.x_begin) + 2. * scene.mesh.finest_cell;
    }

    /// Parameter of a profile at the distance t (m) in a patch's plane from the point at s.
    double parameter_at(const ProfileCurve &profile, const WheelPatch &patch, const double s, const double t)
    {
      const double step = std::copysign(0.05e-3, t), cosine = std::cos(patch.angle()),
                   sine = std::sin(patch.angle());
      double at         = s;
      for (double gone = 0.; std::abs(gone) < std::abs(t) && at >= 0. && at <= profile.length(); at += step)
        {
          const ProfileCurve::Place p = profile.at(at);
          // Where the profile stands steep on the plane a step is worth little.
          gone += step * std::max(0.2, p.dy * cosine + p.dz * sine);
        }
      return at;
    }

    /// By how much the rigid contact moves from where it is at the start, m.
    struct Wandering
    {
      /// Least and largest on one of the bodies, 0 among them.
      struct OnBody
      {
        double x[2] = {0., 0.}, s[2] = {0., 0.};

        void add(const double x_now, const double s_now)
        {
          x[0] = std::min(x[0], x_now);
          x[1] = std::max(x[1], x_now);
          s[0] = std::min(s[0], s_now);
          s[1] = std::max(s[1], s_now);
        }
      };
      OnBody rail, wheel;
    };

    /// @param of_other_wheel whether the other wheel's is asked for, in the axes of its own side
    Wandering wandering(const Scene &scene, const WheelOnRail &surfaces, const bool of_other_wheel)
    {
      Wandering all;
      if (scene.guidance.kind != Guidance::file)
        return all;
      constexpr unsigned int n_instants = 40;
      const double           duration   = scene.motion.meshed_distance() / scene.motion.speed,
                   shift                = scene.wheelset.position().shift;
      std::optional<WheelOnRail::OutlinePoint> first;
      for (unsigned int i = 0; i <= n_instants; ++i)
        {
          const Across              now = scene.across(duration * i / n_instants);
          WheelsetPosition          position{shift + now.y, now.yaw, now.roll, 0.};
          WheelOnRail::OutlinePoint at;
          try
            {
              if (scene.wheelset.both_wheels)
                position = touching_wheelset(surfaces, position).position;
              at = surfaces.nearest(of_other_wheel ? position.mirrored() : position).point;
            }
          catch (const std::runtime_error &error)
            {
              throw InputError(
                format("'Guidance/File', %.4g s after the start, at a lateral shift of %.4g mm: ",
                       duration * i / n_instants, 1e3 * position.shift) +
                error.what());
            }
          if (!first)
            first = at;
          const auto on_rail = [&](const WheelOnRail::OutlinePoint &p) {
            return surfaces.rail().parameter(p.place[1]);
          };
          all.rail.add(at.place[0] - first->place[0], on_rail(at) - on_rail(*first));
          all.wheel.add(surfaces.radius() * (at.angle - first->angle), at.s - first->s);
        }
      return all;
    }

    /// The finest cells at a patch on one of the bodies. @param x_reference of its reference point at the
    /// start
    /// @param s, s_middle parameters of the body's profile there and in the middle of its block
    FineZone zone_of(const Scene             &scene,
                     const WheelPatch        &patch,
                     const ProfileCurve      &profile,
                     const double             x_reference,
                     const double             s,
                     const double             s_middle,
                     const Wandering::OnBody &wanders)
    {
      // Contact that a plane does not stand for may reach farther than in one.
      const double                   wider = 1.1 + 0.3 * patch.turn;
      const reference::PlanarResult &r     = patch.solution;
      const double                   x     = x_reference + 0.5 * (r.x_begin + r.x_end),
                   begin                   = parameter_at(profile, patch, s, r.y_begin),
                   end = parameter_at(profile, patch, s, r.y_end), half_width = 0.5 * (end - begin);
      FineZone zone;
      zone.finest_cell_size = scene.mesh.finest_cell;
      zone.x_begin          = x - beyond_path(scene, r) + wanders.x[0];
      zone.x_end            = x + scene.motion.meshed_distance() + beyond_path(scene, r) + wanders.x[1];
      zone.y_middle         = 0.5 * (begin + end + wanders.s[0] + wanders.s[1]) - s_middle;
      zone.half_width = std::max(scene.mesh.fine_half_width, wider * half_width + scene.mesh.finest_cell +
                                                               0.5 * (wanders.s[1] - wanders.s[0]));
      zone.depth      = scene.mesh.fine_layers * zone.finest_cell_size;
      zone.cells_per_level = scene.mesh.cells_per_level;
      zone.level_depth     = scene.mesh.level_depth * std::sqrt(half_width * 0.5 * (r.x_end - r.x_begin));
      return zone;
    }

    /// The middle of a body's block lies between the patches, its base at right angles to the mean of their
    /// normals.
    struct Middle
    {
      double s, inclination;
    };
    template <typename ParameterOf>
    Middle middle_of(const std::vector<WheelPatch> &patches, const ParameterOf &parameter_of)
    {
      double s[2] = {1e300, -1e300}, angle[2] = {1e300, -1e300};
      for (const WheelPatch &patch : patches)
        {
          s[0]     = std::min(s[0], parameter_of(patch));
          s[1]     = std::max(s[1], parameter_of(patch));
          angle[0] = std::min(angle[0], patch.angle());
          angle[1] = std::max(angle[1], patch.angle());
        }
      return {0.5 * (s[0] + s[1]), 0.5 * (angle[0] + angle[1])};
    }
  } // namespace


  namespace
  {
    /// @throws InputError unless a body has its profile wherever cells are finest.
    void require_on_profile(const ProfileSection        &section,
                            const std::vector<FineZone> &zones,
                            const std::string           &parameter,
                            const bool                   wanders)
    {
      for (const FineZone &zone : zones)
        require(zone.y_middle - zone.half_width >= section.begin() &&
                  zone.y_middle + zone.half_width <= section.end(),
                "a patch lies where the profile of '" + parameter +
                  "' ends, or stands steeper than 70 degrees on the block that is meshed behind it: its "
                  "finest cells reach "
                  "from " +
                  text_in_mm(zone.y_middle - zone.half_width) + " to " +
                  text_in_mm(zone.y_middle + zone.half_width) + " mm along the surface, the profile from " +
                  text_in_mm(section.begin()) + " to " + text_in_mm(section.end()) +
                  " mm: change 'Mesh/Fine half width (mm)', 'Wheel/Sector width (mm)' or the position" +
                  (wanders ? ", or how far 'Guidance/File' moves the contact" : ""));
    }
  } // namespace


  std::function<dealii::Point<3>(const Vector3d &)> PlacedWheel::from_track(const bool is_mirrored) const
  {
    return [origin = surfaces.rail_origin_y(), sign = is_mirrored ? -1. : 1.](const Vector3d &p) {
      return dealii::Point<3>(p[0], sign * p[1] - origin, p[2]);
    };
  }


  Body PlacedWheel::of_sides(const std::string &name, const std::function<Body(const Side &)> &make) const
  {
    try
      {
        Body body = make(sides.front());
        if (sides.size() > 1)
          body = join(body, make(sides.back()));
        body.name = name;
        return body;
      }
    catch (const std::invalid_argument &error) // of the mesh
      {
        throw InputError(
          name + ": " + error.what() +
          "; change 'Mesh/Fine half width (mm)' or 'Fine layers', 'Wheel/Sector width (mm)' or "
          "'Sector thickness (mm)', which rail and wheel share");
      }
  }


  Body PlacedWheel::make_rail(const Scene &scene) const
  {
    return of_sides("rail", [&](const Side &side) { return rail_of(scene, side); });
  }


  Body PlacedWheel::make_wheel(const Scene &scene) const
  {
    return of_sides("wheel", [&](const Side &side) { return wheel_of(scene, side); });
  }


  Body PlacedWheel::rail_of(const Scene &scene, const Side &side) const
  {
    const std::vector<WheelPatch> &patches = side.contact.patches;
    const ProfileCurve             profile = surfaces.rail().curve().moved(-surfaces.rail_origin_y(), 0.);
    const auto                     parameter_of = [&](const WheelPatch &patch) {
      return surfaces.rail().parameter(patch.region.reference[1]);
    };
    const Middle          middle = middle_of(patches, parameter_of);
    const ProfileSection  section(profile, middle.s, middle.inclination, ProfileSection::Side::below,
                                  scene.wheel.sector_thickness, scene.wheel.half_width());
    const Wandering       wanders = wandering(scene, surfaces, side.is_mirrored);
    std::vector<FineZone> zones;
    for (const WheelPatch &patch : patches)
      zones.push_back(zone_of(scene, patch, profile, scene.path_begin() + patch.region.reference[0],
                              parameter_of(patch), middle.s, wanders.rail));
    require_on_profile(section, zones,
                       scene.rail.measured_head.empty() ? "Rail/Profile" : "Rail/Measured head",
                       scene.guidance.kind == Guidance::file);
    return make_profile_block(section, scene.rail_begin(), scene.rail_end(), scene.mesh.coarsest_cell, zones,
                              side.is_mirrored,
                              [in_mesh = from_track(side.is_mirrored),
                               origin  = surfaces.rail_origin_y()](const double x, const dealii::Point<2> p) {
                                return in_mesh({x, p[0] + origin, p[1]});
                              });
  }


  Body PlacedWheel::wheel_of(const Scene &scene, const Side &side) const
  {
    const std::vector<WheelPatch> &patches = side.contact.patches;
    const ProfileCurve            &profile = surfaces.wheel();
    const Middle         middle = middle_of(patches, [](const WheelPatch &patch) { return patch.wheel_s; });
    const ProfileSection section(profile, middle.s, middle.inclination, ProfileSection::Side::above,
                                 scene.wheel.sector_thickness, scene.wheel.half_width());
    // Along the tread arcs have the length that they have on the circle through the middle.
    const double          radius  = surfaces.radius() - profile.at(middle.s).z;
    const Wandering       wanders = wandering(scene, surfaces, side.is_mirrored);
    std::vector<FineZone> zones;
    double                begin = 1e300, end = -1e300;
    for (const WheelPatch &patch : patches)
      {
        const double arc = radius * patch.wheel_angle;
        zones.push_back(zone_of(scene, patch, profile, arc, patch.wheel_s, middle.s, wanders.wheel));
        begin = std::min(begin, arc + wanders.wheel.x[0]);
        end   = std::max(end, arc + wanders.wheel.x[1]);
      }
    require_on_profile(section, zones, "Wheel/Tread profile", scene.guidance.kind == Guidance::file);
    const double margin = scene.wheel.sector_margin, x_start = scene.path_begin();
    return make_profile_block(section, begin - margin, end + scene.motion.meshed_distance() + margin,
                              scene.mesh.coarsest_cell, zones, !side.is_mirrored,
                              [in_mesh = from_track(side.is_mirrored), surfaces = surfaces,
                               position = side.contact.position, radius,
                               x_start](const double arc, const dealii::Point<2> p) {
                                const Vector3d q = surfaces.place(position, p[0], p[1], arc / radius);
                                return in_mesh({q[0] + x_start, q[1], q[2]});
                              });
  }


  PlacedWheel::Place PlacedWheel::place_in_rail(const dealii::Point<3> &p, const WheelPatch &patch) const
  {
    const Vector3 arm = Vector3{p[0], p[1], p[2], 0.} - origin(patch);
    return {arm[0], dot(arm, along(patch)), -dot(arm, normal(patch))};
  }


  PlacedWheel::Place PlacedWheel::place_in_wheel(const dealii::Point<3> &p,
                                                 const WheelPatch       &patch,
                                                 const double            start_x) const
  {
    // The meridian through the point, turned about the axle to that of the patch.
    const Vector3 a = axle(), arm = Vector3{p[0] - start_x, p[1], p[2], 0.} - middle(),
                  of_patch = origin(patch) - middle();
    const Vector3 off = arm - dot(a, arm) * a, patch_off = of_patch - dot(a, of_patch) * a;
    const double  angle  = std::atan2(-dot(a, cross(patch_off, off)), dot(patch_off, off));
    const Vector3 turned = dot(a, arm) * a + (norm(off) / norm(patch_off)) * patch_off;
    const Vector3 from   = turned - of_patch;
    return {angle * patch.rolling_radius, dot(from, along(patch)), dot(from, normal(patch))};
  }
} // namespace tread
