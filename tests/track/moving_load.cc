// SPDX-License-Identifier: LGPL-2.1-or-later
// A constant force moves along a bar of cells: simply supported, against the series of its modes, and on
// supports so close that they are a Winkler foundation, against the steady state in closed form
// (Fryba 1999, chapters 1 and 13).
#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include "check.h"
#include "track_rail.h"

#include <algorithm>
#include <complex>

using namespace tread;

namespace track_moving_load
{
  constexpr double pi    = dealii::numbers::PI;
  constexpr double width = .06, height = .15, force = 1e5; // m, m, N

  reference::BeamSection section()
  {
    // Cowper's shear coefficient (1966).
    constexpr double nu = .3;
    return tests::beam_section(width * height, width * std::pow(height, 3) / 12.,
                               10. * (1. + nu) / (12. + 11. * nu));
  }

  /// A bar from -length/2 to length/2 with the sections of nodes at equal distances.
  struct Bar
  {
    const double                                              cell;
    const unsigned int                                        n;
    Mesh                                                      mesh;
    Solid                                                     solid;
    ExplicitDynamics                                          dynamics;
    NodeLoads                                                &loads = dynamics.add<NodeLoads>();
    std::vector<std::vector<std::pair<unsigned int, double>>> nodes; ///< by section, with shares of its mass

    Bar(const double length, const unsigned int n)
      : cell(length / n)
      , n(n)
      , mesh(MPI_COMM_SELF,
             {tests::make_box("bar",
                              dealii::Point<3>(-.5 * length, -.5 * width, -height),
                              dealii::Point<3>(.5 * length, .5 * width, 0.),
                              {{n, 2, 6}},
                              {{tests::Side::left, Boundary::end},
                               {tests::Side::right, Boundary::end},
                               {tests::Side::bottom, Boundary::support}})})
      , solid(mesh, {tests::steel()}, SolidParameters())
      , dynamics(mesh,
                 solid,
                 [] {
                   DynamicsParameters p;
                   p.gravity = 0.;
                   return p;
                 }())
      , nodes(n + 1)
    {
      for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
        nodes[std::lround((mesh.nodes[i][0] + .5 * length) / cell)].emplace_back(i,
                                                                                 dynamics.true_masses()[i]);
      for (auto &of_section : nodes)
        {
          double mass = 0.;
          for (const auto &node : of_section)
            mass += node.second;
          for (auto &node : of_section)
            node.second /= mass;
        }
    }

    /// Put a downward force at x, which the two nearest sections share.
    void load(const double x, const double f)
    {
      std::fill(loads.force.begin(), loads.force.end(), Vector3{});
      const double       s = x / cell + .5 * n;
      const unsigned int k = std::clamp<int>(std::floor(s), 0, n - 1);
      for (const unsigned int side : {0u, 1u})
        for (const auto &[node, share] : nodes[k + side])
          loads.force[node] = Vector3{0., 0., -f * share * (side ? s - k : 1. - s + k), 0.};
    }

    /// Mean downward displacement of the section at x.
    double deflection(const double x) const
    {
      const double       s   = x / cell + .5 * n;
      const unsigned int k   = std::clamp<int>(std::floor(s), 0, n - 1);
      double             sum = 0.;
      for (const unsigned int side : {0u, 1u})
        for (const auto &[node, share] : nodes[k + side])
          sum +=
            share * (side ? s - k : 1. - s + k) * (mesh.nodes[node][2] - dynamics.state.position(node)[2]);
      return sum;
    }
  };

  /// Middle of a simply supported Timoshenko beam while a force crosses it at speed v: each mode is an
  /// oscillator, sin(n pi x/l), under a force P sin(Omega t) with Omega = n pi v/l (Fryba 1999, eq. 1.31).
  double at_middle(const double length, const double v, const double t)
  {
    const reference::BeamSection s   = section();
    double                       sum = 0.;
    for (unsigned int n = 1; n < 60; n += 2)
      {
        const double Omega = n * pi * v / length, k = n * pi / length,
                     omega = reference::timoshenko_frequency(s, length / n);
        // The static share has the static stiffness: rotary inertia has no part in it.
        const double stiffness =
          s.bending_stiffness * std::pow(k, 4) / (1. + s.bending_stiffness * k * k / s.shear_stiffness);
        sum += std::sin(.5 * n * pi) * 2. * force / length / stiffness /
               (1. - Omega * Omega / (omega * omega)) *
               (std::sin(Omega * t) - Omega / omega * std::sin(omega * t));
      }
    return sum;
  }

