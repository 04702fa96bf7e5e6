// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/contact/mortar.h>

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

namespace tread
{
  namespace
  {
    struct Plane2
    {
      double s, t;
    };

    Row cross(const Row a, const Row b)
    {
      return Row{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0.};
    }

    Row normalised(const Row a)
    {
      return a * (1. / std::sqrt(dot(a, a)));
    }

    double cross(const Plane2 a, const Plane2 b, const Plane2 c)
    {
      return (b.s - a.s) * (c.t - a.t) - (b.t - a.t) * (c.s - a.s);
    }

    /// A quadrilateral in the plane of integration, and its bilinear shape functions.
    struct Quadrilateral
    {
      std::array<Plane2, 4> corners;

      static std::array<double, 4> shape(const double xi, const double eta)
      {
        return {0.25 * (1. - xi) * (1. - eta),
                0.25 * (1. + xi) * (1. - eta),
                0.25 * (1. + xi) * (1. + eta),
                0.25 * (1. - xi) * (1. + eta)};
      }

      /// Shape functions at a point of the plane, by Newton's method on the bilinear map.
      std::array<double, 4> shape_at(const Plane2 p) const
      {
        double xi = 0., eta = 0.;
        for (unsigned int iteration = 0; iteration < 8; ++iteration)
          {
            const auto   N = shape(xi, eta);
            const double dxi[4]  = {-0.25 * (1. - eta), 0.25 * (1. - eta), 0.25 * (1. + eta), -0.25 * (1. + eta)};
            const double deta[4] = {-0.25 * (1. - xi), -0.25 * (1. + xi), 0.25 * (1. + xi), 0.25 * (1. - xi)};
            double       rs = -p.s, rt = -p.t, a = 0., b = 0., c = 0., d = 0.;
            for (unsigned int i = 0; i < 4; ++i)
              {
                rs += N[i] * corners[i].s;
                rt += N[i] * corners[i].t;
                a += dxi[i] * corners[i].s;
                b += deta[i] * corners[i].s;
                c += dxi[i] * corners[i].t;
                d += deta[i] * corners[i].t;
              }
            const double det = a * d - b * c;
            const double step_xi = (d * rs - b * rt) / det, step_eta = (a * rt - c * rs) / det;
            xi -= step_xi;
            eta -= step_eta;
            if (std::abs(step_xi) + std::abs(step_eta) < 1e-13)
              break;
          }
        return shape(xi, eta);
      }

