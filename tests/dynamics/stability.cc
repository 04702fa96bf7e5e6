// SPDX-License-Identifier: LGPL-2.1-or-later
// The time step: not above the stability limit (1e5 steps at Courant number 0.95 keep their energy), not far
// below it (true highest frequency by power iteration), and a run beyond the limit is stopped with advice.
#include <tread/base/format.h>
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/parts/nodes.h>
#include <tread/solid/fully_integrated.h>
#include <tread/solid/one_point.h>

#include <deal.II/base/mpi.h>

#include "check.h"
#include "fields.h"
#include "track_rail.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

using namespace tread;
using dealii::Point;

namespace dynamics_stability
{
  Body graded_block()
  {
    Body body = tests::make_box("block", Point<3>(), Point<3>(.04, .03, .03), {{4, 3, 3}},
                                {{tests::Side::left, Boundary::support}});
    tests::refine_near(body, Point<3>(.04, .03, .03), .006, .005);
    return body;
  }

  /// Flat cells, whose bound nearly is the limit of the mesh.
  Body bricks()
  {
    return tests::make_box("bricks", Point<3>(), Point<3>(.06, .03, .03), {{6, 6, 3}});
  }

  void set_random_velocities(ExplicitDynamics &dynamics, const double speed)
  {
    std::mt19937                     random(17);
    std::uniform_real_distribution<> component(-speed, speed);
    for (Vector3 &v : dynamics.state.v)
      v = Vector3{component(random), component(random), component(random), 0.};
    dynamics.mesh.distribute_hanging_nodes(dynamics.state.v.data());
    for (const unsigned int i : dynamics.support_nodes(0))
      dynamics.state.v[i] = Vector3{};
  }

  /// Kinetic and strain energy (J) at the instant of the velocities.
  double energy_of(const ExplicitDynamics &dynamics)
  {
    NodalField middle(dynamics.state.v.size());
    double     energy = 0.;
    for (unsigned int i = 0; i < middle.size(); ++i)
      {
        middle[i] = dynamics.state.position(i) - 0.5 * dynamics.state.time_step * dynamics.state.v[i];
        energy += 0.5 * dynamics.true_masses()[i] * dot(dynamics.state.v[i], dynamics.state.v[i]);
      }
    const StrainEnergy strain = dynamics.solid.strain_energy(middle.data());
    return energy + strain.strain + strain.hourglass;
  }

  /// Highest angular frequency (rad/s) of the assembled free mesh by power iteration; from below.
  double highest_frequency(const Mesh &mesh, const Solid &solid, const std::vector<double> &masses)
  {
    const NodalField                 x = tests::reference_positions(mesh);
    NodalField                       mode(x.size()), f(x.size());
    std::mt19937                     random(23);
    std::uniform_real_distribution<> component(-1., 1.);
    for (Vector3 &row : mode)
      row = Vector3{component(random), component(random), component(random), 0.};
    double square = 0.;
    // Amplitude 1e-8 m in cells of 5 mm: strain 1e-6, the share of non-linearity.
    const double amplitude = 1e-8;
    for (unsigned int iteration = 0; iteration < 3000; ++iteration)
      {
        mesh.distribute_hanging_nodes(mode.data());
        const double norm = tests::largest(mode);
        NodalField   y    = x;
        for (unsigned int i = 0; i < x.size(); ++i)
          {
            mode[i] = (amplitude / norm) * mode[i];
            y[i] += mode[i];
            f[i] = Vector3{};
          }
        solid.add_internal_forces(y.data(), x.data(), f.data());
        mesh.condense_hanging_nodes(f.data());
        double stiffness = 0., inertia = 0.;
        for (unsigned int i = 0; i < x.size(); ++i)
          {
            stiffness -= dot(mode[i], f[i]);
            inertia += masses[i] * dot(mode[i], mode[i]);
          }
        square = stiffness / inertia;
        for (unsigned int i = 0; i < x.size(); ++i)
          mode[i] = masses[i] > 0. ? -f[i] / masses[i] : Vector3{};
      }
    return std::sqrt(square);
  }

