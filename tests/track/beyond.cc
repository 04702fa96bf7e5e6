// SPDX-License-Identifier: LGPL-2.1-or-later
// The track beyond the ends of a rail of cells. Properties of cross-sections against closed forms; the beam
// at rest against another one and a chain of springs; a longitudinal pulse and a hammer blow on a bar of five
// spans against the same bar so long that nothing comes back; a load at rest, the start of its motion and
// energy; and all ranks together against each alone.
#include <tread/dynamics/parts/nodes.h>
#include <tread/track/rail_ends.h>
#include <tread/track/rail_section.h>

#include <deal.II/base/mpi.h>

#include "check.h"
#include "fields.h"
#include "receptance.h"

#include <algorithm>

using namespace tread;

namespace track_beyond
{
  TrackParameters points()
  {
    TrackParameters track;
    track.pad_width     = .05;
    track.points_along  = 3;
    track.points_across = 2;
    return track;
  }

  DynamicsParameters with_gravity(const double gravity)
  {
    DynamicsParameters parameters;
    parameters.gravity = gravity;
    return parameters;
  }

  TrackBeyondBoth beyond(const TrackParameters &track, const double gravity = 0.)
  {
    TrackBeamParameters p;
    p.spacing       = tests::spacing;
    p.first_support = .5 * tests::spacing;
    p.layers        = track.layers(0);
    p.gravity       = gravity;
    return std::array<TrackBeamParameters, 2>{{p, p}};
  }

  using Corners = std::array<std::array<double, 2>, 4>;

  Corners box(const double left, const double right, const double low, const double high)
  {
    return {{{{left, low}}, {{left, high}}, {{right, high}}, {{right, low}}}};
  }

  /// Quadrilaterals of a rectangle about (y, z), unlike in size.
  std::vector<Corners> rectangle(const double       y,
                                 const double       z,
                                 const double       width,
                                 const double       height,
                                 const unsigned int n)
  {
    std::vector<Corners> parts;
    const auto           at = [n](const unsigned int k) {
      return std::pow(double(k) / n, 1.2) - .5;
    };
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        parts.push_back(
          box(y + width * at(i), y + width * at(i + 1), z + height * at(j), z + height * at(j + 1)));
    return parts;
  }

  void check_sections(tests::Check &check)
  {
    const RailSectionProperties plate = rail_section_properties(rectangle(.2, -.1, .06, .15, 12));
    check.relative("rectangle: area", plate.area, .06 * .15, 1e-12);
    check.absolute("rectangle: y", plate.y, .2, 1e-12);
    check.absolute("rectangle: z", plate.z, -.1, 1e-12);
    check.relative("rectangle: vertical bending", plate.about_y, .06 * std::pow(.15, 3) / 12., 1e-12);
    check.relative("rectangle: lateral bending", plate.about_z, .15 * std::pow(.06, 3) / 12., 1e-12);
    check.relative("rectangle: shear coefficient", plate.shear_coefficient, 5. / 6., 1e-3);
    // A thin web between thin flanges of the web's thickness: the shear flow of thin walls.
    constexpr double   t = 2e-3, h = .2, b = .1;
    auto               walls = rectangle(0., 0., t, h - t, 24);
    const unsigned int n     = 24;
    // The web's columns go on through the flanges, so that the edges fit.
    const auto columns = [&](const double z) {
      const auto at = [](const unsigned int k) {
        return t * (std::pow(double(k) / n, 1.2) - .5);
      };
      for (unsigned int i = 0; i < n; ++i)
        walls.push_back(box(at(i), at(i + 1), z - .5 * t, z + .5 * t));
      for (const double side : {-1., 1.})
        for (unsigned int i = 0; i < 40; ++i)
          {
            const auto across = [&](const unsigned int k) {
              return side * .5 * (t + (b - t) * k / 40.);
            };
            walls.push_back(box(across(i), across(i + 1), z - .5 * t, z + .5 * t));
          }
    };
    columns(.5 * h);
    columns(-.5 * h);
    const RailSectionProperties profile = rail_section_properties(walls);
    // With q = t z (b/2 - |s|) in each half of a flange and t (b h/2 + (h^2/4 - z^2)/2) in the web, over I.
    const double I = t * h * h * h / 12. + 2. * b * t * h * h / 4., area = t * (h + 2. * b);
    const double flanges = 4. * std::pow(t * .5 * h, 2) * std::pow(.5 * b, 3) / 3. / t;
    const double a       = .5 * b * h + h * h / 8.;
    const double web     = t * (a * a * h - a * h * h * h / 12. + std::pow(h, 5) / 320.);
    check.relative("thin walls: shear coefficient", profile.shear_coefficient,
                   I * I / (area * (flanges + web)), .015);
  }

