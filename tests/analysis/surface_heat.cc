// SPDX-License-Identifier: LGPL-2.1-or-later
// Heat that flows into a half-space, and the laws of wear, against closed forms.
#include <tread/analysis/archard_map_wear.h>
#include <tread/analysis/archard_wear.h>
#include <tread/analysis/damage_index.h>
#include <tread/analysis/regime_wear_rate.h>
#include <tread/analysis/t_gamma_damage.h>
#include <tread/analysis/work_wear.h>
#include <tread/reference/fatigue.h>
#include <tread/reference/surface_heat.h>

#include "check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace tread;

namespace analysis_surface_heat
{
  constexpr double pi = std::numbers::pi;

  /// Carslaw and Jaeger 1959, section 2.9: effusivity times the rise at t under a unit flux from 0 to `end`.
  double pulse(const double t, const double end)
  {
    return 2. / std::sqrt(pi) * (std::sqrt(t) - std::sqrt(std::max(0., t - end)));
  }

  void constant_flux(tests::Check &check)
  {
    const double                   interval = 3e-6;
    const reference::SurfaceHeat   heat(interval);
    reference::SurfaceHeat::Memory memory{};
    double                         worst = 0., late = 0.;
    for (unsigned int n = 1; n <= 200000; ++n)
      {
        const double off           = std::abs(heat.flow(memory, 1.) / pulse(n * interval, 1e9) - 1.);
        (n <= 2000 ? worst : late) = std::max(n <= 2000 ? worst : late, off);
      }
    // The trapezoidal rule leaves exp(-pi^2/1.2) of the kernel.
    check.below("constant flux, 2000 intervals, relative", worst, 3e-4);
    check.below("200000 intervals, relative", late, 5e-4);
  }

  void band(tests::Check &check)
  {
    const double                   interval = 1e-5, end = 40 * interval;
    const reference::SurfaceHeat   heat(interval);
    reference::SurfaceHeat::Memory flowing{}, resting{};
    for (unsigned int n = 0; n < 40; ++n)
      {
        heat.flow(flowing, 2.);
        heat.flow(resting, 2.);
      }
    for (unsigned int n = 1; n <= 60; ++n)
      if (const double rise = heat.flow(flowing, 0.); n % 7 == 1)
        check.relative("Jaeger's band source, " + std::to_string(n) + " intervals behind it", rise,
                       2. * pulse(end + n * interval, end), 1e-3);
    heat.rest(resting, 59 * interval);
    check.relative("rest instead of empty intervals", heat.flow(resting, 0.),
                   2. * pulse(end + 60 * interval, end), 1e-3);
  }

  /// Flux of a patch that slides, a semicircle over its length: the largest rise against the convolution with
  /// the exact kernel.
  void ellipse(tests::Check &check)
  {
    constexpr unsigned int n = 60, fine = 200;
    const double           duration = 4e-4, interval = duration / n;
    const auto             flux = [&](const double t) {
      return std::sqrt(std::max(0., 1. - std::pow(2. * t / duration - 1., 2)));
    };
    double exact = 0.;
    for (unsigned int k = 1; k <= n; ++k)
      {
        // With the substitution s = sqrt(t - tau): 2 int flux(t - s^2) ds.
        const double t = k * interval, ds = std::sqrt(t) / (fine * n);
        double       sum = 0.;
        for (unsigned int i = 0; i < fine * n; ++i)
          sum += 2. * ds * flux(t - std::pow((i + 0.5) * ds, 2));
        exact = std::max(exact, sum / std::sqrt(pi));
      }
    const reference::SurfaceHeat   heat(interval);
    reference::SurfaceHeat::Memory memory{};
    double                         largest = 0.;
    for (unsigned int k = 0; k < n; ++k)
      largest = std::max(largest, heat.flow(memory, flux((k + 0.5) * interval)));
    check.relative("semicircle of flux: largest rise", largest, exact, 1.5e-3); // 60 intervals
  }

