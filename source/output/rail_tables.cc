// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/run_folder.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/array.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace tread
{
  namespace
  {
    /// rail_cells.csv: middle, von Mises stress, Cauchy stress xx, yy, zz, xy, yz, zx, plastic strain.
    const Columns<std::array<double, 11>> &rail_cell_columns()
    {
      static const auto columns = columns_of<11>(
        {{{"x", "mm", "Middle of the cell before any load, along the rail"},
          {"y", "mm", "The same across"},
          {"z", "mm", "The same upwards"},
          {"von_mises", "MPa", "Von Mises stress in the middle of the cell at the solution instant"},
          {"stress_xx", "MPa", "Cauchy stress, along the rail"},
          {"stress_yy", "MPa", "Across"},
          {"stress_zz", "MPa", "Upwards"},
          {"stress_xy", "MPa", "Shear"},
          {"stress_yz", "MPa", "Shear"},
          {"stress_zx", "MPa", "Shear"},
          {"equivalent_plastic_strain", "percent", "Equivalent plastic strain at that instant"}}});
      return columns;
    }

    /// rail_surface.csv: place and displacement.
    const Columns<std::array<double, 13>> &rail_surface_columns()
    {
      static const auto columns =
        columns_of<13>({{{"x", "mm", "Node of the surface before any load, along the rail"},
                         {"y", "mm", "The same across"},
                         {"z", "mm", "The same upwards"},
                         {"u_x", "um", "Displacement at the solution instant, along the rail"},
                         {"u_y", "um", "The same across"},
                         {"u_z", "um", "The same upwards"},
                         {"von_mises", "MPa", "Von Mises stress at the surface, recovered, at that instant"},
                         {"stress_xx", "MPa", "Cauchy stress there, along the rail"},
                         {"stress_yy", "MPa", "Across"},
                         {"stress_zz", "MPa", "Upwards"},
                         {"stress_xy", "MPa", "Shear"},
                         {"stress_yz", "MPa", "Shear"},
                         {"stress_zx", "MPa", "Shear"}}});
      return columns;
    }

    const bool rail_tables_are_known = know_table(describe("rail_cells.csv", rail_cell_columns())) &&
                                       know_table(describe("rail_surface.csv", rail_surface_columns()));
  } // namespace


  void RunFolder::write_rail_tables(const ExplicitDynamics                    &dynamics,
                                    const std::vector<StressRecovery::Stress> &stresses,
                                    const unsigned int                         body,
                                    const double                               depth) const
  {
    const Mesh                              &mesh = dynamics.mesh;
    const std::vector<std::array<double, 6>> stress =
      dynamics.solid.cauchy_stress(dynamics.state.positions().data(), dynamics.state.history);
    const std::vector<double> strain =
      dynamics.solid.plastic().equivalent_plastic_strain(dynamics.state.history);
    std::vector<std::array<double, 11>> cells;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (mesh.cells[c].body == body)
        {
          dealii::Point<3> center;
          for (const unsigned int i : mesh.cells[c].nodes)
            center += mesh.nodes[i] / 8.;
          if (-center[2] > depth || std::abs(center[1]) > depth)
            continue;
          const std::array<double, 6> &s = stress[c];
          cells.push_back({{center[0], center[1], center[2], von_mises(s), s[0], s[1], s[2], s[3], s[4], s[5],
                            strain.empty() ? 0. : strain[c]}});
        }
    std::map<std::array<long long, 4>, std::array<double, 13>> own;
    for (const Mesh::Face &face : mesh.faces)
      if (face.body == body && face.boundary == Boundary::contact)
        for (const unsigned int i : face.nodes)
          if (mesh.shared_nodes.is_owned(i) && std::abs(mesh.nodes[i][1]) <= depth)
            {
              const dealii::Point<3>       &p = mesh.nodes[i];
              const Vector3                 u = dynamics.state.position(i) - Vector3{p[0], p[1], p[2], 0.};
              const StressRecovery::Stress &s = stresses[i];
              own[mesh.node_key(i)]           = {
                          {p[0], p[1], p[2], u[0], u[1], u[2], von_mises(s), s[0], s[1], s[2], s[3], s[4], s[5]}};
            }
    std::vector<std::array<double, 13>> nodes;
    for (const auto &[key, values] : own)
      nodes.push_back(values);

    const auto all_cells  = dealii::Utilities::MPI::gather(comm, cells, 0);
    const auto all_nodes  = dealii::Utilities::MPI::gather(comm, nodes, 0);
    const auto write_rows = [&](const std::string &name, const auto &columns, const auto &lists) {
      auto rows = lists.front();
      for (std::size_t i = 1; i < lists.size(); ++i)
        rows.insert(rows.end(), lists[i].begin(), lists[i].end());
      std::sort(rows.begin(), rows.end());
      write_table(name, columns, rows);
    };
    if (!writes_tables)
      return;
    write_rows("rail_cells.csv", rail_cell_columns(), all_cells);
    write_rows("rail_surface.csv", rail_surface_columns(), all_nodes);
  }
} // namespace tread
