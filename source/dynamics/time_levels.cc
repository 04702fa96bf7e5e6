// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tread
{
  namespace
  {
    /// Part of the way that the steady share of slow cells' forces goes to their present value when these are
    /// evaluated.
    constexpr double follow = 0.5;
  } // namespace


  void ExplicitDynamics::set_node_levels()
  {
    unsigned int max_level = 0;
    for (const unsigned int level : solid.cell_levels())
      max_level = std::max(max_level, level);
    max_level = dealii::Utilities::MPI::max(max_level, mesh.comm);
    level_of_node.assign(v.size(), max_level);
    for (unsigned int level = max_level; level-- > 0;)
      {
        // A node moves with its fastest cell on any rank, a parent with those of its hanging nodes, too.
        NodalField marks(v.size(), Row{});
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          if (solid.cell_levels()[c] == level)
            for (const unsigned int i : mesh.cells[c].nodes)
              marks[i][0] = 1.;
        if (level == 0)
          {
            for (const Mesh::Face &face : mesh.faces)
              if (face.boundary == Boundary::contact)
                for (const unsigned int i : face.nodes)
                  marks[i][0] = 1.;
            for (const unsigned int i : hub_nodes)
              marks[i][0] = 1.;
            if (supports)
              for (const unsigned int i : supports->nodes())
                marks[i][0] = 1.;
          }
        mesh.condense_hanging_nodes(marks.data());
        mesh.shared_nodes.sum(marks.data());
        for (unsigned int i = 0; i < marks.size(); ++i)
          if (marks[i][0] > 0.)
            level_of_node[i] = level;
      }
    // Forces on hanging nodes are their parents'.
    std::vector<const Mesh::HangingNode *> hangs(v.size(), nullptr);
    for (const Mesh::HangingNode &h : mesh.hanging_nodes)
      hangs[h.node] = &h;
    hanging.assign(max_level + 1, {});
    hanging_at_contact.clear();
    for (unsigned int body = 0; body < mesh.body_names.size(); ++body)
      for (const unsigned int i : boundary_nodes(body, Boundary::contact))
        if (hangs[i])
          hanging_at_contact.push_back(*hangs[i]);
    std::vector<char> is_placed(v.size(), false);
    for (unsigned int level = 0; level <= max_level; ++level)
      {
        std::vector<char> is_loaded(v.size(), false);
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          if (solid.cell_levels()[c] == level)
            for (const unsigned int i : mesh.cells[c].nodes)
              if (hangs[i] && !is_loaded[i])
                {
                  hanging[level].loaded.push_back(*hangs[i]);
                  is_loaded[i] = true;
                  if (!is_placed[i])
                    hanging[level].placed.push_back(*hangs[i]);
                  is_placed[i] = true;
                }
      }
    slow_shares.assign(max_level + 1, {});
    for (unsigned int level = 1; level <= max_level; ++level)
      {
        std::vector<char> is_shared(v.size(), false);
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          if (solid.cell_levels()[c] == level)
            for (const unsigned int i : mesh.cells[c].nodes)
              {
                if (!hangs[i])
                  is_shared[i] = true;
                else
                  for (const unsigned int parent : hangs[i]->parents)
                    is_shared[parent] = true;
              }
        SlowShares &shares = slow_shares[level];
        for (unsigned int own = 0; own < level; ++own)
          {
            for (unsigned int i = 0; i < v.size(); ++i)
              if (is_shared[i] && level_of_node[i] == own)
                shares.nodes.push_back(i);
            shares.end_of_level.push_back(shares.nodes.size());
          }
        shares.steady.assign(shares.nodes.size(), Row{});
        force_before.resize(std::max(force_before.size(), shares.nodes.size()));
      }
    // Hanging nodes are placed, not moved.
    const auto kind = [&](const unsigned int i) {
      return std::make_tuple(level_of_node[i], on_wheel[i], mesh.shared_nodes.is_owned(i),
                             hangs[i] != nullptr);
    };
    nodes_of_level.assign(max_level + 1, Runs());
    for (unsigned int begin = 0, end = 0; begin < v.size(); begin = end)
      {
        while (end < v.size() && kind(end) == kind(begin))
          ++end;
        if (!hangs[begin])
          nodes_of_level[level_of_node[begin]].push_back(
            {begin, end, bool(on_wheel[begin]), mesh.shared_nodes.is_owned(begin)});
      }
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
    NodalField reference(v.size());
    for (unsigned int i = 0; i < v.size(); ++i)
      reference[i] = Row{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.};
    critical_step = critical_time_step_of(highest_of_levels(reference, solid.virgin()));
    return critical_step;
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
    // Three digits, rounded up: the same step on any number of ranks.
    const auto rounded = [](const double value) {
      const double digit = std::pow(10., std::floor(std::log10(value)) - 2.);
      return value > 0. ? digit * std::ceil(value / digit) : 0.;
    };
    // Forces at x + beta v of half a step back, dampers with v of half a step back: dt^2 K + 2 dt C <= 4 for
    // the largest eigenvalues of M^-1 K (1 + 2 beta/dt) and M^-1 C, or their bounds by row sums.
    highest            = rounded(highest);
    highest_of_step    = highest;
    bound_found_stable = 0.;
    double K = highest * highest * (1. + 2. * parameters.damping_steps), C = 0.;
    if (supports)
      {
        const std::vector<double> inverse = free_inverse_masses();
        NodalField                rows(v.size(), Row{});
        supports->add_row_sums(rows.data());
        mesh.shared_nodes.sum(rows.data());
        double of_springs, of_dampers;
        supports->sleeper_row_sums(of_springs, of_dampers);
        for (unsigned int i = 0; i < rows.size(); ++i)
          {
            of_springs = std::max(of_springs, inverse[i] * rows[i][0]);
            of_dampers = std::max(of_dampers, inverse[i] * rows[i][1]);
          }
        K += rounded(dealii::Utilities::MPI::max(of_springs, mesh.comm));
        C = rounded(dealii::Utilities::MPI::max(of_dampers, mesh.comm));
      }
    // A node of level l moves with a step 2^l times as long.
    double of_nodes = 0.;
    for (const DampedNode &damped : damped_nodes)
      of_nodes = std::max(of_nodes, std::ldexp(damped.rate, level_of_node[damped.node]));
    C += rounded(dealii::Utilities::MPI::max(of_nodes, mesh.comm));
    return 4. / (C + std::sqrt(C * C + 4. * K));
  }


  double ExplicitDynamics::highest_frequency(const unsigned int    first_level,
                                             const NodalField     &x,
                                             const PlasticHistory &memory) const
  {
    using dealii::Utilities::MPI::max;
    using dealii::Utilities::MPI::sum;
    double bound = 0.;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (solid.cell_levels()[c] >= first_level)
        bound = std::max(bound, solid.cell_frequencies()[c]);
    bound = max(bound, mesh.comm);

    // No cell can vibrate as fast in the mesh as it would alone: Lanczos' method on M^-1 K finds how fast the
    // mesh does. Its largest Ritz value comes from below, hence the margin; the cells' bound stays the limit.
    constexpr unsigned int    iterations = 30;
    constexpr double          margin     = 1.005;
    const std::vector<double> inverse    = free_inverse_masses();
    const auto                product    = [&](const NodalField &a, const NodalField &b) {
      double of_rank = 0.;
      for (unsigned int i = 0; i < v.size(); ++i)
        if (inverse[i] > 0. && mesh.shared_nodes.is_owned(i))
          of_rank += dot(a[i], b[i]) / inverse[i];
      return sum(of_rank, mesh.comm);
    };
    NodalField mode(v.size(), Row{}), mode_before(v.size(), Row{}), moved(v.size()), at_rest(v.size(), Row{}),
      f(v.size()), forces_at_x(v.size(), Row{});
    const auto add_forces = [&](const NodalField &at, NodalField &forces) {
      solid.add_internal_forces(at.data(), at_rest.data(), forces.data(), memory, Levels{first_level});
      mesh.condense_hanging_nodes(forces.data());
      mesh.shared_nodes.sum(forces.data());
    };
    add_forces(x, forces_at_x);
    for (unsigned int i = 0; i < mode.size(); ++i)
      for (unsigned int d = 0; d < 3; ++d)
        {
          // Any numbers will do that depend on the place alone, not on the rank.
          const double wave =
            1e4 *
            std::sin(1e5 * (mesh.nodes[i][0] + 1.7 * mesh.nodes[i][1] + 2.3 * mesh.nodes[i][2]) + 2. * d);
          mode[i][d] = inverse[i] > 0. ? wave - std::floor(wave) - 0.5 : 0.;
        }
    double                           size = std::sqrt(product(mode, mode));
    dealii::LAPACKFullMatrix<double> tridiagonal(iterations, iterations);
    tridiagonal = 0.;
    for (unsigned int k = 0; k < iterations && size > 0.; ++k)
      {
        for (Row &row : mode)
          row *= 1. / size;
        mesh.distribute_hanging_nodes(mode.data());
        double largest = 0.;
        for (const Row &row : mode)
          largest = std::max(largest, dot(row, row));
        const double scale = 1e-9 / std::sqrt(max(largest, mesh.comm)); // m: small against any cell
        for (unsigned int i = 0; i < v.size(); ++i)
          {
            moved[i] = x[i] + scale * mode[i];
            f[i]     = Row{};
          }
        add_forces(moved, f);
        for (unsigned int i = 0; i < v.size(); ++i)
          f[i] = (inverse[i] / scale) * (forces_at_x[i] - f[i]);
        tridiagonal(k, k) = product(f, mode);
        for (unsigned int i = 0; i < v.size(); ++i)
          mode_before[i] = f[i] - tridiagonal(k, k) * mode[i] - size * mode_before[i];
        mode.swap(mode_before);
        size = std::sqrt(product(mode, mode));
        if (k + 1 < iterations)
          tridiagonal(k, k + 1) = tridiagonal(k + 1, k) = size;
      }
    tridiagonal.compute_eigenvalues();
    double highest = 0.;
    for (unsigned int k = 0; k < iterations; ++k)
      highest = std::max(highest, std::sqrt(std::max(0., tridiagonal.eigenvalue(k).real())));
    // Bulk viscosity damps high modes, which shortens the stable step: the cells' bound leaves room for it.
    return solid.needs_velocity() ? bound : std::min(bound, margin * highest);
  }


  void ExplicitDynamics::add_forces_due(const unsigned int due)
  {
    totals.plastic +=
      solid.update_internal_forces(x_damped.data(), v.data(), force.data(), history, Levels{0, 0, true});
    Mesh::condense(hanging[0].loaded, force.data());
    for (unsigned int level = 1; level <= max_level(); ++level)
      {
        SlowShares &shares = slow_shares[level];
        if (level > due)
          {
            shares.for_nodes_up_to(due, [&](const std::size_t k, const double own) {
              force[shares.nodes[k]] += own * shares.steady[k];
            });
            continue;
          }
        for (std::size_t k = 0; k < shares.nodes.size(); ++k)
          force_before[k] = force[shares.nodes[k]];
        solid.add_elastic_forces(x_damped.data(), v.data(), force.data(), Levels{level, level, true});
        Mesh::condense(hanging[level].loaded, force.data());
        const double factor = std::ldexp(1., level);
        shares.for_nodes_up_to(level - 1, [&](const std::size_t k, const double own) {
          Row      &here   = force[shares.nodes[k]];
          const Row now    = (1. / factor) * (here - force_before[k]);
          const Row change = slow_shares_known ? follow * (now - shares.steady[k]) : now;
          shares.steady[k] += change;
          // The steady part acts on average half of (factor - own) steps late: what that takes from a
          // force that changes is given at once, or motion would be fed with energy.
          here -= (factor - own) * (slow_shares_known ? shares.steady[k] - 0.5 * change : shares.steady[k]);
        });
      }
    slow_shares_known = true;
  }


  unsigned int ExplicitDynamics::level_due() const
  {
    unsigned int level = max_level();
    while (n_steps % (std::uint64_t(1) << level) != 0)
      --level;
    return level;
  }


  void ExplicitDynamics::place_hanging_nodes()
  {
    if (synchronised())
      {
        for (Row *field : {v.data(), x_damped.data()})
          mesh.distribute_hanging_nodes(field);
        return;
      }
    for (unsigned int level = 0; level <= level_due(); ++level)
      {
        Mesh::distribute(hanging[level].placed, x_damped.data());
        if (solid.needs_velocity())
          Mesh::distribute(hanging[level].placed, v.data());
      }
    Mesh::distribute(hanging_at_contact, x_damped.data());
    Mesh::distribute(hanging_at_contact, v.data());
  }
} // namespace tread
