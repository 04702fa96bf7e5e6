// SPDX-License-Identifier: LGPL-2.1-or-later
// Levels of time steps: they are stable over 1e5 steps, conserve momentum and close the ledger, a loaded body
// remains at rest, and the answer is that of a single step for all cells.
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/parts/nodes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include "check.h"
#include "fields.h"

#include <algorithm>
#include <memory>
#include <random>

using namespace tread;
using dealii::Point;

namespace dynamics_levels
{
  /// Cells of 10, 5 and 2.5 mm.
  Body graded_block(const tests::Side side, const Boundary boundary)
  {
    Body body =
      tests::make_box("block", Point<3>(), Point<3>(.08, .03, .03), {{8, 3, 3}}, {{side, boundary}});
    tests::refine_near(body, Point<3>(.08, .03, .03), .012, .0025);
    return body;
  }

  struct Block
  {
    Mesh                              mesh;
    Solid                             solid;
    std::unique_ptr<ExplicitDynamics> dynamics;
    NodeLoads                        *loads;

    Block(const Boundary left, const unsigned int max_level, const double courant, const double damping)
      : mesh(MPI_COMM_WORLD, {graded_block(tests::Side::left, left)})
      , solid(mesh, {ElasticMaterial()}, [&] {
        SolidParameters p;
        p.max_level = max_level;
        return p;
      }())
    {
      DynamicsParameters parameters;
      parameters.courant_number = courant;
      parameters.damping_steps  = damping;
      parameters.gravity        = 0.;
      dynamics                  = std::make_unique<ExplicitDynamics>(mesh, solid, parameters);
      dynamics->fix_nodes(dynamics->support_nodes(0));
      loads = &dynamics->add<NodeLoads>();
    }

    void advance()
    {
      do
        dynamics->step();
      while (!dynamics->synchronised());
    }

    /// Share the force (N) among the nodes of the free end that do not hang.
    void load_end(const Vector3 force)
    {
      const std::vector<char>   hanging = tests::which_hang(mesh);
      double                    n       = 0.;
      std::vector<unsigned int> end;
      for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
        if (!hanging[i] && mesh.nodes[i][0] > .08 - 1e-9)
          {
            end.push_back(i);
            n += mesh.shared_nodes.is_owned(i);
          }
      n = dealii::Utilities::MPI::sum(n, mesh.comm);
      for (const unsigned int i : end)
        loads->force[i] = (1. / n) * force;
    }

    /// Mean displacement of the end, m.
    double deflection() const
    {
      double sum = 0., n = 0.;
      for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
        if (mesh.nodes[i][0] > .08 - 1e-9 && mesh.shared_nodes.is_owned(i))
          {
            sum += dynamics->state.position(i)[2] - mesh.nodes[i][2];
            n += 1.;
          }
      return dealii::Utilities::MPI::sum(sum, mesh.comm) / dealii::Utilities::MPI::sum(n, mesh.comm);
    }
  };

  void set_random_velocities(Block &block, const double speed)
  {
    std::mt19937                     random(17);
    std::uniform_real_distribution<> component(-speed, speed);
    ExplicitDynamics                &dynamics = *block.dynamics;
    for (unsigned int i = 0; i < dynamics.state.v.size(); ++i)
      {
        const auto key = block.mesh.node_key(i); // the same on all ranks
        random.seed(key[1] + 1000003 * key[2] + 998244353 * key[3]);
        dynamics.state.v[i] = Vector3{component(random), component(random), component(random), 0.};
      }
    block.mesh.distribute_hanging_nodes(dynamics.state.v.data());
    for (const unsigned int i : dynamics.support_nodes(0))
      dynamics.state.v[i] = Vector3{};
  }

  Vector3 momentum(const Block &block)
  {
    Vector3 sum{};
    for (unsigned int i = 0; i < block.mesh.nodes.size(); ++i)
      if (block.mesh.shared_nodes.is_owned(i))
        sum += block.dynamics->true_masses()[i] * block.dynamics->state.v[i];
    return tests::sum_over_ranks(sum, block.mesh.comm);
  }

  void levels_of_cells(tests::Check &check)
  {
    const Block block(Boundary::support, 3, .95, .1);
    check.that("three levels of cells", block.dynamics->max_level() == 2);
    std::printf("%u cells, %.2f times fewer updates\n", unsigned(block.mesh.n_global_cells),
                block.dynamics->ideal_gain_of_levels());
    const Block plain(Boundary::support, 0, .95, .1);
    check.below("the smallest step is not much shortened by coarse cells",
                plain.dynamics->critical_step().seconds() / block.dynamics->critical_step().seconds(), 1.05);
  }

