// SPDX-License-Identifier: LGPL-2.1-or-later
// Eigenmodes of bodies that stand alone against closed forms: a ring (bending in its plane and extension), a
// rail and a sleeper (Timoshenko's beam with free ends), rigid motions, a wheel between axle and sprung mass.
// They converge as cells become smaller. Then a track of cells: its receptance from modes against hammer
// blows in the time domain (doc/track.md), and the same modes on several ranks.
#include <tread/analysis/modes.h>
#include <tread/analysis/seat_modes.h>
#include <tread/mesh/sleeper_body.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include "check.h"
#include "driven_ring.h"
#include "fields.h"
#include "receptance.h"

#include <algorithm>
#include <memory>

using namespace tread;

namespace analysis_modes
{
  constexpr double pi = dealii::numbers::PI;

  /// A body alone in space and its modes.
  struct FreeBody
  {
    Mesh                   mesh;
    ElasticSystem          system;
    std::unique_ptr<Modes> modes;

    FreeBody(const Body &body, const ElasticMaterial &material, const double up_to)
      : mesh(MPI_COMM_SELF, {body})
      , system(mesh, {true}, {material}, SolidParameters())
    {
      system.assemble();
      modes = std::make_unique<Modes>(system, up_to);
    }

    /// Frequencies (Hz) of modes with more than this share of their kinetic energy in directions with these
    /// weights; without the rigid motions.
    std::vector<double> frequencies(const Vector3 directions, const double share) const
    {
      std::vector<double> chosen;
      for (unsigned int k = 6; k < modes->size(); ++k)
        {
          ElasticSystem::RigidParts parts;
          const NodalField          u   = modes->shape(k, parts);
          double                    sum = 0.;
          for (unsigned int i = 0; i < u.size(); ++i)
            sum += system.masses()[i] * dot(u[i] * directions, u[i]);
          if (sum > share)
            chosen.push_back(modes->frequency(k));
        }
      return chosen;
    }
  };

  /// Frequency (Hz) of Timoshenko's beam with free ends, in the n-th bending mode (1, 2, ...). About the
  /// middle the deflection is A ch(l x) + B cos(k x) or A sh(l x) + B sin(k x); moment and shear force vanish
  /// at the end.
  double free_beam(const reference::BeamSection &s, const double length, const unsigned int n)
  {
    const double a = s.mass / s.shear_stiffness, b = s.rotary_inertia / s.bending_stiffness;
    const auto   determinant = [&](const double omega, const bool symmetric) {
      const double w2   = omega * omega;
      const double root = std::sqrt((a - b) * (a - b) * w2 * w2 + 4. * w2 * s.mass / s.bending_stiffness);
      const double l = std::sqrt(.5 * (root - (a + b) * w2)), k = std::sqrt(.5 * (root + (a + b) * w2));
      const double h = .5 * length, bend_l = l * l + a * w2, bend_k = a * w2 - k * k;
      return symmetric ? bend_l / k * std::sin(k * h) - bend_k / l * std::cos(k * h) * std::tanh(l * h)
                         : bend_l / k * std::tanh(l * h) * std::cos(k * h) + bend_k / l * std::sin(k * h);
    };
    const bool symmetric = n % 2 == 1;
    // Below Euler's frequency, which is higher.
    const double step  = std::sqrt(s.bending_stiffness / s.mass) / (length * length) * .01;
    unsigned int found = 0;
    for (double omega = 100. * step;; omega += step)
      if (determinant(omega, symmetric) * determinant(omega + step, symmetric) < 0. && ++found == (n + 1) / 2)
        {
          double low = omega, high = omega + step;
          for (unsigned int i = 0; i < 60; ++i)
            (determinant(low, symmetric) * determinant(.5 * (low + high), symmetric) < 0. ? high : low) =
              .5 * (low + high);
          return low / (2. * pi);
        }
  }

