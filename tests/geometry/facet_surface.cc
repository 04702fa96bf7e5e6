// SPDX-License-Identifier: LGPL-2.1-or-later
// A smooth surface through the vertices of quadrilaterals: crowns, polynomials, pieces, and what is no graph.
#include <tread/base/input_error.h>
#include <tread/geometry/facet_surface.h>

#include "check.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

using namespace tread;
using dealii::Point;
using Height = std::function<double(double, double)>;

namespace geometry_facet_surface
{
  constexpr double crown = 0.3; // m

  double on_crown(const double, const double y)
  {
    return std::sqrt(crown * crown - y * y) - crown;
  }

  struct Faces
  {
    std::vector<Point<3>>                    vertices;
    std::vector<FacetSurface::Quadrilateral> faces;

    /// n_x by n_y faces of this edge from x = begin on, symmetric to y = 0; inner vertices are moved in plan
    /// by up to this share of it.
    void add(const double       begin,
             const unsigned int n_x,
             const unsigned int n_y,
             const double       edge,
             const Height      &height,
             const double       share = 0.)
    {
      std::mt19937                           random(1);
      std::uniform_real_distribution<double> uniform(-share * edge, share * edge);
      const unsigned int                     first = vertices.size();
      for (unsigned int j = 0; j <= n_y; ++j)
        for (unsigned int i = 0; i <= n_x; ++i)
          {
            const bool   inner = i > 0 && i < n_x && j > 0 && j < n_y;
            const double x     = begin + i * edge + (inner ? uniform(random) : 0.),
                         y     = (j - 0.5 * n_y) * edge + (inner ? uniform(random) : 0.);
            vertices.emplace_back(x, y, height(x, y));
          }
      const auto number = [&](const unsigned int i, const unsigned int j) {
        return first + i + (n_x + 1) * j;
      };
      for (unsigned int j = 0; j < n_y; ++j)
        for (unsigned int i = 0; i < n_x; ++i)
          faces.push_back({{number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)}});
    }
    FacetSurface surface() const
    {
      return FacetSurface(vertices, faces);
    }
  };

  /// Largest deviation from a height, m, and of the second difference over y over this distance, 1/m, within
  /// 10 mm of the middle.
  std::pair<double, double> errors(const FacetSurface &surface, const Height &height)
  {
    constexpr double step = 3e-3, reach = 10e-3;
    double           of_height = 0., of_curvature = 0.;
    for (double x = -19.7e-3; x < 20e-3; x += 1.3e-3)
      for (double y = -reach; y < reach; y += 0.7e-3)
        {
          const auto off = [&](const double at) {
            return *surface.height(x, at) - height(x, at);
          };
          of_height = std::max(of_height, std::abs(off(y)));
          of_curvature =
            std::max(of_curvature, std::abs(off(y + step) - 2. * off(y) + off(y - step)) / (step * step));
        }
    return {of_height, of_curvature};
  }

  void check_crowns(tests::Check &check)
  {
    // Regression: two thirds of these errors are found; with cubics they are a hundred times as large.
    for (const auto &[edge_in_mm, share, height_in_nm, curvature_in_percent] :
         {std::tuple(5., 0., 0.006, 6e-5), std::tuple(10., 0., 0.2, 1.1e-3), std::tuple(20., 0., 9., 0.0105),
          std::tuple(5., 0.2, 0.009, 9e-5), std::tuple(10., 0.2, 0.27, 1.2e-3),
          std::tuple(20., 0.2, 12.5, 0.013)})
      {
        const double       edge = 1e-3 * edge_in_mm;
        const unsigned int n    = std::lround(0.2 / edge);
        Faces              faces;
        faces.add(-0.1, n, n, edge, on_crown, share);
        const auto [height, curvature] = errors(faces.surface(), on_crown);
        const std::string name = "crown of 300 mm, faces of " + std::to_string(int(edge_in_mm)) + " mm" +
                                 (share > 0. ? ", moved" : "") + ": ";
        check.below(name + "height, nm", 1e9 * height, height_in_nm);
        check.below(name + "curvature, %", 100. * curvature * crown, curvature_in_percent);
      }
  }

  void check_polynomial(tests::Check &check)
  {
    // Of the fourth degree it is what it is, on faces that lie in any way, up to the edges.
    const Height height = [](const double x, const double y) {
      return 0.2 * x - 0.1 * y + 3. * x * y - 4. * y * y + 50. * x * x * y + 900. * y * y * y * y -
             300. * x * x * y * y;
    };
    Faces faces;
    faces.add(-0.05, 10, 8, 0.01, height, 0.25);
    const FacetSurface surface = faces.surface();
    double             off     = 0.;
    for (double x = -0.05; x <= 0.05; x += 1.1e-3)
      for (double y = -0.04; y <= 0.04; y += 1.1e-3)
        off = std::max(off, std::abs(surface.height(x, y).value_or(1.) - height(x, y)));
    check.below("polynomial of the fourth degree, nm", 1e9 * off, 1e-3);
    double at_vertices = 0.;
    for (const Point<3> &p : faces.vertices)
      at_vertices = std::max(at_vertices, std::abs(surface.facet(p[0], p[1]).smooth_above) +
                                            std::abs(surface.facet(p[0], p[1]).z - p[2]));
    check.below("the surface passes through its vertices, nm", 1e9 * at_vertices, 1e-3);
    // Few faces tell less.
    Faces one;
    one.add(0., 1, 1, 0.01, height);
    check.absolute("one face is a plane or near it: height in its middle, um",
                   1e6 * *one.surface().height(5e-3, 0.), 1e6 * height(5e-3, 0.), 4e3);
    check.that("nothing beside the faces", !surface.height(0.0501, 0.) && !surface.height(0., -0.0401));
    check.absolute("the nearest place of the faces: z, um", 1e6 * surface.facet(0.06, 0.).z,
                   1e6 * height(0.05, 0.), 1e-3);
    const auto across = surface.across(1e-3, 2e-3);
    check.absolute("extent across, mm", 1e3 * (across.end - across.begin), 80., 1e-3);
    check.below("extent where there is none, mm",
                1e3 * (surface.across(0.2, 0.).end - surface.across(0.2, 0.).begin), 0.);
  }

  /// Slopes and curvatures do not jump from one face to the next.
  void check_smoothness(tests::Check &check)
  {
    const Height height = [](const double x, const double y) {
      return 1e-3 * std::sin(60. * x) * std::cos(50. * y);
    };
    constexpr double step = 1e-5;
    for (const double share : {0., 0.2})
      {
        Faces faces;
        faces.add(-0.05, 10, 10, 0.01, height, share);
        const FacetSurface surface = faces.surface();
        double             kink    = 0.;
        for (double x = -0.03; x < 0.03; x += step)
          {
            const double y  = 0.3 * x; // through many edges
            const auto   at = [&](const double way) {
              return *surface.height(x + way, y + 0.3 * way);
            };
            kink = std::max(kink, std::abs(at(step) - 2. * at(0.) + at(-step)) / step);
          }
        // A smooth line turns by its curvature, 3.6 per m, over a step; facets by 0.04.
        check.below(std::string("turn over 10 um") + (share > 0. ? ", faces moved" : "") + ", mrad",
                    1e3 * kink, share > 0. ? 0.3 : 0.06);
      }
  }

  void check_pieces(tests::Check &check)
  {
    // Two rails with a gap of 6 mm, the second 0.5 mm higher.
    constexpr double gap = 6e-3, up = 0.5e-3;
    Faces            faces;
    faces.add(-0.1 - 0.5 * gap, 10, 8, 0.01, on_crown);
    faces.add(0.5 * gap, 10, 8, 0.01, [](const double x, const double y) { return on_crown(x, y) + up; });
    const FacetSurface surface = faces.surface();
    check.absolute("pieces", surface.n_pieces(), 2., 0.);
    check.that("no surface in the gap", !surface.height(0., 0.) && !surface.height(-2.9e-3, 1e-3));
    double off = 0.;
    for (double x = 3e-3; x < 0.05; x += 0.9e-3)
      off = std::max({off, std::abs(surface.height(x, 1.3e-3).value_or(1.) - on_crown(x, 1.3e-3) - up),
                      std::abs(surface.height(-x, 1.3e-3).value_or(1.) - on_crown(x, 1.3e-3))});
    check.below("each piece has its own heights up to its end, nm", 1e9 * off, 1.);
    check.absolute("beside the gap the nearer piece counts: z of the higher one, um",
                   1e6 * surface.facet(0.1e-3, 0.).z, 1e6 * up, 1e-3);
    check.absolute("and of the lower one, um", 1e6 * surface.facet(-0.1e-3, 0.).z, 0., 1e-3);
  }

  void check_refused(tests::Check &check)
  {
    const auto refusal = [](const Faces &faces) {
      return tests::complaint<InputError>([&] { faces.surface(); });
    };
    Faces steep, less_steep, above, down;
    steep.add(0., 4, 4, 0.01, [](const double x, const double) { return 3. * x; });
    check.that("a surface of 72 degrees is refused: \"" + refusal(steep) + "\"",
               refusal(steep).find("steeper than 70 degrees at 0, -20, 0 mm") != std::string::npos);
    less_steep.add(0., 4, 4, 0.01, [](const double x, const double) { return 2.6 * x; });
    check.that("one of 69 degrees is not", refusal(less_steep).empty());
    above.add(0., 4, 4, 0.01, [](const double, const double) { return 0.; });
    above.add(5e-3, 1, 1, 0.01, [](const double, const double) { return 0.02; });
    check.that("one face above another is refused: \"" + refusal(above) + "\"",
               refusal(above).find("one face above another") != std::string::npos);
    down.add(0., 2, 2, 0.01, on_crown);
    for (auto &face : down.faces)
      std::reverse(face.begin(), face.end());
    check.that("a surface that looks down is refused", refusal(down).find("looks down") != std::string::npos);
    check.that("no faces are refused", !refusal(Faces()).empty());
  }
} // namespace geometry_facet_surface

TREAD_TEST(geometry_facet_surface)(tests::Check &check, const tests::Arguments &)
{
  check_crowns(check);
  check_polynomial(check);
  check_smoothness(check);
  check_pieces(check);
  check_refused(check);
}
