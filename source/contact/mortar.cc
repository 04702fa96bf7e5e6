// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/gathered.h>
#include <tread/contact/mortar.h>

#include <deal.II/base/mpi.h>

#include <boost/container/small_vector.hpp>
#include <boost/container/static_vector.hpp>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace tread
{
  namespace
  {
    struct Plane2
    {
      double s, t;
    };

    /// A value at each point of a triangle's quadrature rule; six of eight count,
    /// the last two repeat the sixth with no weight.
    typedef double AtPoints __attribute__((vector_size(64)));

    double total(const AtPoints value)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < 8; ++i)
        sum += value[i];
      return sum;
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

    /// The intersection of two convex quadrilaterals: each edge of one adds at most one corner to the
    /// remainder of the other.
    using Polygon = boost::container::static_vector<Plane2, 8>;

    /// The subject cut by the inner side of each edge of the other (Sutherland & Hodgman 1974).
    Polygon intersection(const Quadrilateral &subject, const Quadrilateral &clip)
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
        }
      return polygon;
    }

    // Symmetric rule of degree 4 with 6 points on a triangle (Dunavant 1985): barycentric coordinates,
    // weights.
    constexpr double near_1 = 0.108103018168070, far_1 = 0.445948490915965, near_2 = 0.816847572980459,
                     far_2 = 0.091576213509771, weight_1 = 0.223381589678011, weight_2 = 0.109951743655322;
    constexpr AtPoints triangle_points[3] = {{near_1, far_1, far_1, near_2, far_2, far_2, far_2, far_2},
                                             {far_1, near_1, far_1, far_2, near_2, far_2, far_2, far_2},
                                             {far_1, far_1, near_1, far_2, far_2, near_2, near_2, near_2}},
                       triangle_weights   = {weight_1, weight_1, weight_1, weight_2, weight_2, weight_2};
  } // namespace


  MortarCoupling couple(const ContactSurfaces  &surfaces,
                        const std::vector<Row> &x,
                        const std::vector<Row> &v,
                        const unsigned int      slave_body,
                        const unsigned int      master_body,
                        const double            search_reach,
                        const double            reach)
  {
    namespace bg   = boost::geometry;
    using BoxPoint = bg::model::point<double, 3, bg::cs::cartesian>;
    using Box      = bg::model::box<BoxPoint>;
    using Entry    = std::pair<Box, unsigned int>;
    /// Bounding box of a face that moves back and forth by a given distance.
    const auto box_of = [&](const ContactSurfaces::Face &face, const Row way) {
      Row low = x[face.nodes[0]], high = low;
      for (const unsigned int i : face.nodes)
        for (unsigned int d = 0; d < 3; ++d)
          {
            low[d]  = std::min(low[d], x[i][d]);
            high[d] = std::max(high[d], x[i][d]);
          }
      const Row margin{std::abs(way[0]), std::abs(way[1]), std::abs(way[2]), 0.};
      low -= margin;
      high += margin;
      return Box(BoxPoint(low[0], low[1], low[2]), BoxPoint(high[0], high[1], high[2]));
    };

    Box slave_extent, master_extent;
    bg::assign_inverse(slave_extent);
    bg::assign_inverse(master_extent);
    unsigned int n_slave_faces = 0;
    for (const ContactSurfaces::Face &face : surfaces.faces)
      if (face.body == slave_body)
        {
          bg::expand(slave_extent, box_of(face, search_reach * Row{1., 1., 1., 0.}));
          ++n_slave_faces;
        }
    std::vector<Entry> boxes;
    for (unsigned int f = 0; f < surfaces.faces.size(); ++f)
      if (surfaces.faces[f].body == master_body)
        if (const Box box = box_of(surfaces.faces[f], Row{}); bg::intersects(box, slave_extent))
          {
            boxes.emplace_back(box, f);
            bg::expand(master_extent, box);
          }
    MortarCoupling coupling;
    coupling.time_to_touch = 1e9;
    if (boxes.empty())
      return coupling;
    const bg::index::rtree<Entry, bg::index::quadratic<16>> tree(boxes);

    // First pass: the slave faces that have a master face opposite, and how near it is. The ranks take some
    // that lie together in turn.
    struct SlaveFace
    {
      const ContactSurfaces::Face *face;
      Row                          origin, normal, along_s, along_t, area_vector;
      std::vector<unsigned int>    opposite; ///< master faces
      bool                         is_near;

      Plane2 project(const Row x) const
      {
        return {dot(x - origin, along_s), dot(x - origin, along_t)};
      }
    };
    std::vector<SlaveFace>   slave_faces;
    std::vector<signed char> near_node(surfaces.nodes.size(), false);
    std::vector<Entry>       found;
    const unsigned int       n_ranks  = dealii::Utilities::MPI::n_mpi_processes(surfaces.comm),
                       this_rank      = dealii::Utilities::MPI::this_mpi_process(surfaces.comm);
    constexpr unsigned int turns      = 32;
    const unsigned int     n_together = 1 + n_slave_faces / (turns * n_ranks);
    unsigned int           turn       = 0;
    for (const ContactSurfaces::Face &face : surfaces.faces)
      {
        if (face.body != slave_body || (turn++ / n_together) % n_ranks != this_rank ||
            !bg::intersects(box_of(face, search_reach * Row{1., 1., 1., 0.}), master_extent))
          continue;
        const auto &n = face.nodes;
        SlaveFace   slave;
        slave.face        = &face;
        slave.area_vector = 0.5 * cross(x[n[2]] - x[n[0]], x[n[3]] - x[n[1]]);
        slave.normal      = normalised(slave.area_vector);
        found.clear();
        tree.query(bg::index::intersects(box_of(face, search_reach * slave.normal)),
                   std::back_inserter(found));
        if (found.empty())
          continue;

        slave.origin             = 0.25 * (x[n[0]] + x[n[1]] + x[n[2]] + x[n[3]]);
        const Row edge           = x[n[1]] - x[n[0]];
        slave.along_s            = normalised(edge - dot(edge, slave.normal) * slave.normal);
        slave.along_t            = cross(slave.normal, slave.along_s);
        slave.is_near            = false;
        const Row slave_velocity = 0.25 * (v[n[0]] + v[n[1]] + v[n[2]] + v[n[3]]);
        for (const auto &[master_box, f] : found)
          {
            const auto &m       = surfaces.faces[f].nodes;
            double      nearest = std::numeric_limits<double>::max(), closing = 0.;
            for (const unsigned int node : m)
              {
                nearest = std::min(nearest, std::abs(dot(x[node] - slave.origin, slave.normal)));
                closing = std::max(closing, -dot(v[node] - slave_velocity, slave.normal));
              }
            if (nearest > search_reach ||
                dot(cross(x[m[2]] - x[m[0]], x[m[3]] - x[m[1]]), slave.normal) >= 0.)
              continue; // too far, or not facing each other
            if (nearest > 0.5 * reach)
              coupling.time_to_touch = std::min(coupling.time_to_touch, nearest / std::max(closing, 1e-30));
            slave.is_near = slave.is_near || nearest <= reach;
            slave.opposite.push_back(f);
          }
        if (slave.opposite.empty())
          continue;
        std::sort(slave.opposite.begin(), slave.opposite.end());
        if (slave.is_near)
          for (const unsigned int i : n)
            near_node[i] = true;
        slave_faces.push_back(std::move(slave));
      }

    if (n_ranks > 1)
      {
        MPI_Allreduce(MPI_IN_PLACE, near_node.data(), near_node.size(), MPI_SIGNED_CHAR, MPI_MAX,
                      surfaces.comm);
        MPI_Allreduce(MPI_IN_PLACE, &coupling.time_to_touch, 1, MPI_DOUBLE, MPI_MIN, surfaces.comm);
      }

    // A hanging node gives its row to its parents. What they need are all the faces around them and around
    // the nodes that hang on them.
    for (const auto &h : surfaces.hanging_nodes)
      if (near_node[h.node])
        for (const unsigned int parent : h.parents)
          near_node[parent] = true;
    std::vector<signed char> integrated = near_node;
    for (const auto &h : surfaces.hanging_nodes)
      for (const unsigned int parent : h.parents)
        integrated[h.node] |= near_node[parent];

    // Second pass: integrate all faces around the nodes that are near.
    struct NodeSum
    {
      unsigned int                                    node = 0;
      Row                                             normal{};
      double                                          area = 0., covered = 0., whole = 0.;
      boost::container::small_vector<MortarEntry, 32> entries;

      void add(const NodeSum &other, const double share)
      {
        area += share * other.area;
        covered += share * other.covered;
        whole += share * other.whole;
        for (const MortarEntry &entry : other.entries)
          add(entry.node, share * entry.coefficient);
      }

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
    /// What one pair of faces shares: the master's corners in the slave's plane, and the common polygon.
    struct Piece
    {
      const ContactSurfaces::Face *master;
      Quadrilateral                corners;
      Polygon                      polygon;
    };
    std::vector<NodeSum> sums;
    std::vector<int>     number_of_sum(surfaces.nodes.size(), -1);
    const auto           sum_number = [&](const unsigned int node) {
      if (number_of_sum[node] < 0)
        {
          number_of_sum[node] = sums.size();
          sums.emplace_back();
          sums.back().node = node;
        }
      return number_of_sum[node];
    };
    std::vector<Piece> pieces;
    for (const SlaveFace &slave : slave_faces)
      {
        const auto &n = slave.face->nodes;
        if (std::none_of(n.begin(), n.end(), [&](const unsigned int i) { return integrated[i]; }))
          continue;
        Quadrilateral corners;
        for (unsigned int k = 0; k < 4; ++k)
          corners.corners[k] = slave.project(x[n[k]]);
        corners.prepare();
        std::array<std::array<double, 4>, 4> weighting; // psi_j = sum_k weighting_jk N_k
        std::array<double, 4>                integral;
        corners.dual_functions(weighting, integral);
        for (unsigned int k = 0; k < 4; ++k)
          {
            NodeSum &sum = sums[sum_number(n[k])];
            sum.normal += slave.area_vector;
            sum.whole += integral[k];
          }

        pieces.clear();
        double covered_area = 0.;
        for (const unsigned int f : slave.opposite)
          {
            Piece piece;
            piece.master = &surfaces.faces[f];
            for (unsigned int k = 0; k < 4; ++k) // reversed: counter-clockwise seen from the slave's outside
              piece.corners.corners[k] = slave.project(x[piece.master->nodes[3 - k]]);
            piece.polygon = intersection(corners, piece.corners);
            if (piece.polygon.size() < 3)
              continue;
            piece.corners.prepare();
            for (unsigned int i = 1; i + 1 < piece.polygon.size(); ++i)
              covered_area += 0.5 * cross(piece.polygon[0], piece.polygon[i], piece.polygon[i + 1]);
            pieces.push_back(std::move(piece));
          }
        // Dual functions are negative in places. Over a whole face that cancels for linear gaps; over a part
        // of it a gap that is open everywhere could come out negative: there the shape functions are the
        // weights.
        if (covered_area < (1. - 1e-6) * std::sqrt(dot(slave.area_vector, slave.area_vector)))
          for (unsigned int j = 0; j < 4; ++j)
            for (unsigned int k = 0; k < 4; ++k)
              weighting[j][k] = j == k ? 1. : 0.;

        // Integrals of N_j, N_j N_k and N_j N_l^master; the weights follow by their coefficients.
        AtPoints slave_slave_at[4][4] = {}, covered_at[4] = {};
        NodeSum *sum_of[4];
        for (unsigned int j = 0; j < 4; ++j)
          sum_of[j] = &sums[number_of_sum[n[j]]];
        for (const Piece &piece : pieces)
          {
            AtPoints       slave_master_at[4][4] = {};
            const Polygon &polygon               = piece.polygon;
            for (unsigned int i = 1; i + 1 < polygon.size(); ++i)
              {
                const Plane2 a = polygon[0], b = polygon[i], c = polygon[i + 1];
                const double area = 0.5 * cross(a, b, c);
                if (area <= 0.)
                  continue;
                const auto    &q = triangle_points;
                const AtPoints s = q[0] * a.s + q[1] * b.s + q[2] * c.s,
                               t = q[0] * a.t + q[1] * b.t + q[2] * c.t;
                const auto N = corners.shape_at(s, t), N_master = piece.corners.shape_at(s, t);
                for (unsigned int j = 0; j < 4; ++j)
                  {
                    const AtPoints w = area * triangle_weights * N[j];
                    covered_at[j] += w;
                    for (unsigned int k = 0; k < 4; ++k)
                      {
                        slave_slave_at[j][k] += w * N[k];
                        slave_master_at[j][k] += w * N_master[k];
                      }
                  }
              }
            double slave_master[4][4];
            for (unsigned int j = 0; j < 4; ++j)
              for (unsigned int k = 0; k < 4; ++k)
                slave_master[j][k] = total(slave_master_at[j][k]);
            for (unsigned int j = 0; j < 4; ++j)
              for (unsigned int k = 0; k < 4; ++k)
                {
                  double M = 0.;
                  for (unsigned int l = 0; l < 4; ++l)
                    M += weighting[j][l] * slave_master[l][k];
                  sum_of[j]->add(piece.master->nodes[3 - k], M);
                }
          }
        double slave_slave[4][4], covered[4];
        for (unsigned int j = 0; j < 4; ++j)
          {
            covered[j] = total(covered_at[j]);
            for (unsigned int k = 0; k < 4; ++k)
              slave_slave[j][k] = total(slave_slave_at[j][k]);
          }
        for (unsigned int j = 0; j < 4; ++j)
          {
            sum_of[j]->covered += covered[j];
            for (unsigned int k = 0; k < 4; ++k)
              {
                double D = 0.;
                for (unsigned int l = 0; l < 4; ++l)
                  D += weighting[j][l] * slave_slave[l][k];
                sum_of[j]->area += weighting[j][k] * covered[k];
                sum_of[j]->add(n[k], -D);
              }
          }
      }

    if (n_ranks > 1)
      {
        std::vector<double> own;
        for (const NodeSum &sum : sums)
          {
            own.insert(own.end(), {double(sum.node), sum.normal[0], sum.normal[1], sum.normal[2], sum.area,
                                   sum.covered, sum.whole, double(sum.entries.size())});
            for (const MortarEntry &entry : sum.entries)
              own.insert(own.end(), {double(entry.node), entry.coefficient});
          }
        sums.clear();
        std::fill(number_of_sum.begin(), number_of_sum.end(), -1);
        const std::vector<double> all = gathered(own, surfaces.comm);
        for (const double *value = all.data(); value < all.data() + all.size();)
          {
            NodeSum &sum = sums[sum_number(value[0])];
            sum.normal += Row{value[1], value[2], value[3], 0.};
            sum.area += value[4];
            sum.covered += value[5];
            sum.whole += value[6];
            const unsigned int n_entries = value[7];
            value += 8;
            const bool is_first = sum.entries.empty();
            for (unsigned int i = 0; i < n_entries; ++i, value += 2)
              if (const unsigned int node = value[0]; is_first)
                sum.entries.push_back({node, value[1]});
              else
                sum.add(node, value[1]);
          }
      }

    std::vector<const std::array<unsigned int, 2> *> parents_of(surfaces.nodes.size(), nullptr);
    for (const auto &h : surfaces.hanging_nodes)
      {
        parents_of[h.node] = &h.parents;
        if (number_of_sum[h.node] >= 0)
          for (const unsigned int parent : h.parents)
            {
              const int sum = sum_number(parent);
              sums[sum].add(sums[number_of_sum[h.node]], 0.5);
            }
      }
    for (unsigned int node = 0; node < surfaces.nodes.size(); ++node)
      {
        if (number_of_sum[node] < 0)
          continue;
        NodeSum &sum = sums[number_of_sum[node]];
        if (parents_of[node] || !near_node[node] || sum.covered < 0.5 * sum.whole ||
            sum.area < 0.25 * sum.whole)
          continue;
        if (std::any_of(sum.entries.begin(), sum.entries.end(),
                        [&](const MortarEntry &entry) { return parents_of[entry.node]; }))
          {
            const auto entries = std::move(sum.entries);
            sum.entries.clear();
            for (const MortarEntry &entry : entries)
              if (const auto *parents = parents_of[entry.node]; !parents)
                sum.add(entry.node, entry.coefficient);
              else
                for (const unsigned int parent : *parents)
                  sum.add(parent, 0.5 * entry.coefficient);
          }
        MortarRow row;
        row.slave  = node;
        row.normal = normalised(sum.normal);
        row.area   = sum.area;
        row.begin  = coupling.entries.size();
        for (const MortarEntry &entry : sum.entries)
          if (std::abs(entry.coefficient) > 1e-10 * sum.area)
            coupling.entries.push_back({entry.node, entry.coefficient / sum.area});
        row.end = coupling.entries.size();
        // Dropped entries and round-off are added to the slave node, so that forces balance to the last one
        // or two bits.
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
