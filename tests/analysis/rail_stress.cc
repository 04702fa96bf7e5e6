// SPDX-License-Identifier: LGPL-2.1-or-later
// Largest von Mises stress under a path, in layers of a region and at its surface, and stress of chosen
// cells, in a block that is stretched by a known field: cells of two sizes, on several ranks.
#include <tread/analysis/rail_stress.h>
#include <tread/analysis/stress_peaks.h>

#include <deal.II/base/mpi.h>

#include "boxes.h"
#include "check.h"
#include "reopened.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

using namespace tread;
using dealii::Point;

namespace analysis_rail_stress
{
  constexpr double length = 0.06, half_width = 0.015, coarse = 5e-3, fine = 2.5e-3;

  /// Stretch along x: u_x = rise X^2/2 (1 - slope Z) (1 + tilt Y) from the front or the rear end, X the
  /// distance from it.
  struct Field
  {
    double rise;
    bool   from_rear;

    static constexpr double slope = 40., tilt = 2.;

    double displacement(const Point<3> &p) const
    {
      const double s = from_rear ? length - p[0] : p[0];
      return (from_rear ? -1. : 1.) * 0.5 * rise * s * s * (1. - slope * p[2]) * (1. + tilt * p[1]);
    }

    /// At a node of the surface, where nothing acts on it: Hooke's law with the logarithmic strains along it.
    StressRecovery::Stress at_surface(const double x, const double y) const
    {
      const double s   = from_rear ? length - x : x;
      const double F11 = 1. + rise * s * (1. + tilt * y),
                   F12 = (from_rear ? -0.5 : 0.5) * rise * s * s * tilt;
      const double E11 = 0.5 * (F11 * F11 - 1.), E12 = 0.5 * F11 * F12, E22 = 0.5 * F12 * F12;
      const double e11 = E11 - E11 * E11 - E12 * E12, e22 = E22 - E22 * E22 - E12 * E12,
                   e12 = E12 - E12 * (E11 + E22);
      const ElasticMaterial steel;
      const double          factor = steel.young_modulus / (1. - steel.poisson_ratio * steel.poisson_ratio);
      return {{factor * (e11 + steel.poisson_ratio * e22), factor * (e22 + steel.poisson_ratio * e11), 0.,
               2. * steel.shear_modulus() * e12, 0., 0.}};
    }

    /// Mean of the four cells around an edge into depth.
    StressRecovery::Stress at_edge(const double x, const double y, const double z, const double edge) const
    {
      StressRecovery::Stress mean{};
      for (const double along : {-0.5, 0.5})
        for (const double across : {-0.5, 0.5})
          {
            const auto of_cell = stress(x + along * edge, y + across * edge, z, edge);
            for (unsigned int k = 0; k < 6; ++k)
              mean[k] += 0.25 * of_cell[k];
          }
      return mean;
    }

    double von_mises(const double x, const double y, const double z, const double edge) const
    {
      return tread::von_mises(stress(x, y, z, edge));
    }

    /// Of the cell with this centre and edge. Means of the trilinear field's gradient, then Cauchy's stress
    /// of Hencky's law.
    StressRecovery::Stress stress(const double x, const double y, const double z, const double edge) const
    {
      const double s = from_rear ? length - x : x;
      const double a = s - 0.5 * edge, b = s + 0.5 * edge;
      const double sign = from_rear ? -1. : 1.;

      dealii::Tensor<2, 3> F, E;
      F[0][0] = 1. + rise * s * (1. - slope * z) * (1. + tilt * y);
      F[0][1] = sign * 0.5 * rise * (1. - slope * z) * tilt * 0.5 * (a * a + b * b);
      F[0][2] = -sign * 0.5 * rise * slope * (1. + tilt * y) * 0.5 * (a * a + b * b);
      F[1][1] = F[2][2] = 1.;
      E                 = 0.5 * (transpose(F) * F);
      for (unsigned int i = 0; i < 3; ++i)
        E[i][i] -= 0.5;
      const ElasticMaterial      steel;
      const double               mu = steel.shear_modulus(), lambda = steel.lame();
      const dealii::Tensor<2, 3> square = E * E;
      dealii::Tensor<2, 3>       S      = (2. * mu - 2. * lambda * trace(E)) * E - 6. * mu * square;
      for (unsigned int i = 0; i < 3; ++i)
        S[i][i] += lambda * (trace(E) - trace(square));
      const dealii::Tensor<2, 3> T = F * S * transpose(F) / determinant(F);
      return {{T[0][0], T[1][1], T[2][2], T[0][1], T[1][2], T[2][0]}};
    }
  };

