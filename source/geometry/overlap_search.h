// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_overlap_search_h
#define tread_geometry_overlap_search_h

#include <tread/geometry/patch_surfaces.h>
#include <tread/geometry/wheel_on_rail.h>

#include <map>
#include <mutex>
#include <vector>

namespace tread
{
  /// Where a wheel overlaps a rail of which one changes along the way: the vertical gap on lines across the
  /// track, found once for all heights of a position.
  class OverlapSearch
  {
  public:
    OverlapSearch(const WheelOnRail &surfaces, const WheelsetPosition &position);

    /// Whether this is the search of these surfaces at this position but for its height.
    bool is_at(const WheelOnRail &others, const WheelsetPosition &position) const;

    /// @throws std::runtime_error where the wheel meets no rail
    WheelOnRail::Nearest             nearest(double height);
    std::vector<WheelOnRail::Region> overlaps(double height, double separation);

  private:
    /// Gap with the wheelset at the height 0 on columns across the track.
    struct Line
    {
      std::vector<double> gap, rail_z, wheel_s;
      double              least = 0.;
    };
    /// The line at this multiple of the spacing along x.
    const Line &line(int number);
    double      y(const std::size_t column) const;
    /// Inclination of the rail, dz/dy.
    double slope(const Line &line, std::size_t column) const;
    /// Lines that may have an overlap, or be next to one.
    std::vector<int> lines_below(double level);

    const WheelOnRail     &surfaces;
    const WheelsetPosition position; ///< at the height 0
    const PatchSurfaces    heights;  ///< over the plane on the rail tops
    double                 y_begin = 0.;
    std::size_t            columns = 0;
    std::map<int, Line>    lines;
    std::vector<int>       coarse; ///< lines on which the search begins
    std::mutex             mutex;
  };
} // namespace tread

#endif
