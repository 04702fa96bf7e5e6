// SPDX-License-Identifier: LGPL-2.1-or-later
// A quarter of an elastic sphere strikes a rigid plane: duration, largest force and approach compared with
// the closed form of Hertz's impact, and the rebound speed.
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/reference/hertz.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"
#include "check.h"

#include <algorithm>
#include <map>

using namespace tread;
using tests::Check;
using dealii::Point;

namespace contact_impact
{
  constexpr double radius = 0.01; // m

  /// The quarter x, y > 0 of a sphere about the origin: a core of cubes in [-1/2, 1/2]^3 of the chart, and a
  /// shell between it and the cube [-1, 1]^3, which becomes the sphere. Cells around the lowest point have
  /// the edge length h within a reach, and grow with the distance beyond it.
  Body make_quarter_sphere(const double h, const double reach, const double cells_per_level)
  {
    constexpr double largest = 1e-3; // m: polyhedra of larger cells are too light
    constexpr int    n       = 2;    // coarse cells from the middle to a side
    constexpr double core    = 0.45;
    Body             body;
    body.name = "sphere";
    std::map<std::array<int, 4>, unsigned int> numbers;
    const auto vertex = [&](const int i, const int j, const int k, const int shell) {
      const auto [place, is_new] =
        numbers.emplace(std::array<int, 4>{{i, j, k, shell}}, body.vertices.size());
      const double scale = (shell ? 1. : core) / n;
      if (is_new)
        body.vertices.emplace_back(scale * i, scale * j, scale * k);
      return place->second;
    };
    const auto add = [&](const std::array<std::array<int, 4>, 8> &corners) {
      dealii::CellData<3> cell;
      for (unsigned int v = 0; v < 8; ++v)
        cell.vertices[v] = vertex(corners[v][0], corners[v][1], corners[v][2], corners[v][3]);
      body.cells.push_back(cell);
    };
    for (int k = -n; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          {
            std::array<std::array<int, 4>, 8> corners;
            for (int v = 0; v < 8; ++v)
              corners[v] = {{i + (v & 1), j + ((v >> 1) & 1), k + ((v >> 2) & 1), 0}};
            add(corners);
            // A face of the core on its surface carries a cell of the shell.
            for (int d = 0; d < 3; ++d)
              for (int side = 0; side < 2; ++side)
                {
                  const int at[3] = {i, j, k};
                  if (at[d] + side != (side ? n : -n))
                    continue;
                  std::array<std::array<int, 4>, 8> shell;
                  for (int v = 0; v < 8; ++v)
                    {
                      // Out of the core towards the shell along d, whichever way that is.
                      const int on_face = side ? v | (1 << d) : v & ~(1 << d);
                      shell[v]          = corners[on_face];
                      shell[v][3]       = ((v >> d) & 1) == side ? 1 : 0;
                    }
                  add(shell);
                }
          }
    const Point<3> pole(0., 0., -1.);
    const auto     to_space = [](const Point<3> &p) {
      const double cube = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
      if (cube <= core)
        return Point<3>(radius * p);
      // On a straight line from the core's plane side to the sphere.
      const double   outwards = (cube - core) / (1. - core);
      const Point<3> on_cube(p / cube);
      return Point<3>(radius * ((1. - outwards) * core + outwards / on_cube.norm()) * on_cube);
    };
    body.to_space         = to_space;
    body.wanted_cell_size = [=](const Point<3> &p) {
      // A level of cells of size s is cells_per_level of them wide.
      const double beyond = std::max(0., radius * p.distance(pole) - reach);
      return std::min(h + beyond / cells_per_level, largest) / radius;
    };
    body.boundary_at = [](const Point<3> &p) {
      // Only the lowest cells of the shell may touch.
      return p[2] < -0.999 && p[0] < 0.5 && p[1] < 0.5 ? Boundary::contact : Boundary::free;
    };
    return body;
  }

  /// E* of a body on a rigid plane, Pa.
  double plane_modulus(const ElasticMaterial &m)
  {
    return m.young_modulus / (1. - m.poisson_ratio * m.poisson_ratio);
  }

  double sphere_mass(const ElasticMaterial &m)
  {
    return m.density * 4. / 3. * dealii::numbers::PI * radius * radius * radius;
  }

  struct Impact
  {
    double duration = 0., force = 0., approach = 0., restitution = 0.; ///< s, N, m, -
    double energy_residual = 0., mass = 0.;                            ///< share of the energy, kg
    double reach = 0.;                                                 ///< of loaded nodes from the middle, m
  };

  Impact run(const double speed, const double h, const double reach, const double cells_per_level)
  {
    const ElasticMaterial steel;
    // The plane is the slave: its normals are those of the symmetric contact at the planes of symmetry, too.
    const unsigned int n    = std::ceil(reach / h);
    const double       side = n * h;
    const Mesh         mesh(MPI_COMM_WORLD,
                            {tests::make_box("plane", Point<3>(0., 0., -radius - h), Point<3>(side, side, -radius),
                                             {{n, n, 1}}, {{tests::Side::top, Boundary::contact}}),
                             make_quarter_sphere(h, reach, cells_per_level)});
    SolidParameters    solid_parameters;
    solid_parameters.max_level = 7;
    const Solid        solid(mesh, {steel, steel}, solid_parameters);
    DynamicsParameters dynamics_parameters;
    dynamics_parameters.gravity = 0.;
    ExplicitDynamics          dynamics(mesh, solid, dynamics_parameters);
    std::vector<unsigned int> of_plane, on_x, on_y;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == 0)
        of_plane.push_back(i);
      else
        {
          dynamics.state.v[i] = Vector3{0., 0., -speed, 0.};
          if (mesh.nodes[i][0] < 1e-9)
            on_x.push_back(i);
          if (mesh.nodes[i][1] < 1e-9)
            on_y.push_back(i);
        }
    dynamics.fix_nodes(of_plane);
    dynamics.guide_nodes(on_x, 0);
    dynamics.guide_nodes(on_y, 1);
    Contact contact(mesh, ContactParameters(), std::make_shared<CoulombFriction>(0.));
    dynamics.attach_contact(contact);
    dynamics.start();

    double mass = 0.;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == 1)
        mass += dynamics.true_masses()[i];
    const double duration = reference::hertz_impact(4. * mass, radius, plane_modulus(steel), speed).duration;
    Impact       impact;
    double       begin = -1., end = 0., velocity = -speed, middle = 0.;
    while (dynamics.state.time < 1.1 * duration || !dynamics.synchronised())
      {
        dynamics.step();
        const double force = 4. * std::abs(contact.total_impulse()[2]) / dynamics.state.time_step;
        // The middle of the mass moves by the contact force alone.
        velocity += 0.25 * force / mass * dynamics.state.time_step;
        middle += velocity * dynamics.state.time_step;
        if (force > 0.)
          {
            begin = begin < 0. ? dynamics.state.time : begin;
            end   = dynamics.state.time;
          }
        impact.force    = std::max(impact.force, force);
        impact.approach = std::max(impact.approach, -middle);
        if (dynamics.state.n_steps % 256 == 0)
          for (const ContactNodeState &node : contact.active_nodes())
            impact.reach = std::max(impact.reach, std::hypot(node.position[0], node.position[1]));
      }
    impact.duration        = end - begin;
    impact.restitution     = velocity / speed;
    impact.mass            = 4. * mass;
    impact.energy_residual = dynamics.ledger().residual() / (0.5 * mass * speed * speed);
    std::printf("%llu cells, %llu steps, mass %.4f of the sphere's\n",
                static_cast<unsigned long long>(mesh.n_global_cells),
                static_cast<unsigned long long>(dynamics.state.n_steps), impact.mass / sphere_mass(steel));
    return impact;
  }
} // namespace contact_impact