  void check_bound(tests::Check &check, const Body &body, const std::string &name, const double least)
  {
    const Mesh mesh(MPI_COMM_SELF, {body});
    for (const std::string type : {OnePoint::name, FullyIntegrated::name})
      for (const double poisson_ratio : {0., 0.3, 0.45})
        {
          ElasticMaterial material;
          material.poisson_ratio = poisson_ratio;
          SolidParameters    solid_parameters;
          DynamicsParameters parameters;
          solid_parameters.element = type;
          parameters.damping_steps = 0.;
          const Solid            solid(mesh, {material}, solid_parameters);
          const ExplicitDynamics dynamics(mesh, solid, parameters);
          const double           exact = 2. / highest_frequency(mesh, solid, dynamics.true_masses());
          const double           ratio = dynamics.critical_step().seconds() / exact;
          char                   what[120];
          std::snprintf(what, sizeof what, "%s, %s, nu %.2f: step/limit", name.c_str(),
                        type == OnePoint::name ? "one point" : "full", poisson_ratio);
          std::printf("%s: critical time step %.4f us, limit %.4f us, ratio %.3f\n", what,
                      1e6 * dynamics.critical_step().seconds(), 1e6 * exact, ratio);
          // Above 1 runs fail; far below steps are in vain. For nu > 0 a free cell has a bulk mode that its
          // neighbours do not let it have in the mesh: what is lost by bounding cell by cell, most for nu
          // towards 0.5.
          const double lower = poisson_ratio > 0.3 ? least - 0.07 : least;
          check.absolute(what, ratio, 0.5 * (1. + lower), 0.5 * (1. - lower) + 1e-6);
        }
  }

  /// Mass added to the cells that would need a shorter step than a given one: how much, and that it is
  /// enough.
  void check_added_mass(tests::Check &check)
  {
    const Mesh            mesh(MPI_COMM_SELF, {graded_block()});
    const ElasticMaterial steel;
    const Solid           untouched(mesh, {steel}, SolidParameters());
    const auto           &frequencies = untouched.cell_frequencies();
    for (const double factor : {1.3, 3.})
      {
        SolidParameters solid_parameters;
        solid_parameters.highest_frequency =
          *std::max_element(frequencies.begin(), frequencies.end()) / factor;
        DynamicsParameters parameters;
        parameters.damping_steps = 0.;
        const Solid      solid(mesh, {steel}, solid_parameters);
        ExplicitDynamics dynamics(mesh, solid, parameters);
        dynamics.start();
        double       own = 0., added = 0.;
        unsigned int n_untouched = 0;
        const auto   masses      = untouched.cell_masses(mesh);
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          {
            const double mass   = std::accumulate(masses[c].begin(), masses[c].end(), 0.),
                         excess = std::pow(frequencies[c] / solid_parameters.highest_frequency, 2) - 1.;
            own += mass;
            added += std::max(0., excess) * mass;
            n_untouched += excess <= 0.;
          }
        const auto        of_body = dynamics.masses_of_bodies()[0];
        const std::string name    = format("step times %g: ", factor);
        check.that(name + "some cells are slow enough", factor > 2. || n_untouched > 0);
        check.relative(name + "mass of the body, kg", of_body.own, own, 1e-12);
        check.relative(name + "mass added, kg", of_body.added, added, 1e-12);
        std::vector<double> inertia;
        for (const double inverse : dynamics.inverse_masses())
          inertia.push_back(inverse > 0. ? 1. / inverse : 0.);
        const double exact = 2. / highest_frequency(mesh, solid, inertia);
        check.below(name + "step over the limit of the mesh", dynamics.critical_step().seconds() / exact,
                    1. + 1e-6);
        // Frequencies are rounded up to three digits.
        check.below(name + "step that was wanted over the step",
                    2. / (solid_parameters.highest_frequency * dynamics.critical_step().seconds()), 1.01);
      }
  }
} // namespace dynamics_stability