      /// Coefficients A of the dual functions psi_j = sum_k A_jk N_k, and the integrals of N_j.
      void dual_functions(std::array<std::array<double, 4>, 4> &A, std::array<double, 4> &integral) const
      {
        const double gauss = std::sqrt(0.6), weight[3] = {5. / 9., 8. / 9., 5. / 9.}, at[3] = {-gauss, 0., gauss};
        double       m[4][8] = {}; // mass matrix, and the identity to invert it
        integral.fill(0.);
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            {
              const auto   N = shape(at[i], at[j]);
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

    /// Convex polygon, cut by the inner side of each edge of another (Sutherland & Hodgman 1974).
    std::vector<Plane2> intersection(const Quadrilateral &subject, const Quadrilateral &clip)
    {
      std::vector<Plane2> polygon(subject.corners.begin(), subject.corners.end()), input;
      for (unsigned int e = 0; e < 4 && !polygon.empty(); ++e)
        {
          const Plane2 a = clip.corners[e], b = clip.corners[(e + 1) % 4];
          input.swap(polygon);
          polygon.clear();
          for (unsigned int i = 0; i < input.size(); ++i)
            {
              const Plane2 p = input[i], q = input[(i + 1) % input.size()];
              const double side_p = cross(a, b, p), side_q = cross(a, b, q);
              if (side_p >= 0.)
                polygon.push_back(p);
              if ((side_p > 0. && side_q < 0.) || (side_p < 0. && side_q > 0.))
                {
                  const double f = side_p / (side_p - side_q);
                  polygon.push_back({p.s + f * (q.s - p.s), p.t + f * (q.t - p.t)});
                }
            }
        }
      return polygon;
    }

    // Symmetric rule of degree 4 with 6 points on a triangle (Dunavant 1985).
    constexpr double triangle_points[6][4] = {
      {0.108103018168070, 0.445948490915965, 0.445948490915965, 0.223381589678011},
      {0.445948490915965, 0.108103018168070, 0.445948490915965, 0.223381589678011},
      {0.445948490915965, 0.445948490915965, 0.108103018168070, 0.223381589678011},
      {0.816847572980459, 0.091576213509771, 0.091576213509771, 0.109951743655322},
      {0.091576213509771, 0.816847572980459, 0.091576213509771, 0.109951743655322},
      {0.091576213509771, 0.091576213509771, 0.816847572980459, 0.109951743655322}};
  } // namespace


  MortarCoupling couple(const ContactSurfaces  &surfaces,
                        const std::vector<Row> &x,
                        const unsigned int      slave_body,
                        const unsigned int      master_body,
                        const double            reach)
  {
    namespace bg  = boost::geometry;
    using BoxPoint = bg::model::point<double, 3, bg::cs::cartesian>;
    using Box      = bg::model::box<BoxPoint>;
    using Entry    = std::pair<Box, unsigned int>;
    const auto box_of = [&](const ContactSurfaces::Face &face, const double margin) {
      Row low = x[face.nodes[0]], high = low;
      for (const unsigned int i : face.nodes)
        for (unsigned int d = 0; d < 3; ++d)
          {
            low[d]  = std::min(low[d], x[i][d]);
            high[d] = std::max(high[d], x[i][d]);
          }
      return Box(BoxPoint(low[0] - margin, low[1] - margin, low[2] - margin),
                 BoxPoint(high[0] + margin, high[1] + margin, high[2] + margin));
    };

    Box slave_extent, master_extent;
    bg::assign_inverse(slave_extent);
    bg::assign_inverse(master_extent);
    for (const ContactSurfaces::Face &face : surfaces.faces)
      if (face.body == slave_body)
        bg::expand(slave_extent, box_of(face, reach));
    std::vector<Entry> boxes;
    for (unsigned int f = 0; f < surfaces.faces.size(); ++f)
      if (surfaces.faces[f].body == master_body)
        if (const Box box = box_of(surfaces.faces[f], 0.); bg::intersects(box, slave_extent))
          {
            boxes.emplace_back(box, f);
            bg::expand(master_extent, box);
          }
    MortarCoupling coupling;
    if (boxes.empty())
      return coupling;
    const bg::index::rtree<Entry, bg::index::quadratic<16>> tree(boxes);

    struct NodeSum
    {
      Row                            normal{};
      double                         area = 0., covered = 0., whole = 0.;
      std::vector<MortarEntry>       entries;
      void add(const unsigned int node, const double value)
      {
        for (MortarEntry &entry : entries)
          if (entry.node == node)
            {
              entry.coefficient += value;
              return;
            }
        entries.push_back({node, value});
      }
    };
    std::map<unsigned int, NodeSum> sums;
    std::vector<Entry>              near;
    for (const ContactSurfaces::Face &face : surfaces.faces)
      {
        if (face.body != slave_body)
          continue;
        const Box box = box_of(face, reach);
        near.clear();
        if (bg::intersects(box, master_extent))
          tree.query(bg::index::intersects(box), std::back_inserter(near));
        if (near.empty())
          continue;
        std::sort(near.begin(), near.end(), [](const Entry &a, const Entry &b) { return a.second < b.second; });

        const Row origin = 0.25 * (x[face.nodes[0]] + x[face.nodes[1]] + x[face.nodes[2]] + x[face.nodes[3]]);
        const Row area_vector =
          0.5 * cross(x[face.nodes[2]] - x[face.nodes[0]], x[face.nodes[3]] - x[face.nodes[1]]);
        const Row normal  = normalised(area_vector);
        const Row along_s = normalised(x[face.nodes[1]] - x[face.nodes[0]] -
                                       dot(x[face.nodes[1]] - x[face.nodes[0]], normal) * normal);
        const Row along_t = cross(normal, along_s);
        const auto project = [&](const unsigned int node) {
          const Row r = x[node] - origin;
          return Plane2{dot(r, along_s), dot(r, along_t)};
        };
        Quadrilateral slave;
        for (unsigned int v = 0; v < 4; ++v)
          slave.corners[v] = project(face.nodes[v]);
        std::array<std::array<double, 4>, 4> dual;
        std::array<double, 4>                integral;
        slave.dual_functions(dual, integral);
        for (unsigned int v = 0; v < 4; ++v)
          {
            NodeSum &sum = sums[face.nodes[v]];
            sum.normal += area_vector;
            sum.whole += integral[v];
          }

        for (const auto &[master_box, f] : near)
          {
            const ContactSurfaces::Face &master_face = surfaces.faces[f];
            Quadrilateral                master; // reversed: counter-clockwise seen from the slave's outside
            double                       distance = 0.;
            for (unsigned int v = 0; v < 4; ++v)
              {
                master.corners[v] = project(master_face.nodes[3 - v]);
                distance += 0.25 * dot(x[master_face.nodes[v]] - origin, normal);
              }
            if (std::abs(distance) > reach || cross(master.corners[0], master.corners[1], master.corners[2]) <= 0.)
              continue;
            const std::vector<Plane2> polygon = intersection(slave, master);
            if (polygon.size() < 3)
              continue;
            double D[4][4] = {}, M[4][4] = {}, area[4] = {}, covered[4] = {};
            for (unsigned int i = 1; i + 1 < polygon.size(); ++i)
              {
                const double triangle_area = 0.5 * cross(polygon[0], polygon[i], polygon[i + 1]);
                if (triangle_area <= 0.)
                  continue;
                for (const auto &q : triangle_points)
                  {
                    const Plane2 p{q[0] * polygon[0].s + q[1] * polygon[i].s + q[2] * polygon[i + 1].s,
                                   q[0] * polygon[0].t + q[1] * polygon[i].t + q[2] * polygon[i + 1].t};
                    const double w = q[3] * triangle_area;
                    const auto   N = slave.shape_at(p), N_master = master.shape_at(p);
                    for (unsigned int j = 0; j < 4; ++j)
                      {
                        double psi = 0.;
                        for (unsigned int k = 0; k < 4; ++k)
                          psi += dual[j][k] * N[k];
                        area[j] += w * psi;
                        covered[j] += w * N[j];
                        for (unsigned int k = 0; k < 4; ++k)
                          {
                            D[j][k] += w * psi * N[k];
                            M[j][k] += w * psi * N_master[k];
                          }
                      }
                  }
              }
            for (unsigned int j = 0; j < 4; ++j)
              {
                NodeSum &sum = sums[face.nodes[j]];
                sum.area += area[j];
                sum.covered += covered[j];
                for (unsigned int k = 0; k < 4; ++k)
                  {
                    sum.add(face.nodes[k], -D[j][k]);
                    sum.add(master_face.nodes[3 - k], M[j][k]);
                  }
              }
          }
      }

    for (auto &[node, sum] : sums)
      {
        if (sum.covered < 0.5 * sum.whole || sum.area < 0.25 * sum.whole)
          continue;
        MortarRow row;
        row.slave  = node;
        row.normal = normalised(sum.normal);
        row.area   = sum.area;
        row.begin  = coupling.entries.size();
        for (const MortarEntry &entry : sum.entries)
          if (std::abs(entry.coefficient) > 1e-10 * sum.area)
            coupling.entries.push_back({entry.node, entry.coefficient / sum.area});
        row.end = coupling.entries.size();
        // What was dropped and round-off go to the slave node: forces balance to the last bit or two.
        double excess = 0.;
        for (std::size_t i = row.begin; i < row.end; ++i)
          excess += coupling.entries[i].coefficient;
        for (std::size_t i = row.begin; i < row.end; ++i)
          if (coupling.entries[i].node == node)
            coupling.entries[i].coefficient -= excess;
        coupling.rows.push_back(row);
      }
    return coupling;
  }
} // namespace tread