  void take(ExplicitDynamics &dynamics, const Field &field, const double time)
  {
    for (unsigned int i = 0; i < dynamics.state.v.size(); ++i)
      {
        Vector3 x = dynamics.state.position(i);
        x[0]      = dynamics.mesh.nodes[i][0] + field.displacement(dynamics.mesh.nodes[i]);
        dynamics.state.set_position(i, x);
      }
    dynamics.state.time = time;
  }

  void check_strip(tests::Check &check, ExplicitDynamics &dynamics)
  {
    const MPI_Comm    comm = dynamics.mesh.comm;
    const StripExtent extent{-1., 1., 0., 6e-3, 8e-3, [](const Point<3> &p) {
                               return -p[2];
                             }};
    const Field       first{0.1, false}, second{0.15, true};
    StressStrip       strip(dynamics.mesh, dynamics.solid, nullptr, 0, ElasticMaterial(), extent);
    take(dynamics, first, 1.);
    strip.sample(dynamics, {}, 10.);

    // A strip that goes on from what the first has stored.
    StressStrip resumed(dynamics.mesh, dynamics.solid, nullptr, 0, ElasticMaterial(), extent);
    Archive     stored(comm);
    strip.serialize(stored);
    Archive archive(comm, tests::parts_of(stored, comm));
    resumed.serialize(archive);
    take(dynamics, second, 2.);
    strip.sample(dynamics, {}, 20.);
    resumed.sample(dynamics, {}, 20.);
    // What a strip over the rear felt of the first field, and one over the front, which goes on from it, of
    // the second.
    const auto part = [&](const double begin, const double end) {
      StripExtent of_part = extent;
      of_part.x_begin     = begin;
      of_part.x_end       = end;
      return StressStrip(dynamics.mesh, dynamics.solid, nullptr, 0, ElasticMaterial(), of_part);
    };
    constexpr double border = 0.03, over = 5e-3;
    StressStrip rear = part(-1., border + over), front = part(border - over, 1.), of_first = part(-1., 1.),
                of_second = part(-1., 1.);
    of_second.sample(dynamics, {}, 20.);
    take(dynamics, first, 1.);
    of_first.sample(dynamics, {}, 10.);
    rear.sample(dynamics, {}, 10.);
    front.take_over(rear);
    take(dynamics, second, 2.);
    front.sample(dynamics, {}, 20.);

    const auto columns = strip.columns(dynamics), again = resumed.columns(dynamics),
               both = front.columns(dynamics), at_first = of_first.columns(dynamics),
               at_second = of_second.columns(dynamics);
    if (dealii::Utilities::MPI::this_mpi_process(comm) != 0)
      return;

    check.that("a strip that goes on from another has the columns of both", both.size() == columns.size());
    double merged = 0.;
    for (unsigned int i = 0; i < both.size(); ++i)
      for (const StressPeak StripColumn::*peak : {&StripColumn::largest, &StripColumn::at_surface})
        {
          // Cells that lie across the ends of the parts belong to neither.
          const double x = both[i].x, here = (both[i].*peak).stress, one = (at_first[i].*peak).stress,
                       two = (at_second[i].*peak).stress;
          if (std::abs(std::abs(x - border) - over) < coarse)
            continue;
          merged = std::max(merged, std::abs(here / (x > border + over   ? two
                                                     : x < border - over ? one
                                                                         : std::max(one, two)) -
                                             1.));
        }
    check.below("and the largest stresses of both, share", merged, 1e-12);

    check.that("a column for each cell at the surface along the path", columns.size() == 24);
    double place = 0., surface = 0., largest = 0., resumption = 0.;
    bool   times = true, depths = true, across = true;
    for (unsigned int i = 0; i < columns.size(); ++i)
      {
        const StripColumn &column = columns[i];
        const double       x = (i + 0.5) * fine, x_below = (i / 2 + 0.5) * coarse;
        place                 = std::max(place, std::abs(column.x / x - 1.));
        double     at_surface = 0., most = 0., depth = 0., time = 0., y_most = 0., y_at_surface = 0.;
        const auto look = [&](const double centre, const double z, const double edge) {
          // Largest at the side to which the field rises: the farthest centres within 6 mm.
          const double y         = edge == fine ? 1.5 * fine : 0.5 * coarse;
          const double values[2] = {first.von_mises(centre, y, z, edge),
                                    second.von_mises(centre, y, z, edge)};
          for (unsigned int k = 0; k < 2; ++k)
            {
              if (values[k] > most)
                {
                  y_most = y;
                  most   = values[k];
                  depth  = -z;
                  time   = k + 1.;
                }
            }
        };
        // Both nodes of the cell along the path, and the farthest within 6 mm to that side.
        y_at_surface = 2. * fine;
        for (const double node : {x - 0.5 * fine, x + 0.5 * fine})
          for (const Field &field : {first, second})
            at_surface = std::max(at_surface, von_mises(field.at_surface(node, y_at_surface)));
        look(x, -0.5 * fine, fine);
        look(x, -1.5 * fine, fine);
        look(x_below, -1.5 * coarse, coarse);
        // Around nodes at the ends of the block there are faces on one side only.
        if (i > 0 && i + 1 < columns.size())
          surface = std::max(surface, std::abs(column.at_surface.stress / at_surface - 1.));
        largest = std::max(largest, std::abs(column.largest.stress / most - 1.));
        across =
          across && std::abs(column.y - y_most) < 1e-9 && std::abs(column.y_at_surface - y_at_surface) < 1e-9;
        times      = times && column.largest.time == time && column.largest.wheel_x == 10. * time;
        depths     = depths && std::abs(column.depth - depth) < 1e-9;
        resumption = std::max(resumption, std::abs(again[i].largest.stress / column.largest.stress - 1.));
      }
    // Round-off of positions (1e-17 m) over strains of 1e-4 in cells of 2.5 mm.
    check.below("middles of the columns, share", place, 1e-12);
    // Strains are means over faces: shear is a few hundredths of the stretch, and 0.2 % off at most.
    check.below("largest at the surface, share", surface, 1e-4);
    check.below("largest at any depth, share", largest, 1e-9);
    check.that("its time and the wheel's place", times);
    check.that("its depth", depths);
    check.that("its place across the rail, and that of the largest at the surface", across);
    check.below("restored and gone on, share", resumption, 1e-15);
  }

