// SPDX-License-Identifier: LGPL-2.1-or-later
// The whole rail: area, centroid and second moments of the meshed section against the profile's, shape of the
// cells, the time step that they allow, what the boundary is used for, and rows along the path.
#include <tread/mesh/mesh.h>
#include <tread/mesh/whole_rail.h>
#include <tread/solid/solid.h>

#include <deal.II/base/mpi.h>

#include "check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

using namespace tread;

namespace
{
  dealii::Tensor<1, 3> edge(const Mesh        &mesh,
                            const Mesh::Cell  &cell,
                            const unsigned int a,
                            const unsigned int b)
  {
    return mesh.nodes[cell.nodes[b]] - mesh.nodes[cell.nodes[a]];
  }

  struct Shapes
  {
    double scaled_jacobian = 1e300, fine_scaled_jacobian = 1e300, longest = 0.;
  };

  /// Determinant of the three edges at a vertex over their lengths, the smallest.
  Shapes shapes(const Mesh &mesh, const FineZone &zone)
  {
    Shapes s;
    for (const Mesh::Cell &cell : mesh.cells)
      {
        double least = 1e300;
        for (unsigned int v = 0; v < 8; ++v)
          {
            dealii::Tensor<1, 3> e[3];
            for (unsigned int d = 0; d < 3; ++d)
              e[d] = edge(mesh, cell, v & ~(1u << d), v | (1u << d));
            least = std::min(least, e[0] * dealii::cross_product_3d(e[1], e[2]) /
                                      (e[0].norm() * e[1].norm() * e[2].norm()));
          }
        s.scaled_jacobian = std::min(s.scaled_jacobian, least);
        const auto &p     = mesh.nodes[cell.nodes[0]];
        if (p[0] > zone.cubes_begin && p[0] < zone.cubes_end && zone.distance(p[0], p[1], -p[2]) == 0.)
          s.fine_scaled_jacobian = std::min(s.fine_scaled_jacobian, least);
        s.longest = std::max(s.longest, edge(mesh, cell, 0, 1).norm());
      }
    return s;
  }

  /// Properties of what the end faces at the largest x cover, quadrilaterals cut into triangles.
  SectionProperties end_section(const Mesh &mesh, const double height)
  {
    double x_end = -1e300;
    for (const auto &p : mesh.nodes)
      x_end = std::max(x_end, p[0]);
    double area = 0., moment = 0., yy = 0., zz = 0.;
    for (const Mesh::Face &face : mesh.faces)
      if (face.boundary == Boundary::end && mesh.nodes[face.nodes[0]][0] > x_end - 1e-6)
        for (const unsigned int last : {2u, 3u})
          {
            std::array<std::array<double, 2>, 3> t;
            const unsigned int                   corners[3] = {0, last - 1, last};
            for (unsigned int i = 0; i < 3; ++i)
              t[i] = {
                {mesh.nodes[face.nodes[corners[i]]][1], mesh.nodes[face.nodes[corners[i]]][2] + height}};
            const double a = 0.5 * std::abs((t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) -
                                            (t[2][0] - t[0][0]) * (t[1][1] - t[0][1]));
            area += a;
            for (unsigned int i = 0; i < 3; ++i)
              {
                // the middles of the sides integrate quadratics exactly
                const double y = 0.5 * (t[i][0] + t[(i + 1) % 3][0]), z = 0.5 * (t[i][1] + t[(i + 1) % 3][1]);
                moment += a / 3. * z;
                yy += a / 3. * z * z;
                zz += a / 3. * y * y;
              }
          }
    return {area, moment / area, yy - moment * moment / area, zz};
  }
} // namespace

void run_test(tests::Check &check, const tests::Arguments &)
{
  for (const RailProfile &profile : {RailProfile::rail_54e1(), RailProfile::rail_60e1()})
    {
      const std::string &name = profile.name();
      FineZone           zone;
      zone.finest_cell_size = 1.1e-3;
      zone.x_begin          = -0.15;
      zone.x_end            = 0.15;
      zone.half_width       = 8e-3;
      zone.depth            = 2.2e-3;
      zone.cubes_begin      = -0.03;
      zone.cubes_end        = 0.04;
      zone.path_stretch     = 3.;
      WholeRail rail;
      rail.x_begin = -0.6;
      rail.x_end   = 0.6;
      const Mesh mesh(MPI_COMM_SELF, {make_whole_rail(profile, rail, zone)});

      const SectionProperties exact = profile.section(), meshed = end_section(mesh, profile.height());
      check.relative(name + " meshed area, cm2", 1e4 * meshed.area, 1e4 * exact.area, 0.01);
      check.relative(name + " meshed centroid, mm", 1e3 * meshed.centroid_height, 1e3 * exact.centroid_height,
                     0.01);
      check.relative(name + " meshed second moment, vertical, cm4", 1e8 * meshed.inertia_y,
                     1e8 * exact.inertia_y, 0.01);
      check.relative(name + " meshed second moment, lateral, cm4", 1e8 * meshed.inertia_z,
                     1e8 * exact.inertia_z, 0.02);

      const Shapes s = shapes(mesh, zone);
      check.that(name + " smallest scaled Jacobian above 0.4", s.scaled_jacobian > 0.4);
      check.that(name + " in the fine zone above 0.95", s.fine_scaled_jacobian > 0.95);
      check.below(name + " longest row, mm", 1e3 * s.longest, 40. + 1e-9);
      // The fine zone gives the time step, not a bad cell in a fillet.
      const Solid solid(mesh, {ElasticMaterial{210e9, 0.3, 7800.}}, SolidParameters());
      double      fastest_fine = 0., fastest_other = 0.;
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        {
          dealii::Point<3> middle;
          for (const unsigned int i : mesh.cells[c].nodes)
            middle += 0.125 * mesh.nodes[i];
          double &fastest =
            zone.distance(middle[0], middle[1], -middle[2]) == 0. ? fastest_fine : fastest_other;
          fastest = std::max(fastest, solid.cell_frequencies()[c]);
        }
      check.below(name + " fastest cell beside the fine zone over the fastest in it",
                  fastest_other / fastest_fine, 1.01);

      std::printf("%s: %zu cells, scaled Jacobian %.3f, in the fine zone %.3f\n", name.c_str(),
                  mesh.cells.size(), s.scaled_jacobian, s.fine_scaled_jacobian);
    }
}