  void rigid_motions(tests::Check &check, const std::string &name, const Modes &modes)
  {
    double largest = 0.;
    for (unsigned int k = 0; k < 6; ++k)
      largest = std::max(largest, std::sqrt(std::abs(modes.eigenvalue(k))) / (2. * pi));
    // The root of rounding: K has entries 1e16 times its lowest elastic eigenvalue times mass.
    check.below(name + ": rigid motions, largest frequency (Hz)", largest, .005);
    check.below(name + ": Phi^T M Phi - 1, largest entry", modes.orthogonality_error(), 1e-8);
  }

  void ring(tests::Check &check)
  {
    constexpr double      outer = .462, inner = .438, R = .5 * (outer + inner), h = outer - inner;
    const ElasticMaterial material  = tests::steel();
    const double          speed     = std::sqrt(material.young_modulus / material.density);
    double                before[3] = {};
    for (const unsigned int layers : {2, 4})
      {
        const std::string name = "ring, " + std::to_string(layers) + " layers";
        const FreeBody    ring(tests::make_ring(outer, inner, .012, {{120 * layers, layers / 2, layers}}),
                               material, 1900.);
        rigid_motions(check, name, *ring.modes);
        const auto in_plane = ring.frequencies(Vector3{1., 0., 1., 0.}, .9);
        // Extension: the mode in which all nodes move outwards.
        double extension = 0., most = 0.;
        for (unsigned int k = 0; k < ring.modes->size(); ++k)
          {
            ElasticSystem::RigidParts parts;
            const NodalField          u   = ring.modes->shape(k, parts);
            double                    sum = 0.;
            for (unsigned int i = 0; i < u.size(); ++i)
              sum += ring.system.masses()[i] *
                     (u[i][0] * ring.mesh.nodes[i][0] + u[i][2] * ring.mesh.nodes[i][2]) / R;
            if (std::abs(sum) > most)
              {
                most      = std::abs(sum);
                extension = ring.modes->frequency(k);
              }
          }
        const auto bending = [&](const double n) {
          return speed * h / std::sqrt(12.) / (R * R) * n * (n * n - 1.) / std::sqrt(n * n + 1.) / (2. * pi);
        };
        // Cells are nearly cubes: the hourglass stiffness of stretched ones depends on how they are turned.
        // Shear and rotary inertia, which the closed forms leave out, lower bending by some 0.2 and 0.5 %.
        const double computed[3] = {in_plane.at(0), in_plane.at(2), extension},
                     closed[3]   = {bending(2.), bending(3.), speed / R / (2. * pi)};
        const char *what[3]      = {"bending, 2 nodal diameters (Hz)", "bending, 3 nodal diameters (Hz)",
                                    "extension (Hz)"};
        for (unsigned int k = 0; k < 3; ++k)
          {
            const double error = computed[k] / closed[k] - 1.;
            std::printf("%s: %s: %.3f, closed form %.3f, %+.2f %%\n", name.c_str(), what[k], computed[k],
                        closed[k], 100. * error);
            if (layers == 4)
              {
                check.relative(name + ": " + what[k], computed[k], closed[k], .01);
                if (k < 2)
                  check.that(std::string(what[k]) + " converges", std::abs(error) < std::abs(before[k]));
              }
            before[k] = error;
          }
        // 5e-6 here; cells that are four times as long as thick split the pair by 5 %.
        check.relative(name + ": pairs of modes", in_plane.at(1), in_plane.at(0), 1e-4);
      }
  }

