// SPDX-License-Identifier: LGPL-2.1-or-later
// A piece of rail on a beam on sleepers: a short base under blows and turns against the beam with nothing
// left out, over frequency and at rest; the deflection that follows a load; a block of cells on it against
// the same beam, with its energy.
#include <tread/base/format.h>
#include <tread/dynamics/explicit_dynamics.h>
#include <tread/dynamics/parts/nodes.h>
#include <tread/dynamics/parts/rail_on_beam.h>

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

namespace track_rail_on_beam
{
  constexpr double spacing = 0.6, before = 0.22; // m; from the support before to x = 0

  /// Under a piece from x on; its section lies halfway between two supports.
  BeamUnderRail beam(const double begin, const double length)
  {
    constexpr int spans = 20;
    BeamUnderRail b;
    b.section             = {6.4e6, 250e6, 60.2, 0.24};
    b.axial_stiffness     = 1.6e9;
    b.begin               = -before - (spans + 0.5) * spacing;
    b.track.spacing       = spacing;
    b.track.n_spans       = 2 * spans;
    b.track.first_support = 0.5 * spacing;
    b.track.layers        = {200e6, 30e3, 0.04, 150., 60e6, 50e3};
    b.track.loaded        = {begin - b.begin, begin + length - b.begin, {}};
    return b;
  }

  /// The same beam without a piece.
  reference::SupportedBeam whole_beam()
  {
    constexpr int       n = 40;
    std::vector<double> supports;
    for (int s = -n; s < n; ++s)
      supports.push_back(spacing * s - before);
    const BeamUnderRail b = beam(0., 0.1);
    return {
      b.section, b.track.layers, supports, supports.front() - 0.5 * spacing, supports.back() + 0.5 * spacing,
      0.005};
  }

  using Complex = std::complex<double>;
  struct Response
  {
    std::vector<Complex> up, slope;
  };

  /// A place between two nodes of a beam, and loads there.
  struct OneLoad
  {
    BeamUnderRail       b;
    TrackBeam           track{b.section, b.axial_stiffness, b.track};
    TrackBeam::Place    place;
    std::vector<double> loads = std::vector<double>(2 * track.n_loaded(), 0.);

    OneLoad(const BeamUnderRail &beam, const double x)
      : b(beam)
      , place(track.place(x - beam.begin))
    {
    }
    void set(const double force, const double moment)
    {
      for (unsigned int k = 0; k < 4; ++k)
        loads[place.first + k] = place.up[k] * force + place.slope[k] * moment;
      track.set_loads(loads.data());
    }
  };

  constexpr double struck_at = 0.031; // x, m

