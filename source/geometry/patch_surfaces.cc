// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/patch_surfaces.h>

#include "rotation.h"

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
    /// Steps of the tables, of which a measured profile has two or three between its points, m.
    constexpr double largest_step = 0.1e-3;

    /// Depth below the plane that stands for no rail, m.
    constexpr double where_no_rail = 0.1;

    /// How far beyond the overlap, along the profile, the wheel is looked at, m.
    constexpr double beyond_overlap = 10e-3;

    /// Where a function of the parameter passes through zero between two places of unlike sign: Newton's
    /// method, by halves where it leaves them. @param at gives value and slope
    template <typename Function>
    double zero_between(double low, double high, const bool rises, const Function &at)
    {
      double t = 0.5 * (low + high);
      for (unsigned int i = 0; i < 60; ++i)
        {
          const auto [value, slope] = at(t);
          if (std::abs(value) < 1e-14)
            break;
          ((value < 0.) == rises ? low : high) = t;
          const double next                    = t - value / slope;
          const double before                  = t;
          t                                    = next > low && next < high ? next : 0.5 * (low + high);
          if (t == before)
            break;
        }
      return t;
    }

    unsigned int steps_over(const double length)
    {
      return std::max(2u, static_cast<unsigned int>(std::ceil(length / largest_step)));
    }
  } // namespace


  PatchSurfaces::PatchSurfaces(const WheelOnRail         &surfaces,
                               const WheelsetPosition    &position,
                               const WheelOnRail::Region &region)
    : surfaces(surfaces)
    , origin(region.reference)
    , cosine(std::cos(region.angle))
    , sine(std::sin(region.angle))
  {
    const Rotation turn(position);
    turn_x                    = turn.x;
    turn_y                    = turn.y;
    turn_z                    = turn.z;
    middle                    = {0., position.shift, surfaces.radius() + position.height};
    along_rail                = position.along + origin[0];
    pitch                     = position.pitch;
    const ProfileCurve &wheel = surfaces.wheel();
    first_wheel_s             = std::max(0., region.s_begin - beyond_overlap);
    const double       length = std::min(wheel.length(), region.s_end + beyond_overlap) - first_wheel_s;
    const unsigned int n      = steps_over(length);
    wheel_step                = length / n;
    for (unsigned int k = 0; k <= n; ++k)
      wheel_places.push_back(wheel.at(first_wheel_s + k * wheel_step));
  }


  int PatchSurfaces::step(const Section &section, const double s, const double sign)
  {
    const std::vector<double> &at = section.s;
    if (section.increases)
      {
        if (s < at.front() || s > at.back())
          return -1;
        const auto above = std::upper_bound(at.begin(), at.end(), s) - at.begin();
        return static_cast<int>(std::clamp<std::ptrdiff_t>(above - 1, 0, at.size() - 2));
      }
    int    best    = -1;
    double nearest = 0.;
    for (std::size_t k = 0; k + 1 < at.size(); ++k)
      if ((at[k] - s) * (at[k + 1] - s) <= 0. && at[k] != at[k + 1])
        {
          const double height = section.height[k] + (s - at[k]) / (at[k + 1] - at[k]) *
                                                      (section.height[k + 1] - section.height[k]);
          if (best < 0 || sign * height < nearest)
            {
              best    = static_cast<int>(k);
              nearest = sign * height;
            }
        }
    return best;
  }


  std::size_t PatchSurfaces::nearest_end(const Section &section, const double s)
  {
    return std::min_element(
             section.s.begin(), section.s.end(),
             [&](const double a, const double b) { return std::abs(a - s) < std::abs(b - s); }) -
           section.s.begin();
  }


  const PatchSurfaces::RailAt &PatchSurfaces::rail_at(const double x) const
  {
    const double where = surfaces.rail_surface().is_constant() ? 0. : x;
    if (const auto known = rails.find(where); known != rails.end())
      return known->second;
    RailAt &rail = rails[where];
    rail.curves  = surfaces.rail_sections(along_rail + where);
    for (const ProfileCurve &curve : *rail.curves)
      {
        const unsigned int n    = steps_over(curve.length());
        const double       step = curve.length() / n;
        Section            section;
        for (unsigned int k = 0; k <= n; ++k)
          {
            const ProfileCurve::Place p = curve.at(k * step);
            section.s.push_back(along({0., p.y, p.z}));
            section.height.push_back(above({0., p.y, p.z}));
          }
        section.increases = std::is_sorted(section.s.begin(), section.s.end());
        rail.sections.push_back(std::move(section));
        rail.steps.push_back(step);
      }
    return rail;
  }


  const std::vector<PatchSurfaces::Section> &PatchSurfaces::rail_sections(const double x) const
  {
    return rail_at(x).sections;
  }


  PatchSurfaces::OnRail PatchSurfaces::on_rail(const double x, const double s) const
  {
    const RailAt &rail    = rail_at(x);
    OnRail        found   = {nullptr, 0., false};
    double        highest = 0., nearest = 0.;
    for (std::size_t piece = 0; piece < rail.sections.size(); ++piece)
      {
        const Section      &section = rail.sections[piece];
        const ProfileCurve &curve   = (*rail.curves)[piece];
        const double        size    = rail.steps[piece];
        const int           k       = step(section, s, -1.);
        if (k < 0)
          {
            const std::size_t end      = nearest_end(section, s);
            const double      distance = std::abs(section.s[end] - s);
            if (!found.exists && (!found.curve || distance < nearest))
              {
                found   = {&curve, end * size, false};
                nearest = distance;
              }
            continue;
          }
        const double parameter =
          zero_between(k * size, (k + 1) * size, section.s[k] < section.s[k + 1],
                       [&](const double t) -> std::pair<double, double> {
                         const ProfileCurve::Place p = curve.at(t);
                         return {along({0., p.y, p.z}) - s, p.dy * cosine + p.dz * sine};
                       });
        const ProfileCurve::Place p = curve.at(parameter);
        if (const double height = above({0., p.y, p.z}); !found.exists || height > highest)
          {
            found   = {&curve, parameter, true};
            highest = height;
          }
      }
    return found;
  }


  PatchSurfaces::RailPlace PatchSurfaces::rail(const double x, const double s) const
  {
    const std::pair where(surfaces.rail_surface().is_constant() ? 0. : x, s);
    if (const auto known = known_rail.find(where); known != known_rail.end())
      return known->second;
    const OnRail found = on_rail(x, s);
    if (!found.curve) // beyond the rail's ends
      return known_rail[where] = {-where_no_rail, 0., 0., false};
    const ProfileCurve::Place p = found.curve->at(found.parameter);
    return known_rail[where] = {above({0., p.y, p.z}), std::atan2(p.dz, p.dy), found.parameter, found.exists};
  }


  double PatchSurfaces::rail_radius() const
  {
    const OnRail found = on_rail(0., 0.);
    return found.curve ? found.curve->radius(found.parameter) : 1e300;
  }


  PatchSurfaces::OnPlane PatchSurfaces::on_plane(const ProfileCurve::Place &p, const double x) const
  {
    // x of the track is turn_x[0] r sin(angle) + turn_y[0] y: the angle follows, and its change along the
    // profile.
    const double y     = surfaces.wheel_origin_y() + p.y;
    const double ahead = (x + origin[0] - turn_y[0] * y) / turn_x[0]; // r sin(angle)
    double       r = surfaces.radius() - p.z, sin_a = std::clamp(ahead / r, -0.9, 0.9);
    double       by_s = -p.dz, by_angle = 0.; // of r, m
    // What the wheel is not round changes slowly with the angle: each turn leaves some per cent of the error.
    if (!surfaces.wheel_surface().is_constant())
      {
        constexpr unsigned int most  = 30;
        constexpr double       exact = 1e-14; // m
        for (unsigned int turn = 0; turn < most; ++turn)
          {
            const WheelDeviation::Value more =
              surfaces.wheel_surface().deviation(std::asin(sin_a) - pitch, p.y);
            const double before = r;
            r                   = surfaces.radius() - p.z + more.dz;
            sin_a               = std::clamp(ahead / r, -0.9, 0.9);
            by_s                = -p.dz + more.by_y * p.dy;
            by_angle            = more.by_angle;
            if (std::abs(r - before) < exact)
              break;
          }
      }
    const double cos_a = std::sqrt(1. - sin_a * sin_a);
    // Along the profile r sin(angle) changes by what keeps x.
    const double turning =
      (-turn_y[0] * p.dy / turn_x[0] - by_s * sin_a) / (cos_a + by_angle / r * sin_a); // r dangle/ds
    const double r_change = by_s + by_angle * turning / r;
    const auto   turned   = [&](const double a, const double b, const double c) -> Vector3d {
      Vector3d v{};
      for (unsigned int d = 1; d < 3; ++d)
        v[d] = a * turn_x[d] + b * turn_y[d] + c * turn_z[d];
      return v;
    };
    Vector3d place = turned(r * sin_a, y, -r * cos_a);
    place[1] += middle[1];
    place[2] += middle[2];
    const Vector3d change =
      turned(turning * cos_a + r_change * sin_a, p.dy, turning * sin_a - r_change * cos_a);
    return {along(place), above(place), std::asin(sin_a), change[1] * cosine + change[2] * sine};
  }


  const PatchSurfaces::Section &PatchSurfaces::wheel_section(const double x) const
  {
    if (const auto known = sections.find(x); known != sections.end())
      return known->second;
    Section &section = sections[x];
    for (const ProfileCurve::Place &p : wheel_places)
      {
        const OnPlane here = on_plane(p, x);
        section.s.push_back(here.s);
        section.height.push_back(here.height);
      }
    section.increases = std::is_sorted(section.s.begin(), section.s.end());
    return section;
  }


  PatchSurfaces::WheelPlace PatchSurfaces::wheel(const double x, const double s) const
  {
    const ProfileCurve &curve   = surfaces.wheel();
    const Section      &section = wheel_section(x);
    const int           k       = step(section, s, 1.);
    const auto          at      = [&](const std::size_t i) {
      return parameter(i);
    };
    const double  profile_s = k < 0 ? at(nearest_end(section, s))
                                    : zero_between(at(k), at(k + 1), section.s[k] < section.s[k + 1],
                                                   [&](const double t) -> std::pair<double, double> {
                                                    const OnPlane here = on_plane(curve.at(t), x);
                                                    return {here.s - s, here.slope};
                                                  });
    const OnPlane found     = on_plane(curve.at(profile_s), x);
    return {found.height, profile_s, found.angle, k >= 0};
  }


  double PatchSurfaces::gap(const double x, const double s) const
  {
    const RailPlace  below = rail(x, s);
    const WheelPlace over  = wheel(x, s);
    const double     gap   = over.height - below.height;
    // Where there is only one of them, nothing can touch.
    constexpr double nothing = 1e-3; // m
    return below.exists && over.exists ? gap : std::max(gap, 0.) + nothing;
  }
} // namespace tread
