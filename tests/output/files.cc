// SPDX-License-Identifier: LGPL-2.1-or-later
// Files of a run against closed forms: tables of a rail's cells and surface, pictures of bodies and contact
// surfaces, the list of pictures of a run that is resumed, and the figures of a summary beside references.
#include <tread/base/csv_table.h>
#include <tread/base/file_text.h>
#include <tread/output/run_folder.h>
#include <tread/output/summary.h>
#include <tread/recorders/history.h>

#include <deal.II/base/utilities.h>

#include "boxes.h"
#include "check.h"
#include "temporary_folder.h"
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/filter/zlib.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <regex>
#include <string>
#include <vector>

using namespace tread;
using dealii::Point;
using tests::Side;
using tests::TemporaryFolder;

namespace output_files
{
  /// The numbers of an array of a VTU file, each of this type.
  template <typename Number>
  std::vector<double> numbers(const std::string &encoded)
  {
    // Four numbers about the compressed bytes, then these.
    constexpr std::size_t            n_header = 24;
    const std::vector<unsigned char> packed   = dealii::Utilities::decode_base64(encoded.substr(n_header));
    std::string                      bytes;
    {
      boost::iostreams::filtering_ostream out;
      out.push(boost::iostreams::zlib_decompressor());
      out.push(boost::iostreams::back_inserter(bytes));
      out.write(reinterpret_cast<const char *>(packed.data()), packed.size());
    }
    std::vector<double> values;
    for (std::size_t i = 0; i + sizeof(Number) <= bytes.size(); i += sizeof(Number))
      {
        Number value;
        std::memcpy(&value, bytes.data() + i, sizeof value);
        values.push_back(value);
      }
    return values;
  }

  /// The fields of a picture by their names, and the places of their values as "points".
  std::map<std::string, std::vector<double>> picture(const std::string &name)
  {
    const std::string                          text = text_of_file(name);
    const std::regex                           attribute("(\\w+)=\"([^\"]*)\"");
    std::map<std::string, std::vector<double>> fields;
    for (std::size_t at = text.find("<DataArray"); at != std::string::npos;
         at             = text.find("<DataArray", at + 1))
      {
                    const std::size_t                  end  = text.find('>', at);
                    const std::string                  head = text.substr(at, end - at);
                    std::map<std::string, std::string> attributes;
                    for (std::sregex_iterator i(head.begin(), head.end(), attribute), none; i != none; ++i)
          attributes[(*i)[1]] = (*i)[2];
        std::string encoded = text.substr(end + 1, text.find('<', end) - end - 1);
                    std::erase_if(encoded, [](const unsigned char c) { return std::isspace(c) != 0; });
                    const bool           is_field = attributes.count("Name") > 0;
                    std::vector<double> &values   = fields[is_field ? attributes["Name"] : "points"];
                    if (attributes["type"] == "Float32")
          values = numbers<float>(encoded);
        else if (attributes["type"] == "Float64")
          values = numbers<double>(encoded);
      }
    return fields;
  }

  /// Pictures have single precision, of which a sum of a few terms loses a few bits.
  constexpr double single_precision = 1e-6;


  // A displacement that is linear in x, y and z, with strains so small that Hooke's law holds up to their
  // size. All strains and thus all stresses differ.
  constexpr double gradient[3][3] = {{3e-5, 1.2e-5, -0.7e-5},
                                     {0.4e-5, -2e-5, 0.9e-5},
                                     {0.5e-5, -1.3e-5, 1e-5}};
  constexpr double small_strains  = 2e-4; // relative error that they allow, several times their size

  Vector3 displacement(const Point<3> &p)
  {
    Vector3 u{};
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        u[i] += gradient[i][j] * p[j];
    return u;
  }

  /// By Hooke's law, Pa.
  double stress(const unsigned int i, const unsigned int j)
  {
    const ElasticMaterial steel;
    const double          nu = steel.poisson_ratio, trace = gradient[0][0] + gradient[1][1] + gradient[2][2];
    return steel.young_modulus / (1. + nu) *
           (0.5 * (gradient[i][j] + gradient[j][i]) + (i == j ? nu / (1. - 2. * nu) * trace : 0.));
  }

