// SPDX-License-Identifier: LGPL-2.1-or-later
// Cells that yield: they are unaffected by rotation, their energies balance, and small strain is elastic.
#include <tread/solid/solid.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include "check.h"
#include "fields.h"

#include <algorithm>
#include <random>

using namespace tread;
using dealii::Point;
using tests::largest;
using tests::turned;

namespace solid_plastic
{
  constexpr double edge = 0.1; // m

  PlasticMaterial steel_that_yields(const bool kinematic)
  {
    PlasticMaterial material;
    material.yield_stress      = 500e6;
    material.isotropic_modulus = kinematic ? 2e9 : 23e9;
    if (kinematic)
      material.backstresses = {{60e9, 300.}, {10e9, 0.}};
    return material;
  }

  double distance(const NodalField &a, const NodalField &b)
  {
    NodalField difference(a.size());
    for (unsigned int i = 0; i < a.size(); ++i)
      difference[i] = a[i] - b[i];
    return largest(difference);
  }

  double largest_strain(const Solid &solid, const PlasticHistory &history)
  {
    const std::vector<double> strain = solid.plastic().equivalent_plastic_strain(history);
    return *std::max_element(strain.begin(), strain.end());
  }

  bool everywhere(const Point<3> &)
  {
    return true;
  }

  /// A cube of distorted cells whose nodes are displaced along random directions.
  struct Cube
  {
    const ElasticMaterial elastic;
    const Mesh            mesh{MPI_COMM_SELF, {tests::make_patch_cube(edge)}};
    const NodalField      reference = tests::reference_positions(mesh);
    const NodalField      at_rest   = NodalField(reference.size(), Vector3{});
    NodalField            direction = NodalField(reference.size());

    Cube()
    {
      std::mt19937                     random(3);
      std::uniform_real_distribution<> number(-1., 1.);
      for (Vector3 &d : direction)
        d = Vector3{number(random), number(random), number(random), 0.};
    }

    Solid solid(const std::vector<PlasticZone> &zones, const double hourglass_coefficient = 1.) const
    {
      SolidParameters parameters;
      parameters.hourglass_coefficient = hourglass_coefficient;
      return Solid(mesh, {elastic}, parameters, zones);
    }

    /// Positions after displacements of up to this share of the edge in each direction.
    NodalField moved(const double share) const
    {
      NodalField x(reference);
      for (unsigned int i = 0; i < x.size(); ++i)
        x[i] += share * edge * direction[i];
      return x;
    }
  };

  struct Loaded
  {
    PlasticHistory history;
    double         largest_force; ///< N
  };

  /// Loading, unloading and loading the other way, with and without a full turn meanwhile.
  Loaded load_with_and_without_turn(tests::Check      &check,
                                    const std::string &name,
                                    const Cube        &cube,
                                    const Solid       &solid)
  {
    PlasticHistory     straight = solid.virgin(), turning = solid.virgin();
    double             difference = 0., scale = 0.;
    const unsigned int n = 180;
    for (unsigned int step = 1; step <= n; ++step)
      {
        const double angle = 2. * dealii::numbers::PI * step / n;
        const auto   x     = cube.moved(0.03 * std::sin(angle));
        NodalField   f(x.size(), Vector3{}), g(x.size(), Vector3{});
        solid.update_internal_forces(x.data(), cube.at_rest.data(), f.data(), straight);
        solid.update_internal_forces(turned(x, angle).data(), cube.at_rest.data(), g.data(), turning);
        difference = std::max(difference, distance(turned(f, angle), g));
        scale      = std::max(scale, largest(f));
      }
    std::printf("%slargest plastic strain %.3f %%, largest nodal force %.3g N\n", name.c_str(),
                100. * largest_strain(solid, straight), scale);
    check.that(name + "much plastic strain", largest_strain(solid, straight) > 0.02);
    check.below(name + "forces after a full turn while yielding", difference / scale, 1e-12);
    double     change = 0.;
    const auto before = solid.plastic().stored(straight), after = solid.plastic().stored(turning);
    for (unsigned int c = 0; c < before.size(); ++c)
      for (unsigned int k = 0; k < 19; ++k)
        change = std::max(change, std::abs(before[c].values[k] - after[c].values[k]) /
                                    (k < 7 ? 1. : std::sqrt(cube.elastic.young_modulus * edge) * edge));
    check.below(name + "history after that", change, 1e-12);
    return {straight, scale};
  }