  void check_probes(tests::Check &check, ExplicitDynamics &dynamics)
  {
    const Field field{0.1, false};
    take(dynamics, field, 3.);
    // In a cell of each size, and on a corner that eight cells share: any of them.
    const CellProbes probes(
      dynamics.mesh, 0,
      {Point<3>(31.2e-3, 1e-3, -1e-3), Point<3>(31e-3, 1e-3, -12e-3), Point<3>(30e-3, 0., -2.5e-3)});
    const auto records = probes.record(dynamics);
    check.absolute("centre of a fine cell: x, mm", 1e3 * probes.centres()[0][0], 31.25, 1e-6);
    check.absolute("centre of a fine cell: z, mm", 1e3 * probes.centres()[0][2], -1.25, 1e-6);
    check.absolute("centre of a coarse cell: x, mm", 1e3 * probes.centres()[1][0], 32.5, 1e-6);
    check.absolute("centre of a coarse cell: z, mm", 1e3 * probes.centres()[1][2], -12.5, 1e-6);
    check.absolute("cell beside a corner: x from it, mm", std::abs(1e3 * probes.centres()[2][0] - 30.), 1.25,
                   1e-6);
    const double edges[3] = {fine, coarse, fine};
    for (unsigned int i = 0; i < 3; ++i)
      check.relative(
        "von Mises stress of cell " + std::to_string(i + 1), records[i].von_mises,
        field.von_mises(probes.centres()[i][0], probes.centres()[i][1], probes.centres()[i][2], edges[i]),
        1e-9);
    const std::string said = tests::complaint<std::out_of_range>([&] {
      CellProbes(dynamics.mesh, 0, {Point<3>(31e-3, 0., -1e-3), Point<3>(31e-3, 0., 1e-3)});
    });
    check.that("a point above the block is refused by its number", said == "2");
  }

