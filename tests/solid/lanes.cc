// SPDX-License-Identifier: LGPL-2.1-or-later
// Cells are computed n_lanes at a time: the position of a cell in a batch, its neighbours there and an
// incomplete last batch must not affect the forces.
#include <tread/solid/fully_integrated.h>
#include <tread/solid/one_point.h>
#include <tread/solid/solid.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"
#include "check.h"

#include <algorithm>
#include <limits>
#include <random>

using namespace tread;
using dealii::Point;

namespace solid_lanes
{
  /// n cells of random shape that share no nodes.
  Body make_loose_cells(const unsigned int n)
  {
    std::mt19937                     random(5);
    std::uniform_real_distribution<> offset(-1.5e-3, 1.5e-3);
    Body                             body;
    body.name = "loose cells";
    for (unsigned int c = 0; c < n; ++c)
      {
        dealii::CellData<3> cell;
        for (unsigned int v = 0; v < 8; ++v)
          {
            cell.vertices[v] = body.vertices.size();
            body.vertices.emplace_back(0.02 * c + 0.01 * (v & 1) + offset(random),
                                       0.01 * ((v >> 1) & 1) + offset(random),
                                       0.01 * ((v >> 2) & 1) + offset(random));
          }
        body.cells.push_back(cell);
      }
    body.wanted_cell_size = [](const Point<3> &) {
      return std::numeric_limits<double>::max();
    };
    body.boundary_at = [](const Point<3> &) {
      return Boundary::free;
    };
    return body;
  }

  struct Tested
  {
    const char *name;
    std::string type;
    double      viscosity;
  };

  SolidParameters parameters_of(const Tested &element)
  {
    SolidParameters parameters;
    parameters.element                  = element.type;
    parameters.linear_bulk_viscosity    = 0.06 * element.viscosity;
    parameters.quadratic_bulk_viscosity = 1.2 * element.viscosity;
    return parameters;
  }

  void random_motion(const Mesh &mesh, NodalField &x, NodalField &v)
  {
    std::mt19937                     random(7);
    std::uniform_real_distribution<> offset(-5e-4, 5e-4), speed(-10., 10.);
    x.resize(mesh.nodes.size());
    v.resize(mesh.nodes.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        x[i] = Vector3{mesh.nodes[i][0] + offset(random), mesh.nodes[i][1] + offset(random),
                       mesh.nodes[i][2] + offset(random), 0.};
        v[i] = Vector3{speed(random), speed(random), speed(random), 0.};
      }
  }

  NodalField forces(const Mesh                         &mesh,
                    const std::vector<ElasticMaterial> &materials,
                    const SolidParameters              &parameters,
                    const NodalField                   &x,
                    const NodalField                   &v)
  {
    const Solid solid(mesh, materials, parameters);
    NodalField  f(x.size(), Vector3{});
    solid.add_internal_forces(x.data(), v.data(), f.data());
    return f;
  }

  double difference(const NodalField &a, const NodalField &b)
  {
    double deviation = 0., largest = 0.;
    for (unsigned int i = 0; i < a.size(); ++i)
      for (unsigned int d = 0; d < 3; ++d)
        {
          deviation = std::max(deviation, std::abs(a[i][d] - b[i][d]));
          largest   = std::max(largest, std::abs(b[i][d]));
        }
    return deviation / largest;
  }
} // namespace solid_lanes