  /// Of von Mises, from the deviator, Pa.
  double equivalent_stress()
  {
    const double mean = (stress(0, 0) + stress(1, 1) + stress(2, 2)) / 3.;
    double       sum  = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        {
          const double deviator = stress(i, j) - (i == j ? mean : 0.);
          sum += deviator * deviator;
        }
    return std::sqrt(1.5 * sum);
  }

  // The wheel has rolled on: it has turned and moved, and each node has gone a little farther.
  constexpr double axle_height = 0.02, turned = 0.3, rolled = 4e-3;                  // m, rad, m
  const Vector3    beyond_rolling{3e-6, -5e-6, 7e-6, 0.}, velocity{1., 2., -3., 0.}; // m, m/s
  constexpr double plastic_strain = 0.0123;

  /// A rail of 30 mm, 20 mm wide and 10 mm high below z = 0, and a wheel above it, each a box.
  struct Bodies
  {
    Mesh             mesh;
    Solid            solid;
    ExplicitDynamics dynamics;
    WheelHub         hub;

    Bodies()
      : mesh(MPI_COMM_WORLD,
             {tests::make_box("rail",
                              Point<3>(-.01, -.01, -.01),
                              Point<3>(.02, .01, 0.),
                              {{3, 4, 2}},
                              {{Side::top, Boundary::contact}}),
              tests::make_box("wheel", Point<3>(-.01, -.01, .01), Point<3>(.02, .01, .02), {{1, 1, 1}})})
      , solid(mesh, {ElasticMaterial(), ElasticMaterial()}, SolidParameters(), zones())
      , dynamics(mesh, solid, DynamicsParameters())
      , hub(WheelHubParameters())
    {
      dynamics.start();
      hub.place(Vector3{0., 0., axle_height, 0.});
      hub.motion.x     = rolled;
      hub.motion.angle = turned;
      // Before the positions, which are kept together with the velocities.
      for (Vector3 &v : dynamics.state.v)
        v = velocity;
      for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
        {
          const Point<3> &p = mesh.nodes[i];
          const Vector3   start{p[0], p[1], p[2], 0.};
          if (mesh.node_bodies[i] == 0)
            {
              dynamics.state.set_position(i, start + displacement(p));
              continue;
            }
          // Rolling to +x takes what is below the axle to -x.
          const double c = std::cos(turned), s = std::sin(turned), z = p[2] - axle_height;
          dynamics.state.set_position(
            i, Vector3{rolled + c * p[0] + s * z, p[1], axle_height - s * p[0] + c * z, 0.} + beyond_rolling);
        }
      std::vector<CellHistory> histories                 = solid.plastic().stored(dynamics.state.history);
      constexpr unsigned int   equivalent_plastic_strain = 6; // behind the plastic deformation
      for (CellHistory &cell : histories)
        cell.values[equivalent_plastic_strain] = plastic_strain;
      solid.plastic().restore(histories, dynamics.state.history);
    }

    /// All of the rail, which does not yield.
    static std::vector<PlasticZone> zones()
    {
      PlasticMaterial strong;
      strong.yield_stress = 1e12;
      return {{0, strong, [](const Point<3> &) {
                 return true;
               }}};
    }
  };


  /// Largest difference of a column's rows from what they should be, over the largest of these.
  double deviation(const std::vector<double>                          &values,
                   const std::function<double(const std::size_t row)> &expected)
  {
    double largest = 0., difference = values.empty() ? 1. : 0.;
    for (std::size_t i = 0; i < values.size(); ++i)
      {
        largest    = std::max(largest, std::abs(expected(i)));
        difference = std::max(difference, std::abs(values[i] - expected(i)));
      }
    return largest > 0. ? difference / largest : difference;
  }

  const std::map<std::string, std::array<unsigned int, 2>> components{{"xx", {{0, 0}}}, {"yy", {{1, 1}}},
                                                                      {"zz", {{2, 2}}}, {"xy", {{0, 1}}},
                                                                      {"yz", {{1, 2}}}, {"zx", {{2, 0}}}};