  PeakRegion region_of_peaks()
  {
    return {0.02,
            0.04,
            4e-3,
            10e-3,
            fine,
            5e-3,
            [](const Point<3> &p) { return p[0]; },
            [](const Point<3> &p) { return p[1]; },
            [](const Point<3> &p) {
              return -p[2];
            }};
  }

  /// Cells with long steps, below the fine ones, are looked at when all nodes are at the same instant.
  void check_peaks_between_steps(tests::Check &check, const Mesh &mesh)
  {
    SolidParameters parameters;
    parameters.max_level = 1;
    const Solid      solid(mesh, {ElasticMaterial()}, parameters);
    ExplicitDynamics dynamics(mesh, solid, DynamicsParameters());
    StressPeaks      peaks(dynamics, nullptr, true, 0, ElasticMaterial(), region_of_peaks());
    dynamics.state.n_steps = 1;
    take(dynamics, Field{0.1, false}, 1.);
    peaks.sample(dynamics, {}, {}, 10.);
    dynamics.state.n_steps = 2;
    take(dynamics, Field{0.09, false}, 2.);
    peaks.sample(dynamics, {}, {}, 20.);
    const StressPeaks::Answer answer = peaks.answer(dynamics);
    check.that("peaks between steps: three layers", answer.layers.size() == 3);
    for (unsigned int k = 0; k < std::min<std::size_t>(3, answer.layers.size()); ++k)
      check.absolute("peaks between steps: time of layer " + std::to_string(k + 1),
                     answer.layers[k].peak.time, k < 2 ? 1. : 2., 0.);
    check.absolute("peaks between steps: time of that at the surface", answer.surface.peak.time, 1., 0.);
  }

  void check_peaks(tests::Check &check, ExplicitDynamics &dynamics)
  {
    const MPI_Comm   comm   = dynamics.mesh.comm;
    const PeakRegion region = region_of_peaks();
    const Field      first{0.1, false}, second{0.09, true};
    StressPeaks      peaks(dynamics, nullptr, true, 0, ElasticMaterial(), region);
    check.that("peaks: a wheel is near up to the reach, and no farther",
               peaks.concerns(0.0151) && peaks.concerns(0.0449) && !peaks.concerns(0.0149) &&
                 !peaks.concerns(0.0451));
    take(dynamics, first, 1.);
    peaks.sample(dynamics, {}, {}, 10.);
    StressPeaks resumed(dynamics, nullptr, true, 0, ElasticMaterial(), region);
    Archive     stored(comm);
    peaks.serialize(stored);
    Archive archive(comm, tests::parts_of(stored, comm));
    resumed.serialize(archive);
    take(dynamics, second, 2.);
    peaks.sample(dynamics, {}, {}, 20.);
    resumed.sample(dynamics, {}, {}, 20.);
    const StressPeaks::Answer answer = peaks.answer(dynamics), again = resumed.answer(dynamics);

    // The first field is the larger one, at the region's end; of the nodes within 4 mm of the middle the
    // largest are those to the side to which the field rises. Coarse cells have the stress of their centres.
    const double x_end = 0.04, y_fine = fine;
    check.that("peaks: three layers, two of them fine", answer.layers.size() == 3);
    const double                 depths[3]   = {0.5 * fine, 1.5 * fine, 1.5 * coarse};
    const StressRecovery::Stress surface     = first.at_surface(x_end, y_fine);
    StressRecovery::Stress       stresses[3] = {
            first.at_edge(x_end, y_fine, -depths[0], fine), first.at_edge(x_end, y_fine, -depths[1], fine),
            first.stress(x_end - 0.5 * coarse, 0.5 * coarse, -depths[2], coarse)};
    // The uppermost one without half the square of its depth times the second derivative over depth.
    for (unsigned int c = 0; c < 6; ++c)
      stresses[0][c] -= (stresses[1][c] - 3. * stresses[0][c] + 2. * surface[c]) / 6.;
    double expected[3];
    for (unsigned int k = 0; k < 3; ++k)
      expected[k] = von_mises(stresses[k]);
    for (unsigned int k = 0; k < std::min<std::size_t>(3, answer.layers.size()); ++k)
      {
        const Peak       &peak = answer.layers[k].peak;
        const std::string name = "peaks: layer " + std::to_string(k + 1) + ": ";
        check.relative(name + "stress", peak.value, expected[k], k == 0 ? 1e-6 : 1e-9);
        check.relative(name + "depth", peak.depth, depths[k], 1e-9);
        check.relative(name + "x", peak.x, k < 2 ? x_end : x_end - 0.5 * coarse, 1e-9);
        check.that(name + "instant, and where the wheel was", peak.time == 1. && peak.wheel_x == 10.);
        check.relative(name + "strain of Hooke's law", answer.layers[k].equivalent_strain,
                       peak.value / (3. * ElasticMaterial().shear_modulus()), 1e-12);
        check.relative(name + "restored and gone on", again.layers[k].peak.value, peak.value, 1e-15);
      }
    check.relative("peaks: at the surface", answer.surface.peak.value, von_mises(surface), 1e-6);
    check.relative("peaks: at the surface: x", answer.surface.peak.x, x_end, 1e-9);
    check.that("peaks: not that of the first layer", answer.surface.peak.value < 0.99 * expected[0] ||
                                                       answer.surface.peak.value > 1.01 * expected[0]);
  }

