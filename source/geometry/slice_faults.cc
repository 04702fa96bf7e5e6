// SPDX-License-Identifier: LGPL-2.1-or-later
// What is wrong with slices of a rail, by themselves and beside their neighbours.
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/base/lagrange.h>
#include <tread/geometry/rail_slices.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace tread
{
  namespace
  {
    using Point  = dealii::Point<2>;
    using Places = std::vector<std::vector<Point>>;

    /// Twice the area of a triangle, positive where it turns to the left.
    double turn(const Point &a, const Point &b, const Point &c)
    {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }

    bool cross(const Point &a, const Point &b, const Point &c, const Point &d)
    {
      return turn(a, b, c) * turn(a, b, d) < 0. && turn(c, d, a) * turn(c, d, b) < 0.;
    }

    /// Samples of a slice beside those that other slices of its strip let expect, at right angles to it.
    struct Offset
    {
      double rms = 0., largest = 0.; ///< m
      Point  at;                     ///< of the largest
    };

    /// Where Lagrange's polynomial through other slices puts the samples of a slice. Extrapolation makes
    /// more of what the others have, by the norm of its weights; so much is taken off if it is wanted.
    Offset offset_from(const std::vector<std::size_t> &others,
                       const std::vector<double>      &x,
                       const Places                   &places,
                       const std::size_t               slice,
                       const bool                      less_for_norm = true)
    {
      constexpr double    usual_norm = 1.5; // of four equidistant slices around the one between them
      std::vector<double> weights;
      double              squares = 1.;
      for (std::size_t k = 0; k < others.size(); ++k)
        {
          weights.push_back(
            lagrange_weight([&](const std::size_t l) { return x[others[l]]; }, others.size(), k, x[slice]));
          squares += weights.back() * weights.back();
        }
      const std::vector<Point> &own  = places[slice];
      const double              less = less_for_norm ? std::max(1., std::sqrt(squares) / usual_norm) : 1.;
      Offset                    offset;
      for (std::size_t s = 0; s < own.size(); ++s)
        {
          dealii::Tensor<1, 2> off = own[s] - Point();
          for (std::size_t k = 0; k < others.size(); ++k)
            off -= weights[k] * (places[others[k]][s] - Point());
          const dealii::Tensor<1, 2> along = own[std::min(s + 1, own.size() - 1)] - own[s > 0 ? s - 1 : 0];
          const double               normal =
            std::abs(off[1] * along[0] - off[0] * along[1]) / std::max(along.norm(), 1e-12) / less;
          offset.rms += normal * normal / own.size();
          if (normal > offset.largest)
            {
              offset.largest = normal;
              offset.at      = own[s];
            }
        }
      offset.rms = std::sqrt(offset.rms);
      return offset;
    }

    /// Consecutive slices that are left out.
    struct LeftOut
    {
      std::size_t first, count;
      bool        has(const std::size_t k) const
      {
        return k >= first && k < first + count;
      }
    };

    /// Two slices before and two behind, or fewer at an end; both empty at the ends.
    std::array<std::vector<std::size_t>, 2> around(const std::size_t slice,
                                                   const std::size_t n,
                                                   const LeftOut    &out)
    {
      std::array<std::vector<std::size_t>, 2> sides;
      for (std::size_t k = slice; k-- > 0 && sides[0].size() < 2;)
        if (!out.has(k))
          sides[0].push_back(k);
      for (std::size_t k = slice + 1; k < n && sides[1].size() < 2; ++k)
        if (!out.has(k))
          sides[1].push_back(k);
      if (sides[0].empty() || sides[1].empty())
        return {};
      return sides;
    }

    std::vector<std::size_t> both(std::array<std::vector<std::size_t>, 2> sides)
    {
      sides[0].insert(sides[0].end(), sides[1].begin(), sides[1].end());
      return sides[0];
    }

    /// Slices that do not fit those around them, which fit each other without them.
    struct Misfit
    {
      LeftOut which;
      Offset  own;    ///< of the one that fits best
      double  others; ///< rms of the largest offset among the others without them, m
    };

    /// What others have without them: the largest rms of an offset, m; negative where fewer than two can be
    /// judged.
    double worst_without(const LeftOut &out, const std::vector<double> &x, const Places &places)
    {
      constexpr std::size_t reach = 2;
      double                worst = -1.;
      unsigned int          n     = 0;
      for (std::size_t k = out.first > reach ? out.first - reach : 0;
           k < std::min(out.first + out.count + reach, x.size()); ++k)
        if (const auto of = both(around(k, x.size(), out)); !out.has(k) && !of.empty())
          {
            worst = std::max(worst, offset_from(of, x, places, k).rms);
            ++n;
          }
      return n < 2 ? -1. : worst;
    }

    std::vector<Misfit> misfits_of(const std::vector<double> &x, const Places &places)
    {
      // Sound slices of the crossing in contrib/contact-data reach a ratio of 2.1. Two or three that are left
      // out at once leave more to the shape between.
      constexpr std::array  least{15e-6, 50e-6, 150e-6}; // m, of one, two and three at once
      constexpr double      least_at_end = 30e-6;
      constexpr double      ratio = 3., ratio_at_end = 4.;
      constexpr std::size_t for_an_end = 6; // slices
      const std::size_t     n          = x.size();
      std::vector<Misfit>   misfits;
      std::vector<char>     named(n, false);
      for (std::size_t count = 1; count <= least.size(); ++count)
        for (std::size_t first = 1; first + count < n; ++first)
          {
            const LeftOut out{first, count};
            if (std::any_of(named.begin() + first, named.begin() + first + count,
                            [](const char is) { return is; }))
              continue;
            Offset smallest;
            smallest.rms = 1e300;
            for (std::size_t k = first; k < first + count; ++k)
              {
                const auto sides = around(k, n, out);
                Offset     own   = offset_from(both(sides), x, places, k);
                // Where a straight line has a bend, the slice lies on the lines of both sides, and a step is
                // on that of one.
                for (const std::vector<std::size_t> &side : sides)
                  own.rms = std::min(own.rms, offset_from(side, x, places, k, false).rms);
                if (own.rms < smallest.rms)
                  smallest = own;
              }
            if (smallest.rms < least[count - 1])
              continue;
            const double worst = worst_without(out, x, places);
            if (worst >= 0. && smallest.rms > ratio * worst)
              {
                misfits.push_back({out, smallest, worst});
                std::fill(named.begin() + first, named.begin() + first + count, true);
              }
          }
      // An end lies on the line through the next two as well as these do on that through theirs.
      if (n >= for_an_end)
        for (const bool begins : {true, false})
          {
            const auto of_line = [&](const std::size_t k) {
              return begins ? k : n - 1 - k;
            };
            const auto from_next = [&](const std::size_t k) {
              return offset_from({of_line(k + 1), of_line(k + 2)}, x, places, of_line(k));
            };
            const Offset own   = from_next(0);
            const double worst = std::max({from_next(1).rms, from_next(2).rms, from_next(3).rms});
            if (own.rms >= least_at_end && own.rms > ratio_at_end * worst)
              misfits.push_back({{of_line(0), 1}, own, worst});
          }
      return misfits;
    }
  } // namespace


  void refuse_crossing_line(const std::string &where, const std::vector<Point> &points)
  {
    // Chords by where they begin in y: only those that overlap in y can cross.
    std::vector<std::size_t> order(points.size() - 1);
    std::iota(order.begin(), order.end(), 0);
    const auto low = [&](const std::size_t i) {
      return std::min(points[i][0], points[i + 1][0]);
    };
    std::sort(order.begin(), order.end(),
              [&](const std::size_t a, const std::size_t b) { return low(a) < low(b); });
    for (std::size_t a = 0; a < order.size(); ++a)
      {
        const Point &p = points[order[a]], &q = points[order[a] + 1];
        const double high = std::max(p[0], q[0]);
        for (std::size_t b = a + 1; b < order.size() && low(order[b]) <= high; ++b)
          {
            const Point &r = points[order[b]], &s = points[order[b] + 1];
            const bool   beside = order[a] + 1 == order[b] || order[b] + 1 == order[a];
            if (!beside && (p == r || cross(p, q, r, s)))
              throw InputError(
                where + "its points come back to y = " + text_in_mm(p[0]) + ", z = " + text_in_mm(p[1]) +
                " mm, where they have been: a slice that is there twice, points in no order, or a scan with "
                "points closer to each other than its noise, which must be thinned out");
          }
      }
  }


  std::vector<std::string> SlicedRail::doubts() const
  {
    const auto         &all = rail.slices;
    std::vector<Misfit> worst;
    const auto          look = [&](const Strip &strip) {
      std::vector<double> x;
      for (std::size_t i = strip.first; i <= strip.last; ++i)
        x.push_back(all[i].x);
      for (Misfit misfit : misfits_of(x, strip.places))
        {
          misfit.which.first += strip.first;
          const auto known = std::find_if(worst.begin(), worst.end(), [&](const Misfit &m) {
            return m.which.has(misfit.which.first) || misfit.which.has(m.which.first);
          });
          if (known == worst.end())
            worst.push_back(misfit);
          else if (misfit.own.rms > known->own.rms)
            *known = misfit;
        }
    };
    for (const std::vector<Strip> &strips : parts)
      for (const Strip &strip : strips)
        look(strip);
    for (const Strip &strip : wholes)
      look(strip);
    std::sort(worst.begin(), worst.end(),
              [](const Misfit &a, const Misfit &b) { return a.own.rms > b.own.rms; });

    std::vector<std::string> list;
    const auto               more = [](const std::size_t n) {
      return n > 1 ? format("; %u more like it", unsigned(n - 1)) : std::string();
    };
    if (!worst.empty())
      {
        const Misfit     &m     = worst.front();
        const std::size_t last  = m.which.first + m.which.count - 1;
        const std::string which = m.which.count == 1 ? format("the slice at %g mm does", 1e3 * all[last].x)
                                                     : format("the slices at %g to %g mm do",
                                                              1e3 * all[m.which.first].x, 1e3 * all[last].x);
        list.push_back(
          format("'%s': %s not fit the neighbours: up to %.3g mm off them (at y = %.2f, z = %.2f mm of the "
                 "slices), which fit each other within %.2g mm without; wrong unit, place or order, or a "
                 "shape that changes within a distance of slices?%s",
                 rail.file.c_str(), which.c_str(), 1e3 * m.own.largest, 1e3 * m.own.at[0], 1e3 * m.own.at[1],
                 1e3 * m.others, more(worst.size()).c_str()));
      }
    // A distance that stands out between its neighbours, or at an end before two that are alike.
    constexpr double wide = 1.5, alike = 1.1;
    const auto       distance = [&](const std::size_t i) {
      return all[i + 1].x - all[i].x;
    };
    const std::size_t        n = all.size() - 1;
    std::vector<std::size_t> gaps;
    for (std::size_t i = 0; n >= 4 && i < n; ++i)
      {
        const bool   inner  = i > 0 && i + 1 < n;
        const double before = distance(i > 0 ? i - 1 : 2), behind = distance(i + 1 < n ? i + 1 : n - 3),
                     larger = std::max(before, behind);
        if (distance(i) > wide * larger && (inner || larger < alike * std::min(before, behind)))
          gaps.push_back(i);
      }
    if (!gaps.empty())
      list.push_back(format("'%s': its slices at %g and %g mm are %.3g mm apart, further than those before "
                            "and behind: is one missing between them?%s",
                            rail.file.c_str(), 1e3 * all[gaps.front()].x, 1e3 * all[gaps.front() + 1].x,
                            1e3 * distance(gaps.front()), more(gaps.size()).c_str()));
    // In inches a rail would be narrower, and the way over it shorter, than any is.
    constexpr double least_width = 20e-3, least_way = 20e-3, inch = 25.4e-3; // m
    double           widest = 0.;
    for (const RailSlice &slice : all)
      {
        const auto [low, high] =
          std::minmax_element(slice.points.begin(), slice.points.end(),
                              [](const Point &a, const Point &b) { return a[0] < b[0]; });
        widest = std::max(widest, (*high)[0] - (*low)[0]);
      }
    for (const auto &[what, size, least] :
         {std::tuple("widest section is", widest, least_width),
          std::tuple("slices reach over", all.back().x - all.front().x, least_way)})
      if (size < least)
        list.push_back(format("'%s': its %s %.3g mm: are its numbers in mm? (%.3g mm if they are in inches)",
                              rail.file.c_str(), what, 1e3 * size, 1e6 * inch * size));
    return list;
  }
} // namespace tread
