// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/csv_table.h>
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/geometry/rail_slices.h>
#include <tread/geometry/slice_list.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace tread
{
  namespace
  {
    using Point = dealii::Point<2>;

    /// Twice the area between a line from low to high y and the chord of its ends, positive where the line
    /// lies above it, m^2.
    double twice_area_below(const std::vector<Point> &line)
    {
      double area = 0.;
      for (std::size_t k = 0; k < line.size(); ++k)
        {
          const Point &a = line[k], &b = line[(k + 1) % line.size()];
          area += b[0] * a[1] - a[0] * b[1];
        }
      return area;
    }

    /// How wide a section is within an eighth of its height from its top over the same at its bottom.
    double width_of_top_over_bottom(const std::vector<Point> &points)
    {
      constexpr double share = 0.125;
      const auto [low, high] = std::minmax_element(
        points.begin(), points.end(), [](const Point &a, const Point &b) { return a[1] < b[1]; });
      const double height = (*high)[1] - (*low)[1];
      const auto   width  = [&](const double from, const double to) {
        double begin = std::numeric_limits<double>::max(), end = -begin;
        for (const Point &p : points)
          if (p[1] >= from && p[1] <= to)
            {
              begin = std::min(begin, p[0]);
              end   = std::max(end, p[0]);
            }
        return end - begin;
      };
      return width((*high)[1] - share * height, (*high)[1]) / width((*low)[1], (*low)[1] + share * height);
    }

    /// Whether most of what a line covers across lies nearer to its top than to its bottom.
    bool is_high(const std::vector<Point> &line)
    {
      std::vector<std::pair<double, double>> pieces; // height and extent in y
      double                                 total = 0.;
      for (std::size_t k = 0; k + 1 < line.size(); ++k)
        {
          pieces.emplace_back(0.5 * (line[k][1] + line[k + 1][1]), std::abs(line[k + 1][0] - line[k][0]));
          total += pieces.back().second;
        }
      std::sort(pieces.begin(), pieces.end());
      double below = 0., median = pieces.front().first;
      for (const auto &[height, extent] : pieces)
        if (below < 0.5 * total)
          {
            below += extent;
            median = height;
          }
      const auto [low, high] = std::minmax_element(
        line.begin(), line.end(), [](const Point &a, const Point &b) { return a[1] < b[1]; });
      return (*high)[1] - median <= median - (*low)[1];
    }

    /// z up and y from low to high. A line that does not run back in y is a running surface, most of which
    /// lies near its top whatever gaps and grooves it has. Below one that runs back, from foot to foot, lies
    /// the steel; one that is closed, or nearly so, goes round a foot, which is wider than the head.
    void set_upright(RailSlices &rail)
    {
      for (RailSlice &slice : rail.slices)
        if (!slice.points.empty() && slice.points.back()[0] < slice.points.front()[0])
          {
            require(slice.breaks.empty(), "'" + rail.file + "', slice at " + text_in_mm(slice.x) +
                                            " mm: points of a slice that is cut must run from low to high y");
            std::reverse(slice.points.begin(), slice.points.end());
            std::reverse(slice.bodies.begin(), slice.bodies.end());
          }
      constexpr double nearly = 0.25, hardly = 1.2; // of the width: the gap between ends, the way across
      double           up = 0.;                     // more slices for it than against it
      for (const RailSlice &slice : rail.slices)
        if (slice.points.size() > 2)
          {
            const auto [low, high] =
              std::minmax_element(slice.points.begin(), slice.points.end(),
                                  [](const Point &a, const Point &b) { return a[0] < b[0]; });
            const double width = (*high)[0] - (*low)[0];
            double       way   = 0.;
            for (std::size_t k = 0; k + 1 < slice.points.size(); ++k)
              way += std::abs(slice.points[k + 1][0] - slice.points[k][0]);
            const bool is_up = way <= hardly * width ? is_high(slice.points)
                               : slice.points.back()[0] - slice.points.front()[0] < nearly * width
                                 ? width_of_top_over_bottom(slice.points) <= 1.
                                 : twice_area_below(slice.points) >= 0.;
            up += is_up ? 1. : -1.;
          }
      if (up < 0.)
        for (RailSlice &slice : rail.slices)
          for (Point &p : slice.points)
            p[1] = 0. - p[1];
    }

    /// A table with a row for each point.
    RailSlices read_table_of_slices(const std::string &file)
    {
      const CsvTable table(
        file,
        [](const std::string &name) {
          return name == "x_mm" || name == "y_mm" || name == "z_mm" || name == "part" || name == "body";
        },
        "cannot read '" + file + "'", [](const std::string &name) { return name == "body"; });
      const std::vector<double> &x = table.column("x_mm"), &y = table.column("y_mm"),
                                &z = table.column("z_mm");
      const std::vector<double> part =
        table.has("part") ? table.column("part") : std::vector<double>(x.size(), 0.);
      const auto fail = [&](const std::size_t row, const std::string &what) {
        throw InputError("'" + file + "', row " + std::to_string(row + 1) + ": " + what);
      };
      constexpr double most = 100.;
      for (std::size_t row = 0; row < x.size(); ++row)
        if (!(part[row] >= 0. && part[row] <= most && part[row] == std::floor(part[row])))
          fail(row,
               "part is " + text_of(part[row]) + "; it must be a whole number, 0 where the slice is not cut");
      const double n_parts = part.empty() ? 0. : *std::max_element(part.begin(), part.end());
      RailSlices   rail{file, {}};
      double       length = 0.;
      for (std::size_t row = 0; row < x.size(); ++row)
        {
          const Point p(1e-3 * y[row], 1e-3 * z[row]);
          const bool  begins = rail.slices.empty() || 1e-3 * x[row] != rail.slices.back().x;
          if (begins)
            {
              rail.slices.push_back({1e-3 * x[row], {}, {}, {}});
              length = 0.;
              if (part[row] > 0.)
                rail.slices.back().breaks.assign(n_parts + 1, std::numeric_limits<double>::quiet_NaN());
            }
          RailSlice &slice = rail.slices.back();
          if (!begins)
            length += p.distance(slice.points.back());
          const auto now = static_cast<std::size_t>(part[row]);
          if (!begins && (now == 0) != slice.breaks.empty())
            fail(row, "a slice is cut as a whole or not at all: part is 0 for some of its points only");
          if (now > 0)
            {
              const auto before = static_cast<std::size_t>(begins ? part[row] : part[row - 1]);
              if (begins || now != before)
                {
                  if (now < before)
                    fail(row, "part " + text_of(part[row]) + " comes after part " + text_of(part[row - 1]) +
                                "; numbers must grow along a slice, which must be there once");
                  if (!begins && now > before + 1)
                    fail(row, "part " + text_of(part[row - 1] + 1.) + " is missing between its neighbours");
                  slice.breaks[now - 1] = length;
                }
              slice.breaks[now] = length;
            }
          slice.points.push_back(p);
          if (table.has("body"))
            slice.bodies.push_back(table.words("body")[row]);
        }
      if (rail.slices.empty())
        throw InputError("'" + file + "' has no points");
      return rail;
    }

    RailSlices read_slices_of_contact(const std::string &file)
    {
      const SliceList list = read_slice_list(file);
      require(!list.approximates,
              "'" + file + "', line " + std::to_string(list.line_of_method) +
                ": S_METHOD 2 is not available for rails; the splines go through the slices, 1");
      RailSlices rail{file, {}};
      double     largest = 0.;
      for (const SliceList::Entry &entry : list.entries)
        {
          RailSlice slice{1e-3 * entry.along, {}, {}, {}};
          for (const auto &[y, z] : entry.points)
            {
              slice.points.emplace_back(y, z);
              largest = std::max({largest, std::abs(y), std::abs(z)});
            }
          for (const double at : entry.features)
            slice.breaks.push_back(at < 0. ? std::numeric_limits<double>::quiet_NaN() : 1e-3 * at);
          rail.slices.push_back(slice);
        }
      // Points were read as if they were in mm.
      constexpr double largest_in_m = 1e-3;
      const double     unit         = largest < largest_in_m ? 1e3 : 1.;
      for (RailSlice &slice : rail.slices)
        {
          double length = 0.;
          for (std::size_t k = 0; k < slice.points.size(); ++k)
            {
              slice.points[k] *= unit;
              if (k > 0)
                length += slice.points[k].distance(slice.points[k - 1]);
            }
          // A number beyond the end stands for the end.
          for (double &at : slice.breaks)
            at = std::isnan(at) ? at : std::min(at, length);
          if (!slice.breaks.empty())
            {
              length = 0.;
              for (std::size_t k = 0; k < slice.points.size(); ++k)
                {
                  if (k > 0)
                    length += slice.points[k].distance(slice.points[k - 1]);
                  std::size_t part = 0;
                  for (std::size_t b = 0; b + 1 < slice.breaks.size(); ++b)
                    if (length >= slice.breaks[b])
                      part = b + 1;
                  slice.bodies.push_back(std::to_string(part));
                }
            }
        }
      return rail;
    }

    /// The formats, each with one line.
    struct SlicesFormat
    {
      std::string                                    ending;
      std::function<RailSlices(const std::string &)> read;
    };
    const std::vector<SlicesFormat> &formats_of_slices()
    {
      static const std::vector<SlicesFormat> list{{".slcs", read_slices_of_contact},
                                                  {".csv", read_table_of_slices}};
      return list;
    }
  } // namespace


  RailSlices read_rail_slices(const std::string &file)
  {
    std::string known;
    for (const SlicesFormat &format : formats_of_slices())
      {
        if (file.ends_with(format.ending))
          {
            RailSlices rail = format.read(file);
            set_upright(rail);
            return rail;
          }
        known += (known.empty() ? "" : " or ") + format.ending;
      }
    throw InputError("'" + file + "': slices of a rail must be in a file that ends in " + known);
  }


  bool has_rail_slices(const std::string &file)
  {
    if (!file.ends_with(".csv"))
      return file.ends_with(".slcs");
    try
      {
        const std::vector<NumberedLine> lines = csv_lines(file);
        return !lines.empty() && lines.front().text.find("x_mm") != std::string::npos;
      }
    catch (const TextError &error)
      {
        throw InputError("cannot read '" + file + "': " + error.what());
      }
  }
} // namespace tread
