// SPDX-License-Identifier: LGPL-2.1-or-later
// Integrals over the common parts of two faces: exact up to the products of shape functions, whichever corner
// a polygon begins at, and for its mirror image. Shape functions at points of faces that are no
// parallelograms.
#include "check.h"
#include "contact/quadrilateral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>

using namespace tread;
using tests::Check;

namespace contact_quadrature
{
  constexpr unsigned int highest = 4; // degree of a product of two bilinear functions

  /// Integral of s^p t^q by the points of the polygon.
  double by_points(const Polygon &polygon, const unsigned int p, const unsigned int q)
  {
    double sum = 0.;
    with_points_of(polygon, [&](const AtPoints s, const AtPoints t, const AtPoints weight) {
      for (unsigned int i = 0; i < 8; ++i)
        sum += weight[i] * std::pow(s[i], p) * std::pow(t[i], q);
    });
    return sum;
  }

  /// The same from the border: the integral of s^(p+1) t^q dt / (p + 1), by Gauss' three points on each edge,
  /// which are exact up to degree 5.
  double by_border(const Polygon &polygon, const unsigned int p, const unsigned int q)
  {
    const double at[3]     = {0.5 - 0.5 * std::sqrt(0.6), 0.5, 0.5 + 0.5 * std::sqrt(0.6)},
                 weight[3] = {5. / 18., 8. / 18., 5. / 18.};
    double sum             = 0.;
    for (unsigned int i = 0; i < polygon.size(); ++i)
      {
        const Plane2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        for (unsigned int k = 0; k < 3; ++k)
          {
            const double s = a.s + at[k] * (b.s - a.s), t = a.t + at[k] * (b.t - a.t);
            sum += weight[k] * std::pow(s, p + 1) * std::pow(t, q) * (b.t - a.t) / (p + 1);
          }
      }
    return sum;
  }

  Polygon mirrored(const Polygon &polygon)
  {
    Polygon image(polygon.rbegin(), polygon.rend());
    for (Plane2 &corner : image)
      corner.s = -corner.s;
    return image;
  }

  void check_polygon(Check &check, const std::string &name, const Polygon &polygon, const double allowed)
  {
    double worst = 0., turned = 0., reflected = 0.;
    for (unsigned int p = 0; p <= highest; ++p)
      for (unsigned int q = 0; p + q <= highest; ++q)
        {
          const double value = by_points(polygon, p, q);
          worst              = std::max(worst, std::abs(value - by_border(polygon, p, q)));
          for (unsigned int first = 1; first < polygon.size(); ++first)
            {
              Polygon other = polygon;
              std::rotate(other.begin(), other.begin() + first, other.end());
              turned = std::max(turned, std::abs(by_points(other, p, q) - value));
            }
          reflected =
            std::max(reflected, std::abs(by_points(mirrored(polygon), p, q) - (p % 2 == 0 ? value : -value)));
        }
    check.below(name + ": monomials up to degree 4", worst, allowed);
    check.below(name + ": whichever corner is the first", turned, 2e-15);
    check.below(name + ": its mirror image", reflected, 2e-15);
  }

  /// A place of a face is the mean of its corners with the shape functions there as weights.
  void check_shape_functions(Check &check, const std::string &name, const std::array<Plane2, 4> &corners)
  {
    Quadrilateral face;
    face.corners = corners;
    face.prepare();
    const double xi[8]  = {-1., -0.7, -0.1, 0.3, 0.9, 1., 0., -0.95},
                 eta[8] = {-1., 0.8, -0.2, 0.5, 0.95, 1., 0., -0.9};
    AtPoints              s{}, t{};
    double                worst = 0.;
    std::array<double, 4> expected[8];
    for (unsigned int i = 0; i < 8; ++i)
      {
        expected[i] = Quadrilateral::shape(xi[i], eta[i]);
        for (unsigned int k = 0; k < 4; ++k)
          {
            s[i] += expected[i][k] * corners[k].s;
            t[i] += expected[i][k] * corners[k].t;
          }
      }
    const std::array<AtPoints, 4> found = face.shape_at(s, t);
    for (unsigned int i = 0; i < 8; ++i)
      for (unsigned int k = 0; k < 4; ++k)
        worst = std::max(worst, std::abs(found[k][i] - expected[i][k]));
    check.below(name + ": shape functions at its places", worst, 1e-9);
  }
} // namespace contact_quadrature


TREAD_TEST(contact_quadrature)(Check &check, const tests::Arguments &)
{
  check_shape_functions(check, "parallelogram", {{{0., 0.}, {1., 0.2}, {1.3, 1.}, {0.3, 0.8}}});
  check_shape_functions(check, "trapezoid", {{{0., 0.}, {1., 0.}, {0.8, 1.}, {0.1, 1.}}});
  check_shape_functions(check, "face with no parallel sides", {{{0., 0.}, {1., 0.2}, {0.8, 1.}, {0.1, 0.6}}});
  const double exact = 1e-14; // fifteen digits of the points on triangles
  check_polygon(check, "triangle", {{0.1, 0.2}, {1.1, 0.3}, {0.4, 1.}}, exact);
  check_polygon(check, "rectangle", {{-0.3, 0.1}, {0.9, 0.1}, {0.9, 0.8}, {-0.3, 0.8}}, exact);
  check_polygon(check, "parallelogram", {{0., 0.}, {1., 0.2}, {1.3, 1.}, {0.3, 0.8}}, exact);
  check_polygon(check, "any quadrilateral", {{0., 0.}, {1., 0.2}, {0.8, 1.}, {0.1, 0.6}}, exact);
  check_polygon(check, "pentagon", {{0., 0.}, {1., 0.}, {1.1, 0.6}, {0.5, 1.}, {-0.1, 0.4}}, exact);
  // Sides that are slightly out of parallel: taken as a parallelogram with a varying area, with an error of
  // second order.
  for (const double out : {0.008, 0.004, 0.002})
    check_polygon(check, "out of parallel by " + std::to_string(out),
                  {{0., 0.}, {1., 0.}, {1. + out, 1.}, {0., 1.}}, 4e-3 * out * out);
}
