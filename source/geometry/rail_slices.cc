// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/geometry/natural_spline.h>
#include <tread/geometry/rail_slices.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tread
{
  namespace
  {
    using Point = dealii::Point<2>;

    /// Distance of the samples across, of which each bend of a section needs some, m.
    constexpr double spacing_across = 0.25e-3;

    bool is_cut(const RailSlice &slice)
    {
      return !slice.breaks.empty();
    }

    bool has_part(const RailSlice &slice, const std::size_t part)
    {
      return is_cut(slice) && slice.breaks[part + 1] > slice.breaks[part];
    }

    bool has_all_parts(const RailSlice &slice)
    {
      for (std::size_t part = 0; part + 1 < slice.breaks.size(); ++part)
        if (!has_part(slice, part))
          return false;
      return true;
    }

    /// Second derivatives by x of the natural cubic splines through all samples, slices as knots.
    std::vector<std::vector<Point>> bend_of(const std::vector<double>             &x,
                                            const std::vector<std::vector<Point>> &places)
    {
      const std::size_t               n = x.size(), samples = places.front().size();
      std::vector<std::vector<Point>> bend(n, std::vector<Point>(samples));
      std::vector<double>             values(n);
      for (std::size_t k = 0; k < samples; ++k)
        for (unsigned int d = 0; d < 2; ++d)
          {
            for (std::size_t i = 0; i < n; ++i)
              values[i] = places[i][k][d];
            const std::vector<double> of_sample = natural_spline(x, values);
            for (std::size_t i = 0; i < n; ++i)
              bend[i][k][d] = of_sample[i];
          }
      return bend;
    }
  } // namespace


  SlicedRail::SlicedRail(RailSlices slices)
    : rail(std::move(slices))
    , known{0., 0., std::numeric_limits<double>::max(), -std::numeric_limits<double>::max()}
  {
    const auto &all = rail.slices;
    require(all.size() >= 2, "'" + rail.file + "' has " + std::to_string(all.size()) +
                               (all.size() == 1 ? " slice" : " slices") + "; a surface needs at least two");
    std::size_t n_breaks = 0;
    for (const RailSlice &slice : all)
      {
        const std::string where = "'" + rail.file + "', slice at " + text_in_mm(slice.x) + " mm: ";
        require(std::isfinite(slice.x), where + "its place is no number");
        require(&slice == &all.front() || slice.x > (&slice - 1)->x,
                where + "slices must follow each other along x; the one before is at " +
                  text_in_mm((&slice == &all.front() ? slice : *(&slice - 1)).x) + " mm");
        require(!is_cut(slice) || n_breaks == 0 || n_breaks == slice.breaks.size(),
                where + "all slices that are cut must have the same numbers of parts");
        n_breaks                  = std::max(n_breaks, slice.breaks.size());
        constexpr double furthest = 1.; // m
        for (const Point &p : slice.points)
          require(std::abs(p[0]) <= furthest && std::abs(p[1]) <= furthest,
                  where + "a point lies further away than " + text_in_mm(furthest) +
                    " mm; are its numbers in mm?");
        try
          {
            curves.emplace_back(slice.points);
          }
        catch (const std::runtime_error &error)
          {
            throw InputError(where + error.what());
          }
        constexpr double longest = 4.; // m, of a section that runs from foot to foot
        require(curves.back().length() <= longest, where + "its points run over " +
                                                     text_in_mm(curves.back().length()) +
                                                     " mm; they must follow each other along the surface");
        refuse_crossing_line(where, slice.points);
        double last = -1.;
        for (const double at : slice.breaks)
          if (!std::isnan(at))
            {
              require(at > last, where + "parts must follow each other; " + text_in_mm(at) +
                                   " mm comes after " + text_in_mm(last) + " mm");
              require(at <= curves.back().length() * (1. + 1e-9),
                      where + "a part ends at " + text_in_mm(at) + " mm of its " +
                        text_in_mm(curves.back().length()) + " mm");
              last = at;
            }
        require(!is_cut(slice) || last > 0., where + "it is cut, but has no part");
        for (const Point &p : slice.points)
          {
            known.y_begin = std::min(known.y_begin, p[0]);
            known.y_end   = std::max(known.y_end, p[0]);
          }
      }
    // Splines through slices that are almost at one place are steep between them.
    constexpr double closest = 1e-3; // of the mean distance
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      require(all[i + 1].x - all[i].x >= closest * (all.back().x - all.front().x) / (all.size() - 1),
              "'" + rail.file + "': slices at " + format("%.9g", 1e3 * all[i].x) + " and " +
                format("%.9g", 1e3 * all[i + 1].x) + " mm are at the same place: is one there twice?");
    constexpr double shortest = 2e-3; // m, of the way and across
    for (const auto &[what, size] : {std::pair("slices reach over ", all.back().x - all.front().x),
                                     std::pair("sections are as wide as ", known.y_end - known.y_begin)})
      require(size >= shortest,
              "'" + rail.file + "': its " + what + text_in_mm(size) + " mm: are its numbers in mm?");
    known.along_begin = all.front().x;
    known.along_end   = all.back().x;

    parts.resize(n_breaks > 0 ? n_breaks - 1 : 0);
    const auto runs = [&](const auto &belongs, const auto &add) {
      for (std::size_t i = 0; i < all.size(); ++i)
        if (belongs(all[i]))
          {
            const std::size_t first = i;
            while (i + 1 < all.size() && belongs(all[i + 1]))
              ++i;
            if (i > first)
              add(first, i);
          }
    };
    for (std::size_t part = 0; part < parts.size(); ++part)
      runs([part](const RailSlice &slice) { return has_part(slice, part); },
           [&](const std::size_t first, const std::size_t last) {
             parts[part].push_back(strip(first, last, static_cast<int>(part)));
           });
    runs([](const RailSlice &slice) { return has_all_parts(slice); },
         [&](const std::size_t first, const std::size_t last) {
           if (std::any_of(all.begin() + first, all.begin() + last + 1,
                           [](const RailSlice &slice) { return !is_cut(slice); }))
             wholes.push_back(strip(first, last, -1));
         });
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      require(!sections(0.5 * (all[i].x + all[i + 1].x)).empty(),
              "'" + rail.file + "': slices at " + text_in_mm(all[i].x) + " mm and " +
                text_in_mm(all[i + 1].x) + " mm have no part in common");
  }


  SlicedRail::Strip SlicedRail::strip(const std::size_t first, const std::size_t last, const int part) const
  {
    const auto ends = [&](const std::size_t i) {
      const double length = curves[i].length();
      return part < 0
               ? std::pair(0., length)
               : std::pair(rail.slices[i].breaks[part], std::min(length, rail.slices[i].breaks[part + 1]));
    };
    double longest = 0.;
    for (std::size_t i = first; i <= last; ++i)
      longest = std::max(longest, ends(i).second - ends(i).first);
    const std::size_t   n = std::max<std::size_t>(4, std::ceil(longest / spacing_across));
    Strip               strip{first, last, {}, {}};
    std::vector<double> x;
    for (std::size_t i = first; i <= last; ++i)
      {
        const auto [begin, end] = ends(i);
        std::vector<Point> places;
        for (std::size_t k = 0; k <= n; ++k)
          {
            const ProfileCurve::Place p = curves[i].at(begin + (end - begin) * k / n);
            places.emplace_back(p.y, p.z);
          }
        strip.places.push_back(places);
        x.push_back(rail.slices[i].x);
      }
    strip.bend = bend_of(x, strip.places);
    return strip;
  }


  std::vector<Point> SlicedRail::points_of(const Strip &strip, const std::size_t slice, const double x) const
  {
    const std::size_t  i     = slice - strip.first;
    const double       begin = rail.slices[slice].x, h = rail.slices[slice + 1].x - begin;
    const double       b = (x - begin) / h, a = 1. - b;
    const double       bend_a = (a * a * a - a) * h * h / 6., bend_b = (b * b * b - b) * h * h / 6.;
    std::vector<Point> points(strip.places[i].size());
    for (std::size_t k = 0; k < points.size(); ++k)
      for (unsigned int d = 0; d < 2; ++d)
        points[k][d] = a * strip.places[i][k][d] + b * strip.places[i + 1][k][d] +
                       bend_a * strip.bend[i][k][d] + bend_b * strip.bend[i + 1][k][d];
    return points;
  }


  std::string SlicedRail::in_words() const
  {
    return std::to_string(rail.slices.size()) + " slices of '" + rail.file + "' from " +
           text_in_mm(known.along_begin) + " to " + text_in_mm(known.along_end) + " mm";
  }


  Surface::Extent SlicedRail::extent() const
  {
    return known;
  }


  bool SlicedRail::is_constant() const
  {
    return false;
  }


  std::vector<ProfileCurve> SlicedRail::sections(const double along) const
  {
    const auto &all = rail.slices;
    if (!known.includes(along))
      return {};
    const auto        next = std::upper_bound(all.begin(), all.end(), along,
                                              [](const double x, const RailSlice &slice) { return x < slice.x; });
    const std::size_t i =
      std::min<std::size_t>(std::max<std::ptrdiff_t>(next - all.begin() - 1, 0), all.size() - 2);
    const auto over = [&](const std::vector<Strip> &strips) -> const Strip * {
      for (const Strip &strip : strips)
        if (strip.first <= i && strip.last >= i + 1)
          return &strip;
      return nullptr;
    };
    std::vector<ProfileCurve> curves_here;
    std::vector<Point>        points;
    const auto                close = [&] {
      if (!points.empty())
        curves_here.emplace_back(points);
      points.clear();
    };
    if (is_cut(all[i]) && is_cut(all[i + 1]))
      for (const std::vector<Strip> &strips : parts)
        if (const Strip *strip = over(strips))
          {
            const std::vector<Point> more = points_of(*strip, i, along);
            points.insert(points.end(), more.begin() + (points.empty() ? 0 : 1), more.end());
          }
        else
          close();
    else if (const Strip *strip = over(wholes))
      points = points_of(*strip, i, along);
    close();
    return curves_here;
  }


  std::string SlicedRail::body(const double along, const double y) const
  {
    const auto nearest =
      std::min_element(rail.slices.begin(), rail.slices.end(), [&](const RailSlice &a, const RailSlice &b) {
        return std::abs(a.x - along) < std::abs(b.x - along);
      });
    // The highest chord over y has the point of the name; the nearest point where none is over it.
    std::size_t best = 0;
    double      z = -std::numeric_limits<double>::max(), distance = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i + 1 < nearest->points.size(); ++i)
      {
        const Point &a = nearest->points[i], &b = nearest->points[i + 1];
        const double outside = std::max({0., std::min(a[0], b[0]) - y, y - std::max(a[0], b[0])});
        if (outside < distance || (outside == distance && std::max(a[1], b[1]) > z))
          {
            distance = outside;
            z        = std::max(a[1], b[1]);
            best     = std::abs(a[0] - y) < std::abs(b[0] - y) ? i : i + 1;
          }
      }
    return nearest->bodies.empty() ? "" : nearest->bodies[best];
  }
} // namespace tread
