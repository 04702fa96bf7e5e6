// SPDX-License-Identifier: LGPL-2.1-or-later
// Taylor's impact test: a copper bar against a rigid wall without friction (Wilkins & Guinan 1973): length
// 32.4 mm, radius 3.2 mm, 227 m/s, 80 us. Published for perfect slip and this material: length 21.3 to 21.7
// mm, radius of the foot 7.0 to 7.2 mm, largest plastic strain 2.5 to 3.3 (Kamoulakos 1990; Zhu & Cescotto
// 1995; Camacho & Ortiz 1997).
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include "boxes.h"
#include "check.h"

#include <cmath>
#include <cstdio>
#include <map>

using namespace tread;
using dealii::Point;

namespace plastic_taylor
{
  constexpr double length = 32.4e-3, radius = 3.2e-3; // m

  /// A cylinder on z = 0: a square core of n cells across and four blocks of n/2 cells around it.
  Body make_bar(const unsigned int n, const unsigned int n_along)
  {
    Body body = tests::make_box("bar", Point<3>(), Point<3>(1., 1., 1.), {{1, 1, 1}},
                                {{tests::Side::bottom, Boundary::contact}});
    body.vertices.clear();
    body.cells.clear();
    std::map<std::array<long long, 3>, unsigned int> number;
    const double       core = 0.52 * radius, quarter = 0.25 * dealii::numbers::PI;
    const unsigned int n_ring = n / 2;
    for (unsigned int block = 0; block < 5; ++block)
      {
        // Block 0 is the core; the others go outwards in t from its sides.
        const auto place = [&](const double u, const double t) {
          if (block == 0)
            return Point<2>(core * u, core * (2. * t - 1.));
          const double x = (1. - t) * core + t * radius * std::cos(quarter * u),
                       y = -(1. - t) * core * u - t * radius * std::sin(quarter * u); // right-handed with t
          return block == 1   ? Point<2>(x, y)
                 : block == 2 ? Point<2>(-y, x)
                 : block == 3 ? Point<2>(-x, -y)
                              : Point<2>(y, -x);
        };
        const unsigned int n_t  = block == 0 ? n : n_ring;
        const auto         name = [&](const unsigned int i, const unsigned int j, const unsigned int k) {
          const Point<2> q = place(2. * i / n - 1., double(j) / n_t);
          const Point<3> p(q[0], q[1], length * k / n_along);
          const auto     entry =
            number.emplace(std::array<long long, 3>{{std::llround(1e9 * p[0]), std::llround(1e9 * p[1]),
                                                     std::llround(1e9 * p[2])}},
                                   body.vertices.size());
          if (entry.second)
            body.vertices.push_back(p);
          return entry.first->second;
        };
        for (unsigned int k = 0; k < n_along; ++k)
          for (unsigned int j = 0; j < n_t; ++j)
            for (unsigned int i = 0; i < n; ++i)
              {
                dealii::CellData<3> cell;
                for (unsigned int v = 0; v < 8; ++v)
                  cell.vertices[v] = name(i + (v & 1), j + ((v >> 1) & 1), k + ((v >> 2) & 1));
                body.cells.push_back(cell);
              }
      }
    body.boundary_at = [](const Point<3> &p) {
      return p[2] < 1e-6 ? Boundary::contact : Boundary::free;
    };
    return body;
  }

  struct Result
  {
    double       length, foot, residual, plastic_share, largest_strain;
    unsigned int n_cells;
  };