  void check_at_rest(tests::Check &check)
  {
    const auto   bar    = tests::bar(5, 12);
    auto         track  = (*beyond(points()))[0];
    const double EA     = 210e9 * .06 * .15;
    track.first_support = .2;
    TrackBeam one(bar.section, EA, track);
    // Half of a beam under a force, or under a moment, between two supports.
    std::vector<double> places;
    for (unsigned int s = 0; s < track.n_spans; ++s)
      {
        places.push_back(.2 + s * tests::spacing);
        places.insert(places.begin(), -places.back());
      }
    const double                   end = places.back() + .5 * tests::spacing;
    const reference::SupportedBeam whole(bar.section, track.layers, places, -end, end, .05);
    const auto                     under = whole.respond({{0., 2000.}});
    one.set_at_rest({0., under.deflection(0.).real(), 0.});
    one.find_forces();
    check.relative("force on the section at rest (N)", one.force_on_section().up, -1000., 1e-8);
    const auto turned = whole.respond({{0., 0., 2000.}});
    one.set_at_rest({0., 0., turned.rotation(0.).real()});
    one.find_forces();
    check.relative("moment on the section at rest (N m)", one.force_on_section().slope, -1000., 1e-8);
    // Bars in series with springs beside them, from the far end on.
    double stiffness = EA / (.5 * tests::spacing);
    for (unsigned int s = track.n_spans; s-- > 0;)
      stiffness = 1. / (1. / (stiffness + track.stiffness_along) + (s > 0 ? tests::spacing : .2) / EA);
    one.set_at_rest({1e-3, 0., 0.});
    one.find_forces();
    check.relative("force along the rail at rest (N)", one.force_on_section().along, -1e-3 * stiffness, 1e-8);
    // Where all supports sink alike.
    track.gravity       = 10.;
    track.first_support = .5 * tests::spacing;
    TrackBeam    heavy(bar.section, EA, track);
    const double of_span = track.gravity * bar.section.mass * tests::spacing,
                 sleepers =
                   -(of_span + track.gravity * track.layers.sleeper_mass) / track.layers.ballast_stiffness,
                 rail = sleepers - of_span / track.layers.pad_stiffness;
    heavy.set_at_rest({0., rail, 0.});
    heavy.find_forces();
    check.below("weight at rest: force on the section over the weight of a span",
                std::abs(heavy.force_on_section().up) / of_span, .02);
    check.relative("weight at rest: potential (J)", heavy.weight_potential(0.),
                   track.n_spans * (of_span * rail + track.gravity * track.layers.sleeper_mass * sleepers),
                   2e-4);
  }

