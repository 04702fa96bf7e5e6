// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_solid_solid_h
#define tread_solid_solid_h

#include <tread/base/simd.h>
#include <tread/material/elastic.h>
#include <tread/mesh/mesh.h>
#include <tread/solid/element.h>
#include <tread/solid/plastic_cells.h>
#include <tread/solid/surface_layer.h>

#include <cstdint>
#include <memory>

namespace tread
{
  /// Selection of the cells over which forces are summed.
  struct Levels
  {
    unsigned int first = 0, last = 1000;
    bool         weighted = false; ///< times 2^level: their share of impulse over the smallest time step
  };

  /// Elastic energies, J.
  struct StrainEnergy
  {
    double strain = 0., hourglass = 0.;
  };

  /// The same as sums that do not depend on the ranks.
  struct StrainEnergySums
  {
    ReproducibleSum<double> strain, hourglass;
  };

  /// The deformable cells of this rank: internal forces, lumped mass, frequencies.
  ///
  /// Total Lagrangian: gradients refer to the reference positions and are computed once;
  /// F = sum x_a (x) B_a is exact for any rotation.
  class Solid
  {
  public:
    /// @param materials one for each body, then others that cells may have. @param zones of cells that may
    /// yield, of their body's own material; the others are elastic.
    Solid(const Mesh                         &mesh,
          const std::vector<ElasticMaterial> &materials,
          const SolidParameters              &parameters,
          const std::vector<PlasticZone>     &zones = {});

    /// Add the forces that the cells exert on their nodes (N) when these are at x (m) and, for bulk
    /// viscosity, move at v (m/s). The caller treats hanging nodes. Cells of plastic zones are not included.
    void add_elastic_forces(const Vector3 *x,
                            const Vector3 *v,
                            Vector3       *force,
                            const Levels   levels = {}) const;

    /// Forces of all cells. Those of plastic zones, which are on level 0, move to x from the state of the
    /// last update of the history, which remains unchanged.
    void add_internal_forces(const Vector3        *x,
                             const Vector3        *v,
                             Vector3              *force,
                             const PlasticHistory &history,
                             const Levels          levels = {}) const
    {
      add_elastic_forces(x, v, force, levels);
      if (levels.first == 0)
        plastic_cells.add_forces(x, force, history);
    }

    /// The same for cells that have never been loaded.
    void add_internal_forces(const Vector3 *x,
                             const Vector3 *v,
                             Vector3       *force,
                             const Levels   levels = {}) const
    {
      add_internal_forces(x, v, force, virgin_history, levels);
    }

    /// Forces of all cells with an update of the history to x: once per step, with the cells of level 0.
    /// @returns the plastic work done on this rank, J.
    ReproducibleSum<double> update_internal_forces(const Vector3  *x,
                                                   const Vector3  *v,
                                                   Vector3        *force,
                                                   PlasticHistory &history,
                                                   const Levels    levels = {}) const
    {
      add_elastic_forces(x, v, force, levels);
      return levels.first == 0 ? plastic_cells.update(x, force, history) : ReproducibleSum<double>();
    }

    /// Energies stored in the cells of this rank at x.
    StrainEnergySums strain_energy_sums(const Vector3 *x, const PlasticHistory &history) const;
    StrainEnergy     strain_energy(const Vector3 *x, const PlasticHistory &history) const
    {
      const StrainEnergySums sums = strain_energy_sums(x, history);
      return {sums.strain.value(), sums.hourglass.value()};
    }
    StrainEnergy strain_energy(const Vector3 *x) const
    {
      return strain_energy(x, virgin_history);
    }

    /// Cauchy stress (xx, yy, zz, xy, yz, zx; Pa) at the centre of each cell of this rank at x. @param wanted
    /// by cell: the stress remains 0 in batches without any wanted cell; empty: all cells.
    std::vector<std::array<double, 6>> cauchy_stress(const Vector3           *x,
                                                     const PlasticHistory    &history,
                                                     const std::vector<char> &wanted = {}) const;
    std::vector<std::array<double, 6>> cauchy_stress(const Vector3 *x) const
    {
      return cauchy_stress(x, virgin_history);
    }

