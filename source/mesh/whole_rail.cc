// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/mesh/whole_rail.h>

#include "even_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

namespace tread
{
  namespace
  {
    using Point2 = dealii::Point<2>;

    /// Where head, web and foot lie in the chart (m).
    struct Chart
    {
      double half_head;  ///< half width of the head: arc length to the middle of the gauge corner
      double half_web;   ///< half width of the web and of the middle of the foot
      double half_foot;  ///< half width of the foot
      double head_depth; ///< bottom of the head
      double web_depth;  ///< bottom of the web
      double base_depth; ///< base of the foot
    };

    /// From the chart's (s, depth >= 0), s >= 0, to the section's right half.
    class SectionMap
    {
    public:
      SectionMap(const RailProfile &profile, const Chart &chart)
        : profile(profile)
        , chart(chart)
        , corners(profile.corners())
        , head_fillet(profile.outline_point(corners.head_fillet))
        , foot_fillet(profile.outline_point(corners.foot_fillet))
        , foot_top(profile.outline_point(corners.foot_top))
        , foot_edge(profile.outline_point(corners.foot_edge))
        , foot_corner(foot_edge[0], -profile.height())
      {
      }

      Point2 operator()(const double s, const double depth) const
      {
        const double tolerance = 1e-9;
        if (depth <= chart.head_depth + tolerance && s <= chart.half_head + tolerance)
          return head(s, std::min(depth, chart.head_depth));
        if (depth <= chart.web_depth + tolerance && s <= chart.half_web + tolerance)
          return web(s, (depth - chart.head_depth) / (chart.web_depth - chart.head_depth));
        const double v = (depth - chart.web_depth) / (chart.base_depth - chart.web_depth);
        if (s <= chart.half_web)
          return {foot_fillet[0] * s / chart.half_web, (1. - v) * foot_fillet[1] - v * profile.height()};
        return flange((s - chart.half_web) / (chart.half_foot - chart.half_web), std::clamp(v, 0., 1.));
      }

    private:
      /// Straight lines from the running surface to the head's bottom; near the sides the curved side's
      /// deviation from the straight line is added, with a weight that is zero with its slope up to the
      /// beginning of the ramp, beside the crown. Below the crown depths are true to the chart near the top.
      Point2 head(const double s, const double depth) const
      {
        const double v          = depth / chart.head_depth;
        const double true_share = -chart.head_depth / head_fillet[1];
        const double below      = true_share * v + (1. - true_share) * v * v * v;
        const double ramp_begin = 0.3 * chart.half_head;
        const double ramp       = s > ramp_begin ? (s - ramp_begin) / (chart.half_head - ramp_begin) : 0.;

        const auto straight = [&](const double t, const double share) {
          return Point2((1. - share) * profile.head_point(t) + share * bottom(t));
        };
        Point2 p = straight(s, (1. - ramp * ramp) * below + ramp * ramp * v);
        if (ramp > 0.)
          p += ramp * ramp *
               (profile.outline_point(chart.half_head + v * (corners.head - chart.half_head)) -
                straight(chart.half_head, v));
        return p;
      }

      /// Lower boundary of the head: the top of the web, then the underside.
      Point2 bottom(const double s) const
      {
        if (s <= chart.half_web)
          return {head_fillet[0] * s / chart.half_web, head_fillet[1]};
        const double u = (s - chart.half_web) / (chart.half_head - chart.half_web);
        return profile.outline_point(corners.head_fillet + u * (corners.head - corners.head_fillet));
      }

      Point2 web(const double s, const double v) const
      {
        const Point2 side =
          profile.outline_point(corners.head_fillet + v * (corners.foot_fillet - corners.head_fillet));
        return {side[0] * s / chart.half_web, side[1]};
      }

      /// Point of the foot beside its middle (u outwards, v down), between the upper side and the base, with
      /// the curved edge.
      Point2 flange(const double u, const double v) const
      {
        const Point2 upper =
          profile.outline_point(corners.foot_fillet + u * (corners.foot_top - corners.foot_fillet));
        // The lower rounding is left out: its corner is nearer to the section than a chord.
        Point2 edge = profile.outline_point(corners.foot_top + v * (corners.foot_edge - corners.foot_top));
        edge[1]     = foot_top[1] +
                  (edge[1] - foot_top[1]) * (foot_top[1] + profile.height()) / (foot_top[1] - foot_edge[1]);
        const Point2 base(foot_fillet[0] + u * (foot_edge[0] - foot_fillet[0]), -profile.height());
        return Point2((1. - v) * upper + v * base + u * (edge - ((1. - v) * foot_top + v * foot_corner)));
      }

      RailProfile          profile;
      Chart                chart;
      RailProfile::Corners corners;
      Point2               head_fillet, foot_fillet, foot_top, foot_edge, foot_corner;
    };

    /// Quadrilaterals of the chart's section; vertices in the order of (s, -depth).
    class ChartSection
    {
    public:
      void add_grid(const std::vector<double> &s, const std::vector<double> &depth)
      {
        for (std::size_t k = 0; k + 1 < depth.size(); ++k)
          for (std::size_t j = 0; j + 1 < s.size(); ++j)
            cells.push_back({{vertex(s[j], depth[k + 1]), vertex(s[j + 1], depth[k + 1]),
                              vertex(s[j], depth[k]), vertex(s[j + 1], depth[k])}});
      }

