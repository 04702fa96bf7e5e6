// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/wheel_on_rail.h>

#include "overlap_search.h"
#include "rotation.h"
#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

namespace tread
{
  namespace
  {
    /// Distance at which the wheel's profile is looked at, m. Between the samples the gap is refined.
    constexpr double sample_spacing = 0.1e-3;

    /// Gap where there is no rail below the wheel, m.
    constexpr double no_rail = 1e3;

    struct Angle
    {
      double sine, cosine;
    };
    /// Where a place of the profile lies on the outline seen along x, about the axle.
    std::optional<Angle> on_outline(const Rotation &turn, const ProfileCurve::Place &p)
    {
      // The normal is dy (sin, 0, -cos) + dz (0, 1, 0) in the axes of the wheelset, with dy and dz of the
      // profile; its component along the track's x is to vanish: a sin(angle) - b cos(angle) = c.
      const double a = turn.x[0] * p.dy, b = turn.z[0] * p.dy, c = -turn.y[0] * p.dz, square = a * a + b * b,
                   rest = square - c * c;
      if (!(rest > 0.) || a <= 0.)
        return {};
      const double root = std::sqrt(rest);
      return Angle{(c * a + root * b) / square, (root * a - c * b) / square};
    }

    /// y at which the rail is the measuring depth below its top, on the gauge side, and the top's height.
    std::pair<double, double> gauge_face(const ProfileCurve &rail, const double depth)
    {
      const CurveFromAbove above(rail);
      // The highest point, then the way down towards the gauge.
      double top_y = 0., top = -1e300;
      for (double y = std::max(-25e-3, above.begin()); y <= std::min(25e-3, above.end()); y += 1e-5)
        if (const double z = above.height(y); z > top)
          {
            top   = z;
            top_y = y;
          }
      double s = above.parameter(top_y);
      // One step of Newton's method for the level point, whose height is of second order in it.
      const double step  = 1e-5;
      const auto   level = [&](const double at) {
        return rail.at(at).dz;
      };
      if (const double change = (level(s + step) - level(s - step)) / (2. * step); change < 0.)
        {
          const double at = std::clamp(s - level(s) / change, s - 1e-5, s + 1e-5);
          top             = std::max(top, rail.at(at).z);
        }
      double upper = s, lower = s;
      while (lower > 0. && rail.at(lower).z > top - depth)
        {
          upper = lower;
          lower = std::max(0., lower - 0.1e-3);
        }
      if (rail.at(lower).z > top - depth)
        throw std::runtime_error(
          "the rail's gauge side does not reach down to the depth at which the gauge is "
          "measured");
      for (unsigned int i = 0; i < 60; ++i)
        {
          const double middle                               = 0.5 * (lower + upper);
          (rail.at(middle).z > top - depth ? upper : lower) = middle;
        }
      // What sticks out further above that depth is the face.
      double y = rail.at(lower).y;
      for (double at = lower; at < s; at += 0.05e-3)
        y = std::min(y, rail.at(at).y);
      return {y, top};
    }
    /// s at which the flange of a wheel leaves its steepest part towards the tip; 0 without a flange.
    double end_of_flank(const ProfileCurve &wheel, const std::vector<double> &samples)
    {
      constexpr double least_angle = 0.5, flatter = 0.05; // rad, and what a measured flank varies by
      // The tip is the lowest place on the flange's side of the running circle.
      double tip = 0., lowest = 1e300;
      for (const double s : samples)
        if (const ProfileCurve::Place p = wheel.at(s); p.y < 0. && p.z < lowest)
          {
            lowest = p.z;
            tip    = s;
          }
      const auto angle = [&](const double s) {
        const ProfileCurve::Place p = wheel.at(s);
        return p.y < 0. ? std::atan2(p.dz, p.dy) : 0.;
      };
      double steepest = 0.;
      for (const double s : samples)
        if (s > tip)
          steepest = std::max(steepest, angle(s));
      if (steepest < least_angle)
        return 0.;
      return *std::find_if(samples.begin(), samples.end(),
                           [&](const double s) { return s > tip && angle(s) >= steepest - flatter; });
    }
  } // namespace


  WheelOnRail::WheelOnRail(const ProfileCurve &wheel,
                           const ProfileCurve &rail,
                           const double        radius,
                           const TrackGauge   &gauge)
    : WheelOnRail(WheelSurface(wheel), std::make_shared<PrismSurface>(rail), radius, gauge)
  {
  }