  void beams(tests::Check &check)
  {
    {
      const RailProfile profile = RailProfile::rail_60e1();
      const auto        rail    = tests::full_section(profile, 5, .0125, .04, 0.);
      const FreeBody    body(rail.body, tests::steel(), 700.);
      rigid_motions(check, "free rail 60E1, 3 m", *body.modes);
      const auto vertical = body.frequencies(Vector3{0., 0., 1., 0.}, .8);
      for (unsigned int n = 1; n <= 2; ++n)
        check.relative("free rail 60E1, 3 m: vertical bending " + std::to_string(n) + " (Hz)",
                       vertical.at(n - 1), free_beam(rail.section, 3., n), .01);
    }
    double before = 0.;
    for (const double cell : {.06, .03})
      {
        SleeperBox box;
        box.y_begin            = -1.26;
        box.y_end              = 1.26;
        box.width              = .25;
        box.height             = .18;
        box.coarsest_cell_size = cell;
        const ElasticMaterial  concrete{38.4e9, .2, 2520.};
        reference::BeamSection section;
        const double           area = box.width * box.height, second = area * box.height * box.height / 12.;
        section.bending_stiffness = concrete.young_modulus * second;
        section.shear_stiffness   = 10. * 1.2 / (12. + 11. * .2) * concrete.shear_modulus() * area;
        section.mass              = concrete.density * area;
        section.rotary_inertia    = concrete.density * second;
        const FreeBody body(make_sleeper(box), concrete, 400.);
        const auto     vertical = body.frequencies(Vector3{0., 0., 1., 0.}, .8);
        const auto     name     = "sleeper, cells of " + std::to_string(std::lround(1e3 * cell)) + " mm";
        rigid_motions(check, name, *body.modes);
        double worst = 0.;
        for (unsigned int n = 1; n <= 2; ++n)
          {
            const double beam = free_beam(section, 2.52, n), error = vertical.at(n - 1) / beam - 1.;
            worst = std::max(worst, std::abs(error));
            std::printf("%s: bending %u: %.3f Hz, Timoshenko %.3f, %+.2f %%\n", name.c_str(), n,
                        vertical.at(n - 1), beam, 100. * error);
            if (cell < .04)
              check.relative(name + ": bending " + std::to_string(n) + " (Hz)", vertical.at(n - 1), beam,
                             .01);
          }
        if (before > 0.)
          check.that("sleeper converges", worst < before);
        before = worst;
      }
  }

  /// A ring on a hub under a sprung mass.
  struct Wheel
  {
    Mesh          mesh;
    ElasticSystem system;

    explicit Wheel(const MPI_Comm comm)
      : mesh(comm, {tests::make_driven_ring()})
      , system(mesh, {true}, {tests::steel()}, SolidParameters())
    {
      WheelHub hub(tests::sprung_hub());
      hub.place(Vector3{});
      ElasticSystem::HubFreedom freedom;
      freedom.turns = true;
      system.attach_hub(hub, 0, freedom);
      system.assemble();
    }
  };

  void hub(tests::Check &check)
  {
    const Wheel              wheel(MPI_COMM_SELF);
    const Modes              modes(wheel.system, 1800.);
    const WheelHubParameters p = tests::sprung_hub();
    // The rim's spring on the hub is 1e4 times that of the suspension.
    const double relative = std::sqrt(p.suspension_stiffness * (1. / p.mass + 1. / p.sprung_mass));
    check.below("wheel: turning (Hz)", modes.frequency(0), .005);
    check.below("wheel: moving up with the sprung mass (Hz)", modes.frequency(1), .005);
    check.relative("wheel on its suspension (Hz)", modes.frequency(2), relative / (2. * pi), 1e-3);
    check.relative("wheel on its suspension: damping share", modes.damping_share(2),
                   .5 * p.suspension_damping * relative / p.suspension_stiffness, 2e-3);
    double                    whole = 0., turning = 0., off_rigid = 0., largest = 0.;
    ElasticSystem::RigidParts parts;
    // The two rigid motions may be mixed; their modal masses are 1.
    for (const unsigned int mode : {0u, 1u})
      {
        const NodalField shape = modes.shape(mode, parts);
        turning += parts.turn * parts.turn;
        for (unsigned int i = 0; i < shape.size(); ++i)
          {
            const dealii::Point<3> &p = wheel.mesh.nodes[i];
            const Vector3           rigid{parts.turn * p[2], 0., parts.up - parts.turn * p[0], 0.};
            off_rigid = std::max(off_rigid, std::sqrt(dot(shape[i] - rigid, shape[i] - rigid)));
            largest   = std::max(largest, std::sqrt(dot(rigid, rigid)));
          }
      }
    check.below("wheel: rigid motions, rim and bore off those of the hub, share", off_rigid / largest, 1e-5);
    check.relative("wheel: moment of inertia about the axle (kg m2)", 1. / turning, p.moment_of_inertia,
                   1e-4);
    const NodalField u = modes.shape(2, parts);
    for (const double inertia : wheel.system.rigid_inertia(parts))
      whole += inertia;
    for (unsigned int i = 0; i < u.size(); ++i)
      whole += wheel.system.masses()[i] * dot(u[i], u[i]);
    check.relative("wheel on its suspension: modal mass (kg m2)", whole, 1., 1e-9);
  }

