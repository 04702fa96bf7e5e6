// SPDX-License-Identifier: LGPL-2.1-or-later
// The whole rail: area, centroid and second moments of the meshed section against the profile's, shape of the
// cells, the time step that they allow, what the boundary is used for, and rows along the path.
#include <tread/mesh/mesh.h>
#include <tread/mesh/whole_rail.h>
#include <tread/solid/solid.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"
#include "check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

using namespace tread;

namespace mesh_whole_rail
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
    double lowest = 1e300, highest = 0.; ///< edges of the cells in the fine zone along the depth, m
  };

  /// Determinant of the three edges at a vertex over their lengths, the smallest; lengths of edges.
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
          {
            s.fine_scaled_jacobian = std::min(s.fine_scaled_jacobian, least);
            s.lowest               = std::min(s.lowest, edge(mesh, cell, 0, 4).norm());
            s.highest              = std::max(s.highest, edge(mesh, cell, 0, 4).norm());
          }
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

  /// Rows along the path: as the fine zone asks near it, as the rail asks away from it.
  void check_rows(tests::Check &check)
  {
    FineZone zone;
    zone.x_begin          = -0.3;
    zone.x_end            = 0.3;
    zone.cubes_begin      = -0.05;
    zone.cubes_end        = 0.05;
    zone.path_stretch     = 2.;
    constexpr double size = 0.02, far_stretch = 5.;
    const PathLines  path     = path_lines(-1., 1., size, zone, far_stretch);
    double           of_cubes = 0., of_path = 0., far_away = 0., growth = 0.;
    for (std::size_t i = 0; i + 1 < path.lines.size(); ++i)
      {
        const double from = path.lines[i], to = path.lines[i + 1], stretch = (to - from) / size;
        double      &largest = std::min(std::abs(from), std::abs(to)) < 0.05 - 1e-9 ? of_cubes
                               : std::min(std::abs(from), std::abs(to)) < 0.28      ? of_path
                                                                                    : far_away;
        largest              = std::max(largest, stretch);
        if (from >= 0. && i > 0)
          growth = std::max(growth, (to - from) / (from - path.lines[i - 1]));
      }
    check.absolute("rows: at the cubes, over the size", of_cubes, 1., 1e-9);
    check.absolute("rows: along the path", of_path, 2., 0.15);
    check.absolute("rows: far away", far_away, 5., 0.5);
    check.below("rows: growth less 1.4", std::max(0., growth - 1.4), 1e-9);
  }

  /// A cell that is stretched along the path is refined by its width, and not by its length.
  void check_stretched_cell(tests::Check &check)
  {
    for (const double width : {2., 1.1})
      {
        Body body = tests::make_box("cell", dealii::Point<3>(), dealii::Point<3>(3., width, 1.), {{1, 1, 1}});
        body.wanted_cell_size = [](const dealii::Point<3> &) {
          return 1.;
        };
        body.path_stretch = [](const dealii::Point<3> &) {
          return 3.;
        };
        check.absolute("cells of one that is 3 long, 1 high, and wide " + std::to_string(width),
                       Mesh(MPI_COMM_SELF, {body}).cells.size(), width > 1.2 ? 8. : 1., 0.);
      }
  }

  /// Faces that could touch take part in the contact where the body says that the other one reaches them.
  void check_reach(tests::Check &check)
  {
    Body body     = tests::make_box("plate", dealii::Point<3>(), dealii::Point<3>(8., 4., 1.), {{8, 4, 1}},
                                    {{tests::Side::top, Boundary::contact}});
    body.in_reach = [](const dealii::Point<3> &p) {
      return p[0] < 3.;
    };
    unsigned int n = 0;
    for (const Mesh::Face &face : Mesh(MPI_COMM_SELF, {body}).faces)
      n += face.boundary == Boundary::contact;
    check.absolute("faces in reach of the other body", n, 12., 0.);
  }

  /// Hanging nodes lie at the mean of their parents also where the surface is curved, or a rotation would
  /// strain their cells.
  double off_the_mean(const Mesh &mesh)
  {
    double largest = 0.;
    for (const Mesh::HangingNode &h : mesh.hanging_nodes)
      {
        dealii::Point<3> mean;
        for (const unsigned int parent : h.parents)
          mean += Mesh::HangingNode::weight * mesh.nodes[parent];
        largest = std::max(largest, mean.distance(mesh.nodes[h.node]));
      }
    return largest;
  }
} // namespace mesh_whole_rail

TREAD_TEST(mesh_whole_rail)(tests::Check &check, const tests::Arguments &)
{
  check_rows(check);
  check_stretched_cell(check);
  check_reach(check);
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
      check.absolute(name + " lowest cell in the fine zone over the asked", s.lowest / zone.finest_cell_size,
                     1., 4e-3);
      check.absolute(name + " highest cell in the fine zone over the asked",
                     s.highest / zone.finest_cell_size, 1., 1e-3);
      double begin = 1e300, end = -1e300;
      for (const Mesh::Face &face : mesh.faces)
        if (face.boundary == Boundary::contact)
          for (const unsigned int i : face.nodes)
            {
              begin = std::min(begin, mesh.nodes[i][0]);
              end   = std::max(end, mesh.nodes[i][0]);
            }
      check.below(name + " in reach of the wheel from, mm beyond the margin",
                  1e3 * std::max(0., begin - (zone.x_begin - rail.contact_margin)), 1e-9);
      check.below(name + " in reach of the wheel to, mm beyond the margin",
                  1e3 * std::max(0., zone.x_end + rail.contact_margin - end), 1e-9);
      check.that(name + " not all of it", begin > -0.25 && end < 0.25);
      // The foot, EN 13674-1: 140 and 150 mm wide; cells fill the roundings of its edges.
      double on_base = 0.;
      for (const Mesh::Face &face : mesh.faces)
        if (face.boundary == Boundary::support)
          {
            const auto &p = mesh.nodes;
            on_base += 0.5 * dealii::cross_product_3d(p[face.nodes[2]] - p[face.nodes[0]],
                                                      p[face.nodes[3]] - p[face.nodes[1]])
                               .norm();
          }
      check.absolute(name + " width of what is supported, mm", 1e3 * on_base / (rail.x_end - rail.x_begin),
                     name == "54E1" ? 140. : 150., 0.01);
      check.below(name + " longest row, mm", 1e3 * s.longest, 40. + 1e-9);
      check.that(name + " has hanging nodes", !mesh.hanging_nodes.empty());
      check.below(name + " hanging nodes off the mean of their parents, nm", 1e9 * off_the_mean(mesh), 1e-6);
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
