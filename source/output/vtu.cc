// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/run_folder.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>
#include <deal.II/grid/reference_cell.h>

#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace tread
{
  namespace
  {
    /// Patches made from plain arrays, written by deal.II.
    template <int dim>
    class ArrayOutput : public dealii::DataOutInterface<dim, 3>
    {
    public:
      using Patch = dealii::DataOutBase::Patch<dim, 3>;

      std::vector<Patch>       patches;
      std::vector<std::string> names;
      /// First and last component of vectors, and their name.
      std::vector<std::tuple<unsigned int,
                             unsigned int,
                             std::string,
                             dealii::DataComponentInterpretation::DataComponentInterpretation>>
        ranges;

      void add_vector(const std::string &name)
      {
        const unsigned int first = names.size();
        names.insert(names.end(), 3, name);
        ranges.emplace_back(first, first + 2, name,
                            dealii::DataComponentInterpretation::component_is_part_of_vector);
      }

    private:
      const std::vector<Patch> &get_patches() const override
      {
        return patches;
      }
      std::vector<std::string> get_dataset_names() const override
      {
        return names;
      }
      std::vector<std::tuple<unsigned int,
                             unsigned int,
                             std::string,
                             dealii::DataComponentInterpretation::DataComponentInterpretation>>
      get_nonscalar_data_ranges() const override
      {
        return ranges;
      }
    };

    template <int dim>
    void set_vector(typename ArrayOutput<dim>::Patch &patch,
                    const unsigned int                first,
                    const unsigned int                vertex,
                    const Row                         value)
    {
      for (unsigned int d = 0; d < 3; ++d)
        patch.data(first + d, vertex) = value[d];
    }

    std::string numbered(const std::string &stem, const std::size_t number)
    {
      char text[64];
      std::snprintf(text, sizeof text, "%s-%04zu.vtu", stem.c_str(), number);
      return text;
    }
  } // namespace


  void RunFolder::write_collection(const std::string                                 &name,
                                   const std::vector<std::pair<double, std::string>> &files) const
  {
    std::ostringstream text;
    dealii::DataOutBase::write_pvd_record(text, files);
    write(name, text.str());
  }


  void RunFolder::write_volume(const ExplicitDynamics &dynamics,
                               const WheelHub         &hub,
                               const unsigned int      wheel_body)
  {
    const Mesh    &mesh = dynamics.mesh;
    ArrayOutput<3> output;
    output.add_vector("displacement_um");
    output.add_vector("velocity_m_per_s");
    for (const char *name : {"von_mises_MPa", "mean_stress_MPa", "body"})
      output.names.emplace_back(name);
    const std::vector<std::array<double, 6>> stress =
      dynamics.solid.cauchy_stress(dynamics.x.data(), dynamics.history);
    // What remains of the stress behind the wheel is the residual stress.
    const bool plastic = !dynamics.history.values.empty();
    const bool yields  = dealii::Utilities::MPI::logical_or(plastic, comm); // the same data on all ranks
    const std::vector<double> strain = dynamics.solid.plastic().equivalent_plastic_strain(dynamics.history);
    if (yields)
      for (const char *name : {"equivalent_plastic_strain_percent", "stress_xx_MPa", "stress_yy_MPa",
                               "stress_zz_MPa", "stress_xy_MPa", "stress_yz_MPa", "stress_zx_MPa"})
        output.names.emplace_back(name);
    const Row axle_at_start{hub.start_x(), 0., hub.start_z(), 0.};
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        ArrayOutput<3>::Patch patch;
        patch.reference_cell = dealii::ReferenceCells::Hexahedron;
        patch.patch_index    = c;
        patch.n_subdivisions = 1;
        patch.data.reinit(output.names.size(), 8);
        for (unsigned int v = 0; v < 8; ++v)
          {
            const unsigned int i = mesh.cells[c].nodes[v];
            const Row          x = dynamics.x[i];
            const Row          reference{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.};
            const Row          rigid =
              mesh.cells[c].body == wheel_body ? hub.position_of(reference - axle_at_start) : reference;
            patch.vertices[v] = dealii::Point<3>(x[0], x[1], x[2]);
            set_vector<3>(patch, 0, v, 1e6 * (x - rigid));
            set_vector<3>(patch, 3, v, dynamics.v[i]);
            patch.data(6, v) = 1e-6 * von_mises(stress[c]);
            patch.data(7, v) = 1e-6 / 3. * (stress[c][0] + stress[c][1] + stress[c][2]);
            patch.data(8, v) = mesh.cells[c].body;
            if (yields)
              {
                patch.data(9, v) = strain.empty() ? 0. : 100. * strain[c];
                for (unsigned int k = 0; k < 6; ++k)
                  patch.data(10 + k, v) = 1e-6 * stress[c][k];
              }
          }
        output.patches.push_back(std::move(patch));
      }
    const std::string name = numbered("volume", volume_files.size());
    output.write_vtu_in_parallel(path(name), comm);
    volume_files.emplace_back(dynamics.time, name);
    write_collection("volume.pvd", volume_files);
  }


  void RunFolder::write_surface(const Contact          &contact,
                                const unsigned int      body,
                                const std::vector<Row> &positions,
                                const double            time,
                                const double            time_step)
  {
    const std::string name = numbered("surface", surface_files.size());
    surface_files.emplace_back(time, name);
    if (!writes_tables)
      return;
    ArrayOutput<2> output;
    for (const char *scalar : {"pressure_MPa", "state"})
      output.names.emplace_back(scalar);
    output.add_vector("shear_MPa");
    output.add_vector("slip_m_per_s");

    struct Values
    {
      double pressure = 0., state = 0.;
      Row    shear{}, slip{};
    };
    std::vector<Values> values(contact.surfaces.nodes.size());
    for (const ContactNodeState &state : contact.active_nodes())
      {
        const double normal = dot(state.impulse, state.normal), scale = 1e-6 / (state.area * time_step);
        values[state.node] = {scale * normal, state.adhesion ? 1. : 2.,
                              scale * (state.impulse - normal * state.normal), state.slip};
      }
    for (const ContactSurfaces::Face &face : contact.surfaces.faces)
      if (face.body == body)
        {
          ArrayOutput<2>::Patch patch;
          patch.reference_cell = dealii::ReferenceCells::Quadrilateral;
          patch.patch_index    = output.patches.size();
          patch.n_subdivisions = 1;
          patch.data.reinit(output.names.size(), 4);
          constexpr unsigned int around[4] = {0, 1, 3, 2}; // deal.II's order from the counter-clockwise one
          for (unsigned int v = 0; v < 4; ++v)
            {
              const unsigned int i = face.nodes[around[v]];
              const Row          x = positions[i];
              patch.vertices[v]    = dealii::Point<3>(x[0], x[1], x[2]);
              patch.data(0, v)     = values[i].pressure;
              patch.data(1, v)     = values[i].state;
              set_vector<2>(patch, 2, v, values[i].shear);
              set_vector<2>(patch, 5, v, values[i].slip);
            }
          output.patches.push_back(std::move(patch));
        }
    std::ofstream file(path(name));
    output.write_vtu(file);
    file.flush();
    if (!file)
      throw std::runtime_error("cannot write '" + path(name) + "': is the disk full?");
    write_collection("surface.pvd", surface_files);
  }
} // namespace tread
