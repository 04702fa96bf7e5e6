// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/run_folder.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>
#include <deal.II/grid/reference_cell.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <sstream>

namespace tread
{
  namespace
  {
    /// Patches made from plain arrays, and the text that deal.II makes of them.
    template <int dim>
    struct ArrayOutput
    {
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

      /// The part of a VTU file with these patches.
      std::string piece() const
      {
        std::ostringstream text;
        if (!patches.empty())
          dealii::DataOutBase::write_vtu_main(patches, names, ranges, dealii::DataOutBase::VtkFlags(), text);
        return text.str();
      }
    };

    /// A field of a picture: its name with the unit, and its values as they are written, by what it is asked
    /// for at a vertex. A new field is one line in a list.
    template <typename Value, typename At>
    struct Field
    {
      std::string                      name;
      std::function<Value(const At &)> value;
    };

    /// The fields of one picture: vectors first.
    template <int dim, typename At>
    struct Fields
    {
      std::vector<Field<Vector3, At>> vectors;
      std::vector<Field<double, At>>  scalars;

      ArrayOutput<dim> output() const
      {
        ArrayOutput<dim> empty;
        for (const auto &field : vectors)
          empty.add_vector(field.name);
        for (const auto &field : scalars)
          empty.names.push_back(field.name);
        return empty;
      }

      /// Set the values at a vertex of a patch.
      void set(typename ArrayOutput<dim>::Patch &patch, const unsigned int vertex, const At &at) const
      {
        unsigned int row = 0;
        for (const auto &field : vectors)
          {
            const Vector3 value = field.value(at);
            for (unsigned int d = 0; d < 3; ++d)
              patch.data(row++, vertex) = value[d];
          }
        for (const auto &field : scalars)
          patch.data(row++, vertex) = field.value(at);
      }
    };

    struct SurfaceValues
    {
      double  pressure = 0., state = 0.; // MPa; 0 apart, 1 adhesion, 2 slip
      Vector3 shear{}, slip{};           // MPa, m/s
    };

    const Fields<2, SurfaceValues> &surface_fields()
    {
      using S = SurfaceValues;
      static const Fields<2, S> fields{{{"shear_MPa",
                                         [](const S &s) {
                                           return s.shear;
                                         }},
                                        {"slip_m_per_s",
                                         [](const S &s) {
                                           return s.slip;
                                         }}},
                                       {{"pressure_MPa",
                                         [](const S &s) {
                                           return s.pressure;
                                         }},
                                        {"state", [](const S &s) {
                                           return s.state;
                                         }}}};
      return fields;
    }

    /// Vertices in deal.II's order.
    void add_face(ArrayOutput<2>                     &output,
                  const std::array<Vector3, 4>       &vertices,
                  const std::array<SurfaceValues, 4> &values)
    {
      ArrayOutput<2>::Patch patch;
      patch.reference_cell = dealii::ReferenceCells::Quadrilateral;
      patch.patch_index    = output.patches.size();
      patch.n_subdivisions = 1;
      patch.data.reinit(output.names.size(), 4);
      for (unsigned int v = 0; v < 4; ++v)
        {
          patch.vertices[v] = dealii::Point<3>(vertices[v][0], vertices[v][1], vertices[v][2]);
          surface_fields().set(patch, v, values[v]);
        }
      output.patches.push_back(std::move(patch));
    }

    std::string numbered(const std::string &stem, const std::size_t number)
    {
      char text[64];
      std::snprintf(text, sizeof text, "%s-%04zu.vtu", stem.c_str(), number);
      return text;
    }
  } // namespace


  void RunFolder::add_picture(const std::string                           &stem,
                              const std::string                           &pieces,
                              const double                                 time,
                              std::vector<std::pair<double, std::string>> &files) const
  {
    if (!writes_tables)
      return;
    const std::string  name = numbered(stem, files.size());
    std::ostringstream vtu;
    dealii::DataOutBase::write_vtu_header(vtu, dealii::DataOutBase::VtkFlags());
    vtu << pieces;
    dealii::DataOutBase::write_vtu_footer(vtu);
    write(name, vtu.str());
    files.emplace_back(time, name);
    std::ostringstream collection;
    dealii::DataOutBase::write_pvd_record(collection, files);
    write(stem + ".pvd", collection.str());
  }


