// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace tread
{
  namespace
  {
    /// Sum of of_run(run, factor)(i) over the nodes i of all ranks that do not hang, each of them once: those
    /// of a run are on the same wheel or on none and move in time steps of the same factor: this rank's own.
    template <typename OfRun>
    ReproducibleSum<double> sum_by_runs(const NodeLevels &levels, const OfRun &of_run)
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
      return sum;
    }
  } // namespace


  double EnergyLedger::residual_share() const
  {
    return gross_work > 0. ? residual() / gross_work : 0.;
  }


  NodalField ExplicitDynamics::cell_forces() const
  {
    NodalField       forces(state.v.size(), Vector3{});
    const NodalField x = state.positions();
    solid.add_internal_forces(x.data(), state.v.data(), forces.data(), state.history);
    matched_surface.add_forces(x.data(), state.v.data(), forces.data(), 0.);
    return forces;
  }


  double ExplicitDynamics::damping_forces(const NodalField &forces, NodalField &damping) const
  {
    // f(x + beta v) - f(x), and how much power it takes with the velocities of half a step back.
    damping.assign(state.v.size(), Vector3{});
    if (!(parameters.damping_steps > 0. || solid.needs_velocity()))
      return 0.;
    NodalField without;
    solid.add_internal_forces(state.x_damped.data(), state.v.data(), damping.data(), state.history);
    matched_surface.add_forces(state.x_damped.data(), state.v.data(), damping.data(), surface_damping_time());
    if (solid.has_bulk_viscosity())
      {
        const NodalField no_velocity(state.v.size(), Vector3{});
        without.assign(state.v.size(), Vector3{});
        solid.add_internal_forces(state.positions().data(), no_velocity.data(), without.data(),
                                  state.history);
        matched_surface.add_forces(state.positions().data(), no_velocity.data(), without.data(), 0.);
      }
    const NodalField &elastic = solid.has_bulk_viscosity() ? without : forces;
    for (unsigned int i = 0; i < state.v.size(); ++i)
      damping[i] -= elastic[i];
    mesh.condense_hanging_nodes(damping.data()); // whose velocities may wait for other levels
    mesh.shared_nodes.sum(damping.data());
    return -power_of(damping);
  }


  double ExplicitDynamics::power_of(const NodalField &forces) const
  {
    return sum_by_runs(levels,
                       [&](const Run &, const double) {
                         return [&](const unsigned int i) {
                           return dot(state.v[i], forces[i]);
                         };
                       })
      .value(mesh.comm);
  }


  double ExplicitDynamics::damping_since_sample(const double power) const
  {
    // The sum over the steps from the last sample on, this one left out, when power changes in a straight
    // line.
    const double n = state.n_steps - last_damping_step;
    return n > 0. ? state.time_step * (n * last_damping_power + 0.5 * (n - 1.) * (power - last_damping_power))
                  : 0.;
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
    --state.n_steps;
    if (dealii::Utilities::MPI::this_mpi_process(mesh.comm) == 0)
      totals.damping.add(damping_since_sample(power));
    last_damping_step  = state.n_steps++;
    last_damping_power = power;
    damping_is_sampled = true;
  }


  ReproducibleSum<double> ExplicitDynamics::kinetic_energy_of_nodes(NodalField forces) const
  {
    // The product of the velocities half a step before and after now: central differences keep its sum with
    // the strain energy. What is not the cells' adds as much to the work.
    mesh.condense_hanging_nodes(forces.data());
    for (const auto &part : parts)
      part->add_spring_forces(forces);
    mesh.shared_nodes.sum(forces.data());
    return sum_by_runs(levels, [&](const Run &, const double factor) {
      return [&, back = 0.5 * factor * state.time_step](const unsigned int i) {
        const double of_forces = back * dot(forces[i], state.v[i]);
        return inverse_mass[i] > 0. ? of_forces + 0.5 / inverse_mass[i] * dot(state.v[i], state.v[i])
                                    : of_forces;
      };
    });
  }


  StrainEnergySums ExplicitDynamics::strain_energy_sums() const
  {
    const NodalField x    = state.positions();
    StrainEnergySums sums = solid.strain_energy_sums(x.data(), state.history);
    sums.hourglass.add(matched_surface.energy(x.data()));
    return sums;
  }


  ReproducibleSum<double> ExplicitDynamics::potential_of_nodes() const
  {
    // Evaluated at the instant of the velocities, half a step back, up to which work is counted.
    return sum_by_runs(levels, [&](const Run &run, const double factor) {
      double  of_arm = 0.;
      Vector3 middle{}, axle{};
      if (run.carrier >= 0)
        {
          const RigidMotion motion = carriers[run.carrier]->motion();
          of_arm                   = 0.5 * motion.compensation * parameters.density_scale;
          middle                   = motion.middle - 0.5 * factor * state.time_step * motion.velocity;
          axle                     = motion.axle;
        }
      return [=, this, back = 0.5 * factor * state.time_step](const unsigned int i) {
        if (inverse_mass[i] == 0.)
          return 0.;
        const Vector3 before = state.position(i) - back * state.v[i], arm = before - middle,
                      off_axle = arm - dot(axle, arm) * axle;
        return true_mass[i] * (parameters.gravity * before[2] + of_arm * dot(off_axle, off_axle));
      };
    });
  }


  ExplicitDynamics::Energies ExplicitDynamics::energies(const NodalField &forces) const
  {
    const StrainEnergySums strain = strain_energy_sums();
    const auto [kinetic, potential, of_strain, hourglass, external_work, gross_work, friction, contact,
                damping, plastic, contact_on_nodes, window] =
      values_of(std::array{kinetic_energy_of_nodes(forces), potential_of_nodes(), strain.strain,
                           strain.hourglass, totals.external_work, totals.gross_work, totals.friction,
                           totals.contact, totals.damping, totals.plastic, totals.contact_on_nodes,
                           totals.window},
                mesh.comm);
    double of_nodes_and_parts = kinetic;
    for (const auto &part : parts)
      of_nodes_and_parts += part->kinetic_energy(state.time_step);
    return {of_nodes_and_parts,
            potential + sum_of_parts([&](const Part &part) { return part.potential(state.time_step); }),
            {of_strain, hourglass},
            {external_work, gross_work, friction, contact, damping, plastic, contact_on_nodes, window}};
  }


  EnergyLedger ExplicitDynamics::ledger() const
  {
    const NodalField forces = cell_forces();
    NodalField       unused;
    const Energies   of_all = energies(forces);
    EnergyLedger     now;
    now.damping          = of_all.totals.damping + damping_since_sample(damping_forces(forces, unused));
    now.plastic          = of_all.totals.plastic;
    now.friction         = of_all.totals.friction;
    now.contact          = of_all.totals.contact;
    now.window           = of_all.totals.window;
    now.contact_on_nodes = of_all.totals.contact_on_nodes;
    now.external_work    = of_all.totals.external_work;
    now.gross_work       = of_all.totals.gross_work;
    const double fall    = start_potential - of_all.potential;
    now.external_work += fall;
    now.gross_work += std::abs(fall);
    now.external_work +=
      sum_of_parts([](const Part &part) { return part.external_work(); }) - start_external_work;
    now.gross_work += sum_of_parts([](const Part &part) { return part.gross_work(); }) - start_gross_work;
    now.springs = sum_of_parts([](const Part &part) { return part.spring_energy(); }) - start_springs;
    now.dampers = sum_of_parts([](const Part &part) { return part.dissipated(); }) - start_dissipated;
    now.damping += now.dampers;
    now.kinetic          = of_all.kinetic - start_kinetic;
    now.strain           = of_all.strain.strain - start_strain.strain;
    now.hourglass        = of_all.strain.hourglass - start_strain.hourglass;
    now.stored_strain    = of_all.strain.strain;
    now.stored_hourglass = of_all.strain.hourglass;
    return now;
  }
} // namespace tread