  WheelOnRail::WheelOnRail(const WheelSurface              &wheel_surface,
                           std::shared_ptr<const Surface>   rail_surface,
                           const double                     radius,
                           const TrackGauge                &gauge,
                           const std::optional<RailOrigin> &origin)
    : wheel_of(wheel_surface)
    , rail_of(std::move(rail_surface))
    , wheel_profile(wheel_surface.profile())
    , nominal_radius(radius)
    , wheel_y(gauge.wheel_origin())
    , rail_y(origin ? origin->y : 0.)
    , rail_z(origin ? origin->z : 0.)
  {
    const ProfileCurve &wheel = wheel_profile;
    if (rail_of->is_constant())
      {
        const ProfileCurve rail = rail_of->sections(0.).front();
        if (!origin)
          {
            const auto [face_y, top] = gauge_face(rail, gauge.measuring_depth);
            rail_y                   = 0.5 * gauge.gauge - face_y;
            rail_z                   = 0. - top;
          }
        rail_profile = CurveFromAbove(rail.moved(rail_y, rail_z), rail_y);
        rail_section = std::make_shared<std::vector<ProfileCurve>>(1, rail_profile->curve());
      }
    else if (!origin)
      throw std::runtime_error("a rail that changes along the way needs a place in the track");
    const auto n = static_cast<unsigned int>(std::ceil(wheel.length() / sample_spacing));
    for (unsigned int i = 0; i <= n; ++i)
      {
        samples.push_back(wheel.length() * i / n);
        places.push_back(wheel.at(samples.back()));
      }
    flank_end = end_of_flank(wheel, samples);
  }


  double WheelOnRail::radius() const
  {
    return nominal_radius;
  }


  const CurveFromAbove &WheelOnRail::rail() const
  {
    return rail_profile.value();
  }


  std::shared_ptr<const std::vector<ProfileCurve>> WheelOnRail::rail_sections(const double along) const
  {
    if (rail_section)
      return rail_section;
    auto sections = std::make_shared<std::vector<ProfileCurve>>();
    for (const ProfileCurve &curve : rail_of->sections(along))
      sections->push_back(curve.moved(rail_y, rail_z));
    return sections;
  }


  std::shared_ptr<OverlapSearch> WheelOnRail::search_at(const WheelsetPosition &position) const
  {
    if (std::shared_ptr<OverlapSearch> last = std::atomic_load(&last_search);
        last && last->is_at(*this, position))
      return last;
    auto search = std::make_shared<OverlapSearch>(*this, position);
    std::atomic_store(&last_search, search);
    return search;
  }


  const ProfileCurve &WheelOnRail::wheel() const
  {
    return wheel_profile;
  }


  double WheelOnRail::rail_origin_y() const
  {
    return rail_y;
  }


  double WheelOnRail::rail_origin_z() const
  {
    return rail_z;
  }


  double WheelOnRail::wheel_origin_y() const
  {
    return wheel_y;
  }


  Vector3d WheelOnRail::axle(const WheelsetPosition &position)
  {
    return Rotation(position).y;
  }


  Vector3d WheelOnRail::middle(const WheelsetPosition &position, const double radius)
  {
    return {0., position.shift, radius + position.height};
  }


  WheelOnRail::SurfacePoint WheelOnRail::surface(const WheelsetPosition &position,
                                                 const double            s,
                                                 const double            angle) const
  {
    const Rotation            turn(position);
    const ProfileCurve::Place p    = wheel_profile.at(s);
    const double              r    = nominal_radius - p.z;
    const double              sine = std::sin(angle), cosine = std::cos(angle);
    SurfacePoint              point;
    point.place    = place(position, p.y, p.z, angle);
    point.by_s     = turn(-p.dz * sine, p.dy, p.dz * cosine);
    point.by_angle = turn(r * cosine, 0., r * sine);
    return point;
  }


  Vector3d WheelOnRail::place(const WheelsetPosition &position,
                              const double            y,
                              const double            z,
                              const double            angle) const
  {
    const double r     = nominal_radius - z;
    Vector3d     place = Rotation(position)(r * std::sin(angle), wheel_y + y, -r * std::cos(angle));
    place[1] += position.shift;
    place[2] += nominal_radius + position.height;
    return place;
  }


  std::optional<WheelOnRail::OutlinePoint> WheelOnRail::outline(const WheelsetPosition &position,
                                                                const double            s) const
  {
    const ProfileCurve::Place  p    = wheel_profile.at(s);
    const std::optional<Angle> turn = on_outline(Rotation(position), p);
    if (!turn)
      return {};
    const double angle = std::atan2(turn->sine, turn->cosine);
    return OutlinePoint{s, angle, place(position, p.y, p.z, angle)};
  }


  double WheelOnRail::gap(const WheelsetPosition &position, const double s, OutlinePoint &point) const
  {
    const std::optional<OutlinePoint> found = outline(position, s);
    if (!found)
      return no_rail;
    point          = *found;
    const double y = point.place[1];
    return y < rail_profile->begin() || y > rail_profile->end() ? no_rail
                                                                : point.place[2] - rail_profile->height(y);
  }


  std::vector<std::size_t> WheelOnRail::near_samples(const WheelsetPosition &position) const
  {
    constexpr double    round_off = 1e-11; // m
    const Rotation      turn(position);
    std::vector<double> least(samples.size(), no_rail);
    double              most = no_rail; // that the smallest gap can be
    for (std::size_t i = 0; i < samples.size(); ++i)
      {
        const ProfileCurve::Place &p     = places[i];
        const std::optional<Angle> angle = on_outline(turn, p);
        if (!angle)
          continue;
        const double   r     = nominal_radius - p.z;
        const Vector3d place = turn(r * angle->sine, wheel_y + p.y, -r * angle->cosine);
        const double   y = place[1] + position.shift, z = place[2] + nominal_radius + position.height;
        if (y < rail_profile->begin() || y > rail_profile->end())
          continue;
        const CurveFromAbove::RoughHeight rail = rail_profile->rough_height(y);
        least[i]                               = z - rail.z - rail.error;
        most                                   = std::min(most, z - rail.z + rail.error);
      }
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (least[i] < no_rail && least[i] <= most + round_off)
        near.push_back(i);
    return near;
  }