  /// A wheel that presses and drives the surface at one instant and has left it at the next, when the block
  /// is stretched along: there nothing acts on the surface, whatever did before.
  void check_surface_that_is_left(tests::Check &check, ExplicitDynamics &dynamics)
  {
    const Mesh   &mesh = dynamics.mesh;
    const Contact contact(mesh, ContactParameters(), std::make_shared<CoulombFriction>(0.3));
    StressPeaks   peaks(dynamics, &contact, true, 0, ElasticMaterial(), region_of_peaks());
    dynamics.state.time_step  = 1e-7;
    constexpr double pressure = 300e6, shear = 50e6, area = 6e-6, strain = 1e-3;
    const auto       stretch = [&](const double share, const double time) {
      for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
        {
          const Point<3> &p = mesh.nodes[i];
          dynamics.state.set_position(i, Vector3{(1. + share) * p[0], p[1], p[2], 0.});
        }
      dynamics.state.time = time;
    };
    std::vector<ContactNodeState> states;
    // What acts on the nodes is given over the areas that belong to them in the mesh.
    std::vector<Vector3> impulses(contact.surfaces.nodes.size(), fine * fine * dynamics.state.time_step *
                                                                   Vector3{-shear, 0., -pressure, 0.});
    for (unsigned int k = 0; k < contact.surfaces.nodes.size(); ++k)
      {
        ContactNodeState state{};
        state.node     = k;
        state.position = contact.surfaces.nodes[k].reference;
        state.normal   = Vector3{0., 0., 1., 0.};
        state.area     = area;
        state.impulse  = area * dynamics.state.time_step * Vector3{shear, 0., pressure, 0.};
        states.push_back(state);
      }
    stretch(0., 1.);
    peaks.sample(dynamics, states, impulses, 10.);
    const Peak pressed   = peaks.answer(dynamics).from_tractions,
               recovered = peaks.answer(dynamics).surface.peak;
    stretch(strain, 2.);
    peaks.sample(dynamics, {}, {}, 20.);
    const StressPeaks::Answer answer = peaks.answer(dynamics);
    // Hooke's law with no strain along the surface, then with no stress across it. Strains are logarithmic,
    // to second order: 4/3 of the square of 0.1 % is left.
    const double nu = ElasticMaterial().poisson_ratio, E = ElasticMaterial().young_modulus;
    check.relative("surface: under the wheel, MPa", 1e-6 * pressed.value,
                   1e-6 * std::hypot(pressure * (1. - 2. * nu) / (1. - nu), std::sqrt(3.) * shear), 1e-12);
    check.relative("surface: the same recovered at its nodes, MPa", 1e-6 * recovered.value,
                   1e-6 * pressed.value, 1e-9);
    check.relative("surface: recovered when the wheel has left, MPa", 1e-6 * answer.surface.peak.value,
                   1e-6 * answer.from_tractions.value, 1e-8);
    check.relative("surface: stretched when the wheel has left, MPa", 1e-6 * answer.from_tractions.value,
                   1e-6 * E / (1. - nu * nu) * std::sqrt(1. - nu + nu * nu) * std::log1p(strain), 2e-6);
    check.that("surface: the latter is larger", answer.from_tractions.value > pressed.value);
    check.absolute("surface: its time", answer.from_tractions.time, 2., 0.);
    check.relative("surface: largest pressure, MPa", 1e-6 * answer.pressure.value, 1e-6 * pressure, 1e-12);
    check.relative("surface: largest shear stress, MPa", 1e-6 * answer.shear.value, 1e-6 * shear, 1e-12);
  }

