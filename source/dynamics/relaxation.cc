// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

namespace tread
{
  unsigned int ExplicitDynamics::relax(const double                                     tolerance,
                                       const unsigned int                               max_iterations,
                                       const std::function<void(unsigned int, double)> &after_measurement)
  {
    using dealii::Utilities::MPI::sum;

    set_damping_time(0.);
    NodalField &x = x_damped; // which are the positions now
    // Sweeps on the way to equilibrium are no steps in time.
    const std::uint64_t unconverged_steps = contact ? contact->n_unconverged_steps() : 0;

    // Masses with which a unit "time" step is stable, and equally so, for every cell.
    constexpr double highest_frequency = 1.8;
    NodalField       mass(x.size(), Row{});
    const auto       cell_masses = solid.cell_masses(mesh);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        const double ratio = solid.cell_frequencies()[c] / highest_frequency;
        for (unsigned int a = 0; a < 8; ++a)
          mass[mesh.cells[c].nodes[a]][0] += ratio * ratio * parameters.density_scale * cell_masses[c][a];
      }
    mesh.condense_hanging_nodes(mass.data());
    if (supports)
      {
        NodalField rows(x.size(), Row{});
        supports->add_row_sums(rows.data());
        for (unsigned int i = 0; i < x.size(); ++i)
          mass[i][0] += rows[i][0] / (highest_frequency * highest_frequency);
      }
    mesh.shared_nodes.sum(mass.data());
    std::vector<double> inverse(x.size(), 0.);
    double              hub_mass = 0.;
    for (unsigned int i = 0; i < x.size(); ++i)
      if (carried[i])
        hub_mass += mesh.shared_nodes.is_owned(i) ? mass[i][0] : 0.;
      else if (!fixed[i] && mass[i][0] > 0.)
        inverse[i] = 1. / mass[i][0];
    hub_mass = sum(hub_mass, mesh.comm);

    // Weight and true centrifugal force act on the true masses; once on nodes that ranks share.
    const double omega2 = nominal_angular_velocity * nominal_angular_velocity;
    const Row    axle   = hub ? Row{hub->motion.x, 0., hub->motion.z, 0.} : Row{};
    NodalField   body_force(x.size(), Row{});
    for (unsigned int i = 0; i < x.size(); ++i)
      if (inverse[i] > 0. && mesh.shared_nodes.is_owned(i))
        {
          body_force[i] = Row{0., 0., -parameters.gravity * true_mass[i], 0.};
          if (on_wheel[i])
            body_force[i] += omega2 * true_mass[i] * Row{1., 0., 1., 0.} * (x[i] - axle);
          if (!external_force.empty())
            body_force[i] += external_force[i];
        }
    const double hub_load = hub ? hub->static_force() : 0.;

    // The slowest motion by far is that of the whole wheel sinking into the contact. Its rigid shift is given
    // this much more acceleration by the total force: inverse masses M^-1 + lightness r r^T / (r^T M r). The
    // shift strains no cell, as K r = 0.
    const double lightness  = hub && contact ? 16. : 0.;
    double       wheel_mass = 0., wheel_load = 0.;
    for (unsigned int i = 0; i < x.size(); ++i)
      if (on_wheel[i] && mesh.shared_nodes.is_owned(i))
        {
          wheel_mass += mass[i][0];
          wheel_load += body_force[i][2];
        }
    wheel_mass = sum(wheel_mass, mesh.comm);
    wheel_load = sum(wheel_load, mesh.comm) + hub_load;