  WheelOnRail::Nearest WheelOnRail::nearest(const WheelsetPosition &position) const
  {
    if (!is_constant())
      return search_at(position)->nearest(position.height);
    Nearest      best{no_rail, {}};
    std::size_t  place = 0;
    OutlinePoint point{};
    for (const std::size_t i : near_samples(position))
      if (const double g = gap(position, samples[i], point); g < best.gap - 1e-12)
        {
          best  = {g, point};
          place = i;
        }
    if (best.gap == no_rail)
      throw std::runtime_error("wheel and rail do not meet: nothing of the wheel is above the rail");
    if (place == 0 || place + 1 == samples.size())
      throw std::runtime_error(
        "the wheel meets the rail with the edge of its profile only: it falls between the rails "
        "or off them");
    if (const double y = best.point.place[1], edge = 2. * sample_spacing;
        y < rail_profile->begin() + edge || y > rail_profile->end() - edge)
      throw std::runtime_error(
        "wheel and rail do not meet on the rail's head, but at the end of its profile");
    // A minimum is no sharper than half of the digits.
    constexpr int digits = std::numeric_limits<double>::digits / 2;
    boost::math::tools::brent_find_minima(
      [&](const double s) {
        const double g = gap(position, s, point);
        if (g < best.gap)
          best = {g, point};
        return g;
      },
      samples[place - 1], samples[place + 1], digits);
    best.inclination = std::atan(rail_profile->slope(best.point.place[1]));
    return best;
  }


  std::vector<WheelOnRail::Region> WheelOnRail::overlaps(const WheelsetPosition &position,
                                                         const double            separation) const
  {
    if (!is_constant())
      return search_at(position)->overlaps(position.height, separation);
    // Intervals of the wheel's profile below the rail, their ends to round-off.
    struct Interval
    {
      double begin, end;
    };
    std::vector<Interval> intervals;
    OutlinePoint          point{};
    const auto            border = [&](double outside, double inside) {
      for (unsigned int i = 0; i < 50; ++i)
        {
          const double middle                                    = 0.5 * (outside + inside);
          (gap(position, middle, point) < 0. ? inside : outside) = middle;
        }
      return inside;
    };
    bool below = false;
    for (std::size_t i = 0; i < samples.size(); ++i)
      {
        const bool now = gap(position, samples[i], point) < 0.;
        if (now && !below)
          intervals.push_back({i > 0 ? border(samples[i - 1], samples[i]) : samples[i], samples[i]});
        if (now)
          intervals.back().end = samples[i];
        if (!now && below)
          intervals.back().end = border(samples[i], samples[i - 1]);
        below = now;
      }
    if (intervals.empty()) // less than two samples overlap
      if (const Nearest deepest = nearest(position); deepest.gap < 0.)
        intervals.push_back({border(deepest.point.s - sample_spacing, deepest.point.s),
                             border(deepest.point.s + sample_spacing, deepest.point.s)});

    std::vector<Region>                regions;
    std::vector<std::vector<Interval>> parts;
    for (const Interval &interval : intervals)
      if (!parts.empty() && interval.begin - parts.back().back().end < separation)
        parts.back().push_back(interval);
      else
        parts.push_back({interval});
    for (const std::vector<Interval> &together : parts)
      {
        Region region;
        region.s_begin = together.front().begin;
        region.s_end   = together.back().end;
        region.parts   = together.size();
        // Along x the depth falls by x^2/(2 R): the square of the depth over the area is, across, the depth
        // to the power of 5/2.
        double weights = 0., x = 0., y = 0., angle = 0.;
        for (const Interval &interval : together)
          {
            constexpr unsigned int n = 400;
            for (unsigned int i = 0; i < n; ++i)
              {
                const double s      = interval.begin + (i + 0.5) / n * (interval.end - interval.begin);
                const double depth  = std::max(0., -gap(position, s, point));
                const double slope  = std::atan(rail_profile->slope(point.place[1]));
                const double weight = std::pow(depth, 2.5) * std::abs(wheel_profile.at(s).dy) *
                                      (interval.end - interval.begin) / n;
                weights += weight;
                x += weight * point.place[0];
                y += weight * point.place[1];
                angle += weight * slope;
                region.overlap = std::max(region.overlap, depth * std::cos(slope));
              }
          }
        if (!(weights > 0.))
          continue;
        y /= weights;
        region.angle     = angle / weights;
        region.reference = {x / weights, y, rail_profile->height(y)};
        regions.push_back(region);
      }
    return regions;
  }
} // namespace tread
