// SPDX-License-Identifier: LGPL-2.1-or-later
// What is meshed of rail and wheel where the wheel has a position: blocks behind the running surfaces.
#include <tread/base/format.h>
#include <tread/geometry/contact_points.h>
#include <tread/mesh/profile_block.h>
#include <tread/mesh/rail_body.h>
#include <tread/scene/assumptions.h>
#include <tread/scene/fine_cells.h>
#include <tread/scene/placed_wheel.h>
#include <tread/scene/scene.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

namespace tread
{
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
      // Slices: contact is solved along the way, guidance included.
      if (scene.guidance.kind != Guidance::file || scene.rail.is_sliced())
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

    constexpr Scene::Range everywhere{-std::numeric_limits<double>::infinity(),
                                      std::numeric_limits<double>::infinity()};

    /// The finest cells at a patch on one of the bodies. @param x_reference of its reference point at the
    /// start
    /// @param s, s_middle parameters of the body's profile there and in the middle of its block
    /// @param way that the patch goes from there along the body (m)
    /// @param window where cells are fine at present, as ways of the patch's middle from there (m)
    FineZone zone_of(const Scene             &scene,
                     const WheelPatch        &patch,
                     const ProfileCurve      &profile,
                     const double             x_reference,
                     const double             s,
                     const double             s_middle,
                     const double             way,
                     const Wandering::OnBody &wanders = {},
                     const Scene::Range      &window  = everywhere)
    {
      // Contact that a plane does not stand for may reach farther than in one.
      const double wider =
        (is_about_defect(scene) || !scene.shapes().is_round() ? room_for_dynamic_load : 1.) *
        (1.1 + 0.3 * patch.turn);
      const reference::PlanarResult &r = patch.solution;
      const double                   x = x_reference + 0.5 * (r.x_begin + r.x_end),
                   begin               = parameter_at(profile, patch, s, r.y_begin),
                   end = parameter_at(profile, patch, s, r.y_end), half_width = 0.5 * (end - begin);
      FineZone zone;
      zone.finest_cell_size = scene.mesh.finest_cell;
      zone.x_begin          = x - beyond_path(scene, r) + wanders.x[0];
      zone.x_end            = x + way + beyond_path(scene, r) + wanders.x[1];
      zone.window_begin     = x + window.begin + wanders.x[0];
      zone.window_end       = x + window.end + wanders.x[1];
      zone.y_middle         = 0.5 * (begin + end + wanders.s[0] + wanders.s[1]) - s_middle;
      zone.half_width = std::max(scene.mesh.fine_half_width, wider * half_width + scene.mesh.finest_cell +
                                                               0.5 * (wanders.s[1] - wanders.s[0]));
      zone.depth      = scene.mesh.fine_layers * zone.finest_cell_size;
      zone.cells_per_level = scene.mesh.cells_per_level;
      zone.level_depth     = scene.mesh.level_depth * std::sqrt(half_width * 0.5 * (r.x_end - r.x_begin));
      return zone;
    }