  /// Stresses at nodes that tell where each belongs, Pa.
  std::vector<StressRecovery::Stress> nodal_stresses(const Mesh &mesh)
  {
    std::vector<StressRecovery::Stress> stresses;
    for (const Point<3> &p : mesh.nodes)
      stresses.push_back({{1e9 * p[0], 2e9 * p[1], 3e9 * p[2], 4e9 * p[0], 5e9 * p[1], 6e9 * p[0]}});
    return stresses;
  }


  void check_rail_tables(tests::Check &check, const Bodies &bodies, RunFolder &folder)
  {
    // Half of the layers, and of each the middle.
    folder.write_rail_tables(bodies.dynamics, nodal_stresses(bodies.dynamics.mesh), 0, 6e-3);
    const auto all = [](const std::string &) {
      return true;
    };
    const CsvTable cells(folder.path("rail_cells.csv"), all, "no table of cells");
    check.absolute("rail_cells.csv: rows, cells down to 6 mm and 6 mm to both sides", cells.n_rows(), 6, 0.);
    check.absolute("rail_cells.csv: columns", cells.names().size(), 11, 0.);
    for (const auto &[name, ij] : components)
      check.below("rail_cells.csv: stress_" + name + "_MPa, relative",
                  deviation(cells.column("stress_" + name + "_MPa"),
                            [&, ij = ij](std::size_t) { return 1e-6 * stress(ij[0], ij[1]); }),
                  small_strains);
    check.below(
      "rail_cells.csv: von_mises_MPa, relative",
      deviation(cells.column("von_mises_MPa"), [](std::size_t) { return 1e-6 * equivalent_stress(); }),
      small_strains);
    check.below("rail_cells.csv: equivalent_plastic_strain_percent, relative",
                deviation(cells.column("equivalent_plastic_strain_percent"),
                          [](std::size_t) { return 100. * plastic_strain; }),
                1e-8);
    // Centres before the deformation: rows follow each other in x, then in y.
    check.below("rail_cells.csv: x_mm",
                deviation(cells.column("x_mm"), [](std::size_t i) { return -5. + 10. * (i / 2); }), 1e-8);
    check.below("rail_cells.csv: y_mm",
                deviation(cells.column("y_mm"), [](std::size_t i) { return i % 2 == 0 ? -2.5 : 2.5; }), 1e-8);
    check.below("rail_cells.csv: z_mm", deviation(cells.column("z_mm"), [](std::size_t) { return -2.5; }),
                1e-8);

    const CsvTable surface(folder.path("rail_surface.csv"), all, "no table of the surface");
    check.absolute("rail_surface.csv: rows, nodes up to 6 mm to both sides", surface.n_rows(), 12, 0.);
    check.absolute("rail_surface.csv: columns", surface.names().size(), 13, 0.);
    const auto place = [&](const std::size_t i) {
      return 1e-3 * Point<3>(surface.column("x_mm")[i], surface.column("y_mm")[i], surface.column("z_mm")[i]);
    };
    check.below("rail_surface.csv: z_mm", deviation(surface.column("z_mm"), [](std::size_t) { return 0.; }),
                1e-8);
    check.below("rail_surface.csv: y_mm",
                deviation(surface.column("y_mm"), [](std::size_t i) { return 5. * (i % 3) - 5.; }), 1e-8);
    constexpr const char *names[] = {"u_x_um", "u_y_um", "u_z_um"};
    for (unsigned int d = 0; d < 3; ++d)
      check.below("rail_surface.csv: " + std::string(names[d]) + ", relative",
                  deviation(surface.column(names[d]),
                            [&](const std::size_t i) { return 1e6 * displacement(place(i))[d]; }),
                  1e-7); // of which the difference of two positions leaves nine digits
    check.below(
      "rail_surface.csv: stress_yz_MPa, relative",
      deviation(surface.column("stress_yz_MPa"), [&](const std::size_t i) { return 5e3 * place(i)[1]; }),
      1e-8);
    check.below("rail_surface.csv: von_mises_MPa, relative",
                deviation(surface.column("von_mises_MPa"),
                          [&](const std::size_t i) {
                            const Point<3> p = 1e3 * place(i);
                            return von_mises({{p[0], 2. * p[1], 3. * p[2], 4. * p[0], 5. * p[1], 6. * p[0]}});
                          }),
                1e-8);
  }


