// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/rail_stress.h>
#include <tread/solid/hexahedron.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/array.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

namespace tread
{
  namespace
  {
    /// Reference positions are compared in whole nm, far below any cell and far above rounding.
    constexpr double per_nm = 1e9, nm = 1e-9;

    Archive::Key key_of(const unsigned int body, const dealii::Point<3> &p)
    {
      return {{body, std::llround(per_nm * p[0]), std::llround(per_nm * p[1]), std::llround(per_nm * p[2])}};
    }

    /// Of rows with the same key that with the largest stress, and of equal ones the least.
    template <typename Row, typename Key>
    std::vector<Row> largest_of_each(std::vector<Row> rows, const std::size_t stress, const Key &key_of_row)
    {
      std::sort(rows.begin(), rows.end());
      std::map<decltype(key_of_row(rows.front())), Row> largest;
      for (const Row &row : rows)
        if (const auto [known, is_new] = largest.emplace(key_of_row(row), row);
            !is_new && row[stress] > known->second[stress])
          known->second = row;
      rows.clear();
      for (const auto &[key, row] : largest)
        rows.push_back(row);
      return rows;
    }

    /// Distances of points from cells are compared in whole units, so many of half a cell.
    constexpr double distance_units = 1e6;

    /// A point this far from the middle of a cell, in local coordinates, still belongs to it: one on the
    /// surface of a body lies on a face, 1, and the map of a distorted cell is not quite linear.
    constexpr double outside = 1.01;

    /// Points farther from the middle of a cell than its corners, by this factor, are not looked at.
    constexpr double reach_of_cell = 1.1;

    /// Largest local coordinate of a point in a cell, by the linear part of its map: 1 on its faces.
    double local_distance(const std::array<dealii::Point<3>, 8> &corners, const dealii::Point<3> &p)
    {
      dealii::Tensor<2, 3> jacobian;
      for (unsigned int a = 0; a < 8; ++a)
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            jacobian[i][j] += corners[a][i] * linear_pattern(j, a) / 8.;
      const dealii::Tensor<1, 3> local = invert(jacobian) * (p - centre_of(corners));
      return std::max({std::abs(local[0]), std::abs(local[1]), std::abs(local[2])});
    }
  } // namespace


  StressStrip::StressStrip(const Mesh            &mesh,
                           const Solid           &solid,
                           const ContactSurfaces *surfaces,
                           const unsigned int     body,
                           const ElasticMaterial &material,
                           const StripExtent     &extent)
    : comm(mesh.comm)
    , recovery(mesh,
               solid,
               surfaces,
               material,
               {body, extent.depth_of,
                [&extent](const dealii::Point<3> &p) {
                  return p[0] >= extent.x_begin - nm && p[0] <= extent.x_end + nm &&
                         std::abs(p[1] - extent.y_middle) <= extent.half_width + nm;
                },
                true})
    , wanted(mesh.cells.size(), false)
  {
    std::vector<char> at_surface(mesh.cells.size(), false);
    for (const Mesh::Face &face : mesh.faces)
      if (face.boundary == Boundary::contact)
        at_surface[face.cell] = true;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (mesh.cells[c].material == body)
        {
          const auto             corners = mesh.corners(c);
          const dealii::Point<3> centre  = centre_of(corners);
          const double           depth   = extent.depth_of(centre);
          if (centre[0] < extent.x_begin || centre[0] > extent.x_end ||
              std::abs(centre[1] - extent.y_middle) > extent.half_width || depth > extent.depth)
            continue;
          Member member{c,     key_of(body, centre), centre[0],   centre[0], centre[1],
                        depth, at_surface[c] != 0,   StressPeak()};
          for (const dealii::Point<3> &p : corners)
            {
              member.x_begin = std::min(member.x_begin, p[0]);
              member.x_end   = std::max(member.x_end, p[0]);
            }
          members.push_back(member);
          wanted[c] = true;
        }
    for (const unsigned int c : recovery.cells())
      wanted[c] = true;
    for (unsigned int k = 0; k < recovery.at_surface().size(); ++k)
      if (const StressRecovery::Site &site = recovery.at_surface()[k]; site.wanted)
        surface.push_back({k, key_of(body, site.place), site.place[0], site.place[1], StressPeak()});
  }