    /// The smallest box about those of all touches of a piece; between two of them contact may begin or end.
    FineZone hull_of(const Scene                                                     &scene,
                     const TouchedPiece                                              &piece,
                     const std::function<FineZone(const TouchedPiece::Touch &touch)> &zone_at)
    {
      FineZone hull;
      double   low = 1e300, high = -1e300;
      hull.x_begin = 1e300;
      hull.x_end   = -1e300;
      for (const TouchedPiece::Touch &touch : piece.touches)
        {
          const FineZone zone = zone_at(touch);
          low                 = std::min(low, zone.y_middle - zone.half_width);
          high                = std::max(high, zone.y_middle + zone.half_width);
          const double begin = std::min(hull.x_begin, zone.x_begin), end = std::max(hull.x_end, zone.x_end),
                       level_depth = std::max(hull.level_depth, zone.level_depth);
          hull                     = zone;
          hull.x_begin             = begin;
          hull.x_end               = end;
          hull.level_depth         = level_depth;
        }
      hull.y_middle   = 0.5 * (low + high);
      hull.half_width = 0.5 * (high - low);
      if (piece.touches.front().axle > scene.path_begin())
        hull.x_begin -= piece.apart;
      if (piece.touches.back().axle < scene.meshed_end() - 0.5 * piece.apart)
        hull.x_end += piece.apart;
      return hull;
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

    /// The sections of a piece along the way, each a block's about the line of its touches.
    class PieceSections
    {
    public:
      PieceSections(const Scene &scene, const WheelOnRail &surfaces, const TouchedPiece &piece)
        : surfaces(surfaces)
        , piece(piece)
        , place(scene.rail.slices_place)
        , inclination(piece.inclination())
        , depth(scene.wheel.sector_thickness)
        , half_width(scene.wheel.half_width())
        , begin(reach(piece.touches.front().x(), scene.rail_begin()))
        , end(reach(piece.touches.back().x(), scene.rail_end()))
      {
        // Where the surface falls away beside the touches there must be room between it and the base.
        constexpr unsigned int n_places = 8;
        constexpr double       step     = 0.5e-3; // m
        for (unsigned int i = 0; i <= n_places; ++i)
          {
            const ProfileSection section = make(begin + (end - begin) * i / n_places);
            double               wide    = 0.;
            while (wide < half_width && section.is_above_base(wide + step) &&
                   section.is_above_base(-wide - step))
              wide += step;
            half_width = std::min(half_width, wide);
          }
      }

      /// The sections at x in track axes.
      std::shared_ptr<const std::vector<ProfileCurve>> curves(const double x) const
      {
        return surfaces.rail_sections(place + x);
      }

      const ProfileSection &at(const double x)
      {
        const auto found = known.find(x);
        return found != known.end() ? found->second : known.emplace(x, make(x)).first->second;
      }

    private:
      /// How far towards `to` the piece goes on, m.
      double reach(const double from, const double to) const
      {
        constexpr double      step = 1e-3, steepest = 1.; // m, m/m
        constexpr double      least_cosine = 0.5;         // of the surface on the base
        double                x            = from;
        std::optional<double> last;
        for (;;)
          {
            const auto                     here = curves(x);
            const std::optional<OnSection> on   = highest_over(*here, piece.y(x));
            if (!on || (last && std::abs(on->z - *last) > steepest * step) ||
                std::cos(std::atan(on->slope) - inclination) < least_cosine ||
                surfaces.rail_surface().body(place + x, piece.y(x) - surfaces.rail_origin_y()) != piece.body)
              return x - std::copysign(step, to - from);
            last = on->z;
            if (x == to)
              return x;
            x = std::abs(to - x) <= step ? to : x + std::copysign(step, to - x);
          }
      }

      ProfileSection make(const double x) const
      {
        const auto here = curves(x);
        const auto on   = highest_over(*here, piece.y(x));
        if (!on)
          throw std::invalid_argument("the slices have no surface there");
        return ProfileSection((*here)[on->curve], on->s, inclination, ProfileSection::Side::below, depth,
                              half_width);
      }

      const WheelOnRail               &surfaces;
      const TouchedPiece              &piece;
      double                           place, inclination, depth;
      std::map<double, ProfileSection> known;

    public:
      double half_width, begin, end; ///< m
    };

    /// Blocks behind the running surfaces of a wheelset in its position, finest at the patches.
    class BlocksOfWheelset
    {
    public:
      BlocksOfWheelset(const Scene &scene, const PlacedWheel &wheel, const FineWindow &window)
        : scene(scene)
        , window(window)
        , surfaces(wheel.surfaces)
        , sides(wheel.sides())
        , slices(wheel.way())
      {
      }

      Body rail() const
      {
        return of_sides("rail", [&](const PlacedWheel::Side &side) {
          return scene.rail.is_sliced() ? rail_of_slices() : rail_of(side);
        });
      }

      Body wheel() const
      {
        return of_sides("wheel", [&](const PlacedWheel::Side &side) { return wheel_of(side); });
      }

    private:
      /// From the track axes of a side to those of the mesh.
      std::function<dealii::Point<3>(const Vector3d &)> from_track(const bool is_mirrored) const
      {
        return [origin = surfaces.rail_origin_y(), sign = is_mirrored ? -1. : 1.](const Vector3d &p) {
          return dealii::Point<3>(p[0], sign * p[1] - origin, p[2]);
        };
      }

      /// A body from its piece at each side.
      Body of_sides(const std::string &name, const std::function<Body(const PlacedWheel::Side &)> &make) const
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

      Body rail_of(const PlacedWheel::Side &side) const
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
          zones.push_back(
            zone_of(scene, patch, profile, scene.path_begin() + patch.region.reference[0],
                    parameter_of(patch), middle.s, scene.motion.meshed_distance(), wanders.rail,
                    {window.rail_begin - scene.path_begin(), window.rail_end - scene.path_begin()}));
        require_on_profile(section, zones,
                           scene.rail.measured_head.empty() ? "Rail/Profile" : "Rail/Measured head",
                           scene.guidance.kind == Guidance::file);
        const auto place = [section, in_mesh = from_track(side.is_mirrored),
                            origin = surfaces.rail_origin_y()](const double x, const double along,
                                                               const double behind) {
          const dealii::Point<2> p = section.point(along, behind);
          return in_mesh({x, p[0] + origin, p[1]});
        };
        Body body = make_profile_block(
          {scene.rail_begin(), scene.rail_end(), section.half_width, section.depth, side.is_mirrored, place},
          scene.mesh.coarsest_cell, zones);
        if (const auto &defect = scene.shapes().defect; defect && !side.is_mirrored)
          body.to_space = shape_top(
            [smooth = body.to_space, rail = scene.rail](const dealii::Point<3> &p) {
              return rail.in_own_axes(smooth(p));
            },
            {[defect](const double x, const double y) { return defect->height(x, y); }, scene.rail.angle()},
            section.depth);
        return body;
      }

      Body rail_of_slices() const
      {
        const auto          in_mesh = from_track(false);
        std::optional<Body> rail;
        for (const TouchedPiece &piece : slices.pieces)
          {
            const auto sections = std::make_shared<PieceSections>(scene, surfaces, piece);
            FineZone   zone     = hull_of(scene, piece, [&](const TouchedPiece::Touch &touch) {
              const auto here   = sections->curves(touch.x());
              const auto middle = highest_over(*here, piece.y(touch.x())),
                         at     = highest_over(*here, touch.patch.region.reference[1]);
              if (!middle || !at)
                throw std::invalid_argument("the slices have no surface where the wheel touches them");
              return zone_of(scene, touch.patch, (*here)[at->curve], touch.x(), at->s, middle->s, 0.);
            });
            zone.x_begin        = std::max(zone.x_begin, sections->begin);
            zone.x_end          = std::min(zone.x_end, sections->end);
            require(
              zone.reach() <= sections->half_width,
              "'Rail/Slices': the finest cells of a piece" +
                (piece.body.empty() ? "" : " (" + piece.body + ")") + " reach " + text_in_mm(zone.reach()) +
                " mm to the side of its middle line, and the block behind "
                "its surface, 'Wheel/Sector thickness (mm)' " +
                text_in_mm(scene.wheel.sector_thickness) + " thick, is only " +
                text_in_mm(sections->half_width) +
                " mm wide to each side: a shorter way, a thicker block or lower 'Mesh/Fine half width (mm)'");
            Body body = make_profile_block(
              {sections->begin, sections->end, sections->half_width, scene.wheel.sector_thickness, false,
               [sections, in_mesh](const double x, const double along, const double behind) {
                 const dealii::Point<2> p = sections->at(x).point(along, behind);
                 return in_mesh({x, p[0], p[1]});
               }},
              scene.mesh.coarsest_cell, {zone});
            // Where a piece begins or ends within the rail, nothing is cut.
            body.boundary_at = [at = body.boundary_at, is_whole_begin = sections->begin > scene.rail_begin(),
                                is_whole_end = sections->end < scene.rail_end(),
                                middle = 0.5 * (sections->begin + sections->end)](const dealii::Point<3> &p) {
              const Boundary boundary = at(p);
              return boundary == Boundary::end && (p[0] < middle ? is_whole_begin : is_whole_end)
                       ? Boundary::free
                       : boundary;
            };
            rail = rail ? join(body, *rail) : body;
          }
        return *rail;
      }

      Body wheel_of(const PlacedWheel::Side &side) const
      {
        const std::vector<WheelPatch> &patches = side.contact.patches;
        const ProfileCurve            &profile = surfaces.wheel();
        std::vector<WheelPatch>        all     = patches; // on the way too
        for (const TouchedPiece &piece : slices.pieces)
          for (const TouchedPiece::Touch &touch : piece.touches)
            all.push_back(touch.patch);
        const Middle         middle = middle_of(all, [](const WheelPatch &patch) { return patch.wheel_s; });
        const ProfileSection section(profile, middle.s, middle.inclination, ProfileSection::Side::above,
                                     scene.wheel.sector_thickness, scene.wheel.half_width());
        // Along the tread arcs have the length that they have on the circle through the middle.
        const double          radius  = surfaces.radius() - profile.at(middle.s).z;
        const Wandering       wanders = wandering(scene, surfaces, side.is_mirrored);
        std::vector<FineZone> zones;
        double                begin = 1e300, end = -1e300;
        const double          way = way_along_block(radius), per_tread = radius / scene.wheel.radius;
        for (const WheelPatch &patch : patches)
          {
            const double arc = radius * patch.wheel_angle;
            if (slices.pieces.empty())
              zones.push_back(zone_of(scene, patch, profile, arc, patch.wheel_s, middle.s, way, wanders.wheel,
                                      {per_tread * window.tread_begin, per_tread * window.tread_end}));
            begin = std::min(begin, arc + wanders.wheel.x[0]);
            end   = std::max(end, arc + wanders.wheel.x[1]);
          }
        for (const TouchedPiece &piece : slices.pieces)
          {
            zones.push_back(hull_of(scene, piece, [&](const TouchedPiece::Touch &touch) {
              const double arc = radius * touch.patch.wheel_angle + touch.axle - scene.path_begin();
              return zone_of(scene, touch.patch, profile, arc, touch.patch.wheel_s, middle.s, 0.);
            }));
            begin = std::min(begin, zones.back().x_begin);
            end   = std::max(end, zones.back().x_end - way);
          }
        require_on_profile(section, zones, "Wheel/Tread profile", scene.guidance.kind == Guidance::file);
        const double margin = scene.wheel.sector_margin, x_start = scene.path_begin();
        const auto   place = [section, in_mesh = from_track(side.is_mirrored), surfaces = surfaces,
                            position  = side.contact.position, radius, x_start,
                            deviation = side.is_mirrored ? nullptr : scene.shapes().surfaces.deviation](
                             const double arc, const double along, const double behind) {
          const double     angle = arc / radius;
          dealii::Point<2> p     = section.point(along, behind);
          // What the tread has beyond round fades to the base of the block.
          if (deviation)
            p[1] -= (1. - behind / section.depth) * deviation(angle, section.point(along, 0.)[0]);
          const Vector3d q = surfaces.place(position, p[0], p[1], angle);
          return in_mesh({q[0] + x_start, q[1], q[2]});
        };
        return make_profile_block(
          {begin - margin, end + way + margin, section.half_width, section.depth, !side.is_mirrored, place},
          scene.mesh.coarsest_cell, zones);
      }

      /// How far a patch goes along the wheel's block, whose arcs have this radius, m. Cells are fine a
      /// quarter of a half length before the patch, which is enough for ways of some patches.
      double way_along_block(const double radius) const
      {
        constexpr double spare = 0.25, with_torque = 0.01;
        const double     way = scene.motion.meshed_distance(),
                     longer  = std::max(given_angular_velocity(scene) * radius / scene.motion.speed - 1.,
                                       scene.motion.drive == Drive::torque ? with_torque : 0.);
        return way +
               std::max(0., longer * way - spare * scene.stance().ellipse(scene.static_load()).semi_axis_x);
      }

      const Scene                          &scene;
      const FineWindow                      window;
      const WheelOnRail                    &surfaces;
      const std::vector<PlacedWheel::Side> &sides;
      const WayOverSlices                  &slices;
    };
  } // namespace


  std::vector<Body> PlacedWheel::make_bodies(const FineWindow &window) const
  {
    const BlocksOfWheelset blocks(scene, *this, window);
    return {blocks.rail(), blocks.wheel()};
  }
} // namespace tread
