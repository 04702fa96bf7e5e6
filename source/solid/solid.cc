// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/solid/hexahedron.h>
#include <tread/solid/solid.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace tread
{
  namespace
  {
    constexpr unsigned int invalid_cell = std::numeric_limits<unsigned int>::max();

    /// Green-Lagrange strain (F^T F - 1)/2: xx, yy, zz, xy, yz, zx.
    [[gnu::always_inline]] inline void green_lagrange(const Lanes (&F)[3][3], Lanes (&E)[6])
    {
      const auto product = [&](const unsigned int j, const unsigned int k) {
        return F[0][j] * F[0][k] + F[1][j] * F[1][k] + F[2][j] * F[2][k];
      };
      E[0] = 0.5 * (product(0, 0) - 1.);
      E[1] = 0.5 * (product(1, 1) - 1.);
      E[2] = 0.5 * (product(2, 2) - 1.);
      E[3] = 0.5 * product(0, 1);
      E[4] = 0.5 * product(1, 2);
      E[5] = 0.5 * product(2, 0);
    }

    /// First Piola-Kirchhoff stress P = F S.
    [[gnu::always_inline]] inline void first_piola(const Lanes (&F)[3][3],
                                                   const Lanes (&S)[6],
                                                   Lanes (&P)[3][3])
    {
      for (unsigned int i = 0; i < 3; ++i)
        {
          P[i][0] = F[i][0] * S[0] + F[i][1] * S[3] + F[i][2] * S[5];
          P[i][1] = F[i][0] * S[3] + F[i][1] * S[1] + F[i][2] * S[4];
          P[i][2] = F[i][0] * S[5] + F[i][1] * S[4] + F[i][2] * S[2];
        }
    }

    /// F = sum x_a (x) B_a.
    [[gnu::always_inline]] inline void mean_deformation(const Lanes (&position)[8][3],
                                                        const Lanes (&gradient)[8][3],
                                                        Lanes (&F)[3][3])
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            F[i][j] = Lanes{};
            for (unsigned int a = 0; a < 8; ++a)
              F[i][j] += position[a][i] * gradient[a][j];
          }
    }
  } // namespace


  Solid::Solid(const Mesh                         &mesh,
               const std::vector<ElasticMaterial> &materials,
               const SolidParameters              &parameters,
               const std::vector<PlasticZone>     &zones)
    : parameters(parameters)
    , plastic_cells(mesh, materials, zones, parameters.hourglass_coefficient)
    , virgin_history(plastic_cells.virgin_history())
    , materials(materials)
    , n_cells(mesh.cells.size())
  {
    const bool full = parameters.element_type == ElementType::fully_integrated;
    if (full && needs_velocity())
      throw std::invalid_argument("bulk viscosity is for one-point cells only");
    if (!zones.empty() && (full || needs_velocity()))
      throw std::invalid_argument("plastic zones are for one-point cells without bulk viscosity");
    frequencies.resize(n_cells);
    levels_of_cells.resize(n_cells);
    std::vector<double> stiffness(n_cells);
    const auto          integrals_of = [&](const unsigned int c) {
      return HexahedronIntegrals(mesh.corners(c));
    };
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        const ElasticMaterial    &material  = materials[mesh.cells[c].body];
        const HexahedronIntegrals integrals = integrals_of(c);
        stiffness[c] = hourglass_stiffness(integrals, material, parameters.hourglass_coefficient);
        frequencies[c] =
          highest_frequency_bound(integrals, material, stiffness[c], full, parameters.density_scale);
        highest_cell_frequency = std::max(highest_cell_frequency, frequencies[c]);
      }
    highest_cell_frequency = dealii::Utilities::MPI::max(highest_cell_frequency, mesh.comm);
    for (unsigned int c = 0; c < n_cells; ++c)
      levels_of_cells[c] = level_up_to(parameters.max_level, c);

    std::vector<Kind> kinds(n_cells, Kind::points);
    if (!full)
      for (unsigned int c = 0; c < n_cells; ++c)
        kinds[c] = is_parallelepiped(mesh.corners(c)) ? Kind::affine : Kind::general;
    for (unsigned int body = 0; body < materials.size(); ++body)
      for (unsigned int level = 0; level <= parameters.max_level; ++level)
        for (const Kind kind : {Kind::affine, Kind::general, Kind::points})
          {
            const ElasticMaterial    &material = materials[body];
            std::vector<unsigned int> cells;
            for (unsigned int c = 0; c < n_cells; ++c)
              if (kinds[c] == kind && mesh.cells[c].body == body && levels_of_cells[c] == level &&
                  !plastic_cells.contains(c))
                cells.push_back(c);
            const auto add = [&](auto &batches, const auto &set_lane) {
              Range range;
              range.begin      = batches.size();
              range.cells      = cell_of_lane.size();
              range.kind       = kind;
              range.level      = level;
              range.lambda     = material.lame();
              range.mu         = material.shear_modulus();
              range.density    = material.density;
              range.wave_speed = material.pressure_wave_speed();
              for (std::size_t first = 0; first < cells.size(); first += n_lanes)
                {
                  batches.emplace_back();
                  cell_of_lane.emplace_back();
                  cell_of_lane.back().fill(invalid_cell);
                  for (unsigned int lane = 0; lane < n_lanes; ++lane)
                    {
                      // Padded lanes have no volume and no gradients: their forces vanish.
                      const bool         padded = first + lane >= cells.size();
                      const unsigned int c      = cells[padded ? first : first + lane];
                      for (unsigned int a = 0; a < 8; ++a)
                        batches.back().node[a][lane] = mesh.cells[c].nodes[a];
                      if (padded)
                        continue;
                      cell_of_lane.back()[lane] = c;
                      set_lane(batches.back(), lane, integrals_of(c), stiffness[c]);
                    }
                }
              range.end = batches.size();
              if (range.end > range.begin)
                ranges.push_back(range);
            };
            const auto set_one_point = [](auto &batch, const unsigned int lane,
                                          const HexahedronIntegrals &integrals, const double stiffness) {
              batch.set(lane, integrals, stiffness);
            };
            if (kind == Kind::affine)
              add(affine_batches, set_one_point);
            else if (kind == Kind::general)
              add(general_batches, set_one_point);
            else
              add(point_batches, [](BatchOfPoints &batch, const unsigned int lane,
                                    const HexahedronIntegrals &integrals, double) {
                for (unsigned int q = 0; q < 8; ++q)
                  {
                    batch.weight[q][lane] = integrals.point_volume[q];
                    for (unsigned int a = 0; a < 8; ++a)
                      for (unsigned int i = 0; i < 3; ++i)
                        batch.gradient[q][a][i][lane] = integrals.point_gradient[q][a][i];
                  }
              });
          }
  }


  unsigned int Solid::level_up_to(const unsigned int max_level, const unsigned int cell) const
  {
    return plastic_cells.contains(cell)
             ? 0
             : level_of_steps(highest_cell_frequency / frequencies[cell], max_level);
  }


  double Solid::relative_cost(const std::array<dealii::Point<3>, 8> &corners,
                              const ElementType                      type,
                              const bool                             is_plastic)
  {
    // Rounded from internal forces of 22, 36 and 233 ns a cell (kernel_benchmark, 205 379 cells: the first
    // table of doc/performance.md) and about 8 ns for its nodes; cells that yield take 1.5 to 2.1 times an
    // elastic one (plastic_benchmark). Only the ratios count: a factor that is wrong by half lets ranks that
    // have such cells wait, or be waited for, by up to half of what these take.
    constexpr double parallelepiped = 1., general = 4. / 3., plastic = 2., fully_integrated = 25. / 3.;
    return type == ElementType::fully_integrated ? fully_integrated
           : is_plastic                          ? plastic
           : is_parallelepiped(corners)          ? parallelepiped
                                                 : general;
  }


  std::vector<std::array<double, 8>> Solid::cell_masses(const Mesh &mesh) const
  {
    std::vector<std::array<double, 8>> masses(n_cells);
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        masses[c] = HexahedronIntegrals(mesh.corners(c)).node_volume;
        for (double &mass : masses[c])
          mass *= materials[mesh.cells[c].body].density;
      }
    return masses;
  }


  template <typename Work>
  void Solid::for_batches(const Work &work) const
  {
    for (const Range &range : ranges)
      for (std::size_t b = range.begin; b < range.end; ++b)
        {
          const auto &cells = cell_of_lane[range.cells + b - range.begin];
          if (range.kind == Kind::affine)
            work(range, affine_batches[b], cells);
          else if (range.kind == Kind::general)
            work(range, general_batches[b], cells);
          else
            work(range, point_batches[b], cells);
        }
  }


  template <bool viscous, bool affine>
  void Solid::add_one_point_forces(const Range   &range,
                                   const Vector3 *x,
                                   const Vector3 *v,
                                   Vector3       *force,
                                   const double   factor) const
  {
    const auto  &batches = one_point_batches<affine>();
    const double density = parameters.density_scale * range.density;
    for (std::size_t b = range.begin; b < range.end; ++b)
      {
        const auto &batch = batches[b];
        Lanes       F[3][3], amplitude[4][3], E[6], S[6], P[3][3];
        deform(batch, x, F, amplitude);
        green_lagrange(F, E);
        HenckyPoint<Lanes>(E).stress(range.lambda, range.mu, S);
        if constexpr (viscous)
          {
            // Volumetric strain rate tr(F^T dF/dt): a pressure against fast changes of volume
            // (von Neumann & Richtmyer 1950; Landshoff 1955).
            Lanes rate[3][3], amplitude_rate[4][3];
            deform(batch, v, rate, amplitude_rate);
            for (unsigned int l = 0; l < n_lanes; ++l)
              {
                double trace = 0.;
                for (unsigned int i = 0; i < 3; ++i)
                  for (unsigned int j = 0; j < 3; ++j)
                    trace += F[i][j][l] * rate[i][j][l];
                const double size = std::cbrt(batch.volume[l]);
                double       q = parameters.linear_bulk_viscosity * density * range.wave_speed * size * trace;
                if (trace < 0.)
                  q -= parameters.quadratic_bulk_viscosity * density * size * size * trace * trace;
                for (unsigned int i = 0; i < 3; ++i)
                  S[i][l] += q;
              }
          }
        const Lanes volume = -factor * batch.volume, stiffness = -factor * batch.stiffness;
        for (Lanes &component : S)
          component *= volume;
        first_piola(F, S, P);
        for (auto &mode : amplitude)
          for (Lanes &component : mode)
            component *= stiffness;
        add_forces_of(batch, force, P, amplitude);
      }
  }


  void Solid::add_fully_integrated_forces(const Range   &range,
                                          const Vector3 *x,
                                          Vector3       *force,
                                          const double   factor) const
  {
    for (std::size_t b = range.begin; b < range.end; ++b)
      {
        const BatchOfPoints &batch = point_batches[b];
        Lanes                position[8][3], f[8][3] = {};
        for (unsigned int a = 0; a < 8; ++a)
          gather(x, batch.node[a], position[a][0], position[a][1], position[a][2]);
        for (unsigned int q = 0; q < 8; ++q)
          {
            Lanes F[3][3], E[6], S[6], P[3][3];
            mean_deformation(position, batch.gradient[q], F);
            green_lagrange(F, E);
            HenckyPoint<Lanes>(E).stress(range.lambda, range.mu, S);
            first_piola(F, S, P);
            for (unsigned int a = 0; a < 8; ++a)
              for (unsigned int i = 0; i < 3; ++i)
                f[a][i] -= factor * batch.weight[q] *
                           (P[i][0] * batch.gradient[q][a][0] + P[i][1] * batch.gradient[q][a][1] +
                            P[i][2] * batch.gradient[q][a][2]);
          }
        for (unsigned int a = 0; a < 8; ++a)
          scatter_add(force, batch.node[a], f[a][0], f[a][1], f[a][2]);
      }
  }


  void Solid::add_elastic_forces(const Vector3 *x,
                                 const Vector3 *v,
                                 Vector3       *force,
                                 const Levels   levels) const
  {
    const auto one_point = [&](const Range &range, const double factor, const auto affine) {
      if (needs_velocity())
        add_one_point_forces<true, affine()>(range, x, v, force, factor);
      else
        add_one_point_forces<false, affine()>(range, x, v, force, factor);
    };
    for (const Range &range : ranges)
      if (range.level >= levels.first && range.level <= levels.last)
        {
          const double factor = levels.weighted ? std::ldexp(1., range.level) : 1.;
          if (range.kind == Kind::affine)
            one_point(range, factor, std::true_type());
          else if (range.kind == Kind::general)
            one_point(range, factor, std::false_type());
          else
            add_fully_integrated_forces(range, x, force, factor);
        }
  }


  StrainEnergy Solid::strain_energy(const Vector3 *x, const PlasticHistory &history) const
  {
    Lanes strain_sum{}, hourglass_sum{};
    for_batches([&](const Range &range, const auto &batch, const auto &) {
      const auto add_point = [&](const Lanes(&F)[3][3], const Lanes weight) {
        Lanes E[6];
        green_lagrange(F, E);
        strain_sum += weight * HenckyPoint<Lanes>(E).energy(range.lambda, range.mu);
      };
      Lanes F[3][3];
      if constexpr (std::is_same_v<std::decay_t<decltype(batch)>, BatchOfPoints>)
        {
          Lanes position[8][3];
          for (unsigned int a = 0; a < 8; ++a)
            gather(x, batch.node[a], position[a][0], position[a][1], position[a][2]);
          for (unsigned int q = 0; q < 8; ++q)
            {
              mean_deformation(position, batch.gradient[q], F);
              add_point(F, batch.weight[q]);
            }
        }
      else
        {
          Lanes amplitude[4][3];
          deform(batch, x, F, amplitude);
          add_point(F, batch.volume);
          for (const auto &mode : amplitude)
            for (const Lanes &component : mode)
              hourglass_sum += 0.5 * batch.stiffness * component * component;
        }
    });
    const auto [plastic_strain, plastic_hourglass] = plastic_cells.energies(x, history);
    StrainEnergy energy{plastic_strain, plastic_hourglass};
    for (unsigned int l = 0; l < n_lanes; ++l)
      {
        energy.strain += strain_sum[l];
        energy.hourglass += hourglass_sum[l];
      }
    return energy;
  }


  std::vector<std::array<double, 6>> Solid::cauchy_stress(const Vector3           *x,
                                                          const PlasticHistory    &history,
                                                          const std::vector<char> &wanted) const
  {
    std::vector<std::array<double, 6>> stress(n_cells);
    for_batches([&](const Range &range, const auto &batch, const auto &cells) {
      if (!wanted.empty() && std::none_of(cells.begin(), cells.end(), [&](const unsigned int c) {
            return c != invalid_cell && wanted[c];
          }))
        return;
      Lanes F[3][3], E[6], S[6], P[3][3];
      if constexpr (std::is_same_v<std::decay_t<decltype(batch)>, BatchOfPoints>)
        {
          Lanes position[8][3], gradient[8][3];
          for (unsigned int a = 0; a < 8; ++a)
            {
              gather(x, batch.node[a], position[a][0], position[a][1], position[a][2]);
              for (unsigned int i = 0; i < 3; ++i)
                {
                  gradient[a][i] = Lanes{};
                  for (unsigned int q = 0; q < 8; ++q)
                    gradient[a][i] += 0.125 * batch.gradient[q][a][i];
                }
            }
          mean_deformation(position, gradient, F);
        }
      else
        {
          Lanes amplitude[4][3];
          deform(batch, x, F, amplitude);
        }
      green_lagrange(F, E);
      HenckyPoint<Lanes>(E).stress(range.lambda, range.mu, S);
      first_piola(F, S, P);
      for (unsigned int l = 0; l < n_lanes; ++l)
        if (const unsigned int c = cells[l]; c != invalid_cell)
          {
            const double J = F[0][0][l] * (F[1][1][l] * F[2][2][l] - F[1][2][l] * F[2][1][l]) -
                             F[0][1][l] * (F[1][0][l] * F[2][2][l] - F[1][2][l] * F[2][0][l]) +
                             F[0][2][l] * (F[1][0][l] * F[2][1][l] - F[1][1][l] * F[2][0][l]);
            static constexpr unsigned int ij[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
            for (unsigned int k = 0; k < 6; ++k)
              {
                double sum = 0.;
                for (unsigned int m = 0; m < 3; ++m)
                  sum += P[ij[k][0]][m][l] * F[ij[k][1]][m][l];
                stress[c][k] = sum / J;
              }
          }
    });
    plastic_cells.cauchy_stress(x, history, stress, wanted);
    return stress;
  }


  std::size_t Solid::memory_consumption() const
  {
    return affine_batches.size() * sizeof(OnePointBatch<true>) +
           general_batches.size() * sizeof(OnePointBatch<false>) +
           point_batches.size() * sizeof(BatchOfPoints) + plastic_cells.memory_consumption() +
           cell_of_lane.size() * sizeof(cell_of_lane[0]) + frequencies.size() * sizeof(frequencies[0]) +
           levels_of_cells.size() * sizeof(levels_of_cells[0]);
  }
} // namespace tread
