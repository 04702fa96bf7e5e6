// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/solid/hexahedron.h>
#include <tread/solid/solid.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tread
{
  namespace
  {
    constexpr unsigned int invalid_cell = std::numeric_limits<unsigned int>::max();

    /// F = sum x_a (x) B_a for n_lanes cells; columns of F by reference direction.
    struct Deformation
    {
      Lanes F[3][3];

      void add(const Lanes (&x)[3], const Lanes (&gradient)[3])
      {
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            F[i][j] += x[i] * gradient[j];
      }

      /// Green-Lagrange strain (F^T F - 1)/2: xx, yy, zz, xy, yz, zx.
      void strain(Lanes (&E)[6]) const
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
      void first_piola(const Lanes (&S)[6], Lanes (&P)[3][3]) const
      {
        for (unsigned int i = 0; i < 3; ++i)
          {
            P[i][0] = F[i][0] * S[0] + F[i][1] * S[3] + F[i][2] * S[5];
            P[i][1] = F[i][0] * S[3] + F[i][1] * S[1] + F[i][2] * S[4];
            P[i][2] = F[i][0] * S[5] + F[i][1] * S[4] + F[i][2] * S[2];
          }
      }
    };

    Lanes contraction(const Lanes (&S)[6], const Lanes (&E)[6])
    {
      return S[0] * E[0] + S[1] * E[1] + S[2] * E[2] + 2. * (S[3] * E[3] + S[4] * E[4] + S[5] * E[5]);
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
    masses.resize(n_cells);
    levels_of_cells.assign(n_cells, 0);
    std::vector<double> stiffness(n_cells);
    const auto          integrals_of = [&](const unsigned int c) {
      std::array<dealii::Point<3>, 8> corners;
      for (unsigned int a = 0; a < 8; ++a)
        corners[a] = mesh.nodes[mesh.cells[c].nodes[a]];
      return HexahedronIntegrals(corners);
    };
    double highest = 0.;
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        const ElasticMaterial    &material  = materials[mesh.cells[c].body];
        const HexahedronIntegrals integrals = integrals_of(c);
        stiffness[c] = hourglass_stiffness(integrals, material, parameters.hourglass_coefficient);
        frequencies[c] =
          highest_frequency_bound(integrals, material, stiffness[c], full, parameters.density_scale);
        highest = std::max(highest, frequencies[c]);
        for (unsigned int a = 0; a < 8; ++a)
          masses[c][a] = material.density * integrals.node_volume[a];
      }
    highest = dealii::Utilities::MPI::max(highest, mesh.comm);
    for (unsigned int c = 0; c < n_cells; ++c)
      while (levels_of_cells[c] < parameters.max_level && !plastic_cells.contains(c) &&
             std::ldexp(frequencies[c], levels_of_cells[c] + 1) <= 1.1 * highest)
        ++levels_of_cells[c];

    for (unsigned int body = 0; body < materials.size(); ++body)
      for (unsigned int level = 0; level <= parameters.max_level; ++level)
        {
          const ElasticMaterial &material = materials[body];
          BodyRange              range;
          range.begin       = cell_of_lane.size();
          range.level       = level;
          range.lambda      = material.lame();
          range.mu          = material.shear_modulus();
          range.density     = material.density;
          range.wave_speed  = material.pressure_wave_speed();
          unsigned int lane = n_lanes;
          for (unsigned int c = 0; c < n_cells; ++c)
            if (mesh.cells[c].body == body && levels_of_cells[c] == level && !plastic_cells.contains(c))
              {
                const HexahedronIntegrals integrals = integrals_of(c);
                if (lane == n_lanes)
                  {
                    lane = 0;
                    cell_of_lane.emplace_back();
                    cell_of_lane.back().fill(invalid_cell);
                    // Padded lanes have no volume and no gradients: their forces vanish.
                    if (full)
                      {
                        point_batches.push_back(BatchOfPoints{});
                        for (auto &node : point_batches.back().node)
                          std::fill(std::begin(node), std::end(node), mesh.cells[c].nodes[0]);
                      }
                    else
                      {
                        batches.push_back(Batch{});
                        for (auto &node : batches.back().node)
                          std::fill(std::begin(node), std::end(node), mesh.cells[c].nodes[0]);
                      }
                  }
                cell_of_lane.back()[lane] = c;
                for (unsigned int a = 0; a < 8; ++a)
                  {
                    if (full)
                      {
                        BatchOfPoints &batch  = point_batches.back();
                        batch.node[a][lane]   = mesh.cells[c].nodes[a];
                        batch.weight[a][lane] = integrals.point_volume[a];
                        for (unsigned int q = 0; q < 8; ++q)
                          for (unsigned int i = 0; i < 3; ++i)
                            batch.gradient[q][a][i][lane] = integrals.point_gradient[q][a][i];
                      }
                    else
                      {
                        Batch &batch        = batches.back();
                        batch.node[a][lane] = mesh.cells[c].nodes[a];
                        batch.volume[lane]  = integrals.volume;
                        for (unsigned int i = 0; i < 3; ++i)
                          batch.gradient[a][i][lane] = integrals.gradient[a][i];
                        for (unsigned int m = 0; m < 4; ++m)
                          batch.hourglass[m][a][lane] = std::sqrt(stiffness[c]) * integrals.hourglass[m][a];
                      }
                  }
                ++lane;
              }
          range.end = cell_of_lane.size();
          ranges.push_back(range);
        }
  }


  template <bool viscous>
  void Solid::add_one_point_forces(const BodyRange &range,
                                   const Row       *x,
                                   const Row       *v,
                                   Row             *force,
                                   const double     factor) const
  {
    const double density = parameters.density_scale * range.density;
    for (std::size_t b = range.begin; b < range.end; ++b)
      {
        const Batch &batch = batches[b];
        Deformation  deformation{};
        Lanes        amplitude[4][3] = {};
        for (unsigned int a = 0; a < 8; ++a)
          {
            Lanes position[3];
            gather(x, batch.node[a], position[0], position[1], position[2]);
            deformation.add(position, batch.gradient[a]);
            for (unsigned int m = 0; m < 4; ++m)
              for (unsigned int i = 0; i < 3; ++i)
                amplitude[m][i] += batch.hourglass[m][a] * position[i];
          }
        Lanes E[6], S[6], P[3][3];
        deformation.strain(E);
        saint_venant_kirchhoff(range.lambda, range.mu, E, S);
        if constexpr (viscous)
          {
            // Volumetric strain rate tr(F^T dF/dt): a pressure against fast changes of volume
            // (von Neumann & Richtmyer 1950; Landshoff 1955).
            Deformation rate{};
            for (unsigned int a = 0; a < 8; ++a)
              {
                Lanes velocity[3];
                gather(v, batch.node[a], velocity[0], velocity[1], velocity[2]);
                rate.add(velocity, batch.gradient[a]);
              }
            for (unsigned int l = 0; l < n_lanes; ++l)
              {
                double trace = 0.;
                for (unsigned int i = 0; i < 3; ++i)
                  for (unsigned int j = 0; j < 3; ++j)
                    trace += deformation.F[i][j][l] * rate.F[i][j][l];
                const double size = std::cbrt(batch.volume[l]);
                double       q = parameters.linear_bulk_viscosity * density * range.wave_speed * size * trace;
                if (trace < 0.)
                  q -= parameters.quadratic_bulk_viscosity * density * size * size * trace * trace;
                for (unsigned int i = 0; i < 3; ++i)
                  S[i][l] += q;
              }
          }
        deformation.first_piola(S, P);
        for (auto &row : P)
          for (Lanes &component : row)
            component *= -factor * batch.volume;
        for (auto &mode : amplitude)
          for (Lanes &component : mode)
            component *= factor;
        for (unsigned int a = 0; a < 8; ++a)
          {
            Lanes f[3];
            for (unsigned int i = 0; i < 3; ++i)
              {
                f[i] = P[i][0] * batch.gradient[a][0] + P[i][1] * batch.gradient[a][1] +
                       P[i][2] * batch.gradient[a][2];
                for (unsigned int m = 0; m < 4; ++m)
                  f[i] -= amplitude[m][i] * batch.hourglass[m][a];
              }
            scatter_add(force, batch.node[a], f[0], f[1], f[2]);
          }
      }
  }


  void Solid::add_fully_integrated_forces(const BodyRange &range,
                                          const Row       *x,
                                          Row             *force,
                                          const double     factor) const
  {
    for (std::size_t b = range.begin; b < range.end; ++b)
      {
        const BatchOfPoints &batch = point_batches[b];
        Lanes                position[8][3], f[8][3] = {};
        for (unsigned int a = 0; a < 8; ++a)
          gather(x, batch.node[a], position[a][0], position[a][1], position[a][2]);
        for (unsigned int q = 0; q < 8; ++q)
          {
            Deformation deformation{};
            for (unsigned int a = 0; a < 8; ++a)
              deformation.add(position[a], batch.gradient[q][a]);
            Lanes E[6], S[6], P[3][3];
            deformation.strain(E);
            saint_venant_kirchhoff(range.lambda, range.mu, E, S);
            deformation.first_piola(S, P);
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


  void Solid::add_elastic_forces(const Row *x, const Row *v, Row *force, const Levels levels) const
  {
    for (const BodyRange &range : ranges)
      if (range.level >= levels.first && range.level <= levels.last)
        {
          const double factor = levels.weighted ? std::ldexp(1., range.level) : 1.;
          if (parameters.element_type == ElementType::fully_integrated)
            add_fully_integrated_forces(range, x, force, factor);
          else if (needs_velocity())
            add_one_point_forces<true>(range, x, v, force, factor);
          else
            add_one_point_forces<false>(range, x, v, force, factor);
        }
  }


  StrainEnergy Solid::strain_energy(const Row *x, const PlasticHistory &history) const
  {
    Lanes strain_sum{}, hourglass_sum{};
    for (const BodyRange &range : ranges)
      for (std::size_t b = range.begin; b < range.end; ++b)
        {
          const bool full                    = parameters.element_type == ElementType::fully_integrated;
          const unsigned int(*node)[n_lanes] = full ? point_batches[b].node : batches[b].node;
          Lanes position[8][3];
          for (unsigned int a = 0; a < 8; ++a)
            gather(x, node[a], position[a][0], position[a][1], position[a][2]);
          const auto add_point = [&](const Lanes(*gradient)[3], const Lanes weight) {
            Deformation deformation{};
            for (unsigned int a = 0; a < 8; ++a)
              for (unsigned int i = 0; i < 3; ++i)
                for (unsigned int j = 0; j < 3; ++j)
                  deformation.F[i][j] += position[a][i] * gradient[a][j];
            Lanes E[6], S[6];
            deformation.strain(E);
            saint_venant_kirchhoff(range.lambda, range.mu, E, S);
            strain_sum += 0.5 * weight * contraction(S, E);
          };
          if (full)
            for (unsigned int q = 0; q < 8; ++q)
              add_point(point_batches[b].gradient[q], point_batches[b].weight[q]);
          else
            {
              add_point(batches[b].gradient, batches[b].volume);
              for (unsigned int m = 0; m < 4; ++m)
                for (unsigned int i = 0; i < 3; ++i)
                  {
                    Lanes amplitude{};
                    for (unsigned int a = 0; a < 8; ++a)
                      amplitude += batches[b].hourglass[m][a] * position[a][i];
                    hourglass_sum += 0.5 * amplitude * amplitude;
                  }
            }
        }
    const auto [plastic_strain, plastic_hourglass] = plastic_cells.energies(x, history);
    StrainEnergy energy{plastic_strain, plastic_hourglass};
    for (unsigned int l = 0; l < n_lanes; ++l)
      {
        energy.strain += strain_sum[l];
        energy.hourglass += hourglass_sum[l];
      }
    return energy;
  }


  std::vector<std::array<double, 6>> Solid::cauchy_stress(const Row *x, const PlasticHistory &history) const
  {
    std::vector<std::array<double, 6>> stress(n_cells);
    for (const BodyRange &range : ranges)
      for (std::size_t b = range.begin; b < range.end; ++b)
        {
          const bool full                    = parameters.element_type == ElementType::fully_integrated;
          const unsigned int(*node)[n_lanes] = full ? point_batches[b].node : batches[b].node;
          Deformation deformation{};
          for (unsigned int a = 0; a < 8; ++a)
            {
              Lanes position[3], gradient[3];
              gather(x, node[a], position[0], position[1], position[2]);
              for (unsigned int i = 0; i < 3; ++i)
                {
                  gradient[i] = full ? Lanes{} : batches[b].gradient[a][i];
                  if (full)
                    for (unsigned int q = 0; q < 8; ++q)
                      gradient[i] += 0.125 * point_batches[b].gradient[q][a][i];
                }
              deformation.add(position, gradient);
            }
          Lanes E[6], S[6], P[3][3];
          deformation.strain(E);
          saint_venant_kirchhoff(range.lambda, range.mu, E, S);
          deformation.first_piola(S, P);
          const auto &F = deformation.F;
          for (unsigned int l = 0; l < n_lanes; ++l)
            if (const unsigned int c = cell_of_lane[b][l]; c != invalid_cell)
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
        }
    plastic_cells.cauchy_stress(x, history, stress);
    return stress;
  }


  std::size_t Solid::memory_consumption() const
  {
    return batches.size() * sizeof(Batch) + point_batches.size() * sizeof(BatchOfPoints) +
           plastic_cells.memory_consumption();
  }
} // namespace tread
