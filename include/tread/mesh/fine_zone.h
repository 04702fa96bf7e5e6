// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_mesh_fine_zone_h
#define tread_mesh_fine_zone_h

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
    double half_width       = 9e-3;   ///< the box is |y| <= half_width (m)
    double depth            = 1.5e-3; ///< the box is 0 <= depth <= this (m)
    double cells_per_level  = 2; ///< cells of each size 2h, 4h, ... that lie between the box and larger ones

    /// Distance of a point from the box; zero inside (m). The box is taken smaller by a hundredth of a
    /// cell, so that cells which only touch it stay outside.
    double distance(double x, double y, double depth) const;

    /// The largest cell that may exist at the distance r from the box (m): the octree sizes are
    /// 2^k h, and in front of a cell of size 2^k h, k >= 2, lie n = cells_per_level cells of each of the
    /// sizes 2h, ..., 2^(k-1) h, which together take up n h (2^k - 2). So
    ///   size(0) = h,   size(r > 0) = 2^k h   with   k = floor(log2(2 + r / (n h))).
    /// It stays below 2h + r/n: n is the inverse slope of the mesh size.
    double wanted_size(double distance) const;

    /// wanted_size(distance(x, y, depth)).
    double wanted_size(double x, double y, double depth) const;
  };

  /// Lines of coarse cells on one axis: anchor + i size for whole i, apart from the last one or two
  /// rows at each side, which take up the remainder and are 0.7 to 1.5 times the size (0.5 to 1.5 beside a
  /// single regular row). A side shorter than that is one row. begin <= anchor <= end (m).
  std::vector<double> coarse_lines(double begin, double end, double anchor, double size);

  /// How far from the anchor the rows of coarse_lines have exactly the size, on a side that is
  /// `length` long (m).
  double regular_length(double length, double size);

  /// One side of one axis: its length from the anchor, and how much of it must have regular rows (m).
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
