// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_mesh_mesh_rail_h
#define tread_mesh_mesh_rail_h

#include <tread/geometry/facet_surface.h>
#include <tread/mesh/body.h>
#include <tread/mesh/fine_zone.h>
#include <tread/mesh/mesh_file.h>

#include <memory>
#include <string>
#include <vector>

namespace tread
{
  /// A rail from a file, and the running surface that its faces `contact` describe. x along the path, z up.
  struct MeshRail
  {
    MeshFile     mesh;
    FacetSurface surface;
    /// Whether it lies between two planes of symmetry along the path. Its running surface may be touched up
    /// to them and goes on behind them as its own image: a wheel with the same section all over its width
    /// then loads it as in plane strain.
    bool between_planes;

    /// @throws InputError
    explicit MeshRail(const MeshFile &file);

    /// Of the material below the running surface at x, y, down to the lowest vertex, m.
    double thickness(const double x, const double y) const;

    /// A stretch of the running surface, m.
    struct Strip
    {
      double x_begin, x_end, y_begin, y_end;
    };
    /// What the coarse cells at the running surface there become when their mean edge is halved down to the
    /// finest size: cells that are too long, too short, or of very unlike lengths side by side. One line
    /// each, with the file's name.
    std::vector<std::string> doubts_about_cells(const Strip &under_path, const double finest_cell_size) const;
  };

  /// The rail with its cells refined about the fine zones. New nodes lie on the straight sides of the coarse
  /// cells, and near the running surface are lifted by what that is above the facets: all of it at the
  /// surface, none from the depth of a coarse face's edge on. Vertices of the file stay where they are at the
  /// surface.
  Body make_mesh_rail(const std::shared_ptr<const MeshRail> &rail, const FineZones &zones);
} // namespace tread

#endif