TREAD_TEST(solid_lanes)(tests::Check &check, const tests::Arguments &)
{
  std::printf("%u lanes\n", n_lanes);

  const std::vector<ElasticMaterial> steel(1);
  const Tested                       elements[3] = {{"one point", OnePoint::name, 0.},
                                                    {"one point, bulk viscosity", OnePoint::name, 1.},
                                                    {"fully integrated", FullyIntegrated::name, 0.}};
  for (const Tested &element : elements)
    {
      const SolidParameters parameters = parameters_of(element);
      const std::string     name       = std::string(element.name) + ": ";
      NodalField            x, v;

      // Cells that share nodes, in another order: the same sums in another order, so rounding of a few
      // times 1e-16 is allowed. 7^3 = 343 cells fill no batch size.
      Mesh block(MPI_COMM_SELF, {tests::make_box("block", Point<3>(), Point<3>(.07, .07, .07), {{7, 7, 7}})});
      random_motion(block, x, v);
      const NodalField expected = forces(block, steel, parameters, x, v);
      std::mt19937     random(11);
      double           deviation = 0.;
      for (unsigned int trial = 0; trial < 5; ++trial)
        {
          std::shuffle(block.cells.begin(), block.cells.end(), random);
          deviation = std::max(deviation, difference(forces(block, steel, parameters, x, v), expected));
        }
      check.below(name + "other order of cells", deviation, 1e-14);
      block.cells.pop_back();
      check.that(name + "a missing cell is noticed",
                 difference(forces(block, steel, parameters, x, v), expected) > 1e-14);

      // Every cell alone in its batch, then any number of them: no common nodes, hence the same bits.
      Mesh                          loose(MPI_COMM_SELF, {make_loose_cells(3 * n_lanes + 1)});
      const std::vector<Mesh::Cell> all_cells = loose.cells;
      random_motion(loose, x, v);
      NodalField alone(x.size(), Vector3{});
      for (const Mesh::Cell &cell : all_cells)
        {
          loose.cells        = {cell};
          const NodalField f = forces(loose, steel, parameters, x, v);
          for (unsigned int i = 0; i < f.size(); ++i)
            alone[i] += f[i];
        }
      double largest_deviation = 0.;
      for (unsigned int n = 1; n <= all_cells.size(); ++n)
        {
          loose.cells.assign(all_cells.begin(), all_cells.begin() + n);
          NodalField wanted(x.size(), Vector3{});
          for (const Mesh::Cell &cell : loose.cells)
            for (const unsigned int i : cell.nodes)
              wanted[i] = alone[i];
          largest_deviation =
            std::max(largest_deviation, difference(forces(loose, steel, parameters, x, v), wanted));
        }
      check.below(name + "1 to 3 batches and one cell", largest_deviation, 0.);

      // Two bodies of different material never share a batch, whatever the order of their cells.
      std::vector<ElasticMaterial> two(2);
      two[1].young_modulus = 70e9;
      two[1].density       = 2700.;
      loose.cells          = all_cells;
      NodalField wanted(x.size(), Vector3{});
      for (unsigned int c = 0; c < loose.cells.size(); ++c)
        loose.cells[c].body = (c / 3) % 2;
      const std::vector<Mesh::Cell> mixed = loose.cells;
      for (const Mesh::Cell &cell : mixed)
        {
          loose.cells        = {cell};
          const NodalField f = forces(loose, two, parameters, x, v);
          for (unsigned int i = 0; i < f.size(); ++i)
            wanted[i] += f[i];
        }
      loose.cells = mixed;
      check.below(name + "two materials", difference(forces(loose, two, parameters, x, v), wanted), 0.);

      // A cell gone wild must not reach the other lanes of its batch.
      NodalField         wild     = x;
      const unsigned int bad_cell = 1;
      loose.cells                 = all_cells;
      for (const unsigned int i : loose.cells[bad_cell].nodes)
        wild[i] = Vector3{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                          1e300, 0.};
      const NodalField f      = forces(loose, steel, parameters, wild, v);
      unsigned int     n_hurt = 0;
      for (unsigned int c = 0; c < loose.cells.size(); ++c)
        for (const unsigned int i : loose.cells[c].nodes)
          for (unsigned int d = 0; d < 3; ++d)
            if (c != bad_cell && !(f[i][d] == alone[i][d]))
              ++n_hurt;
      check.absolute(name + "components spoiled by another lane", n_hurt, 0., 0.);
    }
}