  void simply_supported(tests::Check &check)
  {
    constexpr double length = 3., v = 80.;
    Bar              bar(length, 120);
    // Ends keep their height and may turn.
    for (const unsigned int end : {0u, bar.n})
      {
        std::vector<unsigned int> all, axis;
        for (const auto &node : bar.nodes[end])
          {
            all.push_back(node.first);
            if (std::abs(bar.mesh.nodes[node.first][2] + .5 * height) < 1e-9)
              axis.push_back(node.first);
          }
        bar.dynamics.guide_nodes(all, 2);
        if (end == 0)
          {
            bar.dynamics.guide_nodes(axis, 0);
            bar.dynamics.guide_nodes(axis, 1);
          }
      }
    bar.dynamics.start();
    double worst = 0., worst_still = 0., largest = 0., cells_largest = 0.;
    while (v * bar.dynamics.state.time < length)
      {
        bar.load(v * bar.dynamics.state.time - .5 * length, force);
        bar.dynamics.step();
        const double t = bar.dynamics.state.time, w = bar.deflection(0.), exact = at_middle(length, v, t);
        worst         = std::max(worst, std::abs(w - exact));
        worst_still   = std::max(worst_still, std::abs(w - at_middle(length, 1e-3 * v, 1e3 * t)));
        largest       = std::max(largest, exact);
        cells_largest = std::max(cells_largest, w);
      }
    check.relative("simply supported, 288 km/h: largest deflection at the middle (mm)", 1e3 * cells_largest,
                   1e3 * largest, .02);
    check.below("simply supported: whole history, largest difference/deflection", worst / largest, .02);
    check.that("simply supported: a force that moves without inertia is told from it",
               worst_still > .1 * largest);
  }

  /// Deflection under a force that has moved at speed v for long along a Timoshenko beam on a Winkler
  /// foundation of stiffness u (N/m^2) and damping c (N s/m^2): the integral over all wave numbers k of the
  /// answer to k with the frequency k v.
  double winkler(const reference::BeamSection &s, const double u, const double c, const double v)
  {
    constexpr double end = 400., step = 1e-3; // 1/m
    double           sum = 0.;
    for (double k = .5 * step; k < end; k += step)
      {
        const double bending = s.bending_stiffness * k * k, omega = k * v;
        // kappa G A k^2 (1 - kappa G A/(kappa G A + E I k^2 - rho I omega^2)), which has a limit for Euler's
        // beam.
        const double rigid   = bending - s.rotary_inertia * omega * omega;
        const double of_beam = k * k * rigid / (1. + rigid / s.shear_stiffness);
        sum += (1. / std::complex<double>(of_beam + u - s.mass * omega * omega, omega * c)).real();
      }
    return force / pi * sum * step;
  }