  void check_bodies(tests::Check &check, const Bodies &bodies, RunFolder &folder)
  {
    folder.write_volume(bodies.dynamics, nodal_stresses(bodies.dynamics.mesh), {{1, &bodies.hub}});
    auto              fields = picture(folder.path("volume-0000.vtu"));
    const std::size_t n_rail = 8 * 3 * 4 * 2, n_all = n_rail + 8; // vertices of cells
    check.absolute("volume: places", fields["points"].size() / 3., n_all, 0.);
    check.below("volume: body",
                deviation(fields["body"], [&](std::size_t i) { return i < n_rail ? 0. : 1.; }), 0.);

    // Where a point of the rail was: the displacement changes it by less than the picture resolves.
    const auto place = [&](const std::size_t i) {
      const std::vector<double> &p = fields["points"];
      return Point<3>(p[3 * i], p[3 * i + 1], p[3 * i + 2]);
    };
    std::vector<double> of_rail(fields["displacement_um"]), of_wheel;
    of_rail.resize(3 * n_rail);
    for (std::size_t i = 3 * n_rail; i < fields["displacement_um"].size(); ++i)
      of_wheel.push_back(fields["displacement_um"][i]);
    check.below("volume: displacement_um of the rail, relative",
                deviation(of_rail, [&](std::size_t i) { return 1e6 * displacement(place(i / 3))[i % 3]; }),
                small_strains);
    check.below("volume: displacement_um of the wheel without its rolling, relative",
                deviation(of_wheel, [](std::size_t i) { return 1e6 * beyond_rolling[i % 3]; }),
                single_precision);
    std::vector<double> recovered = fields["recovered_von_mises_MPa"];
    recovered.resize(n_rail);
    check.below("volume: recovered_von_mises_MPa of the rail, relative",
                deviation(recovered,
                          [&](std::size_t i) {
                            const Point<3> p = 1e3 * place(i);
                            return von_mises({{p[0], 2. * p[1], 3. * p[2], 4. * p[0], 5. * p[1], 6. * p[0]}});
                          }),
                0.05); // places are those of the deformed body
    check.below("volume: velocity_m_per_s",
                deviation(fields["velocity_m_per_s"], [](std::size_t i) { return velocity[i % 3]; }),
                single_precision);
    const auto in_rail = [&](const std::string &name) {
      std::vector<double> values = fields[name];
      values.resize(std::min(values.size(), n_rail));
      return values;
    };
    for (const auto &[name, ij] : components)
      check.below("volume: stress_" + name + "_MPa, relative",
                  deviation(in_rail("stress_" + name + "_MPa"),
                            [&, ij = ij](std::size_t) { return 1e-6 * stress(ij[0], ij[1]); }),
                  small_strains);
    check.below("volume: von_mises_MPa, relative",
                deviation(in_rail("von_mises_MPa"), [](std::size_t) { return 1e-6 * equivalent_stress(); }),
                small_strains);
    check.below(
      "volume: mean_stress_MPa, relative",
      deviation(in_rail("mean_stress_MPa"),
                [](std::size_t) { return 1e-6 / 3. * (stress(0, 0) + stress(1, 1) + stress(2, 2)); }),
      small_strains);
    check.below("volume: equivalent_plastic_strain_percent, relative",
                deviation(in_rail("equivalent_plastic_strain_percent"),
                          [](std::size_t) { return 100. * plastic_strain; }),
                single_precision);
  }