      std::vector<Point2>                      vertices;
      std::vector<std::array<unsigned int, 4>> cells;

    private:
      unsigned int vertex(const double s, const double depth)
      {
        const auto key             = std::make_pair(std::lround(s * 1e9), std::lround(depth * 1e9));
        const auto [place, is_new] = numbers.try_emplace(key, vertices.size());
        if (is_new)
          vertices.push_back({s, -depth});
        return place->second;
      }

      std::map<std::pair<long, long>, unsigned int> numbers;
    };
  } // namespace


  Body make_whole_rail(const RailProfile &profile, const WholeRail &rail, const FineZones &zones)
  {
    const RailProfile::Corners corners     = profile.corners();
    const Point2               head_fillet = profile.outline_point(corners.head_fillet),
                 foot_fillet               = profile.outline_point(corners.foot_fillet);

    Chart chart;
    chart.half_head  = profile.shoulder_length();
    chart.head_depth = profile.head_depth();
    const double size =
      coarse_cell_size(zones.any().finest_cell_size, rail.coarsest_cell_size,
                       {{chart.half_head, zones.any().reach()}, {chart.head_depth, zones.any().depth}});
    // Away from the wheel longer cells do: they bend with the rail.
    const double wide = 1.5 * size;

    const std::vector<double> head_s = coarse_lines(-chart.half_head, chart.half_head, 0., size);
    const unsigned int        middle = (head_s.size() - 1) / 2;
    const unsigned int        n_web =
      std::clamp<unsigned int>(std::lround(head_fillet[0] / size), 1, std::max(1u, middle - 1));
    chart.half_web   = head_s[middle + n_web];
    chart.web_depth  = chart.head_depth + corners.foot_fillet - corners.head_fillet;
    chart.base_depth = chart.web_depth + profile.height() + foot_fillet[1];
    chart.half_foot  = chart.half_web + corners.foot_top - corners.foot_fillet;

    ChartSection section;
    const auto   depths = [&](const double from, const double to) {
      return even_lines(from, to, rows_of(to - from, wide, 2));
    };
    const std::vector<double> web_s(head_s.begin() + middle - n_web, head_s.begin() + middle + n_web + 1);
    const std::vector<double> foot_depths = depths(chart.web_depth, chart.base_depth);
    const unsigned int        n_flange    = rows_of(chart.half_foot - chart.half_web, wide, 2);
    section.add_grid(head_s, coarse_lines(0., chart.head_depth, 0., size));
    section.add_grid(web_s, depths(chart.head_depth, chart.web_depth));
    section.add_grid(web_s, foot_depths);
    section.add_grid(even_lines(-chart.half_foot, -chart.half_web, n_flange), foot_depths);
    section.add_grid(even_lines(chart.half_web, chart.half_foot, n_flange), foot_depths);

    const PathLines path = path_lines(rail.x_begin, rail.x_end, size, zones, rail.longest_row / size);
    Body            body;
    body.name                = "rail " + profile.name();
    const unsigned int n     = section.vertices.size();
    const std::size_t  n_row = path.lines.size() - 1;
    for (const double x : path.lines)
      for (const Point2 &p : section.vertices)
        body.vertices.emplace_back(x, p[0], p[1]);
    for (unsigned int i = 0; i < n_row; ++i)
      for (const auto &quadrilateral : section.cells)
        {
          dealii::CellData<3> cell;
          for (unsigned int v = 0; v < 8; ++v)
            cell.vertices[v] = (i + v % 2) * n + quadrilateral[v / 2];
          body.cells.push_back(cell);
        }

    body.to_space = shape_top(
      [map = SectionMap(profile, chart)](const dealii::Point<3> &p) {
        const Point2 q = map(std::abs(p[1]), std::max(0., -p[2]));
        return dealii::Point<3>(p[0], std::copysign(q[0], p[1]), q[1]);
      },
      rail.top, chart.head_depth);
    body.wanted_cell_size = [zones](const dealii::Point<3> &p) {
      return zones.wanted_size(p[0], p[1], -p[2]);
    };
    body.path_stretch = [path](const dealii::Point<3> &p) {
      return std::max(1., path.stretch(p[0]));
    };

    const double tolerance = 1e-3 * size;
    body.boundary_at       = [rail, chart, tolerance, zones, path](const dealii::Point<3> &p) {
      if (std::abs(p[2]) < tolerance)
        {
          const double half_row = 0.5 * path.size * path.stretch(p[0]);
          const bool   in_reach = std::abs(p[1]) <= rail.contact_half_width &&
                                zones.meet(p[0] - half_row, p[0] + half_row, rail.contact_margin);
          return in_reach ? Boundary::contact : Boundary::free;
        }
      if (std::abs(p[2] + chart.base_depth) < tolerance)
        return Boundary::support;
      if (std::min(std::abs(p[0] - rail.x_begin), std::abs(p[0] - rail.x_end)) < tolerance)
        return Boundary::end;
      return Boundary::free;
    };
    return body;
  }
} // namespace tread