  /// Long after any flux a half-space knows only how much heat it took, here nearly at the time t_0 of its
  /// centre: effusivity times rise is Q / sqrt(pi (t - t_0)). So the integral over the depth, Q, is found
  /// from the surface alone.
  void heat_taken(tests::Check &check)
  {
    const double                   interval = 1e-5;
    const reference::SurfaceHeat   heat(interval);
    reference::SurfaceHeat::Memory memory{};
    double                         taken = 0., moment = 0., t = 0.;
    for (unsigned int n = 0; n < 60; ++n, t += interval)
      {
        const double flux = 1. + std::sin(0.9 * n) + (n % 5 == 0);
        heat.flow(memory, flux);
        taken += flux * interval;
        moment += flux * interval * (t + 0.5 * interval);
      }
    for (unsigned int n = 0; n < 1900; ++n, t += interval)
      {
        const double rise = heat.flow(memory, 0.);
        if (n >= 700 && n % 300 == 100)
          check.relative("heat taken up, from the rise " + std::to_string(n) + " intervals later",
                         rise * std::sqrt(pi * (t + interval - moment / taken)), taken, 1e-3);
      }
  }

  void wear(tests::Check &check)
  {
    WearLaw::Sliding sliding;
    sliding.work     = 12.;
    sliding.normal   = 40.;
    sliding.distance = 2e-3;
    sliding.duration = 1e-3;
    sliding.area     = 1e-6;
    check.relative("Archard: 1e-4 x 40 J / 2.8 GPa, mm3", 1e9 * ArchardWear(1e-4, 2.8e9).volume(sliding),
                   40e-4 / 2.8, 1e-12);
    // 2 m/s, at ten times the hardness; borders belong to the range above.
    const auto of_map = [&](const std::vector<double> &speeds, const std::vector<double> &pressures) {
      std::vector<double> coefficients;
      for (std::size_t k = 0; k < (speeds.size() + 1) * (pressures.size() + 1); ++k)
        coefficients.push_back(1e-5 * (k + 1.));
      return ArchardMapWear(speeds, pressures, coefficients, 2e9).volume(sliding) * 2e9 / 40. / 1e-5;
    };
    check.relative("map: second speed, third pressure of 3 x 3", of_map({0.2, 7.}, {1., 9.}), 8., 1e-9);
    check.relative("third speed, second pressure", of_map({0.2, 1.9}, {1., 11.}), 6., 1e-9);
    check.relative("first of both", of_map({2.1, 7.}, {10.1, 11.}), 1., 1e-9);
    check.relative("no borders: one coefficient", of_map({}, {}), 1., 1e-9);
    check.relative("a border belongs to what lies above it", of_map({2., 7.}, {}), 2., 1e-9);
    check.that("a map with a gap is refused", tests::complaint<InputError>([] {
                                                ArchardMapWear({0.2, 0.7}, {0.8}, {1e-4, 1e-4, 1e-4}, 2e9);
                                              }) == "'Damage/Map wear coefficients' has 3 numbers; 3 ranges "
                                                    "of the slip speed and 2 of the pressure need 6");
    check.that("borders that fall are refused", tests::complaint<InputError>([] {
                                                  ArchardMapWear({0.7, 0.2}, {}, {1e-4, 1e-4, 1e-4}, 2e9);
                                                }).find("must rise") != std::string::npos);
    check.relative("3 mm3 per kJ, mm3", 1e9 * WorkWear(3e-12).volume(sliding), 36e-3, 1e-12);
  }

  void fatigue(tests::Check &check)
  {
    // 0.3 - 2 pi 6 8 200 / (3 100000) of N and mm
    check.relative("surface fatigue index",
                   reference::surface_fatigue_index(0.3, 1.5 * 1e5 / (pi * 6e-3 * 8e-3), 200e6),
                   0.3 - 2. * pi * 6. * 8. * 200. / 3e5, 1e-12);
    // It is 0 where the mean shear stress of sliding at full friction, 1.5 times it in the middle, is the
    // strength.
    const double a = 5e-3, b = 7e-3, strength = 300e6, force = 9e4;
    const double friction = strength / (1.5 * force / (pi * a * b));
    check.absolute("nought where friction reaches the strength in the middle of a sliding patch",
                   reference::surface_fatigue_index(friction, 1.5 * force / (pi * a * b), strength), 0.,
                   1e-12);
  }