  /// Rail and sleepers of a track of the tests, held as in their runs.
  struct Track
  {
    tests::TrackRail rail;
    ElasticSystem    system;

    Track(const MPI_Comm             comm,
          const tests::RailForTrack &cells,
          const unsigned int         n_supports,
          const TrackParameters     &parameters,
          const bool                 solid_sleepers)
      : rail(comm, cells, n_supports, parameters, DynamicsParameters(), {}, solid_sleepers)
      , system(*rail.mesh,
               std::vector<char>(rail.mesh->body_names.size(), true),
               materials(rail),
               SolidParameters())
    {
      system.attach_supports(*rail.supports);
      system.guide_nodes(rail.mesh->boundary_nodes(0, Boundary::end), 0);
      system.guide_nodes(rail.supports->guided_nodes(1), 1);
      for (const SolidSleeper &sleeper : rail.supports->solid_sleepers)
        system.guide_nodes(rail.mesh->boundary_nodes(sleeper.body, Boundary::end), 1);
      if (solid_sleepers)
        system.guide_nodes(rail.supports->guided_nodes(0), 0);
      system.assemble();
    }

    static std::vector<ElasticMaterial> materials(const tests::TrackRail &rail)
    {
      std::vector<ElasticMaterial> list{tests::steel()};
      list.resize(rail.mesh->body_names.size(), {38.4e9, .2, 2520.});
      return list;
    }

    /// Of this rank's own nodes.
    ElasticSystem::Place sections(const double x) const
    {
      ElasticSystem::Place place = rail.sections(x);
      place.erase(
        std::remove_if(place.begin(), place.end(),
                       [&](const auto &entry) { return !rail.mesh->shared_nodes.is_owned(entry.first); }),
        place.end());
      return place;
    }
  };

  /// What the cells answered to hammer blows in the time domain, doc/track.md, section "Hammer blows".
  void track(tests::Check &check)
  {
    constexpr double cell = .0125, row = .04, eta = 200.;
    TrackParameters  areas;
    areas.pad_width           = .13;
    TrackParameters points    = areas;
    points.pad_width          = .02;
    points.points_along       = 1;
    points.points_across      = 2;
    const RailProfile profile = RailProfile::rail_60e1();
    struct Case
    {
      const char            *what;
      const TrackParameters *pads;
      double                 x, from, to, sign, hammer, allowed;
    };
    // The hammer's lines lie 8 Hz apart and are given in whole Hz; the dip of the sleepers is flat.
    const std::vector<Case> cases{
      {"over a sleeper: dip of the sleepers", &areas, 0., 300., 600., -1., 401., .02},
      {"over a sleeper: peak, rail on pads", &areas, 0., 700., 1000., 1., 871., .004},
      {"over a sleeper: pinned-pinned dip", &areas, 0., 1050., 1350., -1., 1214., .004},
      {"at mid-span: peak, rail on pads", &areas, .3, 700., 1000., 1., 883., .004},
      {"at mid-span: pinned-pinned peak", &areas, .3, 1050., 1200., 1., 1101., .004},
      {"at mid-span, points: pinned-pinned peak", &points, .3, 950., 1150., 1., 1075., .004}};
    std::vector<std::complex<double>> omega;
    for (unsigned int k = 0; k < 160; ++k)
      omega.emplace_back(2. * pi * (200. + 8. * k), -eta);
    for (const TrackParameters *pads : {&areas, &points})
      for (const double x : {0., .3})
        {
          if (pads == &points && x == 0.)
            continue;
          const Track track(MPI_COMM_SELF, tests::full_section(profile, 9, cell, row, x), 9, *pads, false);
          const Modes modes(track.system, 1600.);
          tests::Receptance cells{200., 8., modes.receptance(track.sections(x), omega)};
          for (const Case &c : cases)
            if (c.pads == pads && c.x == x)
              check.relative(std::string("60E1, ") + c.what + " (Hz)", cells.extreme(c.from, c.to, c.sign),
                             c.hammer, c.allowed);
        }
  }