  /// Face of the surface in the plane z = 0, deformed by a known stretch and turned.
  void check_face(tests::Check &check)
  {
    const ElasticMaterial  steel;
    const double           mu = steel.shear_modulus(), lambda = steel.lame();
    std::array<Vector3, 4> reference{
      {{0., 0., 0., 0.}, {1e-3, 0., 0., 0.}, {1.2e-3, 0.8e-3, 0., 0.}, {0.2e-3, 0.8e-3, 0., 0.}}};
    const double e1 = 2e-3, e2 = -3e-3, p = 1.2e9, q = 3e8;
    // Principal logarithmic strains e1, e2 along x and y, then turned about x by a fifth and about z by a
    // tenth.
    std::array<Vector3, 4> current;
    for (unsigned int a = 0; a < 4; ++a)
      {
        const double x = std::exp(e1) * reference[a][0], y = std::exp(e2) * reference[a][1];
        const double turned_y = std::cos(0.2) * y, z = std::sin(0.2) * y;
        current[a] = Vector3{std::cos(0.1) * x - std::sin(0.1) * turned_y,
                             std::sin(0.1) * x + std::cos(0.1) * turned_y, z, 0.};
      }
    const double e3       = (-p - lambda * (e1 + e2)) / (lambda + 2. * mu);
    const double expected = von_mises(
      {{lambda * (e1 + e2 + e3) + 2. * mu * e1, lambda * (e1 + e2 + e3) + 2. * mu * e2, -p, 0., q, 0.}});
    // To second order in strains of 0.3 %.
    check.relative("face: stress from stretch, pressure and shear",
                   von_mises_at_face(reference, current, steel, p, q), expected, 3e-5);
    // The same principal strains, turned by 0.5 in the face.
    const double c = std::cos(0.5), s = std::sin(0.5), along = std::exp(e1), across = std::exp(e2);
    for (unsigned int a = 0; a < 4; ++a)
      {
        const double x = reference[a][0], y = reference[a][1];
        current[a] = Vector3{(c * c * along + s * s * across) * x + c * s * (along - across) * y,
                             c * s * (along - across) * x + (s * s * along + c * c * across) * y, 0., 0.};
      }
    check.relative("face: the same in other directions", von_mises_at_face(reference, current, steel, p, 0.),
                   von_mises({{lambda * (e1 + e2 + e3) + 2. * mu * e1, lambda * (e1 + e2 + e3) + 2. * mu * e2,
                               -p, 0., 0., 0.}}),
                   3e-5);
    check.relative("face: nothing but shear", von_mises_at_face(reference, reference, steel, 0., q),
                   std::sqrt(3.) * q, 1e-12);
  }
} // namespace analysis_rail_stress

TREAD_TEST(analysis_rail_stress)(tests::Check &check, const tests::Arguments &)
{
  Body body =
    tests::make_box("block", Point<3>(0., -half_width, -0.02), Point<3>(length, half_width, 0.), {{12, 6, 4}},
                    {{tests::Side::left, Boundary::end},
                     {tests::Side::right, Boundary::end},
                     {tests::Side::bottom, Boundary::support},
                     {tests::Side::top, Boundary::contact}});
  body.wanted_cell_size = [](const Point<3> &p) {
    return p[2] > -0.9 * coarse ? fine : std::numeric_limits<double>::max();
  };
  const Mesh       mesh(MPI_COMM_WORLD, {body});
  const Solid      solid(mesh, {ElasticMaterial()}, SolidParameters());
  ExplicitDynamics dynamics(mesh, solid, DynamicsParameters());
  check_strip(check, dynamics);
  check_probes(check, dynamics);
  check_peaks(check, dynamics);
  check_peaks_between_steps(check, mesh);
  check_surface_that_is_left(check, dynamics);
  check_face(check);
}
