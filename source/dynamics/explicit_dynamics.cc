// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/format.h>
#include <tread/base/went_wrong.h>
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
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


  ExplicitDynamics::ExplicitDynamics(const Mesh               &mesh,
                                     const Solid              &solid,
                                     const DynamicsParameters &parameters)
    : state(mesh, solid.virgin())
    , mesh(mesh)
    , solid(solid)
    , matched_surface(mesh, solid)
    , parameters(parameters)
    , inverse_mass(mesh.nodes.size(), 0.)
    , fixed(mesh.nodes.size(), false)
    , carried(mesh.nodes.size(), false)
    , carrier_of_body(mesh.body_names.size(), -1)
  {
    if (solid.reproducible())
      quanta = {solid.force_quantum(), Quantum(on_hubs), Quantum(moments), Quantum(loss), Quantum(stiffness)};
    true_mass = nodal_masses([](const unsigned int) { return 1.; });
    if (solid.may_add_mass())
      added_mass = nodal_masses([&](const unsigned int c) { return solid.added_share(c); });
    set_node_levels();
    gain_of_levels = ideal_gain_of_levels(max_level());
  }


  std::vector<double> ExplicitDynamics::nodal_masses(
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


  std::vector<ExplicitDynamics::MassOfBody> ExplicitDynamics::masses_of_bodies() const
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


  void ExplicitDynamics::fix_nodes(const std::vector<unsigned int> &nodes)
  {
    for (const unsigned int i : nodes)
      fixed[i] = true;
  }


  void ExplicitDynamics::guide_nodes(const std::vector<unsigned int> &nodes, const unsigned int direction)
  {
    for (const unsigned int i : nodes)
      guided.emplace_back(i, direction);
  }


  void ExplicitDynamics::hold_guided_nodes(NodalField &field) const
  {
    for (const auto &[node, direction] : guided)
      field[node][direction] = 0.;
  }


  void ExplicitDynamics::add(std::unique_ptr<Part> part)
  {
    for (const unsigned int i : part->carried_nodes())
      carried[i] = true;
    if (auto *carrier = dynamic_cast<CarriesBody *>(part.get()))
      {
        carrier_of_body[carrier->body()] = carriers.size();
        carriers.push_back(carrier);
        part_of_carrier.push_back(parts.size());
      }
    first_sum.push_back(rank_sums.size());
    rank_sums.resize(rank_sums.size() + part->n_sums());
    parts.push_back(std::move(part));
    set_node_levels();
  }


  void ExplicitDynamics::attach_contact(Contact &c)
  {
    contact = &c;
  }


  std::vector<double> ExplicitDynamics::free_inverse_masses() const
  {
    std::vector<double> inverse(mesh.nodes.size(), 0.);
    for (unsigned int i = 0; i < inverse.size(); ++i)
      if (!fixed[i] && !carried[i] && true_mass[i] > 0.) // hanging nodes have none
        inverse[i] =
          1. / (parameters.density_scale * true_mass[i] + (added_mass.empty() ? 0. : added_mass[i]));
    return inverse;
  }


  void ExplicitDynamics::set_rigid_velocities()
  {
    const double step = parameters.courant_number * critical_time_step();
    for (const CarriesBody *carrier : carriers)
      carrier->set_velocities(
        state, [&](const unsigned int i) { return 0.5 * std::ldexp(step, levels.of_node[i]); });
  }


  std::vector<MovingLoad> ExplicitDynamics::loads_of_carriers() const
  {
    std::vector<MovingLoad> loads;
    for (const CarriesBody *carrier : carriers)
      loads.push_back(carrier->load());
    return loads;
  }


  void ExplicitDynamics::set_bending_velocities()
  {
    const auto constrain = [&](NodalField &v) {
      hold_guided_nodes(v);
      mesh.distribute_hanging_nodes(v.data());
    };
    const std::vector<MovingLoad> loads = loads_of_carriers();
    for (const auto &part : parts)
      if (const std::vector<double> up = part->follow(state, loads, constrain); !up.empty())
        for (std::size_t k = 0; k < carriers.size(); ++k)
          carriers[k]->rise(up[k]);
  }


  void ExplicitDynamics::set_inertia()
  {
    levels.slow_shares_known = false;
    state.time_step          = parameters.courant_number * critical_time_step();
    inverse_mass             = free_inverse_masses();
    loads_of_shared.clear();
    for (const unsigned int i : mesh.shared_nodes.nodes())
      loads_of_shared.push_back({i, levels.of_node[i], Vector3{}});
    if (contact)
      {
        contact->set_inverse_masses(inverse_mass);
        contact->refresh(state.positions().data(), state.v.data(), state.time_step);
        matched_surface.select(contact->nodes_near());
      }
    hold_guided_nodes(state.v);
  }


  void ExplicitDynamics::start()
  {
    for (const auto &part : parts)
      part->start();
    set_inertia();
    prepare_step();
    totals                  = LedgerTotals();
    const Energies at_start = energies(cell_forces());
    start_kinetic           = at_start.kinetic;
    start_potential         = at_start.potential;
    start_strain            = at_start.strain;
    start_external_work     = sum_of_parts([](const Part &part) { return part.external_work(); });
    start_gross_work        = sum_of_parts([](const Part &part) { return part.gross_work(); });
    start_springs           = sum_of_parts([](const Part &part) { return part.spring_energy(); });
    start_dissipated        = sum_of_parts([](const Part &part) { return part.dissipated(); });
    last_damping_step       = state.n_steps;
    last_damping_power      = 0.;
    damping_is_sampled      = false;
  }


  void ExplicitDynamics::serialize_parts(Archive &archive)
  {
    for (const auto &part : parts)
      part->serialize(archive);
  }


  void ExplicitDynamics::serialize(Archive &archive)
  {
    archive.same(critical_step, highest_of_step, bound_found_stable);
    serialize_parts(archive);
    if (archive.restores())
      set_inertia(); // before the contact, as it looks for the pairs that may touch
    archive.same(start_kinetic, start_potential, start_strain, start_external_work, start_gross_work,
                 start_springs, start_dissipated);
    totals.serialize(archive);
    archive.same(last_damping_power, last_damping_step, damping_is_sampled);
    archive.largest(spent.internal_forces, spent.contact, spent.search, spent.communication, spent.nodes);
    state.serialize(archive, mesh, solid, parameters.damping_steps * state.time_step);
    levels.serialize(archive, mesh);
    if (contact)
      {
        contact->serialize(archive);
        matched_surface.serialize(archive);
      }
    if (archive.restores())
      prepare_step();
  }


  void ExplicitDynamics::check_stability() const
  {
    double       fastest = 0.; // squared
    unsigned int worst   = 0;
    for (unsigned int i = 0; i < state.v.size(); ++i)
      if (const double speed2 = dot(state.v[i], state.v[i]); !(speed2 <= fastest)) // NaN is found as well
        {
          fastest = speed2 == speed2 ? speed2 : std::numeric_limits<double>::max();
          worst   = i;
        }
    const double largest = dealii::Utilities::MPI::max(fastest, mesh.comm);
    if (largest <= parameters.largest_speed * parameters.largest_speed)
      return;
    const bool             is_here = fastest == largest && !state.v.empty();
    const dealii::Point<3> place   = is_here ? mesh.nodes[worst] : dealii::Point<3>();
    throw WentWrong(
      format("unstable: nodes move faster than %g m/s after %llu steps, most of all that which was ",
             parameters.largest_speed, (unsigned long long)state.n_steps) +
      place_of_worst(is_here, place, is_here ? mesh.node_bodies[worst] : 0) +
      format("; lower 'Time stepping/Courant number' (%f, at most 1)", parameters.courant_number));
  }
} // namespace tread
