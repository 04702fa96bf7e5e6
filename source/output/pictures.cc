// SPDX-License-Identifier: LGPL-2.1-or-later
// The pictures of a run: what is in them, and the lists of them.
#include <tread/output/run_folder.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <numeric>
#include <sstream>

namespace tread
{
  namespace
  {
    /// A field of a picture: its name with the unit, and its values as they are written, by what it is asked
    /// for at a point, or of a cell. A new field is one line in a list.
    template <typename Value, typename At>
    struct Field
    {
      std::string                      name;
      std::function<Value(const At &)> value;
    };

    template <typename At>
    using Vectors = std::vector<Field<Vector3, At>>;
    template <typename At>
    using Scalars = std::vector<Field<double, At>>;

    template <typename At>
    void add_fields(Picture               &picture,
                    const std::vector<At> &places,
                    const bool             at_points,
                    const Vectors<At>     &vectors,
                    const Scalars<At>     &scalars)
    {
      for (const auto &field : vectors)
        {
          Picture::Field added{field.name, 3, at_points, {}};
          for (const At &at : places)
            {
              const Vector3 value = field.value(at);
              for (unsigned int d = 0; d < 3; ++d)
                added.values.push_back(value[d]);
            }
          picture.fields.push_back(std::move(added));
        }
      for (const auto &field : scalars)
        {
          Picture::Field added{field.name, 1, at_points, {}};
          for (const At &at : places)
            added.values.push_back(field.value(at));
          picture.fields.push_back(std::move(added));
        }
    }

    // States of faces: one slips if a node of it does.
    constexpr double apart = 0., adheres = 1., slips = 2.;

    struct SurfaceValues
    {
      double  pressure = 0.;   // MPa
      Vector3 shear{}, slip{}; // MPa, m/s
    };

    /// @param of_faces the states, which have no meaning between two of them
    void add_surface_fields(Picture                          &picture,
                            const std::vector<SurfaceValues> &values,
                            const bool                        at_points,
                            const std::vector<double>        &of_faces)
    {
      using S = SurfaceValues;
      static const Vectors<S>      vectors{{"shear_MPa",
                                            [](const S &s) {
                                         return s.shear;
                                       }},
                                      {"slip_m_per_s", [](const S &s) {
                                         return s.slip;
                                       }}};
      static const Scalars<S>      scalars{{"pressure_MPa", [](const S &s) {
                                         return s.pressure;
                                       }}};
      static const Scalars<double> states{{"state", [](const double state) {
                                             return state;
                                           }}};
      add_fields(picture, values, at_points, vectors, scalars);
      add_fields(picture, of_faces, false, {}, states);
    }

    constexpr const char *components[] = {"xx", "yy", "zz", "xy", "yz", "zx"};

    /// Recovered stresses at nodes: the first fields of von Mises stress and the components.
    Scalars<unsigned int> stress_fields(const std::vector<StressRecovery::Stress> &stresses,
                                        const unsigned int                         n_fields)
    {
      Scalars<unsigned int> fields{{"recovered_von_mises_MPa", [&stresses](const unsigned int i) {
                                      return 1e-6 * von_mises(stresses[i]);
                                    }}};
      for (unsigned int k = 0; k + 1 < n_fields; ++k)
        fields.push_back(
          {std::string("recovered_stress_") + components[k] + "_MPa", [&stresses, k](const unsigned int i) {
             return 1e-6 * stresses[i][k];
           }});
      return fields;
    }

    /// Numbers that somebody keeps on nodes. @see State::fields
    Scalars<unsigned int> kept_fields(const State &state)
    {
      Scalars<unsigned int> fields;
      for (const auto &[name, values] : state.fields)
        fields.push_back({name, [&values = values](const unsigned int i) {
                            return values[i];
                          }});
      return fields;
    }

    const Scalars<SurfacePlace> &damage_fields()
    {
      using P = SurfacePlace;
      static const Scalars<P> fields{{"friction_work_J_per_m2",
                                      [](const P &p) {
                                        return p.friction_work;
                                      }},
                                     {"slip_distance_m",
                                      [](const P &p) {
                                        return p.slip_distance;
                                      }},
                                     {"max_flash_temperature_K",
                                      [](const P &p) {
                                        return p.max_temperature;
                                      }},
                                     {"wear_depth_m", [](const P &p) {
                                        return p.wear_depth;
                                      }}};
      return fields;
    }

    void add_point(Picture &picture, const Vector3 place)
    {
      for (unsigned int d = 0; d < 3; ++d)
        picture.points.push_back(place[d]);
    }

    std::string numbered(const std::string &stem, const std::size_t number, const std::string &ending)
    {
      char text[64];
      std::snprintf(text, sizeof text, "%s-%04zu.%s", stem.c_str(), number, ending.c_str());
      return text;
    }

    /// The number in such a name.
    std::string number_in(const std::string &name)
    {
      const std::size_t begin = name.rfind('-') + 1;
      return name.substr(begin, name.rfind('.') - begin);
    }

