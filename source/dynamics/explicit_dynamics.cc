// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

namespace tread
{
  namespace
  {
    /// Damping power is sampled every so many steps: two force evaluations more each time.
    constexpr std::uint64_t steps_between_damping_samples = 50;

    /// Part of the way that the steady share of slow cells' forces goes to their present value when these are
    /// evaluated.
    constexpr double follow = 0.5;

    class Stopwatch
    {
    public:
      double lap()
      {
        const auto   now     = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last).count();
        last                 = now;
        return seconds;
      }

    private:
      std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();
    };
  } // namespace


  double EnergyLedger::residual_share() const
  {
    return gross_work > 0. ? residual() / gross_work : 0.;
  }


  ExplicitDynamics::ExplicitDynamics(const Mesh               &mesh,
                                     const Solid              &solid,
                                     const DynamicsParameters &parameters)
    : x(mesh.nodes.size())
    , v(mesh.nodes.size(), Row{})
    , history(solid.virgin())
    , mesh(mesh)
    , solid(solid)
    , parameters(parameters)
    , force(mesh.nodes.size(), Row{})
    , x_damped(mesh.nodes.size())
    , true_mass(mesh.nodes.size())
    , inverse_mass(mesh.nodes.size(), 0.)
    , fixed(mesh.nodes.size(), false)
    , carried(mesh.nodes.size(), false)
    , on_wheel(mesh.nodes.size(), false)
  {
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      x[i] = Row{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.};
    NodalField mass(mesh.nodes.size(), Row{});
    const auto cell_masses = solid.cell_masses(mesh);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int a = 0; a < 8; ++a)
        mass[mesh.cells[c].nodes[a]][0] += cell_masses[c][a];
    mesh.condense_hanging_nodes(mass.data());
    mesh.shared_nodes.sum(mass.data());
    for (unsigned int i = 0; i < mass.size(); ++i)
      true_mass[i] = mass[i][0];
    // A hanging node is condensed on each rank that holds cells at it, so its sum is zero everywhere.
    set_node_levels();
  }


  void ExplicitDynamics::set_node_levels()
  {
    unsigned int max_level = 0;
    for (const unsigned int level : solid.cell_levels())
      max_level = std::max(max_level, level);
    max_level = dealii::Utilities::MPI::max(max_level, mesh.comm);
    level_of_node.assign(x.size(), max_level);
    for (unsigned int level = max_level; level-- > 0;)
      {
        // A node moves with its fastest cell on any rank, a parent with those of its hanging nodes, too.
        NodalField marks(x.size(), Row{});
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          if (solid.cell_levels()[c] == level)
            for (const unsigned int i : mesh.cells[c].nodes)
              marks[i][0] = 1.;
        if (level == 0)
          {
            for (const Mesh::Face &face : mesh.faces)
              if (face.boundary == Boundary::contact)
                for (const unsigned int i : face.nodes)
                  marks[i][0] = 1.;
            for (const unsigned int i : hub_nodes)
              marks[i][0] = 1.;
            if (supports)
              for (const unsigned int i : supports->nodes())
                marks[i][0] = 1.;
          }
        mesh.condense_hanging_nodes(marks.data());
        mesh.shared_nodes.sum(marks.data());
        for (unsigned int i = 0; i < marks.size(); ++i)
          if (marks[i][0] > 0.)
            level_of_node[i] = level;
      }
    // Forces on hanging nodes are their parents'.
    std::vector<const Mesh::HangingNode *> hangs(x.size(), nullptr);
    for (const Mesh::HangingNode &h : mesh.hanging_nodes)
      hangs[h.node] = &h;
    hanging.assign(max_level + 1, {});
    hanging_at_contact.clear();
    for (unsigned int body = 0; body < mesh.body_names.size(); ++body)
      for (const unsigned int i : boundary_nodes(body, Boundary::contact))
        if (hangs[i])
          hanging_at_contact.push_back(*hangs[i]);
    std::vector<char> is_placed(x.size(), false);
    for (unsigned int level = 0; level <= max_level; ++level)
      {
        std::vector<char> is_loaded(x.size(), false);
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          if (solid.cell_levels()[c] == level)
            for (const unsigned int i : mesh.cells[c].nodes)
              if (hangs[i] && !is_loaded[i])
                {
                  hanging[level].loaded.push_back(*hangs[i]);
                  is_loaded[i] = true;
                  if (!is_placed[i])
                    hanging[level].placed.push_back(*hangs[i]);
                  is_placed[i] = true;
                }
      }
    slow_shares.assign(max_level + 1, {});
    for (unsigned int level = 1; level <= max_level; ++level)
      {
        std::vector<char> seen(x.size(), false);
        const auto        add = [&](const unsigned int i) {
          if (level_of_node[i] < level && !seen[i])
            slow_shares[level].push_back(
                     {i, level_of_node[i], std::ldexp(1., level_of_node[i]), Row{}, Row{}});
          seen[i] = true;
        };
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          if (solid.cell_levels()[c] == level)
            for (const unsigned int i : mesh.cells[c].nodes)
              {
                if (!hangs[i])
                  add(i);
                else
                  for (const unsigned int parent : hangs[i]->parents)
                    add(parent);
              }
      }
    nodes_of_level.assign(max_level + 1, Runs());
    for (unsigned int begin = 0; begin < level_of_node.size();)
      {
        unsigned int end = begin + 1;
        while (end < level_of_node.size() && level_of_node[end] == level_of_node[begin] &&
               on_wheel[end] == on_wheel[begin])
          ++end;
        nodes_of_level[level_of_node[begin]].push_back({begin, end, bool(on_wheel[begin])});
        begin = end;
      }
  }


  double ExplicitDynamics::ideal_gain_of_levels(const unsigned int largest) const
  {
    double updates = 0.;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      updates += std::ldexp(1., -static_cast<int>(solid.level_up_to(largest, c)));
    return mesh.n_global_cells / dealii::Utilities::MPI::sum(updates, mesh.comm);
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


  std::vector<unsigned int> ExplicitDynamics::boundary_nodes(const unsigned int body,
                                                             const Boundary     boundary) const
  {
    // A rank may hold a node of the boundary without holding a face of it: ask all through the sum.
    NodalField marks(mesh.nodes.size(), Row{});
    for (const Mesh::Face &face : mesh.faces)
      if (face.body == body && face.boundary == boundary)
        for (const unsigned int i : face.nodes)
          marks[i][0] = 1.;
    mesh.shared_nodes.sum(marks.data());
    std::vector<unsigned int> nodes;
    for (unsigned int i = 0; i < marks.size(); ++i)
      if (marks[i][0] > 0.)
        nodes.push_back(i);
    return nodes;
  }


  void ExplicitDynamics::attach_hub(WheelHub          &wheel_hub,
                                    const unsigned int body,
                                    const double       angular_velocity)
  {
    hub                      = &wheel_hub;
    nominal_angular_velocity = angular_velocity;
    for (unsigned int i = 0; i < on_wheel.size(); ++i)
      on_wheel[i] = mesh.node_bodies[i] == body;
    hub_nodes = support_nodes(body);
    hub_reference.clear();
    for (const unsigned int i : hub_nodes)
      {
        carried[i] = true;
        hub_reference.push_back(x[i] - Row{hub->motion.x, 0., hub->motion.z, 0.});
      }
    rank_sums.resize(4 + (supports ? supports->n_points() : 0));
    set_node_levels(); // the hub moves in every step

    std::vector<double> sums(4, 0.);
    for (unsigned int i = 0; i < x.size(); ++i)
      if (on_wheel[i] && !carried[i] && mesh.shared_nodes.is_owned(i))
        {
          const double rx = x[i][0] - hub->motion.x, rz = x[i][2] - hub->motion.z;
          sums[0] += true_mass[i];
          sums[1] += true_mass[i] * (rx * rx + rz * rz);
          sums[2] += true_mass[i] * rx;
          sums[3] += true_mass[i] * rz;
        }
    dealii::Utilities::MPI::sum(sums, mesh.comm, sums);
    hub->take_out(sums[0], sums[1], sums[2], sums[3]);
  }


  void ExplicitDynamics::attach_contact(Contact &c)
  {
    contact = &c;
  }


  void ExplicitDynamics::attach_supports(Supports &s, const ElasticMaterial &rail_material)
  {
    supports = &s;
    s.set_gravity(parameters.gravity);
    rail_beam = std::make_unique<RailBeam>(mesh, solid, s, rail_material);
    rank_sums.resize(4 + s.n_points());
    set_node_levels();
  }


  std::vector<double> ExplicitDynamics::free_inverse_masses() const
  {
    std::vector<double> inverse(mesh.nodes.size(), 0.);
    for (unsigned int i = 0; i < inverse.size(); ++i)
      if (!fixed[i] && !carried[i] && true_mass[i] > 0.) // hanging nodes have none
        inverse[i] = 1. / (parameters.density_scale * true_mass[i]);
    return inverse;
  }


  double ExplicitDynamics::critical_time_step() const
  {
    if (critical_step > 0.)
      return critical_step;
    double highest = 0.;
    for (unsigned int level = 0; level <= max_level(); ++level)
      highest = std::max(highest, std::ldexp(highest_frequency(level), level));
    // Three digits, rounded up: the same step on any number of ranks.
    const auto rounded = [](const double value) {
      const double digit = std::pow(10., std::floor(std::log10(value)) - 2.);
      return value > 0. ? digit * std::ceil(value / digit) : 0.;
    };
    // Forces at x + beta v of half a step back, dampers with v of half a step back: dt^2 K + 2 dt C <= 4 for
    // the largest eigenvalues of M^-1 K (1 + 2 beta/dt) and M^-1 C, or their bounds by row sums.
    highest  = rounded(highest);
    double K = highest * highest * (1. + 2. * parameters.damping_steps), C = 0.;
    if (supports)
      {
        const std::vector<double> inverse = free_inverse_masses();
        NodalField                rows(x.size(), Row{});
        supports->add_row_sums(rows.data());
        mesh.shared_nodes.sum(rows.data());
        double of_springs, of_dampers;
        supports->sleeper_row_sums(of_springs, of_dampers);
        for (unsigned int i = 0; i < rows.size(); ++i)
          {
            of_springs = std::max(of_springs, inverse[i] * rows[i][0]);
            of_dampers = std::max(of_dampers, inverse[i] * rows[i][1]);
          }
        K += rounded(dealii::Utilities::MPI::max(of_springs, mesh.comm));
        C = rounded(dealii::Utilities::MPI::max(of_dampers, mesh.comm));
      }
    critical_step = 4. / (C + std::sqrt(C * C + 4. * K));
    return critical_step;
  }


  double ExplicitDynamics::highest_frequency(const unsigned int first_level) const
  {
    using dealii::Utilities::MPI::max;
    using dealii::Utilities::MPI::sum;
    double bound = 0.;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (solid.cell_levels()[c] >= first_level)
        bound = std::max(bound, solid.cell_frequencies()[c]);
    bound = max(bound, mesh.comm);

    // No cell can vibrate as fast in the mesh as it would alone: the power method on M^-1 K finds how fast
    // the mesh does. Its Rayleigh quotient comes from below, hence the margin; the cells' bound stays the
    // limit.
    constexpr unsigned int    iterations = 80;
    constexpr double          margin     = 1.03;
    const std::vector<double> inverse    = free_inverse_masses();
    NodalField mode(x.size(), Row{}), reference(x.size()), moved(x.size()), at_rest(x.size(), Row{}),
      f(x.size());
    // Not where the nodes are now, so that a run that resumes has the same step.
    for (unsigned int i = 0; i < x.size(); ++i)
      reference[i] = Row{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.};
    for (unsigned int i = 0; i < mode.size(); ++i)
      for (unsigned int d = 0; d < 3; ++d)
        {
          // Any numbers will do that depend on the place alone, not on the rank.
          const double wave =
            1e4 *
            std::sin(1e5 * (mesh.nodes[i][0] + 1.7 * mesh.nodes[i][1] + 2.3 * mesh.nodes[i][2]) + 2. * d);
          mode[i][d] = inverse[i] > 0. ? wave - std::floor(wave) - 0.5 : 0.;
        }
    double highest = 0.;
    for (unsigned int k = 0; k < iterations; ++k)
      {
        double inertia = 0., largest = 0.;
        for (unsigned int i = 0; i < mode.size(); ++i)
          if (inverse[i] > 0.)
            largest = std::max(largest, dot(mode[i], mode[i]));
        const double scale = 1e-9 / std::sqrt(max(largest, mesh.comm)); // m: small against any cell
        for (unsigned int i = 0; i < mode.size(); ++i)
          {
            mode[i] *= scale;
            if (inverse[i] > 0. && mesh.shared_nodes.is_owned(i))
              inertia += dot(mode[i], mode[i]) / inverse[i];
          }
        mesh.distribute_hanging_nodes(mode.data());
        for (unsigned int i = 0; i < mode.size(); ++i)
          {
            moved[i] = reference[i] + mode[i];
            f[i]     = Row{};
          }
        solid.add_internal_forces(moved.data(), at_rest.data(), f.data(), Levels{first_level});
        mesh.condense_hanging_nodes(f.data());
        mesh.shared_nodes.sum(f.data());
        double stiffness = 0.;
        for (unsigned int i = 0; i < mode.size(); ++i)
          {
            const Row change = -f[i]; // the reference is free of stress
            if (inverse[i] > 0. && mesh.shared_nodes.is_owned(i))
              stiffness += dot(mode[i], change);
            mode[i] = inverse[i] * change;
          }
        highest = std::sqrt(std::max(0., sum(stiffness, mesh.comm) / sum(inertia, mesh.comm)));
      }
    // Bulk viscosity damps high modes, which shortens the stable step: the cells' bound leaves room for it.
    return solid.needs_velocity() ? bound : std::min(bound, margin * highest);
  }


  void ExplicitDynamics::set_wheel_velocities()
  {
    // Half a step back, as velocities are: the centripetal acceleration in that time is no small thing.
    const Row    of_axle = hub->velocity_at(Row{hub->motion.x, 0., hub->motion.z, 0.});
    const double step    = parameters.courant_number * critical_time_step();
    for (unsigned int i = 0; i < x.size(); ++i)
      if (on_wheel[i])
        {
          const double back = 0.5 * std::ldexp(step, level_of_node[i]);
          v[i]              = hub->velocity_at(x[i] - back * (hub->velocity_at(x[i]) - of_axle));
        }
  }


  void ExplicitDynamics::set_track_velocities()
  {
    // How the deflection changes while the load moves by a small way, over the time that takes.
    constexpr double      way = 1e-3; // m
    const double          x = hub->motion.x, load = hub->static_force();
    const RailBeam::Field before = rail_beam->balance(x - way, load),
                          after  = rail_beam->balance(x + way, load);
    const double rate            = 0.5 * hub->motion.velocity_x / way;
    rail_beam->add(after, rate, v.data());
    rail_beam->add(before, -rate, v.data());
    hub->motion.velocity_z +=
      rate * (after.rail.deflection(x + way) - before.rail.deflection(x - way)).real();
    hold_guided_nodes(v);
    mesh.distribute_hanging_nodes(v.data());
    std::vector<double> sleepers(after.sleepers.size());
    for (unsigned int s = 0; s < sleepers.size(); ++s)
      sleepers[s] = rate * (after.sleepers[s] - before.sleepers[s]);
    supports->set_velocities(v.data(), sleepers);
  }


  inline Row ExplicitDynamics::body_load(const unsigned int i, const double factor, BodyLoads &sums) const
  {
    if (inverse_mass[i] == 0.)
      return Row{};
    const double here  = factor * parameters.density_scale * true_mass[i];
    const double owned = mesh.shared_nodes.is_owned(i) ? here : 0.;
    Row          acceleration{};
    if (on_wheel[i])
      {
        const Row arm    = x[i] - Row{hub->motion.x, 0., hub->motion.z, 0.};
        const Row inward = -compensation() * Row{1., 0., 1., 0.} * arm;
        acceleration += inward;
        sums.compensation += owned * inward;
      }
    if (parameters.mass_damping > 0.)
      {
        // Against what moves on top of the rigid motion. The hub takes the reaction.
        const Row relative = on_wheel[i] ? v[i] - hub->velocity_at(x[i]) : v[i];
        const Row drag     = parameters.mass_damping * relative;
        const Row reaction = owned * drag;
        acceleration -= drag;
        sums.drag_power += dot(reaction, relative);
        if (on_wheel[i])
          {
            const Row arm = x[i] - Row{hub->motion.x, 0., hub->motion.z, 0.};
            sums.drag += reaction;
            sums.drag_moment += arm[2] * reaction[0] - arm[0] * reaction[2];
          }
      }
    return here * acceleration;
  }


  inline Row ExplicitDynamics::first_force(const unsigned int i, const double factor, const bool with_loads)
  {
    const Row weight{0., 0., inverse_mass[i] > 0. ? -parameters.gravity * factor * true_mass[i] : 0., 0.};
    return with_loads ? weight + body_load(i, factor, next_loads) : weight;
  }


  void ExplicitDynamics::keep_loads_of_shared(const unsigned int due)
  {
    for (LoadOfShared &shared : loads_of_shared)
      if (shared.level <= due)
        {
          shared.load        = force[shared.node];
          force[shared.node] = Row{};
        }
  }


  void ExplicitDynamics::set_inertia()
  {
    slow_shares_known = false;
    time_step         = parameters.courant_number * critical_time_step();
    inverse_mass      = free_inverse_masses();
    loads_of_shared.clear();
    for (const unsigned int i : mesh.shared_nodes.nodes())
      loads_of_shared.push_back({i, level_of_node[i], Row{}});
    if (contact)
      {
        contact->set_inverse_masses(inverse_mass);
        contact->refresh(x.data(), v.data(), time_step);
      }
    hold_guided_nodes(v);
    prepare_step();
  }


  void ExplicitDynamics::prepare_step()
  {
    const double beta = parameters.damping_steps * time_step;
    for (unsigned int i = 0; i < x.size(); ++i)
      x_damped[i] = x[i] + beta * v[i];
    mesh.distribute_hanging_nodes(x_damped.data());
    next_loads = BodyLoads();
    for (unsigned int level = 0; level <= max_level(); ++level)
      for (const Run &run : nodes_of_level[level])
        for (unsigned int i = run.begin; i < run.end; ++i)
          force[i] = first_force(i, std::ldexp(1., level), level == 0 && has_body_loads(run));
    keep_loads_of_shared(max_level());
  }


  void ExplicitDynamics::start()
  {
    if (hub)
      nominal_angular_velocity = hub->motion.angular_velocity;
    set_inertia();
    totals             = EnergyLedger();
    start_kinetic      = kinetic_energy();
    start_potential    = body_potential();
    start_strain       = strain_energy();
    start_hub_work     = hub ? hub->external_work() : 0.;
    start_hub_gross    = hub ? hub->gross_work() : 0.;
    start_springs      = supports ? supports->spring_energy() : 0.;
    start_dissipated   = supports ? supports->dissipated() : 0.;
    last_damping_step  = n_steps;
    last_damping_power = 0.;
    sample_damping();
  }


  void ExplicitDynamics::add_hub_sums(std::vector<double> &sums) const
  {
    std::fill(sums.begin(), sums.end(), 0.);
    for (const unsigned int i : hub_nodes)
      if (mesh.shared_nodes.is_owned(i))
        {
          const double rx = x[i][0] - hub->motion.x, rz = x[i][2] - hub->motion.z;
          for (unsigned int d = 0; d < 3; ++d)
            sums[d] += force[i][d];
          sums[3] += rz * force[i][0] - rx * force[i][2];
        }
  }


  void ExplicitDynamics::move_hub_nodes()
  {
    for (unsigned int k = 0; k < hub_nodes.size(); ++k)
      {
        const unsigned int i = hub_nodes[k];
        x[i]                 = hub->position_of(hub_reference[k]);
        v[i]                 = hub->velocity_at(x[i]);
      }
  }


  void ExplicitDynamics::add_forces_due(const unsigned int due)
  {
    totals.plastic +=
      solid.update_internal_forces(x_damped.data(), v.data(), force.data(), history, Levels{0, 0, true});
    Mesh::condense(hanging[0].loaded, force.data());
    for (unsigned int level = 1; level <= max_level(); ++level)
      {
        const double factor = std::ldexp(1., level);
        if (level <= due)
          {
            for (SlowShare &share : slow_shares[level])
              share.before = force[share.node];
            solid.add_elastic_forces(x_damped.data(), v.data(), force.data(), Levels{level, level, true});
            Mesh::condense(hanging[level].loaded, force.data());
            for (SlowShare &share : slow_shares[level])
              {
                const Row now    = (1. / factor) * (force[share.node] - share.before);
                const Row change = slow_shares_known ? follow * (now - share.steady) : now;
                share.steady += change;
                force[share.node] -= factor * share.steady;
                // The steady part acts on average half of (factor - own) steps late: what that takes from a
                // force that changes is given at once, or motion would be fed with energy.
                if (slow_shares_known)
                  force[share.node] += 0.5 * (factor - share.factor) * change;
              }
          }
        for (const SlowShare &share : slow_shares[level])
          if (share.level <= due)
            force[share.node] += share.factor * share.steady;
      }
    slow_shares_known = true;
  }


  unsigned int ExplicitDynamics::level_due() const
  {
    unsigned int level = max_level();
    while (n_steps % (std::uint64_t(1) << level) != 0)
      --level;
    return level;
  }


  void ExplicitDynamics::place_hanging_nodes()
  {
    if (synchronised())
      {
        for (Row *field : {v.data(), x.data(), x_damped.data()})
          mesh.distribute_hanging_nodes(field);
        return;
      }
    for (unsigned int level = 0; level <= level_due(); ++level)
      {
        Mesh::distribute(hanging[level].placed, x_damped.data());
        if (solid.needs_velocity())
          Mesh::distribute(hanging[level].placed, v.data());
      }
    Mesh::distribute(hanging_at_contact, x.data());
    Mesh::distribute(hanging_at_contact, v.data());
  }


  void ExplicitDynamics::step()
  {
    Stopwatch watch;
    if (n_steps >= last_damping_step + steps_between_damping_samples && synchronised())
      sample_damping();
    const unsigned int due = level_due();
    add_forces_due(due);
    if (supports)
      supports->add_forces(force.data());
    times.internal_forces += watch.lap();
    mesh.shared_nodes.sum(force.data());
    // Not before: the sums of nodes that are not due must stay zero.
    for (const LoadOfShared &shared : loads_of_shared)
      if (shared.level <= due)
        force[shared.node] += shared.load;
    times.communication += watch.lap();

    // What acts on the nodes from outside.
    BodyLoads  body_loads = next_loads;
    const bool loaded     = !external_force.empty();
    if (loaded)
      for (unsigned int level = 0; level <= due; ++level)
        for (const Run &run : nodes_of_level[level])
          for (unsigned int i = run.begin; i < run.end; ++i)
            force[i] += std::ldexp(1., level) * external_force[i];
    if (has_body_loads())
      for (unsigned int level = 1; level <= due; ++level)
        for (const Run &run : nodes_of_level[level])
          if (has_body_loads(run))
            for (unsigned int i = run.begin; i < run.end; ++i)
              force[i] += body_load(i, std::ldexp(1., level), body_loads);
    totals.damping += time_step * body_loads.drag_power;
    hold_guided_nodes(force);

    if (hub)
      {
        add_hub_sums(rank_sums);
        for (unsigned int d = 0; d < 3; ++d)
          rank_sums[d] += body_loads.drag[d];
        rank_sums[3] += body_loads.drag_moment;
        // The compensation acts on mass that is not there, so the axle feels nothing of it. Its work with the
        // motion about the axle is a potential, that with the axle's motion is summed here.
        const double work = time_step * (body_loads.compensation[0] * hub->motion.velocity_x +
                                         body_loads.compensation[2] * hub->motion.velocity_z);
        totals.external_work += work;
        totals.gross_work += std::abs(work);
      }
    else
      std::fill(rank_sums.begin(), rank_sums.end(), 0.);
    if (supports)
      supports->predict(v.data(), force.data(), inverse_mass, time_step, rank_sums.data() + 4);
    times.nodes += watch.lap();

    if (contact)
      {
        if (contact->refresh_due())
          {
            contact->refresh(x.data(), v.data(), time_step);
            times.search += watch.lap();
          }
        contact->predict(v.data(), force.data(), time_step, rank_sums);
        times.communication += watch.lap();
        contact->solve(time_step, force.data());
        const ContactWork work = contact->last_work();
        totals.friction += work.friction;
        totals.contact += work.normal;
        times.contact += watch.lap();
      }
    else if (!rank_sums.empty())
      dealii::Utilities::MPI::sum(rank_sums, mesh.comm, rank_sums);
    if (supports)
      supports->advance(rank_sums.data() + 4, time_step);
    if (hub)
      hub->advance(Row{rank_sums[0], rank_sums[1], rank_sums[2], 0.}, rank_sums[3], time_step);

    const double beta = parameters.damping_steps * time_step;
    double       work = 0., gross = 0.;
    next_loads = BodyLoads();
    for (unsigned int level = 0; level <= due; ++level)
      {
        const double factor = std::ldexp(1., level);
        for (const Run &run : nodes_of_level[level])
          {
            const bool has_loads = level == 0 && has_body_loads(run);
            for (unsigned int i = run.begin; i < run.end; ++i)
              {
                const Row velocity = v[i] + (time_step * inverse_mass[i]) * force[i];
                if (loaded)
                  {
                    const double w = 0.5 * factor * time_step * dot(external_force[i], velocity + v[i]);
                    if (mesh.shared_nodes.is_owned(i))
                      {
                        work += w;
                        gross += std::abs(w);
                      }
                  }
                v[i] = velocity;
                x[i] += factor * time_step * velocity;
                x_damped[i] = x[i] + beta * velocity;
                force[i]    = first_force(i, factor, has_loads);
              }
          }
      }
    keep_loads_of_shared(due);
    totals.external_work += work;
    totals.gross_work += gross;
    if (hub)
      {
        move_hub_nodes();
        for (const unsigned int i : hub_nodes)
          x_damped[i] = x[i] + beta * v[i];
      }
    time += time_step;
    ++n_steps;
    place_hanging_nodes();
    times.nodes += watch.lap();
  }


  void ExplicitDynamics::sample_damping()
  {
    // Power of the damping forces, v . (f(x) - f(x + beta v)), trapezoid between samples.
    double power = 0.;
    if (parameters.damping_steps > 0. || solid.needs_velocity())
      {
        NodalField with(x.size(), Row{}), without(x.size(), Row{}), no_velocity;
        solid.add_internal_forces(x_damped.data(), v.data(), with.data(), history);
        if (solid.needs_velocity())
          no_velocity.assign(x.size(), Row{});
        solid.add_internal_forces(x.data(), no_velocity.data(), without.data(), history);
        for (unsigned int i = 0; i < x.size(); ++i)
          power += dot(v[i], without[i] - with[i]);
      }
    totals.damping += 0.5 * (power + last_damping_power) * time_step * (n_steps - last_damping_step);
    last_damping_power = power;
    last_damping_step  = n_steps;
  }


  double ExplicitDynamics::kinetic_energy() const
  {
    // The product of the velocities half a step before and after now: central differences keep its sum with
    // the strain energy. What is not the cells' adds as much to the work.
    NodalField cell_force(x.size(), Row{});
    solid.add_internal_forces(x.data(), v.data(), cell_force.data(), history);
    mesh.condense_hanging_nodes(cell_force.data());
    if (supports)
      supports->add_spring_forces(cell_force.data());
    double energy = 0.;
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        energy += 0.5 * std::ldexp(time_step, level_of_node[i]) * dot(cell_force[i], v[i]);
        if (inverse_mass[i] > 0. && mesh.shared_nodes.is_owned(i))
          energy += 0.5 / inverse_mass[i] * dot(v[i], v[i]);
      }
    energy = dealii::Utilities::MPI::sum(energy, mesh.comm);
    if (supports)
      energy += supports->sleeper_kinetic_energy(time_step);
    return hub ? energy + hub->kinetic_energy(0.5 * time_step) : energy;
  }


  StrainEnergy ExplicitDynamics::strain_energy() const
  {
    StrainEnergy energy = solid.strain_energy(x.data(), history);
    energy.strain       = dealii::Utilities::MPI::sum(energy.strain, mesh.comm);
    energy.hourglass    = dealii::Utilities::MPI::sum(energy.hourglass, mesh.comm);
    return energy;
  }


  double ExplicitDynamics::body_potential() const
  {
    // At the instant of the velocities, half a step back: so far work is counted.
    const double compensation =
      (1. - 1. / parameters.density_scale) * nominal_angular_velocity * nominal_angular_velocity;
    double potential = 0.;
    for (unsigned int i = 0; i < x.size(); ++i)
      if (inverse_mass[i] > 0. && mesh.shared_nodes.is_owned(i))
        {
          const double back     = 0.5 * std::ldexp(time_step, level_of_node[i]);
          const Row    position = x[i] - back * v[i];
          potential += true_mass[i] * parameters.gravity * position[2];
          if (on_wheel[i])
            {
              const double rx = position[0] - hub->motion.x + back * hub->motion.velocity_x,
                           rz = position[2] - hub->motion.z + back * hub->motion.velocity_z;
              potential += 0.5 * compensation * parameters.density_scale * true_mass[i] * (rx * rx + rz * rz);
            }
        }
    potential = dealii::Utilities::MPI::sum(potential, mesh.comm);
    return supports ? potential + supports->weight_potential(time_step) : potential;
  }


  EnergyLedger ExplicitDynamics::ledger()
  {
    using dealii::Utilities::MPI::sum;
    sample_damping();
    EnergyLedger now  = totals;
    now.damping       = sum(totals.damping, mesh.comm);
    now.plastic       = sum(totals.plastic, mesh.comm);
    now.external_work = sum(totals.external_work, mesh.comm);
    now.gross_work    = sum(totals.gross_work, mesh.comm);
    const double fall = start_potential - body_potential();
    now.external_work += fall;
    now.gross_work += std::abs(fall);
    if (hub)
      {
        now.external_work += hub->external_work() - start_hub_work;
        now.gross_work += hub->gross_work() - start_hub_gross;
      }
    if (supports)
      {
        now.springs = supports->spring_energy() - start_springs;
        now.damping += supports->dissipated() - start_dissipated;
      }
    now.kinetic               = kinetic_energy() - start_kinetic;
    const StrainEnergy energy = strain_energy();
    now.strain                = energy.strain - start_strain.strain;
    now.hourglass             = energy.hourglass - start_strain.hourglass;
    return now;
  }


  void ExplicitDynamics::check_stability() const
  {
    double fastest = 0.;
    for (const Row &velocity : v)
      {
        const double speed2 = dot(velocity, velocity);
        fastest             = speed2 <= fastest ? fastest : speed2; // NaN is kept
        if (!(speed2 == speed2))
          {
            fastest = 1e300;
            break;
          }
      }
    fastest = std::sqrt(dealii::Utilities::MPI::max(fastest, mesh.comm));
    if (fastest > 1000.)
      throw std::runtime_error("unstable: nodes move faster than 1000 m/s after " + std::to_string(n_steps) +
                               " steps; lower 'Time stepping/Courant number' (" +
                               std::to_string(parameters.courant_number) + ", at most 1)");
  }
} // namespace tread
