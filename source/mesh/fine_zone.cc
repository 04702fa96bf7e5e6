// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/mesh/fine_zone.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace tread
{
  namespace
  {
    /// Rows from the anchor outwards on a side of the given length: how many have the regular size, and
    /// how many of which size follow.
    struct Rows
    {
      unsigned int n_regular;
      unsigned int n_stretched;
      double       stretched_size;
    };

    Rows divide(const double length, const double size)
    {
      // a remainder or a shortfall of a millionth of a cell is round-off
      const double       tolerance = 1e-6;
      const unsigned int n         = static_cast<unsigned int>(std::floor(length / size + tolerance));
      const double       rest      = length / size - n;
      if (rest <= tolerance)
        return {n, 0, 0.};
      if (rest >= 0.7 || n == 0 || (n == 1 && rest > 0.5))
        return {n, 1, rest * size};
      if (rest <= 0.5)
        return {n - 1, 1, (1. + rest) * size};
      return {n - 1, 2, 0.5 * (1. + rest) * size};
    }
  } // namespace

  std::array<double, 2> FineZone::cubes() const
  {
    const double from = std::max(x_begin, cubes_begin), to = std::min(x_end, cubes_end);
    const double middle = 0.5 * (x_begin + x_end);
    return from < to ? std::array<double, 2>{{from, to}} : std::array<double, 2>{{middle, middle}};
  }

  FineZone FineZone::in_window() const
  {
    FineZone part     = *this;
    part.x_begin      = std::max(x_begin, window_begin);
    part.x_end        = std::min(x_end, window_end);
    part.window_begin = -std::numeric_limits<double>::infinity();
    part.window_end   = std::numeric_limits<double>::infinity();
    if (!(part.x_begin < part.x_end))
      throw std::invalid_argument("the window of fine cells does not meet the path");
    return part;
  }

  double FineZone::distance(const double x, const double y, const double depth_of_point) const
  {
    const double margin = 0.01 * finest_cell_size;
    const double a      = std::max({x_begin + margin - x, x - (x_end - margin), 0.});
    const double b      = std::max(std::abs(y - y_middle) - (half_width - margin), 0.);
    double       below = std::max(depth_of_point - (depth - margin), 0.), c = 0.;
    for (double layer = 2. * cells_per_level * finest_cell_size; layer < level_depth && below > 0.;
         layer *= 2.)
      {
        const double part = std::min(below, level_depth);
        c += part * layer / level_depth;
        below -= part;
      }
    c += below;
    return std::sqrt(a * a + b * b + c * c);
  }

  double FineZone::wanted_size(const double distance) const
  {
    if (distance <= 0.)
      return finest_cell_size;
    const double level = std::floor(std::log2(2. + distance / (cells_per_level * finest_cell_size)));
    return finest_cell_size * std::exp2(level);
  }

  double FineZone::wanted_size(const double x, const double y, const double depth_of_point) const
  {
    if (x_begin < window_begin || x_end > window_end)
      return in_window().wanted_size(x, y, depth_of_point);
    if (path_level == 0)
      return wanted_size(distance(x, y, depth_of_point));
    FineZone path         = *this;
    path.path_level       = 0;
    path.finest_cell_size = std::ldexp(finest_cell_size, path_level);
    const double on_path  = path.wanted_size(x, y, depth_of_point);
    FineZone     fine     = *this;
    fine.path_level       = 0;
    fine.x_begin          = cubes()[0];
    fine.x_end            = cubes()[1];
    return fine.x_begin < fine.x_end ? std::min(on_path, fine.wanted_size(x, y, depth_of_point)) : on_path;
  }

  FineZones::FineZones(const std::vector<FineZone> &zones)
    : zones(zones)
  {
    bool in_order = !zones.empty();
    for (std::size_t k = 1; k < zones.size(); ++k)
      in_order = in_order && zones[k - 1].x_end < zones[k].x_begin;
    if (!in_order)
      throw std::invalid_argument("fine zones must follow each other without overlap");
  }

  double FineZones::wanted_size(const double x, const double y, const double depth) const
  {
    double size = std::numeric_limits<double>::max();
    for (const FineZone &zone : zones)
      size = std::min(size, zone.wanted_size(x, y, depth));
    return size;
  }

  bool FineZones::meet(const double begin, const double end, const double margin) const
  {
    return std::any_of(zones.begin(), zones.end(), [&](const FineZone &zone) {
      return end > zone.x_begin - margin && begin < zone.x_end + margin;
    });
  }

  double regular_length(const double length, const double size)
  {
    return divide(length, size).n_regular * size;
  }

  std::vector<double> coarse_lines(const double begin,
                                   const double end,
                                   const double anchor,
                                   const double size)
  {
    if (!(begin <= anchor && anchor <= end && begin < end && size > 0.))
      throw std::invalid_argument("coarse_lines: needs begin <= anchor <= end and a positive size");

    // distances from the anchor, without the anchor itself
    const auto side = [size](const double length) {
      std::vector<double> lines;
      const Rows          rows = divide(length, size);
      for (unsigned int i = 1; i <= rows.n_regular; ++i)
        lines.push_back(i * size);
      for (unsigned int i = 1; i <= rows.n_stretched; ++i)
        lines.push_back(rows.n_regular * size + i * rows.stretched_size);
      if (!lines.empty())
        lines.back() = length;
      return lines;
    };

    std::vector<double> lines = side(anchor - begin);
    std::reverse(lines.begin(), lines.end());
    for (double &line : lines)
      line = anchor - line;
    lines.push_back(anchor);
    for (const double line : side(end - anchor))
      lines.push_back(anchor + line);
    return lines;
  }

  double PathLines::stretch(const double x) const
  {
    const std::size_t i = std::clamp<std::ptrdiff_t>(
      std::upper_bound(lines.begin(), lines.end(), x) - lines.begin() - 1, 0, lines.size() - 2);
    return (lines[i + 1] - lines[i]) / size;
  }

  namespace
  {
    /// Lines from begin to end about one zone, of rows that may be longer than others.
    std::vector<double> lines_about(const double    begin,
                                    const double    end,
                                    const double    size,
                                    const FineZone &zone,
                                    const double    far_stretch)
    {
      const double from = std::max(begin, zone.cubes()[0]), to = std::min(end, zone.cubes()[1]);
      if (!(from <= to))
        throw std::invalid_argument("path_lines: the path does not lie between begin and end");
      const double anchor = (from <= 0. && 0. <= to) ? 0. : 0.5 * (from + to);

      constexpr double growth = 1.4;
      // distances from the anchor, without the anchor itself
      const auto side = [&](const double length, const double cubes, const double path) {
        std::vector<double> lines;
        const unsigned int  n_regular = std::min(std::floor(length / size), std::ceil(cubes / size - 1e-6));
        for (unsigned int i = 1; i <= n_regular; ++i)
          lines.push_back(i * size);
        const double regular = n_regular * size, rest = length - regular;
        if (rest < 0.7 * size && !lines.empty())
          {
            lines.back() = length;
            return lines;
          }
        double row = size, position = regular;
        while (position < length - 1e-6 * size)
          {
            const double limit =
              position < path ? zone.path_stretch : std::max(far_stretch, zone.path_stretch);
            row = std::min(growth * row, std::max(limit, 1.) * size);
            position += row;
            lines.push_back(position);
          }
        for (unsigned int i = n_regular; i < lines.size(); ++i)
          lines[i] = regular + (lines[i] - regular) * rest / (position - regular);
        return lines;
      };

      std::vector<double> lines = side(anchor - begin, anchor - from, anchor - zone.x_begin);
      std::reverse(lines.begin(), lines.end());
      for (double &line : lines)
        line = anchor - line;
      lines.push_back(anchor);
      for (const double line : side(end - anchor, to - anchor, zone.x_end - anchor))
        lines.push_back(anchor + line);
      return lines;
    }
  } // namespace

  PathLines path_lines(const double     begin,
                       const double     end,
                       const double     size,
                       const FineZones &zones,
                       const double     far_stretch)
  {
    if (zones.any().path_stretch <= 1. && far_stretch <= 1.)
      return {coarse_lines(begin, end, (begin <= 0. && 0. <= end) ? 0. : 0.5 * (begin + end), size), size};
    PathLines path{{}, size};
    double    from = begin;
    for (std::size_t k = 0; k < zones.all().size(); ++k)
      {
        const FineZone &zone = zones.all()[k];
        const double to = k + 1 < zones.all().size() ? 0.5 * (zone.x_end + zones.all()[k + 1].x_begin) : end;
        const std::vector<double> lines = lines_about(from, to, size, zone, far_stretch);
        path.lines.insert(path.lines.end(), lines.begin() + (k > 0 ? 1 : 0), lines.end());
        from = to;
      }
    return path;
  }

  double coarse_cell_size(const double finest, const double coarsest, const std::vector<CoarseSide> &sides)
  {
    if (!(finest > 0. && coarsest >= finest))
      throw std::invalid_argument(
        "the coarsest cell size must not be below the finest, and both must be positive");

    const double tolerance = 1e-6 * finest;
    for (int k = static_cast<int>(std::floor(std::log2(coarsest / finest) + 1e-9)); k >= 0; --k)
      {
        const double size    = finest * std::exp2(k);
        bool         regular = true;
        for (const CoarseSide &side : sides)
          regular = regular && side.regular <= regular_length(side.length, size) + tolerance &&
                    (side.length <= tolerance || side.length >= 0.7 * size);
        if (regular)
          return size;
      }

    std::ostringstream message;
    message << "the body is too small for its fine zone with cells of " << 1e3 * finest << " mm";
    throw std::invalid_argument(message.str());
  }
} // namespace tread
