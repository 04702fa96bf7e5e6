// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/solid/hexahedron.h>
#include <tread/solid/plastic_cells.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <type_traits>

namespace tread
{
  std::array<long long, 4> PlasticCells::key_of(const unsigned int body, const dealii::Point<3> &centre)
  {
    return {
      {body, std::llround(1e9 * centre[0]), std::llround(1e9 * centre[1]), std::llround(1e9 * centre[2])}};
  }


  int zone_at(const std::vector<PlasticZone> &zones, const unsigned int body, const dealii::Point<3> &centre)
  {
    for (unsigned int z = zones.size(); z-- > 0;)
      if (zones[z].body == body && zones[z].contains(centre))
        return zones[z].material.yield_stress > 0. ? z : -1;
    return -1;
  }


  PlasticCells::PlasticCells(const Mesh                         &mesh,
                             const std::vector<ElasticMaterial> &materials,
                             const std::vector<PlasticZone>     &zones,
                             const double                        hourglass_coefficient,
                             const Quantum                       force_quantum,
                             const SurfaceLayer                 &surface)
    : force_quantum(force_quantum)
  {
    if (zones.empty())
      return;
    zone_of_cell.assign(mesh.cells.size(), -1);
    std::vector<dealii::Point<3>> centers(mesh.cells.size());
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        for (const unsigned int i : mesh.cells[c].nodes)
          centers[c] += mesh.nodes[i] / 8.;
        if (mesh.cells[c].has_own_material())
          zone_of_cell[c] = zone_at(zones, mesh.cells[c].body, centers[c]);
      }