  /// Only turning: nothing flows, the residual stress turns along. Returns the history before the turn, at
  /// the reference positions.
  PlasticHistory turn_with_residual_stress(tests::Check      &check,
                                           const std::string &name,
                                           const Cube        &cube,
                                           const Solid       &solid,
                                           const Loaded      &loaded)
  {
    NodalField     x     = cube.moved(0.), f_0(x.size(), Vector3{});
    PlasticHistory rigid = loaded.history;
    solid.update_internal_forces(x.data(), cube.at_rest.data(), f_0.data(), rigid);
    const PlasticHistory kept       = rigid;
    double               turn_error = 0.;
    for (unsigned int degrees = 1; degrees <= 360; ++degrees)
      {
        const double angle = degrees * dealii::numbers::PI / 180.;
        NodalField   f(x.size(), Vector3{});
        solid.update_internal_forces(turned(x, angle).data(), cube.at_rest.data(), f.data(), rigid);
        turn_error = std::max(turn_error, distance(turned(f_0, angle), f));
      }
    check.below(name + "forces while a body with residual stress turns", turn_error / loaded.largest_force,
                1e-12);
    check.below(name + "plastic strain from that", largest_strain(solid, rigid) - largest_strain(solid, kept),
                1e-12);
    return kept;
  }

  /// Trial evaluations leave no trace, and agree with the update.
  void trial_and_update(tests::Check         &check,
                        const std::string    &name,
                        const Cube           &cube,
                        const Solid          &solid,
                        const PlasticHistory &before,
                        const double          largest_force)
  {
    const NodalField beyond = cube.moved(5e-4);
    NodalField       f(beyond.size(), Vector3{}), g(beyond.size(), Vector3{});
    PlasticHistory   history = before;
    solid.add_internal_forces(beyond.data(), cube.at_rest.data(), f.data(), history);
    const StrainEnergy trial = solid.strain_energy(beyond.data(), history);
    solid.update_internal_forces(beyond.data(), cube.at_rest.data(), g.data(), history);
    check.that(name + "they yield", largest_strain(solid, history) > largest_strain(solid, before) + 1e-4);
    check.that(name + "trial forces are those of the update", distance(f, g) == 0.);
    const StrainEnergy updated = solid.strain_energy(beyond.data(), history);
    // The update keeps the plastic volume to the cube of the elastic strain, 1e-2 here.
    check.relative(name + "elastic energy, before and after the update, J", trial.strain, updated.strain,
                   1e-5);
    NodalField again(beyond.size(), Vector3{});
    solid.add_internal_forces(beyond.data(), cube.at_rest.data(), again.data(), history);
    check.below(name + "forces from the updated history", distance(again, g) / largest_force, 1e-5);
  }

  /// Work of the forces = elastic energy + plastic work; midpoint rule, so of second order in the step, the
  /// return mapping of first.
  void energy_balance(tests::Check &check, const std::string &name, const Cube &cube, const Solid &solid)
  {
    double error[2];
    for (const unsigned int refined : {0u, 1u})
      {
        PlasticHistory     path     = solid.virgin();
        const unsigned int steps    = refined ? 4000 : 2000;
        double             external = 0., plastic = 0.;
        NodalField         last_x = cube.moved(0.), last_f(last_x.size(), Vector3{});
        for (unsigned int step = 1; step <= steps; ++step)
          {
            const NodalField next = cube.moved(0.03 * std::sin(2. * dealii::numbers::PI * step / steps));
            NodalField       force(next.size(), Vector3{});
            plastic +=
              solid.update_internal_forces(next.data(), cube.at_rest.data(), force.data(), path).value();
            for (unsigned int i = 0; i < next.size(); ++i)
              external -= 0.5 * dot(force[i] + last_f[i], next[i] - last_x[i]);
            last_x = next;
            last_f = force;
          }
        const StrainEnergy stored = solid.strain_energy(last_x.data(), path);
        error[refined]            = (external - plastic - stored.strain - stored.hourglass) / external;
        std::printf("%s%u steps: work %.1f J, plastic %.1f J, elastic %.2f J, hourglass %.2f J\n",
                    name.c_str(), steps, external, plastic, stored.strain, stored.hourglass);
      }
    check.below(name + "energy that is missing, share", error[1], 5e-3);
    check.absolute(name + "it halves with the step", error[0] / error[1], 2., 0.3);
  }

