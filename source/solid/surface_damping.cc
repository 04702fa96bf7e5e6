// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/solid/surface_damping.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tread
{
  SurfaceDamping::SurfaceDamping(const Mesh &mesh, const Solid &solid)
    : n_nodes(mesh.nodes.size())
    , reproducible(solid.reproducible())
    , quantum(solid.force_quantum())
  {
    std::map<unsigned int, std::vector<unsigned int>> cells_of_level;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (solid.surface().find(c))
        cells_of_level[solid.cell_levels()[c]].push_back(c);
    for (const auto &[level, cells] : cells_of_level)
      for (std::size_t k = 0; k < cells.size(); ++k)
        {
          const unsigned int c = cells[k], lane = k % n_lanes;
          if (lane == 0)
            {
              batches.emplace_back();
              batches.back().level = level;
              for (unsigned int a = 0; a < 8; ++a)
                std::fill_n(batches.back().node[a], n_lanes, mesh.cells[c].nodes[a]);
            }
          Batch &batch = batches.back();
          batch.set(lane, HexahedronIntegrals(mesh.corners(c)), solid.surface().find(c)->stiffness);
          for (unsigned int a = 0; a < 8; ++a)
            batch.node[a][lane] = mesh.cells[c].nodes[a];
          const auto &axes = solid.surface().find(c)->axes;
          for (unsigned int i = 0; i < 2; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              batch.axis[i][j][lane] = axes[i][j];
        }
  }


  template <typename Select>
  void SurfaceDamping::select_if(const Select &selects)
  {
    active.clear();
    for (std::size_t b = 0; b < batches.size(); ++b)
      {
        Batch &batch   = batches[b];
        batch.selected = Lanes{};
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          for (unsigned int a = 0; a < 8; ++a)
            if (batch.stiffness[lane] > 0. && selects(batch.node[a][lane]))
              batch.selected[lane] = 1.;
        if (any(batch.selected > 0.))
          active.push_back(b);
      }
  }


  void SurfaceDamping::select(const std::vector<unsigned int> &nodes)
  {
    std::vector<char> is_near(n_nodes, 0);
    for (const unsigned int i : nodes)
      is_near[i] = 1;
    select_if([&](const unsigned int i) { return is_near[i] != 0; });
  }


  void SurfaceDamping::select_all()
  {
    select_if([](const unsigned int) { return true; });
  }


  unsigned int SurfaceDamping::n_selected() const
  {
    double sum = 0.;
    for (const std::size_t b : active)
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        sum += batches[b].selected[lane];
    return std::lround(sum);
  }


  void SurfaceDamping::add_forces(const Vector3 *x,
                                  const Vector3 *v,
                                  Vector3       *force,
                                  const double   time,
                                  const Levels   levels) const
  {
    if (time == 0.)
      return;
    if (reproducible)
      add_forces(x, v, force, time, levels, quantum);
    else
      add_forces(x, v, force, time, levels, NoRounding());
  }


  template <typename Rounding>
  void SurfaceDamping::add_forces(const Vector3 *x,
                                  const Vector3 *v,
                                  Vector3       *force,
                                  const double   time,
                                  const Levels   levels,
                                  const Rounding rounding) const
  {
    for (const std::size_t b : active)
      {
        const Batch &batch = batches[b];
        if (batch.level < levels.first || batch.level > levels.last)
          continue;
        Lanes F[3][3], amplitude[4][3], F_rate[3][3], rate[4][3];
        deform(batch, x, F, amplitude);
        deform(batch, v, F_rate, rate);
        const Lanes damping =
          -time * (levels.weighted ? std::ldexp(1., batch.level) : 1.) * batch.selected * batch.stiffness;
        Lanes P[3][3] = {}, Q[4][3] = {};
        for (unsigned int i = 0; i < 2; ++i)
          {
            const Lanes(&E)[3] = batch.axis[i];
            Lanes e[3], e_rate[3], turned[3] = {};
            for (unsigned int j = 0; j < 3; ++j)
              {
                e[j]      = F[j][0] * E[0] + F[j][1] * E[1] + F[j][2] * E[2];
                e_rate[j] = F_rate[j][0] * E[0] + F_rate[j][1] * E[1] + F_rate[j][2] * E[2];
              }
            for (unsigned int m = 0; m < 4; ++m)
              {
                const Lanes(&g)[3] = amplitude[m];
                const Lanes load   = damping * (e[0] * rate[m][0] + e[1] * rate[m][1] + e[2] * rate[m][2] +
                                              e_rate[0] * g[0] + e_rate[1] * g[1] + e_rate[2] * g[2]);
                for (unsigned int j = 0; j < 3; ++j)
                  {
                    Q[m][j] += load * e[j];
                    turned[j] += load * g[j];
                  }
              }
            for (unsigned int j = 0; j < 3; ++j)
              for (unsigned int k = 0; k < 3; ++k)
                P[j][k] += turned[j] * E[k];
          }
        add_forces_of(batch, force, P, Q, rounding);
      }
  }
} // namespace tread