  /// A bar with hanging nodes on solid and on rigid sleepers, and the wheel, on all ranks and on one.
  void ranks(tests::Check &check)
  {
    const auto compare = [&](const std::string &name, const auto &together, const auto &alone,
                             const ElasticSystem::Place *place_together,
                             const ElasticSystem::Place *place_alone) {
      Modes several(together.system, 1500.), one(alone.system, 1500.);
      check.absolute(name + ": number of modes", several.size(), one.size(), 0.);
      double worst = 0.;
      for (unsigned int k = 0; k < std::min(several.size(), one.size()); ++k)
        if (std::max(one.frequency(k), several.frequency(k)) > .02) // no rigid motion
          worst = std::max(worst, std::abs(several.frequency(k) - one.frequency(k)) / one.frequency(k));
      check.below(name + ": frequencies against one rank, relative", worst, 1e-6);
      check.below(name + ": Phi^T M Phi - 1, largest entry", several.orthogonality_error(), 1e-8);
      if (!place_alone)
        return;
      several.align(*place_together);
      one.align(*place_alone);
      double difference = 0., largest = 0.;
      for (unsigned int k = 0; k < one.size(); ++k)
        {
          ElasticSystem::RigidParts parts;
          const double a = together.system.displacement_of(*place_together, several.shape(k, parts)),
                       b = alone.system.displacement_of(*place_alone, one.shape(k, parts));
          difference     = std::max(difference, std::abs(a - b));
          largest        = std::max(largest, std::abs(b));
        }
      check.below(name + ": amplitudes of a place against one rank, share", difference / largest, 1e-6);
      const std::vector<std::complex<double>> omega{{2. * pi * 300., 0.}, {2. * pi * 1100., 0.}};
      const auto a = several.receptance(*place_together, omega), b = one.receptance(*place_alone, omega);
      for (unsigned int k = 0; k < omega.size(); ++k)
        check.below(name + ": receptance against one rank, share", std::abs(a[k] - b[k]) / std::abs(b[k]),
                    1e-6);
    };
    TrackParameters pads;
    pads.pad_width = .05;
    for (const bool solid : {false, true})
      {
        auto bar = tests::bar(3, 12);
        tests::refine_near(bar.body, dealii::Point<3>(.3, 0., 0.), .06, .02);
        const Track together(MPI_COMM_WORLD, bar, 3, pads, solid), alone(MPI_COMM_SELF, bar, 3, pads, solid);
        const auto  a = together.sections(.3), b = alone.sections(.3);
        compare(solid ? "solid sleepers" : "rigid sleepers", together, alone, &a, &b);
      }
    compare("wheel", Wheel(MPI_COMM_WORLD), Wheel(MPI_COMM_SELF), nullptr, nullptr);
  }


