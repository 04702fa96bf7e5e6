// SPDX-License-Identifier: LGPL-2.1-or-later
/// What cells that yield cost: a step's internal forces of a block with a quarter of its cells in a plastic
/// zone over those of the same block without, measured in turn. Prints a table in Markdown.
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include <boxes.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace
{
  double seconds()
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
} // namespace


int main(int argc, char **argv)
{
  using namespace tread;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::printf("%u lanes of double precision, one core, a quarter of the cells plastic\n\n", n_lanes);
  std::printf("| cells | hardening | state | elastic, ns a cell | with the zone | ratio "
              "|\n|---|---|---|---|---|---|\n");
  constexpr unsigned int n    = 32;
  constexpr double       edge = 0.032; // m
  const Mesh             mesh(MPI_COMM_SELF, {tests::make_box("box", dealii::Point<3>(),
                                                              dealii::Point<3>(edge, edge, edge), {{n, n, n}})});
  const auto             upper = [](const dealii::Point<3> &p) {
    return p[2] > 0.75 * edge;
  };
  const Solid    elastic(mesh, {ElasticMaterial()}, SolidParameters());
  PlasticHistory none;
  for (const bool kinematic : {false, true})
    {
      PlasticMaterial material;
      material.yield_stress = 500e6;
      if (kinematic)
        material.backstresses = {{60e9, 300.}};
      else
        material.isotropic_modulus = 23e9;
      const Solid    plastic(mesh, {ElasticMaterial()}, SolidParameters(), {{0, material, upper}});
      PlasticHistory history = plastic.virgin();
      for (const bool flows : {false, true})
        {
          NodalField x(mesh.nodes.size()), force(mesh.nodes.size(), Vector3{});
          double     best[2] = {1e300, 1e300}, strain = flows ? 5e-3 : 1e-4;
          for (unsigned int repetition = 0; repetition < 60; ++repetition)
            {
              // Every step stretches on, so that each cell yields each time.
              strain += flows ? 1e-4 : 0.;
              for (unsigned int i = 0; i < x.size(); ++i)
                x[i] = Vector3{(1. + strain) * mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2], 0.};
              for (const bool with_zone : {false, true})
                {
                  const double start = seconds();
                  if (with_zone)
                    plastic.update_internal_forces(x.data(), x.data(), force.data(), history);
                  else
                    elastic.update_internal_forces(x.data(), x.data(), force.data(), none);
                  best[with_zone] = std::min(best[with_zone], seconds() - start);
                }
            }
          const double cells = mesh.cells.size();
          std::printf("| %.0f | %s | %s | %.1f | %.1f | %.2f |\n", cells,
                      kinematic ? "Armstrong-Frederick" : "isotropic", flows ? "all yield" : "none yields",
                      1e9 * best[0] / cells, 1e9 * best[1] / cells, best[1] / best[0]);
        }
    }
  return 0;
}
