// SPDX-License-Identifier: LGPL-2.1-or-later
// A piece of rail on a beam on sleepers: a short base under blows and turns against the beam with nothing
// left out, over frequency and at rest; the deflection that follows a load; a block of cells on it against
// the same beam, with its energy.
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/parts/nodes.h>
#include <tread/dynamics/parts/rail_base.h>
#include <tread/track/base_on_beam.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include "boxes.h"
#include "check.h"
#include "receptance.h"

#include <algorithm>
#include <cmath>
#include <complex>

using namespace tread;
using dealii::Point;

namespace
{
  constexpr double spacing = 0.6, before = 0.22; // m; from the support before to the middle of the base

  BeamUnderRail beam(const double length)
  {
    BeamUnderRail b;
    b.section         = {6.4e6, 250e6, 60.2, 0.24};
    b.axial_stiffness = 1.6e9;
    b.length          = length;
    b.mass            = length * b.section.mass;
    TrackBeyondParameters beyond;
    beyond.spacing = spacing;
    beyond.layers  = {200e6, 30e3, 0.04, 150., 60e6, 50e3};
    b.beyond.fill(beyond);
    b.beyond[0].first_support = before - 0.5 * length;
    b.beyond[1].first_support = spacing - before - 0.5 * length;
    return b;
  }

  /// The same beam without a rigid piece; the middle of the base is at 0.
  reference::SupportedBeam whole_beam()
  {
    constexpr int       n = 40;
    std::vector<double> supports;
    for (int s = -n; s < n; ++s)
      supports.push_back(spacing * (s + 1) - before);
    const BeamUnderRail b = beam(0.1);
    return {b.section,
            b.beyond[0].layers,
            supports,
            supports.front() - 0.5 * spacing,
            supports.back() + 0.5 * spacing,
            0.02};
  }

  using Complex = std::complex<double>;
  /// Up and slope over a force, then over a moment.
  struct Response
  {
    std::vector<Complex> up, slope;
  };

  /// After a blow of 0.3 ms on the middle.
  Response struck(const bool by_force, const tests::Lines &lines)
  {
    constexpr double time_step = 1e-6, pulse = 0.3e-3, duration = 0.05;
    BaseOnBeam       base(beam(0.04));
    base.advance({}, time_step); // at rest without a load
    std::vector<Complex> force(lines.n, 0.), phase(lines.n, 1.), turn(lines.n);
    Response             r{std::vector<Complex>(lines.n, 0.), std::vector<Complex>(lines.n, 0.)};
    for (unsigned int k = 0; k < lines.n; ++k)
      turn[k] = std::exp(Complex(-lines.decay, -2. * dealii::numbers::PI * (lines.lowest + k * lines.step)) *
                         time_step);
    for (double time = 0.; time < duration; time += time_step)
      {
        const double f =
          time < pulse ? 0.5 * (1. - std::cos(2. * dealii::numbers::PI * time / pulse)) * 1e3 : 0.;
        for (unsigned int k = 0; k < lines.n; ++k)
          {
            force[k] += f * phase[k];
            r.up[k] += base.displacement().shift[2] * phase[k];
            r.slope[k] += base.displacement().slope * phase[k];
            phase[k] *= turn[k];
          }
        base.find_forces();
        base.advance(by_force ? RailBase::Load{{0., 0., f, 0.}, 0.} : RailBase::Load{{}, f}, time_step);
      }
    for (unsigned int k = 0; k < lines.n; ++k)
      {
        r.up[k] /= force[k];
        r.slope[k] /= force[k];
      }
    return r;
  }

  void check_over_frequency(tests::Check &check)
  {
    const tests::Lines             lines{60., 20., 98, 100.};
    const reference::SupportedBeam whole = whole_beam();
    for (const bool by_force : {true, false})
      {
        const Response found  = struck(by_force, lines);
        double         off[2] = {0., 0.}, scale[2] = {0., 0.};
        for (unsigned int k = 0; k < lines.n; ++k)
          {
            const reference::SupportedBeam::Load load{0., by_force ? 1. : 0., by_force ? 0. : 1.};
            const auto                           there = whole.respond(
                                        {load}, {2. * dealii::numbers::PI * (lines.lowest + k * lines.step), -lines.decay});
            off[0] += std::norm(found.up[k] - there.deflection(0.));
            scale[0] += std::norm(there.deflection(0.));
            off[1] += std::norm(found.slope[k] - there.rotation(0.));
            scale[1] += std::norm(there.rotation(0.));
          }
        const std::string over = by_force ? " over a force" : " over a moment";
        check.below("60 to 2000 Hz: up" + over + ", difference from the beam", std::sqrt(off[0] / scale[0]),
                    0.02);
        check.below("60 to 2000 Hz: slope" + over + ", difference from the beam",
                    std::sqrt(off[1] / scale[1]), 0.02);
      }
  }

  void check_following(tests::Check &check)
  {
    constexpr double load = -60e3, speed = 20.; // N, m/s
    BaseOnBeam       base(beam(0.04));
    check.that("it follows", base.follow(load, speed));
    const auto at_rest = whole_beam().respond({{0., 0., load * speed}});
    check.relative("following a load: up, mm/s", 1e3 * base.velocity().shift[2],
                   1e3 * at_rest.deflection(0.).real(), 0.01);
    check.relative("slope, mrad/s", 1e3 * base.velocity().slope, 1e3 * at_rest.rotation(0.).real(), 0.01);
    base.place();
    check.that("in its place it is at rest", base.velocity().shift[2] == 0. && base.spring_energy() == 0.);
  }

