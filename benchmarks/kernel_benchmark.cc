// SPDX-License-Identifier: LGPL-2.1-or-later
/// Internal forces alone: element updates per second and core over the number of cells, beside the
/// bandwidth of a triad of the same size in memory. Prints a table in Markdown.
/// Arguments: cells along the edge of the cubes, if not the usual ones.
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/solid/fully_integrated.h>
#include <tread/solid/one_point.h>

#include <deal.II/base/mpi.h>

#include <boxes.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

namespace
{
  double seconds()
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  /// Best of several repetitions of at least 0.2 s each.
  template <typename Work>
  double best_time(const Work &work)
  {
    double best = 1e300;
    for (unsigned int repetition = 0; repetition < 5; ++repetition)
      {
        unsigned int n     = 0;
        const double start = seconds();
        do
          {
            work();
            ++n;
          }
        while (seconds() - start < 0.2);
        best = std::min(best, (seconds() - start) / n);
      }
    return best;
  }

  /// a = b + s c on arrays that together have the given size; bytes a second, without write-allocate.
  double triad_bandwidth(const double bytes)
  {
    const std::size_t   n = bytes / 24.;
    std::vector<double> a(n, 1.), b(n, 2.), c(n, 3.);
    const double        time = best_time([&]() {
      for (std::size_t i = 0; i < n; ++i)
        a[i] = b[i] + 1.0000001 * c[i];
      asm volatile("" : : "r"(a.data()) : "memory");
    });
    return 24. * n / time;
  }
} // namespace


int main(int argc, char **argv)
{
  using namespace tread;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::printf("%u lanes of double precision, one core\n\n", n_lanes);
  std::printf("| element | shape | cells | updates per second | bytes a cell | stream, GB/s | triad, GB/s | "
              "share |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  std::vector<unsigned int> edges; // cells along an edge of the cube
  for (int i = 1; i < argc; ++i)
    edges.push_back(std::stoul(argv[i]));
  if (edges.empty())
    edges = {10, 20, 40, 59, 126};
  struct Kind
  {
    const char  *element, *shape;
    std::string  type;
    unsigned int most; ///< cells along an edge of the largest cube
  };
  for (const Kind &kind :
       {Kind{"one-point", "box", OnePoint::name, 126}, Kind{"one-point", "general", OnePoint::name, 126},
        Kind{"fully integrated", "general", FullyIntegrated::name, 59}})
    for (const unsigned int n : edges)
      {
        if (n > kind.most)
          continue;
        Body body = tests::make_box("box", dealii::Point<3>(), dealii::Point<3>(0.1, 0.1, 0.1), {{n, n, n}});
        if (kind.shape == std::string("general")) // no two alike
          for (dealii::Point<3> &p : body.vertices)
            {
              const double s[3] = {std::sin(1e4 * p[0]), std::sin(1e4 * p[1]), std::sin(1e4 * p[2])};
              p += 1e-2 * 0.1 / n * dealii::Point<3>(s[1] * s[2], s[2] * s[0], s[0] * s[1]);
            }
        const Mesh      mesh(MPI_COMM_SELF, {body});
        SolidParameters parameters;
        parameters.element = kind.type;
        const Solid      solid(mesh, {ElasticMaterial()}, parameters);
        ExplicitDynamics dynamics(mesh, solid, DynamicsParameters());
        NodalField       force(mesh.nodes.size(), Vector3{});
        const NodalField x = dynamics.state.positions();
        const double     time =
          best_time([&]() { solid.add_internal_forces(x.data(), dynamics.state.v.data(), force.data()); });
        const double cells = mesh.cells.size(), bytes = solid.memory_consumption() + 96. * mesh.nodes.size();
        const double triad = triad_bandwidth(bytes);
        std::printf("| %s | %s | %.0f | %.1f million | %.0f | %.1f | %.1f | %.0f %% |\n", kind.element,
                    kind.shape, cells, 1e-6 * cells / time, solid.memory_consumption() / cells,
                    1e-9 * bytes / time, 1e-9 * triad, 100. * bytes / time / triad);
      }
  return 0;
}
