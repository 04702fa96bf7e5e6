// SPDX-License-Identifier: LGPL-2.1-or-later
// Fields that go from one mesh to another, whose cells are fine elsewhere: linear fields stay as they are,
// nodes that both meshes have keep their values, new ones get the mean of those around them.
#include <tread/mesh/moved_fields.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"
#include "check.h"

#include <algorithm>
#include <cmath>
#include <map>

using namespace tread;
using dealii::Point;

namespace mesh_moved_fields
{
  constexpr double length = 0.16, size = 0.02; // of the coarse cells, m

  /// A bar whose cells are an eighth of the coarse ones where x is near the middle, and a curved one whose
  /// nodes leave their chords.
  Body bar(const double middle, const bool is_curved)
  {
    Body body = tests::make_box("bar", Point<3>(), Point<3>(length, 2. * size, size), {{8, 2, 1}});
    body.wanted_cell_size = [middle](const Point<3> &p) {
      const double off = std::abs(p[0] - middle);
      return off < 0.02 ? size / 8. : off < 0.04 ? size / 2. : size;
    };
    if (is_curved)
      body.to_space = [](const Point<3> &p) {
        return Point<3>(p[0], p[1], p[2] - 5. * p[1] * p[1]);
      };
    return body;
  }

  template <typename Function>
  NodalField field_of(const Mesh &mesh, const Function &of)
  {
    NodalField field;
    for (const Point<3> &p : mesh.nodes)
      field.push_back(of(p));
    mesh.distribute_hanging_nodes(field.data());
    return field;
  }

  Vector3 linear(const Point<3> &p)
  {
    return Vector3{1. + 3. * p[0] - 7. * p[1] + 2. * p[2], 5. * p[0] + p[1], -4. * p[2] + p[0], 0.};
  }

  /// Nothing smooth: each node has a number of its own.
  Vector3 rough(const Point<3> &p)
  {
    return Vector3{std::sin(1e5 * p[0] + 3e4 * p[1] + 7e3 * p[2]), std::cos(9e4 * p[2] + 4e3 * p[0]), p[1],
                   0.};
  }

  double difference(const NodalField &found, const NodalField &expected)
  {
    double largest = 0.;
    for (unsigned int i = 0; i < found.size(); ++i)
      largest = std::max(largest, norm(found[i] - expected[i]));
    return largest;
  }

  double largest(const double value)
  {
    return dealii::Utilities::MPI::max(value, MPI_COMM_WORLD);
  }
} // namespace mesh_moved_fields


TREAD_TEST(mesh_moved_fields)(tests::Check &check, const tests::Arguments &)
{
  // The first in parts and the second as a whole on each rank, where the middle costs three times as much.
  const auto cost = [](const unsigned int, const std::array<Point<3>, 8> &corners, const unsigned int) {
    return std::abs(corners[0][0] - 0.10) < 0.02 ? 3. : 1.;
  };
  const Mesh from(MPI_COMM_WORLD, {bar(0.05, false)}), to(MPI_COMM_WORLD, {bar(0.10, false)}, 0, cost, true);
  const Mesh in_parts(MPI_COMM_WORLD, {bar(0.10, false)});
  check.that("made as a whole there are as many cells and nodes as in parts",
             to.n_global_cells == in_parts.n_global_cells && to.n_global_nodes == in_parts.n_global_nodes &&
               to.n_global_hanging_nodes == in_parts.n_global_hanging_nodes);
  double of_rank = 0.;
  for (unsigned int c = 0; c < to.cells.size(); ++c)
    of_rank += cost(0, to.corners(c), 0);
  const auto costs = dealii::Utilities::MPI::min_max_avg(of_rank, MPI_COMM_WORLD);
  check.below("dearest rank over the mean", costs.max / costs.avg, 1.1);
  check.absolute("cells of all ranks", dealii::Utilities::MPI::sum(double(to.cells.size()), MPI_COMM_WORLD),
                 to.n_global_cells, 0.);
  check.that("cells are fine elsewhere", from.n_global_hanging_nodes > 0 && to.n_global_hanging_nodes > 0);
  const NodalField before_linear = field_of(from, linear), before_rough = field_of(from, rough);
  const auto       moved = moved_fields(from, {&before_linear, &before_rough}, to);
  check.that("as many fields, and as many rows", moved.size() == 2 && moved[1].size() == to.nodes.size());
  check.below("a linear field, largest difference", largest(difference(moved[0], field_of(to, linear))),
              1e-12);

  // Nodes that hang in neither mesh and are in both; places in units of a sixteenth of a coarse cell.
  const auto key_of = [](const Point<3> &p) {
    return std::array<long, 3>{
      {std::lround(p[0] / size * 16), std::lround(p[1] / size * 16), std::lround(p[2] / size * 16)}};
  };
  double       kept = 0., middles = 0.;
  unsigned int n_kept = 0, n_middles = 0;
  {
    // All ranks know all of the mesh before on one rank alone.
    const Mesh                             whole(MPI_COMM_SELF, {bar(0.05, false)});
    const NodalField                       values = field_of(whole, rough);
    std::map<std::array<long, 3>, Vector3> by_place;
    for (unsigned int i = 0; i < whole.nodes.size(); ++i)
      by_place[key_of(whole.nodes[i])] = values[i];
    for (unsigned int i = 0; i < to.nodes.size(); ++i)
      {
        const auto key = key_of(to.nodes[i]);
        if (const auto found = by_place.find(key); found != by_place.end())
          {
            kept = std::max(kept, norm(moved[1][i] - found->second));
            ++n_kept;
          }
        else if (key[0] % 16 == 8 && key[1] % 16 == 0 && key[2] % 16 == 0)
          {
            auto low = key, high = key;
            low[0] -= 8;
            high[0] += 8;
            if (by_place.count(low) && by_place.count(high))
              {
                middles = std::max(middles, norm(moved[1][i] - 0.5 * (by_place[low] + by_place[high])));
                ++n_middles;
              }
          }
      }
  }
  check.that("there are nodes of both kinds", largest(n_kept) > 20 && largest(n_middles) > 0);
  check.below("nodes of both meshes keep their values, largest difference", largest(kept), 1e-14);
  check.below("new nodes in the middle of an edge, largest difference from the mean", largest(middles),
              1e-14);

  // Forth and back to a mesh that is fine in both places nothing is lost, curved or not.
  Body both             = bar(0.05, true);
  both.wanted_cell_size = [](const Point<3> &) {
    return size / 8.;
  };
  const Mesh       curved(MPI_COMM_WORLD, {bar(0.05, true)}), finest(MPI_COMM_WORLD, {both});
  const NodalField here  = field_of(curved, rough);
  const auto       there = moved_fields(curved, {&here}, finest);
  check.below("to finer cells and back, largest difference",
              largest(difference(moved_fields(finest, {&there[0]}, curved)[0], here)), 1e-14);

  // Other coarse cells are noticed.
  Body other   = tests::make_box("bar", Point<3>(), Point<3>(length, 2. * size, size), {{9, 2, 1}});
  bool noticed = false;
  try
    {
      moved_fields(from, {&before_rough}, Mesh(MPI_COMM_WORLD, {other}));
    }
  catch (const std::logic_error &)
    {
      noticed = true;
    }
  check.that("a mesh of more coarse cells is refused", noticed);
}