    std::size_t size = 0;
    for (unsigned int z = 0; z < zones.size(); ++z)
      {
        if (zones[z].material.backstresses.size() > PlasticMaterial::max_backstresses)
          throw std::invalid_argument("a material has at most three backstresses");
        for (const bool is_surface : {false, true})
          {
            Range range{batches.size(), 0,          size,        materials[zones[z].body], zones[z].material,
                        zones[z].body,  is_surface, modes.size()};
            unsigned int lane = n_lanes;
            for (unsigned int c = 0; c < mesh.cells.size(); ++c)
              if (const SurfaceCell *of_surface = surface.find(c);
                  zone_of_cell[c] == static_cast<int>(z) && (of_surface != nullptr) == is_surface)
                {
                  const HexahedronIntegrals integrals(mesh.corners(c));
                  const double              stiffness =
                    hourglass_stiffness(integrals, range.elastic, hourglass_coefficient);
                  if (lane == n_lanes)
                    {
                      lane = 0;
                      cell_of_lane.emplace_back();
                      cell_of_lane.back().fill(-1);
                      if (is_surface)
                        modes.emplace_back();
                      // Padded lanes repeat the first cell, without volume and hourglass stiffness: no
                      // forces.
                      batches.emplace_back();
                      for (unsigned int l = 0; l < n_lanes; ++l)
                        {
                          for (unsigned int a = 0; a < 8; ++a)
                            batches.back().node[a][l] = mesh.cells[c].nodes[a];
                          batches.back().set(l, integrals, 0.);
                          batches.back().volume[l] = 0.;
                        }
                    }
                  Batch &batch              = batches.back();
                  cell_of_lane.back()[lane] = c;
                  batch.set(lane, integrals, stiffness);
                  if (is_surface)
                    modes.back().set(lane, *of_surface);
                  for (unsigned int a = 0; a < 8; ++a)
                    batch.node[a][lane] = mesh.cells[c].nodes[a];
                  keys.push_back(key_of(mesh.cells[c].body, centers[c]));
                  ++lane;
                }
            range.end = batches.size();
            size += (range.end - range.begin) * range.stride();
            ranges.push_back(range);
          }
      }
  }


  template <typename Work>
  void PlasticCells::for_ranges(const Work &work) const
  {
    for (const Range &range : ranges)
      switch (range.plastic.backstresses.size())
        {
        case 0:
          work(range, std::integral_constant<unsigned int, 0>());
          break;
        case 1:
          work(range, std::integral_constant<unsigned int, 1>());
          break;
        case 2:
          work(range, std::integral_constant<unsigned int, 2>());
          break;
        default:
          work(range, std::integral_constant<unsigned int, 3>());
        }
  }


  PlasticHistory PlasticCells::virgin_history() const
  {
    PlasticHistory history;
    for (const Range &range : ranges)
      for (std::size_t b = range.begin; b < range.end; ++b)
        for (std::size_t k = 0; k < range.stride(); ++k)
          history.values.push_back(broadcast(k < 3 ? 1. : 0.));
    return history;
  }


  void PlasticCells::forget(const unsigned int body, PlasticHistory &history) const
  {
    for (const Range &range : ranges)
      if (range.body == body)
        for (std::size_t b = range.begin; b < range.end; ++b)
          for (std::size_t k = 0; k < range.stride(); ++k)
            history.values[range.history + (b - range.begin) * range.stride() + k] =
              broadcast(k < 3 ? 1. : 0.);
  }


  /// A batch at given nodal positions.
  template <unsigned int n>
  struct PlasticCells::State
  {
    Lanes           F[3][3], R[3][3];
    Lanes           amplitude[4][3]; ///< elastic part of the hourglass amplitudes, after the flow
    Lanes           flowed[4][3];    ///< plastic part of the same, carried with F
    PlasticPoint<n> point;

    /// @param memory of the batch.
    void evaluate(const YieldConstants<n> &material,
                  const Batch             &batch,
                  const Vector3           *x,
                  const Lanes             *memory)
    {
      deform(batch, x, F, amplitude);
      Lanes G[6];
      for (unsigned int k = 0; k < 6; ++k)
        G[k] = memory[k];
      point.plastic_strain = memory[strain_at];
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int k = 0; k < 6; ++k)
          point.backstress[i][k] = memory[backstress_at + 6 * i + k];
      if constexpr (n == 0)
        point.evaluate(material, F, G);
      else
        {
          polar_rotation(F, R);
          Lanes U[3][3];
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              U[i][j] = R[0][i] * F[0][j] + R[1][i] * F[1][j] + R[2][i] * F[2][j];
          point.evaluate(material, U, G);
        }
      // The hourglass modes yield with the cell: what a common plastic multiplier does to any deviatoric part
      // of the stress in it.
      for (unsigned int m = 0; m < 4; ++m)
        for (unsigned int j = 0; j < 3; ++j)
          flowed[m][j] = memory[hourglass_at + 3 * m + j];
      Lanes inverse[3][3];
      if constexpr (n == 0)
        std::copy(&point.inverse[0][0], &point.inverse[0][0] + 9, &inverse[0][0]);
      else
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            inverse[i][j] =
              point.inverse[i][0] * R[j][0] + point.inverse[i][1] * R[j][1] + point.inverse[i][2] * R[j][2];
      for (unsigned int m = 0; m < 4; ++m)
        {
          Lanes lost[3];
          for (unsigned int i = 0; i < 3; ++i)
            {
              amplitude[m][i] -= F[i][0] * flowed[m][0] + F[i][1] * flowed[m][1] + F[i][2] * flowed[m][2];
              lost[i] = point.flow.share * amplitude[m][i];
              amplitude[m][i] -= lost[i];
            }
          for (unsigned int j = 0; j < 3; ++j)
            flowed[m][j] += inverse[j][0] * lost[0] + inverse[j][1] * lost[1] + inverse[j][2] * lost[2];
        }
    }

    /// Set e to an axis of the surface over its length: in steel that yields this is not near 1. @returns one
    /// over the length.
    Lanes unit_axis(const SurfaceModes &modes, const unsigned int i, Lanes (&e)[3]) const
    {
      modes.turn(i, F, e);
      // Newton's method from a value that is right for no stretch: to round-off for stretches up to 2.
      const Lanes square  = e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
      Lanes       inverse = 2. / (1. + square);
      for (unsigned int pass = 0; pass < 6; ++pass)
        inverse *= 1.5 - 0.5 * square * inverse * inverse;
      for (Lanes &component : e)
        component *= inverse;
      return inverse;
    }

    /// Add to the forces Q on the amplitudes, and to P, what the weights of the surface change.
    void add_weighted(const SurfaceModes &modes,
                      const Lanes         stiffness,
                      Lanes (&Q)[4][3],
                      Lanes (&P)[3][3]) const
    {
      for (unsigned int i = 0; i < 2; ++i)
        {
          Lanes       e[3], turned[3] = {}, along{};
          const Lanes inverse_length = unit_axis(modes, i, e);
          for (unsigned int m = 0; m < 4; ++m)
            {
              const Lanes(&g)[3] = amplitude[m];
              const Lanes A      = e[0] * g[0] + e[1] * g[1] + e[2] * g[2];
              const Lanes load   = stiffness * modes.added[m][i] * A;
              for (unsigned int j = 0; j < 3; ++j)
                {
                  Q[m][j] += load * e[j];
                  turned[j] += load * g[j];
                }
              along += load * A;
            }
          for (unsigned int j = 0; j < 3; ++j)
            for (unsigned int k = 0; k < 3; ++k)
              P[j][k] += inverse_length * (turned[j] - along * e[j]) * modes.axis[i][k];
        }
    }

    /// @param stiffness of the amplitudes, N/m. @param modes null: below the surface.
    Lanes hourglass_energy(const Lanes stiffness, const SurfaceModes *modes) const
    {
      Lanes sum{};
      for (const auto &mode : amplitude)
        for (const Lanes &component : mode)
          sum += component * component;
      for (unsigned int i = 0; modes && i < 2; ++i)
        {
          Lanes e[3];
          unit_axis(*modes, i, e);
          for (unsigned int m = 0; m < 4; ++m)
            {
              const Lanes A = e[0] * amplitude[m][0] + e[1] * amplitude[m][1] + e[2] * amplitude[m][2];
              sum += modes->added[m][i] * A * A;
            }
        }
      return 0.5 * stiffness * sum;
    }

    /// First Piola-Kirchhoff stress P = tau F^-T.
    void first_piola(Lanes (&P)[3][3]) const
    {
      Lanes in_frame[3][3];
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          in_frame[i][j] = point.kirchhoff[symmetric_index[i][0]] * point.inverse[j][0] +
                           point.kirchhoff[symmetric_index[i][1]] * point.inverse[j][1] +
                           point.kirchhoff[symmetric_index[i][2]] * point.inverse[j][2];
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          if constexpr (n == 0)
            P[i][j] = in_frame[i][j];
          else
            P[i][j] = R[i][0] * in_frame[0][j] + R[i][1] * in_frame[1][j] + R[i][2] * in_frame[2][j];
    }
  };


  template <unsigned int n, bool updates, typename History>
  ReproducibleSum<double> PlasticCells::add_forces(const Range   &range,
                                                   const Vector3 *x,
                                                   Vector3       *force,
                                                   History       &history) const
  {
    const YieldConstants<n> material(range.elastic, range.plastic);
    ReproducibleSum<Lanes>  work;
    for (std::size_t b = range.begin; b < range.end; ++b)
      {
        const Batch &batch  = batches[b];
        auto *const  memory = history.values.data() + range.history + (b - range.begin) * range.stride();
        State<n>     state;
        state.evaluate(material, batch, x, memory);
        Lanes P[3][3];
        state.first_piola(P);
        for (auto &row : P)
          for (Lanes &component : row)
            component *= -batch.volume;
        Lanes                     restoring[4][3];
        const SurfaceModes *const of_surface = range.modes_of(modes, b);
        for (unsigned int m = 0; m < 4; ++m)
          for (unsigned int i = 0; i < 3; ++i)
            restoring[m][i] = -batch.stiffness * state.amplitude[m][i];
        if (of_surface)
          state.add_weighted(*of_surface, -batch.stiffness, restoring, P);
        // What the amplitudes do, differentiated: their plastic part is carried with F.
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            for (unsigned int m = 0; m < 4; ++m)
              P[i][j] -= restoring[m][i] * state.flowed[m][j];
        add_forces_of(batch, force, P, restoring, force_quantum);
        if constexpr (updates)
          {
            const auto yields = state.point.flow.strain > 0.;
            if (any(yields))
              {
                Lanes G[6];
                state.point.plastic_inverse(G);
                for (unsigned int k = 0; k < 6; ++k)
                  memory[k] = yields ? G[k] : memory[k];
                memory[strain_at] = state.point.plastic_strain;
                for (unsigned int m = 0; m < 4; ++m)
                  for (unsigned int j = 0; j < 3; ++j)
                    memory[hourglass_at + 3 * m + j] = state.flowed[m][j];
                for (unsigned int i = 0; i < n; ++i)
                  for (unsigned int k = 0; k < 6; ++k)
                    memory[backstress_at + 6 * i + k] = state.point.backstress[i][k];
                // Amplitudes that shrink to the share 1 - s lose 1 - (1 - s)^2 of their energy.
                const Lanes left = 1. - state.point.flow.share;
                work.add(batch.volume * state.point.flow.work +
                         state.hourglass_energy(batch.stiffness, of_surface) * (1. / (left * left) - 1.));
              }
          }
      }
    return work.of_lanes();
  }


  void PlasticCells::add_forces(const Vector3 *x, Vector3 *force, const PlasticHistory &history) const
  {
    for_ranges([&](const Range &range, const auto n) { add_forces<n(), false>(range, x, force, history); });
  }


  ReproducibleSum<double> PlasticCells::update(const Vector3  *x,
                                               Vector3        *force,
                                               PlasticHistory &history) const
  {
    ReproducibleSum<double> work;
    for_ranges(
      [&](const Range &range, const auto n) { work.add(add_forces<n(), true>(range, x, force, history)); });
    return work;
  }


  std::array<ReproducibleSum<double>, 2> PlasticCells::energies(const Vector3        *x,
                                                                const PlasticHistory &history) const
  {
    ReproducibleSum<Lanes> strain, hourglass;
    for_ranges([&](const Range &range, const auto n) {
      const YieldConstants<n()> material(range.elastic, range.plastic);
      for (std::size_t b = range.begin; b < range.end; ++b)
        {
          State<n()> state;
          state.evaluate(material, batches[b], x,
                         history.values.data() + range.history + (b - range.begin) * range.stride());
          strain.add(batches[b].volume * state.point.energy);
          hourglass.add(state.hourglass_energy(batches[b].stiffness, range.modes_of(modes, b)));
        }
    });
    return {{strain.of_lanes(), hourglass.of_lanes()}};
  }


  void PlasticCells::cauchy_stress(const Vector3                      *x,
                                   const PlasticHistory               &history,
                                   std::vector<std::array<double, 6>> &stress,
                                   const std::vector<char>            &wanted) const
  {
    for_ranges([&](const Range &range, const auto n) {
      const YieldConstants<n()> material(range.elastic, range.plastic);
      for (std::size_t b = range.begin; b < range.end; ++b)
        {
          if (!wanted.empty() && std::none_of(cell_of_lane[b].begin(), cell_of_lane[b].end(),
                                              [&](const int c) { return c >= 0 && wanted[c]; }))
            continue;
          State<n()> state;
          state.evaluate(material, batches[b], x,
                         history.values.data() + range.history + (b - range.begin) * range.stride());
          Lanes sigma[6], inverse[3][3];
          if constexpr (n() == 0)
            std::copy(std::begin(state.point.kirchhoff), std::end(state.point.kirchhoff), sigma);
          else
            congruence(state.R, state.point.kirchhoff, sigma);
          const Lanes J = invert(state.F, inverse);
          for (unsigned int l = 0; l < n_lanes; ++l)
            if (cell_of_lane[b][l] >= 0)
              for (unsigned int k = 0; k < 6; ++k)
                stress[cell_of_lane[b][l]][k] = sigma[k][l] / J[l];
        }
    });
  }


  std::vector<double> PlasticCells::equivalent_plastic_strain(const PlasticHistory &history) const
  {
    std::vector<double> strain(zone_of_cell.size(), 0.);
    for_cells([&](const Range &, const std::size_t first, const unsigned int lane, const int cell,
                  std::size_t) { strain[cell] = history.values[first + strain_at][lane]; });
    return strain;
  }


  std::vector<double> PlasticCells::yield_limits(const PlasticHistory &history) const
  {
    std::vector<double> limits(zone_of_cell.size(), 0.);
    for_cells(
      [&](const Range &range, const std::size_t first, const unsigned int lane, const int cell, std::size_t) {
        const double strain = history.values[first + strain_at][lane];
        if (!(strain > 0.))
          return;
        limits[cell] = range.plastic.yield_stress + range.plastic.isotropic_modulus * strain;
        for (std::size_t i = 0; i < range.plastic.backstresses.size(); ++i)
          {
            std::array<double, 6> backstress;
            for (unsigned int k = 0; k < 6; ++k)
              backstress[k] = history.values[first + backstress_at + 6 * i + k][lane];
            limits[cell] += von_mises(backstress);
          }
      });
    return limits;
  }


  std::vector<CellHistory> PlasticCells::stored(const PlasticHistory &history) const
  {
    std::vector<CellHistory> list;
    for_cells([&](const Range &range, const std::size_t first, const unsigned int lane, int,
                  const std::size_t number) {
      CellHistory cell;
      cell.key = keys[number];
      cell.values.fill(0.);
      for (std::size_t k = 0; k < range.stride(); ++k)
        cell.values[k] = history.values[first + k][lane];
      list.push_back(cell);
    });
    return list;
  }


  std::size_t PlasticCells::restore(const std::vector<CellHistory> &list, PlasticHistory &history) const
  {
    std::map<std::array<long long, 4>, const CellHistory *> by_key;
    for (const CellHistory &cell : list)
      by_key[cell.key] = &cell;
    std::size_t n_found = 0;
    for_cells([&](const Range &range, const std::size_t first, const unsigned int lane, int,
                  const std::size_t number) {
      const auto entry = by_key.find(keys[number]);
      if (entry == by_key.end())
        return;
      ++n_found;
      for (std::size_t k = 0; k < range.stride(); ++k)
        history.values[first + k][lane] = entry->second->values[k];
    });
    // Padded lanes go with the first cell of their batch.
    for (const Range &range : ranges)
      for (std::size_t b = range.begin; b < range.end; ++b)
        for (unsigned int lane = 1; lane < n_lanes; ++lane)
          if (cell_of_lane[b][lane] < 0)
            for (std::size_t k = 0; k < range.stride(); ++k)
              {
                Lanes &values = history.values[range.history + (b - range.begin) * range.stride() + k];
                values[lane]  = values[0];
              }
    return n_found;
  }


  void PlasticCells::serialize(Archive &archive, PlasticHistory &history) const
  {
    const std::vector<CellHistory> all =
      archive.records(archive.restores() ? std::vector<CellHistory>() : stored(history));
    if (archive.restores() && restore(all, history) != n_cells())
      archive.miss();
  }


  std::size_t PlasticCells::memory_consumption() const
  {
    std::size_t bytes = batches.size() * sizeof(Batch) + modes.size() * sizeof(SurfaceModes);
    for (const Range &range : ranges)
      bytes += (range.end - range.begin) * range.stride() * sizeof(Lanes);
    return bytes;
  }
} // namespace tread
