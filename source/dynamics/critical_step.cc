// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/critical_step.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
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


  double CriticalStep::seconds() const
  {
    if (critical_step > 0.)
      return critical_step;
    // The stress-free reference configuration is used instead of the present one: small strain changes the
    // result by less than the margin.
    NodalField reference(moving.state.v.size());
    for (unsigned int i = 0; i < moving.state.v.size(); ++i)
      reference[i] = Vector3{moving.mesh.nodes[i][0], moving.mesh.nodes[i][1], moving.mesh.nodes[i][2], 0.};
    critical_step = step_for(highest_of_levels(reference, moving.solid.virgin()));
    return critical_step;
  }


  double CriticalStep::slowed_by_supports() const
  {
    return 2. / (highest_of_step * std::sqrt(1. + 2. * moving.parameters.damping_steps) * seconds());
  }


  double CriticalStep::highest_of_levels(const NodalField &x, const PlasticHistory &memory) const
  {
    double highest = 0.;
    for (unsigned int level = 0; level <= moving.max_level(); ++level)
      highest = std::max(highest, std::ldexp(highest_frequency(level, x, memory), level));
    return highest;
  }


  double CriticalStep::step_for(double highest) const
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
    double                    K = highest * highest * (1. + 2. * moving.parameters.damping_steps), C = 0.;
    const std::vector<double> inverse = moving.free_inverse_masses();
    for (const auto &part : moving.parts)
      {
        NodalField rows(moving.state.v.size(), Vector3{});
        part->add_row_sums(rows);
        moving.mesh.shared_nodes.sum(rows.data());
        Part::OwnRates rates = part->own_rates(moving.levels);
        for (unsigned int i = 0; i < rows.size(); ++i)
          {
            rates.stiffness = std::max(rates.stiffness, inverse[i] * rows[i][0]);
            rates.damping   = std::max(rates.damping, inverse[i] * rows[i][1]);
          }
        K += rounded(dealii::Utilities::MPI::max(rates.stiffness, moving.mesh.comm));
        C += rounded(dealii::Utilities::MPI::max(rates.damping, moving.mesh.comm));
      }
    return 4. / (C + std::sqrt(C * C + 4. * K));
  }


  double CriticalStep::highest_frequency(const unsigned int    first_level,
                                         const NodalField     &x,
                                         const PlasticHistory &memory) const
  {
    using dealii::Utilities::MPI::max;
    double bound = 0.;
    for (unsigned int c = 0; c < moving.mesh.cells.size(); ++c)
      if (moving.solid.cell_levels()[c] >= first_level)
        bound = std::max(bound, moving.solid.cell_frequencies()[c]);
    bound = max(bound, moving.mesh.comm);

    // No cell can vibrate as fast in the mesh as it would alone: Lanczos' method on M^-1 K finds how fast the
    // mesh does. Its largest Ritz value comes from below, hence the margin; the cells' bound stays the limit.
    const std::vector<double> inverse = moving.free_inverse_masses();
    std::vector<double>       own_mass(moving.state.v.size()), terms(moving.state.v.size());
    for (unsigned int i = 0; i < own_mass.size(); ++i)
      own_mass[i] = inverse[i] > 0. && moving.mesh.shared_nodes.is_owned(i) ? 1. / inverse[i] : 0.;
    const auto product = [&](const NodalField &a, const NodalField &b) {
      for (unsigned int i = 0; i < terms.size(); ++i)
        terms[i] = own_mass[i] * dot(a[i], b[i]);
      return reproducible_sum(
        terms.size(), [&](const std::size_t i) { return terms[i]; }, moving.mesh.comm);
    };
    NodalField mode(moving.state.v.size(), Vector3{}), mode_before(moving.state.v.size(), Vector3{}),
      moved(moving.state.v.size()), rate(moving.state.v.size(), Vector3{}), f(moving.state.v.size()),
      forces_at_x(moving.state.v.size(), Vector3{});
    // Damping of the surface counts like stiffness: dt^2 K (1 + 2 beta/dt) + 2 dt C <= 4. Here it acts on
    // displacements as rates.
    const double like_stiffness =
      2. * moving.solid.surface_damping() / (1. + 2. * moving.parameters.damping_steps);
    MatchedSurface all_of_surface(moving.mesh, moving.solid);
    all_of_surface.select_all();
    const auto add_forces = [&](const NodalField &at, NodalField &forces) {
      moving.solid.add_internal_forces(at.data(), rate.data(), forces.data(), memory, Levels{first_level});
      all_of_surface.add_forces(at.data(), rate.data(), forces.data(), like_stiffness, Levels{first_level});
      moving.mesh.condense_hanging_nodes(forces.data());
      moving.mesh.shared_nodes.sum(forces.data());
    };
    add_forces(x, forces_at_x);
    for (unsigned int i = 0; i < mode.size(); ++i)
      for (unsigned int d = 0; d < 3; ++d)
        mode[i][d] = inverse[i] > 0. ? random_at(moving.mesh.nodes[i], d) : 0.;
    double                           size = std::sqrt(product(mode, mode));
    dealii::LAPACKFullMatrix<double> tridiagonal(lanczos_steps, lanczos_steps);
    tridiagonal = 0.;
    for (unsigned int k = 0; k < lanczos_steps && size > 0.; ++k)
      {
        for (Vector3 &row : mode)
          row *= 1. / size;
        moving.mesh.distribute_hanging_nodes(mode.data());
        double largest = 0.;
        for (const Vector3 &row : mode)
          largest = std::max(largest, dot(row, row));
        const double scale = probing_displacement / std::sqrt(max(largest, moving.mesh.comm));
        for (unsigned int i = 0; i < moving.state.v.size(); ++i)
          {
            rate[i]  = scale * mode[i];
            moved[i] = x[i] + rate[i];
            f[i]     = Vector3{};
          }
        add_forces(moved, f);
        for (unsigned int i = 0; i < moving.state.v.size(); ++i)
          f[i] = (inverse[i] / scale) * (forces_at_x[i] - f[i]);
        tridiagonal(k, k) = product(f, mode);
        for (unsigned int i = 0; i < moving.state.v.size(); ++i)
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
    return moving.solid.has_bulk_viscosity() ? bound : std::min(bound, lanczos_margin * highest);
  }


  void CriticalStep::renew()
  {
    critical_step = step_for(highest_of_levels(moving.state.positions(), moving.state.history));
  }
} // namespace tread