  void on_foundation(tests::Check &check)
  {
    constexpr double length = 7.2, distance = .075, u = 72.5e6, share_of_critical = .5, damping_ratio = .3;
    const reference::BeamSection s     = section();
    reference::BeamSection       euler = s;
    euler.shear_stiffness              = std::numeric_limits<double>::infinity();
    euler.rotary_inertia               = 0.;
    const double critical              = std::pow(4. * u * s.bending_stiffness / (s.mass * s.mass), .25),
                 v = share_of_critical * critical, c = 2. * damping_ratio * std::sqrt(u * s.mass);
    check.relative("Euler's beam: deflection of the moving force over that at rest",
                   winkler(euler, u, 0., v) / winkler(euler, u, 0., 0.),
                   1. / std::sqrt(1. - share_of_critical * share_of_critical), 1e-4);

    TrackParameters track;
    track.two_layers            = false;
    track.springs.pad_stiffness = u * distance;
    track.springs.pad_damping   = c * distance;
    track.pad_length            = .02;
    track.pad_width             = .03;
    track.points_along          = 1;
    track.points_across         = 2;
    Bar                 bar(length, 288);
    std::vector<double> positions;
    for (double x = .5 * (distance - length); x < .5 * length; x += distance)
      positions.push_back(x);
    Supports supports(bar.mesh, 0, positions, track);
    bar.dynamics.add<RailOnSupports>(supports, tests::steel());
    bar.dynamics.guide_nodes(bar.dynamics.boundary_nodes(0, Boundary::end), 0);
    bar.dynamics.guide_nodes(supports.guided_nodes(1), 1);
    bar.dynamics.start();
    // It comes on smoothly on the first metres; then deflections are taken.
    constexpr double begin = -2.4, full = -.4, from = 1., to = 1.6;
    double           sum = 0., worst = 0.;
    unsigned int     steps  = 0;
    const double     steady = winkler(s, u, c, v), still = winkler(s, u, c, 0.);
    for (double x = begin; x < to; x = begin + v * bar.dynamics.state.time)
      {
        const double t = std::min(1., (x - begin) / (full - begin));
        bar.load(x, force * t * t * (3. - 2. * t));
        bar.dynamics.step();
        if (x > from)
          {
            const double w = bar.deflection(begin + v * bar.dynamics.state.time);
            sum += w;
            worst = std::max(worst, std::abs(w / steady - 1.));
            ++steps;
          }
      }
    std::printf("speed %.1f m/s, critical %.1f m/s; deflection at rest %.4f mm\n", v, critical, 1e3 * still);
    check.relative("Winkler's foundation: deflection under the force (mm)", 1e3 * sum / steps, 1e3 * steady,
                   .02);
    check.below("Winkler's foundation: largest deviation from the steady state", worst, .02);
    check.that("Winkler's foundation: a force at rest is told from it", std::abs(still / steady - 1.) > .05);
  }

  /// Sleepers of 10 g on stiff ballast, stiffer and more damped under one of them, are faster than the cells:
  /// a mass m between pad and ground is followed with steps up to 4/(C + (C^2 + 4 K)^1/2), with the row sums
  /// K = (2 pad + ballast)/m of the stiffness and C of the damping.
  void light_sleepers(tests::Check &check)
  {
    constexpr double          mass = .01;
    TrackParameters           track;
    TrackParameters::Springs &springs = track.springs;
    springs.pad_stiffness             = 90e6;
    springs.ballast_stiffness         = 4e9;
    springs.pad_damping = springs.ballast_damping = 0.;
    track.sleeper_mass                            = mass;
    track.pad_length                              = .02;
    track.pad_width                               = .03;
    track.points_along                            = 1;
    track.points_across                           = 2;
    const auto critical                           = [&] {
      Bar      bar(1.2, 24);
      Supports supports(bar.mesh, 0, {-.4, 0., .4}, track);
      bar.dynamics.add<RailOnSupports>(supports, tests::steel());
      return bar.dynamics.critical_step().seconds();
    };
    const double of_cells = Bar(1.2, 24).dynamics.critical_step().seconds();
    const auto   expected = [&](const TrackParameters::Springs &own) {
      const double K = (2. * own.pad_stiffness + own.ballast_stiffness) / mass +
                       4. / (of_cells * of_cells), // both in turn, as the bound has them
        C = (2. * own.pad_damping + own.ballast_damping) / mass;
      return 4. / (C + std::sqrt(C * C + 4. * K));
    };
    check.relative("light sleepers: critical time step, us", 1e6 * critical(), 1e6 * expected(springs), 0.01);
    track.exceptions[1] = {springs.pad_stiffness, 12e9, 0., 9e3, 0.};
    check.relative("one of them on stiffer ballast: critical time step, us", 1e6 * critical(),
                   1e6 * expected(track.exceptions[1]), 0.01);
    check.that("they are faster than the cells", 1.5 * expected(springs) < of_cells);
  }
} // namespace track_moving_load


TREAD_TEST(track_moving_load)(tests::Check &check, const tests::Arguments &)
{
  simply_supported(check);
  on_foundation(check);
  light_sleepers(check);
}