    std::fill(v.begin(), v.end(), Row{});
    std::shared_ptr<const FrictionLaw> law; // of the motion to come
    if (contact)
      {
        contact->set_inverse_masses(inverse);
        law = contact->set_friction(std::make_shared<CoulombFriction>(0.));
        contact->refresh(x.data(), v.data(), 1.);
      }
    const NodalField       at_rest(x.size(), Row{});
    NodalField             previous(x.size(), Row{});
    double                 keep = 0.9, hub_velocity = 0.; // share of the velocity that damping leaves
    constexpr unsigned int interval = 20, steps_between_beams = 200;
    unsigned int           iteration = 1, last_refresh = 0;
    double                 first_residual = 0.; // N
    for (; iteration <= max_iterations; ++iteration)
      {
        std::copy(body_force.begin(), body_force.end(), force.begin());
        solid.add_internal_forces(x.data(), at_rest.data(), force.data(), history);
        mesh.condense_hanging_nodes(force.data());
        if (supports)
          {
            supports->set_at_rest(x.data());
            supports->add_forces(force.data());
          }
        mesh.shared_nodes.sum(force.data());

        const bool measure  = iteration == 1 || iteration % interval == 0,
                   remember = iteration % interval == interval - 1;
        if (measure && iteration > 1)
          {
            // Rayleigh quotient of the last displacement, of which the velocities are what damping leaves:
            // the frequency that still moves.
            double change = 0., inertia = 0., momentum = 0.;
            for (unsigned int i = 0; i < x.size(); ++i)
              if (inverse[i] > 0. && mesh.shared_nodes.is_owned(i))
                {
                  change -= dot(v[i], force[i] - previous[i]);
                  inertia += dot(v[i], v[i]) / inverse[i];
                  if (on_wheel[i])
                    momentum += v[i][2] / inverse[i];
                }
            change   = sum(change, mesh.comm) / keep;
            momentum = sum(momentum, mesh.comm) + hub_mass * hub_velocity;
            inertia  = sum(inertia, mesh.comm) + hub_mass * hub_velocity * hub_velocity;
            if (lightness > 0.)
              inertia -= lightness / (1. + lightness) * momentum * momentum / wheel_mass;
            inertia /= keep * keep;
            const double omega = inertia > 0. ? std::sqrt(std::max(0., change / inertia)) : 0.;
            // Stable for omega^2 < 2 (1 + keep): with highest_frequency 1.8 keep must exceed 0.62.
            const double kept = std::exchange(keep, std::clamp(1. - 2. * omega, 0.75, 0.9998));
            for (Row &velocity : v)
              velocity *= keep / kept;
            hub_velocity *= keep / kept;
          }
        if (remember)
          previous = force;

        hold_guided_nodes(force);
        if (hub)
          add_hub_sums(rank_sums);
        if (contact)
          {
            if (contact->refresh_due())
              contact->refresh(x.data(), v.data(), 1.);
            contact->predict(v.data(), force.data(), 1., rank_sums);
            contact->solve(1., force.data());
          }
        else if (hub)
          sum(rank_sums, mesh.comm, rank_sums);

        // The rail as a beam follows what is out of balance along it, the wheel with all of its load
        // included.
        if (supports && iteration % steps_between_beams == 1)
          {
            double on_wheel_nodes = 0.;
            for (unsigned int i = 0; i < x.size(); ++i)
              if (on_wheel[i] && !carried[i] && mesh.shared_nodes.is_owned(i))
                on_wheel_nodes += force[i][2];
            on_wheel_nodes              = sum(on_wheel_nodes, mesh.comm);
            const double          place = hub ? hub->motion.x : supports->positions[0];
            const RailBeam::Field field =
              rail_beam->balance(force.data(), place, hub ? on_wheel_nodes + rank_sums[2] + hub_load : 0.);
            rail_beam->add(field, 1., x.data());
            const double down = field.rail.deflection(place).real();
            if (hub)
              {
                hub->motion.z += down;
                for (unsigned int i = 0; i < x.size(); ++i)
                  if (on_wheel[i])
                    x[i][2] += down;
              }
            mesh.distribute_hanging_nodes(x.data());
            if (contact)
              contact->refresh(x.data(), v.data(), 1.);
          }

        const double shift =
          lightness > 0. ? lightness / wheel_mass * (wheel_load + contact->total_impulse_on(hub_body)[2])
                         : 0.;
        double residual = 0., scale = 0.;
        if (hub)
          {
            const double imbalance    = rank_sums[2] + hub_load;
            const double displacement = hub_velocity + imbalance / hub_mass + shift;
            hub->motion.z += displacement;
            hub_velocity = keep * displacement;
            residual     = std::abs(imbalance);
            scale        = std::abs(hub_load);
          }
        double squares = 0., load_squares = 0.;
        for (unsigned int i = 0; i < x.size(); ++i)
          {
            if (measure && inverse[i] > 0. && mesh.shared_nodes.is_owned(i))
              {
                squares += dot(force[i], force[i]);
                load_squares += dot(body_force[i], body_force[i]);
              }
            const Row displacement = v[i] + inverse[i] * force[i] + Row{0., 0., on_wheel[i] ? shift : 0., 0.};
            x[i] += displacement;
            v[i] = keep * displacement;
          }
        if (hub)
          for (unsigned int k = 0; k < hub_nodes.size(); ++k)
            {
              x[hub_nodes[k]] = hub->position_of(hub_reference[k]);
              v[hub_nodes[k]] = Row{0., 0., hub_velocity, 0.};
            }
        mesh.distribute_hanging_nodes(x.data());
        Mesh::distribute(hanging_at_contact, v.data()); // all that is asked for

        if (measure)
          {
            residual = std::max(residual, std::sqrt(sum(squares, mesh.comm)));
            scale    = std::max(scale, std::sqrt(sum(load_squares, mesh.comm)));
            if (iteration == 1)
              first_residual = residual;
            // Without a load: of what is out of balance at the start.
            const double share = residual / (scale > 0. ? scale : std::max(first_residual, 1e-300));
            if (!std::isfinite(share))
              throw std::runtime_error("no equilibrium at the start: forces grow without bound after " +
                                       std::to_string(iteration) + " iterations");
            if (after_measurement)
              after_measurement(iteration, share);
            // The iteration continues if the callback has changed the contact.
            if (share <= tolerance && !(contact && contact->refresh_due()))
              {
                // Balanced with the coupling of where nodes were many iterations ago? Then not yet.
                if (!contact || iteration <= last_refresh + interval)
                  break;
                contact->refresh(x.data(), v.data(), 1.);
                last_refresh = iteration;
              }
          }
      }
    if (iteration > max_iterations)
      throw std::runtime_error(
        "no equilibrium at the start within " + std::to_string(max_iterations) +
        " iterations: raise 'Start/Largest number of iterations' or check loads and supports");
    solid.update_internal_forces(x.data(), at_rest.data(), force.data(), history);
    if (supports)
      supports->set_at_rest(x.data());
    std::fill(force.begin(), force.end(), Row{});
    std::fill(v.begin(), v.end(), Row{});
    if (hub)
      hub->balance_suspension();
    if (contact)
      {
        contact->set_friction(law);
        contact->set_n_unconverged_steps(unconverged_steps);
      }
    return iteration;
  }
} // namespace tread
