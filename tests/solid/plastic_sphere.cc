// SPDX-License-Identifier: LGPL-2.1-or-later
// Thick-walled sphere under inner pressure, perfectly plastic (Hill 1950, chapter V): the plastic front, the
// displacement of the outer surface, and the residual stress after unloading.
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/parts/nodes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include "boxes.h"
#include "check.h"

#include <cmath>
#include <map>

using namespace tread;
using dealii::Point;

namespace plastic_sphere
{
  constexpr double inner = 0.05, outer = 0.10; // m
  constexpr double yield = 500e6;              // Pa

  /// Six blocks between two spheres, n cells along each edge and across the wall.
  Body make_sphere(const unsigned int n, const unsigned int n_radial)
  {
    Body body = tests::make_box("sphere", Point<3>(-1., -1., 0.), Point<3>(1., 1., 1.), {{n, n, n_radial}},
                                {{tests::Side::bottom, Boundary::support}});
    const auto block_vertices = body.vertices;
    const auto block_cells    = body.cells;
    body.vertices.clear();
    body.cells.clear();
    std::map<std::array<long long, 3>, unsigned int> number;
    for (unsigned int block = 0; block < 6; ++block)
      {
        std::vector<unsigned int> name;
        for (const Point<3> &p : block_vertices)
          {
            // Equal angles along the edges of the cube.
            const double u            = std::tan(0.25 * dealii::numbers::PI * p[0]),
                         v            = std::tan(0.25 * dealii::numbers::PI * p[1]);
            const double         sign = block % 2 ? -1. : 1.;
            dealii::Tensor<1, 3> direction;
            direction[block / 2]           = sign;
            direction[(block / 2 + 1) % 3] = sign * u;
            direction[(block / 2 + 2) % 3] = v;
            const double   radius          = inner * std::pow(outer / inner, p[2]);
            const Point<3> q(radius / direction.norm() * direction);
            const auto     key = std::array<long long, 3>{
                  {std::llround(1e9 * q[0]), std::llround(1e9 * q[1]), std::llround(1e9 * q[2])}};
            const auto entry = number.emplace(key, body.vertices.size());
            if (entry.second)
              body.vertices.push_back(q);
            name.push_back(entry.first->second);
          }
        for (dealii::CellData<3> cell : block_cells)
          {
            for (unsigned int &v : cell.vertices)
              v = name[v];
            body.cells.push_back(cell);
          }
      }
    body.boundary_at = [](const Point<3> &p) {
      return p.norm() < 0.5 * (inner + outer) ? Boundary::support : Boundary::free;
    };
    return body;
  }

  struct Shell
  {
    Mesh             mesh;
    Solid            solid;
    ExplicitDynamics dynamics;
    NodeLoads       &loads = dynamics.add<NodeLoads>();
    NodalField       unit; ///< nodal forces of a unit pressure on the inner surface

    Shell(const unsigned int n, const unsigned int n_radial)
      : mesh(MPI_COMM_SELF, {make_sphere(n, n_radial)})
      , solid(mesh,
              {ElasticMaterial()},
              SolidParameters(),
              {{0,
                {yield, 0., {}},
                [](const Point<3> &) {
                  return true;
                }}})
      , dynamics(mesh, solid, still())
      , unit(mesh.nodes.size(), Vector3{})
    {
      for (const Mesh::Face &face : mesh.faces)
        if (face.boundary == Boundary::support)
          {
            const auto                &p = mesh.nodes;
            const dealii::Tensor<1, 3> area =
              0.5 * dealii::cross_product_3d(p[face.nodes[2]] - p[face.nodes[0]],
                                             p[face.nodes[3]] - p[face.nodes[1]]);
            for (const unsigned int i : face.nodes)
              unit[i] += 0.25 * Vector3{-area[0], -area[1], -area[2], 0.};
          }

      // Flat faces have less area than the sphere: the load is that of the sphere.
      double total = 0.;
      for (unsigned int i = 0; i < unit.size(); ++i)
        total +=
          (unit[i][0] * mesh.nodes[i][0] + unit[i][1] * mesh.nodes[i][1] + unit[i][2] * mesh.nodes[i][2]) /
          mesh.nodes[i].norm();
      for (Vector3 &f : unit)
        f *= 4. * dealii::numbers::PI * inner * inner / total;
    }

    static DynamicsParameters still()
    {
      DynamicsParameters parameters;
      parameters.gravity = 0.;
      return parameters;
    }

    void load(const double pressure)
    {
      loads.force = unit;
      for (Vector3 &f : loads.force)
        f *= pressure;
      dynamics.relax(1e-5, 20000, nullptr);
    }