  /// Cells that are not quite twice as slow take steps that are twice as long, and the step must be as short
  /// as these need it.
  void step_of_slow_cells(tests::Check &check)
  {
    constexpr double times_as_slow = 1.85;
    const auto       cube          = [](const double x) {
      return tests::make_box("cube", Point<3>(x, 0., 0.), Point<3>(x + .02, .02, .02), {{4, 4, 4}});
    };
    const Mesh      mesh(MPI_COMM_WORLD, {cube(0.), cube(.1)});
    ElasticMaterial heavy = ElasticMaterial();
    heavy.density *= times_as_slow * times_as_slow;
    double step[2];
    for (const unsigned int max_level : {0u, 1u})
      {
        SolidParameters solid_parameters;
        solid_parameters.max_level = max_level;
        const Solid            solid(mesh, {ElasticMaterial(), heavy}, solid_parameters);
        const ExplicitDynamics dynamics(mesh, solid, DynamicsParameters());
        check.absolute("slow cells: levels", dynamics.max_level(), max_level, 0.);
        step[max_level] = dynamics.critical_step().seconds();
      }
    // Frequencies are rounded up to three digits.
    check.relative("slow cells: step over that of fast cells", step[1] / step[0], .5 * times_as_slow, .011);
  }

  /// Nodes that hang at the contact follow their parents in every step: their velocity is what contact looks
  /// at.
  void hanging_at_contact(tests::Check &check)
  {
    const Mesh      mesh(MPI_COMM_WORLD, {graded_block(tests::Side::top, Boundary::contact)});
    SolidParameters solid_parameters;
    solid_parameters.max_level = 2;
    const Solid      solid(mesh, {ElasticMaterial()}, solid_parameters);
    ExplicitDynamics dynamics(mesh, solid, DynamicsParameters());
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      dynamics.state.v[i] = Vector3{std::sin(40. * mesh.nodes[i][0]), 0., mesh.nodes[i][1], 0.};
    mesh.distribute_hanging_nodes(dynamics.state.v.data());
    dynamics.start();
    double       largest = 0.;
    unsigned int n       = 0;
    for (unsigned int step = 0; step < 16; ++step)
      {
        dynamics.step();
        for (const Mesh::HangingNode &h : mesh.hanging_nodes)
          if (mesh.nodes[h.node][2] > .03 - 1e-9)
            {
              Vector3 mean{};
              for (const unsigned int parent : h.parents)
                mean += Mesh::HangingNode::weight * dynamics.state.v[parent];
              largest = std::max(largest, tests::size(dynamics.state.v[h.node] - mean));
              ++n;
            }
      }
    check.that("nodes hang at the contact", dealii::Utilities::MPI::sum(n, mesh.comm) > 0);
    check.below("hanging at the contact: velocity off the parents', m/s",
                dealii::Utilities::MPI::max(largest, mesh.comm), 1e-14);
  }

  /// Any motion of the grid: energy only falls, over 1e5 of the smallest steps at Courant number 0.95.
  void random_motion(tests::Check &check)
  {
    Block block(Boundary::support, 2, .95, .1);
    set_random_velocities(block, 1.);
    block.dynamics->start();
    EnergyLedger ledger           = block.dynamics->ledger();
    double       kinetic_at_first = 0.;
    for (unsigned int i = 0; i < block.mesh.nodes.size(); ++i)
      if (block.mesh.shared_nodes.is_owned(i))
        kinetic_at_first +=
          .5 * block.dynamics->true_masses()[i] * dot(block.dynamics->state.v[i], block.dynamics->state.v[i]);
    kinetic_at_first = dealii::Utilities::MPI::sum(kinetic_at_first, block.mesh.comm);
    double highest   = 0.;
    while (block.dynamics->state.n_steps < 100000)
      {
        block.advance();
        if (block.dynamics->state.n_steps % 1000 == 0)
          {
            ledger  = block.dynamics->ledger();
            highest = std::max(highest, ledger.kinetic + ledger.strain + ledger.hourglass);
          }
      }
    std::printf("random motion: %.4g J at first, change %.4g J, damping %.4g J\n", kinetic_at_first,
                ledger.kinetic + ledger.strain + ledger.hourglass, ledger.damping);
    check.below("random motion: energy never above the first", highest / kinetic_at_first, 1e-3);
    check.relative("random motion: nearly all of it is damped",
                   -(ledger.kinetic + ledger.strain + ledger.hourglass) / kinetic_at_first, 1., 3e-3);
  }

