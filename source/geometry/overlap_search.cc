// SPDX-License-Identifier: LGPL-2.1-or-later
#include "overlap_search.h"

#include <tread/base/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tread
{
  namespace
  {
    /// Distance of the lines across the track and of the columns along it, m. A wheel that overlaps by 1 um
    /// does so over 2 mm along and, on a nose of 10 mm radius, 0.3 mm across.
    constexpr double line_spacing = 0.2e-3, column_spacing = 0.05e-3;

    /// The first lines are so many apart.
    constexpr int coarse_step = 5;

    /// How far from the axle a wheel may touch, over its radius: where a rail rises by 1:7.
    constexpr double furthest = 0.15;

    /// What two coarse lines may differ from the gap between them, m.
    constexpr double between_lines = 0.2e-3;

    /// Gap where there is no rail below the wheel, m.
    constexpr double far_away = 1e3;

    WheelsetPosition at_height_0(WheelsetPosition position)
    {
      position.height = 0.;
      return position;
    }

    WheelOnRail::Region whole_wheel(const WheelOnRail &surfaces)
    {
      WheelOnRail::Region region;
      region.s_end = surfaces.wheel().length();
      return region;
    }

    /// Calls add(column, height, share, step) for all columns over the steps of a section.
    template <typename Add>
    void over_columns(const PatchSurfaces::Section &section,
                      const double                  y_begin,
                      const std::size_t             columns,
                      const Add                    &add)
    {
      for (std::size_t k = 0; k + 1 < section.s.size(); ++k)
        {
          const double a = (section.s[k] - y_begin) / column_spacing,
                       b = (section.s[k + 1] - y_begin) / column_spacing;
          if (a == b)
            continue;
          const double low  = std::max(0., std::ceil(std::min(a, b))),
                       high = std::min(columns - 1., std::floor(std::max(a, b)));
          for (double c = low; c <= high; ++c)
            {
              const double share = (c - a) / (b - a);
              add(static_cast<std::size_t>(c),
                  section.height[k] + share * (section.height[k + 1] - section.height[k]), k, share);
            }
        }
    }
  } // namespace


  OverlapSearch::OverlapSearch(const WheelOnRail &surfaces, const WheelsetPosition &position)
    : surfaces(surfaces)
    , position(at_height_0(position))
    , heights(surfaces, at_height_0(position), whole_wheel(surfaces))
  {
    const Surface::Extent extent = surfaces.rail_surface().extent();
    const double          middle = position.shift + surfaces.wheel_origin_y(), around = 0.1; // m
    y_begin          = std::max(extent.y_begin + surfaces.rail_origin_y(), middle - around);
    const double end = std::min(extent.y_end + surfaces.rail_origin_y(), middle + around);
    if (!(end > y_begin))
      throw std::runtime_error("wheel and rail do not meet: nothing of the wheel is above the rail");
    columns        = static_cast<std::size_t>((end - y_begin) / column_spacing) + 1;
    const int most = static_cast<int>(furthest * surfaces.radius() / (coarse_step * line_spacing));
    for (int k = -most; k <= most; ++k)
      if (extent.includes(position.along + coarse_step * k * line_spacing))
        coarse.push_back(coarse_step * k);
    if (coarse.empty())
      throw std::runtime_error("the wheel stands at " + text_in_mm(position.along) +
                               " mm, beyond the ends of the rail's slices, which reach from " +
                               text_in_mm(extent.along_begin) + " to " + text_in_mm(extent.along_end) +
                               " mm");
  }


  bool OverlapSearch::is_at(const WheelOnRail &others, const WheelsetPosition &p) const
  {
    return &others == &surfaces && p.shift == position.shift && p.yaw == position.yaw &&
           p.roll == position.roll && p.along == position.along && p.pitch == position.pitch;
  }


  double OverlapSearch::y(const std::size_t column) const
  {
    return y_begin + column * column_spacing;
  }


  double OverlapSearch::slope(const Line &line, const std::size_t column) const
  {
    const std::size_t before = column > 0 ? column - 1 : column, behind = std::min(column + 1, columns - 1);
    const double      z    = line.rail_z[column];
    const double      left = line.rail_z[before], right = line.rail_z[behind];
    // Beside a place without a rail the other side counts.
    if (left < -0.5 * far_away)
      return right < -0.5 * far_away ? 0. : (right - z) / column_spacing;
    if (right < -0.5 * far_away)
      return (z - left) / column_spacing;
    return (right - left) / ((behind - before) * column_spacing);
  }


  const OverlapSearch::Line &OverlapSearch::line(const int number)
  {
    if (const auto known = lines.find(number); known != lines.end())
      return known->second;
    Line        &line = lines[number];
    const double x    = number * line_spacing;
    line.gap.assign(columns, far_away);
    line.rail_z.assign(columns, -far_away);
    line.wheel_s.assign(columns, 0.);
    for (const PatchSurfaces::Section &section : heights.rail_sections(x))
      over_columns(section, y_begin, columns,
                   [&](const std::size_t column, const double height, const std::size_t, const double) {
                     line.rail_z[column] = std::max(line.rail_z[column], height);
                   });
    std::vector<double> wheel_z(columns, far_away);
    over_columns(
      heights.wheel_section(x), y_begin, columns,
      [&](const std::size_t column, const double height, const std::size_t step, const double share) {
        if (height < wheel_z[column])
          {
            wheel_z[column] = height;
            line.wheel_s[column] =
              heights.parameter(step) + share * (heights.parameter(1) - heights.parameter(0));
          }
      });
    for (std::size_t column = 0; column < columns; ++column)
      if (wheel_z[column] < far_away && line.rail_z[column] > -far_away)
        line.gap[column] = wheel_z[column] - line.rail_z[column];
    line.least = *std::min_element(line.gap.begin(), line.gap.end());
    return line;
  }


  std::vector<int> OverlapSearch::lines_below(const double level)
  {
    const auto is_known = [&](const int number) {
      return surfaces.rail_surface().extent().includes(position.along + number * line_spacing);
    };
    std::vector<int> below;
    for (const int k : coarse)
      if (line(k).least < level)
        for (int near = k - coarse_step; near <= k + coarse_step; ++near)
          if ((below.empty() || near > below.back()) && is_known(near))
            below.push_back(near);
    return below;
  }


  WheelOnRail::Nearest OverlapSearch::nearest(const double height)
  {
    const std::lock_guard lock(mutex);
    double                least = far_away;
    for (const int k : coarse)
      least = std::min(least, line(k).least);
    if (!(least < far_away))
      throw std::runtime_error("wheel and rail do not meet: nothing of the wheel is above the rail");
    int best = coarse.front();
    for (const int k : lines_below(least + between_lines))
      if (line(k).least < line(best).least)
        best = k;
    const Line       &at     = line(best);
    const std::size_t column = std::min_element(at.gap.begin(), at.gap.end()) - at.gap.begin();
    const double x = best * line_spacing, half = furthest * surfaces.radius() - coarse_step * line_spacing;
    constexpr double edge = 0.2e-3; // m
    if (std::abs(x) > half)
      throw std::runtime_error(
        "the wheel meets the rail far ahead of its axle or behind it: the rail rises or "
        "falls too steeply along the way");
    const double s = at.wheel_s[column];
    if (s < edge || s > surfaces.wheel().length() - edge)
      throw std::runtime_error(
        "the wheel meets the rail with the edge of its profile only: it falls between the rails "
        "or off them");
    WheelOnRail::Nearest nearest;
    nearest.gap         = at.least + height;
    nearest.inclination = std::atan(slope(at, column));
    nearest.point = {s, heights.wheel(x, y(column)).angle, {x, y(column), at.rail_z[column] + nearest.gap}};
    return nearest;
  }


  std::vector<WheelOnRail::Region> OverlapSearch::overlaps(const double height, const double separation)
  {
    const std::lock_guard  lock(mutex);
    const std::vector<int> below = lines_below(between_lines - height);
    // Places that hang together.
    struct Cell
    {
      int         line;
      std::size_t column;
    };
    std::map<int, std::vector<char>> open;
    for (const int k : below)
      {
        const Line       &at = line(k);
        std::vector<char> here(columns, 0);
        bool              any = false;
        for (std::size_t c = 0; c < columns; ++c)
          if (at.gap[c] + height < 0.)
            here[c] = 1, any = true;
        if (any)
          open[k] = std::move(here);
      }
    struct Island
    {
      std::vector<Cell> cells;
      double            x_low, x_high, y_low, y_high, z_at_low, z_at_high;
    };
    std::vector<Island> islands;
    for (auto &[k, here] : open)
      for (std::size_t c = 0; c < columns; ++c)
        if (here[c])
          {
            Island            island{{}, 1e300, -1e300, 1e300, -1e300, 0., 0.};
            std::vector<Cell> next{{k, c}};
            here[c] = 0;
            while (!next.empty())
              {
                const Cell cell = next.back();
                next.pop_back();
                island.cells.push_back(cell);
                const double x = cell.line * line_spacing, at = y(cell.column),
                             z = line(cell.line).rail_z[cell.column];
                island.x_low   = std::min(island.x_low, x);
                island.x_high  = std::max(island.x_high, x);
                if (at < island.y_low)
                  island.y_low = at, island.z_at_low = z;
                if (at > island.y_high)
                  island.y_high = at, island.z_at_high = z;
                for (int l = cell.line - 1; l <= cell.line + 1; ++l)
                  if (const auto beside = open.find(l); beside != open.end())
                    for (std::size_t b = cell.column - std::min<std::size_t>(cell.column, 1);
                         b <= std::min(cell.column + 1, columns - 1); ++b)
                      if (beside->second[b])
                        {
                          beside->second[b] = 0;
                          next.push_back({l, b});
                        }
              }
            islands.push_back(std::move(island));
          }
    std::sort(islands.begin(), islands.end(),
              [](const Island &a, const Island &b) { return a.y_low < b.y_low; });

    // Those that are nearer than the separation are one.
    std::vector<std::vector<Island>> groups;
    for (const Island &island : islands)
      {
        const auto is_near = [&](const Island &other) {
          const double along  = std::max({0., island.x_low - other.x_high, other.x_low - island.x_high});
          const double beside = std::max({0., island.y_low - other.y_high, other.y_low - island.y_high});
          const double up     = beside == 0.                  ? 0.
                                : island.y_low > other.y_high ? island.z_at_low - other.z_at_high
                                                              : other.z_at_low - island.z_at_high;
          return std::hypot(along, beside, up) < separation;
        };
        std::vector<Island> joined{island};
        for (auto group = groups.begin(); group != groups.end();)
          if (std::any_of(group->begin(), group->end(), is_near))
            {
              joined.insert(joined.end(), group->begin(), group->end());
              group = groups.erase(group);
            }
          else
            ++group;
        groups.push_back(std::move(joined));
      }

    std::vector<WheelOnRail::Region> regions;
    for (const std::vector<Island> &group : groups)
      {
        WheelOnRail::Region region;
        region.parts   = group.size();
        region.s_begin = std::numeric_limits<double>::max();
        double weights = 0., x = 0., at = 0., angle = 0., deepest = 0.;
        Cell   deep{};
        for (const Island &island : group)
          for (const Cell &cell : island.cells)
            {
              const Line  &here   = line(cell.line);
              const double depth  = -(here.gap[cell.column] + height);
              const double tilt   = std::atan(slope(here, cell.column));
              const double weight = depth * depth;
              weights += weight;
              x += weight * cell.line * line_spacing;
              at += weight * y(cell.column);
              angle += weight * tilt;
              region.s_begin = std::min(region.s_begin, here.wheel_s[cell.column]);
              region.s_end   = std::max(region.s_end, here.wheel_s[cell.column]);
              region.overlap = std::max(region.overlap, depth * std::cos(tilt));
              if (depth > deepest)
                {
                  deepest = depth;
                  deep    = cell;
                }
            }
        // Chords lie beside the surfaces: what overlaps by them only is none.
        const double x_deep = deep.line * line_spacing, y_deep = y(deep.column);
        if (!(weights > 0.) || heights.gap(x_deep, y_deep) + height >= 0.)
          continue;
        x /= weights;
        at /= weights;
        region.angle                      = angle / weights;
        PatchSurfaces::RailPlace below_it = heights.rail(x, at);
        if (!below_it.exists) // the middle of several may lie over a gap
          {
            x        = x_deep;
            at       = y_deep;
            below_it = heights.rail(x, at);
          }
        region.reference = {x, at, below_it.height};
        WheelOnRail::Region::Box box;
        const double             c = std::cos(region.angle), s = std::sin(region.angle);
        for (const Island &island : group)
          for (const Cell &cell : island.cells)
            {
              const double ahead = cell.line * line_spacing - x;
              const double along =
                (y(cell.column) - at) * c + (line(cell.line).rail_z[cell.column] - region.reference[2]) * s;
              box.x_low  = std::min(box.x_low, ahead - line_spacing);
              box.x_high = std::max(box.x_high, ahead + line_spacing);
              box.s_low  = std::min(box.s_low, along - column_spacing);
              box.s_high = std::max(box.s_high, along + column_spacing);
            }
        region.box = box;
        regions.push_back(region);
      }
    std::sort(regions.begin(), regions.end(),
              [](const auto &a, const auto &b) { return a.s_begin < b.s_begin; });
    return regions;
  }
} // namespace tread