  /// An element of a half-space solution, as it is written without a mesh.
  void check_elements(tests::Check &check, RunFolder &folder)
  {
    PatchNode element{};
    element.position = Vector3{1e-3, -2e-3, 0.5e-3, 0.};
    element.area     = 0.4e-3 * 0.4e-3;
    element.pressure = 811e6;
    element.shear[0] = 212e6;
    element.shear[1] = -93e6;
    element.slip[0]  = -0.041;
    element.slip[1]  = 0.013;
    element.adhesion = false;
    PatchNode other  = element;
    other.adhesion   = true;
    folder.write_surface(std::vector<PatchNode>{element, other}, 0.4e-3);
    auto fields = picture(folder.path("surface-0000.vtu"));
    check.below("half-space's picture: pressure_MPa",
                deviation(fields["pressure_MPa"], [](std::size_t) { return 811.; }), single_precision);
    const double shear[] = {212., -93., 0.}, slip[] = {-0.041, 0.013, 0.};
    check.below("half-space's picture: shear_MPa",
                deviation(fields["shear_MPa"], [&](std::size_t i) { return shear[i % 3]; }),
                single_precision);
    check.below("half-space's picture: slip_m_per_s",
                deviation(fields["slip_m_per_s"], [&](std::size_t i) { return slip[i % 3]; }),
                single_precision);
    check.below("half-space's picture: state, 2 slip and 1 adhesion",
                deviation(fields["state"], [](std::size_t i) { return i < 4 ? 2. : 1.; }), 0.);
    check.below("half-space's picture: corners",
                deviation(fields["points"],
                          [](std::size_t i) {
                            const std::size_t corner = i / 3 % 4;
                            return i % 3 == 0   ? (corner % 2 == 0 ? 0.8e-3 : 1.2e-3)
                                   : i % 3 == 1 ? (corner < 2 ? -2.2e-3 : -1.8e-3)
                                                : 0.5e-3;
                          }),
                single_precision);
  }


  /// Two equal blocks, of which the upper one comes down on the lower one that is free as well. In the first
  /// step only the nodes of the surfaces feel it, with the mass of half a cell: the impulse per area takes
  /// away the difference of velocities of two such masses, along the surface as far as friction can.
  void check_contact(tests::Check &check, const bool slips, RunFolder &folder)
  {
    constexpr double cell = 5e-3, width = 4 * cell, friction = 0.4;
    const Body lower = tests::make_box("lower", Point<3>(0., 0., -2. * cell), Point<3>(width, width, 0.),
                                       {{4, 4, 2}}, {{Side::top, Boundary::contact}}),
               upper = tests::make_box("upper", Point<3>(), Point<3>(width, width, 2. * cell), {{4, 4, 2}},
                                       {{Side::bottom, Boundary::contact}});
    const Mesh         mesh(MPI_COMM_WORLD, {lower, upper});
    const Solid        solid(mesh, {ElasticMaterial(), ElasticMaterial()}, SolidParameters());
    Contact            contact(mesh, ContactParameters(), std::make_shared<CoulombFriction>(friction));
    DynamicsParameters parameters;
    parameters.gravity = 0.;
    ExplicitDynamics dynamics(mesh, solid, parameters);
    dynamics.attach_contact(contact);
    const Vector3 approach = slips ? Vector3{1.6, 1.2, -1., 0.} : Vector3{0.2, -0.1, -1., 0.};
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == 1)
        dynamics.state.v[i] = approach;
    dynamics.start();
    dynamics.step();
    dynamics.state.time = slips ? 2e-3 : 1e-3; // one instant has one picture
    folder.write_surface(dynamics, contact, nodal_stresses(mesh), {}, 0);
    auto fields = picture(folder.path(slips ? "surface-0001.vtu" : "surface-0000.vtu"));

