// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/input_error.h>
#include <tread/mesh/mesh_rail.h>

#include <algorithm>
#include <cmath>

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
  } // namespace


  MeshRail::MeshRail(const MeshFile &file)
    : mesh(file)
    , surface(surface_of(file))
  {
  }


  double MeshRail::thickness(const double x, const double y) const
  {
    return surface.facet(x, y).z - mesh.range(2).begin;
  }


  namespace
  {
    /// Mean edge of the cells at the running surface that the fine zones meet.
    double mean_edge_in(const FineZones &zones, const MeshFile &mesh)
    {
      double       sum = 0.;
      unsigned int n   = 0;
      for (const NamedFace &face : mesh.faces)
        {
          double low[2], high[2];
          for (unsigned int d = 0; d < 2; ++d)
            {
              const auto coordinate = [&](const unsigned int a, const unsigned int b) {
                return mesh.vertices[a][d] < mesh.vertices[b][d];
              };
              low[d] =
                mesh.vertices[*std::min_element(face.vertices.begin(), face.vertices.end(), coordinate)][d];
              high[d] =
                mesh.vertices[*std::max_element(face.vertices.begin(), face.vertices.end(), coordinate)][d];
            }
          const bool is_met = std::any_of(zones.all().begin(), zones.all().end(), [&](const FineZone &zone) {
            return high[0] > zone.x_begin && low[0] < zone.x_end &&
                   high[1] > zone.y_middle - zone.half_width && low[1] < zone.y_middle + zone.half_width;
          });
          if (face.boundary != Boundary::contact || !is_met)
            continue;
          const auto &corners = mesh.cells[face.cell].vertices;
          for (unsigned int v = 0; v < 8; ++v)
            for (unsigned int d = 0; d < 3; ++d)
              if (!(v >> d & 1u))
                {
                  sum += mesh.vertices[corners[v]].distance(mesh.vertices[corners[v | 1u << d]]);
                  ++n;
                }
        }
      return n > 0 ? sum / n : 0.;
    }
  } // namespace


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
