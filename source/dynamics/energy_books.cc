// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/energy_books.h>

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


  NodalField EnergyBooks::cell_forces() const
  {
    NodalField       forces(moving.state.v.size(), Vector3{});
    const NodalField x = moving.state.positions();
    moving.solid.add_internal_forces(x.data(), moving.state.v.data(), forces.data(), moving.state.history);
    moving.matched_surface.add_forces(x.data(), moving.state.v.data(), forces.data(), 0.);
    return forces;
  }


  double EnergyBooks::damping_forces(const NodalField &forces, NodalField &damping) const
  {
    // f(x + beta v) - f(x), and how much power it takes with the velocities of half a step back.
    damping.assign(moving.state.v.size(), Vector3{});
    if (!(moving.parameters.damping_steps > 0. || moving.solid.needs_velocity()))
      return 0.;
    NodalField without;
    moving.solid.add_internal_forces(moving.state.x_damped.data(), moving.state.v.data(), damping.data(),
                                     moving.state.history);
    moving.matched_surface.add_forces(moving.state.x_damped.data(), moving.state.v.data(), damping.data(),
                                      moving.surface_damping_time());
    if (moving.solid.has_bulk_viscosity())
      {
        const NodalField no_velocity(moving.state.v.size(), Vector3{});
        without.assign(moving.state.v.size(), Vector3{});
        moving.solid.add_internal_forces(moving.state.positions().data(), no_velocity.data(), without.data(),
                                         moving.state.history);
        moving.matched_surface.add_forces(moving.state.positions().data(), no_velocity.data(), without.data(),
                                          0.);
      }
    const NodalField &elastic = moving.solid.has_bulk_viscosity() ? without : forces;
    for (unsigned int i = 0; i < moving.state.v.size(); ++i)
      damping[i] -= elastic[i];
    moving.mesh.condense_hanging_nodes(damping.data()); // whose velocities may wait for other levels
    moving.mesh.shared_nodes.sum(damping.data());
    return -power_of(damping);
  }


  double EnergyBooks::power_of(const NodalField &forces) const
  {
    return sum_by_runs(moving.levels,
                       [&](const NodeLevels::Run &, const double) {
                         return [&](const unsigned int i) {
                           return dot(moving.state.v[i], forces[i]);
                         };
                       })
      .value(moving.mesh.comm);
  }


  double EnergyBooks::damping_since_sample(const double power, const std::uint64_t n_steps) const
  {
    // The sum over the steps from the last sample on, the last one left out, when power changes in a straight
    // line.
    const double n = n_steps - last_step;
    return n > 0. ? moving.state.time_step * (n * last_power + 0.5 * (n - 1.) * (power - last_power)) : 0.;
  }


  bool EnergyBooks::is_first_rank() const
  {
    return dealii::Utilities::MPI::this_mpi_process(moving.mesh.comm) == 0;
  }


  EnergyBooks::DampingSample EnergyBooks::begin_sample() const
  {
    DampingSample sample;
    sample.power = damping_forces(cell_forces(), sample.force);
    return sample;
  }


  void EnergyBooks::end_sample(const DampingSample &sample)
  {
    // In central differences a force works in a step with the mean of the velocities before and after it. The
    // step has already been counted.
    const double        power = 0.5 * (sample.power - power_of(sample.force));
    const std::uint64_t step  = moving.state.n_steps - 1;
    if (is_first_rank())
      totals.damping.add(damping_since_sample(power, step));
    last_step  = step;
    last_power = power;
    is_sampled = true;
  }


  ReproducibleSum<double> EnergyBooks::kinetic_energy_of_nodes(NodalField forces) const
  {
    // The product of the velocities half a step before and after now: central differences keep its sum with
    // the strain energy. What is not the cells' adds as much to the work.
    moving.mesh.condense_hanging_nodes(forces.data());
    for (const auto &part : moving.parts)
      part->add_spring_forces(forces);
    moving.mesh.shared_nodes.sum(forces.data());
    return sum_by_runs(moving.levels, [&](const NodeLevels::Run &, const double factor) {
      return [&, back = 0.5 * factor * moving.state.time_step](const unsigned int i) {
        const double of_forces = back * dot(forces[i], moving.state.v[i]);
        return moving.inverse_mass[i] > 0.
                 ? of_forces + 0.5 / moving.inverse_mass[i] * dot(moving.state.v[i], moving.state.v[i])
                 : of_forces;
      };
    });
  }


  StrainEnergySums EnergyBooks::strain_energy_sums() const
  {
    const NodalField x    = moving.state.positions();
    StrainEnergySums sums = moving.solid.strain_energy_sums(x.data(), moving.state.history);
    sums.hourglass.add(moving.matched_surface.energy(x.data()));
    return sums;
  }


  ReproducibleSum<double> EnergyBooks::potential_of_nodes() const
  {
    // Evaluated at the instant of the velocities, half a step back, up to which work is counted.
    return sum_by_runs(moving.levels, [&](const NodeLevels::Run &run, const double factor) {
      double  of_arm = 0.;
      Vector3 middle{}, axle{};
      if (run.carrier >= 0)
        {
          const RigidMotion motion = moving.parts.carriers()[run.carrier]->motion();
          of_arm                   = 0.5 * motion.compensation * moving.parameters.density_scale;
          middle                   = motion.middle - 0.5 * factor * moving.state.time_step * motion.velocity;
          axle                     = motion.axle;
        }
      return [=, this, back = 0.5 * factor * moving.state.time_step](const unsigned int i) {
        if (moving.inverse_mass[i] == 0.)
          return 0.;
        const Vector3 before = moving.state.position(i) - back * moving.state.v[i], arm = before - middle,
                      off_axle = arm - dot(axle, arm) * axle;
        return moving.true_mass[i] *
               (moving.parameters.gravity * before[2] + of_arm * dot(off_axle, off_axle));
      };
    });
  }


  EnergyBooks::Found EnergyBooks::find(const NodalField &forces) const
  {
    const StrainEnergySums strain = strain_energy_sums();
    const auto [kinetic, potential, of_strain, hourglass, external_work, gross_work, friction, contact,
                damping, plastic, contact_on_nodes, window] =
      values_of(std::array{kinetic_energy_of_nodes(forces), potential_of_nodes(), strain.strain,
                           strain.hourglass, totals.external_work, totals.gross_work, totals.friction,
                           totals.contact, totals.damping, totals.plastic, totals.contact_on_nodes,
                           totals.window},
                moving.mesh.comm);
    const double time_step          = moving.state.time_step;
    double       of_nodes_and_parts = kinetic;
    for (const auto &part : moving.parts)
      of_nodes_and_parts += part->kinetic_energy(time_step);
    const auto sum = [&](const auto &energy) {
      return moving.parts.sum_of(energy);
    };
    return {{of_nodes_and_parts,
             potential + sum([&](const Part &part) { return part.potential(time_step); }),
             {of_strain, hourglass},
             sum([](const Part &part) { return part.external_work(); }),
             sum([](const Part &part) { return part.gross_work(); }),
             sum([](const Part &part) { return part.spring_energy(); }),
             sum([](const Part &part) { return part.dissipated(); })},
            {external_work, gross_work, friction, contact, damping, plastic, contact_on_nodes, window}};
  }


  void EnergyBooks::start()
  {
    totals     = LedgerTotals();
    at_start   = find(cell_forces()).energies;
    last_step  = moving.state.n_steps;
    last_power = 0.;
    is_sampled = false;
  }


  EnergyLedger EnergyBooks::ledger() const
  {
    const NodalField  forces = cell_forces();
    NodalField        unused;
    const Found       found  = find(forces);
    const Energies   &of_all = found.energies;
    const LedgerSums &sums   = found.totals;
    EnergyLedger      now;
    now.damping  = sums.damping + damping_since_sample(damping_forces(forces, unused), moving.state.n_steps);
    now.plastic  = sums.plastic;
    now.friction = sums.friction;
    now.contact  = sums.contact;
    now.window   = sums.window;
    now.contact_on_nodes = sums.contact_on_nodes;
    now.external_work    = sums.external_work;
    now.gross_work       = sums.gross_work;
    const double fall    = at_start.potential - of_all.potential;
    now.external_work += fall;
    now.gross_work += std::abs(fall);
    now.external_work += of_all.external_work - at_start.external_work;
    now.gross_work += of_all.gross_work - at_start.gross_work;
    now.springs = of_all.springs - at_start.springs;
    now.dampers = of_all.dissipated - at_start.dissipated;
    now.damping += now.dampers;
    now.kinetic          = of_all.kinetic - at_start.kinetic;
    now.strain           = of_all.strain.strain - at_start.strain.strain;
    now.hourglass        = of_all.strain.hourglass - at_start.strain.hourglass;
    now.stored_strain    = of_all.strain.strain;
    now.stored_hourglass = of_all.strain.hourglass;
    return now;
  }


  void EnergyBooks::go_on_from(const EnergyBooks &before, const double damping_power)
  {
    totals   = before.totals;
    at_start = before.at_start;
    // What was damped since the last sample, in steps of another length.
    if (is_first_rank())
      totals.damping.add(before.damping_since_sample(damping_power, before.moving.state.n_steps));
    last_power = damping_power;
    last_step  = moving.state.n_steps;
    is_sampled = true;
  }


  void EnergyBooks::count_window(const double lost, const double added)
  {
    if (!is_first_rank())
      return;
    totals.window.add(lost);
    totals.external_work.add(added);
    totals.gross_work.add(std::abs(added));
  }


  void EnergyBooks::serialize(Archive &archive)
  {
    archive.same(at_start.kinetic, at_start.potential, at_start.strain, at_start.external_work,
                 at_start.gross_work, at_start.springs, at_start.dissipated);
    totals.serialize(archive);
    archive.same(last_power, last_step, is_sampled);
  }
} // namespace tread