    /// The points of some of a mesh's nodes, which get numbers as they are met.
    class PointsOfNodes
    {
    public:
      PointsOfNodes(const ExplicitDynamics &dynamics, Picture &picture)
        : dynamics(dynamics)
        , picture(picture)
        , number(dynamics.mesh.nodes.size(), -1)
      {
      }

      void add_corner(const unsigned int node)
      {
        if (number[node] < 0)
          {
            number[node] = nodes.size();
            nodes.push_back(node);
            add_point(picture, dynamics.state.position(node));
          }
        picture.corners.push_back(number[node]);
      }

      std::vector<unsigned int> nodes;

    private:
      const ExplicitDynamics &dynamics;
      Picture                &picture;
      std::vector<int>        number;
    };
  } // namespace


  void RunFolder::add_picture(const std::string &stem, const Picture &of_rank, const double time)
  {
    Series &series = pictures[stem];
    // One of the same instant is the same picture: ParaView shows neither, or both.
    if (!series.files.empty() && series.files.back().first == time)
      {
        series.files.pop_back();
        if (!series.grids.empty())
          series.grids.pop_back();
      }
    const std::size_t number =
      series.files.empty() ? 0 : std::stoul(number_in(series.files.back().second)) + 1;
    if (picture_format == PictureFormat::vtu)
      {
        const std::string name = numbered(stem, number, "vtu"), pieces = gather(vtu_piece(of_rank));
        series.files.emplace_back(time, name);
        if (!writes_tables)
          return;
        std::ostringstream vtu, collection;
        dealii::DataOutBase::write_vtu_header(vtu, dealii::DataOutBase::VtkFlags());
        vtu << pieces;
        dealii::DataOutBase::write_vtu_footer(vtu);
        write(name, vtu.str());
        dealii::DataOutBase::write_pvd_record(collection, series.files);
        write(stem + ".pvd", collection.str());
        return;
      }
    const std::string          name = numbered(stem, number, "h5");
    const std::vector<Picture> all  = dealii::Utilities::MPI::gather(comm, of_rank, 0);
    series.files.emplace_back(time, name);
    if (!writes_tables)
      return;
    Picture picture = of_rank;
    for (std::size_t rank = 1; rank < all.size(); ++rank)
      picture.add(all[rank]);
    write_through(name, [&](const std::string &path) { write_hdf5_picture(path, picture); });
    series.grids.push_back(xdmf_grid(picture, name.substr(0, name.size() - 3), name + ":/", time));
    write(stem + ".xdmf", xdmf_collection(stem, series.grids));
  }


  void RunFolder::join_pictures() const
  {
    if (!writes_tables || picture_format == PictureFormat::vtu)
      return;
    for (const auto &[stem, series] : pictures)
      {
        const std::string                                joined = stem + ".h5";
        std::vector<std::pair<std::string, std::string>> all;
        std::vector<std::string>                         grids;
        for (std::size_t i = 0; i < series.files.size(); ++i)
          {
            const std::string &alone = series.files[i].second;
            if (!std::filesystem::exists(path(alone))) // removed by hand
              continue;
            const std::string group = number_in(alone);
            all.emplace_back(group, path(alone));
            grids.push_back(dealii::Utilities::replace_in_string(series.grids[i], alone + ":/",
                                                                 joined + ":/" + group + "/"));
          }
        if (all.empty())
          continue;
        write_through(joined, [&](const std::string &path) { join_hdf5_pictures(path, all); });
        write(stem + ".xdmf", xdmf_collection(stem, grids));
        for (const auto &[group, alone] : all)
          std::filesystem::remove(alone);
      }
  }