  /// A solid sleeper on ballast as its pad feels it, with a dozen coordinates, beside all modes of its cells.
  void seat(tests::Check &check, const MPI_Comm comm)
  {
    TrackParameters pads;
    pads.pad_width = .05;
    const tests::TrackRail rail(comm, tests::bar(3, 12), 3, pads, DynamicsParameters(), {}, true);
    const Mesh            &mesh    = *rail.mesh;
    const SolidSleeper     sleeper = rail.supports->solid_sleepers[1];
    TrackParameters        bare    = pads;
    bare.springs.pad_stiffness = bare.springs.pad_damping = 0.;
    const Supports    support(mesh, 0, {rail.positions[1]}, bare, {sleeper});
    std::vector<char> with_body(mesh.body_names.size(), false);
    with_body[sleeper.body] = true;
    ElasticSystem system(mesh, with_body, Track::materials(rail), SolidParameters());
    system.attach_supports(support);
    system.guide_nodes(support.guided_nodes(0), 0);
    system.guide_nodes(mesh.boundary_nodes(sleeper.body, Boundary::end), 1);
    system.assemble();
    ElasticSystem::Place seat;
    for (const Supports::Link &link : support.links())
      if (link.layer == Supports::pad)
        for (const auto &[node, share] : link.nodes)
          if (mesh.node_bodies[node] == sleeper.body)
            seat.emplace_back(node, std::abs(share) / (bare.points_along * bare.points_across));
    double shares = 0., mass = 0.;
    for (const auto &entry : seat)
      shares += entry.second;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (mesh.shared_nodes.is_owned(i))
        mass += system.masses()[i];
    mass = dealii::Utilities::MPI::sum(mass, comm);
    check.relative("seat: shares of the nodes", dealii::Utilities::MPI::sum(shares, comm), 1., 1e-9);

    const SleeperModes reduced =
      modes_at_seat(mesh, 0, sleeper, rail.positions[1], pads, Track::materials(rail), SolidParameters());
    const Modes                       modes(system, 4000.);
    const std::vector<double>         frequencies{1., 60., 300., 700., 1200., 2000.}; // Hz
    std::vector<std::complex<double>> omega;
    for (const double frequency : frequencies)
      omega.emplace_back(2. * pi * frequency, 0.);
    const std::vector<std::complex<double>> all = modes.receptance(seat, omega);
    const unsigned int                      n   = reduced.size();
    check.that("seat: coordinates that the pad feels",
               n > 6 && n <= 12 && *std::max_element(reduced.mass.begin(), reduced.mass.end()) < 1e8);
    for (unsigned int line = 0; line < omega.size(); ++line)
      {
        dealii::LAPACKFullMatrix<std::complex<double>> matrix(n);
        dealii::Vector<std::complex<double>>           answer(n);
        for (unsigned int i = 0; i < n; ++i)
          {
            for (unsigned int j = 0; j < n; ++j)
              matrix(i, j) = std::complex<double>(0., 1.) * omega[line] * reduced.damping[i * n + j];
            matrix(i, i) += reduced.stiffness[i] - omega[line] * omega[line] * reduced.mass[i];
            answer(i) = 1.;
          }
        matrix.compute_lu_factorization();
        matrix.solve(answer);
        std::complex<double> sum = 0.;
        for (unsigned int i = 0; i < n; ++i)
          sum += answer(i);
        check.below("seat: receptance at " + std::to_string(std::lround(frequencies[line])) +
                      " Hz beside all modes, share",
                    std::abs(sum - all[line]) / std::abs(all[line]), 2e-3);
      }
    // On ballast it sinks under its weight nearly as a rigid one does.
    double sunk = 0.;
    for (unsigned int i = 0; i < n; ++i)
      sunk += reduced.weighing[i] / mass / reduced.stiffness[i];
    check.relative("seat: sinks under its weight of 1 N, nm", 1e9 * sunk,
                   1e9 / bare.springs.ballast_stiffness, 0.05);
  }
} // namespace analysis_modes


TREAD_TEST(analysis_modes)(tests::Check &check, const tests::Arguments &arguments)
{
  if (arguments.empty())
    {
      ranks(check);
      seat(check, MPI_COMM_WORLD);
    }
  for (const std::string &part : arguments)
    if (part == "ring")
      ring(check);
    else if (part == "beams")
      beams(check);
    else if (part == "hub")
      hub(check);
    else if (part == "track")
      track(check);
}
