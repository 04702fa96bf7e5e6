// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/solid/solid.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace tread
{
  Solid::Solid(const Mesh                         &mesh,
               const std::vector<ElasticMaterial> &materials,
               const SolidParameters              &parameters,
               const std::vector<PlasticZone>     &zones)
    : parameters(parameters)
    , surface_layer(parameters.matched_surface && element_named(parameters.element).has_hourglass_modes
                      ? SurfaceLayer(mesh, materials, parameters.hourglass_coefficient)
                      : SurfaceLayer())
    , plastic_cells(mesh,
                    materials,
                    zones,
                    parameters.hourglass_coefficient,
                    parameters.force_quantum(),
                    surface_layer)
    , virgin_history(plastic_cells.virgin_history())
    , materials(materials)
    , n_cells(mesh.cells.size())
  {
    const ElementEntry &entry = element_named(parameters.element);
    if (!parameters.matched_surface || !entry.has_hourglass_modes)
      this->parameters.surface_damping = 0.;
    if (has_bulk_viscosity() && !entry.has_bulk_viscosity)
      throw std::invalid_argument("bulk viscosity is not for cells of the element " + entry.name);
    if (!zones.empty() && (!entry.can_yield || has_bulk_viscosity()))
      throw std::invalid_argument("plastic zones are for one-point cells without bulk viscosity");
    const std::shared_ptr<const Element> element = entry.make(parameters);
    frequencies.resize(n_cells);
    levels_of_cells.resize(n_cells);
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        frequencies[c] = element->highest_frequency_bound(
          HexahedronIntegrals(mesh.corners(c)), materials[mesh.cells[c].material],
          surface_layer.stiffening_of(c, parameters.surface_damping));
        if (const double limit = parameters.highest_frequency; limit > 0. && frequencies[c] > limit)
          {
            added_shares.resize(n_cells);
            added_shares[c] =
              parameters.density_scale * (frequencies[c] * frequencies[c] / (limit * limit) - 1.);
            frequencies[c] = limit;
          }
        highest_cell_frequency = std::max(highest_cell_frequency, frequencies[c]);
      }
    highest_cell_frequency = dealii::Utilities::MPI::max(highest_cell_frequency, mesh.comm);
    for (unsigned int c = 0; c < n_cells; ++c)
      levels_of_cells[c] = level_up_to(parameters.max_level, c);

    for (unsigned int material = 0; material < materials.size(); ++material)
      for (unsigned int level = 0; level <= parameters.max_level; ++level)
        {
          std::vector<unsigned int> cells;
          for (unsigned int c = 0; c < n_cells; ++c)
            if (mesh.cells[c].material == material && levels_of_cells[c] == level &&
                !plastic_cells.contains(c))
              cells.push_back(c);
          if (cells.empty())
            continue;
          for (auto &group : element->make_groups(mesh, materials[material], cells))
            groups.push_back({level, std::move(group)});
        }
  }


  unsigned int Solid::level_up_to(const unsigned int max_level, const unsigned int cell) const
  {
    return plastic_cells.contains(cell)
             ? 0
             : level_of_steps(highest_cell_frequency / frequencies[cell], max_level);
  }


  std::vector<std::array<double, 8>> Solid::cell_masses(const Mesh &mesh) const
  {
    std::vector<std::array<double, 8>> masses(n_cells);
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        masses[c] = HexahedronIntegrals(mesh.corners(c)).node_volume;
        for (double &mass : masses[c])
          mass *= materials[mesh.cells[c].material].density;
      }
    return masses;
  }


  void Solid::add_elastic_forces(const Vector3 *x,
                                 const Vector3 *v,
                                 Vector3       *force,
                                 const Levels   levels) const
  {
    for (const Group &group : groups)
      if (group.level >= levels.first && group.level <= levels.last)
        group.cells->add_forces(x, v, force, levels.weighted ? std::ldexp(1., group.level) : 1.);
  }


  StrainEnergySums Solid::strain_energy_sums(const Vector3 *x, const PlasticHistory &history) const
  {
    ReproducibleSum<Lanes> strain, hourglass;
    for (const Group &group : groups)
      group.cells->add_energies(x, strain, hourglass);
    auto [strain_sum, hourglass_sum] = plastic_cells.energies(x, history);
    strain_sum.add(strain.of_lanes());
    hourglass_sum.add(hourglass.of_lanes());
    return {strain_sum, hourglass_sum};
  }


  std::vector<std::array<double, 6>> Solid::cauchy_stress(const Vector3           *x,
                                                          const PlasticHistory    &history,
                                                          const std::vector<char> &wanted) const
  {
    std::vector<std::array<double, 6>> stress(n_cells);
    for (const Group &group : groups)
      group.cells->set_cauchy_stress(x, wanted, stress);
    plastic_cells.cauchy_stress(x, history, stress, wanted);
    return stress;
  }


  std::vector<std::unique_ptr<const CellGroup>> Solid::groups_of(const Mesh                      &mesh,
                                                                 const unsigned int               body,
                                                                 const std::vector<unsigned int> &cells) const
  {
    return element_named(parameters.element).make(parameters)->make_groups(mesh, materials[body], cells);
  }


  std::size_t Solid::memory_consumption() const
  {
    std::size_t bytes = plastic_cells.memory_consumption() + frequencies.size() * sizeof(frequencies[0]) +
                        added_shares.size() * sizeof(added_shares[0]) +
                        levels_of_cells.size() * sizeof(levels_of_cells[0]);
    for (const Group &group : groups)
      bytes += group.cells->memory_consumption();
    return bytes;
  }
} // namespace tread
