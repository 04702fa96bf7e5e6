// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/lagrange.h>
#include <tread/base/median.h>
#include <tread/geometry/profile_faults.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tread
{
  namespace
  {
    using Points = std::vector<ProfilePoint>;

    double distance(const ProfilePoint &a, const ProfilePoint &b)
    {
      return std::hypot(b.y - a.y, b.z - a.z);
    }

    /// Cosine of the angle by which the line turns at b.
    double cosine(const ProfilePoint &a, const ProfilePoint &b, const ProfilePoint &c)
    {
      const double lengths = distance(a, b) * distance(b, c);
      return lengths > 0. ? ((b.y - a.y) * (c.y - b.y) + (b.z - a.z) * (c.z - b.z)) / lengths : 1.;
    }

    /// The angle by which the line turns at b, positive to the left, rad.
    double turn(const ProfilePoint &a, const ProfilePoint &b, const ProfilePoint &c)
    {
      return std::atan2((b.y - a.y) * (c.z - b.z) - (b.z - a.z) * (c.y - b.y),
                        (b.y - a.y) * (c.y - b.y) + (b.z - a.z) * (c.z - b.z));
    }

    /// Distance of p from the cubic through four points, over the length of their chords, between the middle
    /// two of which p belongs.
    double distance_from_cubic(const ProfilePoint &p, const std::array<const ProfilePoint *, 4> &of)
    {
      const ProfilePoint &b = *of[1], &c = *of[2];
      const double        chord = distance(b, c), before = distance(*of[0], b), behind = distance(c, *of[3]);
      if (!(chord > 0.) || !(before > 0.) || !(behind > 0.))
        return 0.;
      const double t[4] = {-before, 0., chord, chord + behind};
      const auto   at   = [&](const double s) {
        std::array<double, 2> place{0., 0.};
        for (unsigned int i = 0; i < 4; ++i)
          {
            const double weight = lagrange_weight([&](const std::size_t k) { return t[k]; }, 4, i, s);
            place[0] += weight * of[i]->y;
            place[1] += weight * of[i]->z;
          }
        return place;
      };
      const double s = std::clamp(((p.y - b.y) * (c.y - b.y) + (p.z - b.z) * (c.z - b.z)) / chord, 0., chord);
      const double step = 1e-3 * chord;
      const auto   low = at(s - step), high = at(s + step), place = at(s);
      const double along_y = high[0] - low[0], along_z = high[1] - low[1],
                   length = std::hypot(along_y, along_z);
      return length > 0. ? std::abs((p.y - place[0]) * along_z - (p.z - place[1]) * along_y) / length : 0.;
    }

    /// Distance of each point from the cubic through its neighbours; 0 for the first and the last two.
    std::vector<double> distances_from_neighbours(const Points &p)
    {
      std::vector<double> result(p.size(), 0.);
      for (std::size_t i = 2; i + 2 < p.size(); ++i)
        result[i] = distance_from_cubic(p[i], {&p[i - 2], &p[i - 1], &p[i + 1], &p[i + 2]});
      return result;
    }
  } // namespace


  void refuse_spikes(const std::string &file, const Points &p)
  {
    constexpr double          least       = 10e-6; // m: steps of instruments are below
    constexpr double          above_noise = 8.;    // times the median, 7.5 standard deviations
    constexpr double          goes_on = 0.25; // of the spike: how far the neighbours may be off without it
    constexpr std::size_t     around  = 14;   // points at each side tell the noise
    const std::vector<double> off     = distances_from_neighbours(p);
    for (std::size_t width = 1; width <= 2; ++width)
      for (std::size_t i = 3; i + width + 2 < p.size(); ++i)
        {
          double      largest = 0.;
          std::size_t at      = i;
          for (std::size_t k = i; k < i + width; ++k)
            if (const double d =
                  distance_from_cubic(p[k], {&p[i - 2], &p[i - 1], &p[i + width], &p[i + width + 1]});
                d > largest)
              {
                largest = d;
                at      = k;
              }
          if (largest < least)
            continue;
          std::vector<double> others;
          for (std::size_t k = i > around ? i - around : 0; k < std::min(p.size(), i + width + around); ++k)
            if ((k + 2 < i || k > i + width + 1) && off[k] > 0.)
              others.push_back(off[k]);
          if (largest < above_noise * median(others))
            continue;
          // A corner stays one when its point is left out, a spike is gone; and a spike turns the line three
          // times, there, back and there again.
          const double before = distance_from_cubic(p[i - 1],
                                                    {&p[i - 3], &p[i - 2], &p[i + width], &p[i + width + 1]}),
                       behind = distance_from_cubic(
                         p[i + width], {&p[i - 2], &p[i - 1], &p[i + width + 1], &p[i + width + 2]});
          double within = 0.;
          for (std::size_t k = i; k < i + width; ++k)
            within += turn(p[k - 1], p[k], p[k + 1]);
          const double first = turn(p[i - 2], p[i - 1], p[i]),
                       last  = turn(p[i + width - 1], p[i + width], p[i + width + 1]),
                       sign  = within > 0. ? -1. : 1.;
          if (std::max(before, behind) < goes_on * largest && sign * first > goes_on * std::abs(within) &&
              sign * last > goes_on * std::abs(within))
            refuse_profile(file, p[at].line,
                           "the point at y = " + text_in_mm(p[at].y) + " mm, z = " + text_in_mm(p[at].z) +
                             " mm stands " + text_in_mm(largest) +
                             " mm off the line through its neighbours: a spike; take it out");
        }
  }


  Points without_turns_back(const std::string        &file,
                            Points                    p,
                            const bool                refuses,
                            std::vector<std::string> &remarks)
  {
    constexpr double      back = -0.34; // cosine of 110 degrees: no profile turns so far at one point
    constexpr double      most = 0.05e-3, off_line = 10e-6;
    constexpr std::size_t n_named = 3;
    std::size_t           n       = 0;
    // Points that coincide with the one before have no direction.
    p.erase(std::unique(p.begin(), p.end(),
                        [](const ProfilePoint &a, const ProfilePoint &b) { return distance(a, b) < 1e-9; }),
            p.end());
    for (std::size_t i = 1; i + 1 < p.size(); ++i)
      {
        if (cosine(p[i - 1], p[i], p[i + 1]) >= back)
          continue;
        // The point whose absence leaves the straightest line is the one that stands back.
        const auto straightness_without = [&](const std::size_t k) {
          std::vector<ProfilePoint> left;
          for (std::size_t j = i > 3 ? i - 3 : 0; j < std::min(p.size(), i + 5); ++j)
            if (j != k)
              left.push_back(p[j]);
          double least = 1.;
          for (std::size_t j = 1; j + 1 < left.size(); ++j)
            least = std::min(least, cosine(left[j - 1], left[j], left[j + 1]));
          return least;
        };
        std::size_t at = i;
        for (const std::size_t k : {i - 1, i + 1})
          if (straightness_without(k) > straightness_without(at) + 1e-12)
            at = k;
        const ProfilePoint &stands = p[at];
        double              step = distance(p[i], p[i + 1]), normal = 0.;
        step = std::min(step, distance(p[i - 1], p[i]));
        if (at > 0 && at + 1 < p.size() && distance(p[at - 1], p[at + 1]) > 0.)
          normal = std::abs((stands.y - p[at - 1].y) * (p[at + 1].z - p[at - 1].z) -
                            (stands.z - p[at - 1].z) * (p[at + 1].y - p[at - 1].y)) /
                   distance(p[at - 1], p[at + 1]);
        const std::string where = "the point at y = " + text_in_mm(stands.y) +
                                  " mm, z = " + text_in_mm(stands.z) + " mm stands " + text_in_mm(step) +
                                  " mm back on the line";
        const bool is_small = straightness_without(at) >= back && step <= most && normal <= off_line;
        if (!is_small && !refuses)
          continue;
        if (!is_small)
          refuse_profile(file, stands.line,
                         where +
                           ", which turns back there: take it out, or smooth by 'Smoothing length (mm)'");
        if (++n <= n_named)
          remarks.push_back("profile '" + file + "': line " + std::to_string(stands.line) + ": " + where +
                            ", and is left out");
        p.erase(p.begin() + at);
        i = i > 2 ? i - 3 : 0;
      }
    if (n > n_named)
      remarks.push_back(
        "profile '" + file + "': " + std::to_string(n - n_named) +
        " more points stand back on the line, and are left out; 'Smoothing length (mm)' smooths them");
    return p;
  }


  std::pair<double, double> noise_and_spacing(const Points &points, const double half_width)
  {
    constexpr double          of_median = 1. / 0.94;
    const std::vector<double> off       = distances_from_neighbours(points);
    std::vector<double>       near, spacing;
    for (std::size_t i = 2; i + 2 < points.size(); ++i)
      if (std::abs(points[i].y) <= half_width)
        {
          near.push_back(off[i]);
          spacing.push_back(distance(points[i - 1], points[i]));
        }
    return {of_median * median(near), median(spacing)};
  }
} // namespace tread
