// SPDX-License-Identifier: LGPL-2.1-or-later
// A wheel rotates through any angle: rigid motion must store no energy, and a deformed state must keep its
// energy and forces when it rotates.
#include <tread/solid/fully_integrated.h>
#include <tread/solid/one_point.h>
#include <tread/solid/solid.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include "check.h"
#include "fields.h"

#include <algorithm>
#include <random>

using namespace tread;
using dealii::Point;
using tests::largest;
using tests::turned;

namespace solid_rotation
{
  NodalField forces(const Mesh &mesh, const Solid &solid, const NodalField &x)
  {
    NodalField f(x.size(), Vector3{});
    solid.add_internal_forces(x.data(), x.data(), f.data());
    mesh.condense_hanging_nodes(f.data());
    return f;
  }
} // namespace solid_rotation


TREAD_TEST(solid_rotation)(tests::Check &check, const tests::Arguments &)
{
  constexpr double      edge = 0.1; // m
  const ElasticMaterial material;
  Body                  body = tests::make_patch_cube(edge);
  tests::refine_near(body, Point<3>(edge, edge, edge), 0.2 * edge, 0.2 * edge);
  const Mesh       mesh(MPI_COMM_WORLD, {body});
  const NodalField reference = tests::reference_positions(mesh);

  NodalField                       deformed = reference;
  std::mt19937                     random(1);
  std::uniform_real_distribution<> offset(-0.02 * edge, 0.02 * edge);
  for (Vector3 &row : deformed)
    row += Vector3{offset(random), offset(random), offset(random), 0.};
  mesh.distribute_hanging_nodes(deformed.data());

  for (const std::string type : {OnePoint::name, FullyIntegrated::name})
    {
      SolidParameters parameters;
      parameters.element = type;
      const Solid       solid(mesh, {material}, parameters);
      const std::string name         = type == OnePoint::name ? "one point: " : "fully integrated: ";
      const double      energy_scale = material.young_modulus * edge * edge * edge; // J, that of strain 1
      const double      force_scale  = material.young_modulus * edge * edge;        // N

      const StrainEnergy energy_0     = solid.strain_energy(deformed.data());
      const NodalField   force_0      = forces(mesh, solid, deformed);
      double             rigid_energy = 0., rigid_force = 0., energy_change = 0., force_change = 0.,
             direction_change = 0.;
      for (unsigned int degrees = 0; degrees <= 360; degrees += 15)
        {
          const double       angle = degrees * dealii::numbers::PI / 180.;
          const NodalField   rigid = turned(reference, angle, Vector3{30., -20., 10., 0.});
          const StrainEnergy e     = solid.strain_energy(rigid.data());
          rigid_energy             = std::max(rigid_energy, (e.strain + e.hourglass) / energy_scale);
          rigid_force              = std::max(rigid_force, largest(forces(mesh, solid, rigid)) / force_scale);

          const NodalField   x      = turned(deformed, angle);
          const StrainEnergy energy = solid.strain_energy(x.data());
          energy_change =
            std::max({energy_change, std::abs(energy.strain / energy_0.strain - 1.),
                      energy_0.hourglass > 0. ? std::abs(energy.hourglass / energy_0.hourglass - 1.) : 0.});
          const NodalField f        = forces(mesh, solid, x);
          const NodalField expected = turned(force_0, angle);
          const double     scale    = largest(force_0);
          for (unsigned int i = 0; i < f.size(); ++i)
            {
              force_change = std::max(
                force_change,
                std::abs(std::sqrt(dot(f[i], f[i])) - std::sqrt(dot(force_0[i], force_0[i]))) / scale);
              const Vector3 d  = f[i] - expected[i];
              direction_change = std::max(direction_change, std::sqrt(dot(d, d)) / scale);
            }
        }
      // 37 m away rounding moves a node by 4e-15 m, which is a strain of 4e-13 in cells of 0.01 m: energy
      // 1e-25, force 1e-13 times the share of a face in edge^2. A linear strain measure would give 1.
      check.below(name + "rigid motion, energy/(E V)", rigid_energy, 1e-20);
      check.below(name + "rigid motion, force/(E edge^2)", rigid_force, 1e-12);
      // Strains of some 10 %: rounding of positions (1e-17 m) over cells of 0.01 m is 1e-14 of them.
      check.below(name + "deformed and turned, energy", energy_change, 1e-12);
      check.below(name + "deformed and turned, |force|", force_change, 1e-12);
      check.below(name + "deformed and turned, force turns with it", direction_change, 1e-12);

      // The comparison must notice a stretch of 1e-9 that comes with the rotation.
      NodalField stretched = turned(reference, 1., Vector3{30., -20., 10., 0.});
      for (Vector3 &row : stretched)
        row[0] *= 1. + 1e-9;
      const StrainEnergy e = solid.strain_energy(stretched.data());
      std::printf("stretched by 1e-9: energy/(E V) %.1e\n", (e.strain + e.hourglass) / energy_scale);
      check.that(name + "a stretch of 1e-9 is noticed", (e.strain + e.hourglass) / energy_scale > 1e-20);
    }
}
