// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/solid/batched_group.h>
#include <tread/solid/one_point.h>
#include <tread/solid/one_point_batch.h>

#include <cmath>

namespace tread
{
  namespace
  {
    template <bool affine>
    class OnePointGroup : public BatchedGroup<OnePointBatch<affine>>
    {
    public:
      using Batch = OnePointBatch<affine>;

      OnePointGroup(const Mesh                      &mesh,
                    const ElasticMaterial           &material,
                    const std::vector<unsigned int> &cells,
                    const SolidParameters           &parameters)
        : BatchedGroup<Batch>(
            mesh,
            material,
            cells,
            [&](Batch &batch, const unsigned int lane, const HexahedronIntegrals &integrals, unsigned int) {
              batch.set(lane, integrals,
                        hourglass_stiffness(integrals, material, parameters.hourglass_coefficient));
            })
        , parameters(parameters)
        , density(parameters.density_scale * material.density)
        , wave_speed(material.pressure_wave_speed())
      {
      }

      void add_forces(const Vector3 *x, const Vector3 *v, Vector3 *force, const double factor) const override
      {
        if (parameters.reproducible)
          add(x, v, force, factor, parameters.force_quantum());
        else
          add(x, v, force, factor, NoRounding());
      }

      void add_energies(const Vector3          *x,
                        ReproducibleSum<Lanes> &strain,
                        ReproducibleSum<Lanes> &hourglass) const override
      {
        for (const auto &batch : this->batches)
          {
            Lanes F[3][3], amplitude[4][3], E[6];
            deform(batch, x, F, amplitude);
            green_lagrange(F, E);
            strain.add(batch.volume * HenckyPoint<Lanes>(E).energy(this->lambda, this->mu));
            Lanes squares{};
            for (const auto &mode : amplitude)
              for (const Lanes &component : mode)
                squares += component * component;
            hourglass.add(0.5 * batch.stiffness * squares);
          }
      }

    protected:
      void deform_centre(const Batch &batch, const Vector3 *x, Lanes (&F)[3][3]) const override
      {
        Lanes amplitude[4][3];
        deform(batch, x, F, amplitude);
      }

    private:
      template <typename Rounding>
      void add(const Vector3 *x,
               const Vector3 *v,
               Vector3       *force,
               const double   factor,
               const Rounding rounding) const
      {
        if (parameters.has_bulk_viscosity())
          add<true>(x, v, force, factor, rounding);
        else
          add<false>(x, v, force, factor, rounding);
      }

      template <bool viscous, typename Rounding>
      void add(const Vector3                  *x,
               [[maybe_unused]] const Vector3 *v,
               Vector3                        *force,
               const double                    factor,
               const Rounding                  rounding) const
      {
        const double lambda = this->lambda, mu = this->mu;
        for (const auto &batch : this->batches)
          {
            Lanes F[3][3], amplitude[4][3], E[6], S[6], P[3][3];
            deform(batch, x, F, amplitude);
            green_lagrange(F, E);
            HenckyPoint<Lanes>(E).stress(lambda, mu, S);
            if constexpr (viscous)
              add_viscosity(batch, v, F, S);
            const Lanes volume = -factor * batch.volume, stiffness = -factor * batch.stiffness;
            for (Lanes &component : S)
              component *= volume;
            first_piola(F, S, P);
            for (auto &mode : amplitude)
              for (Lanes &component : mode)
                component *= stiffness;
            add_forces_of(batch, force, P, amplitude, rounding);
          }
      }

      /// Volumetric strain rate tr(F^T dF/dt): a pressure against fast changes of volume (von Neumann &
      /// Richtmyer 1950; Landshoff 1955).
      void add_viscosity(const Batch &batch, const Vector3 *v, const Lanes (&F)[3][3], Lanes (&S)[6]) const
      {
        Lanes rate[3][3], amplitude_rate[4][3];
        deform(batch, v, rate, amplitude_rate);
        for (unsigned int l = 0; l < n_lanes; ++l)
          {
            double trace = 0.;
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                trace += F[i][j][l] * rate[i][j][l];
            const double size = std::cbrt(batch.volume[l]);
            double       q    = parameters.linear_bulk_viscosity * density * wave_speed * size * trace;
            if (trace < 0.)
              q -= parameters.quadratic_bulk_viscosity * density * size * size * trace * trace;
            for (unsigned int i = 0; i < 3; ++i)
              S[i][l] += q;
          }
      }

      SolidParameters parameters;
      double          density, wave_speed; ///< scaled, kg/m^3; of the true density, m/s
    };
  } // namespace


  double OnePoint::highest_frequency_bound(const HexahedronIntegrals &cell,
                                           const ElasticMaterial     &material,
                                           const double               hourglass_factor) const
  {
    return one_point_frequency_bound(
      cell, material,
      hourglass_stiffness(cell, material, hourglass_factor * parameters.hourglass_coefficient),
      parameters.density_scale);
  }


  double OnePoint::relative_cost(const std::array<dealii::Point<3>, 8> &corners) const
  {
    // Rounded from internal forces of 22 and 36 ns a cell (kernel_benchmark, 205 379 cells: the first table
    // of doc/performance.md) and about 8 ns for its nodes. Only the ratios count: a factor that is wrong by
    // half lets ranks that have such cells wait, or be waited for, by up to half of what these take.
    return is_parallelepiped(corners) ? 1. : 4. / 3.;
  }


  std::vector<std::unique_ptr<const CellGroup>> OnePoint::make_groups(
    const Mesh                      &mesh,
    const ElasticMaterial           &material,
    const std::vector<unsigned int> &cells) const
  {
    std::vector<unsigned int> cells_of[2]; // parallelepipeds last
    for (const unsigned int c : cells)
      cells_of[is_parallelepiped(mesh.corners(c))].push_back(c);
    std::vector<std::unique_ptr<const CellGroup>> groups;
    groups.push_back(std::make_unique<OnePointGroup<true>>(mesh, material, cells_of[1], parameters));
    groups.push_back(std::make_unique<OnePointGroup<false>>(mesh, material, cells_of[0], parameters));
    return groups;
  }
} // namespace tread