  void StressStrip::sample(const ExplicitDynamics     &dynamics,
                           const std::vector<Vector3> &impulses,
                           const double                wheel_x)
  {
    const NodalField x      = dynamics.state.positions();
    const auto       stress = dynamics.solid.cauchy_stress(x.data(), dynamics.state.history, wanted);
    const auto       keep   = [&](StressPeak &peak, const StressRecovery::Stress &present) {
      if (const double value = von_mises(present); value > peak.stress)
        peak = {value, dynamics.state.time, wheel_x};
    };
    for (Member &member : members)
      keep(member.peak, stress[member.cell]);
    recovery.recover(x.data(), stress, dynamics.solid.plastic().yield_limits(dynamics.state.history),
                     impulses, dynamics.state.time_step);
    for (SurfaceMember &member : surface)
      keep(member.peak, recovery.stress_at_surface()[member.site]);
  }


  std::vector<StressStrip::CellRow> StressStrip::cell_rows(const std::vector<double> &plastic_strain) const
  {
    std::vector<CellRow> rows;
    for (const Member &m : members)
      rows.push_back({{m.x_begin, m.x_end, m.y, m.depth, m.at_surface ? 1. : 0., m.peak.stress, m.peak.time,
                       m.peak.wheel_x, plastic_strain.empty() ? 0. : plastic_strain[m.cell]}});
    return rows;
  }


  std::vector<StressStrip::NodeRow> StressStrip::node_rows() const
  {
    std::vector<NodeRow> rows;
    for (const SurfaceMember &m : surface)
      rows.push_back({{m.x, m.y, m.peak.stress, m.peak.time, m.peak.wheel_x}});
    return rows;
  }


  void StressStrip::take_over(const StressStrip &before)
  {
    const auto gathered = [this](const auto &own, const auto &so_far) {
      auto rows = so_far;
      for (const auto &list : dealii::Utilities::MPI::all_gather(comm, own))
        rows.insert(rows.end(), list.begin(), list.end());
      return rows;
    };
    // Of cells from one x to another, at the surface or below it, and of nodes at one x columns() needs the
    // largest alone.
    cells_before =
      largest_of_each(gathered(before.cell_rows({}), before.cells_before), 5, [](const CellRow &row) {
        return std::array<long long, 3>{
          {std::llround(per_nm * row[0]), std::llround(per_nm * row[1]), row[4] > 0.}};
      });
    nodes_before = largest_of_each(gathered(before.node_rows(), before.nodes_before), 2,
                                   [](const NodeRow &row) { return std::llround(per_nm * row[0]); });
  }


  std::vector<StripColumn> StressStrip::columns(const ExplicitDynamics &dynamics) const
  {
    std::vector<CellRow> all = cells_before;
    for (const auto &list : dealii::Utilities::MPI::gather(
           comm, cell_rows(dynamics.solid.plastic().equivalent_plastic_strain(dynamics.state.history)), 0))
      all.insert(all.end(), list.begin(), list.end());
    std::sort(all.begin(), all.end()); // equal peaks: the same cell on any number of ranks

    std::map<long long, StripColumn> by_place;
    std::map<long long, double>      length_of; // of the surface cell
    for (const auto &cell : all)
      if (cell[4] > 0.)
        {
          const double x                       = 0.5 * (cell[0] + cell[1]);
          by_place[std::llround(per_nm * x)].x = x;
          length_of[std::llround(per_nm * x)]  = cell[1] - cell[0];
        }
    std::vector<StripColumn> columns;
    for (const auto &[place, column] : by_place)
      columns.push_back(column);
    for (const auto &[x_begin, x_end, y, depth, at_surface, stress, time, wheel_x, plastic_strain] : all)
      {
        const auto first = std::lower_bound(columns.begin(), columns.end(), x_begin,
                                            [](const StripColumn &c, const double x) { return c.x < x; });
        for (auto column = first; column != columns.end() && column->x <= x_end; ++column)
          {
            const StressPeak peak{stress, time, wheel_x};
            if (stress > column->largest.stress)
              {
                column->largest = peak;
                column->y       = y;
                column->depth   = depth;
              }
            column->equivalent_plastic_strain = std::max(column->equivalent_plastic_strain, plastic_strain);
          }
      }

    std::vector<NodeRow> nodes = nodes_before;
    for (const auto &list : dealii::Utilities::MPI::gather(comm, node_rows(), 0))
      nodes.insert(nodes.end(), list.begin(), list.end());
    std::sort(nodes.begin(), nodes.end());
    for (const auto &[x, y, stress, time, wheel_x] : nodes)
      {
        // A node belongs to the cells on both sides of it.
        const auto above = std::lower_bound(columns.begin(), columns.end(), x,
                                            [](const StripColumn &c, const double at) { return c.x < at; });
        for (auto column = above == columns.begin() ? above : above - 1;
             column != columns.end() && column <= above; ++column)
          if (std::abs(x - column->x) <= 0.5 * length_of[std::llround(per_nm * column->x)] + nm &&
              stress > column->at_surface.stress)
            {
              column->at_surface   = {stress, time, wheel_x};
              column->y_at_surface = y;
            }
      }
    return columns;
  }


