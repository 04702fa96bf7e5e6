// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/mesh/mesh_rail.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace tread
{
  namespace
  {
    FacetSurface surface_of(const MeshFile &mesh)
    {
      std::vector<FacetSurface::Quadrilateral> faces;
      for (const NamedFace &face : mesh.faces)
        if (face.boundary == Boundary::contact)
          faces.push_back(face.vertices);
      try
        {
          return FacetSurface(mesh.vertices, faces);
        }
      catch (const InputError &error)
        {
          throw InputError("'" + mesh.file + "': " + error.what());
        }
    }

    /// What the faces of the boundary are named, found by their middles.
    class FaceNames
    {
    public:
      explicit FaceNames(const MeshFile &mesh)
      {
        for (const NamedFace &face : mesh.faces)
          {
            dealii::Point<3> middle;
            for (const unsigned int v : face.vertices)
              middle += 0.25 * mesh.vertices[v];
            entries.push_back({middle, face.boundary});
          }
        std::sort(entries.begin(), entries.end(),
                  [](const Entry &a, const Entry &b) { return a.middle[0] < b.middle[0]; });
      }

      Boundary at(const dealii::Point<3> &p) const
      {
        constexpr double round_off = 1e-9; // m; nodes are further apart
        for (auto entry = std::lower_bound(entries.begin(), entries.end(), p[0] - round_off,
                                           [](const Entry &e, const double x) { return e.middle[0] < x; });
             entry != entries.end() && entry->middle[0] <= p[0] + round_off; ++entry)
          if (entry->middle.distance(p) <= round_off)
            return entry->boundary;
        return Boundary::free;
      }

    private:
      struct Entry
      {
        dealii::Point<3> middle;
        Boundary         boundary;
      };
      std::vector<Entry> entries; // in the order of x
    };

    /// Whether faces of symmetry along the path are there on either side.
    bool has_both_sides(const MeshFile &mesh)
    {
      const MeshFile::Range across = mesh.range(1);
      bool                  ends[2]{};
      for (const NamedFace &face : mesh.faces)
        if (face.boundary == Boundary::side)
          ends[mesh.vertices[face.vertices[0]][1] > 0.5 * (across.begin + across.end)] = true;
      return ends[0] && ends[1];
    }
  } // namespace


  MeshRail::MeshRail(const MeshFile &file)
    : mesh(file)
    , surface(surface_of(file))
    , between_planes(has_both_sides(file))
  {
  }


  double MeshRail::thickness(const double x, const double y) const
  {
    return surface.facet(x, y).z - mesh.range(2).begin;
  }


  namespace
  {
    /// A cell of the file at the running surface.
    struct CoarseSurfaceCell
    {
      const NamedFace *face;
      double           edges[3]; ///< mean ones along the path, across and down, m
      double           low[2], high[2];

      double mean() const
      {
        return (edges[0] + edges[1] + edges[2]) / 3.;
      }
      dealii::Point<3> middle(const MeshFile &mesh) const
      {
        dealii::Point<3> p;
        for (const unsigned int v : face->vertices)
          p += 0.25 * mesh.vertices[v];
        return p;
      }
    };

    /// Those of which the faces meet a region. @param is_met function of a CoarseSurfaceCell
    template <typename Function>
    std::vector<CoarseSurfaceCell> coarse_surface_cells(const MeshFile &mesh, const Function &is_met)
    {
      std::vector<CoarseSurfaceCell> cells;
      for (const NamedFace &face : mesh.faces)
        {
          if (face.boundary != Boundary::contact)
            continue;
          CoarseSurfaceCell cell{&face, {0., 0., 0.}, {}, {}};
          for (unsigned int d = 0; d < 2; ++d)
            {
              cell.low[d] = cell.high[d] = mesh.vertices[face.vertices[0]][d];
              for (const unsigned int v : face.vertices)
                {
                  cell.low[d]  = std::min(cell.low[d], mesh.vertices[v][d]);
                  cell.high[d] = std::max(cell.high[d], mesh.vertices[v][d]);
                }
            }
          const auto &corners = mesh.cells[face.cell].vertices;
          for (unsigned int v = 0; v < 8; ++v)
            for (unsigned int d = 0; d < 3; ++d)
              if (!(v >> d & 1u))
                cell.edges[d] +=
                  0.25 * mesh.vertices[corners[v]].distance(mesh.vertices[corners[v | 1u << d]]);
          if (is_met(cell))
            cells.push_back(cell);
        }
      return cells;
    }

    double mean_edge_of(const std::vector<CoarseSurfaceCell> &cells)
    {
      double sum = 0.;
      for (const CoarseSurfaceCell &cell : cells)
        sum += cell.mean();
      return cells.empty() ? 0. : sum / cells.size();
    }

    /// Mean edge of the cells at the running surface that the fine zones meet.
    double mean_edge_in(const FineZones &zones, const MeshFile &mesh)
    {
      return mean_edge_of(coarse_surface_cells(mesh, [&](const CoarseSurfaceCell &cell) {
        return std::any_of(zones.all().begin(), zones.all().end(), [&](const FineZone &zone) {
          return cell.high[0] > zone.x_begin && cell.low[0] < zone.x_end &&
                 cell.high[1] > zone.y_middle - zone.half_width &&
                 cell.low[1] < zone.y_middle + zone.half_width;
        });
      }));
    }

    /// The cell of which an edge differs most from the mean one, where that is more than by a factor of 1.5
    /// up, which a patch of ten cells feels, or of 2 down, which costs steps.
    std::string doubt_about_edges(const MeshFile                       &mesh,
                                  const std::vector<CoarseSurfaceCell> &cells,
                                  const double                          finest_cell_size)
    {
      constexpr double         too_long = 1.5, too_short = 0.5; // of the mean edge
      constexpr double         tolerance = 1.2;                 // @see refine() of mesh.cc
      const double             mean      = mean_edge_of(cells);
      const CoarseSurfaceCell *worst     = nullptr;
      double                   by        = 1.;
      unsigned int             n         = 0;
      for (const CoarseSurfaceCell &cell : cells)
        {
          const auto [least, most] = std::minmax_element(std::begin(cell.edges), std::end(cell.edges));
          if (*most <= too_long * mean && *least >= too_short * mean)
            continue;
          ++n;
          if (const double now = std::max(*most / (too_long * mean), too_short * mean / *least); now > by)
            {
              by    = now;
              worst = &cell;
            }
        }
      if (!worst)
        return "";
      double halved = 1.;
      while (halved * mean > tolerance * finest_cell_size)
        halved *= 0.5;
      const auto in_mm = [&](const double length) {
        return format("%.3g", 1e3 * length);
      };
      const dealii::Point<3> p = worst->middle(mesh);
      return format(
        "%u of %zu cells at the running surface under the path have edges unlike the mean one of %s "
        "mm: that at x = %s, y = %s mm of %s x %s x %s mm (along, across, down) is refined to %s x %s "
        "x %s mm, where 'Mesh/Finest cell (mm)' is %s; make such cells about as long as wide and high",
        n, cells.size(), in_mm(mean).c_str(), in_mm(p[0]).c_str(), in_mm(p[1]).c_str(),
        in_mm(worst->edges[0]).c_str(), in_mm(worst->edges[1]).c_str(), in_mm(worst->edges[2]).c_str(),
        in_mm(halved * worst->edges[0]).c_str(), in_mm(halved * worst->edges[1]).c_str(),
        in_mm(halved * worst->edges[2]).c_str(), in_mm(finest_cell_size).c_str());
    }

    /// Faces side by side of which one is longer than the other away from their common edge.
    std::string doubt_about_jumps(const MeshFile &mesh, const std::vector<CoarseSurfaceCell> &cells)
    {
      constexpr double                                                           most = 2.5;
      std::map<std::pair<unsigned int, unsigned int>, std::pair<double, double>> sides; // shortest, longest
      for (const CoarseSurfaceCell &cell : cells)
        for (unsigned int v = 0; v < 4; ++v)
          {
            const auto &around = cell.face->vertices;
            const auto  length = [&](const unsigned int from) {
              return mesh.vertices[around[from % 4]].distance(mesh.vertices[around[(from + 1) % 4]]);
            };
            const double away = 0.5 * (length(v + 1) + length(v + 3));
            auto        &side =
              sides.try_emplace(std::minmax(around[v], around[(v + 1) % 4]), away, away).first->second;
            side = {std::min(side.first, away), std::max(side.second, away)};
          }
      const auto worst = std::max_element(sides.begin(), sides.end(), [](const auto &a, const auto &b) {
        return a.second.second * b.second.first < b.second.second * a.second.first;
      });
      if (worst == sides.end() || worst->second.second <= most * worst->second.first)
        return "";
      const auto &[edge, lengths] = *worst;
      const auto p                = 0.5 * (mesh.vertices[edge.first] + mesh.vertices[edge.second]);
      return format(
        "faces of the running surface side by side at x = %.3g, y = %.3g mm are %.3g and %.3g mm "
        "long: finest cells differ as they do, and the fitted surface is that of the longer ones; "
        "let sizes change by less than a factor of %g from face to face",
        1e3 * p[0], 1e3 * p[1], 1e3 * lengths.second, 1e3 * lengths.first, most);
    }

    std::string doubt_about_material(const MeshFile &mesh, const std::vector<CoarseSurfaceCell> &cells)
    {
      const std::size_t n = std::count_if(cells.begin(), cells.end(), [&](const CoarseSurfaceCell &cell) {
        return mesh.cells[cell.face->cell].material_id != 0;
      });
      return 2 * n <= cells.size()
               ? ""
               : format("%zu of %zu faces of the running surface under the path are of "
                        "'Rail/Materials': half-space answers, predicted creepage, stresses and yielding are "
                        "of the rail's own steel",
                        n, cells.size());
    }
  } // namespace


  std::vector<std::string> MeshRail::doubts_about_cells(const Strip &under_path,
                                                        const double finest_cell_size) const
  {
    const auto               cells = coarse_surface_cells(mesh, [&](const CoarseSurfaceCell &cell) {
      return cell.high[0] > under_path.x_begin && cell.low[0] < under_path.x_end &&
             cell.high[1] > under_path.y_begin && cell.low[1] < under_path.y_end;
    });
    std::vector<std::string> doubts;
    for (const std::string &doubt : {doubt_about_edges(mesh, cells, finest_cell_size),
                                     doubt_about_jumps(mesh, cells), doubt_about_material(mesh, cells)})
      if (!doubt.empty())
        doubts.push_back("'" + mesh.file + "': " + doubt);
    return doubts;
  }


  Body make_mesh_rail(const std::shared_ptr<const MeshRail> &rail, const FineZones &zones)
  {
    Body body;
    body.name         = "rail";
    body.vertices     = rail->mesh.vertices;
    body.cells        = rail->mesh.cells;
    const auto lowest = rail->mesh.range(2).begin;
    body.to_space     = [rail, lowest](const dealii::Point<3> &p) {
      const FacetSurface::Facet facet = rail->surface.facet(p[0], p[1]);
      const double              fades = std::min(rail->surface.mean_edge(), 0.5 * (facet.z - lowest)),
                   share              = std::clamp(1. - (facet.z - p[2]) / fades, 0., 1.);
      return dealii::Point<3>(p[0], p[1], p[2] + share * facet.smooth_above);
    };
    body.wanted_cell_size = [rail, zones](const dealii::Point<3> &p) {
      return zones.wanted_size(p[0], p[1], std::max(0., rail->surface.facet(p[0], p[1]).z - p[2]));
    };
    body.even_edge = mean_edge_in(zones, rail->mesh);
    if (body.even_edge > 0.)
      body.even_size = std::ldexp(zones.any().finest_cell_size, zones.any().path_level);
    body.boundary_at = [names = FaceNames(rail->mesh)](const dealii::Point<3> &p) {
      return names.at(p);
    };
    return body;
  }
} // namespace tread
