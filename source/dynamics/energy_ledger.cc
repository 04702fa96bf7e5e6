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
    double            power   = 0.;
    for (unsigned int i = 0; i < v.size(); ++i)
      {
        damping[i] -= elastic[i];
        power -= dot(v[i], damping[i]);
      }
    return power;
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
    mesh.condense_hanging_nodes(sample.force.data()); // whose velocities may wait for other levels
    return sample;
  }


  void ExplicitDynamics::end_damping_sample(const DampingSample &sample)
  {
    // In central differences a force works in a step with the mean of the velocities before and after it. The
    // step has already been counted.
    double after = 0.;
    for (unsigned int i = 0; i < v.size(); ++i)
      after -= dot(v[i], sample.force[i]);
    const double power = 0.5 * (sample.power + after);
    --n_steps;
    totals.damping += damping_since_sample(power);
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
    double energy = 0.;
    for (unsigned int i = 0; i < v.size(); ++i)
      {
        energy += 0.5 * std::ldexp(time_step, levels.of_node[i]) * dot(forces[i], v[i]);
        if (inverse_mass[i] > 0. && mesh.shared_nodes.is_owned(i))
          energy += 0.5 / inverse_mass[i] * dot(v[i], v[i]);
      }
    energy = dealii::Utilities::MPI::sum(energy, mesh.comm);
    if (supports)
      energy += supports->sleeper_kinetic_energy(time_step);
    for (const Wheel &wheel : wheels)
      energy += wheel.hub->kinetic_energy(0.5 * time_step);
    return energy;
  }


  StrainEnergy ExplicitDynamics::strain_energy() const
  {
    StrainEnergy energy = solid.strain_energy(positions().data(), history);
    energy.strain       = dealii::Utilities::MPI::sum(energy.strain, mesh.comm);
    energy.hourglass    = dealii::Utilities::MPI::sum(energy.hourglass, mesh.comm);
    return energy;
  }


  double ExplicitDynamics::body_potential() const
  {
    // Evaluated at the instant of the velocities, half a step back, up to which work is counted.
    double potential = 0.;
    for (unsigned int i = 0; i < v.size(); ++i)
      if (inverse_mass[i] > 0. && mesh.shared_nodes.is_owned(i))
        {
          const double  back   = 0.5 * std::ldexp(time_step, levels.of_node[i]);
          const Vector3 before = position(i) - back * v[i];
          potential += true_mass[i] * parameters.gravity * before[2];
          if (const int number = wheel_of(i); number >= 0)
            {
              const Wheel    &wheel = wheels[number];
              const WheelHub &hub   = *wheel.hub;
              const Vector3   arm   = hub.off_axle(before - hub.middle() + back * hub.velocity());
              potential +=
                0.5 * compensation(wheel) * parameters.density_scale * true_mass[i] * dot(arm, arm);
            }
        }
    potential = dealii::Utilities::MPI::sum(potential, mesh.comm);
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
    return work;
  }


  EnergyLedger ExplicitDynamics::ledger() const
  {
    using dealii::Utilities::MPI::sum;
    const NodalField forces = cell_forces();
    NodalField       unused;
    EnergyLedger     now = totals;
    now.damping  = sum(totals.damping + damping_since_sample(damping_forces(forces, unused)), mesh.comm);
    now.plastic  = sum(totals.plastic, mesh.comm);
    now.friction = sum(totals.friction, mesh.comm);
    now.contact  = sum(totals.contact, mesh.comm);
    now.contact_on_nodes = sum(totals.contact_on_nodes, mesh.comm);
    now.external_work    = sum(totals.external_work, mesh.comm);
    now.gross_work       = sum(totals.gross_work, mesh.comm);
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