TREAD_TEST(contact_impact)(Check &check, const tests::Arguments &)
{
  const ElasticMaterial steel;
  const double          modulus = plane_modulus(steel), mass = sphere_mass(steel);
  const auto            known = reference::hertz_impact(mass, radius, modulus, 1.);
  check.relative("closed form at 1 m/s: duration (us)", 1e6 * known.duration, 52.24, 2e-4);
  check.relative("closed form at 1 m/s: largest force (N)", known.max_force, 2300.9, 2e-4);

  // Five cells across the largest contact radius. Hertz's half-space leaves out that the sphere is finite:
  // a share of the order of a/R, 0.01 here, and the strain, of the order of p0/E: 0.5 %. At 0.3 m/s the force
  // is 1.2 % larger.
  constexpr double speed = 0.03;
  const auto       hertz = reference::hertz_impact(mass, radius, modulus, speed);
  const double     h = hertz.contact_radius / 5., reach = 1.3 * hertz.contact_radius;
  const Impact     impact = run(speed, h, reach, 4.);
  check.relative("duration (us)", 1e6 * impact.duration, 1e6 * hertz.duration, .01);
  check.relative("largest force (N)", impact.force, hertz.max_force, .01);
  check.relative("largest approach (um)", 1e6 * impact.approach, 1e6 * hertz.max_approach, .01);
  // Stress waves cross the sphere ten times meanwhile: they take next to nothing (Hunter 1957).
  check.relative("restitution", impact.restitution, 1., 1e-3);
  check.below("energy residual over the kinetic energy", impact.energy_residual, 1e-3);
  check.that("contact stays inside the fine zone", impact.reach > 0. && impact.reach < reach - h);
  check.that("a speed wrong by 2 % is noticed",
             std::abs(impact.force / reference::hertz_impact(mass, radius, modulus, 1.02 * speed).max_force -
                      1.) > .01);
}
