// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/solid/matched_surface.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <type_traits>

namespace tread
{
  namespace
  {
    /// Set e_i = F E_i and A_mi = e_i . g_m, m.
    void set_amplitudes(const SurfaceModes &modes,
                        const Lanes (&F)[3][3],
                        const Lanes (&g)[4][3],
                        Lanes (&e)[2][3],
                        Lanes (&A)[2][4])
    {
      for (unsigned int i = 0; i < 2; ++i)
        {
          modes.turn(i, F, e[i]);
          for (unsigned int m = 0; m < 4; ++m)
            A[i][m] = e[i][0] * g[m][0] + e[i][1] * g[m][1] + e[i][2] * g[m][2];
        }
    }

    /// Sum of (w_mi - 1) A_mi^2, m^2.
    Lanes added_squares(const SurfaceModes &modes, const Lanes (&A)[2][4])
    {
      Lanes sum{};
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int m = 0; m < 4; ++m)
          sum += modes.added[m][i] * A[i][m] * A[i][m];
      return sum;
    }
  } // namespace


  MatchedSurface::MatchedSurface(const Mesh &mesh, const Solid &solid)
    : mesh(mesh)
    , solid(solid)
  {
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (solid.surface().find(c))
        cells.push_back(c);
    shares.assign(cells.size(), 0.);
    std::stable_sort(cells.begin(), cells.end(), [&](const unsigned int a, const unsigned int b) {
      return solid.cell_levels()[a] < solid.cell_levels()[b];
    });
  }


  template <typename Chosen>
  void MatchedSurface::select_if(const Chosen &is_chosen)
  {
    for (const Batch &batch : batches)
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        if (batch.cell[lane] != none)
          shares[batch.cell[lane]] = batch.share[lane];
    make_batches([&](const unsigned int k) -> std::optional<bool> {
      if (is_chosen(mesh.cells[cells[k]]))
        return true;
      return shares[k] > 0. ? std::optional<bool>(false) : std::nullopt;
    });
  }


  template <typename Wanted>
  void MatchedSurface::make_batches(const Wanted &is_wanted)
  {
    batches.resize(0);
    unsigned int lane = n_lanes;
    for (unsigned int k = 0; k < cells.size(); ++k)
      {
        const unsigned int        c      = cells[k];
        const std::optional<bool> wanted = is_wanted(k);
        if (!wanted)
          continue;
        const unsigned int level = solid.cell_levels()[c];
        if (lane == n_lanes || batches.back().level != level)
          {
            lane = 0;
            batches.emplace_back();
            batches.back().level = level;
            std::fill_n(batches.back().cell, n_lanes, none);
            for (unsigned int a = 0; a < 8; ++a)
              std::fill_n(batches.back().node[a], n_lanes, mesh.cells[c].nodes[a]);
          }
        const SurfaceCell &cell  = *solid.surface().find(c);
        Batch             &batch = batches.back();
        batch.set(lane, HexahedronIntegrals(mesh.corners(c)), cell.stiffness);
        batch.modes.set(lane, cell);
        batch.cell[lane]   = k;
        batch.share[lane]  = shares[k];
        batch.wanted[lane] = *wanted ? 1. : 0.;
        for (unsigned int a = 0; a < 8; ++a)
          batch.node[a][lane] = mesh.cells[c].nodes[a];
        if (solid.plastic().contains(c))
          for (auto &mode : batch.modes.added)
            for (Lanes &added : mode)
              added[lane] = 0.;
        ++lane;
      }
  }


  void MatchedSurface::select(const std::vector<unsigned int> &nodes)
  {
    std::vector<char> is_near(mesh.nodes.size(), false);
    for (const unsigned int i : nodes)
      is_near[i] = true;
    select_if([&](const Mesh::Cell &cell) {
      return std::any_of(cell.nodes.begin(), cell.nodes.end(),
                         [&](const unsigned int i) { return is_near[i]; });
    });
  }


  void MatchedSurface::select_all()
  {
    select_if([](const Mesh::Cell &) { return true; });
    settle();
  }


  void MatchedSurface::settle()
  {
    for (Batch &batch : batches)
      batch.share = batch.wanted;
  }


  std::size_t MatchedSurface::n_cells() const
  {
    std::size_t n = 0;
    for (const Batch &batch : batches)
      n += n_lanes - std::count(batch.cell, batch.cell + n_lanes, none);
    return n;
  }


  void MatchedSurface::serialize(Archive &archive)
  {
    struct Kept
    {
      Archive::Key node; ///< the first one of the cell
      double       share, wanted;
    };
    const auto key_of = [&](const unsigned int c) {
      return mesh.node_key(mesh.cells[c].nodes[0]);
    };
    std::vector<Kept> own;
    for (const Batch &batch : batches)
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        if (batch.cell[lane] != none)
          own.push_back({key_of(cells[batch.cell[lane]]), batch.share[lane], batch.wanted[lane]});
    const std::vector<Kept> all = archive.records(archive.restores() ? std::vector<Kept>() : own);
    if (!archive.restores())
      return;
    std::map<Archive::Key, const Kept *> by_key;
    for (const Kept &kept : all)
      by_key[kept.node] = &kept;
    std::fill(shares.begin(), shares.end(), 0.);
    make_batches([&](const unsigned int k) -> std::optional<bool> {
      const auto kept = by_key.find(key_of(cells[k]));
      if (kept == by_key.end())
        return {};
      if (!(kept->second->share >= 0. && kept->second->share <= 1.))
        archive.miss();
      shares[k] = kept->second->share;
      return kept->second->wanted > 0.;
    });
  }


  ReproducibleSum<double> MatchedSurface::energy(const Vector3 *x) const
  {
    ReproducibleSum<Lanes> sum;
    for (const Batch &batch : batches)
      {
        Lanes F[3][3], g[4][3], e[2][3], A[2][4];
        deform(batch, x, F, g);
        set_amplitudes(batch.modes, F, g, e, A);
        sum.add(0.5 * batch.share * batch.stiffness * added_squares(batch.modes, A));
      }
    return sum.of_lanes();
  }


  template <typename Batches, typename Rounding, typename Change>
  [[gnu::flatten]] void MatchedSurface::add(Batches       &batches,
                                            const Vector3 *x,
                                            const Vector3 *v,
                                            Vector3       *force,
                                            const double   time,
                                            const Levels   levels,
                                            const Rounding rounding,
                                            const Change  &change)
  {
    constexpr bool advances = !std::is_const_v<Batches>;
    for (auto &batch : batches)
      {
        if (batch.level < levels.first || batch.level > levels.last || !any(batch.share + batch.wanted > 0.))
          continue;
        Lanes F[3][3], g[4][3], F_rate[3][3] = {}, g_rate[4][3] = {};
        deform(batch, x, F, g);
        if (advances || time > 0.)
          deform(batch, v, F_rate, g_rate);
        Lanes e[2][3], A[2][4], A_rate[2][4];
        set_amplitudes(batch.modes, F, g, e, A);
        for (unsigned int i = 0; i < 2; ++i)
          {
            Lanes e_rate[3];
            batch.modes.turn(i, F_rate, e_rate);
            for (unsigned int m = 0; m < 4; ++m)
              A_rate[i][m] = e[i][0] * g_rate[m][0] + e[i][1] * g_rate[m][1] + e[i][2] * g_rate[m][2] +
                             e_rate[0] * g[m][0] + e_rate[1] * g[m][1] + e_rate[2] * g[m][2];
          }
        change(batch, A, A_rate);
        const Lanes stiffness =
          -(levels.weighted ? std::ldexp(1., batch.level) : 1.) * batch.share * batch.stiffness;
        Lanes P[3][3] = {}, Q[4][3] = {};
        for (unsigned int i = 0; i < 2; ++i)
          {
            Lanes turned[3] = {};
            for (unsigned int m = 0; m < 4; ++m)
              {
                const Lanes load = stiffness * (batch.modes.added[m][i] * A[i][m] + time * A_rate[i][m]);
                for (unsigned int j = 0; j < 3; ++j)
                  {
                    Q[m][j] += load * e[i][j];
                    turned[j] += load * g[m][j];
                  }
              }
            for (unsigned int j = 0; j < 3; ++j)
              for (unsigned int k = 0; k < 3; ++k)
                P[j][k] += turned[j] * batch.modes.axis[i][k];
          }
        add_forces_of(batch, force, P, Q, rounding);
      }
  }


  void MatchedSurface::add_forces(const Vector3 *x,
                                  const Vector3 *v,
                                  Vector3       *force,
                                  const double   time,
                                  const Levels   levels) const
  {
    const auto stays = [](const Batch &, const auto &, const auto &) {
    };
    if (solid.reproducible())
      add(batches, x, v, force, time, levels, solid.force_quantum(), stays);
    else
      add(batches, x, v, force, time, levels, NoRounding(), stays);
  }


  ReproducibleSum<double> MatchedSurface::advance(const Vector3 *x,
                                                  const Vector3 *v,
                                                  Vector3       *force,
                                                  const double   time,
                                                  const double   back,
                                                  const Levels   levels)
  {
    ReproducibleSum<Lanes> lost;
    const auto             change = [&](Batch &batch, const Lanes(&A)[2][4], const Lanes(&A_rate)[2][4]) {
      // Forces do work with the mean of those at both ends of a step, one with the old shares and one with
      // the new: what is stored changes as if in the middle.
      const double longest = std::ldexp(1. / steps_to_grow, batch.level);
      const Lanes  way     = batch.wanted - batch.share;
      const Lanes  most    = broadcast(longest);
      const Lanes  grown   = way > most ? most : (way < -most ? -most : way);
      Lanes        middle[2][4];
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int m = 0; m < 4; ++m)
          middle[i][m] = A[i][m] - back * A_rate[i][m];
      lost.add(-0.5 * grown * batch.stiffness * added_squares(batch.modes, middle));
      batch.share += grown;
    };
    if (solid.reproducible())
      add(batches, x, v, force, time, levels, solid.force_quantum(), change);
    else
      add(batches, x, v, force, time, levels, NoRounding(), change);
    return lost.of_lanes();
  }
} // namespace tread