    /// Mean radial displacement of the outer surface, m.
    double outer_displacement() const
    {
      double       sum = 0.;
      unsigned int n   = 0;
      for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
        if (mesh.nodes[i].norm() > outer - 1e-6)
          {
            sum += std::sqrt(dot(dynamics.state.position(i), dynamics.state.position(i))) - outer;
            ++n;
          }
      return sum / n;
    }
  };
} // namespace plastic_sphere


TREAD_TEST(plastic_sphere)(tests::Check &check, const tests::Arguments &)
{
  const ElasticMaterial steel;
  const double          E = steel.young_modulus, nu = steel.poisson_ratio, a3 = std::pow(inner, 3),
               b3 = std::pow(outer, 3);

  // Pressure with the plastic front at c (Hill 1950, eq. V.10), and what it does outside.
  const auto pressure_at = [&](const double c) {
    return 2. * yield * std::log(c / inner) + 2. / 3. * yield * (1. - c * c * c / b3);
  };
  const double first = pressure_at(inner), limit = pressure_at(outer);
  std::printf("first yield at %.1f MPa, all plastic at %.1f MPa\n", 1e-6 * first, 1e-6 * limit);
  {
    Shell shell(8, 12);
    shell.load(0.99 * first);
    const std::vector<double> before =
      shell.solid.plastic().equivalent_plastic_strain(shell.dynamics.state.history);
    double largest = 0.;
    for (const double p : before)
      largest = std::max(largest, p);
    check.below("plastic strain just below first yield", largest, 0.);
  }
  for (const unsigned int n_radial : {8u, 16u})
    {
      Shell             shell(n_radial == 8 ? 8 : 12, n_radial);
      const std::string name = std::to_string(n_radial) + " cells across: ";
      for (const double c : {0.06, 0.07, 0.08})
        {
          shell.load(pressure_at(c));
          const std::string at = name + "front at " + std::to_string(int(1e3 * c + 0.5)) + " mm, ";
          check.relative(at + "u(outer), um", 1e6 * shell.outer_displacement(),
                         1e6 * yield * std::pow(c, 3) * (1. - nu) / (E * outer * outer),
                         n_radial == 8 ? 0.03 : 0.015);
          // The front lies between the cells that yielded and those that did not.
          const std::vector<double> strain =
            shell.solid.plastic().equivalent_plastic_strain(shell.dynamics.state.history);
          const auto masses         = shell.solid.cell_masses(shell.mesh);
          double     plastic_volume = 0.;
          for (unsigned int cell = 0; cell < shell.mesh.cells.size(); ++cell)
            if (strain[cell] > 0.)
              for (const double mass : masses[cell])
                plastic_volume += mass / steel.density;
          const double front = std::cbrt(a3 + 0.75 / dealii::numbers::PI * plastic_volume);
          check.absolute(at + "front, cells", std::log(front / c) / std::log(outer / inner) * n_radial, 0.,
                         0.8);
        }
      // Unloading from c = 80 mm is elastic: hoop minus radial stress was Y inside the front and loses that
      // of the elastic wall (Lame).
      const double p = pressure_at(0.08);
      shell.load(0.);
      const auto stress =
        shell.solid.cauchy_stress(shell.dynamics.state.positions().data(), shell.dynamics.state.history);
      double error = 0., scale = 0.;
      for (unsigned int cell = 0; cell < shell.mesh.cells.size(); ++cell)
        {
          Point<3> q;
          for (const unsigned int i : shell.mesh.cells[cell].nodes)
            q += shell.mesh.nodes[i] / 8.;
          const double r = q.norm(), r3 = r * r * r;
          if (r > 0.078)
            continue; // inside the front
          const Point<3> e(q / r);
          const auto    &s      = stress[cell];
          const double   radial = s[0] * e[0] * e[0] + s[1] * e[1] * e[1] + s[2] * e[2] * e[2] +
                                2. * (s[3] * e[0] * e[1] + s[4] * e[1] * e[2] + s[5] * e[2] * e[0]);
          const double hoop     = 0.5 * (s[0] + s[1] + s[2] - radial);
          const double expected = yield - 1.5 * p * a3 / (b3 - a3) * b3 / r3; // hoop minus radial stress
          error += std::pow(hoop - radial - expected, 2);
          scale += std::pow(expected, 2);
        }
      check.below(name + "residual hoop minus radial stress, RMS share", std::sqrt(error / scale),
                  n_radial == 8 ? 0.10 : 0.05);
    }
}
