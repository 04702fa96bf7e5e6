// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace tread
{
  double EnergyLedger::residual_share() const
  {
    return gross_work > 0. ? residual() / gross_work : 0.;
  }


  NodalField ExplicitDynamics::cell_forces() const
  {
    NodalField forces(v.size(), Vector3{});
    solid.add_internal_forces(positions().data(), v.data(), forces.data(), history);
    return forces;
  }


  double ExplicitDynamics::damping_forces(const NodalField &forces, NodalField &damping) const
  {
    // f(x + beta v) - f(x), and how much power it takes with the velocities of half a step back.
    damping.assign(v.size(), Vector3{});
    if (!(parameters.damping_steps > 0. || solid.needs_velocity()))
      return 0.;
    NodalField without;
    solid.add_internal_forces(x_damped.data(), v.data(), damping.data(), history);
    if (solid.needs_velocity())
      {
        const NodalField no_velocity(v.size(), Vector3{});
        without.assign(v.size(), Vector3{});
        solid.add_internal_forces(positions().data(), no_velocity.data(), without.data(), history);
      }
    const NodalField &elastic = solid.needs_velocity() ? without : forces;
    for (unsigned int i = 0; i < v.size(); ++i)
      damping[i] -= elastic[i];
    mesh.condense_hanging_nodes(damping.data()); // whose velocities may wait for other levels
    mesh.shared_nodes.sum(damping.data());
    return -power_of(damping);
  }


  double ExplicitDynamics::power_of(const NodalField &forces) const
  {
    ReproducibleSum<double> of_nodes;
    for (unsigned int i = 0; i < v.size(); ++i)
      if (mesh.shared_nodes.is_owned(i))
        of_nodes.add(dot(v[i], forces[i]));
    return of_nodes.value(mesh.comm);
  }


  double ExplicitDynamics::damping_since_sample(const double power) const
  {
    // The sum over the steps from the last sample on, this one left out, when power changes in a straight
    // line.
    const double n = n_steps - last_damping_step;
    return n > 0. ? time_step * (n * last_damping_power + 0.5 * (n - 1.) * (power - last_damping_power)) : 0.;
  }


  ExplicitDynamics::DampingSample ExplicitDynamics::begin_damping_sample() const
  {
    DampingSample sample;
    sample.power = damping_forces(cell_forces(), sample.force);
    return sample;
  }


  void ExplicitDynamics::end_damping_sample(const DampingSample &sample)
  {
    // In central differences a force works in a step with the mean of the velocities before and after it. The
    // step has already been counted.
    const double power = 0.5 * (sample.power - power_of(sample.force));
    --n_steps;
    if (dealii::Utilities::MPI::this_mpi_process(mesh.comm) == 0)
      totals.damping.add(damping_since_sample(power));
    last_damping_step  = n_steps++;
    last_damping_power = power;
    damping_is_sampled = true;
  }


  double ExplicitDynamics::kinetic_energy(NodalField forces) const
  {
    // The product of the velocities half a step before and after now: central differences keep its sum with
    // the strain energy. What is not the cells' adds as much to the work.
    mesh.condense_hanging_nodes(forces.data());
    if (supports)
      supports->add_spring_forces(forces.data());
    mesh.shared_nodes.sum(forces.data());
    ReproducibleSum<double> of_nodes;
    for (unsigned int i = 0; i < v.size(); ++i)
      if (mesh.shared_nodes.is_owned(i))
        {
          double energy = 0.5 * std::ldexp(time_step, levels.of_node[i]) * dot(forces[i], v[i]);
          if (inverse_mass[i] > 0.)
            energy += 0.5 / inverse_mass[i] * dot(v[i], v[i]);
          of_nodes.add(energy);
        }
    double energy = of_nodes.value(mesh.comm);
    if (supports)
      energy += supports->sleeper_kinetic_energy(time_step);
    for (const Wheel &wheel : wheels)
      energy += wheel.hub->kinetic_energy(0.5 * time_step);
    if (rail_base)
      energy += rail_base->kinetic_energy();
    return energy;
  }


  StrainEnergy ExplicitDynamics::strain_energy() const
  {
    const StrainEnergySums sums = solid.strain_energy_sums(positions().data(), history);
    return {sums.strain.value(mesh.comm), sums.hourglass.value(mesh.comm)};
  }


  double ExplicitDynamics::body_potential() const
  {
    // Evaluated at the instant of the velocities, half a step back, up to which work is counted.
    ReproducibleSum<double> of_nodes;
    for (unsigned int i = 0; i < v.size(); ++i)
      if (inverse_mass[i] > 0. && mesh.shared_nodes.is_owned(i))
        {
          const double  back   = 0.5 * std::ldexp(time_step, levels.of_node[i]);
          const Vector3 before = position(i) - back * v[i];
          double        energy = true_mass[i] * parameters.gravity * before[2];
          if (const int number = wheel_of(i); number >= 0)
            {
              const Wheel    &wheel = wheels[number];
              const WheelHub &hub   = *wheel.hub;
              const Vector3   arm   = hub.off_axle(before - hub.middle() + back * hub.velocity());
              energy += 0.5 * compensation(wheel) * parameters.density_scale * true_mass[i] * dot(arm, arm);
            }
          of_nodes.add(energy);
        }
    const double potential = of_nodes.value(mesh.comm);
    return supports ? potential + supports->weight_potential(time_step) : potential;
  }


  std::array<double, 2> ExplicitDynamics::work_on_hubs() const
  {
    std::array<double, 2> work{};
    for (const Wheel &wheel : wheels)
      {
        work[0] += wheel.hub->external_work();
        work[1] += wheel.hub->gross_work();
      }
    if (rail_base)
      {
        work[0] += rail_base->external_work();
        work[1] += rail_base->gross_work();
      }
    return work;
  }


  EnergyLedger ExplicitDynamics::ledger() const
  {
    const NodalField forces = cell_forces();
    NodalField       unused;
    EnergyLedger     now;
    now.damping  = totals.damping.value(mesh.comm) + damping_since_sample(damping_forces(forces, unused));
    now.plastic  = totals.plastic.value(mesh.comm);
    now.friction = totals.friction.value(mesh.comm);
    now.contact  = totals.contact.value(mesh.comm);
    now.contact_on_nodes = totals.contact_on_nodes.value(mesh.comm);
    now.external_work    = totals.external_work.value(mesh.comm);
    now.gross_work       = totals.gross_work.value(mesh.comm);
    const double fall    = start_potential - body_potential();
    now.external_work += fall;
    now.gross_work += std::abs(fall);
    const std::array<double, 2> hub_work = work_on_hubs();
    now.external_work += hub_work[0] - start_hub_work[0];
    now.gross_work += hub_work[1] - start_hub_work[1];
    if (supports)
      {
        now.springs = supports->spring_energy() - start_springs;
        now.dampers = supports->dissipated() - start_dissipated;
        now.damping += now.dampers;
      }
    now.kinetic               = kinetic_energy(forces) - start_kinetic;
    const StrainEnergy energy = strain_energy();
    now.strain                = energy.strain - start_strain.strain;
    now.hourglass             = energy.hourglass - start_strain.hourglass;
    now.stored_strain         = energy.strain;
    now.stored_hourglass      = energy.hourglass;
    return now;
  }
} // namespace tread