TREAD_TEST(dynamics_stability)(tests::Check &check, const tests::Arguments &)
{
  const ElasticMaterial steel;

  check_added_mass(check);

  check_bound(check, tests::make_box("cubes", Point<3>(), Point<3>(.03, .03, .03), {{6, 6, 6}}), "cubes",
              0.75);
  check_bound(check, bricks(), "bricks 2:1:2", 0.90);
  check_bound(check, graded_block(), "hanging nodes", 0.72);
  {
    // The worst cell is alone here: nothing else in the mesh is as fast.
    Body patch = tests::make_patch_cube(.03);
    tests::refine_near(patch, Point<3>(.03, .03, .03), .006, .006);
    check_bound(check, patch, "distorted, hanging nodes", 0.60);
  }

  struct Case
  {
    const char  *name;
    double       damping_steps, viscosity;
    unsigned int n_steps;
  };
  // Hanging nodes for their constraints, bricks because the bound is sharp for them.
  for (const bool hanging : {true, false})
    {
      const Mesh mesh(MPI_COMM_SELF, {hanging ? graded_block() : bricks()});
      std::printf("%u cells, %u hanging nodes\n", unsigned(mesh.n_global_cells),
                  unsigned(mesh.n_global_hanging_nodes));
      check.that("mesh as intended", (mesh.n_global_hanging_nodes > 0) == hanging);
      for (const Case &c : {Case{"damping 0", 0., 0., 100000}, Case{"damping 0.1", 0.1, 0., 100000},
                            Case{"damping 1", 1., 0., 20000}, Case{"bulk viscosity 0.06, 1.2", 0., 1., 20000},
                            Case{"damping 0.1 and bulk viscosity", 0.1, 1., 20000}})
        {
          SolidParameters solid_parameters;
          solid_parameters.linear_bulk_viscosity    = 0.06 * c.viscosity;
          solid_parameters.quadratic_bulk_viscosity = 1.2 * c.viscosity;
          DynamicsParameters parameters;
          parameters.courant_number = 0.95;
          parameters.gravity        = 0.;
          parameters.damping_steps  = c.damping_steps;
          const Solid      solid(mesh, {steel}, solid_parameters);
          ExplicitDynamics dynamics(mesh, solid, parameters);
          dynamics.fix_nodes(dynamics.support_nodes(0));
          set_random_velocities(dynamics, 1.);
          dynamics.start();
          const double start = energy_of(dynamics);
          double       low = start, high = start;
          for (unsigned int n = 1; n <= c.n_steps; ++n)
            {
              dynamics.step();
              if (n % 100 == 0)
                {
                  const double energy = energy_of(dynamics);
                  low                 = std::min(low, energy);
                  high                = !(energy <= high) ? energy : high; // NaN is kept
                }
            }
          std::printf("%s: %u steps of %.4f us, energy %.5g J at first, between %.5g and %.5g J later\n",
                      c.name, unsigned(dynamics.state.n_steps), 1e6 * dynamics.state.time_step, start, low,
                      high);
          const std::string name = std::string(hanging ? "hanging nodes, " : "bricks, ") + c.name;
          // Modes near omega dt = 1.9 swing by (omega dt)^2/8 = 0.45 of their strain energy; many modes
          // average.
          if (c.damping_steps == 0. && c.viscosity == 0.)
            {
              check.relative(name + ": highest energy/first", high / start, 1., 0.1);
              check.relative(name + ": lowest energy/first", low / start, 1., 0.1);
            }
          else
            check.that(name + ": energy only falls", high <= start && low < 0.5 * start);
        }
    }

  // Dampers shorten the step: omega^2 dt^2 + 2 dt c <= 4 for the highest frequency and the largest rate.
  for (const double rate : {0., 5e6, 5e7}) // 1/s; the cells' highest frequency is about 2e6
    {
      const Mesh         mesh(MPI_COMM_SELF, {bricks()});
      DynamicsParameters parameters;
      parameters.courant_number = 0.95;
      parameters.gravity        = 0.;
      parameters.damping_steps  = 0.;
      const Solid            solid(mesh, {steel}, SolidParameters());
      const ExplicitDynamics undamped(mesh, solid, parameters);
      ExplicitDynamics       dynamics(mesh, solid, parameters);
      dynamics.add<DampedNodes>(0, [&](const Point<3> &p) { return p[0] > 0.03 ? rate : 0.; });
      const double      omega    = 2. / undamped.critical_step().seconds();
      const double      expected = 4. / (rate + std::sqrt(rate * rate + 4. * omega * omega));
      const std::string name     = "nodes damped with " + std::to_string(int(1e-6 * rate)) + " per us: ";
      // Three digits are kept of the frequency, of the undamped step as well, and of the rate, which has one.
      check.relative(name + "time step, us", 1e6 * dynamics.critical_step().seconds(), 1e6 * expected, 1e-9);
      check.relative(name + "shortened by", dynamics.critical_step().slowed_by_supports(),
                     undamped.critical_step().seconds() / dynamics.critical_step().seconds(), 1e-12);
      set_random_velocities(dynamics, 1.);
      dynamics.start();
      const double first = energy_of(dynamics);
      double       high  = 0.;
      for (unsigned int n = 0; n < 2000; ++n)
        {
          dynamics.step();
          const double energy = energy_of(dynamics);
          high                = !(energy <= high) ? energy : high;
        }
      check.that(name + "energy stays bounded", high <= 1.1 * first);
    }

  // So do stiff pads and strong dampers under a rail, which then vibrates as others do.
  for (const bool stiff : {true, false})
    {
      TrackParameters track;
      track.pad_width     = .05;
      track.points_along  = 1;
      track.points_across = 2;
      if (stiff)
        track.springs.pad_stiffness = 1e13;
      else
        track.springs.pad_damping = 1e8;
      DynamicsParameters parameters;
      parameters.courant_number = 0.95;
      parameters.gravity        = 0.;
      tests::TrackRail  rail(MPI_COMM_SELF, tests::bar(5, 6), 5, track, parameters, {});
      const auto        struck = rail.sections(0.);
      const std::string name   = stiff ? "stiff pads: " : "strong dampers: ";
      rail.dynamics->start();
      const std::string said = tests::complaint<std::runtime_error>([&] {
        for (unsigned int n = 0; n < 4000; ++n)
          {
            rail.load(struck, tests::blow(n));
            rail.dynamics->step();
            if (n % 100 == 0)
              rail.dynamics->check_stability();
          }
      });
      check.that(name + "the cells alone would allow a longer step",
                 rail.dynamics->critical_step().slowed_by_supports() > 1.5);
      check.that(name + "stable " + said, said.empty());
      check.below(name + "energy residual/gross work", rail.dynamics->ledger().residual_share(), 0.01);
    }

  // Beyond the limit: a clear end instead of figures without meaning. With bricks, as 1.3 is still stable for
  // cubes.
  {
    const Mesh         mesh(MPI_COMM_SELF, {bricks()});
    DynamicsParameters parameters;
    parameters.courant_number = 1.3;
    parameters.gravity        = 0.;
    parameters.damping_steps  = 0.;
    const Solid      solid(mesh, {steel}, SolidParameters());
    ExplicitDynamics dynamics(mesh, solid, parameters);
    set_random_velocities(dynamics, 1.);
    dynamics.start();
    std::string message = tests::complaint<std::runtime_error>([&] {
      dynamics.check_stability();
      for (unsigned int n = 0; n < 2000; ++n)
        {
          dynamics.step();
          dynamics.check_stability();
        }
    });
    std::printf("message after %u steps: %s\n", unsigned(dynamics.state.n_steps), message.c_str());
    check.that("Courant number 1.3 ends with a message", message.find("Courant number") != std::string::npos);
    check.that("and not before the first step", dynamics.state.n_steps > 0);
    // A velocity that is not a number must not pass as slow.
    std::fill(dynamics.state.v.begin(), dynamics.state.v.end(), Vector3{});
    dynamics.state.v.back()[1] = std::nan("");
    message                    = tests::complaint<std::runtime_error>([&] { dynamics.check_stability(); });
    check.that("no number (NaN) is found too", !message.empty());
    const auto &p = mesh.nodes.back();
    char        place[80];
    std::snprintf(place, sizeof(place), "x = %.2f, y = %.2f, z = %.2f mm", 1e3 * p[0], 1e3 * p[1],
                  1e3 * p[2]);
    check.that(std::string("and where: ") + place, message.find(place) != std::string::npos);
    dynamics.state.v.back() = Vector3{0., 0., 999., 0.};
    check.that("999 m/s are borne",
               tests::complaint<std::runtime_error>([&] { dynamics.check_stability(); }).empty());
    dynamics.state.v.back() = Vector3{0., 0., 1001., 0.};
    check.that("1001 m/s are not",
               !tests::complaint<std::runtime_error>([&] { dynamics.check_stability(); }).empty());
  }
}