  /// What a section of cells that is displaced as a whole does to the track beyond it, and the other way
  /// round.
  void check_coupling(tests::Check &check)
  {
    const TrackBeyondBoth both = beyond(points());
    tests::TrackRail      rail(MPI_COMM_SELF, tests::bar(3, 12), 3, points(), with_gravity(0.), {});
    auto                 &part = rail.dynamics->add<RailOnTrackBeyond>(0, tests::steel(), *both);
    const double          EA = 210e9 * .06 * .15, about_z = .15 * std::pow(.06, 3) / 12., small = 1e-5;
    // The shear coefficient that the cells' section has.
    std::vector<Corners> quads;
    for (int i = -1; i < 1; ++i)
      for (int j = 0; j < 6; ++j)
        quads.push_back(box(.03 * i, .03 * (i + 1), .025 * j, .025 * (j + 1)));
    reference::BeamSection section = rail.section;
    section.shear_stiffness =
      rail_section_properties(quads).shear_coefficient * tests::steel().shear_modulus() * .06 * .15;
    TrackBeam  one(section, EA, (*both)[0]);
    const auto displaced = [&](const auto &by) {
      State state = rail.dynamics->state;
      for (unsigned int i = 0; i < rail.mesh->nodes.size(); ++i)
        state.x_damped[i] += small * by(rail.mesh->nodes[i]);
      return state;
    };
    const auto check_both = [&](const std::string &name, const auto &by, const double energy) {
      const State state = displaced(by);
      part.set_at_rest(state);
      check.relative(name + ": energy of both ends (J)", part.spring_energy(), 2. * energy, 1e-6);
      NodalField force(rail.mesh->nodes.size(), Vector3{});
      part.add_forces(force);
      double work = 0.;
      for (unsigned int i = 0; i < force.size(); ++i)
        work -= .5 * small * dot(force[i], by(rail.mesh->nodes[i]));
      check.relative(name + ": work of the forces on the nodes (J)", work, 2. * energy, 1e-6);
    };
    const auto energy_of = [&](const TrackBeam::AtSection &at) {
      one.set_at_rest(at);
      return one.spring_energy();
    };
    check_both(
      "section along the rail",
      [](const dealii::Point<3> &) {
        return Vector3{1., 0., 0., 0.};
      },
      energy_of({small, 0., 0.}));
    check_both(
      "section up",
      [](const dealii::Point<3> &) {
        return Vector3{0., 0., 1., 0.};
      },
      energy_of({0., small, 0.}));
    check_both(
      "section turned across",
      [](const dealii::Point<3> &p) {
        return Vector3{.075 + p[2], 0., 0., 0.};
      },
      energy_of({0., 0., small}));
    // Up and turned at the end of highest x as outwards, at the other one the other way round.
    check_both(
      "section up and turned outwards",
      [](const dealii::Point<3> &p) {
        return Vector3{(p[0] > 0. ? -1. : 1.) * (.075 + p[2]), 0., 1., 0.};
      },
      energy_of({0., small, small}));
    check_both(
      "section turned about the vertical",
      [](const dealii::Point<3> &p) {
        return Vector3{p[1], 0., 0., 0.};
      },
      .5 * 2. * std::sqrt(3.) * 210e9 * about_z / tests::spacing * small * small);
  }

  /// Energy in the cells over what it was, when longitudinal waves would have come back from so far beyond
  /// their ends, m.
  double left_of_pulse(const TrackBeyondBoth &goes_on, const double from = 0.)
  {
    constexpr unsigned int n_supports = 5;
    constexpr double       frequency = 6e3, periods = 2.; // Hz
    DynamicsParameters     parameters = with_gravity(0.);
    parameters.damping_steps          = 0.;
    TrackParameters undamped          = points();
    undamped.springs.pad_damping = undamped.springs.ballast_damping = 0.;
    tests::TrackRail rail(MPI_COMM_SELF, tests::bar(n_supports, 24), n_supports, undamped, parameters, {},
                          false, 0, SleeperBox().coarsest_cell_size, goes_on);
    const auto       energy = [&]() {
      double sum = 0.;
      for (unsigned int i = 0; i < rail.mesh->nodes.size(); ++i)
        sum +=
          .5 * rail.dynamics->true_masses()[i] * dot(rail.dynamics->state.v[i], rail.dynamics->state.v[i]);
      const EnergyLedger ledger = rail.dynamics->ledger();
      return sum + ledger.strain + ledger.hourglass;
    };
    return tests::left_of_tone(rail, frequency, periods,
                               2. * (rail.end + from) / tests::bar_wave_speed() + periods / frequency,
                               energy);
  }

