// SPDX-License-Identifier: LGPL-2.1-or-later
// What is wrong with slices of a rail, by themselves and beside their neighbours.
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/geometry/rail_slices.h>

#include <algorithm>
#include <cmath>
#include <numeric>

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
    /// more of what the others have, by the norm of its weights; so much is taken off.
    Offset offset_from(const std::vector<std::size_t> &others,
                       const std::vector<double>      &x,
                       const Places                   &places,
                       const std::size_t               slice)
    {
      constexpr double    usual_norm = 1.5; // of four equidistant slices around the one between them
      std::vector<double> weights;
      double              squares = 1.;
      for (const std::size_t k : others)
        {
          double weight = 1.;
          for (const std::size_t l : others)
            if (l != k)
              weight *= (x[slice] - x[l]) / (x[k] - x[l]);
          weights.push_back(weight);
          squares += weight * weight;
        }
      const std::vector<Point> &own  = places[slice];
      const double              less = std::max(1., std::sqrt(squares) / usual_norm);
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

    constexpr std::size_t none = -1;

    /// Two slices before and two behind, or fewer at an end, without one that is left out; empty at the ends.
    std::vector<std::size_t> around(const std::size_t slice, const std::size_t n, const std::size_t left_out)
    {
      std::vector<std::size_t> before, behind;
      for (std::size_t k = slice; k-- > 0 && before.size() < 2;)
        if (k != left_out)
          before.push_back(k);
      for (std::size_t k = slice + 1; k < n && behind.size() < 2; ++k)
        if (k != left_out)
          behind.push_back(k);
      if (before.empty() || behind.empty())
        return {};
      before.insert(before.end(), behind.begin(), behind.end());
      return before;
    }

    /// A slice that does not fit those around it, which fit each other without it.
    struct Misfit
    {
      std::size_t slice;
      Offset      own;
      double      others; ///< rms of the largest offset among the others without it, m
    };

    std::vector<Misfit> misfits_of(const std::vector<double> &x, const Places &places)
    {
      // Sound slices of the crossing in contrib/contact-data reach a ratio of 2.1.
      constexpr double      least = 10e-6, least_at_end = 30e-6; // m
      constexpr double      ratio = 3., ratio_at_end = 4.;
      constexpr std::size_t for_an_end = 6; // slices
      const std::size_t     n          = x.size();
      std::vector<Misfit>   misfits;
      const auto            judge = [&](const std::size_t slice, const std::vector<std::size_t> &of,
                             const double smallest, const double factor, const auto &others) {
        const Offset own = offset_from(of, x, places, slice);
        if (own.rms < smallest)
          return;
        const std::vector<double> offsets = others();
        if (offsets.size() < 2)
          return;
        const double worst = *std::max_element(offsets.begin(), offsets.end());
        if (own.rms > factor * worst)
          misfits.push_back({slice, own, worst});
      };
      for (std::size_t i = 1; i + 1 < n; ++i)
        judge(i, around(i, n, none), least, ratio, [&] {
          std::vector<double> offsets;
          for (std::size_t k = i > 2 ? i - 2 : 0; k < std::min(i + 3, n); ++k)
            if (const auto of = around(k, n, i); k != i && !of.empty())
              offsets.push_back(offset_from(of, x, places, k).rms);
          return offsets;
        });
      // An end lies on the line through the next two as well as these do on that through theirs.
      if (n >= for_an_end)
        for (const bool first : {true, false})
          {
            const auto of_line = [&](const std::size_t k) {
              return first ? k : n - 1 - k;
            };
            judge(of_line(0), {of_line(1), of_line(2)}, least_at_end, ratio_at_end, [&] {
              std::vector<double> offsets;
              for (const std::size_t k : {1, 2, 3})
                offsets.push_back(offset_from({of_line(k + 1), of_line(k + 2)}, x, places, of_line(k)).rms);
              return offsets;
            });
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
            require(beside || (p != r && !cross(p, q, r, s)),
                    where + "its points come back to y = " + text_in_mm(p[0]) + ", z = " + text_in_mm(p[1]) +
                      " mm, where they have been; they must follow each other once along the surface, and "
                      "each slice be there once");
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
          misfit.slice += strip.first;
          const auto known = std::find_if(worst.begin(), worst.end(),
                                                   [&](const Misfit &m) { return m.slice == misfit.slice; });
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
    if (!worst.empty())
      {
        const Misfit &m = worst.front();
        list.push_back(format(
          "'%s': the slice at %g mm does not fit its neighbours: it lies up to %.3g mm off them (at y = "
          "%.2f, "
          "z = %.2f mm of the slices), while they fit each other within %.2g mm without it; is it in mm, and "
          "at its place?%s",
          rail.file.c_str(), 1e3 * all[m.slice].x, 1e3 * m.own.largest, 1e3 * m.own.at[0], 1e3 * m.own.at[1],
          1e3 * m.others,
          worst.size() > 1 ? format(" %u more like it", unsigned(worst.size() - 1)).c_str() : ""));
      }
    // A distance that stands out between its neighbours, or at an end before two that are alike.
    constexpr double wide = 1.5, alike = 1.1;
    const auto       distance = [&](const std::size_t i) {
      return all[i + 1].x - all[i].x;
    };
    const std::size_t n = all.size() - 1;
    for (std::size_t i = 0; i < n; ++i)
      {
        const double before = distance(i > 0 ? i - 1 : std::min<std::size_t>(2, n - 1)),
                     behind = distance(i + 1 < n ? i + 1 : n - std::min<std::size_t>(3, n));
        const bool inner    = i > 0 && i + 1 < n;
        if (n >= 4 && distance(i) > wide * std::max(before, behind) &&
            (inner || std::max(before, behind) < alike * std::min(before, behind)))
          list.push_back(format("'%s': its slices at %g and %g mm are %.3g mm apart, those around them %.3g "
                                "mm: is one missing between them?",
                                rail.file.c_str(), 1e3 * all[i].x, 1e3 * all[i + 1].x, 1e3 * distance(i),
                                1e3 * std::max(before, behind)));
      }
    return list;
  }
} // namespace tread
