// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/solid/matched_surface.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  MatchedSurface::MatchedSurface(const Mesh &mesh, const Solid &solid)
    : mesh(mesh)
    , solid(solid)
  {
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (solid.surface().find(c))
        cells.push_back(c);
    std::stable_sort(cells.begin(), cells.end(), [&](const unsigned int a, const unsigned int b) {
      return solid.cell_levels()[a] < solid.cell_levels()[b];
    });
  }


  template <typename Chosen>
  void MatchedSurface::select_if(const Chosen &is_chosen)
  {
    batches.resize(0);
    n_cells           = 0;
    unsigned int lane = n_lanes;
    for (const unsigned int c : cells)
      {
        if (!is_chosen(mesh.cells[c]))
          continue;
        const unsigned int level = solid.cell_levels()[c];
        if (lane == n_lanes || batches.back().level != level)
          {
            lane = 0;
            batches.emplace_back();
            batches.back().level = level;
            for (unsigned int a = 0; a < 8; ++a)
              std::fill_n(batches.back().node[a], n_lanes, mesh.cells[c].nodes[a]);
          }
        const SurfaceCell &cell  = *solid.surface().find(c);
        Batch             &batch = batches.back();
        batch.set(lane, HexahedronIntegrals(mesh.corners(c)), cell.stiffness);
        batch.modes.set(lane, cell);
        for (unsigned int a = 0; a < 8; ++a)
          batch.node[a][lane] = mesh.cells[c].nodes[a];
        if (solid.plastic().contains(c))
          for (auto &mode : batch.modes.added)
            for (Lanes &added : mode)
              added[lane] = 0.;
        ++lane;
        ++n_cells;
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
  }


  ReproducibleSum<double> MatchedSurface::energy(const Vector3 *x) const
  {
    ReproducibleSum<Lanes> sum;
    for (const Batch &batch : batches)
      {
        Lanes F[3][3], amplitude[4][3];
        deform(batch, x, F, amplitude);
        Lanes squares{};
        for (unsigned int i = 0; i < 2; ++i)
          {
            Lanes e[3];
            batch.modes.turn(i, F, e);
            for (unsigned int m = 0; m < 4; ++m)
              {
                const Lanes A = e[0] * amplitude[m][0] + e[1] * amplitude[m][1] + e[2] * amplitude[m][2];
                squares += batch.modes.added[m][i] * A * A;
              }
          }
        sum.add(0.5 * batch.stiffness * squares);
      }
    return sum.of_lanes();
  }


  void MatchedSurface::add_forces(const Vector3 *x,
                                  const Vector3 *v,
                                  Vector3       *force,
                                  const double   time,
                                  const Levels   levels) const
  {
    if (solid.reproducible())
      add_forces(x, v, force, time, levels, solid.force_quantum());
    else
      add_forces(x, v, force, time, levels, NoRounding());
  }


  template <typename Rounding>
  void MatchedSurface::add_forces(const Vector3 *x,
                                  const Vector3 *v,
                                  Vector3       *force,
                                  const double   time,
                                  const Levels   levels,
                                  const Rounding rounding) const
  {
    for (const Batch &batch : batches)
      {
        if (batch.level < levels.first || batch.level > levels.last)
          continue;
        Lanes F[3][3], amplitude[4][3], F_rate[3][3] = {}, rate[4][3] = {};
        deform(batch, x, F, amplitude);
        if (time > 0.)
          deform(batch, v, F_rate, rate);
        const Lanes stiffness = -(levels.weighted ? std::ldexp(1., batch.level) : 1.) * batch.stiffness;
        Lanes       P[3][3] = {}, Q[4][3] = {};
        for (unsigned int i = 0; i < 2; ++i)
          {
            Lanes e[3], e_rate[3], turned[3] = {};
            batch.modes.turn(i, F, e);
            batch.modes.turn(i, F_rate, e_rate);
            for (unsigned int m = 0; m < 4; ++m)
              {
                const Lanes(&g)[3] = amplitude[m];
                const Lanes A      = e[0] * g[0] + e[1] * g[1] + e[2] * g[2];
                const Lanes A_rate = e[0] * rate[m][0] + e[1] * rate[m][1] + e[2] * rate[m][2] +
                                     e_rate[0] * g[0] + e_rate[1] * g[1] + e_rate[2] * g[2];
                const Lanes load = stiffness * (batch.modes.added[m][i] * A + time * A_rate);
                for (unsigned int j = 0; j < 3; ++j)
                  {
                    Q[m][j] += load * e[j];
                    turned[j] += load * g[j];
                  }
              }
            for (unsigned int j = 0; j < 3; ++j)
              for (unsigned int k = 0; k < 3; ++k)
                P[j][k] += turned[j] * batch.modes.axis[i][k];
          }
        add_forces_of(batch, force, P, Q, rounding);
      }
  }
} // namespace tread
