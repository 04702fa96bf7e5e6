// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace tread
{
  namespace
  {
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


  ExplicitDynamics::ExplicitDynamics(const Mesh               &mesh,
                                     const Solid              &solid,
                                     const DynamicsParameters &parameters)
    : v(mesh.nodes.size(), Row{})
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
      x_damped[i] = Row{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.};
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
    hub_body                 = body;
    nominal_angular_velocity = angular_velocity;
    for (unsigned int i = 0; i < on_wheel.size(); ++i)
      on_wheel[i] = mesh.node_bodies[i] == body;
    hub_nodes = support_nodes(body);
    hub_reference.clear();
    for (const unsigned int i : hub_nodes)
      {
        carried[i] = true;
        hub_reference.push_back(position(i) - Row{hub->motion.x, 0., hub->motion.z, 0.});
      }
    rank_sums.resize(n_hub_sums + (supports ? supports->n_points() : 0));
    set_node_levels(); // the hub moves in every step

    std::vector<double> sums(4, 0.);
    for (unsigned int i = 0; i < v.size(); ++i)
      if (on_wheel[i] && !carried[i] && mesh.shared_nodes.is_owned(i))
        {
          const Row    x  = position(i);
          const double rx = x[0] - hub->motion.x, rz = x[2] - hub->motion.z;
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
    rank_sums.resize(n_hub_sums + s.n_points());
    set_node_levels();
  }


  void ExplicitDynamics::damp_nodes(const unsigned int                                     body,
                                    const std::function<double(const dealii::Point<3> &)> &rate)
  {
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == body && true_mass[i] > 0.) // hanging nodes have none
        if (const double r = rate(mesh.nodes[i]); r > 0.)
          damped_nodes.push_back({i, r, Row{}});
  }


  void ExplicitDynamics::add_local_damping(const unsigned int due)
  {
    for (DampedNode &damped : damped_nodes)
      if (const unsigned int i = damped.node; level_of_node[i] <= due)
        {
          damped.load =
            -damped.rate * free_mass(i, std::ldexp(parameters.density_scale, level_of_node[i])) * v[i];
          force[i] += damped.load;
        }
  }


  void ExplicitDynamics::count_local_damping(const unsigned int due)
  {
    // The work uses the mean of the velocities before and after the step, as for all prescribed forces.
    for (const DampedNode &damped : damped_nodes)
      if (const unsigned int i = damped.node; level_of_node[i] <= due && mesh.shared_nodes.is_owned(i))
        totals.damping -= time_step * dot(damped.load, v[i] + (0.5 * time_step * inverse_mass[i]) * force[i]);
  }


  std::vector<double> ExplicitDynamics::free_inverse_masses() const
  {
    std::vector<double> inverse(mesh.nodes.size(), 0.);
    for (unsigned int i = 0; i < inverse.size(); ++i)
      if (!fixed[i] && !carried[i] && true_mass[i] > 0.) // hanging nodes have none
        inverse[i] = 1. / (parameters.density_scale * true_mass[i]);
    return inverse;
  }


  void ExplicitDynamics::set_wheel_velocities()
  {
    // Half a step back, as velocities are: the centripetal acceleration in that time is no small thing.
    const Row    of_axle = hub->velocity_at(Row{hub->motion.x, 0., hub->motion.z, 0.});
    const double step    = parameters.courant_number * critical_time_step();
    for (unsigned int i = 0; i < v.size(); ++i)
      if (on_wheel[i])
        {
          const double back = 0.5 * std::ldexp(step, level_of_node[i]);
          const Row    x    = position(i);
          v[i]              = hub->velocity_at(x - back * (hub->velocity_at(x) - of_axle));
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


  template <typename Loop>
  inline void ExplicitDynamics::with_body_loads(const bool   has_loads,
                                                const Run   &run,
                                                const double factor,
                                                BodyLoads   &sums,
                                                const Loop  &loop) const
  {
    if (!has_loads)
      {
        loop([](const unsigned int) { return Row{}; });
        return;
      }
    BodyLoads    of_run;
    const double damping = parameters.mass_damping, scaled = parameters.density_scale * factor;
    if (run.on_wheel)
      {
        const auto  &hub_motion = hub->motion;
        const double omega      = hub_motion.angular_velocity;
        const Row    axle{hub_motion.x, 0., hub_motion.z, 0.},
          velocity{hub_motion.velocity_x, 0., hub_motion.velocity_z, 0.}, spin{omega, 0., -omega, 0.},
          inward = -compensation() * Row{1., 0., 1., 0.};
        loop([&](const unsigned int i) {
          const double mass     = free_mass(i, scaled);
          const Row    arm      = position(i) - axle;
          const Row    swapped  = __builtin_shufflevector(arm, arm, 2, 1, 0, 3);
          const Row    relative = v[i] - velocity - spin * swapped;
          const Row    momentum = mass * relative;
          of_run.arms += mass * arm;
          of_run.momentum += momentum;
          of_run.moments += swapped * momentum;
          of_run.squares += relative * momentum;
          return mass * inward * arm - damping * momentum;
        });
      }
    else
      loop([&](const unsigned int i) {
        const Row momentum = free_mass(i, scaled) * v[i];
        of_run.squares += v[i] * momentum;
        return -damping * momentum;
      });
    if (run.is_owned)
      sums += of_run;
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
        contact->refresh(positions().data(), v.data(), time_step);
      }
    hold_guided_nodes(v);
  }


  NodalField ExplicitDynamics::positions() const
  {
    NodalField x(v.size());
    for (unsigned int i = 0; i < v.size(); ++i)
      x[i] = position(i);
    return x;
  }


  void ExplicitDynamics::set_damping_time(const double beta)
  {
    for (unsigned int i = 0; i < v.size(); ++i)
      x_damped[i] += (beta - damping_time) * v[i];
    damping_time = beta;
  }


  void ExplicitDynamics::prepare_step()
  {
    set_damping_time(parameters.damping_steps * time_step);
    mesh.distribute_hanging_nodes(x_damped.data());
    next_loads = BodyLoads();
    std::fill(force.begin(), force.end(), Row{});
    for (unsigned int level = 0; level <= max_level(); ++level)
      for (const Run &run : nodes_of_level[level])
        {
          const double factor = std::ldexp(1., level);
          with_body_loads(level == 0 && has_body_loads(run), run, factor, next_loads, [&](const auto &load) {
            for (unsigned int i = run.begin; i < run.end; ++i)
              force[i] = weight(i, factor) + load(i);
          });
        }
    keep_loads_of_shared(max_level());
  }


  void ExplicitDynamics::start()
  {
    if (hub)
      nominal_angular_velocity = hub->motion.angular_velocity;
    set_inertia();
    prepare_step();
    totals             = EnergyLedger();
    start_kinetic      = kinetic_energy(cell_forces());
    start_potential    = body_potential();
    start_strain       = strain_energy();
    start_hub_work     = hub ? hub->external_work() : 0.;
    start_hub_gross    = hub ? hub->gross_work() : 0.;
    start_springs      = supports ? supports->spring_energy() : 0.;
    start_dissipated   = supports ? supports->dissipated() : 0.;
    last_damping_step  = n_steps;
    last_damping_power = 0.;
    damping_is_sampled = false;
  }


  void ExplicitDynamics::add_hub_sums(std::vector<double> &sums) const
  {
    std::fill(sums.begin(), sums.end(), 0.);
    for (const unsigned int i : hub_nodes)
      if (mesh.shared_nodes.is_owned(i))
        {
          const Row    x  = position(i);
          const double rx = x[0] - hub->motion.x, rz = x[2] - hub->motion.z;
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
        const Row          x = hub->position_of(hub_reference[k]);
        v[i]                 = hub->velocity_at(x);
        set_position(i, x);
      }
  }


  void ExplicitDynamics::step()
  {
    Stopwatch  watch;
    const bool samples_damping =
      synchronised() &&
      (!damping_is_sampled || n_steps >= last_damping_step + parameters.steps_between_damping_samples);
    std::optional<DampingSample> sample;
    if (samples_damping)
      sample = begin_damping_sample();
    const unsigned int due = level_due();
    add_forces_due(due);
    if (supports)
      supports->add_forces(force.data());
    times.internal_forces += watch.lap();
    mesh.shared_nodes.sum(force.data());
    // These loads are added after the sum, because the sums of nodes that are not due must remain zero.
    for (const LoadOfShared &shared : loads_of_shared)
      if (shared.level <= due)
        force[shared.node] += shared.load;
    times.communication += watch.lap();

    // What acts on the nodes from outside.
    BodyLoads  loads  = next_loads;
    const bool loaded = !external_force.empty();
    if (loaded)
      for (unsigned int level = 0; level <= due; ++level)
        for (const Run &run : nodes_of_level[level])
          for (unsigned int i = run.begin; i < run.end; ++i)
            force[i] += std::ldexp(1., level) * external_force[i];
    for (unsigned int level = 1; level <= due; ++level)
      for (const Run &run : nodes_of_level[level])
        if (has_body_loads(run))
          with_body_loads(true, run, std::ldexp(1., level), loads, [&](const auto &load) {
            for (unsigned int i = run.begin; i < run.end; ++i)
              force[i] += load(i);
          });
    totals.damping += time_step * parameters.mass_damping * dot(loads.squares, Row{1., 1., 1., 0.});
    add_local_damping(due);
    hold_guided_nodes(force);

    if (hub)
      {
        add_hub_sums(rank_sums);
        for (unsigned int d = 0; d < 3; ++d)
          rank_sums[d] += parameters.mass_damping * loads.momentum[d];
        rank_sums[3] += parameters.mass_damping * (loads.moments[0] - loads.moments[2]);
        rank_sums[4] = loads.arms[0];
        rank_sums[5] = loads.arms[2];
      }
    else
      std::fill(rank_sums.begin(), rank_sums.end(), 0.);
    if (supports)
      supports->predict(v.data(), force.data(), inverse_mass, time_step, rank_sums.data() + n_hub_sums);
    times.nodes += watch.lap();

    if (contact)
      {
        if (contact->refresh_due())
          {
            check_stability(); // a search among nodes that fly apart fills the memory
            contact->refresh(positions().data(), v.data(), time_step);
            times.search += watch.lap();
          }
        contact->predict(v.data(), force.data(), time_step, rank_sums);
        times.communication += watch.lap();
        contact->solve(time_step, force.data());
        const ContactWork work = contact->last_work();
        totals.friction += work.friction;
        totals.contact += work.normal + work.adhesion;
        totals.contact_on_nodes += work.on_nodes;
        times.contact += watch.lap();
      }
    else if (!rank_sums.empty())
      dealii::Utilities::MPI::sum(rank_sums, mesh.comm, rank_sums);
    if (supports)
      supports->advance(rank_sums.data() + n_hub_sums, time_step);
    if (hub)
      {
        const WheelHub::Motion before = hub->motion;
        hub->advance(Row{rank_sums[0], rank_sums[1], rank_sums[2], 0.}, rank_sums[3], time_step);
        // The compensation acts on mass that is not there, so the axle feels nothing of it. Its work with the
        // motion about the axle is a potential, that with the axle's mean motion in this step is summed here.
        const double work = -0.5 * time_step * compensation() *
                            (rank_sums[4] * (before.velocity_x + hub->motion.velocity_x) +
                             rank_sums[5] * (before.velocity_z + hub->motion.velocity_z));
        if (dealii::Utilities::MPI::this_mpi_process(mesh.comm) == 0)
          {
            totals.external_work += work;
            totals.gross_work += std::abs(work);
          }
      }

    count_local_damping(due);
    double work = 0., gross = 0.;
    next_loads = BodyLoads();
    for (unsigned int level = 0; level <= due; ++level)
      {
        const double factor = std::ldexp(1., level), way = factor * time_step + damping_time;
        for (const Run &run : nodes_of_level[level])
          {
            const auto advance = [&](const unsigned int i) {
              const Row velocity = v[i] + (time_step * inverse_mass[i]) * force[i];
              if (loaded && run.is_owned)
                {
                  const double w = 0.5 * factor * time_step * dot(external_force[i], velocity + v[i]);
                  work += w;
                  gross += std::abs(w);
                }
              x_damped[i] += way * velocity - damping_time * v[i];
              v[i] = velocity;
            };
            with_body_loads(level == 0 && has_body_loads(run), run, factor, next_loads,
                            [&](const auto &load) {
                              for (unsigned int i = run.begin; i < run.end; ++i)
                                {
                                  advance(i);
                                  force[i] = weight(i, factor) + load(i);
                                }
                            });
          }
      }
    keep_loads_of_shared(due);
    totals.external_work += work;
    totals.gross_work += gross;
    if (hub)
      move_hub_nodes();
    time += time_step;
    ++n_steps;
    place_hanging_nodes();
    if (sample)
      end_damping_sample(*sample);
    times.nodes += watch.lap();
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