  void RunFolder::write_volume(const ExplicitDynamics                         &dynamics,
                               const std::vector<StressRecovery::Stress>      &stresses,
                               const std::map<unsigned int, const WheelHub *> &hubs)
  {
    const Mesh                              &mesh = dynamics.mesh;
    const std::vector<std::array<double, 6>> stress =
      dynamics.solid.cauchy_stress(dynamics.state.positions().data(), dynamics.state.history);
    const std::vector<double> strain =
      dynamics.solid.plastic().equivalent_plastic_strain(dynamics.state.history);

    Picture       picture;
    PointsOfNodes points(dynamics, picture);
    for (const Mesh::Cell &cell : mesh.cells)
      for (const unsigned int node : cell.nodes)
        points.add_corner(node);

    const Vectors<unsigned int> of_nodes{
      {"displacement_um", // without the hub's rigid motion
       [&](const unsigned int i) {
         Vector3 rigid{mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.};
         if (const auto wheel = hubs.find(mesh.node_bodies[i]); wheel != hubs.end())
           rigid = wheel->second->position_of(rigid - wheel->second->start());
         return 1e6 * (dynamics.state.position(i) - rigid);
       }},
      {"velocity_m_per_s", [&](const unsigned int i) {
         return dynamics.state.v[i];
       }}};
    Scalars<unsigned int> of_cells{{"von_mises_MPa",
                                    [&](const unsigned int c) {
                                      return 1e-6 * von_mises(stress[c]);
                                    }},
                                   {"mean_stress_MPa",
                                    [&](const unsigned int c) {
                                      return 1e-6 / 3. * (stress[c][0] + stress[c][1] + stress[c][2]);
                                    }},
                                   {"body", [&](const unsigned int c) {
                                      return double(mesh.cells[c].body);
                                    }}};
    for (unsigned int k = 0; k < 6; ++k)
      of_cells.push_back({std::string("stress_") + components[k] + "_MPa", [&, k](const unsigned int c) {
                            return 1e-6 * stress[c][k];
                          }});
    // The same fields on all ranks.
    if (dealii::Utilities::MPI::logical_or(!dynamics.state.history.values.empty(), comm))
      of_cells.push_back({"equivalent_plastic_strain_percent", [&](const unsigned int c) {
                            return strain.empty() ? 0. : 100. * strain[c];
                          }});
    if (dealii::Utilities::MPI::logical_or(
          std::any_of(mesh.cells.begin(), mesh.cells.end(),
                      [](const Mesh::Cell &c) { return !c.has_own_material(); }),
          comm))
      of_cells.push_back({"material", [&](const unsigned int c) {
                            return double(mesh.cells[c].material);
                          }});
    std::vector<unsigned int> cells(mesh.cells.size());
    std::iota(cells.begin(), cells.end(), 0u);
    add_fields(picture, points.nodes, true, of_nodes, stress_fields(stresses, 1));
    add_fields(picture, points.nodes, true, {}, kept_fields(dynamics.state));
    add_fields(picture, cells, false, {}, of_cells);
    add_picture("volume", picture, dynamics.state.time);
  }


  void RunFolder::write_surface(const ExplicitDynamics                    &dynamics,
                                const Contact                             &contact,
                                const std::vector<StressRecovery::Stress> &stresses,
                                const std::vector<SurfacePlace>           &damage,
                                const unsigned int                         body)
  {
    const Mesh                &mesh = dynamics.mesh;
    std::vector<SurfaceValues> of_nodes(mesh.nodes.size());
    std::vector<double>        state_of_node(mesh.nodes.size(), apart), states;
    for (const ContactNodeState &state : contact.active_nodes())
      if (const int node = contact.surfaces.nodes[state.node].local; node >= 0)
        {
          const double normal = dot(state.impulse, state.normal),
                       scale  = 1e-6 / (state.area * dynamics.state.time_step);
          of_nodes[node]      = {scale * normal, scale * (state.impulse - normal * state.normal), state.slip};
          state_of_node[node] = state.adhesion ? adheres : slips;
        }
    // Those of the mesh: contact leaves out faces with an edge that hangs.
    Picture picture;
    picture.n_corners = 4;
    PointsOfNodes points(dynamics, picture);
    for (const Mesh::Face &face : mesh.faces)
      if (face.body == body && face.boundary == Boundary::contact)
        {
          states.push_back(apart);
          for (const unsigned int v : {0, 1, 3, 2}) // from the counter-clockwise order
            {
              points.add_corner(face.nodes[v]);
              states.back() = std::max(states.back(), state_of_node[face.nodes[v]]);
            }
        }
    std::vector<SurfaceValues> values;
    for (const unsigned int node : points.nodes)
      values.push_back(of_nodes[node]);
    add_surface_fields(picture, values, true, states);
    add_fields(picture, points.nodes, true, {}, stress_fields(stresses, 7));
    add_fields(picture, points.nodes, true, {}, kept_fields(dynamics.state));
    if (!damage.empty())
      {
        std::vector<SurfacePlace> of_mesh(mesh.nodes.size());
        for (unsigned int i = 0; i < damage.size(); ++i)
          if (const int node = contact.surfaces.nodes[i].local; node >= 0)
            of_mesh[node] = damage[i];
        std::vector<SurfacePlace> at_points;
        for (const unsigned int node : points.nodes)
          at_points.push_back(of_mesh[node]);
        add_fields(picture, at_points, true, {}, damage_fields());
      }
    add_picture("surface", picture, dynamics.state.time);
  }


  void RunFolder::write_surface(const std::vector<PatchNode> &elements, const double element_size)
  {
    Picture picture;
    picture.n_corners = 4;
    std::vector<SurfaceValues> values;
    std::vector<double>        states;
    if (writes_tables) // all ranks know all of them
      for (const PatchNode &element : elements)
        {
          values.emplace_back();
          values.back().pressure = 1e-6 * element.pressure;
          states.push_back(element.adhesion ? adheres : slips);
          for (unsigned int d = 0; d < 2; ++d)
            {
              values.back().shear[d] = 1e-6 * element.shear[d];
              values.back().slip[d]  = element.slip[d];
            }
          for (unsigned int v = 0; v < 4; ++v)
            {
              picture.corners.push_back(picture.n_points());
              add_point(picture,
                        element.position + Vector3{(v % 2 - 0.5) * element_size,
                                                   (v / 2 - 0.5) * element.area / element_size, 0., 0.});
            }
        }
    add_surface_fields(picture, values, false, states);
    add_picture("surface", picture, 0.);
  }
} // namespace tread
