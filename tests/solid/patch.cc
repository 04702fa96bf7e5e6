// SPDX-License-Identifier: LGPL-2.1-or-later
// Patch test: on distorted cells, with and without hanging nodes, a linear displacement field must give the
// exact uniform stress and no force on inner nodes (Irons & Razzaque 1972).
#include <tread/solid/fully_integrated.h>
#include <tread/solid/one_point.h>
#include <tread/solid/solid.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include "check.h"
#include "fields.h"

#include <algorithm>

using namespace tread;
using dealii::Point;
using dealii::Tensor;

namespace solid_patch
{
  constexpr double edge = 0.1; // m

  Tensor<2, 3> identity()
  {
    Tensor<2, 3> I;
    for (unsigned int d = 0; d < 3; ++d)
      I[d][d] = 1.;
    return I;
  }

  /// Cauchy stress of HenckyPoint's law under the deformation gradient F, in full tensors.
  Tensor<2, 3> exact_stress(const ElasticMaterial &material, const Tensor<2, 3> &F)
  {
    const Tensor<2, 3> E      = 0.5 * (transpose(F) * F - identity());
    const Tensor<2, 3> square = E * E;
    const Tensor<2, 3> S      = material.lame() * (trace(E) - trace(square)) * identity() +
                           (2. * material.shear_modulus() - 2. * material.lame() * trace(E)) * E -
                           6. * material.shear_modulus() * square;
    return F * S * transpose(F) / determinant(F);
  }

  struct PatchErrors
  {
    double stress = 0.; ///< largest deviation over the largest component
    double force  = 0.; ///< largest force on an inner node over the largest on any node
  };

  PatchErrors patch_errors(const Mesh            &mesh,
                           const Solid           &solid,
                           const ElasticMaterial &material,
                           const Tensor<2, 3>    &F,
                           const double           perturbation)
  {
    using dealii::Utilities::MPI::max;
    const std::vector<char> hanging = tests::which_hang(mesh);

    // The inner node to be perturbed is found by its place, so that every rank that holds it moves it.
    double nearest = -1e300;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (!hanging[i])
        nearest = std::max(nearest, -mesh.nodes[i].distance(Point<3>(.4 * edge, .3 * edge, .3 * edge)));
    nearest = -max(nearest, mesh.comm);

    NodalField x(mesh.nodes.size()), force(mesh.nodes.size(), Vector3{});
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      {
        // Hanging nodes start at a wrong place: only distribute_hanging_nodes() can put them right.
        const Tensor<1, 3> p = hanging[i] ? Tensor<1, 3>() : F * Tensor<1, 3>(mesh.nodes[i]);
        x[i]                 = Vector3{p[0] + 0.3, p[1] - 0.2, p[2] + 0.1, 0.};
        if (!hanging[i] && mesh.nodes[i].distance(Point<3>(.4 * edge, .3 * edge, .3 * edge)) < nearest + 1e-9)
          x[i][0] += perturbation;
      }
    mesh.distribute_hanging_nodes(x.data());
    solid.add_internal_forces(x.data(), x.data(), force.data());
    mesh.condense_hanging_nodes(force.data());
    mesh.shared_nodes.sum(force.data());

    const Tensor<2, 3>            exact          = exact_stress(material, F);
    static constexpr unsigned int ij[6][2]       = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    double                        largest_stress = 0., largest_force = 0., inner_force = 0., deviation = 0.;
    for (const auto &stress : solid.cauchy_stress(x.data()))
      for (unsigned int k = 0; k < 6; ++k)
        {
          largest_stress = std::max(largest_stress, std::abs(exact[ij[k][0]][ij[k][1]]));
          deviation      = std::max(deviation, std::abs(stress[k] - exact[ij[k][0]][ij[k][1]]));
        }
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      {
        const double f     = std::sqrt(dot(force[i], force[i]));
        bool         inner = true;
        for (unsigned int d = 0; d < 3; ++d)
          inner = inner && mesh.nodes[i][d] > 1e-6 * edge && mesh.nodes[i][d] < (1. - 1e-6) * edge;
        largest_force = std::max(largest_force, f);
        if (inner)
          inner_force = std::max(inner_force, f);
      }
    PatchErrors errors;
    errors.stress = max(deviation, mesh.comm) / max(largest_stress, mesh.comm);
    errors.force  = max(inner_force, mesh.comm) / max(largest_force, mesh.comm);
    return errors;
  }

