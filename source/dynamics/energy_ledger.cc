// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace tread
{
  namespace
  {
    /// Sum of of_run(run, factor)(i) over the nodes i of all ranks that do not hang, each of them once: those
    /// of a run are on the same wheel or on none and move in time steps of the same factor. Collective.
    template <typename OfRun>
    double sum_by_runs(const NodeLevels &levels, const MPI_Comm comm, const OfRun &of_run)
    {
      ReproducibleSum<double> sum;
      for (unsigned int level = 0; level <= levels.max_level(); ++level)
        for (const NodeLevels::Run &run : levels.runs[level])
          if (run.is_owned)
            {
              const auto of_node = of_run(run, std::ldexp(1., level));
              for (unsigned int i = run.begin; i < run.end; ++i)
                sum.add(of_node(i));
            }
      return sum.value(comm);
    }
  } // namespace


  double EnergyLedger::residual_share() const
  {
    return gross_work > 0. ? residual() / gross_work : 0.;
  }


  NodalField ExplicitDynamics::cell_forces() const
  {
    NodalField       forces(v.size(), Vector3{});
    const NodalField x = positions();
    solid.add_internal_forces(x.data(), v.data(), forces.data(), history);
    matched_surface.add_forces(x.data(), v.data(), forces.data(), 0.);
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
    matched_surface.add_forces(x_damped.data(), v.data(), damping.data(), surface_damping_time());
    if (solid.has_bulk_viscosity())
      {
        const NodalField no_velocity(v.size(), Vector3{});
        without.assign(v.size(), Vector3{});
        solid.add_internal_forces(positions().data(), no_velocity.data(), without.data(), history);
        matched_surface.add_forces(positions().data(), no_velocity.data(), without.data(), 0.);
      }
    const NodalField &elastic = solid.has_bulk_viscosity() ? without : forces;
    for (unsigned int i = 0; i < v.size(); ++i)
      damping[i] -= elastic[i];
    mesh.condense_hanging_nodes(damping.data()); // whose velocities may wait for other levels
    mesh.shared_nodes.sum(damping.data());
    return -power_of(damping);
  }


  double ExplicitDynamics::power_of(const NodalField &forces) const
  {
    return sum_by_runs(levels, mesh.comm, [&](const Run &, const double) {
      return [&](const unsigned int i) {
        return dot(v[i], forces[i]);
      };
    });
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
    double energy = sum_by_runs(levels, mesh.comm, [&](const Run &, const double factor) {
      return [&, back = 0.5 * factor * time_step](const unsigned int i) {
        const double of_forces = back * dot(forces[i], v[i]);
        return inverse_mass[i] > 0. ? of_forces + 0.5 / inverse_mass[i] * dot(v[i], v[i]) : of_forces;
      };
    });
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
    const NodalField x    = positions();
    StrainEnergySums sums = solid.strain_energy_sums(x.data(), history);
    sums.hourglass.add(matched_surface.energy(x.data()));
    return {sums.strain.value(mesh.comm), sums.hourglass.value(mesh.comm)};
  }


  double ExplicitDynamics::body_potential() const
  {
    // Evaluated at the instant of the velocities, half a step back, up to which work is counted.
    const double potential = sum_by_runs(levels, mesh.comm, [&](const Run &run, const double factor) {
      double  of_arm = 0.;
      Vector3 middle{}, axle{};
      if (run.wheel >= 0)
        {
          const Wheel &wheel = wheels[run.wheel];
          of_arm             = 0.5 * compensation(wheel) * parameters.density_scale;
          middle             = wheel.hub->middle() - 0.5 * factor * time_step * wheel.hub->velocity();
          axle               = wheel.hub->axle();
        }
      return [=, this, back = 0.5 * factor * time_step](const unsigned int i) {
        if (inverse_mass[i] == 0.)
          return 0.;
        const Vector3 before = position(i) - back * v[i], arm = before - middle,
                      off_axle = arm - dot(axle, arm) * axle;
        return true_mass[i] * (parameters.gravity * before[2] + of_arm * dot(off_axle, off_axle));
      };
    });
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
