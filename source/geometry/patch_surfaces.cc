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
    const ProfileCurve &wheel = surfaces.wheel(), &rail = surfaces.rail().curve();
    const auto          steps = [](const double length) {
      return std::max(2u, static_cast<unsigned int>(std::ceil(length / largest_step)));
    };
    first_wheel_s       = std::max(0., region.s_begin - beyond_overlap);
    const double length = std::min(wheel.length(), region.s_end + beyond_overlap) - first_wheel_s;
    unsigned int n      = steps(length);
    wheel_step          = length / n;
    for (unsigned int k = 0; k <= n; ++k)
      wheel_places.push_back(wheel.at(first_wheel_s + k * wheel_step));
    n         = steps(rail.length());
    rail_step = rail.length() / n;
    for (unsigned int k = 0; k <= n; ++k)
      {
        const ProfileCurve::Place p = rail.at(k * rail_step);
        rail_section.s.push_back(along({0., p.y, p.z}));
        rail_section.height.push_back(above({0., p.y, p.z}));
      }
    rail_section.increases = std::is_sorted(rail_section.s.begin(), rail_section.s.end());
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


  PatchSurfaces::RailPlace PatchSurfaces::rail(const double s) const
  {
    if (const auto known = known_rail.find(s); known != known_rail.end())
      return known->second;
    const ProfileCurve &curve = surfaces.rail().curve();
    const int           k     = step(rail_section, s, -1.);
    const double        parameter =
      k < 0 ? nearest_end(rail_section, s) * rail_step
                   : zero_between(k * rail_step, (k + 1) * rail_step, rail_section.s[k] < rail_section.s[k + 1],
                                  [&](const double t) -> std::pair<double, double> {
                             const ProfileCurve::Place p = curve.at(t);
                             return {along({0., p.y, p.z}) - s, p.dy * cosine + p.dz * sine};
                           });
    const ProfileCurve::Place p = curve.at(parameter);
    return known_rail[s]        = {above({0., p.y, p.z}), std::atan2(p.dz, p.dy), k >= 0};
  }


  PatchSurfaces::OnPlane PatchSurfaces::on_plane(const ProfileCurve::Place &p, const double x) const
  {
    // x of the track is turn_x[0] r sin(angle) + turn_y[0] y: the angle follows, and its change along the
    // profile.
    const double r = surfaces.radius() - p.z, y = surfaces.wheel_origin_y() + p.y;
    const double sin_a  = std::clamp((x + origin[0] - turn_y[0] * y) / (turn_x[0] * r), -0.9, 0.9);
    const double cos_a  = std::sqrt(1. - sin_a * sin_a);
    const double by_arc = (-turn_y[0] * p.dy / turn_x[0] + p.dz * sin_a) / cos_a; // r dangle/ds
    const auto   turned = [&](const double a, const double b, const double c) -> Vector3d {
      Vector3d v{};
      for (unsigned int d = 1; d < 3; ++d)
        v[d] = a * turn_x[d] + b * turn_y[d] + c * turn_z[d];
      return v;
    };
    Vector3d place = turned(r * sin_a, y, -r * cos_a);
    place[1] += middle[1];
    place[2] += middle[2];
    const Vector3d change = turned(by_arc * cos_a - p.dz * sin_a, p.dy, by_arc * sin_a + p.dz * cos_a);
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
      return first_wheel_s + i * wheel_step;
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
    const RailPlace  below = rail(s);
    const WheelPlace over  = wheel(x, s);
    const double     gap   = over.height - below.height;
    // Where there is only one of them, nothing can touch.
    constexpr double nothing = 1e-3; // m
    return below.exists && over.exists ? gap : std::max(gap, 0.) + nothing;
  }
} // namespace tread
