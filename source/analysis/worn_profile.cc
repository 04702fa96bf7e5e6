// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/worn_profile.h>
#include <tread/base/format.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace tread
{
  WornProfile::WornProfile(const ProfileCurve &curve, const double spacing, const Side side)
    : side(side)
  {
    const auto n = static_cast<std::size_t>(std::ceil(curve.length() / spacing));
    for (std::size_t k = 0; k <= n; ++k)
      {
        const ProfileCurve::Place place = curve.at(curve.length() * k / n);
        start.emplace_back(place.y, place.z);
      }
    now = start;
  }


  std::vector<double> WornProfile::chords() const
  {
    std::vector<double> s(now.size(), 0.);
    for (std::size_t k = 1; k < now.size(); ++k)
      s[k] = s[k - 1] + now[k].distance(now[k - 1]);
    return s;
  }


  std::vector<double> WornProfile::lengths() const
  {
    const std::vector<double> s = chords();
    std::vector<double>       list(s.size());
    for (std::size_t k = 0; k < s.size(); ++k)
      list[k] = 0.5 * (s[std::min(k + 1, s.size() - 1)] - s[k > 0 ? k - 1 : 0]);
    return list;
  }


  void WornProfile::add_hat(const double         begin,
                            const double         middle,
                            const double         end,
                            const double         area,
                            std::vector<double> &areas) const
  {
    const std::vector<double> s      = chords();
    const double              before = middle - begin, after = end - middle, all = before + after;
    // Share of the hat below a place.
    const auto below = [&](const double place) {
      if (place <= begin)
        return 0.;
      if (place >= end)
        return 1.;
      return place < middle ? (place - begin) * (place - begin) / (before * all)
                            : 1. - (end - place) * (end - place) / (after * all);
    };
    const auto  first = std::upper_bound(s.begin(), s.end(), begin) - s.begin();
    std::size_t k     = std::max<std::ptrdiff_t>(0, first - 1);
    double      done  = 0.;
    for (; k < s.size() && done < 1.; ++k)
      {
        const double upto = k + 1 < s.size() ? below(0.5 * (s[k] + s[k + 1])) : 1.;
        areas[k] += (upto - done) * area;
        done = upto;
      }
  }


  std::vector<double> WornProfile::smoothed(const std::vector<double> &areas, const double length) const
  {
    if (length == 0.)
      return areas;
    // The Fourier transform exp(-2 (pi deviation / wavelength)^2) is a half at this length.
    const double deviation      = length * std::sqrt(0.5 * std::log(2.)) / dealii::numbers::PI,
                 reach          = 4. * deviation;
    const std::vector<double> s = chords(), share = lengths();
    std::vector<double>       spread(areas.size(), 0.), weight;
    for (std::size_t k = 0; k < areas.size(); ++k)
      {
        if (areas[k] == 0.)
          continue;
        const std::size_t first = std::lower_bound(s.begin(), s.end(), s[k] - reach) - s.begin(),
                          last  = std::upper_bound(s.begin(), s.end(), s[k] + reach) - s.begin();
        weight.clear();
        for (std::size_t i = first; i < last; ++i)
          weight.push_back(share[i] * std::exp(-0.5 * std::pow((s[i] - s[k]) / deviation, 2)));
        const double sum = std::accumulate(weight.begin(), weight.end(), 0.);
        for (std::size_t i = first; i < last; ++i)
          spread[i] += areas[k] * weight[i - first] / sum;
      }
    return spread;
  }


  WornProfile WornProfile::without(const std::vector<double> &areas) const
  {
    const ProfileCurve        line = curve();
    const std::vector<double> s = chords(), share = lengths();
    WornProfile               after = *this;
    for (std::size_t k = 0; k < now.size(); ++k)
      {
        const ProfileCurve::Place place = line.at(s[k]);
        const double              into =
          (side == Side::below ? 1. : -1.) * areas[k] / share[k] / std::hypot(place.dy, place.dz);
        after.now[k] += dealii::Tensor<1, 2>{{into * place.dz, -into * place.dy}};
      }
    constexpr double least = 1. / 3.;
    for (std::size_t k = 1; k < now.size(); ++k)
      if (const dealii::Tensor<1, 2> before = now[k] - now[k - 1], behind = after.now[k] - after.now[k - 1];
          behind * before < least * start[k].distance(start[k - 1]) * before.norm())
        throw std::runtime_error(format(
          "the profile folds where it wears, at y = %.2f mm: its points come too near to each other; wear "
          "fewer passages, or keep points at a larger distance",
          1e3 * after.now[k][0]));
    return after;
  }


  std::vector<double> WornProfile::depths() const
  {
    std::vector<double> list(now.size());
    for (std::size_t k = 0; k < now.size(); ++k)
      list[k] = now[k].distance(start[k]);
    return list;
  }


  double WornProfile::lost_area() const
  {
    // Both triangles of the four points, about the first of them.
    const auto cross = [](const dealii::Tensor<1, 2> &a, const dealii::Tensor<1, 2> &b) {
      return a[0] * b[1] - a[1] * b[0];
    };
    double twice = 0.;
    for (std::size_t k = 1; k < now.size(); ++k)
      {
        const dealii::Point<2> &origin = start[k - 1];
        twice += cross(now[k - 1] - origin, now[k] - origin) + cross(now[k] - origin, start[k] - origin);
      }
    return (side == Side::below ? 0.5 : -0.5) * twice;
  }


  void WornProfile::serialize(Archive &archive)
  {
    archive.same(start, now);
  }
} // namespace tread