  std::unique_ptr<tests::TrackRail> five_spans(const MPI_Comm         comm,
                                               const unsigned int     n_supports,
                                               const double           gravity,
                                               const TrackBeyondBoth &goes_on,
                                               const unsigned int     levels = 0)
  {
    return std::make_unique<tests::TrackRail>(comm, tests::bar(n_supports, 12), n_supports, points(),
                                              with_gravity(gravity), std::vector<double>(), false, levels,
                                              SleeperBox().coarsest_cell_size, goes_on);
  }

  /// Neither over a support nor at mid-span.
  constexpr double struck_at = .15;

  tests::Receptance strike(const unsigned int n_supports, const TrackBeyondBoth &goes_on)
  {
    const auto rail = five_spans(MPI_COMM_SELF, n_supports, 0., goes_on);
    return tests::by_hammer(*rail, rail->sections(struck_at), .02, {30., 10., 198, 200.});
  }

  struct History
  {
    double              at_rest, still; ///< displacements when balanced, and as much later, m
    std::vector<double> displacements;  ///< of the section that is struck then
    EnergyLedger        ledger;
  };

  /// A load at rest in equilibrium, and a blow beside and along the rail.
  History run(const MPI_Comm comm)
  {
    const auto rail   = five_spans(comm, 5, 9.81, beyond(points(), 9.81), 2);
    const auto struck = rail->sections(struck_at);
    rail->load(struck, 50e3);
    rail->dynamics->relax(1e-7, 20000, {});
    History history;
    history.at_rest = rail->displacement(struck);
    rail->dynamics->start();
    for (unsigned int n = 0; n < 400; ++n)
      rail->dynamics->step();
    history.still = rail->displacement(struck);
    for (unsigned int n = 0; n < 3000; ++n)
      {
        for (const auto &[node, share] : struck)
          rail->loads->force[node] = share * Vector3{.3 * tests::blow(n), 0., -50e3 - tests::blow(n), 0.};
        rail->dynamics->step();
        if (n % 100 == 99)
          history.displacements.push_back(rail->displacement(struck));
      }
    history.ledger = rail->dynamics->ledger();
    return history;
  }
} // namespace track_beyond


