// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/measured_line.h>
#include <tread/geometry/natural_spline.h>
#include <tread/geometry/profile_curve.h>
#include <tread/geometry/rail_profile.h>
#include <tread/geometry/wheel_tread.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tread
{
  namespace
  {
    using Point = dealii::Point<2>;

    /// Distance of the points that stand for profiles given by formulas, m. Their splines then lie within
    /// 1e-9 m of them, apart from 5e-8 m beside a step of the curvature.
    constexpr double spacing = 0.1e-3;

    std::vector<Point> s1002_points(const double begin, const double end)
    {
      std::vector<Point> points;
      double             y = begin;
      while (y < end)
        {
          points.emplace_back(y, -s1002_offset(y));
          // At the back of the flange the profile stands upright.
          const double h     = std::min(1e-6, 0.5 * (y + 70.0001e-3));
          const double slope = (s1002_offset(y + h) - s1002_offset(std::max(-70e-3, y - h))) / (2. * h);
          y += std::clamp(spacing / std::hypot(1., slope), 1e-7, spacing);
        }
      points.emplace_back(end, -s1002_offset(end));
      return points;
    }

    /// A cone with the flange of S1002: its straight flank goes over into the cone by the arc R13 of the
    /// throat.
    std::vector<Point> cone_points(const double slope)
    {
      // Flank z = 93.58 mm + 2.747 y downwards (EN 13715), cone z = slope y, both in z up.
      constexpr double flank_slope = 2.747477419, flank_level = 93.576667419e-3, radius = 13e-3;
      const double     flank = std::atan(flank_slope), cone = std::atan(slope);
      // The arc's middle lies above neither: below the surface z of the wheel's metal is up, the throat is
      // hollow towards the rail, so that its middle lies on the rail's side of both lines.
      const double level_1 = flank_level - radius / std::cos(flank), level_2 = -radius / std::cos(cone);
      const double y_middle = (level_2 - level_1) / (flank_slope - slope),
                   z_middle = level_2 + slope * y_middle;
      const Point        on_flank(y_middle - radius * std::sin(flank), z_middle + radius * std::cos(flank));
      const Point        on_cone(y_middle - radius * std::sin(cone), z_middle + radius * std::cos(cone));
      std::vector<Point> points = s1002_points(-70e-3, -39.764474e-3);
      const auto         add    = [&](const unsigned int n, const auto &place) {
        for (unsigned int i = 1; i <= n; ++i)
          points.push_back(place(double(i) / n));
      };
      const Point from = points.back();
      if (on_flank[0] > from[0])
        add(std::ceil(from.distance(on_flank) / spacing),
            [&](const double t) { return from + t * (on_flank - from); });
      add(std::ceil(radius * (flank - cone) / spacing), [&](const double t) {
        const double angle = flank + t * (cone - flank);
        return Point(y_middle - radius * std::sin(angle), z_middle + radius * std::cos(angle));
      });
      const Point end(60e-3, slope * 60e-3);
      add(std::ceil(on_cone.distance(end) / spacing),
          [&](const double t) { return on_cone + t * (end - on_cone); });
      return points;
    }
  } // namespace


  ProfileCurve::ProfileCurve(const std::vector<Point> &given)
  {
    constexpr double coincident = 1e-9; // m
    for (const Point &p : given)
      if (points.empty() || p.distance(points.back()) > coincident)
        {
          s.push_back(points.empty() ? 0. : s.back() + p.distance(points.back()));
          points.push_back(p);
        }
    if (points.size() < 4)
      throw std::runtime_error("has less than four points");
    bend.resize(points.size());
    std::vector<double> values(points.size());
    for (const unsigned int d : {0, 1})
      {
        for (std::size_t i = 0; i < points.size(); ++i)
          values[i] = points[i][d];
        const std::vector<double> of_coordinate = natural_spline(s, values);
        for (std::size_t i = 0; i < points.size(); ++i)
          bend[i][d] = of_coordinate[i];
      }
  }


  double ProfileCurve::length() const
  {
    return s.back();
  }


  const std::vector<double> &ProfileCurve::knots() const
  {
    return s;
  }


  ProfileCurve::Place ProfileCurve::at(const double place) const
  {
    const std::size_t i =
      std::clamp<std::ptrdiff_t>(std::upper_bound(s.begin(), s.end(), place) - s.begin() - 1, 0,
                                 static_cast<std::ptrdiff_t>(s.size()) - 2);
    const double      h = s[i + 1] - s[i];
    const SplinePiece piece(h, (place - s[i]) / h);
    double            value[2], derivative[2];
    for (const unsigned int d : {0, 1})
      {
        value[d]      = piece.value(points[i][d], points[i + 1][d], bend[i][d], bend[i + 1][d]);
        derivative[d] = piece.slope(points[i][d], points[i + 1][d], bend[i][d], bend[i + 1][d]);
      }
    return {value[0], value[1], derivative[0], derivative[1]};
  }


  double ProfileCurve::radius(const double place) const
  {
    // Over two points on each side, so that the last digits of measured points do not decide.
    constexpr double step = 0.5e-3;
    const double     low = std::max(0., place - step), high = std::min(length(), place + step);
    const Place      p = at(low), q = at(high);
    const double     turn = std::atan2(p.dz, p.dy) - std::atan2(q.dz, q.dy);
    return turn == 0. ? 1e300 : (high - low) / std::remainder(turn, 2. * dealii::numbers::PI);
  }


  ProfileCurve ProfileCurve::turned(const double angle) const
  {
    const double       c = std::cos(angle), sine = std::sin(angle);
    std::vector<Point> result;
    for (const Point &p : points)
      result.emplace_back(c * p[0] - sine * p[1], sine * p[0] + c * p[1]);
    return ProfileCurve(result);
  }


  ProfileCurve ProfileCurve::moved(const double along_y, const double along_z) const
  {
    std::vector<Point> result;
    for (const Point &p : points)
      result.emplace_back(p[0] + along_y, p[1] + along_z);
    return ProfileCurve(result);
  }


  CurveFromAbove::CurveFromAbove(const ProfileCurve &curve, const double y_middle)
    : line(curve)
  {
    std::vector<double> all;
    for (std::size_t i = 0; i + 1 < curve.knots().size(); ++i)
      for (const double share : {0., 0.5})
        all.push_back(curve.knots()[i] + share * (curve.knots()[i + 1] - curve.knots()[i]));
    all.push_back(curve.length());
    constexpr double near_middle = 25e-3;
    std::size_t      top         = all.size();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (const ProfileCurve::Place p = curve.at(all[i]);
          std::abs(p.y - y_middle) <= near_middle && (top == all.size() || p.z > curve.at(all[top]).z))
        top = i;
    if (top == all.size())
      throw std::runtime_error("has no point within 25 mm of its middle");
    constexpr double least = 1e-3; // of dy/ds: steeper places are taken for upright
    std::size_t      first = top, last = top;
    while (first > 0 && curve.at(all[first - 1]).dy > least)
      --first;
    while (last + 1 < all.size() && curve.at(all[last + 1]).dy > least)
      ++last;
    for (std::size_t i = first; i <= last; ++i)
      {
        const ProfileCurve::Place p = curve.at(all[i]);
        s.push_back(all[i]);
        y.push_back(p.y);
        z.push_back(p.z);
      }
    if (s.size() < 2)
      throw std::runtime_error("does not run on in y at its top");
    for (std::size_t i = 0; i + 1 < s.size(); ++i)
      {
        // A cubic piece bends once or twice between the ends.
        constexpr unsigned int n    = 8;
        constexpr double       safe = 2.;
        double                 most = 0.;
        for (unsigned int k = 1; k < n; ++k)
          {
            const ProfileCurve::Place p = curve.at(s[i] + k * (s[i + 1] - s[i]) / n);
            most =
              std::max(most, std::abs(p.z - z[i] - (p.y - y[i]) / (y[i + 1] - y[i]) * (z[i + 1] - z[i])));
          }
        deviation.push_back(safe * most);
      }
  }


  double CurveFromAbove::begin() const
  {
    return y.front();
  }


  double CurveFromAbove::end() const
  {
    return y.back();
  }


  const ProfileCurve &CurveFromAbove::curve() const
  {
    return line;
  }


  std::size_t CurveFromAbove::step(const double at_y) const
  {
    return std::clamp<std::ptrdiff_t>(std::upper_bound(y.begin(), y.end(), at_y) - y.begin() - 1, 0,
                                      static_cast<std::ptrdiff_t>(y.size()) - 2);
  }


  CurveFromAbove::RoughHeight CurveFromAbove::rough_height(const double at_y) const
  {
    const std::size_t i = step(at_y);
    return {z[i] + (at_y - y[i]) / (y[i + 1] - y[i]) * (z[i + 1] - z[i]), deviation[i]};
  }


  double CurveFromAbove::parameter(const double at_y) const
  {
    const std::size_t i = step(at_y);
    double            t = s[i] + (at_y - y[i]) / (y[i + 1] - y[i]) * (s[i + 1] - s[i]);
    for (unsigned int k = 0; k < 8; ++k)
      {
        const ProfileCurve::Place p    = line.at(t);
        const double              step = (at_y - p.y) / p.dy;
        t                              = std::clamp(t + step, s[i], s[i + 1]);
        if (std::abs(step) < 1e-14)
          break;
      }
    return t;
  }


  double CurveFromAbove::height(const double at_y) const
  {
    return line.at(parameter(at_y)).z;
  }


  double CurveFromAbove::slope(const double at_y) const
  {
    const ProfileCurve::Place p = line.at(parameter(at_y));
    return p.dz / p.dy;
  }


  ProfileCurve wheel_curve(const std::string &tread, const ProfilePlacement &placement)
  {
    if (tread == "cylinder")
      {
        std::vector<Point> points;
        for (int i = -70; i <= 60; ++i)
          points.emplace_back(1e-3 * i, 0.);
        return ProfileCurve(points);
      }
    if (tread == "cone 1:40" || tread == "cone 1:20")
      return ProfileCurve(cone_points(tread == "cone 1:40" ? 1. / 40. : 1. / 20.));
    if (tread == "S1002")
      return ProfileCurve(s1002_points(-70e-3, 60e-3));
    std::vector<Point> points = read_wheel_points(tread, placement);
    return ProfileCurve(points);
  }


  ProfileCurve rail_curve(const RailProfile &profile)
  {
    const double       length = profile.head_length();
    const auto         n      = static_cast<int>(std::ceil(length / spacing));
    std::vector<Point> points;
    for (int i = -n; i <= n; ++i)
      points.push_back(profile.head_point(i * (length / n) * (1. - 1e-12)));
    return ProfileCurve(points);
  }


  ProfileCurve measured_rail_curve(const std::string &file, const ProfilePlacement &placement)
  {
    return ProfileCurve(read_rail_points(file, placement));
  }
} // namespace tread
