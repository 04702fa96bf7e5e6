// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/scene/parts.h>
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

    /// @throws InputError where wheel and rail do not meet, or no height carries the load.
    std::vector<PlacedWheel::Side> solve_sides(const Scene            &scene,
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
              if (!scene.rail.is_sliced()) // whose other side is not known
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

    /// Of all wheels, in the track axes of the own one.
    WheelContact together(const std::vector<PlacedWheel::Side> &sides)
    {
      WheelContact all = sides.front().contact;
      for (const PlacedWheel::Side &side : sides)
        if (side.is_mirrored)
          {
            const WheelContact other = of_other_wheel(side.contact);
            all.patches.insert(all.patches.end(), other.patches.begin(), other.patches.end());
            for (unsigned int d = 0; d < 3; ++d)
              all.force[d] += other.force[d];
          }
      return all;
    }
  } // namespace


  PlacedWheel::PlacedWheel(const Scene &scene)
    : PlacedWheel(scene, scene.position_at(scene.path_begin()), wheel_rolling(scene, scene.path_begin()))
  {
    if (scene.rail.is_sliced())
      slices = way_over_slices(scene, surfaces);
  }


  PlacedWheel::PlacedWheel(const Scene &scene, const WheelsetPosition &position, const WheelRolling &rolling)
    : surfaces(scene.wheel_on_rail())
    , scene(scene)
    , solved_sides(solve_sides(scene, surfaces, position, rolling))
    , contact(together(solved_sides))
  {
  }


  double PlacedWheel::rolling_radius() const
  {
    // Both wheels have different ones.
    return scene.wheelset.both_wheels ? scene.wheel.radius : main_patch().rolling_radius;
  }


  unsigned int PlacedWheel::n_loads() const
  {
    return scene.wheelset.n_wheels();
  }


  void PlacedWheel::place(WheelHub &hub, const unsigned int) const
  {
    hub.place(Vector3{scene.path_begin(), 0., 0., 0.} + middle(), contact.position.yaw,
              contact.position.roll);
    if (scene.guidance.kind == Guidance::file)
      hub.guidance.follow([this](const double time) { return scene.across(time); });
    else if (scene.guidance.kind == Guidance::springs)
      hub.guidance.release(scene.guidance.springs, hub.motion.yaw);
    if (scene.rail.is_sliced())
      hub.settling.ride([this](const double x) { return slices.curvature(x); });
    hub.motion.angular_velocity = given_angular_velocity(scene);
  }


  double PlacedWheel::factor_across(const Vector3 &place) const
  {
    const auto  &rail = surfaces.rail();
    const double y    = std::clamp(place[1] + surfaces.rail_origin_y(), rail.begin(), rail.end());
    return scene.contact.factor_across(y - surfaces.rail_origin_y(), std::atan(rail.slope(y)));
  }


  std::vector<std::pair<double, double>> PlacedWheel::loaded_lines() const
  {
    std::vector<std::pair<double, double>> lines;
    for (const WheelPatch &patch : patches())
      for (const PatchNode &node : elements_in_contact(patch))
        lines.emplace_back(patch.region.reference[1] + std::cos(patch.angle()) * node.position[1] -
                             surfaces.rail_origin_y(),
                           node.pressure);
    return lines;
  }


  std::vector<WheelStance::Footprint> PlacedWheel::footprints() const
  {
    std::vector<Footprint> all;
    for (const WheelPatch &patch : sides().front().contact.patches)
      {
        const ContactAxes contact_axes = axes(patch);
        const auto        across       = [&](const double s) {
          const Vector3 p = contact_axes.origin + s * contact_axes.along;
          return scene.rail.in_own_axes({p[0], p[1], p[2]})[1];
        };
        const reference::PlanarResult &solution = patch.solution;
        all.push_back({contact_axes.origin[0] + solution.x_begin, contact_axes.origin[0] + solution.x_end,
                       across(solution.y_begin), across(solution.y_end)});
      }
    return all;
  }


  std::vector<WheelStance::Footprint> PlacedWheel::treads() const
  {
    std::vector<Footprint> all;
    const auto             add = [&](const WheelPatch &patch, const double from, const double to) {
      const ProfileCurve::Place      at       = surfaces.wheel().at(patch.wheel_s);
      const reference::PlanarResult &solution = patch.solution;
      const double cosine = at.dy / std::hypot(at.dy, at.dz), arc = scene.wheel.radius * patch.wheel_angle;
      all.push_back({arc + from + solution.x_begin, arc + to + solution.x_end,
                     at.y + cosine * solution.y_begin, at.y + cosine * solution.y_end});
    };
    for (const WheelPatch &patch : sides().front().contact.patches)
      add(patch, 0., slices.pieces.empty() ? scene.motion.meshed_distance() : 0.);
    for (const TouchedPiece &piece : slices.pieces)
      for (const TouchedPiece::Touch &touch : piece.touches)
        add(touch.patch, touch.axle - scene.path_begin(), touch.axle - scene.path_begin());
    return all;
  }


  std::vector<std::pair<std::string, std::vector<Island>>> PlacedWheel::parts_of_patches() const
  {
    std::vector<std::pair<std::string, std::vector<Island>>> parts;
    const auto add = [&](const WheelPatch &patch, const std::string &words) {
      parts.emplace_back(words, islands_of(patch.solution.grid, patch.solution.pressure));
    };
    for (const WheelPatch &patch : patches())
      add(patch, "patch " + std::to_string(parts.size() + 1));
    for (const TouchedPiece &piece : slices.pieces)
      for (const TouchedPiece::Touch &touch : piece.touches)
        add(touch.patch,
            format("the patch at %.1f mm along the slices", 1e3 * scene.position_at(touch.x()).along));
    return parts;
  }


  const WheelPatch &PlacedWheel::main_patch() const
  {
    return most_loaded(solved_sides.front().contact.patches);
  }


  PlacedWheel::Rise PlacedWheel::rise() const
  {
    // On slices the way holds what guidance by a file does, too.
    const double own =
      slices.pieces.empty() ? main_patch().rise : scene.motion.speed * slices.slope(scene.path_begin());
    if (solved_sides.size() == 1)
      return {own, 0.};
    const double other = most_loaded(solved_sides.back().contact.patches).rise;
    // A positive roll rate takes the own side down.
    return {0.5 * (own + other), 0.5 * (other - own) / surfaces.wheel_origin_y()};
  }


  std::optional<double> PlacedWheel::between_pieces() const
  {
    if (slices.pieces.size() != 2 || slices.pieces.front().y_high() >= slices.pieces.back().y_low())
      return {};
    return 0.5 * (slices.pieces.front().y_high() + slices.pieces.back().y_low()) - surfaces.rail_origin_y();
  }


  unsigned int PlacedWheel::nearest_patch(const Vector3 place) const
  {
    const auto distance = [&](const WheelPatch &patch) {
      const ContactAxes contact_axes = axes(patch);
      const Vector3     arm          = place - contact_axes.origin;
      const double y = std::clamp(dot(arm, contact_axes.along), patch.solution.y_begin, patch.solution.y_end);
      const Vector3 away = arm - y * contact_axes.along;
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


  ContactAxes PlacedWheel::axes(const WheelPatch &patch) const
  {
    return {vector(patch.region.reference) - Vector3{0., surfaces.rail_origin_y(), 0., 0.},
            vector(patch.along()), vector(patch.normal())};
  }


  ContactNodeState PlacedWheel::in_contact_axes(const ContactNodeState &given, const double wheel_x) const
  {
    ContactNodeState  state = given;
    const ContactAxes contact_axes =
      axes(patches()[nearest_patch(state.position - Vector3{wheel_x, 0., 0., 0.})]);
    for (Vector3 *v : {&state.normal, &state.impulse, &state.slip})
      *v = contact_axes.turned(*v);
    return state;
  }


  std::vector<ContactNodeState> PlacedWheel::of_patch(const unsigned int                   number,
                                                      const std::vector<ContactNodeState> &states,
                                                      const double                         wheel_x) const
  {
    const ContactAxes             at = axes(patches()[number]);
    const Vector3                 x{wheel_x, 0., 0., 0.};
    std::vector<ContactNodeState> own;
    for (const ContactNodeState &state : states)
      if (nearest_patch(state.position - x) == number)
        {
          own.push_back(state);
          own.back().position = at.turned(state.position - x - at.origin) + x;
        }
    return own;
  }


  reference::HertzEllipse PlacedWheel::ellipse(const double vertical_force) const
  {
    // By Hertz all lengths grow like the cube root of the force.
    const reference::PlanarResult &s     = main_patch().solution;
    const double                   scale = std::cbrt(vertical_force / scene.static_load());
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
    /// How far a profile lies over a plane, at the distance t along it (m). @param s parameter where it is
    /// near the plane's origin `from`; @param across unit vector along the plane
    double over_plane(const ProfileCurve         &profile,
                      double                      s,
                      const dealii::Point<2>     &from,
                      const dealii::Tensor<1, 2> &across,
                      const double                t)
    {
      constexpr unsigned int most_steps  = 20;
      constexpr double       near_enough = 1e-9, // m
        least_cosine                     = 0.2;  // of the profile on the plane
      ProfileCurve::Place p;
      for (unsigned int step = 0; step < most_steps; ++step)
        {
          p              = profile.at(s);
          const double d = (p.y - from[0]) * across[0] + (p.z - from[1]) * across[1] - t;
          if (std::abs(d) < near_enough)
            break;
          s = std::clamp(
            s - d / std::max(least_cosine * std::hypot(p.dy, p.dz), p.dy * across[0] + p.dz * across[1]), 0.,
            profile.length());
        }
      return (p.z - from[1]) * across[0] - (p.y - from[0]) * across[1];
    }

    /// How far a place is beside the path of a piece of slices (m).
    double beside_piece(const TouchedPiece &piece, const WheelOnRail &surfaces, const dealii::Point<3> &p)
    {
      return (p[1] + surfaces.rail_origin_y() - piece.y(p[0])) / std::cos(piece.inclination());
    }
  } // namespace


  PlacedWheel::Place PlacedWheel::place_in_rail(const dealii::Point<3> &p, const WheelPatch &patch) const
  {
    if (!surfaces.rail_surface().is_constant())
      return place_in_slices(p);
    const ContactAxes      contact_axes = axes(patch);
    const Vector3          arm          = Vector3{p[0], p[1], p[2], 0.} - contact_axes.origin;
    const double           beside = dot(arm, contact_axes.along), side = patch.is_of_other_wheel ? -1. : 1.;
    const dealii::Point<2> from(side * patch.region.reference[1], patch.region.reference[2]);
    const dealii::Tensor<1, 2> in_section({side * contact_axes.along[1], contact_axes.along[2]});
    const CurveFromAbove      &rail = surfaces.rail();
    const double               s    = rail.parameter(std::clamp(from[0], rail.begin(), rail.end()));
    return {arm[0], beside,
            over_plane(rail.curve(), s, from, in_section, beside) - dot(arm, contact_axes.normal)};
  }


  double PlacedWheel::depth_under(const dealii::Point<3> &p, const WheelPatch &patch) const
  {
    const double smooth = place_in_rail(p, patch).below;
    const auto  &defect = scene.shapes().defect;
    if (!defect || patch.is_of_other_wheel)
      return smooth;
    const Vector3          normal = vector(patch.normal());
    const dealii::Point<3> on_top(p[0], p[1] + smooth * normal[1], p[2] + smooth * normal[2]);
    const double           angle = scene.rail.angle();
    return smooth + defect->height(on_top[0], scene.rail.in_own_axes(on_top)[1]) *
                      (-std::sin(angle) * normal[1] + std::cos(angle) * normal[2]);
  }


  double PlacedWheel::depth_in_rail(const dealii::Point<3> &p) const
  {
    return depth_under(p, patches()[nearest_patch(Vector3{p[0], p[1], p[2], 0.})]);
  }


  bool PlacedWheel::is_on_path(const dealii::Point<3> &p, const double cell) const
  {
    constexpr double on_surface = 0.3; // of a cell, above the nodes of the next layer
    const auto       is_on      = [&](const double beside, const double below) {
      return std::abs(beside) <= 0.5 * cell && std::abs(below) <= on_surface * cell;
    };
    if (slices.pieces.empty())
      return is_on(place_in_rail(p, main_patch()).beside, depth_under(p, main_patch()));
    const TouchedPiece        *on    = nullptr;
    const TouchedPiece::Touch *touch = nullptr;
    for (const TouchedPiece &piece : slices.pieces)
      for (const TouchedPiece::Touch &other : piece.touches)
        {
          const double nearer = touch ? std::abs(touch->axle - p[0]) - std::abs(other.axle - p[0]) : 1.;
          if (nearer > 0. ||
              (nearer == 0. && other.patch.solution.normal_force > touch->patch.solution.normal_force))
            {
              on    = &piece;
              touch = &other;
            }
        }
    return is_on(beside_piece(*on, surfaces, p), place_in_slices(p).below);
  }


  namespace
  {
    /// Height of the end of a section that is nearest to y, beside all of them.
    double nearest_end(const std::vector<ProfileCurve> &sections, const double y)
    {
      dealii::Point<2> nearest(1e300, 0.);
      for (const ProfileCurve &curve : sections)
        for (const dealii::Point<2> &end : {curve.points_at_knots().front(), curve.points_at_knots().back()})
          if (std::abs(end[0] - y) < std::abs(nearest[0] - y))
            nearest = end;
      return nearest[1];
    }
  } // namespace


  PlacedWheel::Place PlacedWheel::place_in_slices(const dealii::Point<3> &p) const
  {
    const double        y     = p[1] + surfaces.rail_origin_y();
    const TouchedPiece &piece = *std::min_element(
      slices.pieces.begin(), slices.pieces.end(), [&](const TouchedPiece &a, const TouchedPiece &b) {
        return std::abs(beside_piece(a, surfaces, p)) < std::abs(beside_piece(b, surfaces, p));
      });
    std::shared_ptr<const std::vector<ProfileCurve>> &sections = sections_at[p[0]];
    if (!sections)
      sections = surfaces.rail_sections(scene.rail.slices_place + p[0]);
    const auto   top   = highest_over(*sections, y);
    const double below = (top ? top->z : nearest_end(*sections, y)) - p[2];
    return {p[0], beside_piece(piece, surfaces, p), std::cos(piece.inclination()) * below};
  }


  PlacedWheel::Place PlacedWheel::place_in_wheel(const dealii::Point<3> &p,
                                                 const WheelPatch       &patch,
                                                 const double            start_x) const
  {
    // The meridian through the point, turned about the axle to that of the patch.
    const ContactAxes contact_axes = axes(patch);
    const Vector3     a            = vector(WheelOnRail::axle(contact.position)),
                  arm              = Vector3{p[0] - start_x, p[1], p[2], 0.} - middle(),
                  of_patch         = contact_axes.origin - middle();
    const Vector3 off = arm - dot(a, arm) * a, patch_off = of_patch - dot(a, of_patch) * a;
    const double  angle  = std::atan2(-dot(a, cross(patch_off, off)), dot(patch_off, off));
    const Vector3 turned = dot(a, arm) * a + (norm(off) / norm(patch_off)) * patch_off;
    const Vector3 from   = turned - of_patch;
    // In the axes of the wheel's profile, in which z grows towards the axle.
    const Vector3          outwards = (1. / norm(patch_off)) * patch_off;
    const double           side = patch.is_of_other_wheel ? -1. : 1., beside = dot(from, contact_axes.along);
    const dealii::Point<2> origin(side * dot(a, of_patch) - surfaces.wheel_origin_y(),
                                  surfaces.radius() - norm(patch_off));
    const dealii::Tensor<1, 2> in_section(
      {side * dot(a, contact_axes.along), -dot(outwards, contact_axes.along)});
    return {angle * patch.rolling_radius, beside,
            dot(from, contact_axes.normal) -
              over_plane(surfaces.wheel(), patch.wheel_s, origin, in_section / in_section.norm(), beside)};
  }


  std::vector<WheelStance::Place> PlacedWheel::places_under(const dealii::Point<3> &p,
                                                            const unsigned int      body) const
  {
    std::vector<Place> places;
    for (const WheelPatch &patch : patches())
      places.push_back(body == rail_body ? place_in_rail(p, patch)
                                         : place_in_wheel(p, patch, scene.path_begin()));
    return places;
  }


  WheelStance::Strip PlacedWheel::strip(const unsigned int body, const double begin, const double end) const
  {
    const Path path = paths_over(begin, end).front();
    if (body == rail_body)
      return {path, [](const dealii::Point<3> &p) { return p[0]; },
              [this, path](const dealii::Point<3> &p) { return beside(path, p); },
              [this](const dealii::Point<3> &p) {
                return depth_in_rail(p);
              }};
    const auto place = [this, path, start = scene.path_begin()](const dealii::Point<3> &p) {
      return place_in_wheel(p, path, start);
    };
    return {path, [place](const dealii::Point<3> &p) { return place(p).along; },
            [place](const dealii::Point<3> &p) { return place(p).beside; },
            [place](const dealii::Point<3> &p) {
              return place(p).below;
            }};
  }


  std::vector<PlacedWheel::Path> PlacedWheel::paths() const
  {
    std::vector<Path> all;
    const auto        half_width = [](const WheelPatch &patch) {
      return 0.5 * (patch.solution.y_end - patch.solution.y_begin);
    };
    if (slices.pieces.empty())
      {
        const double ahead = main_patch().region.reference[0];
        return {{nullptr, "", scene.path_begin() + ahead, scene.path_end() + ahead, half_width(main_patch()),
                 std::abs(ahead)}};
      }
    for (const TouchedPiece &piece : slices.pieces)
      {
        Path path{&piece, piece.body, 1e300, -1e300, 0., 0.};
        for (const TouchedPiece::Touch &touch : piece.touches)
          {
            path.begin      = std::min(path.begin, touch.x());
            path.end        = std::max(path.end, touch.x());
            path.half_width = std::max(path.half_width, half_width(touch.patch));
            path.ahead      = std::max(path.ahead, std::abs(touch.patch.region.reference[0]));
          }
        all.push_back(path);
      }
    return all;
  }


  std::vector<PlacedWheel::Path> PlacedWheel::paths_over(const double begin, const double end) const
  {
    std::vector<std::pair<double, Path>> by_force;
    for (const Path &path : paths())
      if (begin >= path.begin && end <= path.end)
        {
          double force = path.piece ? 0. : main_patch().solution.normal_force;
          if (path.piece)
            for (const TouchedPiece::Touch &touch : path.piece->touches)
              if (touch.x() >= begin - path.piece->apart && touch.x() <= end + path.piece->apart)
                force = std::max(force, touch.patch.solution.normal_force);
          by_force.emplace_back(force, path);
        }
    std::stable_sort(by_force.begin(), by_force.end(),
                     [](const auto &a, const auto &b) { return a.first > b.first; });
    std::vector<Path> over;
    for (const auto &[force, path] : by_force)
      over.push_back(path);
    return over;
  }


  double PlacedWheel::beside(const Path &path, const dealii::Point<3> &p) const
  {
    if (path.piece)
      return beside_piece(*path.piece, surfaces, p);
    const ContactAxes contact_axes = axes(main_patch());
    return dot(Vector3{p[0], p[1], p[2], 0.} - contact_axes.origin, contact_axes.along);
  }


  PlacedWheel::Place PlacedWheel::place_in_wheel(const dealii::Point<3> &p,
                                                 const Path             &path,
                                                 const double            start_x) const
  {
    const WheelPatch *patch = &main_patch();
    if (path.piece)
      {
        // Where the axle is when this part of the tread has come down to the rail.
        const auto  &touches = path.piece->touches;
        const double axle    = start_x + place_in_wheel(p, touches.front().patch, start_x).along;
        patch = &std::min_element(touches.begin(), touches.end(), [&](const auto &a, const auto &b) {
                   return std::abs(a.axle - axle) < std::abs(b.axle - axle);
                 })->patch;
      }
    Place place = place_in_wheel(p, *patch, start_x);
    if (const auto &deviation = scene.shapes().surfaces.deviation; deviation && !patch->is_of_other_wheel)
      {
        const Vector3 arm   = Vector3{p[0] - start_x, p[1], p[2], 0.} - middle();
        const double  angle = patch->wheel_angle + place.along / patch->rolling_radius,
                     y = dot(vector(WheelOnRail::axle(contact.position)), arm) - surfaces.wheel_origin_y();
        const ProfileCurve::Place at = surfaces.wheel().at(patch->wheel_s);
        place.below += deviation(angle, y) * at.dy / std::hypot(at.dy, at.dz);
      }
    place.along += start_x + patch->region.reference[0];
    return place;
  }


  Vector3 traction_over_pressure(const PlacedWheel &wheel, const Vector3 place)
  {
    const WheelPatch              &patch = wheel.patches()[wheel.nearest_patch(place)];
    const ContactAxes              axes  = wheel.axes(patch);
    const reference::PlanarResult &s     = patch.solution;
    const Vector3                  arm   = place - axes.origin;
    const double                   x = arm[0], y = dot(arm, axes.along);
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
          return (1. / s.pressure[e]) * (Vector3{s.shear_x[e], 0., 0., 0.} + s.shear_y[e] * axes.along);
      }
    return Vector3{};
  }


  std::vector<PatchNode> table_nodes(const PlacedWheel &wheel, const WheelPatch &patch)
  {
    const ContactAxes      axes  = wheel.axes(patch);
    std::vector<PatchNode> nodes = elements_in_contact(patch);
    for (PatchNode &node : nodes)
      node.position = axes.origin + Vector3{node.position[0], 0., 0., 0.} + node.position[1] * axes.along;
    return nodes;
  }


  std::vector<PatchNode> table_nodes(const PlacedWheel &wheel)
  {
    std::vector<PatchNode> nodes;
    for (const WheelPatch &patch : wheel.patches())
      {
        const std::vector<PatchNode> own = table_nodes(wheel, patch);
        nodes.insert(nodes.end(), own.begin(), own.end());
      }
    return nodes;
  }
} // namespace tread