  /// Where nothing flows, cells with plastic strain and plastic hourglass amplitudes have an energy, and
  /// their forces are its derivative.
  void forces_are_derivatives(tests::Check         &check,
                              const std::string    &name,
                              const Cube           &cube,
                              const Solid          &solid,
                              const PlasticHistory &history,
                              const double          allowed)
  {
    // Back from where the last step led to, so that all cells unload.
    const NodalField x    = cube.moved(-2e-4);
    PlasticHistory   same = history;
    NodalField       f(x.size(), Vector3{});
    check.that(name + "no cell yields while it unloads",
               solid.update_internal_forces(x.data(), cube.at_rest.data(), f.data(), same).value() == 0.);
    constexpr double step     = 1e-7 * edge;
    double           expected = 0., energies[2];
    NodalField       to[2]    = {x, x};
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        const Vector3 &d = cube.direction[i], other{d[1], -d[2], d[0], 0.};
        expected -= dot(f[i], other);
        to[0][i] -= step * other;
        to[1][i] += step * other;
      }
    for (const unsigned int k : {0u, 1u})
      {
        const StrainEnergy energy = solid.strain_energy(to[k].data(), history);
        energies[k]               = energy.strain + energy.hourglass;
      }
    check.relative(name + "derivative of the energy, N", (energies[1] - energies[0]) / (2. * step), expected,
                   allowed);
  }

  /// What does not yield is elastic.
  void small_strain(tests::Check &check, const Cube &cube)
  {
    for (const double coefficient : {1., 3.})
      {
        const Solid plain   = cube.solid({}, coefficient),
                    plastic = cube.solid({{0, steel_that_yields(false), everywhere}}, coefficient);
        const NodalField x  = cube.moved(1e-5);
        NodalField       f(x.size(), Vector3{}), g(x.size(), Vector3{});
        plain.add_internal_forces(x.data(), cube.at_rest.data(), f.data());
        plastic.add_internal_forces(x.data(), cube.at_rest.data(), g.data());
        check.below("elastic and not yielding, strain 5e-5, hourglass coefficient " +
                      std::to_string(int(coefficient)),
                    distance(f, g) / largest(f), 1e-7);
      }
  }

  /// Cauchy's stress of cells that are strained by about 2 % in volume, sheared and turned, and do not yield:
  /// that of elastic cells, but for the third order of the strain.
  void cauchy_stress(tests::Check &check, const Cube &cube)
  {
    for (const bool kinematic : {false, true})
      {
        PlasticMaterial strong = steel_that_yields(kinematic);
        strong.yield_stress    = 1e12;
        const Solid plain = cube.solid({}), plastic = cube.solid({{0, strong, everywhere}});
        NodalField  x = cube.reference;
        for (Vector3 &p : x)
          {
            const Point<3> strained(1.02 * p[0] + 0.01 * p[1], 0.995 * p[1], 1.005 * p[2]);
            const Point<3> turned = tests::turn(strained, Point<3>(0.6, 0., 0.8), 0.7);
            p                     = Vector3{turned[0], turned[1], turned[2], 0.};
          }
        PlasticHistory history = plastic.virgin();
        NodalField     f(x.size(), Vector3{});
        plastic.update_internal_forces(x.data(), cube.at_rest.data(), f.data(), history);
        check.below(
          std::string(kinematic ? "kinematic" : "isotropic") +
            ": Cauchy's stress beside elastic cells', share",
          tests::difference(plastic.cauchy_stress(x.data(), history), plain.cauchy_stress(x.data())), 4e-3);
      }
  }

  /// Of several zones the last counts; cells outside are elastic.
  void zones_on_top_of_each_other(tests::Check &check, const Cube &cube)
  {
    const Mesh &mesh = cube.mesh;
    const auto  half = [](const Point<3> &p) {
      return p[2] > 0.5 * edge;
    };
    PlasticMaterial none, weak = steel_that_yields(false);
    weak.yield_stress    = 1e6;
    const Solid  solid   = cube.solid({{0, steel_that_yields(true), everywhere}, {0, none, half}});
    const Solid  weld    = cube.solid({{0, steel_that_yields(true), everywhere}, {0, weak, half}});
    unsigned int n_upper = 0;
    for (const Mesh::Cell &cell : mesh.cells)
      {
        double z = 0.;
        for (const unsigned int i : cell.nodes)
          z += mesh.nodes[i][2] / 8.;
        n_upper += z > 0.5 * edge;
      }
    check.that("a zone without yield stress takes cells out",
               n_upper > 0 && solid.plastic().n_cells() == mesh.cells.size() - n_upper);
    PlasticHistory   history = weld.virgin();
    const NodalField x       = cube.moved(1e-4);
    NodalField       f(x.size(), Vector3{});
    weld.update_internal_forces(x.data(), cube.at_rest.data(), f.data(), history);
    const std::vector<double> strain    = weld.plastic().equivalent_plastic_strain(history);
    unsigned int              n_yielded = 0;
    for (const double p : strain)
      n_yielded += p > 0.;
    check.absolute("cells of the weak zone that yield", n_yielded, n_upper, 0.);

    PlasticHistory back = weld.virgin();
    check.that("stored and restored",
               weld.plastic().restore(weld.plastic().stored(history), back) == mesh.cells.size());
    check.that("to the same strain", weld.plastic().equivalent_plastic_strain(back) == strain);
    weld.plastic().forget(0, back);
    check.that("and forgotten", largest_strain(weld, back) == 0.);
  }

  /// The net plastic strain, and histories that are added with its logarithm.
  void growth(tests::Check &check, const Cube &cube)
  {
    const Solid          solid       = cube.solid({{0, steel_that_yields(true), everywhere}});
    const PlasticCells  &plastic     = solid.plastic();
    const PlasticHistory virgin      = solid.virgin();
    const auto           largest_net = [&](const PlasticHistory &logarithmic) {
      const std::vector<double> strain = plastic.net_plastic_strain(logarithmic);
      return *std::max_element(strain.begin(), strain.end());
    };
    check.that("virgin steel has no net strain", largest_net(plastic.with_logarithms(virgin)) == 0.);

    // Stretched along x, at constant volume.
    const auto stretched = [&](const double strain) {
      NodalField x = cube.reference;
      for (Vector3 &p : x)
        p = Vector3{std::exp(strain) * p[0], std::exp(-0.5 * strain) * p[1], std::exp(-0.5 * strain) * p[2],
                    0.};
      return x;
    };
    const auto load = [&](PlasticHistory &history, const double from, const double to) {
      constexpr unsigned int n = 40;
      for (unsigned int step = 1; step <= n; ++step)
        {
          const NodalField x = stretched(from + (to - from) * step / n);
          NodalField       f(x.size(), Vector3{});
          solid.update_internal_forces(x.data(), cube.at_rest.data(), f.data(), history);
        }
    };
    PlasticHistory there = virgin;
    load(there, 0., 0.05);
    const PlasticHistory log_there = plastic.with_logarithms(there);
    const double         forth     = largest_strain(solid, there);
    check.that("it has yielded", forth > 0.04);
    check.relative("one way: net strain is the plastic strain", largest_net(log_there), forth, 1e-4);
    PlasticHistory back = there;
    load(back, 0.05, -0.02);
    const double left = 2. * forth - largest_strain(solid, back);
    check.relative("forth and back: what is left", largest_net(plastic.with_logarithms(back)), std::abs(left),
                   1e-4);

    const auto largest_change = [](const PlasticHistory &a, const PlasticHistory &b) {
      double change = 0.;
      for (std::size_t k = 0; k < a.values.size(); ++k)
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          change = std::max(change, std::abs(a.values[k][lane] - b.values[k][lane]));
      return change;
    };
    // In units of strain and of Pa.
    check.below("to logarithms and back", largest_change(plastic.from_logarithms(log_there), there), 1e-12);
    PlasticHistory twice = log_there;
    for (Lanes &value : twice.values)
      value *= 2.;
    const PlasticHistory far = plastic.from_logarithms(twice);
    check.relative("twice the history: net strain", largest_net(plastic.with_logarithms(far)),
                   2. * largest_net(log_there), 1e-12);
    const std::vector<double> limits = plastic.yield_limits(far);
    check.relative("a backstress that saturates does not leave C/gamma, Pa",
                   *std::max_element(limits.begin(), limits.end()),
                   500e6 + 2e9 * 2. * forth + 60e9 / 300. + 10e9 * 2. * forth, 1e-3);
    double volume = 0.;
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      volume =
        std::max(volume, std::abs(twice.values[0][lane] + twice.values[1][lane] + twice.values[2][lane]));
    check.below("the first cells keep their volume, strain", volume, 1e-12);

    const NodalField     x        = stretched(0.05);
    const PlasticHistory stressed = plastic.with_stresses(x.data(), there);
    check.below("to stresses and back", largest_change(plastic.from_stresses(x.data(), stressed), there),
                1e-12);
    // Another shape under the same stresses: sheared and turned, at the same volume. Backstresses turn with
    // the steel, so that it is one without them.
    const Solid         isotropic = cube.solid({{0, steel_that_yields(false), everywhere}});
    const PlasticCells &cells     = isotropic.plastic();
    PlasticHistory      flowed    = isotropic.virgin();
    for (unsigned int step = 1; step <= 40; ++step)
      {
        NodalField f(x.size(), Vector3{});
        isotropic.update_internal_forces(stretched(0.05 * step / 40).data(), cube.at_rest.data(), f.data(),
                                         flowed);
      }
    NodalField moved = x;
    for (Vector3 &p : moved)
      p = Vector3{0.8 * (p[0] + 0.1 * p[2]) + 0.6 * p[1], -0.6 * (p[0] + 0.1 * p[2]) + 0.8 * p[1], p[2], 0.};
    const PlasticHistory under  = cells.from_stresses(moved.data(), cells.with_stresses(x.data(), flowed));
    const auto           before = isotropic.cauchy_stress(x.data(), flowed),
               after            = isotropic.cauchy_stress(moved.data(), under);
    double largest = 0., change = 0.;
    for (std::size_t c = 0; c < before.size(); ++c)
      for (unsigned int k = 0; k < 6; ++k)
        {
          largest = std::max(largest, std::abs(before[c][k]));
          change  = std::max(change, std::abs(after[c][k] - before[c][k]));
        }
    check.that("there are stresses", largest > 100e6);
    check.below("another shape under the same stresses, over the largest", change / largest, 1e-9);
    check.that("its plastic strain is another one", largest_change(under, flowed) > 0.05);

    PlasticHistory sum = virgin;
    plastic.add(sum, 2., there, PlasticCells::strain_at, PlasticCells::hourglass_at);
    check.relative("a part of a history is added", largest_strain(solid, sum), 2. * forth, 1e-12);
    plastic.copy(sum, virgin, PlasticCells::strain_at, PlasticCells::hourglass_at);
    check.that("and set back", largest_change(sum, virgin) == 0.);
    const std::vector<double> squares =
      plastic.products(there, there, PlasticCells::strain_at, PlasticCells::hourglass_at);
    check.relative("product with itself", *std::max_element(squares.begin(), squares.end()), forth * forth,
                   1e-12);
    check.that("steel that flows has the one history, other steel the other",
               largest_change(plastic.where_flowing(there, twice, log_there), twice) == 0. &&
                 largest_change(plastic.where_flowing(virgin, twice, log_there), log_there) == 0.);
  }
} // namespace solid_plastic


TREAD_TEST(solid_plastic)(tests::Check &check, const tests::Arguments &)
{
  const Cube cube;
  for (const bool kinematic : {false, true})
    {
      const std::string name  = kinematic ? "two backstresses: " : "isotropic: ";
      const Solid       solid = cube.solid({{0, steel_that_yields(kinematic), everywhere}});
      check.that(name + "all cells may yield", solid.plastic().n_cells() == cube.mesh.cells.size());
      const Loaded         loaded  = load_with_and_without_turn(check, name, cube, solid);
      const PlasticHistory history = turn_with_residual_stress(check, name, cube, solid, loaded);
      trial_and_update(check, name, cube, solid, history, loaded.largest_force);
      energy_balance(check, name, cube, solid);
      // The law keeps the second order of the elastic strain, which is 0.3 % where the yield stress stays.
      forces_are_derivatives(check, name, cube, solid, history, kinematic ? 3e-5 : 6e-4);
    }
  small_strain(check, cube);
  growth(check, cube);
  cauchy_stress(check, cube);
  zones_on_top_of_each_other(check, cube);
}