  /// The pushes that make up for late forces come before those that they make up for, so momentum is lent,
  /// not given. When the grid has come to rest all is paid back.
  void free_block(tests::Check &check)
  {
    Block block(Boundary::free, 2, .9, .1);
    set_random_velocities(block, 1.);
    block.dynamics->start();
    const Vector3 before = momentum(block);
    double        scale  = 0.;
    for (unsigned int i = 0; i < block.mesh.nodes.size(); ++i)
      scale += block.dynamics->true_masses()[i] *
               std::sqrt(dot(block.dynamics->state.v[i], block.dynamics->state.v[i]));
    const auto change = [&] {
      const Vector3 difference = momentum(block) - before;
      return std::sqrt(dot(difference, difference)) / scale;
    };
    double largest = 0.;
    while (block.dynamics->state.n_steps < 100000)
      {
        block.advance();
        largest = std::max(largest, change());
      }
    check.below("free block: momentum lent over the sum of its amounts", largest, 1e-2);
    check.below("free block: momentum not paid back, as it still turns", change(), 2e-4);
  }

  /// Without the steady shares the border between levels would rattle.
  void loaded_at_rest(tests::Check &check)
  {
    Block block(Boundary::support, 2, .9, .1);
    block.load_end(Vector3{0., 0., 2e4, 0.});
    block.dynamics->relax(1e-10, 100000, {});
    block.dynamics->start();
    const double at_rest = block.deflection();
    while (block.dynamics->state.n_steps < 20000)
      block.advance();
    check.relative("loaded and at rest: deflection stays", block.deflection() / at_rest, 1., 1e-7);
    double fastest = 0.;
    for (const Vector3 &v : block.dynamics->state.v)
      fastest = std::max(fastest, std::sqrt(dot(v, v)));
    fastest = dealii::Utilities::MPI::max(fastest, block.mesh.comm);
    std::printf("loaded and at rest: deflection %.4g um, fastest node %.2g m/s\n", 1e6 * at_rest, fastest);
    check.below("loaded and at rest: fastest node, m/s", fastest, 1e-5);
  }

  /// A smooth push, then free ringing: the ledger closes over 1e5 steps, and the deflection follows that of
  /// one step.
  void push_and_ringing(tests::Check &check)
  {
    Block        levels(Boundary::support, 2, .9, .1), plain(Boundary::support, 0, .9, .1);
    const double duration       = 100e-6;
    double       worst_residual = 0., worst_deflection = 0., largest_deflection = 0.;
    for (Block *block : {&levels, &plain})
      block->dynamics->start();
    const auto push = [&](Block &block) {
      do
        {
          const double s = block.dynamics->state.time / duration;
          block.load_end(
            Vector3{0., 0., s < 1. ? 250. * (1. - std::cos(2. * dealii::numbers::PI * s)) : 0., 0.});
          block.dynamics->step();
        }
      while (!block.dynamics->synchronised());
    };
    while (levels.dynamics->state.time < 1e-3)
      {
        push(levels);
        double before = plain.deflection(), time_before = plain.dynamics->state.time;
        while (plain.dynamics->state.time < levels.dynamics->state.time)
          {
            before      = plain.deflection();
            time_before = plain.dynamics->state.time;
            push(plain);
          }
        const double share =
          (levels.dynamics->state.time - time_before) / (plain.dynamics->state.time - time_before);
        const double then  = before + share * (plain.deflection() - before);
        largest_deflection = std::max(largest_deflection, std::abs(then));
        worst_deflection   = std::max(worst_deflection, std::abs(levels.deflection() - then));
      }
    levels.load_end(Vector3{});
    while (levels.dynamics->state.n_steps < 100000)
      {
        levels.advance();
        if (levels.dynamics->state.n_steps % 5000 == 0)
          worst_residual = std::max(worst_residual, std::abs(levels.dynamics->ledger().residual_share()));
      }
    const EnergyLedger ledger = levels.dynamics->ledger();
    std::printf("push: work %.4g J, damping %.4g, residual %.2g J\n", ledger.external_work, ledger.damping,
                ledger.residual());
    // Nearly all of this block's motion is in the slow cells, right at the border: harsher than any scene.
    // Their forces act on the faster nodes at other instants than those at which the ledger takes them; with
    // one step for all what is left is between the samples of the damping.
    check.below("push: energy residual over the work, 1e5 steps", worst_residual, 7e-3);
    check.below("push with one step for all: energy residual over the work",
                plain.dynamics->ledger().residual_share(), 1e-4);
    check.below("push: deflection against one step for all", worst_deflection / largest_deflection, 2e-3);
  }
} // namespace dynamics_levels


TREAD_TEST(dynamics_levels)(tests::Check &check, const tests::Arguments &)
{
  levels_of_cells(check);
  step_of_slow_cells(check);
  hanging_at_contact(check);
  random_motion(check);
  free_block(check);
  loaded_at_rest(check);
  push_and_ringing(check);
}
