// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/run_folder.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/array.hpp>

#include <algorithm>
#include <iomanip>
#include <map>
#include <sstream>

namespace tread
{
  void RunFolder::write_rail_tables(const ExplicitDynamics &dynamics,
                                    const unsigned int      body,
                                    const double            depth) const
  {
    const Mesh                              &mesh = dynamics.mesh;
    const std::vector<std::array<double, 6>> stress =
      dynamics.solid.cauchy_stress(dynamics.positions().data(), dynamics.history);
    const std::vector<double> strain = dynamics.solid.plastic().equivalent_plastic_strain(dynamics.history);
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
          cells.push_back({{1e3 * center[0], 1e3 * center[1], 1e3 * center[2], 1e-6 * von_mises(s),
                            1e-6 * s[0], 1e-6 * s[1], 1e-6 * s[2], 1e-6 * s[3], 1e-6 * s[4], 1e-6 * s[5],
                            strain.empty() ? 0. : 100. * strain[c]}});
        }
    std::map<std::array<long long, 4>, std::array<double, 6>> own;
    for (const Mesh::Face &face : mesh.faces)
      if (face.body == body && face.boundary == Boundary::contact)
        for (const unsigned int i : face.nodes)
          if (mesh.shared_nodes.is_owned(i) && std::abs(mesh.nodes[i][1]) <= depth)
            {
              const dealii::Point<3> &p = mesh.nodes[i];
              const Row               u = dynamics.position(i) - Row{p[0], p[1], p[2], 0.};
              own[mesh.node_key(i)]     = {
                    {1e3 * p[0], 1e3 * p[1], 1e3 * p[2], 1e6 * u[0], 1e6 * u[1], 1e6 * u[2]}};
            }
    std::vector<std::array<double, 6>> nodes;
    for (const auto &[key, values] : own)
      nodes.push_back(values);

    const auto all_cells  = dealii::Utilities::MPI::gather(comm, cells, 0);
    const auto all_nodes  = dealii::Utilities::MPI::gather(comm, nodes, 0);
    const auto write_rows = [&](const std::string &name, const std::string &header, const auto &lists) {
      auto rows = lists.front();
      for (std::size_t i = 1; i < lists.size(); ++i)
        rows.insert(rows.end(), lists[i].begin(), lists[i].end());
      std::sort(rows.begin(), rows.end());
      std::ostringstream text;
      text << header << '\n' << std::setprecision(9);
      for (const auto &row : rows)
        for (std::size_t k = 0; k < row.size(); ++k)
          text << row[k] << (k + 1 < row.size() ? ',' : '\n');
      write(name, text.str());
    };
    if (!writes_tables)
      return;
    write_rows(
      "rail_cells.csv",
      "x_mm,y_mm,z_mm,von_mises_MPa,stress_xx_MPa,stress_yy_MPa,stress_zz_MPa,stress_xy_MPa,stress_yz_MPa,"
      "stress_zx_MPa,equivalent_plastic_strain_percent",
      all_cells);
    write_rows("rail_surface.csv", "x_mm,y_mm,z_mm,u_x_um,u_y_um,u_z_um", all_nodes);
  }
} // namespace tread
