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
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int a = 0; a < 8; ++a)
        mass[mesh.cells[c].nodes[a]][0] += solid.cell_masses()[c][a];
    mesh.condense_hanging_nodes(mass.data());
    mesh.shared_nodes.sum(mass.data());
    for (unsigned int i = 0; i < mass.size(); ++i)
      true_mass[i] = mass[i][0];
    // A hanging node is condensed on each rank that holds cells at it, so its sum is zero everywhere.
  }


  void ExplicitDynamics::fix_nodes(const std::vector<unsigned int> &nodes)
  {
    for (const unsigned int i : nodes)
      fixed[i] = true;
  }


  std::vector<unsigned int> ExplicitDynamics::support_nodes(const unsigned int body) const
  {
    // A rank may hold a support node without holding a support face: ask all through the sum.
    NodalField marks(mesh.nodes.size(), Row{});
    for (const Mesh::Face &face : mesh.faces)
      if (face.body == body && face.boundary == Boundary::support)
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
    hub_sums.resize(4);

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
    using dealii::Utilities::MPI::max;
    using dealii::Utilities::MPI::sum;
    double bound = 0.;
    for (const double frequency : solid.cell_frequencies())
      bound = std::max(bound, frequency);
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
        solid.add_internal_forces(moved.data(), at_rest.data(), f.data());
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
    highest = solid.needs_velocity() ? bound : std::min(bound, margin * highest);
    // Three digits, rounded up: the same step on any number of ranks.
    const double digit = std::pow(10., std::floor(std::log10(highest)) - 2.);
    highest            = digit * std::ceil(highest / digit);
    // With forces at x + beta v of half a step back: dt^2 omega^2 (1 + 2 beta/dt) <= 4.
    critical_step = 2. / (highest * std::sqrt(1. + 2. * parameters.damping_steps));
    return critical_step;
  }


  void ExplicitDynamics::set_wheel_velocities()
  {
    for (unsigned int i = 0; i < x.size(); ++i)
      if (on_wheel[i])
        v[i] = hub->velocity_at(x[i]);
  }


  void ExplicitDynamics::set_inertia()
  {
    time_step    = parameters.courant_number * critical_time_step();
    inverse_mass = free_inverse_masses();
    if (contact)
      {
        contact->set_inverse_masses(inverse_mass);
        contact->refresh(x.data(), v.data(), time_step);
      }
    const double beta = parameters.damping_steps * time_step;
    for (unsigned int i = 0; i < x.size(); ++i)
      x_damped[i] = x[i] + beta * v[i];
  }


  void ExplicitDynamics::start()
  {
    if (hub)
      nominal_angular_velocity = hub->motion.angular_velocity;
    set_inertia();
    totals                     = EnergyLedger();
    start_kinetic              = kinetic_energy();
    const NodalField positions = positions_with_velocities();
    start_potential            = body_potential(positions);
    start_strain               = solid.strain_energy(positions.data(), history);
    start_strain.strain        = dealii::Utilities::MPI::sum(start_strain.strain, mesh.comm);
    start_strain.hourglass     = dealii::Utilities::MPI::sum(start_strain.hourglass, mesh.comm);
    start_hub_work             = hub ? hub->external_work() : 0.;
    start_hub_gross            = hub ? hub->gross_work() : 0.;
    last_damping_step          = n_steps;
    last_damping_power         = 0.;
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


  void ExplicitDynamics::step()
  {
    Stopwatch watch;
    if (n_steps >= last_damping_step + steps_between_damping_samples)
      sample_damping();
    totals.plastic += solid.update_internal_forces(x_damped.data(), v.data(), force.data(), history);
    mesh.condense_hanging_nodes(force.data());
    times.internal_forces += watch.lap();
    mesh.shared_nodes.sum(force.data());
    times.communication += watch.lap();

    // What acts on the nodes from outside. Weight and the compensation of the centrifugal force of
    // scaled density are accelerations: weight / inertia, and the share of inertia that is not there.
    const double weight_acceleration = -parameters.gravity / parameters.density_scale;
    const double compensation =
      (1. - 1. / parameters.density_scale) * nominal_angular_velocity * nominal_angular_velocity;
    const Row  axle    = hub ? Row{hub->motion.x, 0., hub->motion.z, 0.} : Row{};
    const Row  keep_xz = {1., 0., 1., 0.};
    Row        compensation_sum{};
    const bool loaded      = !external_force.empty();
    const bool accelerated = parameters.gravity != 0. || compensation != 0.;
    if (loaded)
      for (unsigned int i = 0; i < force.size(); ++i)
        force[i] += external_force[i];
    if (accelerated)
      for (unsigned int i = 0; i < force.size(); ++i)
        if (inverse_mass[i] > 0.)
          {
            Row acceleration = Row{0., 0., weight_acceleration, 0.};
            if (on_wheel[i] && compensation > 0.)
              {
                const Row inward = -compensation * keep_xz * (x[i] - axle);
                acceleration += inward;
                if (mesh.shared_nodes.is_owned(i))
                  compensation_sum += (1. / inverse_mass[i]) * inward;
              }
            force[i] += (1. / inverse_mass[i]) * acceleration;
          }

    if (hub)
      {
        add_hub_sums(hub_sums);
        // The compensation acts on mass that is not there, so the axle feels nothing of it. Its work with the
        // motion about the axle is a potential, that with the axle's motion is summed here.
        const double work = time_step * (compensation_sum[0] * hub->motion.velocity_x +
                                         compensation_sum[2] * hub->motion.velocity_z);
        totals.external_work += work;
        totals.gross_work += std::abs(work);
      }
    times.nodes += watch.lap();

    if (contact)
      {
        if (contact->refresh_due())
          {
            contact->refresh(x.data(), v.data(), time_step);
            times.search += watch.lap();
          }
        contact->predict(v.data(), force.data(), time_step, hub_sums);
        times.communication += watch.lap();
        contact->solve(time_step, force.data());
        const ContactWork work = contact->last_work();
        totals.friction += work.friction;
        totals.contact += work.normal;
        times.contact += watch.lap();
      }
    else if (hub)
      dealii::Utilities::MPI::sum(hub_sums, mesh.comm, hub_sums);
    if (hub)
      hub->advance(Row{hub_sums[0], hub_sums[1], hub_sums[2], 0.}, hub_sums[3], time_step);

    const double beta = parameters.damping_steps * time_step;
    double       work = 0., gross = 0.;
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        const Row velocity = v[i] + (time_step * inverse_mass[i]) * force[i];
        if (loaded)
          {
            const double w = 0.5 * time_step * dot(external_force[i], velocity + v[i]);
            if (mesh.shared_nodes.is_owned(i))
              {
                work += w;
                gross += std::abs(w);
              }
          }
        v[i] = velocity;
        x[i] += time_step * velocity;
        x_damped[i] = x[i] + beta * velocity;
        force[i]    = Row{};
      }
    totals.external_work += work;
    totals.gross_work += gross;
    if (hub)
      {
        move_hub_nodes();
        for (const unsigned int i : hub_nodes)
          x_damped[i] = x[i] + beta * v[i];
      }
    mesh.distribute_hanging_nodes(v.data());
    mesh.distribute_hanging_nodes(x.data());
    mesh.distribute_hanging_nodes(x_damped.data());
    time += time_step;
    ++n_steps;
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
    double energy = 0.;
    for (unsigned int i = 0; i < x.size(); ++i)
      if (inverse_mass[i] > 0. && mesh.shared_nodes.is_owned(i))
        energy += 0.5 / inverse_mass[i] * dot(v[i], v[i]);
    energy = dealii::Utilities::MPI::sum(energy, mesh.comm);
    return hub ? energy + hub->kinetic_energy(0.5 * time_step) : energy;
  }


  NodalField ExplicitDynamics::positions_with_velocities() const
  {
    NodalField positions(x.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      positions[i] = x[i] - 0.5 * time_step * v[i];
    return positions;
  }


  double ExplicitDynamics::body_potential(const NodalField &positions) const
  {
    const Row    axle = hub ? Row{hub->motion.x - 0.5 * time_step * hub->motion.velocity_x, 0.,
                               hub->motion.z - 0.5 * time_step * hub->motion.velocity_z, 0.}
                            : Row{};
    const double compensation =
      (1. - 1. / parameters.density_scale) * nominal_angular_velocity * nominal_angular_velocity;
    double potential = 0.;
    for (unsigned int i = 0; i < x.size(); ++i)
      if (inverse_mass[i] > 0. && mesh.shared_nodes.is_owned(i))
        {
          potential += true_mass[i] * parameters.gravity * positions[i][2];
          if (on_wheel[i])
            {
              const double rx = positions[i][0] - axle[0], rz = positions[i][2] - axle[2];
              potential += 0.5 * compensation * parameters.density_scale * true_mass[i] * (rx * rx + rz * rz);
            }
        }
    return dealii::Utilities::MPI::sum(potential, mesh.comm);
  }


  EnergyLedger ExplicitDynamics::ledger()
  {
    using dealii::Utilities::MPI::sum;
    sample_damping();
    EnergyLedger now           = totals;
    now.damping                = sum(totals.damping, mesh.comm);
    now.plastic                = sum(totals.plastic, mesh.comm);
    now.external_work          = sum(totals.external_work, mesh.comm);
    now.gross_work             = sum(totals.gross_work, mesh.comm);
    const NodalField positions = positions_with_velocities();
    const double     fall      = start_potential - body_potential(positions);
    now.external_work += fall;
    now.gross_work += std::abs(fall);
    if (hub)
      {
        now.external_work += hub->external_work() - start_hub_work;
        now.gross_work += hub->gross_work() - start_hub_gross;
      }
    now.kinetic               = kinetic_energy() - start_kinetic;
    const StrainEnergy energy = solid.strain_energy(positions.data(), history);
    now.strain                = sum(energy.strain, mesh.comm) - start_strain.strain;
    now.hourglass             = sum(energy.hourglass, mesh.comm) - start_strain.hourglass;
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