  /// After a blow of 0.3 ms.
  Response struck(const bool by_force, const tests::Lines &lines)
  {
    constexpr double     time_step = 1e-6, pulse = 0.3e-3, duration = 0.05;
    OneLoad              beam_under(beam(-0.05, 0.2), struck_at);
    TrackBeam           &track = beam_under.track;
    std::vector<Complex> force(lines.n, 0.), phase(lines.n, 1.), turn(lines.n);
    Response             r{std::vector<Complex>(lines.n, 0.), std::vector<Complex>(lines.n, 0.)};
    for (unsigned int k = 0; k < lines.n; ++k)
      turn[k] = std::exp(Complex(-lines.decay, -2. * dealii::numbers::PI * (lines.lowest + k * lines.step)) *
                         time_step);
    for (double time = 0.; time < duration; time += time_step)
      {
        const double f =
          time < pulse ? 0.5 * (1. - std::cos(2. * dealii::numbers::PI * time / pulse)) * 1e3 : 0.;
        const TrackBeam::AtSection at = track.displacement_at(beam_under.place);
        for (unsigned int k = 0; k < lines.n; ++k)
          {
            force[k] += f * phase[k];
            r.up[k] += at.up * phase[k];
            r.slope[k] += at.slope * phase[k];
            phase[k] *= turn[k];
          }
        beam_under.set(by_force ? f : 0., by_force ? 0. : f);
        track.find_forces();
        track.advance({}, time_step);
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
    // Up over a force, slope over a force, up over a moment, slope over a moment.
    double off[4] = {0., 0., 0., 0.}, scale[4] = {0., 0., 0., 0.};
    for (const unsigned int of_moment : {0, 1})
      {
        const Response found = struck(of_moment == 0, lines);
        for (unsigned int k = 0; k < lines.n; ++k)
          {
            const reference::SupportedBeam::Load load{struck_at, 1. - of_moment, 1. * of_moment};
            const auto                           there = whole.respond(
                                        {load}, {2. * dealii::numbers::PI * (lines.lowest + k * lines.step), -lines.decay});
            off[2 * of_moment] += std::norm(found.up[k] - there.deflection(struck_at));
            scale[2 * of_moment] += std::norm(there.deflection(struck_at));
            off[2 * of_moment + 1] += std::norm(found.slope[k] - there.rotation(struck_at));
            scale[2 * of_moment + 1] += std::norm(there.rotation(struck_at));
          }
      }
    check.below("60 to 2000 Hz: up over a force, difference from the beam", std::sqrt(off[0] / scale[0]),
                0.01);
    check.below("slope over a moment, difference from the beam", std::sqrt(off[3] / scale[3]), 0.01);
    // The place is near the middle of a span, where they are small.
    const double of_both = std::sqrt(scale[0] * scale[3]);
    check.below("slope over a force, over the means of both", std::sqrt(off[1] / of_both), 0.01);
    check.below("up over a moment, likewise", std::sqrt(off[2] / of_both), 0.01);
  }

  void check_at_rest(tests::Check &check)
  {
    constexpr double               force = -60e3, moment = 3e3; // N, N m
    const reference::SupportedBeam whole = whole_beam();
    OneLoad                        under(beam(-0.05, 1.), struck_at); // over a support
    under.set(force, moment);
    under.track.take_loads_at_rest();
    const auto there = whole.respond({{struck_at, force, moment}});
    for (const double x : {struck_at, 0.2, 0.39, 0.9})
      {
        const TrackBeam::AtSection at = under.track.displacement_at(under.track.place(x - under.b.begin));
        check.absolute(format("at rest, x = %.3f m: up, um", x), 1e6 * at.up,
                       1e6 * there.deflection(x).real(), 0.1);
        check.absolute(format("x = %.3f m: slope, urad", x), 1e6 * at.slope, 1e6 * there.rotation(x).real(),
                       0.2);
      }
  }

  /// Deflections (m) at rest under a force by the equations of a Timoshenko beam, solved from its held
  /// beginning to its end, where it does not turn: with stretches of any section, and without elements.
  std::vector<double> deflections_by_equations(const BeamUnderRail       &b,
                                               const double               x_force,
                                               const double               force,
                                               const std::vector<double> &places)
  {
    struct At
    {
      double w = 0., slope = 0., shear = 0., moment = 0.;
    };
    const TrackBeamParameters      &p = b.track;
    const reference::SupportLayers &l = p.layers;
    const double pads = 1. / (1. / l.pad_stiffness + 1. / l.ballast_stiffness), end = p.n_spans * p.spacing;
    std::vector<double> stops{x_force - b.begin, end};
    for (unsigned int s = 0; s < p.n_spans; ++s)
      stops.push_back(p.first_support + s * p.spacing);
    for (const BeamStretch &stretch : p.stretches)
      stops.push_back(stretch.from);
    for (const double x : places)
      stops.push_back(x - b.begin);
    std::sort(stops.begin(), stops.end());
    // The load alone, and one of shear force and moment at the beginning.
    std::array<std::vector<double>, 3> w;
    std::array<At, 3>                  last;
    for (unsigned int k = 0; k < 3; ++k)
      {
        At     at{0., 0., k == 1 ? 1. : 0., k == 2 ? 1. : 0.};
        double x = 0.;
        for (const double to : stops)
          {
            const double                  h    = to - x;
            const reference::BeamSection &here = section_between(b.section, p.stretches, x, to);
            at.w += at.slope * h + (at.moment / 2. - at.shear * h / 6.) * h * h / here.bending_stiffness +
                    at.shear * h / here.shear_stiffness;
            at.slope += (at.moment - at.shear * h / 2.) * h / here.bending_stiffness;
            at.moment -= at.shear * h;
            x              = to;
            const double s = (x - p.first_support) / p.spacing;
            // Several stops may be at one place.
            if (h > 0. && std::abs(s - std::round(s)) < 1e-9)
              {
                at.shear += pads * at.w;
                at.moment += l.pad_stiffness * l.pad_radius * l.pad_radius * at.slope;
              }
            if (k == 0 && h > 0. && x == x_force - b.begin)
              at.shear -= force;
            for (const double place : places)
              if (h > 0. && x == place - b.begin)
                w[k].push_back(at.w);
          }
        last[k] = at;
      }
    const double determinant = last[1].shear * last[2].slope - last[2].shear * last[1].slope,
                 shear       = (last[2].shear * last[0].slope - last[0].shear * last[2].slope) / determinant,
                 moment      = (last[0].shear * last[1].slope - last[1].shear * last[0].slope) / determinant;
    std::vector<double> result;
    for (std::size_t i = 0; i < w[0].size(); ++i)
      result.push_back(w[0][i] + shear * w[1][i] + moment * w[2][i]);
    return result;
  }

  /// A joint: fishplates alone over a gap, and with the rail on both sides of it.
  void check_stretches(tests::Check &check)
  {
    constexpr double force = -60e3; // N
    BeamUnderRail    b     = beam(0.2, 0.3);
    b.track.n_spans        = 10;
    b.begin                = -before - 5.5 * spacing;
    b.track.loaded         = {0.2 - b.begin, 0.5 - b.begin, {}};
    const std::vector<double> places{0.2, 0.31, 0.35, 0.45};
    const auto                compare = [&](const std::string &name) {
      OneLoad under(b, places[1]);
      under.set(force, 0.);
      under.track.take_loads_at_rest();
      const std::vector<double> there = deflections_by_equations(b, places[1], force, places);
      double                    off   = 0.;
      for (const std::size_t i : {0, 2, 3})
        off = std::max(
                         off, std::abs(under.track.displacement_at(under.track.place(places[i] - b.begin)).up / there.at(i) -
                                       1.));
      check.below(name + ": deflection at rest, difference", off, 1e-8);
      // Within an element the force bends it a little more.
      check.relative(name + ": at the load, um", 1e6 * under.track.displacement_at(under.place).up,
                                    1e6 * there.at(1), 1e-3);
      return there.at(1);
    };
    const double whole = compare("beam by its equations");
    const auto   from  = [&](const double x) {
      return x - b.begin;
    };
    b.track.stretches = {{from(-0.15), {9e6, 400e6, 100., 0.34}},
                         {from(0.347), {0.5e6, 80e6, 40., 0.02}},
                         {from(0.353), {9e6, 400e6, 100., 0.34}},
                         {from(0.75), b.section}};
    check.that("with a joint it bends otherwise", std::abs(compare("with a joint") / whole - 1.) > 0.02);
  }

  /// A block of steel on a beam, with a force upwards on nodes across its top beside its middle.
  struct Block
  {
    static constexpr double cell = 0.02, width = 2 * cell, begin = 0.3;
    static constexpr double x = begin + 5 * cell; // of the force

    unsigned int     n_long, n_high;
    double           height = n_high * cell, length = n_long * cell;
    Mesh             mesh{MPI_COMM_WORLD,
              {tests::make_box("rail",
                                           Point<3>(begin, 0., 0.),
                                           Point<3>(begin + length, width, height),
                                           {{n_long, 2, n_high}},
                                           {{tests::Side::bottom, Boundary::support}})}};
    Solid            solid{mesh, {ElasticMaterial()}, SolidParameters()};
    ExplicitDynamics dynamics;
    RailOnBeam      *rail     = nullptr;
    NodalField      *external = nullptr;
    double           n_loaded = 0.;

    explicit Block(const DynamicsParameters &parameters,
                   const unsigned int        n_long = 6,
                   const unsigned int        n_high = 2)
      : n_long(n_long)
      , n_high(n_high)
      , dynamics(mesh, solid, parameters)
    {
      rail     = &dynamics.add<RailOnBeam>(beam(begin, length), 0);
      external = &dynamics.add<NodeLoads>().force;
      for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
        n_loaded += is_loaded(i) && mesh.shared_nodes.is_owned(i);
      n_loaded = dealii::Utilities::MPI::sum(n_loaded, MPI_COMM_WORLD);
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

  /// A block under a force that begins to act, beside the beam alone.
  void check_block(tests::Check      &check,
                   const std::string &name,
                   const unsigned int n_long,
                   const unsigned int n_high,
                   const double       largest)
  {
    constexpr double  force = 20e3; // N
    Block             block(weightless(), n_long, n_high);
    OneLoad           alone(beam(Block::begin, block.length), Block::x);
    ExplicitDynamics &dynamics = block.dynamics;
    double            off_up = 0., off_slope = 0., up = 0., residual = 0.;
    dynamics.start();
    dynamics.step();
    while (dynamics.state.time < 4e-3)
      {
        const double rise = std::min(1., dynamics.state.time / 1e-3),
                     f    = force * rise * rise * (3. - 2. * rise);
        block.load(f);
        dynamics.step();
        alone.set(f, 0.);
        alone.track.find_forces();
        alone.track.advance({}, dynamics.state.time_step);
        const TrackBeam::AtSection with    = block.rail->displacement_at(Block::x),
                                   without = alone.track.displacement_at(alone.place);
        off_up                             = std::max(off_up, std::abs(with.up - without.up));
        off_slope                          = std::max(off_slope, std::abs(with.slope - without.slope));
        up                                 = std::max(up, std::abs(without.up));
        if (dynamics.state.n_steps % 500 == 0)
          residual = std::max(residual, std::abs(dynamics.ledger().residual_share()));
      }
    check.below(name + ": up beside the beam alone under the same load", off_up / up, largest);
    check.below(name + ": its slope, over 0.12 m", 0.12 * off_slope / up, largest);
    check.below(name + ": energy not accounted for, share of the work", residual, 1e-6);
  }

  /// A start under a load: it stays where it is, and what the springs hold is not counted.
  void check_loaded_start(tests::Check &check)
  {
    constexpr double               force = -60e3; // N
    const reference::SupportedBeam whole = whole_beam();
    const double                   sunk  = whole.respond({{Block::x, force}}).deflection(Block::x).real();
    Block                          block(weightless());
    block.load(force);
    block.dynamics.relax(1e-7, 20000, {});
    block.dynamics.start();
    for (unsigned int k = 0; k < 300; ++k)
      block.dynamics.step();
    check.below("a loaded start: up over the deflection at rest",
                block.rail->displacement_at(Block::x).up / sunk, 1e-4);
    const EnergyLedger at_rest = block.dynamics.ledger();
    check.below("energy of springs since the start over that at rest", at_rest.springs / (0.5 * force * sunk),
                1e-3);
    check.below("and energy not accounted for", at_rest.residual() / (0.5 * force * sunk), 1e-5);
    block.load(1.1 * force);
    while (block.dynamics.state.time < 2e-3)
      block.dynamics.step();
    const EnergyLedger ledger = block.dynamics.ledger();
    check.below("with more load: energy not accounted for, share of the work", ledger.residual_share(), 1e-5);
    check.that("the springs hold more", ledger.springs > 0. && ledger.dampers > 0.);
    block.rail->place();
    check.that("in its place nothing is displaced",
               block.rail->displacement_at(Block::x).up == 0. && block.rail->spring_energy() == 0.);
  }

  /// Velocities with which the deflection follows a load, beside the beam under a load a little farther.
  void check_following(tests::Check &check)
  {
    // Halfway between two nodes of the beam, where it is as much deeper as it is a little farther.
    constexpr double               force = -60e3, speed = 20., way = 1e-3, at = 0.315; // N, m/s, m, m
    const reference::SupportedBeam whole = whole_beam();
    Block                          block(weightless());
    State                         &state = block.dynamics.state;
    const std::vector<double>      up = block.rail->follow(state, {{at, speed, force}}, [](NodalField &) {});
    const auto later = whole.respond({{at + way, force}}), earlier = whole.respond({{at - way, force}});
    const auto rate = [&](const double x) {
      return speed * (later.deflection(x) - earlier.deflection(x)).real() / (2. * way);
    };
    check.relative("following a load: what presses goes up, mm/s", 1e3 * up.at(0), 1e3 * rate(at), 0.001);
    double worst = 0., fastest = 0.;
    for (unsigned int i = 0; i < block.mesh.nodes.size(); ++i)
      if (const double x = block.mesh.nodes[i][0]; x > at + 0.03)
        {
          worst   = std::max(worst, std::abs(state.v[i][2] - rate(x)));
          fastest = std::max(fastest, std::abs(rate(x)));
        }
    using dealii::Utilities::MPI::max;
    check.below("and the nodes of the rail ahead of it",
                max(worst, MPI_COMM_WORLD) / max(fastest, MPI_COMM_WORLD), 0.001);
    // It goes on with them when it finds the load with which it begins.
    block.load(force);
    block.dynamics.relax(1e-7, 20000, {});
    const double lively = block.rail->follow(state, {{at, speed, force}}, [](NodalField &) {}).at(0);
    block.dynamics.start();
    for (unsigned int k = 0; k < 2; ++k)
      block.dynamics.step();
    check.relative("its first way, um", 1e6 * block.rail->displacement_at(at).up, 1e6 * lively * state.time,
                   0.05);
    // The books begin before the beam knows its load: what the load does in half a step is missing.
    check.below("energy not accounted for, over the work of the load in a step",
                block.dynamics.ledger().residual() / (force * max(fastest, MPI_COMM_WORLD) * state.time_step),
                1.);
  }
} // namespace track_rail_on_beam


TREAD_TEST(track_rail_on_beam)(tests::Check &check, const tests::Arguments &)
{
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
    {
      check_over_frequency(check);
      check_at_rest(check);
      check_stretches(check);
    }
  check_following(check);
  check_block(check, "a block on it", 6, 2, 0.01);
  // A sixth of the beam's mass and two fifths of its stiffness.
  check_block(check, "a long and high block on it", 60, 5, 0.02);
  check_loaded_start(check);
}