  void RunFolder::write_volume(const ExplicitDynamics                         &dynamics,
                               const std::map<unsigned int, const WheelHub *> &hubs)
  {
    const Mesh                              &mesh = dynamics.mesh;
    const std::vector<std::array<double, 6>> stress =
      dynamics.solid.cauchy_stress(dynamics.positions().data(), dynamics.history);
    const std::vector<double> strain = dynamics.solid.plastic().equivalent_plastic_strain(dynamics.history);

    struct At ///< a node of a cell
    {
      unsigned int cell, node;
      Vector3      displacement; // m, without the hub's rigid motion
    };
    Fields<3, At> fields{{{"displacement_um",
                           [](const At &at) {
                             return 1e6 * at.displacement;
                           }},
                          {"velocity_m_per_s",
                           [&](const At &at) {
                             return dynamics.v[at.node];
                           }}},
                         {{"von_mises_MPa",
                           [&](const At &at) {
                             return 1e-6 * von_mises(stress[at.cell]);
                           }},
                          {"mean_stress_MPa",
                           [&](const At &at) {
                             return 1e-6 / 3. *
                                    (stress[at.cell][0] + stress[at.cell][1] + stress[at.cell][2]);
                           }},
                          {"body", [&](const At &at) {
                             return double(mesh.cells[at.cell].body);
                           }}}};
    // What remains of the stress behind the wheel is the residual stress.
    const bool yields = dealii::Utilities::MPI::logical_or(!dynamics.history.values.empty(), comm);
    if (yields) // the same fields on all ranks
      {
        fields.scalars.push_back({"equivalent_plastic_strain_percent", [&](const At &at) {
                                    return strain.empty() ? 0. : 100. * strain[at.cell];
                                  }});
        constexpr const char *components[] = {"xx", "yy", "zz", "xy", "yz", "zx"};
        for (unsigned int k = 0; k < 6; ++k)
          fields.scalars.push_back({std::string("stress_") + components[k] + "_MPa", [&, k](const At &at) {
                                      return 1e-6 * stress[at.cell][k];
                                    }});
      }

    ArrayOutput<3> output = fields.output();
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        ArrayOutput<3>::Patch patch;
        patch.reference_cell = dealii::ReferenceCells::Hexahedron;
        patch.patch_index    = c;
        patch.n_subdivisions = 1;
        patch.data.reinit(output.names.size(), 8);
        const auto wheel = hubs.find(mesh.cells[c].body);
        for (unsigned int v = 0; v < 8; ++v)
          {
            const unsigned int i = mesh.cells[c].nodes[v];
            const Vector3      x = dynamics.position(i);
            Vector3            rigid{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.};
            if (wheel != hubs.end())
              {
                const WheelHub &hub = *wheel->second;
                rigid               = hub.position_of(rigid - hub.start());
              }
            patch.vertices[v] = dealii::Point<3>(x[0], x[1], x[2]);
            fields.set(patch, v, {c, i, x - rigid});
          }
        output.patches.push_back(std::move(patch));
      }
    add_picture("volume", gather(output.piece()), dynamics.time, volume_files);
  }


  void RunFolder::write_surface(const ExplicitDynamics &dynamics,
                                const Contact          &contact,
                                const unsigned int      body)
  {
    std::vector<Vector3> positions;
    contact.surfaces.replicate(dynamics.positions().data(), positions);
    const std::vector<ContactNodeState> states = contact.active_nodes();
    if (!writes_tables) // all ranks know all of the surface
      return;
    ArrayOutput<2>             output = surface_fields().output();
    std::vector<SurfaceValues> values(contact.surfaces.nodes.size());
    for (const ContactNodeState &state : states)
      {
        const double normal = dot(state.impulse, state.normal),
                     scale  = 1e-6 / (state.area * dynamics.time_step);
        values[state.node]  = {scale * normal, state.adhesion ? 1. : 2.,
                               scale * (state.impulse - normal * state.normal), state.slip};
      }
    for (const ContactSurfaces::Face &face : contact.surfaces.faces)
      if (face.body == body)
        {
          constexpr unsigned int       around[4] = {0, 1, 3, 2}; // from the counter-clockwise order
          std::array<Vector3, 4>       vertices;
          std::array<SurfaceValues, 4> at;
          for (unsigned int v = 0; v < 4; ++v)
            {
              const unsigned int i = face.nodes[around[v]];
              vertices[v]          = positions[i];
              at[v]                = values[i];
            }
          add_face(output, vertices, at);
        }
    add_picture("surface", output.piece(), dynamics.time, surface_files);
  }


  void RunFolder::write_surface(const std::vector<PatchNode> &elements, const double element_size)
  {
    if (!writes_tables)
      return;
    ArrayOutput<2> output = surface_fields().output();
    for (const PatchNode &element : elements)
      {
        SurfaceValues values;
        values.pressure = 1e-6 * element.pressure;
        values.state    = element.adhesion ? 1. : 2.;
        for (unsigned int d = 0; d < 2; ++d)
          {
            values.shear[d] = 1e-6 * element.shear[d];
            values.slip[d]  = element.slip[d];
          }
        std::array<Vector3, 4> vertices;
        for (unsigned int v = 0; v < 4; ++v)
          vertices[v] =
            element.position + Vector3{(v % 2 - 0.5) * element_size, (v / 2 - 0.5) * element_size, 0., 0.};
        add_face(output, vertices, {values, values, values, values});
      }
    add_picture("surface", output.piece(), 0., surface_files);
  }
} // namespace tread
