// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/quiet_boost.h>
#include <tread/contact/mortar.h>

#include <deal.II/base/mpi.h>

#include "node_sums.h"
#include "quadrilateral.h"
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
    /// Share of a slave face's area from which on it counts as covered: all of it but round-off of the cuts.
    constexpr double covers_all = 1. - 1e-6;
    /// A slave node gets a row if at least this share of its faces is covered: where less is, contact has
    /// left the surfaces that are meshed for it.
    constexpr double least_covered = 0.5;
    /// ... and if the integral of its weight, by which the row is divided, is at least this share of what it
    /// is over whole faces: as much as shape functions have over the far halves of all faces around a node.
    constexpr double least_area = 0.25;
    /// Coefficients below this share are round-off: functions of faces that only touch.
    constexpr double least_coefficient = 1e-10;

    Vector3 normalised(const Vector3 a)
    {
      return a * (1. / std::sqrt(dot(a, a)));
    }

    namespace bg   = boost::geometry;
    using BoxPoint = bg::model::point<double, 3, bg::cs::cartesian>;
    using Box      = bg::model::box<BoxPoint>;

    /// Bounding box of a face that moves back and forth by a given distance.
    Box box_of(const ContactSurfaces::Face &face, const std::vector<Vector3> &x, const Vector3 way)
    {
      Vector3 low = x[face.nodes[0]], high = low;
      for (const unsigned int i : face.nodes)
        for (unsigned int d = 0; d < 3; ++d)
          {
            low[d]  = std::min(low[d], x[i][d]);
            high[d] = std::max(high[d], x[i][d]);
          }
      const Vector3 margin{std::abs(way[0]), std::abs(way[1]), std::abs(way[2]), 0.};
      low -= margin;
      high += margin;
      return Box(BoxPoint(low[0], low[1], low[2]), BoxPoint(high[0], high[1], high[2]));
    }

    /// The same way in all directions.
    Vector3 everywhere(const double way)
    {
      return way * Vector3{1., 1., 1., 0.};
    }


    /// The faces of the master surfaces that lie where the slave surface may reach, to be searched.
    class MasterFaces
    {
    public:
      MasterFaces(const ContactSurfaces      &surfaces,
                  const std::vector<Vector3> &x,
                  const unsigned int          slave_body,
                  const double                search_reach)
      {
        Box slave_extent;
        bg::assign_inverse(slave_extent);
        bg::assign_inverse(extent);
        for (const ContactSurfaces::Face &face : surfaces.faces)
          if (face.body == slave_body)
            bg::expand(slave_extent, box_of(face, x, everywhere(search_reach)));
        std::vector<Entry> boxes;
        for (unsigned int f = 0; f < surfaces.faces.size(); ++f)
          if (surfaces.faces[f].body != slave_body)
            if (const Box box = box_of(surfaces.faces[f], x, Vector3{}); bg::intersects(box, slave_extent))
              {
                boxes.emplace_back(box, f);
                bg::expand(extent, box);
              }
        tree = Tree(boxes);
      }

      bool empty() const
      {
        return tree.empty();
      }

      /// Whether any of them may be in a box.
      bool may_be_in(const Box &box) const
      {
        return bg::intersects(box, extent);
      }

      /// Numbers of those whose boxes meet this one, in the order of the search.
      std::vector<unsigned int> in(const Box &box) const
      {
        std::vector<Entry> found;
        tree.query(bg::index::intersects(box), std::back_inserter(found));
        std::vector<unsigned int> faces;
        for (const Entry &entry : found)
          faces.push_back(entry.second);
        return faces;
      }

    private:
      using Entry = std::pair<Box, unsigned int>;
      using Tree  = bg::index::rtree<Entry, bg::index::quadratic<16>>;
      Box  extent;
      Tree tree;
    };


    /// A slave face, the plane in which it is integrated, and the master faces opposite.
    struct SlaveFace
    {
      const ContactSurfaces::Face *face;
      Vector3                      origin, normal, along_s, along_t, area_vector;
      std::vector<unsigned int>    opposite;
      bool                         is_near;

      SlaveFace(const ContactSurfaces::Face &face, const std::vector<Vector3> &x)
        : face(&face)
        , is_near(false)
      {
        const auto &n      = face.nodes;
        area_vector        = 0.5 * cross(x[n[2]] - x[n[0]], x[n[3]] - x[n[1]]);
        normal             = normalised(area_vector);
        origin             = 0.25 * (x[n[0]] + x[n[1]] + x[n[2]] + x[n[3]]);
        const Vector3 edge = x[n[1]] - x[n[0]];
        along_s            = normalised(edge - dot(edge, normal) * normal);
        along_t            = cross(normal, along_s);
      }

      Plane2 project(const Vector3 x) const
      {
        return {dot(x - origin, along_s), dot(x - origin, along_t)};
      }
    };

    /// What the search finds: this rank's slave faces with master faces opposite; and, of all ranks, the
    /// nodes of near ones and the time until others may touch.
    struct Found
    {
      std::vector<SlaveFace>   slave_faces;
      std::vector<signed char> near_node;
      double                   time_to_touch = 1e9; ///< s
    };

    /// Keep those of the faces that are opposite and within the search reach, and note how near they are.
    void choose_opposite(SlaveFace                       &slave,
                         const std::vector<unsigned int> &faces,
                         const ContactSurfaces           &surfaces,
                         const std::vector<Vector3>      &x,
                         const std::vector<Vector3>      &v,
                         const double                     search_reach,
                         const double                     reach,
                         double                          &time_to_touch)
    {
      const auto   &n              = slave.face->nodes;
      const Vector3 slave_velocity = 0.25 * (v[n[0]] + v[n[1]] + v[n[2]] + v[n[3]]);
      for (const unsigned int f : faces)
        {
          const auto &m       = surfaces.faces[f].nodes;
          double      nearest = std::numeric_limits<double>::max(), closing = 0.;
          for (const unsigned int node : m)
            {
              nearest = std::min(nearest, std::abs(dot(x[node] - slave.origin, slave.normal)));
              closing = std::max(closing, -dot(v[node] - slave_velocity, slave.normal));
            }
          if (nearest > search_reach || dot(cross(x[m[2]] - x[m[0]], x[m[3]] - x[m[1]]), slave.normal) >= 0.)
            continue; // too far, or not facing each other
          if (nearest > MortarCoupling::candidates * reach)
            time_to_touch = std::min(time_to_touch, nearest / std::max(closing, 1e-30));
          slave.is_near = slave.is_near || nearest <= reach;
          slave.opposite.push_back(f);
        }
      std::sort(slave.opposite.begin(), slave.opposite.end());
    }

    /// First pass: the slave faces that have a master face opposite, and how near it is. Collective.
    Found search(const ContactSurfaces      &surfaces,
                 const std::vector<Vector3> &x,
                 const std::vector<Vector3> &v,
                 const unsigned int          slave_body,
                 const MasterFaces          &master_faces,
                 const double                search_reach,
                 const double                reach)
    {
      Found found;
      found.near_node.assign(surfaces.nodes.size(), false);
      const unsigned int n_ranks   = dealii::Utilities::MPI::n_mpi_processes(surfaces.comm),
                         this_rank = dealii::Utilities::MPI::this_mpi_process(surfaces.comm);
      // The ranks take some that lie together in turn: where the patch is there is more to do.
      constexpr unsigned int turns      = 32;
      const unsigned int     n_faces    = std::count_if(surfaces.faces.begin(), surfaces.faces.end(),
                                                        [&](const auto &face) { return face.body == slave_body; });
      const unsigned int     n_together = 1 + n_faces / (turns * n_ranks);
      unsigned int           turn       = 0;
      for (const ContactSurfaces::Face &face : surfaces.faces)
        {
          if (face.body != slave_body || (turn++ / n_together) % n_ranks != this_rank ||
              !master_faces.may_be_in(box_of(face, x, everywhere(search_reach))))
            continue;
          SlaveFace slave(face, x);
          choose_opposite(slave, master_faces.in(box_of(face, x, search_reach * slave.normal)), surfaces, x,
                          v, search_reach, reach, found.time_to_touch);
          if (slave.opposite.empty())
            continue;
          if (slave.is_near)
            for (const unsigned int i : face.nodes)
              found.near_node[i] = true;
          found.slave_faces.push_back(std::move(slave));
        }
      if (n_ranks > 1)
        {
          MPI_Allreduce(MPI_IN_PLACE, found.near_node.data(), found.near_node.size(), MPI_SIGNED_CHAR,
                        MPI_MAX, surfaces.comm);
          MPI_Allreduce(MPI_IN_PLACE, &found.time_to_touch, 1, MPI_DOUBLE, MPI_MIN, surfaces.comm);
        }
      // A hanging node gives its row to its parents.
      for (const auto &h : surfaces.hanging_nodes)
        if (found.near_node[h.node])
          for (const unsigned int parent : h.parents)
            found.near_node[parent] = true;
      return found;
    }


    /// What one pair of faces shares: the master's corners in the slave's plane, and the common polygon.
    struct Piece
    {
      const ContactSurfaces::Face *master;
      Quadrilateral                corners;
      Polygon                      polygon;
    };

    /// The parts of a slave face that master faces cover. @returns their area, m^2.
    double cut(const SlaveFace            &slave,
               const Quadrilateral        &corners,
               const ContactSurfaces      &surfaces,
               const std::vector<Vector3> &x,
               std::vector<Piece>         &pieces)
    {
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
      return covered_area;
    }

    using Matrix4 = std::array<std::array<double, 4>, 4>;

    /// Add the integrals over a face's pieces to its nodes' sums.
    /// @param weighting of the shape functions: psi_j = sum_k weighting_jk N_k
    void integrate(const Quadrilateral               &corners,
                   const std::vector<Piece>          &pieces,
                   const Matrix4                     &weighting,
                   const std::array<unsigned int, 4> &n,
                   std::array<NodeSum, 4>            &sum_of)
    {
      // Integrals of N_j, N_j N_k and N_j N_l^master; the weights follow by their coefficients.
      AtPoints slave_slave_at[4][4] = {}, covered_at[4] = {};
      for (const Piece &piece : pieces)
        {
          AtPoints slave_master_at[4][4] = {};
          with_points_of(piece.polygon, [&](const AtPoints s, const AtPoints t, const AtPoints weight) {
            const auto N = corners.shape_at(s, t), N_master = piece.corners.shape_at(s, t);
            for (unsigned int j = 0; j < 4; ++j)
              {
                const AtPoints w = weight * N[j];
                covered_at[j] += w;
                for (unsigned int k = 0; k < 4; ++k)
                  {
                    slave_slave_at[j][k] += w * N[k];
                    slave_master_at[j][k] += w * N_master[k];
                  }
              }
          });
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
                sum_of[j].add(piece.master->nodes[3 - k], M);
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
          sum_of[j].covered += covered[j];
          for (unsigned int k = 0; k < 4; ++k)
            {
              double D = 0.;
              for (unsigned int l = 0; l < 4; ++l)
                D += weighting[j][l] * slave_slave[l][k];
              sum_of[j].area += weighting[j][k] * covered[k];
              sum_of[j].add(n[k], -D);
            }
        }
    }

    /// Second pass: integrate all faces around the nodes that are near. What a hanging node's parents need
    /// are all the faces around them and around the nodes that hang on them. Collective.
    NodeSums integrate_near(const ContactSurfaces      &surfaces,
                            const std::vector<Vector3> &x,
                            const Found                &found)
    {
      std::vector<signed char> integrated = found.near_node;
      for (const auto &h : surfaces.hanging_nodes)
        for (const unsigned int parent : h.parents)
          integrated[h.node] |= found.near_node[parent];

      FaceSums           of_faces;
      std::vector<Piece> pieces;
      for (const SlaveFace &slave : found.slave_faces)
        {
          const auto &n = slave.face->nodes;
          if (std::none_of(n.begin(), n.end(), [&](const unsigned int i) { return integrated[i]; }))
            continue;
          Quadrilateral corners;
          for (unsigned int k = 0; k < 4; ++k)
            corners.corners[k] = slave.project(x[n[k]]);
          corners.prepare();
          Matrix4               weighting;
          std::array<double, 4> integral;
          corners.dual_functions(weighting, integral);
          std::array<NodeSum, 4> &sum_of = of_faces.begin_face(slave.face - surfaces.faces.data(), n);
          for (unsigned int k = 0; k < 4; ++k)
            {
              sum_of[k].normal = slave.area_vector;
              sum_of[k].whole  = integral[k];
            }
          // Dual functions are negative in places. Over a whole face that cancels for linear gaps; over a
          // part of it a gap that is open everywhere could come out negative: there the shape functions are
          // the weights.
          const double covered_area = cut(slave, corners, surfaces, x, pieces);
          if (covered_area < covers_all * std::sqrt(dot(slave.area_vector, slave.area_vector)))
            for (unsigned int j = 0; j < 4; ++j)
              for (unsigned int k = 0; k < 4; ++k)
                weighting[j][k] = j == k ? 1. : 0.;
          integrate(corners, pieces, weighting, n, sum_of);
        }
      NodeSums sums(surfaces.nodes.size());
      of_faces.add_to(sums, surfaces.comm);
      return sums;
    }


    /// The row of a node whose sum is complete, with coefficients of nodes that do not hang.
    void add_row(const NodeSum &sum, MortarCoupling &coupling)
    {
      MortarRow row;
      row.slave  = sum.node;
      row.normal = normalised(sum.normal);
      row.area   = sum.area;
      row.begin  = coupling.entries.size();
      for (const MortarEntry &entry : sum.entries)
        if (std::abs(entry.coefficient) > least_coefficient * sum.area)
          coupling.entries.push_back({entry.node, entry.coefficient / sum.area});
      row.end = coupling.entries.size();
      // Dropped entries and round-off are added to the slave node, so that forces balance to the last one
      // or two bits.
      double excess = 0.;
      for (std::size_t i = row.begin; i < row.end; ++i)
        excess += coupling.entries[i].coefficient;
      for (std::size_t i = row.begin; i < row.end; ++i)
        if (coupling.entries[i].node == sum.node)
          coupling.entries[i].coefficient -= excess;
      coupling.rows.push_back(row);
    }

    /// Rows of the near nodes that do not hang: those that do give what they have to their parents.
    void add_rows(const ContactSurfaces          &surfaces,
                  const std::vector<signed char> &near_node,
                  NodeSums                       &sums,
                  MortarCoupling                 &coupling)
    {
      std::vector<const std::array<unsigned int, 2> *> parents_of(surfaces.nodes.size(), nullptr);
      for (const auto &h : surfaces.hanging_nodes)
        {
          parents_of[h.node] = &h.parents;
          if (sums.has(h.node))
            for (const unsigned int parent : h.parents)
              {
                sums.of(parent); // before that of the hanging node, which it may move
                sums.of(parent).add(sums.of(h.node), 0.5);
              }
        }
      for (unsigned int node = 0; node < surfaces.nodes.size(); ++node)
        {
          if (!sums.has(node))
            continue;
          NodeSum &sum = sums.of(node);
          if (parents_of[node] || !near_node[node] || sum.covered < least_covered * sum.whole ||
              sum.area < least_area * sum.whole)
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
          add_row(sum, coupling);
        }
    }
  } // namespace


  MortarCoupling couple(const ContactSurfaces      &surfaces,
                        const std::vector<Vector3> &x,
                        const std::vector<Vector3> &v,
                        const unsigned int          slave_body,
                        const double                search_reach,
                        const double                reach)
  {
    MortarCoupling    coupling;
    const MasterFaces master_faces(surfaces, x, slave_body, search_reach);
    if (master_faces.empty())
      {
        coupling.time_to_touch = Found().time_to_touch;
        return coupling;
      }
    const Found found      = search(surfaces, x, v, slave_body, master_faces, search_reach, reach);
    coupling.time_to_touch = found.time_to_touch;
    NodeSums sums          = integrate_near(surfaces, x, found);
    add_rows(surfaces, found.near_node, sums, coupling);
    return coupling;
  }
} // namespace tread