    const ElasticMaterial &material_of(const Mesh::Cell &cell) const
    {
      return materials[cell.material];
    }

    /// Some cells of a body, all of its own material and none of a plastic zone, in groups of their own: for
    /// those who look at their stresses in every step.
    std::vector<std::unique_ptr<const CellGroup>> groups_of(const Mesh                      &mesh,
                                                            const unsigned int               body,
                                                            const std::vector<unsigned int> &cells) const;

    /// The cells that may yield.
    const PlasticCells &plastic() const
    {
      return plastic_cells;
    }

    /// History of cells that were never loaded.
    const PlasticHistory &virgin() const
    {
      return virgin_history;
    }

    /// Upper bound of each cell's highest angular frequency, rad/s, with its own share of the
    /// (scaled) mass. The bound of the whole mesh is the maximum (Rayleigh quotient; Belytschko 1983).
    const std::vector<double> &cell_frequencies() const
    {
      return frequencies;
    }

    /// Level of each cell, up to max_level, by its frequency and that of the fastest cell of all ranks (@see
    /// level_of_steps). Cells of plastic zones are of level 0: they yield in the smallest steps.
    const std::vector<unsigned int> &cell_levels() const
    {
      return levels_of_cells;
    }

    /// The value that cell_levels() would give for a cell with another largest level.
    unsigned int level_up_to(const unsigned int max_level, const unsigned int cell) const;

    /// Mass that a cell was given to slow it down, over its own unscaled one. @see
    /// SolidParameters::highest_frequency
    double added_share(const unsigned int cell) const
    {
      return added_shares.empty() ? 0. : added_shares[cell];
    }

    /// Whether any rank may have cells with added mass.
    bool may_add_mass() const
    {
      return parameters.highest_frequency > 0.;
    }

    /// Unscaled masses, kg, before hanging nodes are condensed and ranks are summed, by node and cell. They
    /// are computed anew and not stored.
    std::vector<std::array<double, 8>> cell_masses(const Mesh &mesh) const;

    /// Whether sums of forces at the nodes are not to depend on the ranks, and the quantum of what is added
    /// to them for that, N.
    bool reproducible() const
    {
      return parameters.reproducible;
    }
    Quantum force_quantum() const
    {
      return parameters.force_quantum();
    }

    bool has_bulk_viscosity() const
    {
      return parameters.has_bulk_viscosity();
    }

    /// Damping of the hourglass modes of the uppermost layer of cells over their stiffness, in time steps.
    double surface_damping() const
    {
      return parameters.surface_damping;
    }

    /// Whether forces depend on the velocities of the nodes, those that hang included.
    bool needs_velocity() const
    {
      return has_bulk_viscosity() || parameters.surface_damping > 0.;
    }

    /// The cells of the uppermost layer with hourglass stiffness of their own.
    const SurfaceLayer &surface() const
    {
      return surface_layer;
    }

    /// Memory of this rank's cells for the internal forces, bytes.
    std::size_t memory_consumption() const;

  private:
    struct Group ///< of one element, material and level
    {
      unsigned int                     level;
      std::unique_ptr<const CellGroup> cells;
    };

    SolidParameters              parameters;
    SurfaceLayer                 surface_layer;
    PlasticCells                 plastic_cells;
    PlasticHistory               virgin_history;
    std::vector<ElasticMaterial> materials;
    std::vector<Group>           groups; ///< of all cells but those of plastic zones
    std::vector<double>          frequencies;
    std::vector<double>          added_shares; ///< by cell; empty: no cell has added mass
    std::vector<unsigned int>    levels_of_cells;
    double                       highest_cell_frequency = 0.; ///< of all ranks, rad/s
    std::size_t                  n_cells;
  };
} // namespace tread

#endif