    const std::string name = slips ? "contact that slips: " : "contact that adheres: ";
    const double pressure  = 1e-6 * ElasticMaterial().density * cell / 4. / dynamics.state.time_step; // MPa
    // On the upper block, whose speed along the surface is 2 m/s in the direction 0.8, 0.6 where it slips.
    const Vector3 shear = slips ? pressure * Vector3{-0.8 * friction, -0.6 * friction, 0., 0.}
                                : pressure * Vector3{-0.2, 0.1, 0., 0.},
                  slip  = slips ? (2. - friction) * Vector3{0.8, 0.6, 0., 0.} : Vector3{};
    check.absolute(name + "places", fields["points"].size() / 3., 4. * 16., 0.);
    check.below(name + "state", deviation(fields["state"], [&](std::size_t) { return slips ? 2. : 1.; }), 0.);
    constexpr double of_sweeps = 1e-6; // which end at 1e-7 of the largest impulse
    check.below(name + "pressure_MPa, relative",
                deviation(fields["pressure_MPa"], [&](std::size_t) { return pressure; }), of_sweeps);
    check.below(name + "shear_MPa, relative",
                deviation(fields["shear_MPa"], [&](std::size_t i) { return shear[i % 3]; }), of_sweeps);
    check.below(name + "slip_m_per_s",
                deviation(fields["slip_m_per_s"], [&](std::size_t i) { return slip[i % 3]; }), of_sweeps);
  }


  /// A run of which rows and pictures until 2 ms are kept, and that goes on from 2.5 ms.
  void check_resumed(tests::Check &check, const std::string &path)
  {
    Bodies     bodies;
    const auto columns = history_columns({1, false, false, {}});
    const auto write   = [&](RunFolder &folder, const double time) {
      HistoryRow row{};
      row.time = time;
      row.wheels.resize(1);
      folder.append("history.csv", columns, {row});
      bodies.dynamics.state.time = time;
      folder.write_volume(bodies.dynamics, nodal_stresses(bodies.dynamics.mesh), {});
    };
    std::string kept; // by a checkpoint at 2.5 ms
    {
      RunFolder folder(path, MPI_COMM_WORLD);
      folder.remove_results();
      folder.open_table("history.csv", columns);
      for (const double time : {1e-3, 2e-3, 3e-3, 4e-3})
        {
          if (time == 3e-3)
            kept = folder.progress();
          write(folder, time);
        }
    }
    RunFolder folder(path, MPI_COMM_WORLD);
    folder.continue_from(kept);
    folder.open_table("history.csv", columns);
    write(folder, 3.5e-3);

    const std::string   list = text_of_file(folder.path("volume.pvd"));
    const std::regex    entry("timestep=\"([^\"]*)\"[^>]*file=\"([^\"]*)\"");
    std::vector<double> times;
    std::string         files;
    for (std::sregex_iterator i(list.begin(), list.end(), entry), end; i != end; ++i)
      {
        times.push_back(1e3 * std::stod((*i)[1]));
        files += (*i)[2].str() + " ";
      }
    const double expected[] = {1., 2., 3.5}; // ms
    check.absolute("resumed: pictures in the list", times.size(), 3, 0.);
    check.below("resumed: their times, ms",
                deviation(times, [&](std::size_t i) { return expected[std::min<std::size_t>(i, 2)]; }), 1e-9);
    check.that("resumed: their files: " + files, files == "volume-0000.vtu volume-0001.vtu volume-0002.vtu ");
    const CsvTable history(
      folder.path("history.csv"), [](const std::string &) { return true; }, "no history");
    check.absolute("resumed: rows of history.csv", history.n_rows(), 3, 0.);
    check.below("resumed: their time_s",
                deviation(history.column("time_s"),
                          [&](std::size_t i) { return 1e-3 * expected[std::min<std::size_t>(i, 2)]; }),
                1e-9);
  }


  /// Tables and pictures of a run that is resumed twice, in between without the patches, and without a
  /// picture that somebody has removed.
  void check_switched_off(tests::Check &check, const std::string &path, const PictureFormat format)
  {
    Bodies     bodies;
    const auto columns = history_columns({1, false, false, {}});
    const auto part = [&](const double time, const bool with_patches, std::string kept, const bool removes) {
      RunFolder folder(path, MPI_COMM_WORLD, format);
      if (kept.empty())
        folder.remove_results();
      else
        folder.continue_from(kept);
      folder.open_table("history.csv", columns);
      if (with_patches)
        {
          folder.open_table("patches.csv", patches_columns());
          folder.append("patches.csv", patches_columns(), {{time, 0., PatchNode{}}});
        }
      bodies.dynamics.state.time = time;
      folder.write_volume(bodies.dynamics, nodal_stresses(bodies.dynamics.mesh), {});
      kept = folder.progress();
      if (with_patches)
        folder.append("patches.csv", patches_columns(),
                      {{time + 1., 0., PatchNode{}}}); // after the checkpoint
      if (removes)
        std::filesystem::remove(
          folder.path(format == PictureFormat::vtu ? "volume-0001.vtu" : "volume-0001.h5"));
      return kept;
    };
    const std::string name = format == PictureFormat::vtu ? "vtu: " : "xdmf: ";
    part(4., true, part(3., false, part(2., false, part(1., true, "", false), true), false), false);
    RunFolder      folder(path, MPI_COMM_WORLD, format);
    const CsvTable patches(
      folder.path("patches.csv"), [](const std::string &column) { return column == "time_s"; }, "no patches");
    check.that(name + "patches that were switched off and on: all of them",
               patches.column("time_s") == std::vector<double>{1., 4., 5.});
    const std::string   list = text_of_file(folder.path(folder.list_of_pictures("volume")));
    const std::regex    entry("(timestep=|Time Value=)\"([^\"]*)\"");
    std::vector<double> times;
    for (std::sregex_iterator i(list.begin(), list.end(), entry), end; i != end; ++i)
      times.push_back(std::stod((*i)[2]));
    check.that(name + "a picture that was removed is not in the list",
               times == std::vector<double>{1., 3., 4.});
    for (const char *number : {"0000", "0001", "0002"})
      check.that(name + "picture " + number + " is there",
                 std::filesystem::exists(folder.path(std::string("volume-") + number +
                                                     (format == PictureFormat::vtu ? ".vtu" : ".h5"))));
  }


  /// A disk that fills while a file is written: here no file may be larger than that.
  void check_full_disk(tests::Check &check, const std::string &path)
  {
    constexpr rlim_t room = 1 << 16; // bytes
    RunFolder        folder(path, MPI_COMM_WORLD);
    folder.write("text.json", "kept");
    rlimit before;
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{room, before.rlim_max};
    const auto   old_handler = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string said =
      tests::complaint<std::runtime_error>([&] { folder.write("text.json", std::string(2 * room, 'x')); });
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, old_handler);
    check.that("no room: said", said.find("cannot write") != std::string::npos);
    check.that("no room: the file of before is kept", text_of_file(folder.path("text.json")) == "kept");
    check.that("no room: nothing half written stays",
               !std::filesystem::exists(folder.path("text.json.part")));
  }


  void check_summary(tests::Check &check)
  {
    Summary summary;
    summary.compare("max_pressure_Pa", "maximum pressure, MPa", 1e-6, 1100e6, "Hertz", 1000e6, 0., 7e6);
    summary.compare("creepage", "creepage, 1e-3", 1e3, 1e-3, "half-space", 1e-6, 1e-5);
    const auto  json = nlohmann::json::parse(summary.text());
    const auto &of   = json["reference"]["max_pressure_Pa"]["Hertz"];
    check.relative("summary: the value", json["max_pressure_Pa"].get<double>(), 1100e6, 0.);
    check.relative("summary: its reference", of["value"].get<double>(), 1000e6, 0.);
    check.absolute("summary: relative_difference of a value that is a tenth larger",
                   of["relative_difference"].get<double>(), 0.1, 1e-12);
    check.relative("summary: uncertainty of the reference",
                   json["max_pressure_Pa_hertz_uncertainty"].get<double>(), 7e6, 0.);
    check.that("summary: none from a reference that is as good as nothing",
               json["reference"]["creepage"]["half-space"]["relative_difference"].is_null());
    const std::string table = summary.table();
    check.that("summary: the table shows it",
               table.find("1100") != std::string::npos && table.find("+10.00%") != std::string::npos);
  }
} // namespace output_files


TREAD_TEST(output_files)(tests::Check &check, const tests::Arguments &)
{
  const TemporaryFolder temporary;
  {
    Bodies    bodies;
    RunFolder folder(temporary.path + "/tables", MPI_COMM_WORLD);
    check_rail_tables(check, bodies, folder);
    check_bodies(check, bodies, folder);
    check_elements(check, folder);
  }
  {
    RunFolder folder(temporary.path + "/contact", MPI_COMM_WORLD);
    check_contact(check, false, folder);
    check_contact(check, true, folder);
  }
  check_resumed(check, temporary.path + "/resumed");
  check_switched_off(check, temporary.path + "/vtu", PictureFormat::vtu);
  check_switched_off(check, temporary.path + "/xdmf", PictureFormat::xdmf);
  check_full_disk(check, temporary.path + "/full");
  check_summary(check);
}