  void indices(tests::Check &check)
  {
    // N and mm: 100 kN, 25 kN, 140 mm2 in contact, 1000 MPa, T-gamma 700 N, k 250 MPa.
    const DamageIndex::Load load{100e3, 25e3, 140e-6, 1000e6, 700., 250e6};
    DamageIndex::Load       unknown = load;
    unknown.shear_strength          = 0.;
    ParameterTable table;
    {
      Section section(table, "Damage");
      declare_damage_indices(section);
    }
    const auto made = [&table](const auto make) { // with the present values
      const Section section(table, "Damage");
      return make(table.handler());
    };
    const auto set = [&](const std::string &name, const std::string &value) {
      check.that(name + " is set", table.set(*table.find("Damage/" + name), value));
    };
    set("Function T-gammas (N)", "15, 65, 175");
    set("Function damages", "0, 10, 0");
    const double wanted[] = {0.25, 4., 0., 5e6, 26.5e-3, 0.};
    unsigned int k        = 0;
    for (const DamageIndexEntry &entry : damage_indices())
      {
        const auto index = made(entry.make);
        check.absolute(entry.key, index->value(load).value() / std::max(wanted[k], 1e-3),
                       wanted[k] / std::max(wanted[k], 1e-3), 1e-12);
        check.that(entry.key + " is there without a yield stress if it does not need it",
                   index->value(unknown).has_value() == (k != 1 && k != 2));
        ++k;
      }
    // Each regime goes on from where the one before ends.
    const auto rate = [](const double t_gamma_per_area) {
      return reference::regimes_of_r8t_on_900a.rate(1e6 * t_gamma_per_area) * 1e3; // of ug/(m mm2)
    };
    check.relative("mild wear, ug per m and mm2", rate(2.), 10.6, 1e-12);
    check.relative("up to the border", rate(10.4 - 1e-9), 55.12, 1e-9);
    check.relative("severe wear stays", rate(50.), 55.12, 1e-12);
    check.relative("catastrophic wear", rate(80.), 55.12 + 61.9 * 2.8, 1e-12);
    check.relative("goes on from the border", rate(77.2 + 1e-9), 55.12, 1e-8);

    const TGammaDamage damage({15., 65., 175.}, {0., 10., -5.});
    const auto         of = [&](const double t_gamma) {
      DamageIndex::Load with = load;
      with.t_gamma           = t_gamma;
      return damage.value(with).value();
    };
    check.absolute("below the first point", of(3.), 0., 1e-12);
    check.absolute("between points", of(40.), 5., 1e-12);
    check.absolute("at a point", of(65.), 10., 1e-12);
    check.absolute("where it falls", of(120.), 2.5, 1e-12);
    check.absolute("behind the last point", of(500.), -5., 1e-12);
    check.that("points that fall are refused", tests::complaint<InputError>([] {
                                                 TGammaDamage({15., 15.}, {0., 1.});
                                               }).find("must rise") != std::string::npos);
    check.that("numbers that do not match are refused",
               tests::complaint<InputError>([] {
                 TGammaDamage({15., 65.}, {0.});
               }) == "'Damage/Function T-gammas (N)' has 2 numbers, 'Function damages' has 1");
    set("Regime slopes (ug per m N)", "5.3");
    check.that("one slope for two regimes is refused",
               tests::complaint<InputError>([&] { made(RegimeWearRate::make); }) ==
                 "'Damage/Regime slopes (ug per m N)' has two numbers");
    set("Regime slopes (ug per m N)", "5.3, 61.9");
    set("Regime borders (N per mm2)", "77, 10");
    check.that("borders of regimes that fall are refused", tests::complaint<InputError>([&] {
                                                             made(RegimeWearRate::make);
                                                           }).find("must rise") != std::string::npos);
  }
} // namespace analysis_surface_heat


TREAD_TEST(analysis_surface_heat)(tests::Check &check, const tests::Arguments &)
{
  constant_flux(check);
  band(check);
  ellipse(check);
  heat_taken(check);
  wear(check);
  fatigue(check);
  indices(check);
}
