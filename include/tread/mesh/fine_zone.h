// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_mesh_fine_zone_h
#define tread_mesh_fine_zone_h

#include <array>
#include <limits>
#include <vector>

namespace tread
{
  /// The box under the contact path in which the cells have the finest size, and how fast they may
  /// grow around it. On the rail x is the coordinate along the rail; on the wheel it is the arc length
  /// along the tread (at the running radius), zero at the lowest point of the reference configuration
  /// and positive towards +x. y is lateral, depth is measured inwards from the surface. Lengths in m. The
  /// octree rounds the box outwards to whole cells of 2h: a depth of 2h, 4h, ... is filled exactly.
  struct FineZone
  {
    double finest_cell_size = 1e-3;   ///< edge of the cells in the box, h (m)
    double x_begin          = -0.02;  ///< contact path, margin for the patch included (m)
    double x_end            = 0.02;   ///< (m)
    double y_middle         = 0.;     ///< (m)
    double half_width       = 9e-3;   ///< the box is |y - y_middle| <= half_width (m)
    double depth            = 1.5e-3; ///< the box is 0 <= depth <= this (m)
    double cells_per_level  = 2;  ///< cells of each size 2h, 4h, ... that lie between the box and larger ones
    double level_depth      = 0.; ///< least thickness of the layer of each of these sizes below the box (m)

    /// Between these the cells of the box are cubes of the finest size (m). Elsewhere they are coarser by
    /// path_level levels of the octree, and up to path_stretch times as long along the path as they are wide.
    double       cubes_begin  = -std::numeric_limits<double>::infinity();
    double       cubes_end    = std::numeric_limits<double>::infinity();
    double       path_stretch = 1.;
    unsigned int path_level   = 0;

    /// The box is as long as the path, for the sake of the coarse cells; but only between these are cells of
    /// it fine at present (m). With other limits the same coarse cells are refined elsewhere.
    double window_begin = -std::numeric_limits<double>::infinity();
    double window_end   = std::numeric_limits<double>::infinity();

    /// The part of the box that lies in the window. @throws std::invalid_argument if there is none
    FineZone in_window() const;

    /// The cubes that lie in the box along the path; where none do, its middle twice (m).
    std::array<double, 2> cubes() const;

    /// Largest distance of the box from the middle of the body (m).
    double reach() const
    {
      return (y_middle < 0. ? -y_middle : y_middle) + half_width;
    }

    /// Distance of a point from the box; zero inside (m). The box is taken smaller by a hundredth of a
    /// cell, so that cells which only touch it stay outside. Below the box a layer that level_depth makes
    /// thicker counts as if it were not.
    ///
    /// Where the cells' size s doubles, hanging nodes stiffen a layer of cells, by a share that grows with
    /// s over the distance from the patch. With the same number of cells of each size that share stays what
    /// it is at the depth of a semi-axis, however small the finest cell is; layers that are as thick as the
    /// patch asks for let it shrink.
    double distance(double x, double y, double depth) const;

    /// The largest cell that may exist at the distance r from the box (m): the octree sizes are
    /// 2^k h, and in front of a cell of size 2^k h, k >= 2, lie n = cells_per_level cells of each of the
    /// sizes 2h, ..., 2^(k-1) h, which together take up n h (2^k - 2). So
    ///   size(0) = h,   size(r > 0) = 2^k h   with   k = floor(log2(2 + r / (n h))).
    /// It stays below 2h + r/n: n is the inverse slope of the mesh size.
    double wanted_size(double distance) const;

    /// The smaller value of wanted_size(distance(x, y, depth)) for the box with and without cubes, in the
    /// window.
    double wanted_size(double x, double y, double depth) const;
  };

  /// Where cells are fine at present: along the rail (x) and along the wheel's tread (arc length), m.
  struct FineWindow
  {
    double rail_begin  = -std::numeric_limits<double>::infinity();
    double rail_end    = std::numeric_limits<double>::infinity();
    double tread_begin = -std::numeric_limits<double>::infinity();
    double tread_end   = std::numeric_limits<double>::infinity();
  };

  /// The boxes on one body, in the order of x, none of which overlap along it: one for each wheel that rolls
  /// on a rail.
  class FineZones
  {
  public:
    FineZones(const FineZone &zone)
      : FineZones(std::vector<FineZone>{zone})
    {
    }

    /// @throws std::invalid_argument unless there is one, and they follow each other.
    explicit FineZones(const std::vector<FineZone> &zones);

    /// The smallest value of those of the zones.
    double wanted_size(double x, double y, double depth) const;

    /// Whether one of them, longer by a margin at each end, meets the interval between two x (m).
    bool meet(double begin, double end, double margin) const;

    const std::vector<FineZone> &all() const
    {
      return zones;
    }
    /// What is the same for all: sizes of cells, width and depth.
    const FineZone &any() const
    {
      return zones.front();
    }
    double x_begin() const
    {
      return zones.front().x_begin;
    }
    double x_end() const
    {
      return zones.back().x_end;
    }

  private:
    std::vector<FineZone> zones;
  };

  /// Lines of coarse cells on one axis: anchor + i size for whole i, apart from the last one or two
  /// rows at each side, which take up the remainder and are 0.7 to 1.5 times the size (0.5 to 1.5 beside a
  /// single regular row). A side shorter than that is one row. begin <= anchor <= end (m).
  std::vector<double> coarse_lines(double begin, double end, double anchor, double size);

  /// Lines of coarse cells along the path and how much longer than `size` the cells between them are.
  struct PathLines
  {
    std::vector<double> lines;
    double              size;

    /// Stretch of the row that contains x.
    double stretch(double x) const;
  };

  /// Lines from begin to end. Rows have the given size between cubes_begin and cubes_end of each zone. From
  /// there they grow by a factor of up to 1.4 per row to at most path_stretch times the size along the path,
  /// and to far_stretch times the size outside it, up to the middle between two zones (m). If neither allows
  /// longer rows, the lines are those of coarse_lines.
  PathLines path_lines(double begin, double end, double size, const FineZones &zones, double far_stretch);

  /// Distance from the anchor over which the rows of coarse_lines have exactly the size, on a side that is
  /// `length` long (m).
  double regular_length(double length, double size);

  /// One side of one axis: its length from the anchor, and the part of it that must have regular rows (m).
  struct CoarseSide
  {
    double length;
    double regular;
  };

  /// The largest coarse cell 2^k h, k >= 0, not above `coarsest`, for which on all sides the needed part is
  /// regular and no row is below 0.7 of it (m). Throws std::invalid_argument if there is none.
  double coarse_cell_size(double finest, double coarsest, const std::vector<CoarseSide> &sides);
} // namespace tread

#endif