  /// A block of steel on a base on a beam, with a force upwards on nodes across its top beside its middle.
  struct Block
  {
    static constexpr double cell = 0.02, height = 2 * cell, length = 6 * cell, width = 2 * cell, begin = 0.3;
    static constexpr double x = begin + 5 * cell, arm = 2 * cell; // of the force

    Mesh             mesh{MPI_COMM_WORLD,
              {tests::make_box("rail",
                                           Point<3>(begin, 0., 0.),
                                           Point<3>(begin + length, width, height),
                                           {{6, 2, 2}},
                                           {{tests::Side::bottom, Boundary::support}})}};
    Solid            solid{mesh, {ElasticMaterial()}, SolidParameters()};
    ExplicitDynamics dynamics;
    BaseOnBeam       base;
    NodalField      *external = nullptr;
    double           n_loaded = 0.;

    explicit Block(const DynamicsParameters &parameters)
      : dynamics(mesh, solid, parameters)
      , base(without_block())
    {
      dynamics.add<RailOnBase>(base, 0);
      external = &dynamics.add<NodeLoads>().force;
      for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
        n_loaded += is_loaded(i) && mesh.shared_nodes.is_owned(i);
      n_loaded = dealii::Utilities::MPI::sum(n_loaded, MPI_COMM_WORLD);
    }

    static BeamUnderRail without_block()
    {
      BeamUnderRail under = beam(length);
      // Half of the lowest cells is on the base and has no mass.
      under.mass -= ElasticMaterial().density * length * width * (height - 0.5 * cell);
      return under;
    }
    bool is_loaded(const unsigned int i) const
    {
      return mesh.nodes[i][2] > height - 1e-6 && std::abs(mesh.nodes[i][0] - x) < 1e-6;
    }
    void load(const double force)
    {
      for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
        if (is_loaded(i))
          (*external)[i] = Vector3{0., 0., force / n_loaded, 0.};
    }
  };

  DynamicsParameters weightless()
  {
    DynamicsParameters parameters;
    parameters.gravity                       = 0.;
    parameters.steps_between_damping_samples = 1;
    return parameters;
  }

  /// The block under a force that begins to act, beside the base alone.
  void check_block(tests::Check &check)
  {
    constexpr double  force = 20e3; // N
    Block             block(weightless());
    BaseOnBeam        alone(beam(Block::length));
    ExplicitDynamics &dynamics = block.dynamics;
    double            off_up = 0., off_slope = 0., up = 0., slope = 0., residual = 0.;
    dynamics.start();
    dynamics.step();
    alone.advance({}, dynamics.state.time_step);
    while (dynamics.state.time < 4e-3)
      {
        // The block has no time to swing: the load grows within a millisecond.
        const double rise = std::min(1., dynamics.state.time / 1e-3),
                     f    = force * rise * rise * (3. - 2. * rise);
        block.load(f);
        dynamics.step();
        alone.find_forces();
        alone.advance({Vector3{0., 0., f, 0.}, f * Block::arm}, dynamics.state.time_step);
        const RailBase::Motion with = block.base.displacement(), without = alone.displacement();
        off_up    = std::max(off_up, std::abs(with.shift[2] - without.shift[2]));
        off_slope = std::max(off_slope, std::abs(with.slope - without.slope));
        up        = std::max(up, std::abs(without.shift[2]));
        slope     = std::max(slope, std::abs(without.slope));
        if (dynamics.state.n_steps % 500 == 0)
          residual = std::max(residual, std::abs(dynamics.ledger().residual_share()));
      }
    check.below("a block on it: up beside the beam alone under the same load", off_up / up, 0.01);
    check.below("likewise its slope", off_slope / slope, 0.02);
    check.below("energy not accounted for, share of the work", residual, 1e-6);
  }

  /// A start under a load: it stays where it is, and what the springs hold is not counted.
  void check_loaded_start(tests::Check &check)
  {
    constexpr double force = -60e3; // N
    Block            block(weightless());
    block.load(force);
    block.dynamics.relax(1e-7, 20000, {});
    block.dynamics.start();
    for (unsigned int k = 0; k < 300; ++k)
      block.dynamics.step();
    const double sunk = whole_beam().respond({{0., force}}).deflection(0.).real();
    check.below("a loaded start: up over the deflection at rest", block.base.displacement().shift[2] / sunk,
                1e-4);
    check.below("energy of springs since the start over that at rest",
                block.dynamics.ledger().springs / (0.5 * force * sunk), 1e-3);
    check.below("and energy not accounted for", block.dynamics.ledger().residual() / (0.5 * force * sunk),
                1e-5);
    block.load(1.1 * force);
    while (block.dynamics.state.time < 2e-3)
      block.dynamics.step();
    const EnergyLedger ledger = block.dynamics.ledger();
    check.below("with more load: energy not accounted for, share of the work", ledger.residual_share(), 1e-5);
    check.that("the springs hold more", ledger.springs > 0. && ledger.dampers > 0.);
  }
} // namespace


void run_test(tests::Check &check, const tests::Arguments &)
{
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
    {
      check_over_frequency(check);
      check_following(check);
    }
  check_block(check);
  check_loaded_start(check);
}