  Result impact(const unsigned int n_across, const double courant_number)
  {
    const unsigned int n_along =
      static_cast<unsigned int>(std::lround(0.9 * 2. * n_across * length / (2. * radius)));
    const Body   bar   = make_bar(n_across, n_along);
    const double width = 10e-3;
    const Body   wall =
      tests::make_box("wall", Point<3>(-width, -width, -2e-3), Point<3>(width, width, 0.), {{10, 10, 1}},
                      {{tests::Side::bottom, Boundary::support}, {tests::Side::top, Boundary::contact}});
    const Mesh      mesh(MPI_COMM_SELF, {bar, wall});
    ElasticMaterial copper;
    copper.young_modulus = 117e9;
    copper.poisson_ratio = 0.35;
    copper.density       = 8930.;
    PlasticMaterial yielding;
    yielding.yield_stress      = 400e6;
    yielding.isotropic_modulus = 100e6;
    const Solid        solid(mesh, {copper, copper}, SolidParameters(), {{0, yielding, [](const Point<3> &) {
                                                                     return true;
                                                                   }}});
    DynamicsParameters parameters;
    // Cells of the foot get up to fifteen times thinner: so much shorter is the step that is stable for them.
    parameters.courant_number = courant_number;
    parameters.gravity        = 0.;
    ExplicitDynamics          dynamics(mesh, solid, parameters);
    std::vector<unsigned int> held;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == 1)
        held.push_back(i);
      else
        dynamics.state.v[i] = Vector3{0., 0., -227., 0.};
    dynamics.fix_nodes(held);
    ContactParameters contact_parameters;
    contact_parameters.slave_body = 0;
    Contact contact(mesh, contact_parameters, std::make_shared<CoulombFriction>(0.));
    dynamics.attach_contact(contact);
    dynamics.start();
    while (dynamics.state.time < 80e-6)
      {
        dynamics.step();
        if (dynamics.state.n_steps % 500 == 0)
          dynamics.check_stability();
      }
    Result result{};
    double low = 1., high = 0., n_rim = 0.;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == 0)
        {
          const Vector3 x = dynamics.state.position(i);
          low             = std::min(low, x[2]);
          high            = std::max(high, x[2]);
          if (std::hypot(mesh.nodes[i][0], mesh.nodes[i][1]) > 0.99 * radius && mesh.nodes[i][2] < 1e-6)
            {
              result.foot += std::hypot(x[0], x[1]);
              n_rim += 1.;
            }
        }
    result.foot /= n_rim;
    result.length             = high - low;
    const EnergyLedger energy = dynamics.ledger();
    // Nothing from outside drives it: the energies are shares of the kinetic energy lost.
    result.residual      = energy.residual() / energy.kinetic;
    result.plastic_share = -energy.plastic / energy.kinetic;
    result.n_cells       = mesh.n_global_cells;
    for (const double p : solid.plastic().equivalent_plastic_strain(dynamics.state.history))
      result.largest_strain = std::max(result.largest_strain, p);
    std::printf(
      "core of %u cells across: %u steps, length %.3f mm, foot %.3f mm, largest plastic strain %.2f, "
      "kinetic %.2f plastic %.2f strain %.3f hourglass %.3f contact %.3f damping %.3f J\n",
      n_across, unsigned(dynamics.state.n_steps), 1e3 * result.length, 1e3 * result.foot,
      result.largest_strain, energy.kinetic, energy.plastic, energy.strain, energy.hourglass, energy.contact,
      energy.damping);
    std::fflush(stdout);
    return result;
  }
} // namespace plastic_taylor


TREAD_TEST(plastic_taylor)(tests::Check &check, const tests::Arguments &)
{
  const Result coarse = impact(4, 0.08), fine = impact(6, 0.05);
  check.relative("length, 8 cells across, mm", 1e3 * coarse.length, 21.45, 0.02);
  check.relative("length, 12 cells across, mm", 1e3 * fine.length, 21.45, 0.02);
  check.relative("radius of the foot, 12 cells across, mm", 1e3 * fine.foot, 7.1, 0.04);
  check.relative("largest plastic strain, 12 cells across", fine.largest_strain, 2.9, 0.15);
  check.below("energy that is missing, share of the kinetic energy", fine.residual, 0.01);
  check.relative("nearly all of it is plastic work", fine.plastic_share, 1., 0.05);
}