TREAD_TEST(track_beyond)(tests::Check &check, const tests::Arguments &)
{
  const History together = run(MPI_COMM_WORLD);
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    {
      const History alone = run(MPI_COMM_SELF);
      check.relative("at rest, on other ranks (m)", together.at_rest, alone.at_rest, 1e-6);
      check.below("displacements on other ranks",
                  tests::difference(together.displacements, alone.displacements), 1e-6);
      check.relative("damping on other ranks (J)", together.ledger.damping, alone.ledger.damping, 1e-6);
      return;
    }
  check_sections(check);
  check_at_rest(check);
  check_coupling(check);

  // The same beam on 45 supports.
  const tests::RailForTrack bar = tests::bar(5, 12);
  std::vector<double>       supports;
  for (int s = -22; s <= 22; ++s)
    supports.push_back(tests::spacing * s);
  const double                   end = supports.back() + .5 * tests::spacing;
  const reference::SupportedBeam endless_beam(bar.section, points().layers(0), supports, -end, end, .05);
  const double by_load = endless_beam.respond({{struck_at, 50e3}}).deflection(struck_at).real(),
               of_span = 9.81 * bar.section.mass * tests::spacing, sleeper = 9.81 * points().sleeper_mass,
               by_weight = (of_span + sleeper) / points().springs.ballast_stiffness +
                           of_span / points().springs.pad_stiffness;
  check.relative("at rest: displacement under load and weight (mm)", 1e3 * together.at_rest,
                 1e3 * (by_load + by_weight), 1e-3);
  check.relative("at rest it stays (mm)", 1e3 * together.still, 1e3 * together.at_rest, 1e-6);
  check.below("energy residual/gross work", together.ledger.residual_share(), 1e-3);
  check.that("dampers take energy", together.ledger.dampers > 0.);

  TrackBeyondBoth free       = beyond(points());
  (*free)[0].stiffness_along = (*free)[1].stiffness_along = 0.;
  check.relative("longitudinal pulse, symmetric: energy that comes back (%)", 100. * left_of_pulse({}), 100.,
                 .01);
  check.below("longitudinal pulse, endless: energy that comes back (%)", 100. * left_of_pulse(free), .02);
  // From the plane of symmetry behind the layer that absorbs, half of four spans.
  for (TrackBeamParameters &end : *free)
    end.n_spans = 4;
  const double kept = std::exp(-2. * AbsorbingEnds::strength / 3. / std::sqrt(2.6));
  check.absolute("longitudinal pulse: energy that comes back from the far end (%)",
                 100. * left_of_pulse(free, 4. * tests::spacing), 100. * kept, 1.);

  // A rigid sleeper as two coordinates that move alike, each with twice its mass and springs: the same track.
  const auto in_two = [](TrackBeyondBoth both) {
    for (TrackBeamParameters &end : *both)
      {
        const reference::SupportLayers &rigid = end.layers;
        const double m = rigid.sleeper_mass, k = rigid.ballast_stiffness, c = rigid.ballast_damping;
        end.sleeper = {{2. * m, 2. * m}, {2. * k, 2. * k}, {m, m}, {1.5 * c, .5 * c, .5 * c, 1.5 * c}};
      }
    return both;
  };
  const auto force_at_rest = [&](const TrackBeyondBoth &both) {
    TrackBeam track(bar.section, 1e9, (*both)[0]);
    track.set_at_rest({0., -1e-3, 2e-3});
    return track.present_force_on_section();
  };
  const TrackBeam::AtSection of_one = force_at_rest(beyond(points(), 9.81)),
                             of_two = force_at_rest(in_two(beyond(points(), 9.81)));
  check.relative("sleepers of two coordinates: force at rest, kN", 1e-3 * of_two.up, 1e-3 * of_one.up, 1e-9);
  check.relative("sleepers of two coordinates: moment at rest, kN m", 1e-3 * of_two.slope,
                 1e-3 * of_one.slope, 1e-9);

  // Nothing comes back from the ends of 61 spans while the record counts, 20 ms at a decay of 200 1/s.
  const tests::Receptance endless = strike(61, {}), symmetric = strike(5, {}),
                          five = strike(5, beyond(points()));
  TrackBeyondBoth few          = beyond(points());
  (*few)[0].n_spans = (*few)[1].n_spans = 8;
  check.below("eight spans beyond, 30 to 2000 Hz: share of the energy that comes back (%)",
              100. * tests::reflected(strike(5, few), endless, 30., 2000.), 6e-3);
  check.below("sleepers of two coordinates, 30 to 2000 Hz: energy of the difference (%)",
              100. * tests::reflected(strike(5, in_two(beyond(points()))), five, 30., 2000.), 1e-6);
  struct Band
  {
    double from, to, limit; ///< Hz, %
  };
  for (const Band &band : {Band{30., 100., 1e-5},
                           {100., 300., 2e-4},
                           {300., 700., 7e-5},
                           {700., 1200., 6e-3},
                           {1200., 2000., .015}})
    {
      const std::string name = std::to_string(int(band.from)) + " to " + std::to_string(int(band.to)) +
                               " Hz: share of the energy that comes back (%)";
      check.below("five spans, endless, " + name, 100. * tests::reflected(five, endless, band.from, band.to),
                  band.limit);
      check.that("five spans, symmetric, " + name + " is larger",
                 100. * tests::reflected(symmetric, endless, band.from, band.to) > 5. * band.limit);
    }
}
