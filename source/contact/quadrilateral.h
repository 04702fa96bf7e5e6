// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_quadrilateral_h
#define tread_contact_quadrilateral_h

#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

// Faces as mortar.cc sees them, projected into one plane: shape functions, dual functions, the part that two
// of them share, and the points at which that is integrated.
namespace tread
{
  struct Plane2
  {
    double s, t;
  };

  /// A value at each point of a quadrature rule.
  typedef double AtPoints __attribute__((vector_size(64)));

  inline double total(const AtPoints value)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < 8; ++i)
      sum += value[i];
    return sum;
  }

  inline double cross(const Plane2 a, const Plane2 b, const Plane2 c)
  {
    return (b.s - a.s) * (c.t - a.t) - (b.t - a.t) * (c.s - a.s);
  }

  /// A quadrilateral in the plane of integration, and its bilinear shape functions.
  struct Quadrilateral
  {
    std::array<Plane2, 4> corners;
    std::array<double, 4> inverse;

    template <typename T>
    static std::array<T, 4> shape(const T xi, const T eta)
    {
      return {0.25 * (1. - xi) * (1. - eta), 0.25 * (1. + xi) * (1. - eta), 0.25 * (1. + xi) * (1. + eta),
              0.25 * (1. - xi) * (1. + eta)};
    }

    /// Inverse of the bilinear map's derivative at the centre; call after the corners are set.
    void prepare()
    {
      const auto  &c   = corners;
      const double a   = 0.25 * (-c[0].s + c[1].s + c[2].s - c[3].s),
                   b   = 0.25 * (-c[0].s - c[1].s + c[2].s + c[3].s);
      const double d   = 0.25 * (-c[0].t + c[1].t + c[2].t - c[3].t),
                   e   = 0.25 * (-c[0].t - c[1].t + c[2].t + c[3].t);
      const double det = a * e - b * d;
      inverse          = {e / det, -b / det, -d / det, a / det};
    }

    /// Shape functions at points of the plane, by Newton's method with the derivative at the centre:
    /// faces are nearly parallelograms, for which one step is exact.
    std::array<AtPoints, 4> shape_at(const AtPoints s, const AtPoints t) const
    {
      AtPoints                xi{}, eta{};
      std::array<AtPoints, 4> N = shape(xi, eta);
      for (unsigned int iteration = 0; iteration < 60; ++iteration)
        {
          AtPoints rs = -s, rt = -t;
          for (unsigned int i = 0; i < 4; ++i)
            {
              rs += N[i] * corners[i].s;
              rt += N[i] * corners[i].t;
            }
          const AtPoints step_xi  = inverse[0] * rs + inverse[1] * rt,
                         step_eta = inverse[2] * rs + inverse[3] * rt;
          xi -= step_xi;
          eta -= step_eta;
          N                     = shape(xi, eta);
          const AtPoints step2  = step_xi * step_xi + step_eta * step_eta;
          double         moving = 0.;
          for (unsigned int i = 0; i < 8; ++i)
            moving = std::max(moving, step2[i]);
          if (moving < 1e-18) // the next step would be smaller than 1e-10
            break;
        }
      return N;
    }

    /// Coefficients A of the dual functions psi_j = sum_k A_jk N_k, and the integrals of N_j.
    void dual_functions(std::array<std::array<double, 4>, 4> &A, std::array<double, 4> &integral) const
    {
      const double gauss = std::sqrt(0.6), weight[3] = {5. / 9., 8. / 9., 5. / 9.},
                   at[3] = {-gauss, 0., gauss};
      double m[4][8]     = {}; // mass matrix, and the identity to invert it
      integral.fill(0.);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            const auto   N       = shape(at[i], at[j]);
            const double dxi[4]  = {-(1. - at[j]), 1. - at[j], 1. + at[j], -(1. + at[j])};
            const double deta[4] = {-(1. - at[i]), -(1. + at[i]), 1. + at[i], 1. - at[i]};
            double       a = 0., b = 0., c = 0., d = 0.;
            for (unsigned int k = 0; k < 4; ++k)
              {
                a += dxi[k] * corners[k].s / 4.;
                b += deta[k] * corners[k].s / 4.;
                c += dxi[k] * corners[k].t / 4.;
                d += deta[k] * corners[k].t / 4.;
              }
            const double w = weight[i] * weight[j] * (a * d - b * c);
            for (unsigned int k = 0; k < 4; ++k)
              {
                integral[k] += w * N[k];
                for (unsigned int l = 0; l < 4; ++l)
                  m[k][l] += w * N[k] * N[l];
              }
          }
      for (unsigned int k = 0; k < 4; ++k)
        m[k][4 + k] = 1.;
      for (unsigned int k = 0; k < 4; ++k) // symmetric positive definite: no pivoting needed
        {
          const double pivot = 1. / m[k][k];
          for (double &entry : m[k])
            entry *= pivot;
          for (unsigned int i = 0; i < 4; ++i)
            if (i != k)
              for (unsigned int j = 8; j-- > k;)
                m[i][j] -= m[i][k] * m[k][j];
        }
      for (unsigned int j = 0; j < 4; ++j)
        for (unsigned int k = 0; k < 4; ++k)
          A[j][k] = integral[j] * m[j][4 + k];
    }
  };

  /// The intersection of two convex quadrilaterals has at most eight corners: each edge of one adds at most
  /// one to the remainder of the other. Each edge may double those of one that is folded.
  constexpr unsigned int most_corners = 8;
  using Polygon                       = boost::container::static_vector<Plane2, 2 * most_corners>;

  /// The subject cut by the inner side of each edge of the other (Sutherland & Hodgman 1974).
  /// @throws std::runtime_error, one line, where a face is folded.
  inline Polygon intersection(const Quadrilateral &subject, const Quadrilateral &clip)
  {
    Polygon polygon(subject.corners.begin(), subject.corners.end()), input;
    for (unsigned int e = 0; e < 4 && !polygon.empty(); ++e)
      {
        const Plane2 a = clip.corners[e], b = clip.corners[(e + 1) % 4];
        input = polygon;
        polygon.clear();
        for (unsigned int i = 0; i < input.size(); ++i)
          {
            const Plane2 p = input[i], q = input[i + 1 < input.size() ? i + 1 : 0];
            const double side_p = cross(a, b, p), side_q = cross(a, b, q);
            if (side_p >= 0.)
              polygon.push_back(p);
            if ((side_p > 0. && side_q < 0.) || (side_p < 0. && side_q > 0.))
              {
                const double f = side_p / (side_p - side_q);
                polygon.push_back({p.s + f * (q.s - p.s), p.t + f * (q.t - p.t)});
              }
          }
        if (polygon.size() > most_corners)
          throw std::runtime_error(
            "a face of the contact surfaces has folded: the cells below it are crushed; what "
            "yields cannot carry the load, or its cells are too flat");
      }
    return polygon;
  }

  // Symmetric rule of degree 4 with 6 points on a triangle (Dunavant 1985): barycentric coordinates,
  // weights; the last two of eight repeat the sixth with no weight.
  constexpr double near_1 = 0.108103018168070, far_1 = 0.445948490915965, near_2 = 0.816847572980459,
                   far_2 = 0.091576213509771, weight_1 = 0.223381589678011, weight_2 = 0.109951743655322;
  constexpr AtPoints triangle_points[3] = {{near_1, far_1, far_1, near_2, far_2, far_2, far_2, far_2},
                                           {far_1, near_1, far_1, far_2, near_2, far_2, far_2, far_2},
                                           {far_1, far_1, near_1, far_2, far_2, near_2, near_2, near_2}},
                     triangle_weights   = {weight_1, weight_1, weight_1, weight_2, weight_2, weight_2};

  // Symmetric rule of degree 5 with 8 points on the square from -1 to 1 (Burnside 1908), weights over its
  // area.
  constexpr double   on_axis = 0.68313005106397323, off_axis = 0.88191710368819686; // sqrt(7/15), sqrt(7/9)
  constexpr AtPoints square_points[2] = {{on_axis, -on_axis, 0., 0., off_axis, -off_axis, -off_axis,
                                          off_axis},
                                         {0., 0., on_axis, -on_axis, off_axis, off_axis, -off_axis,
                                          -off_axis}},
                     square_weights   = {10. / 49., 10. / 49., 10. / 49., 10. / 49.,
                                         9. / 196., 9. / 196., 9. / 196., 9. / 196.};

  /// Call add(s, t, weight) with points and weights that integrate over a polygon. They do not depend on the
  /// corner at which it begins, so that the mirror image of a contact has the mirror image of its forces.
  template <typename Add>
  void with_points_of(const Polygon &polygon, const Add &add)
  {
    const auto with_triangle = [&](const Plane2 a, const Plane2 b, const Plane2 c) {
      const double area = 0.5 * cross(a, b, c);
      const auto  &q    = triangle_points;
      if (area > 0.)
        add(q[0] * a.s + q[1] * b.s + q[2] * c.s, q[0] * a.t + q[1] * b.t + q[2] * c.t,
            area * triangle_weights);
    };
    const unsigned int n = polygon.size();
    if (n == 3)
      {
        with_triangle(polygon[0], polygon[1], polygon[2]);
        return;
      }
    Plane2 middle{0., 0.};
    for (const Plane2 &corner : polygon)
      middle = {middle.s + corner.s / n, middle.t + corner.t / n};
    if (n == 4)
      {
        const Plane2 a = polygon[0], b = polygon[1], c = polygon[2], d = polygon[3];
        // Halves of its middle lines, and how much its sides are out of parallel: the rule is exact for
        // parallelograms.
        const Plane2 u{0.25 * (b.s + c.s - a.s - d.s), 0.25 * (b.t + c.t - a.t - d.t)},
          v{0.25 * (c.s + d.s - a.s - b.s), 0.25 * (c.t + d.t - a.t - b.t)},
          w{0.25 * (a.s - b.s + c.s - d.s), 0.25 * (a.t - b.t + c.t - d.t)};
        const double area = 4. * (u.s * v.t - u.t * v.s), by_u = 4. * (u.s * w.t - u.t * w.s),
                     by_v       = 4. * (w.s * v.t - w.t * v.s);
        constexpr double nearly = 0.01;
        if (std::abs(by_u) + std::abs(by_v) < nearly * area)
          {
            const AtPoints x = square_points[0], y = square_points[1];
            add(middle.s + u.s * x + v.s * y + w.s * x * y, middle.t + u.t * x + v.t * y + w.t * x * y,
                square_weights * (area + by_u * x + by_v * y));
            return;
          }
      }
    for (unsigned int i = 0; i < n; ++i)
      with_triangle(middle, polygon[i], polygon[i + 1 < n ? i + 1 : 0]);
  }
} // namespace tread

#endif