  void StressStrip::serialize(Archive &archive)
  {
    struct KeptPeak
    {
      Archive::Key key;
      StressPeak   peak;
    };
    const auto store = [&archive](auto &list) {
      std::vector<KeptPeak> own;
      for (const auto &member : list)
        own.push_back({member.key, member.peak});
      const std::vector<KeptPeak> all = archive.records(own);
      if (!archive.restores())
        return;
      std::map<Archive::Key, StressPeak> by_key;
      for (const KeptPeak &kept : all)
        by_key[kept.key] = kept.peak;
      for (auto &member : list)
        if (const auto kept = by_key.find(member.key); kept != by_key.end())
          member.peak = kept->second;
        else
          archive.miss();
    };
    store(members);
    store(surface);
    archive.same(cells_before, nodes_before);
  }


  CellProbes::CellProbes(const Mesh                          &mesh,
                         const unsigned int                   body,
                         const std::vector<dealii::Point<3>> &points)
    : comm(mesh.comm)
    , wanted(mesh.cells.size(), false)
  {
    // Distance in units of 1e-6, then the name of the cell: of two that share a face with a point on it all
    // ranks take the same.
    using Candidate = std::array<long long, 5>;
    std::vector<Candidate>    own(points.size());
    std::vector<unsigned int> own_cells(points.size(), elsewhere);
    for (Candidate &candidate : own)
      candidate.fill(std::numeric_limits<long long>::max());
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (mesh.cells[c].body == body)
        {
          const auto             corners = mesh.corners(c);
          const dealii::Point<3> centre  = centre_of(corners);
          double                 reach   = 0.;
          for (const dealii::Point<3> &p : corners)
            reach = std::max(reach, p.distance(centre));
          for (unsigned int i = 0; i < points.size(); ++i)
            if (points[i].distance(centre) < reach_of_cell * reach)
              {
                const auto      key = key_of(body, centre);
                const Candidate candidate{std::llround(distance_units * local_distance(corners, points[i])),
                                          key[0], key[1], key[2], key[3]};
                if (candidate < own[i])
                  {
                    own[i]       = candidate;
                    own_cells[i] = c;
                  }
              }
        }
    const auto all = dealii::Utilities::MPI::all_gather(comm, own);
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        Candidate best = all[0][i];
        for (const auto &list : all)
          best = std::min(best, list[i]);
        if (best[0] > distance_units * outside)
          throw std::out_of_range(std::to_string(i + 1));
        const bool here = best == own[i];
        cells.push_back(here ? own_cells[i] : elsewhere);
        if (here)
          wanted[own_cells[i]] = true;
        centres_of_cells.emplace_back(nm * best[2], nm * best[3], nm * best[4]);
      }
  }


  std::vector<CellRecord> CellProbes::record(const ExplicitDynamics &dynamics) const
  {
    const auto stress =
      dynamics.solid.cauchy_stress(dynamics.state.positions().data(), dynamics.state.history, wanted);
    const auto          strain = dynamics.solid.plastic().equivalent_plastic_strain(dynamics.state.history);
    std::vector<double> values(2 * cells.size(), 0.);
    for (unsigned int i = 0; i < cells.size(); ++i)
      if (cells[i] != elsewhere)
        {
          values[2 * i]     = von_mises(stress[cells[i]]);
          values[2 * i + 1] = strain.empty() ? 0. : strain[cells[i]];
        }
    dealii::Utilities::MPI::sum(values, comm, values);
    std::vector<CellRecord> records;
    for (unsigned int i = 0; i < cells.size(); ++i)
      records.push_back({values[2 * i], values[2 * i + 1]});
    return records;
  }
} // namespace tread
