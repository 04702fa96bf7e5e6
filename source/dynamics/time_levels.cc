// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
    /// Part of the way that the steady share of slow cells' forces goes to their present value when these are
    /// evaluated.
    constexpr double follow = 0.5;

    /// Digits to which frequencies are rounded up, so that the time step is the same on any number of ranks:
    /// sums over the ranks differ from the 15th digit on, and Lanczos' method amplifies that. It costs at
    /// most 1 % of the step.
    constexpr int kept_digits = 3;

    /// Steps of Lanczos' method, and the factor by which its largest Ritz value, which approaches the highest
    /// frequency from below, is raised. The bound of the fastest cell limits the result in any case.
    constexpr unsigned int lanczos_steps  = 30;
    constexpr double       lanczos_margin = 1.005;

    /// Largest displacement with which stiffness is applied to a mode, m: small against any cell (strains of
    /// 1e-6 in cells of 1 mm), and large against the rounding of positions (1e-16 m for 1 m).
    constexpr double probing_displacement = 1e-9;

    /// A number in [-0.5, 0.5) that looks random and depends on the place alone, not on the rank: the start
    /// of Lanczos' method, which must contain all modes. The factors only have to be large against the
    /// inverse of a cell's size and without a common divisor.
    double random_at(const dealii::Point<3> &place, const unsigned int direction)
    {
      constexpr double scale = 1e4, per_metre = 1e5, weight_of_y = 1.7, weight_of_z = 2.3;
      const double     wave =
        scale *
        std::sin(per_metre * (place[0] + weight_of_y * place[1] + weight_of_z * place[2]) + 2. * direction);
      return wave - std::floor(wave) - 0.5;
    }
  } // namespace


  void ExplicitDynamics::set_node_levels()
  {
    std::vector<unsigned int> smallest_steps;
    for (const auto &part : parts)
      {
        const std::vector<unsigned int> nodes = part->nodes_of_every_step();
        smallest_steps.insert(smallest_steps.end(), nodes.begin(), nodes.end());
      }
    levels           = NodeLevels(mesh, solid, smallest_steps, carrier_of_body);
    std::size_t most = force_before.size();
    for (const SlowShares &shares : levels.slow_shares)
      most = std::max(most, shares.nodes.size());
    force_before.resize(most);
  }


  double ExplicitDynamics::ideal_gain_of_levels(const unsigned int largest) const
  {
    double updates = 0.;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      updates += std::ldexp(1., -static_cast<int>(solid.level_up_to(largest, c)));
    return mesh.n_global_cells / dealii::Utilities::MPI::sum(updates, mesh.comm);
  }


  double ExplicitDynamics::critical_time_step() const
  {
    if (critical_step > 0.)
      return critical_step;
    // The stress-free reference configuration is used instead of the present one: small strain changes the
    // result by less than the margin.
    NodalField reference(state.v.size());
    for (unsigned int i = 0; i < state.v.size(); ++i)
      reference[i] = Vector3{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.};
    critical_step = critical_time_step_of(highest_of_levels(reference, solid.virgin()));
    return critical_step;
  }


  double ExplicitDynamics::slowed_by_supports() const
  {
    return 2. / (highest_of_step * std::sqrt(1. + 2. * parameters.damping_steps) * critical_time_step());
  }


  double ExplicitDynamics::highest_of_levels(const NodalField &x, const PlasticHistory &memory) const
  {
    double highest = 0.;
    for (unsigned int level = 0; level <= max_level(); ++level)
      highest = std::max(highest, std::ldexp(highest_frequency(level, x, memory), level));
    return highest;
  }


  double ExplicitDynamics::critical_time_step_of(double highest) const
  {
    const auto rounded = [](const double value) {
      const double digit = std::pow(10., std::floor(std::log10(value)) + 1. - kept_digits);
      return value > 0. ? digit * std::ceil(value / digit) : 0.;
    };
    // Forces at x + beta v of half a step back, dampers with v of half a step back: dt^2 K + 2 dt C <= 4 for
    // the largest eigenvalues of M^-1 K (1 + 2 beta/dt) and M^-1 C, or their bounds by row sums.
    highest                     = rounded(highest);
    highest_of_step             = highest;
    bound_found_stable          = 0.;
    double                    K = highest * highest * (1. + 2. * parameters.damping_steps), C = 0.;
    const std::vector<double> inverse = free_inverse_masses();
    for (const auto &part : parts)
      {
        NodalField rows(state.v.size(), Vector3{});
        part->add_row_sums(rows);
        mesh.shared_nodes.sum(rows.data());
        Part::OwnRates rates = part->own_rates(levels);
        for (unsigned int i = 0; i < rows.size(); ++i)
          {
            rates.stiffness = std::max(rates.stiffness, inverse[i] * rows[i][0]);
            rates.damping   = std::max(rates.damping, inverse[i] * rows[i][1]);
          }
        K += rounded(dealii::Utilities::MPI::max(rates.stiffness, mesh.comm));
        C += rounded(dealii::Utilities::MPI::max(rates.damping, mesh.comm));
      }
    return 4. / (C + std::sqrt(C * C + 4. * K));
  }


  double ExplicitDynamics::highest_frequency(const unsigned int    first_level,
                                             const NodalField     &x,
                                             const PlasticHistory &memory) const
  {
    using dealii::Utilities::MPI::max;
    double bound = 0.;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (solid.cell_levels()[c] >= first_level)
        bound = std::max(bound, solid.cell_frequencies()[c]);
    bound = max(bound, mesh.comm);

    // No cell can vibrate as fast in the mesh as it would alone: Lanczos' method on M^-1 K finds how fast the
    // mesh does. Its largest Ritz value comes from below, hence the margin; the cells' bound stays the limit.
    const std::vector<double> inverse = free_inverse_masses();
    std::vector<double>       own_mass(state.v.size()), terms(state.v.size());
    for (unsigned int i = 0; i < own_mass.size(); ++i)
      own_mass[i] = inverse[i] > 0. && mesh.shared_nodes.is_owned(i) ? 1. / inverse[i] : 0.;
    const auto product = [&](const NodalField &a, const NodalField &b) {
      for (unsigned int i = 0; i < terms.size(); ++i)
        terms[i] = own_mass[i] * dot(a[i], b[i]);
      return reproducible_sum(
        terms.size(), [&](const std::size_t i) { return terms[i]; }, mesh.comm);
    };
    NodalField mode(state.v.size(), Vector3{}), mode_before(state.v.size(), Vector3{}), moved(state.v.size()),
      rate(state.v.size(), Vector3{}), f(state.v.size()), forces_at_x(state.v.size(), Vector3{});
    // Damping of the surface counts like stiffness: dt^2 K (1 + 2 beta/dt) + 2 dt C <= 4. Here it acts on
    // displacements as rates.
    const double   like_stiffness = 2. * solid.surface_damping() / (1. + 2. * parameters.damping_steps);
    MatchedSurface all_of_surface(mesh, solid);
    all_of_surface.select_all();
    const auto add_forces = [&](const NodalField &at, NodalField &forces) {
      solid.add_internal_forces(at.data(), rate.data(), forces.data(), memory, Levels{first_level});
      all_of_surface.add_forces(at.data(), rate.data(), forces.data(), like_stiffness, Levels{first_level});
      mesh.condense_hanging_nodes(forces.data());
      mesh.shared_nodes.sum(forces.data());
    };
    add_forces(x, forces_at_x);
    for (unsigned int i = 0; i < mode.size(); ++i)
      for (unsigned int d = 0; d < 3; ++d)
        mode[i][d] = inverse[i] > 0. ? random_at(mesh.nodes[i], d) : 0.;
    double                           size = std::sqrt(product(mode, mode));
    dealii::LAPACKFullMatrix<double> tridiagonal(lanczos_steps, lanczos_steps);
    tridiagonal = 0.;
    for (unsigned int k = 0; k < lanczos_steps && size > 0.; ++k)
      {
        for (Vector3 &row : mode)
          row *= 1. / size;
        mesh.distribute_hanging_nodes(mode.data());
        double largest = 0.;
        for (const Vector3 &row : mode)
          largest = std::max(largest, dot(row, row));
        const double scale = probing_displacement / std::sqrt(max(largest, mesh.comm));
        for (unsigned int i = 0; i < state.v.size(); ++i)
          {
            rate[i]  = scale * mode[i];
            moved[i] = x[i] + rate[i];
            f[i]     = Vector3{};
          }
        add_forces(moved, f);
        for (unsigned int i = 0; i < state.v.size(); ++i)
          f[i] = (inverse[i] / scale) * (forces_at_x[i] - f[i]);
        tridiagonal(k, k) = product(f, mode);
        for (unsigned int i = 0; i < state.v.size(); ++i)
          mode_before[i] = f[i] - tridiagonal(k, k) * mode[i] - size * mode_before[i];
        mode.swap(mode_before);
        size = std::sqrt(product(mode, mode));
        if (k + 1 < lanczos_steps)
          tridiagonal(k, k + 1) = tridiagonal(k + 1, k) = size;
      }
    tridiagonal.compute_eigenvalues();
    double highest = 0.;
    for (unsigned int k = 0; k < lanczos_steps; ++k)
      highest = std::max(highest, std::sqrt(std::max(0., tridiagonal.eigenvalue(k).real())));
    // Bulk viscosity damps high modes, which shortens the stable step: the cells' bound leaves room for it.
    return solid.has_bulk_viscosity() ? bound : std::min(bound, lanczos_margin * highest);
  }


  void ExplicitDynamics::add_forces_due(const unsigned int due)
  {
    const auto add_matched = [&](const unsigned int level) {
      totals.external_work.add(-matched_surface.advance(
        state.x_damped.data(), state.v.data(), state.force.data(), surface_damping_time(),
        state.damping_time + 0.5 * std::ldexp(state.time_step, level), Levels{level, level, true}));
    };
    totals.plastic.add(solid.update_internal_forces(state.x_damped.data(), state.v.data(), state.force.data(),
                                                    state.history, Levels{0, 0, true}));
    add_matched(0);
    Mesh::condense(levels.hanging[0].loaded, state.force.data());
    for (unsigned int level = 1; level <= max_level(); ++level)
      {
        SlowShares &shares = levels.slow_shares[level];
        if (level > due)
          {
            shares.for_nodes_up_to(due, [&](const std::size_t k, const double own) {
              state.force[shares.nodes[k]] += own * shares.steady[k];
            });
            continue;
          }
        for (std::size_t k = 0; k < shares.nodes.size(); ++k)
          force_before[k] = state.force[shares.nodes[k]];
        solid.add_elastic_forces(state.x_damped.data(), state.v.data(), state.force.data(),
                                 Levels{level, level, true});
        add_matched(level);
        Mesh::condense(levels.hanging[level].loaded, state.force.data());
        if (levels.reproducible)
          give_to_owners(shares);
        const double factor = std::ldexp(1., level);
        shares.for_nodes_up_to(level - 1, [&](const std::size_t k, const double own) {
          Vector3      &here = state.force[shares.nodes[k]];
          const Vector3 now  = (1. / factor) * (here - force_before[k]);
          const Vector3 change =
            quanta.force.round((levels.slow_shares_known ? follow : 1.) * (now - shares.steady[k]));
          shares.steady[k] += change;
          // The steady part acts on average half of (factor - own) steps late: what that takes from a
          // force that changes is given at once, or motion would be fed with energy.
          here -=
            (factor - own) * (levels.slow_shares_known ? shares.steady[k] - 0.5 * change : shares.steady[k]);
        });
      }
    levels.slow_shares_known = true;
  }


  void ExplicitDynamics::give_to_owners(const SlowShares &shares)
  {
    if (mesh.shared_nodes.nodes().empty())
      return;
    given_to_owners.assign(state.v.size(), Vector3{});
    for (const std::size_t k : shares.with_copies)
      {
        Vector3 &here                    = state.force[shares.nodes[k]];
        given_to_owners[shares.nodes[k]] = here - force_before[k];
        here                             = force_before[k];
      }
    mesh.shared_nodes.sum(given_to_owners.data());
    for (const std::size_t k : shares.with_copies)
      if (const unsigned int i = shares.nodes[k]; mesh.shared_nodes.is_owned(i))
        state.force[i] += given_to_owners[i];
  }


  unsigned int ExplicitDynamics::level_due() const
  {
    unsigned int level = max_level();
    while (state.n_steps % (std::uint64_t(1) << level) != 0)
      --level;
    return level;
  }


  void ExplicitDynamics::place_hanging_nodes()
  {
    if (synchronised())
      {
        for (Vector3 *field : {state.v.data(), state.x_damped.data()})
          mesh.distribute_hanging_nodes(field);
        return;
      }
    for (unsigned int level = 0; level <= level_due(); ++level)
      {
        Mesh::distribute(levels.hanging[level].placed, state.x_damped.data());
        if (solid.needs_velocity())
          Mesh::distribute(levels.hanging[level].placed, state.v.data());
      }
    Mesh::distribute(levels.hanging_at_contact, state.x_damped.data());
    Mesh::distribute(levels.hanging_at_contact, state.v.data());
  }
} // namespace tread