  /// A column of steel and, above, of something soft, of two bodies the second; pulled so that both have the
  /// same stress. Without Poisson's ratio nothing bulges.
  void two_materials_in_a_body(tests::Check &check, const bool refined)
  {
    using dealii::Utilities::MPI::max;
    using dealii::Utilities::MPI::sum;
    const std::string     name = refined ? "two materials, refined: " : "two materials: ";
    constexpr double      h = 0.04, width = 0.04, strain = 1e-8; // m, m, of the steel
    const ElasticMaterial steel{210e9, 0., 7800.}, soft{3e9, 0., 1900.};
    const auto            box = [](const char *name, const double x) {
      return tests::make_box(name, Point<3>(x, 0., 0.), Point<3>(x + width, width, 2. * h), {{2, 2, 4}});
    };
    Body column = box("column", 0.1);
    for (std::size_t c = column.cells.size() / 2; c < column.cells.size(); ++c)
      column.cells[c].material_id = 1;
    if (refined)
      tests::refine_near(column, Point<3>(0.1, 0., h), 0.2 * h, 0.2 * h);
    const Mesh mesh(MPI_COMM_WORLD, {box("other", 0.), column});
    for (const std::string type : {OnePoint::name, FullyIntegrated::name})
      {
        SolidParameters parameters;
        parameters.element = type;
        const Solid solid(mesh, {steel, steel, soft}, parameters);
        NodalField  x(mesh.nodes.size()), force(mesh.nodes.size(), Vector3{});
        for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
          {
            const Point<3> &p    = mesh.nodes[i];
            const double    pull = strain * (std::min(p[2], h) +
                                          std::max(0., p[2] - h) * steel.young_modulus / soft.young_modulus);
            x[i]                 = Vector3{p[0], p[1], p[2] + (p[0] < 0.09 ? 0. : pull), 0.};
          }
        solid.add_internal_forces(x.data(), x.data(), force.data());
        mesh.condense_hanging_nodes(force.data());
        mesh.shared_nodes.sum(force.data());
        double inner = 0., at_top = 0., mass = 0.;
        for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
          if (const double z = mesh.nodes[i][2]; z > 1e-6 && z < 2. * h - 1e-6)
            inner = std::max(inner, std::sqrt(dot(force[i], force[i])));
          else if (z > h && mesh.shared_nodes.is_owned(i))
            at_top += force[i][2];
        for (const auto &of_cell : solid.cell_masses(mesh))
          for (const double of_node : of_cell)
            mass += of_node;
        if (!refined)
          {
            // Cells are alike but for their material.
            double highest[2] = {0., 0.};
            for (unsigned int c = 0; c < mesh.cells.size(); ++c)
              {
                double &own = highest[mesh.cells[c].has_own_material() ? 0 : 1];
                own         = std::max(own, solid.cell_frequencies()[c]);
              }
            check.relative(name + type + ": highest frequency of the soft cells over that of steel",
                           max(highest[1], mesh.comm) / max(highest[0], mesh.comm),
                           std::sqrt(soft.young_modulus / soft.density * steel.density / steel.young_modulus),
                           1e-6);
          }
        const double pulled = strain * steel.young_modulus * width * width;
        check.relative(name + type + ": force on its top, N", sum(at_top, mesh.comm), -pulled, 1e-5);
        check.below(name + type + ": force within over that", max(inner, mesh.comm) / pulled, 1e-5);
        check.relative(name + type + ": mass, kg", sum(mass, mesh.comm),
                       width * width * h * (3. * steel.density + soft.density), 1e-12);
      }
    PlasticMaterial plastic;
    plastic.yield_stress = 1e6;
    const Solid  yielding(mesh, {steel, steel, soft}, SolidParameters(), {{1, plastic, [](const Point<3> &) {
                                                                            return true;
                                                                          }}});
    unsigned int wrong = 0, n = 0;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        const Point<3> centre = centre_of(mesh.corners(c));
        const bool     may    = centre[0] > 0.09 && centre[2] < h;
        n += may;
        wrong += yielding.plastic().contains(c) != may;
      }
    check.absolute(name + "cells that yield or do not against their material", sum(wrong, mesh.comm), 0., 0.);
    check.that(name + "some yield", sum(n, mesh.comm) > 0);
  }

  /// Bricks that are bent and twisted: the mean gradient of the one-point element is that of the centre,
  /// where fully integrated cells have their stress as well.
  void stress_at_the_centre(tests::Check &check, const ElasticMaterial &material)
  {
    const Mesh mesh(MPI_COMM_WORLD,
                    {tests::make_box("bricks", Point<3>(), Point<3>(.1, .04, .03), {{4, 2, 3}})});
    NodalField x = tests::reference_positions(mesh);
    for (Vector3 &p : x)
      p += Vector3{-2. * p[0] * p[2], .5 * p[0] * p[2], p[0] * p[0] + p[1] * p[2], 0.};
    SolidParameters parameters;
    parameters.element = FullyIntegrated::name;
    const auto found   = Solid(mesh, {material}, parameters).cauchy_stress(x.data()),
               mean    = Solid(mesh, {material}, SolidParameters()).cauchy_stress(x.data());
    check.below("bent bricks: stress of fully integrated cells beside one point",
                tests::difference(found, mean), 1e-10);
  }
} // namespace solid_patch


