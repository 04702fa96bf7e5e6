// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/geometry/measured_profile.h>
#include <tread/geometry/profile_faults.h>
#include <tread/geometry/smoothing_spline.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace tread
{
  namespace
  {
    using Points = std::vector<ProfilePoint>;

    /// What belongs to the crown of a rail, or to the middle of a tread, m.
    constexpr double crown = 20e-3;

    /// Anything that is further beyond a tread is a flange, the face of the rim, or wrong, m.
    constexpr double beyond_tread = 10e-3;

    struct Extent
    {
      double least = 1e300, most = -1e300;
      void   add(const double value)
      {
        least = std::min(least, value);
        most  = std::max(most, value);
      }
      double size() const
      {
        return most - least;
      }
    };

    template <typename Wanted>
    Extent extent_of(const Points &points, double ProfilePoint::*coordinate, const Wanted &wanted)
    {
      Extent extent;
      for (const ProfilePoint &p : points)
        if (wanted(p))
          extent.add(p.*coordinate);
      return extent;
    }

    bool any(const ProfilePoint &)
    {
      return true;
    }

    std::string place_of(const ProfilePoint &p)
    {
      return "y = " + text_in_mm(p.y) + " mm, z = " + text_in_mm(p.z) + " mm";
    }

    /// Units in which a length of so many mm would be that of a profile.
    std::string units_for(const double span)
    {
      constexpr double                      least = 24e-3, most = 250e-3;
      std::string                           names;
      const std::pair<const char *, double> units[] = {{"m", 1e3}, {"inch", 25.4}, {"cm", 10.}, {"um", 1e-3}};
      for (const auto &[name, in_mm] : units)
        if (in_mm * span >= least && in_mm * span <= most)
          names += (names.empty() ? "" : " or ") + std::string(name);
      return names.empty() ? "" : "; are its lengths in " + names + "? They must be in mm";
    }

    void refuse_units(const std::string &file, const Points &points, const ProfileBody body)
    {
      const bool   is_rail = body == ProfileBody::rail;
      const Extent y = extent_of(points, &ProfilePoint::y, any), z = extent_of(points, &ProfilePoint::z, any);
      constexpr double narrowest = 20e-3, widest = 400e-3, highest = 300e-3, lowest_rail = 0.04e-3,
                       lowest_wheel = 0.1e-3, round_off = 1e-9;
      if (y.size() < narrowest)
        refuse_profile(file, 0,
                       "reaches from " + text_in_mm(y.least) + " mm to " + text_in_mm(y.most) +
                         " mm; at least " + (is_rail ? "12" : "25") + " mm at both sides are needed" +
                         units_for(y.size()));
      if (y.size() > widest)
        refuse_profile(file, 0,
                       "is " + text_in_mm(y.size()) + " mm wide, more than any " +
                         (is_rail ? "rail" : "wheel") + units_for(y.size()));
      if (z.size() > highest)
        refuse_profile(file, 0,
                       "heights span " + text_in_mm(z.size()) + " mm, more than those of any " +
                         (is_rail ? "rail" : "wheel") + ": are they in um? They must be in mm");
      if (z.size() > round_off && z.size() < (is_rail ? lowest_rail : lowest_wheel))
        refuse_profile(file, 0,
                       "heights span " + text_in_mm(z.size()) + " mm over " + text_in_mm(y.size()) +
                         " mm of width: are they in m? They must be in mm");
    }

    /// Where the line goes from one side of y = 0 to the other, by indices: the last point on one side of a
    /// strip around it, and the first on the other.
    std::pair<std::size_t, std::size_t> crossing(const std::string &file,
                                                 const Points      &points,
                                                 const ProfileBody  body)
    {
      constexpr double                                 strip = 5e-3; // m, half
      std::vector<std::pair<std::size_t, std::size_t>> found;
      std::optional<std::size_t>                       last; // outside of the strip
      for (std::size_t i = 0; i < points.size(); ++i)
        if (std::abs(points[i].y) >= strip)
          {
            if (last && points[*last].y * points[i].y < 0.)
              found.emplace_back(*last, i);
            last = i;
          }
      const char *middle = body == ProfileBody::rail ? "the middle y = 0" : "the running circle y = 0";
      if (found.empty())
        {
          const Extent y = extent_of(points, &ProfilePoint::y, any);
          refuse_profile(file, 0,
                         "reaches from " + text_in_mm(y.least) + " mm to " + text_in_mm(y.most) +
                           " mm, to one side of " + middle + " only; at least " +
                           (body == ProfileBody::rail ? "12" : "25") +
                           " mm at both sides are needed: place it by its mirroring and its shift");
        }
      if (found.size() > 1)
        refuse_profile(
          file, points[found[1].second].line,
          std::string("the line comes to ") + middle +
            " again: does it run round the whole section, or does the file have more than one profile?");
      return found.front();
    }

    /// z = level + slope y + bend y^2 of best fit through the points from one index to another within the
    /// crown.
    struct Parabola
    {
      double       level = 0., slope = 0., bend = 0.;
      unsigned int n = 0;
    };

    Parabola fit(const Points &points, std::size_t from, std::size_t to)
    {
      while (from > 0 && std::abs(points[from - 1].y) <= crown)
        --from;
      while (to + 1 < points.size() && std::abs(points[to + 1].y) <= crown)
        ++to;
      double   m[3][4] = {};
      Parabola p;
      for (std::size_t i = from; i <= to; ++i)
        if (const double u = points[i].y / crown; std::abs(u) <= 1.)
          {
            const double powers[] = {1., u, u * u};
            for (unsigned int r = 0; r < 3; ++r)
              {
                for (unsigned int k = 0; k < 3; ++k)
                  m[r][k] += powers[r] * powers[k];
                m[r][3] += powers[r] * points[i].z;
              }
            ++p.n;
          }
      constexpr unsigned int enough = 5;
      if (p.n < enough)
        return p;
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int r = k + 1; r < 3; ++r)
          {
            const double factor = m[r][k] / m[k][k];
            for (unsigned int i = k; i < 4; ++i)
              m[r][i] -= factor * m[k][i];
          }
      const double c = m[2][3] / m[2][2], b = (m[1][3] - m[1][2] * c) / m[1][1],
                   a = (m[0][3] - m[0][1] * b - m[0][2] * c) / m[0][0];
      if (!std::isfinite(a) || !std::isfinite(b) || !std::isfinite(c))
        {
          p.n = 0;
          return p;
        }
      p.level = a;
      p.slope = b / crown;
      p.bend  = c / (crown * crown);
      return p;
    }

    void refuse_steep_middle(const std::string &file, const Points &points, const ProfileBody body)
    {
      constexpr double half_width = 10e-3, most = 12e-3; // m
      const Extent     z = extent_of(points, &ProfilePoint::z,
                                     [](const ProfilePoint &p) { return std::abs(p.y) <= half_width; });
      if (z.size() > most)
        refuse_profile(file, 0,
                       "its heights differ by " + text_in_mm(z.size()) + " mm within " +
                         text_in_mm(half_width) + " mm of " +
                         (body == ProfileBody::rail ? "the middle y = 0" : "the running circle y = 0") +
                         ", more than those of any " + (body == ProfileBody::rail ? "rail" : "wheel") +
                         ": is y = 0 elsewhere, or are heights in um?");
    }

    void from_low_to_high(Points &points)
    {
      if (points.front().y > points.back().y)
        std::reverse(points.begin(), points.end());
    }

    /// z up, and 0 at the highest point of the crown. Whether z points up is seen from the bend of the crown.
    void orient_rail(const std::string &file, Points &points)
    {
      const auto [from, to] = crossing(file, points, ProfileBody::rail);
      const Parabola   p    = fit(points, from, to);
      constexpr double flat = 0.1, far = 5e-3; // 1/m: 0.04 mm at 20 mm; m
      // Where both ends are far to one side of the middle they say it, also if the crown is hollow.
      const double middle = p.n > 0 ? p.level : points[from].z, first = points.front().z - middle,
                   last = points.back().z - middle;
      bool down         = first + last > 0.;
      if (std::min(first, last) <= far && std::max(first, last) >= -far && p.n > 0 && std::abs(p.bend) > flat)
        down = p.bend > 0.;
      if (down)
        for (ProfilePoint &point : points)
          point.z = -point.z;
      refuse_steep_middle(file, points, ProfileBody::rail);
      const Extent on_top = extent_of(points, &ProfilePoint::z,
                                      [](const ProfilePoint &point) { return std::abs(point.y) <= crown; });
      for (ProfilePoint &point : points)
        point.z -= on_top.most;
      from_low_to_high(points);

      constexpr double above = 1e-3, tilt = 0.1, widest = 55e-3, wide_depth = 10e-3;
      for (const ProfilePoint &point : points)
        {
          const double beside = std::max(0., std::abs(point.y) - crown);
          if (point.z > above + tilt * beside)
            refuse_profile(
              file, point.line,
              "the point at y = " + text_in_mm(point.y) + " mm lies " + text_in_mm(point.z) +
                " mm above the top of the head, as no rail's does: is the head upside down, is it a "
                "wheel, or something that lies on the rail?");
          if (std::abs(point.y) > widest && point.z > -wide_depth)
            refuse_profile(
              file, point.line,
              "the head reaches to y = " + text_in_mm(point.y) +
                " mm, as no rail's does: is it the profile of a wheel, or is y = 0 not its middle?");
        }
      // A flat head, or heights in another unit.
      constexpr double side = 30e-3, least_drop = 0.5e-3;
      const auto       highest_beyond = [&](const double sign) {
        return extent_of(points, &ProfilePoint::z,
                               [&](const ProfilePoint &point) { return sign * point.y >= side; });
      };
      const Extent low = highest_beyond(-1.), high = highest_beyond(1.);
      if (low.size() >= 0. && high.size() >= 0. && low.least > -least_drop && high.least > -least_drop)
        refuse_profile(file, 0,
                       "lies only " + text_in_mm(-std::min(low.least, high.least)) + " mm below its top " +
                         text_in_mm(side) +
                         " mm beside its middle, as no rail does: are heights in another unit?");
      // One side like a flange, the other flat: a wheel.
      constexpr double deep = 15e-3, rises = 3e-3, shallow = 4e-3, far_side = 34e-3;
      for (const double sign : {-1., 1.})
        {
          double                      lowest = 0.;
          std::optional<ProfilePoint> back;
          const auto                  look = [&](const ProfilePoint &point) {
            if (sign * point.y > crown)
              {
                lowest = std::min(lowest, point.z);
                if (!back && lowest < -deep && point.z > lowest + rises)
                  back = point;
              }
          };
          if (sign > 0.)
            std::for_each(points.begin(), points.end(), look);
          else
            std::for_each(points.rbegin(), points.rend(), look);
          const Extent other = extent_of(points, &ProfilePoint::z, [&](const ProfilePoint &point) {
            return sign * point.y < 0. && std::abs(point.y) <= far_side;
          });
          const Extent reach = extent_of(points, &ProfilePoint::y, any);
          if (back && other.least > -shallow && std::max(-sign * reach.least, -sign * reach.most) > far_side)
            refuse_profile(file, back->line,
                           "a flange at " + place_of(*back) + ": is it the profile of a wheel?");
        }
    }

    /// How a wheel's points would lie with y, z or both turned round.
    struct Turned
    {
      double       along, up;
      bool         has_back = false; ///< the flange has both of its flanks
      unsigned int line     = 0;     ///< of the flange's tip
    };

    /// Whether the points, from low to high y and z up, are a wheel with its flange at y < 0: a flange below
    /// the running circle, between two flanks or up to its rounded tip; nothing above the tread before it; on
    /// the other side a tread, and at its end perhaps the face of the rim, which goes up.
    bool is_wheel(const Points &p, Turned &turned)
    {
      constexpr double deepest = 60e-3, nearest = 12e-3, furthest = 110e-3, back_rises = 2e-3, above = 12e-3,
                       rim_rises = 8e-3, rim_falls = 3e-3, rounding = 3e-3, near = 3e-3;
      std::size_t middle = 0;
      for (std::size_t i = 0; i < p.size(); ++i)
        if (std::abs(p[i].y) < std::abs(p[middle].y))
          middle = i;
      double sum = 0.;
      int    n   = 0;
      for (const ProfilePoint &point : p)
        if (std::abs(point.y) <= std::max(near, std::abs(p[middle].y)))
          {
            sum += point.z;
            ++n;
          }
      const double level = sum / n;
      std::size_t  tip   = middle;
      for (std::size_t i = 0; i <= middle; ++i)
        if (p[i].z < p[tip].z)
          tip = i;
      const double depth = level - p[tip].z;
      if (depth <= beyond_tread || depth > deepest || p[tip].y > -nearest || p[tip].y < -furthest)
        return false;
      for (std::size_t i = tip; i <= middle; ++i)
        if (p[i].z > level + above)
          return false;
      double highest = level;
      for (std::size_t i = middle; i < p.size(); ++i)
        {
          highest = std::max(highest, p[i].z);
          if (p[i].z < level - beyond_tread || (highest > level + rim_rises && p[i].z < highest - rim_falls))
            return false;
        }
      double back = p[tip].z;
      for (std::size_t i = 0; i < tip; ++i)
        back = std::max(back, p[i].z);
      turned.has_back = back > p[tip].z + back_rises;
      turned.line     = p[tip].line;
      if (turned.has_back)
        return true;
      // Without its back the flange must end in its tip, which the face of a rim does not have.
      std::size_t inner = 0;
      while (inner + 1 < p.size() && std::hypot(p[inner].y - p[0].y, p[inner].z - p[0].z) < rounding)
        ++inner;
      return std::abs(p[inner].z - p[0].z) < std::abs(p[inner].y - p[0].y);
    }

    Points turned_round(Points points, const double along, const double up)
    {
      for (ProfilePoint &p : points)
        {
          p.y *= along;
          p.z *= up;
        }
      from_low_to_high(points);
      return points;
    }

    /// z up, the flange at y < 0. @returns whether there is one
    bool orient_wheel(const std::string &file, Points &points)
    {
      crossing(file, points, ProfileBody::wheel);
      refuse_steep_middle(file, points, ProfileBody::wheel);
      std::vector<Turned> found;
      for (const double along : {1., -1.})
        for (const double up : {1., -1.})
          if (Turned turned{along, up}; is_wheel(turned_round(points, along, up), turned))
            found.push_back(turned);
      if (std::any_of(found.begin(), found.end(), [](const Turned &t) { return t.has_back; }))
        found.erase(std::remove_if(found.begin(), found.end(), [](const Turned &t) { return !t.has_back; }),
                    found.end());
      if (found.size() > 1)
        refuse_profile(file, found[1].line,
                       "the flange may be here or in line " + std::to_string(found[0].line) +
                         ": cut off what is no part of the profile");
      if (found.size() == 1)
        {
          points = turned_round(points, found[0].along, found[0].up);
          return true;
        }
      // No flange: then nothing may be as far from the tread as one.
      const Points ordered = turned_round(points, 1., 1.);
      const auto   middle =
        std::min_element(ordered.begin(), ordered.end(), [](const ProfilePoint &a, const ProfilePoint &b) {
          return std::abs(a.y) < std::abs(b.y);
        });
      const auto furthest =
        std::max_element(ordered.begin(), ordered.end(), [&](const ProfilePoint &a, const ProfilePoint &b) {
          return std::abs(a.z - middle->z) < std::abs(b.z - middle->z);
        });
      if (std::abs(furthest->z - middle->z) > beyond_tread)
        refuse_profile(
          file, furthest->line,
          text_in_mm(std::abs(furthest->z - middle->z)) + " mm from the running circle y = 0 at " +
            place_of(*furthest) +
            ", but there is no flange, which lies on one side 10 to 60 mm below the tread, between two "
            "flanks: is y = 0 elsewhere, is the flange cut off, is it the face of the rim, or the "
            "profile of a rail?");
      constexpr double flange_begins = 45e-3;
      if (ordered.front().y < -flange_begins && ordered.back().y > flange_begins)
        refuse_profile(file, 0,
                       "has no flange, although it reaches from " + text_in_mm(ordered.front().y) +
                         " mm to " + text_in_mm(ordered.back().y) +
                         " mm: are heights in another unit, or is y = 0 not the running circle?");
      // A tread becomes larger towards its flange.
      const auto       line  = fit(ordered, middle - ordered.begin(), middle - ordered.begin());
      constexpr double steep = 1. / 200.;
      if (line.n > 0 && line.slope < -steep)
        refuse_profile(
          file, 0,
          "has no flange, and its tread falls from y < 0 to y > 0 by 1:" +
            text_of(std::round(-1. / line.slope)) +
            ", as none does whose flange side is y < 0 and whose z points up: turn y or z round");
      points = ordered;
      return false;
    }

    void smooth(const std::string &file, MeasuredProfile &profile, const double length)
    {
      std::vector<dealii::Point<2>> curve;
      for (const ProfilePoint &p : profile.measured)
        curve.emplace_back(p.y, p.z);
      try
        {
          curve = smoothed(curve, length);
        }
      catch (const std::runtime_error &error)
        {
          refuse_profile(file, 0, error.what());
        }
      for (std::size_t i = 0; i < curve.size(); ++i)
        {
          ProfilePoint       &p      = profile.points[i];
          const ProfilePoint &before = profile.measured[i > 0 ? i - 1 : i],
                             &behind = profile.measured[i + 1 < curve.size() ? i + 1 : i];
          p.y                        = curve[i][0];
          p.z                        = curve[i][1];
          const double along_y = behind.y - before.y, along_z = behind.z - before.z,
                       change = std::abs((p.y - profile.measured[i].y) * along_z -
                                         (p.z - profile.measured[i].z) * along_y) /
                                std::hypot(along_y, along_z);
          if (change > profile.largest_change)
            {
              profile.largest_change = change;
              profile.y_of_change    = p.y;
            }
        }
    }
    void set_zero(MeasuredProfile &profile, const double level)
    {
      for (Points *points : {&profile.points, &profile.measured})
        for (ProfilePoint &p : *points)
          p.z -= level;
    }
  } // namespace


  double MeasuredProfile::pressure_of_noise(const double modulus) const
  {
    return spacing > 0. ? std::numbers::pi * modulus * std::numbers::sqrt2 * noise / (2. * spacing) : 0.;
  }


  namespace
  {
    /// y of the back of the flange, which stands upright behind its rounded tip. Nothing where the points end
    /// before it.
    std::optional<double> flange_back(const Points &points)
    {
      // Behind the tip of S1002, an arc of 12 mm, so much higher the back is 0.7 mm away.
      constexpr double least_rise = 8e-3;
      const auto       before =
        std::find_if(points.begin(), points.end(), [](const ProfilePoint &p) { return p.y > 0.; });
      if (before == points.begin())
        return {};
      const auto lower = [](const ProfilePoint &a, const ProfilePoint &b) {
        return a.z < b.z;
      };
      const auto tip  = std::min_element(points.begin(), before, lower);
      const auto back = std::min_element(
        points.begin(), tip + 1, [](const ProfilePoint &a, const ProfilePoint &b) { return a.y < b.y; });
      const auto top = std::max_element(points.begin(), tip + 1, lower);
      return top->z > tip->z + least_rise ? std::optional<double>(back->y) : std::nullopt;
    }
  } // namespace


  MeasuredProfile read_measured_profile(const std::string      &file,
                                        const ProfileBody       body,
                                        const ProfilePlacement &placement)
  {
    MeasuredProfile profile;
    Points          points = read_profile_points(file, body);
    for (ProfilePoint &p : points)
      p.y = (placement.is_mirrored ? -p.y : p.y) + placement.shift;
    refuse_units(file, points, body);
    if (placement.smoothing > 0.) // which takes small turns away; points that coincide have no direction
      points.erase(std::unique(points.begin(), points.end(),
                               [](const ProfilePoint &a, const ProfilePoint &b) {
                                 return std::hypot(a.y - b.y, a.z - b.z) < 1e-9;
                               }),
                   points.end());
    if (placement.smoothing == 0.)
      points = without_turns_back(file, points, false, profile.remarks);
    refuse_spikes(file, points);
    if (placement.smoothing == 0.) // what turns back and is no spike
      points = without_turns_back(file, points, true, profile.remarks);
    if (body == ProfileBody::rail)
      orient_rail(file, points);
    else
      profile.has_flange = orient_wheel(file, points);
    profile.points = profile.measured = points;
    if (placement.smoothing > 0.)
      smooth(file, profile, placement.smoothing);
    if (body == ProfileBody::rail)
      set_zero(profile, extent_of(profile.points, &ProfilePoint::z, [](const ProfilePoint &p) {
                          return std::abs(p.y) <= crown;
                        }).most);
    else
      for (std::size_t i = 1; i < points.size(); ++i)
        if (const ProfilePoint a = profile.points[i - 1], b = profile.points[i]; a.y <= 0. && b.y > 0.)
          {
            set_zero(profile, a.z - a.y / (b.y - a.y) * (b.z - a.z));
            break;
          }
    if (profile.has_flange)
      profile.flange_back = flange_back(profile.points);
    std::tie(profile.noise, profile.spacing) = noise_and_spacing(profile.points, crown);
    if (body == ProfileBody::wheel && !profile.has_flange)
      profile.remarks.push_back(
        "profile '" + file +
        "' has no flange that would show how it lies: it is taken with z up and the flange's "
        "side at y < 0");
    return profile;
  }
} // namespace tread
