// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/reproducible_sum.h>
#include <tread/dynamics/moving_bodies.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tread
{
  namespace
  {
    // Quanta of reproducible sums, each with room for sums of 2^53 quanta.
    constexpr double on_hubs   = 0x1p-28; ///< N and N m, up to 3e7: 200 times the load of a wheel
    constexpr double moments   = 0x1p-36; ///< kg m and kg m^2, up to 1e5: a hundred wheels
    constexpr double loss      = 0x1p-50; ///< J in a step, up to 8; a run dissipates some J in 1e5 steps
    constexpr double stiffness = 0x1p-12; ///< N/m, up to 2e12: a cell of steel of 10 m
  }                                       // namespace


  MovingBodies::MovingBodies(const Mesh &mesh, const Solid &solid, const DynamicsParameters &parameters)
    : state(mesh, solid.virgin())
    , mesh(mesh)
    , solid(solid)
    , matched_surface(mesh, solid)
    , parameters(parameters)
    , inverse_mass(mesh.nodes.size(), 0.)
    , fixed(mesh.nodes.size(), false)
    , carried(mesh.nodes.size(), false)
    , parts(mesh.body_names.size())
  {
    if (solid.reproducible())
      quanta = {solid.force_quantum(), Quantum(on_hubs), Quantum(moments), Quantum(loss), Quantum(stiffness)};
    true_mass = nodal_masses([](const unsigned int) { return 1.; });
    if (solid.may_add_mass())
      added_mass = nodal_masses([&](const unsigned int c) { return solid.added_share(c); });
    set_levels();
    gain_of_levels = ideal_gain_of_levels(max_level());
  }


  void MovingBodies::append(std::unique_ptr<Part> part)
  {
    for (const unsigned int i : part->carried_nodes())
      carried[i] = true;
    parts.add(std::move(part));
    set_levels();
  }


  std::vector<double> MovingBodies::nodal_masses(
    const std::function<double(unsigned int)> &factor_of_cell) const
  {
    NodalField mass(mesh.nodes.size(), Vector3{});
    const auto cell_masses = solid.cell_masses(mesh);
    // In two parts, each of which sums exactly: cells of all sizes weigh up to 1e7 kg and have digits to
    // 1e-21 kg.
    const Quantum large(0x1p-24), small(0x1p-68);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int a = 0; a < 8; ++a)
        {
          const double of_node = factor_of_cell(c) * cell_masses[c][a], part = large.round(of_node);
          mass[mesh.cells[c].nodes[a]] += Vector3{part, small.round(of_node - part), 0., 0.};
        }
    // A hanging node is condensed on each rank that holds cells at it, so its sum is zero everywhere.
    mesh.condense_hanging_nodes(mass.data());
    mesh.shared_nodes.sum(mass.data());
    std::vector<double> masses(mass.size());
    for (unsigned int i = 0; i < mass.size(); ++i)
      masses[i] = mass[i][0] + mass[i][1];
    return masses;
  }


  std::vector<MovingBodies::MassOfBody> MovingBodies::masses_of_bodies() const
  {
    std::vector<std::array<ReproducibleSum<double>, 2>> sums(mesh.body_names.size());
    for (unsigned int i = 0; i < true_mass.size(); ++i)
      if (mesh.shared_nodes.is_owned(i))
        {
          auto &[own, added] = sums[mesh.node_bodies[i]];
          own.add(true_mass[i]);
          if (!added_mass.empty() && !carried[i] && !fixed[i]) // else it does not act
            added.add(added_mass[i]);
        }
    std::vector<MassOfBody> masses;
    for (const auto &of_body : sums)
      {
        const auto [own, added] = values_of(of_body, mesh.comm);
        masses.push_back({own, added});
      }
    return masses;
  }


  void MovingBodies::fix_nodes(const std::vector<unsigned int> &nodes)
  {
    for (const unsigned int i : nodes)
      fixed[i] = true;
  }


  void MovingBodies::guide_nodes(const std::vector<unsigned int> &nodes, const unsigned int direction)
  {
    for (const unsigned int i : nodes)
      guided.emplace_back(i, direction);
  }


  void MovingBodies::hold_guided_nodes(NodalField &field) const
  {
    for (const auto &[node, direction] : guided)
      field[node][direction] = 0.;
  }


  void MovingBodies::attach_contact(Contact &c)
  {
    contact = &c;
  }


  std::vector<double> MovingBodies::free_inverse_masses() const
  {
    std::vector<double> inverse(mesh.nodes.size(), 0.);
    for (unsigned int i = 0; i < inverse.size(); ++i)
      if (!fixed[i] && !carried[i] && true_mass[i] > 0.) // hanging nodes have none
        inverse[i] =
          1. / (parameters.density_scale * true_mass[i] + (added_mass.empty() ? 0. : added_mass[i]));
    return inverse;
  }


  void MovingBodies::set_levels()
  {
    std::vector<unsigned int> smallest_steps;
    for (const auto &part : parts)
      {
        const std::vector<unsigned int> nodes = part->nodes_of_every_step();
        smallest_steps.insert(smallest_steps.end(), nodes.begin(), nodes.end());
      }
    levels = NodeLevels(mesh, solid, smallest_steps, parts.carriers_of_bodies());
  }


  double MovingBodies::ideal_gain_of_levels(const unsigned int largest) const
  {
    double updates = 0.;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      updates += std::ldexp(1., -static_cast<int>(solid.level_up_to(largest, c)));
    return mesh.n_global_cells / dealii::Utilities::MPI::sum(updates, mesh.comm);
  }


  double MovingBodies::imbalance_of_cost(const Mesh::CellCost &cost) const
  {
    std::vector<double> costs(max_level() + 1, 0.);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      costs[solid.cell_levels()[c]] += cost(mesh.cells[c].body, mesh.corners(c), 0);
    double of_step = 0., waited_for = 0., mean = 0.;
    for (unsigned int last = 0; last <= max_level(); ++last)
      {
        // In one of 2^(last + 1) steps it is the turn of levels 0 to `last` and no further.
        const double share = std::ldexp(1., -static_cast<int>(std::min(last + 1, max_level())));
        of_step += costs[last];
        const auto over_ranks = dealii::Utilities::MPI::min_max_avg(of_step, mesh.comm);
        waited_for += share * over_ranks.max;
        mean += share * over_ranks.avg;
      }
    return waited_for / mean;
  }


  std::string MovingBodies::place_of_worst(const bool              is_worst,
                                           const dealii::Point<3> &place,
                                           const unsigned int      body) const
  {
    using dealii::Utilities::MPI::min;
    const int   this_rank = dealii::Utilities::MPI::this_mpi_process(mesh.comm);
    const int   rank      = min(is_worst ? this_rank : std::numeric_limits<int>::max(), mesh.comm);
    std::string where;
    if (rank == this_rank)
      where = format("at x = %.2f, y = %.2f, z = %.2f mm of the %s", 1e3 * place[0], 1e3 * place[1],
                     1e3 * place[2], mesh.body_names[body].c_str());
    return dealii::Utilities::MPI::broadcast(mesh.comm, where, rank);
  }


  std::string MovingBodies::place_of_worst_cell(const bool is_worst, const unsigned int cell) const
  {
    dealii::Point<3> centre;
    unsigned int     body = 0;
    if (is_worst)
      {
        for (const unsigned int i : mesh.cells[cell].nodes)
          centre += mesh.nodes[i] / 8.;
        body = mesh.cells[cell].body;
      }
    return place_of_worst(is_worst, centre, body);
  }
} // namespace tread