TREAD_TEST(solid_patch)(tests::Check &check, const tests::Arguments &)
{
  // Small strains with a rigid turn in them, and a deformation that no linear theory would get right.
  Tensor<2, 3> small = identity(), large = identity();
  const double g[3][3] = {{1.1, -.4, .7}, {.2, -.9, .5}, {-.6, .3, .8}};
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      {
        small[i][j] += 1e-3 * g[i][j];
        large[i][j] += 0.3 * g[i][j];
      }

  const ElasticMaterial material;
  stress_at_the_centre(check, material);
  two_materials_in_a_body(check, false);
  two_materials_in_a_body(check, true);
  for (const bool refined : {false, true})
    {
      Body body = tests::make_patch_cube(edge);
      if (refined)
        tests::refine_near(body, Point<3>(edge, edge, edge), 0.2 * edge, 0.2 * edge);
      const Mesh mesh(MPI_COMM_WORLD, {body});
      std::printf("%u cells, %u hanging nodes\n", unsigned(mesh.n_global_cells),
                  unsigned(mesh.n_global_hanging_nodes));
      check.that(refined ? "mesh has hanging nodes" : "mesh has no hanging nodes",
                 (mesh.n_global_hanging_nodes > 0) == refined);
      for (const std::string type : {OnePoint::name, FullyIntegrated::name})
        {
          SolidParameters parameters;
          parameters.element = type;
          const Solid       solid(mesh, {material}, parameters);
          const std::string name = std::string(type == OnePoint::name ? "one point" : "fully integrated") +
                                   (refined ? ", hanging nodes" : ", 7 cells");
          // Positions of about 0.3 m carry rounding of 3e-17 m; over cells of 0.01 m and strains of 1e-3 that
          // is 1e-11 at worst.
          for (const bool is_large : {false, true})
            {
              const PatchErrors errors = patch_errors(mesh, solid, material, is_large ? large : small, 0.);
              const std::string what   = name + (is_large ? ", large: " : ", small: ");
              check.below(what + "stress", errors.stress, 1e-10);
              check.below(what + "inner force", errors.force, 1e-10);
            }
          // The same comparison must notice a node that is 1e-8 of the edge off.
          const PatchErrors off = patch_errors(mesh, solid, material, small, 1e-8 * edge);
          std::printf("node moved by 1e-8 of the edge: stress %.1e, inner force %.1e\n", off.stress,
                      off.force);
          check.that(name + ": a moved node is noticed", off.stress > 1e-8 && off.force > 1e-8);
        }
    }
}
