// SPDX-License-Identifier: LGPL-2.1-or-later
// Taylor's impact test: a copper bar against a rigid wall without friction. Wilkins & Guinan (1973) and many
// codes since: length 32.4 mm, radius 3.2 mm, 227 m/s, 80 us. Published final length 21.4 to 21.5 mm and
// radius of the foot 7.0 to 7.2 mm (Kamoulakos 1990; Zhu & Cescotto 1995; Camacho & Ortiz 1997).
#include <tread/dynamics/explicit_dynamics.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include "boxes.h"
#include "check.h"

#include <cmath>
#include <cstdio>

using namespace tread;
using dealii::Point;

namespace
{
  constexpr double length = 32.4e-3, radius = 3.2e-3; // m

  struct Result
  {
    double       length, foot, residual, plastic_share, largest_strain;
    unsigned int n_cells;
  };

  Result impact(const unsigned int n_across, const double hourglass_coefficient)
  {
    const unsigned int n_along =
      static_cast<unsigned int>(std::lround(0.9 * n_across * length / (2. * radius)));
    Body bar = tests::make_box(
      "bar", Point<3>(-1., -1., 0.), Point<3>(1., 1., length), {{n_across, n_across, n_along}},
      {{Boundary::free, Boundary::free, Boundary::free, Boundary::free, Boundary::contact, Boundary::free}});
    // A square onto a disc: concentric squares become circles towards the rim.
    bar.to_space = [](const Point<3> &p) {
      const double size = std::max(std::abs(p[0]), std::abs(p[1])), norm = std::hypot(p[0], p[1]);
      const double round = norm > 0. ? size / norm : 1., mix = 0.6 * size;
      const double scale = radius * ((1. - mix) * 0.82 + mix * round + 0.18 * (1. - mix) * 0.);
      return Point<3>(scale * p[0], scale * p[1], p[2]);
    };
    const double width = 10e-3;
    const Body   wall =
      tests::make_box("wall", Point<3>(-width, -width, -2e-3), Point<3>(width, width, 0.), {{10, 10, 1}},
                      {{Boundary::free, Boundary::free, Boundary::free, Boundary::free, Boundary::support,
                        Boundary::contact}});
    const Mesh      mesh(MPI_COMM_SELF, {bar, wall});
    ElasticMaterial copper;
    copper.young_modulus = 117e9;
    copper.poisson_ratio = 0.35;
    copper.density       = 8930.;
    PlasticMaterial yielding;
    yielding.yield_stress      = 400e6;
    yielding.isotropic_modulus = 100e6;
    SolidParameters solid_parameters;
    solid_parameters.hourglass_coefficient = hourglass_coefficient;
    const Solid        solid(mesh, {copper, copper}, solid_parameters, {{0, yielding, [](const Point<3> &) {
                                                                    return true;
                                                                  }}});
    DynamicsParameters parameters;
    // Cells of the foot get six times thinner: so much shorter is the step that is stable for them.
    parameters.courant_number = 0.12;
    parameters.gravity        = 0.;
    ExplicitDynamics          dynamics(mesh, solid, parameters);
    std::vector<unsigned int> held;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == 1)
        held.push_back(i);
      else
        dynamics.v[i] = Row{0., 0., -227., 0.};
    dynamics.fix_nodes(held);
    ContactParameters contact_parameters;
    contact_parameters.slave_body  = 0;
    contact_parameters.master_body = 1;
    Contact contact(mesh, contact_parameters, std::make_shared<CoulombFriction>(0.));
    dynamics.attach_contact(contact);
    dynamics.start();
    while (dynamics.time < 80e-6)
      {
        dynamics.step();
        if (dynamics.n_steps % 500 == 0)
          dynamics.check_stability();
      }
    Result result{};
    double low = 1., high = 0.;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.node_bodies[i] == 0)
        {
          const Row x = dynamics.x[i];
          low         = std::min(low, x[2]);
          high        = std::max(high, x[2]);
          result.foot = std::max(result.foot, std::hypot(x[0], x[1]));
        }
    result.length             = high - low;
    const EnergyLedger energy = dynamics.ledger();
    // Nothing from outside drives it: the energies are shares of the kinetic energy lost.
    result.residual      = energy.residual() / energy.kinetic;
    result.plastic_share = -energy.plastic / energy.kinetic;
    result.n_cells       = mesh.n_global_cells;
    for (const double p : solid.plastic().equivalent_plastic_strain(dynamics.history))
      result.largest_strain = std::max(result.largest_strain, p);
    std::printf(
      "%u across, hourglass %g: %u steps, length %.3f mm, foot %.3f mm, largest plastic strain %.2f, "
      "kinetic %.2f plastic %.2f strain %.3f hourglass %.3f contact %.3f damping %.3f J\n",
      n_across, hourglass_coefficient, unsigned(dynamics.n_steps), 1e3 * result.length, 1e3 * result.foot,
      result.largest_strain, energy.kinetic, energy.plastic, energy.strain, energy.hourglass, energy.contact,
      energy.damping);
    std::fflush(stdout);
    return result;
  }
} // namespace


int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  tests::Check                             check;
  const Result                             coarse = impact(6, 1.), fine = impact(10, 1.);
  check.relative("length, 6 cells across, mm", 1e3 * coarse.length, 21.45, 0.02);
  check.relative("length, 10 cells across, mm", 1e3 * fine.length, 21.45, 0.02);
  check.relative("radius of the foot, 10 cells across, mm", 1e3 * fine.foot, 7.1, 0.04);
  check.below("energy that is missing, share of the kinetic energy", fine.residual, 0.01);
  check.relative("nearly all of it is plastic work", fine.plastic_share, 1., 0.05);
  return check.exit_code();
}
