// SPDX-License-Identifier: LGPL-2.1-or-later
// The beam on discrete supports: statics against an independent solution of the same problem and Zimmermann's
// closed form, dynamics against Timoshenko's frequencies and energy.
#include <tread/reference/supported_beam.h>
#include <tread/reference/zimmermann.h>

#include "check.h"

#include <algorithm>
#include <numbers>
#include <string>

using namespace tread::reference;

namespace reference_track
{
  constexpr double spacing = 0.6, wheel_load = 116.8e3;

  SupportLayers layers()
  {
    SupportLayers l;
    l.pad_stiffness     = 1300e6;
    l.pad_damping       = 45e3;
    l.sleeper_mass      = 200.;
    l.ballast_stiffness = 45e6;
    l.ballast_damping   = 32e3;
    return l;
  }

  /// n supports, the middle one at x = 0, ends half a spacing beyond.
  std::vector<double> positions(const int n)
  {
    std::vector<double> x;
    for (int i = -(n / 2); i <= n / 2; ++i)
      x.push_back(spacing * i);
    return x;
  }

  SupportedBeam track(const BeamSection   &section,
                      const SupportLayers &support,
                      const int            n,
                      const double         element)
  {
    const double end = 0.5 * spacing * n;
    return {section, support, positions(n), -end, end, element};
  }

  struct Rail
  {
    std::string name;
    double      moment_of_inertia, area;

    BeamSection section(const double kappa, const bool euler = false) const
    {
      BeamSection s;
      s.bending_stiffness = 210e9 * moment_of_inertia;
      s.mass              = 7850. * area;
      if (!euler)
        {
          s.shear_stiffness = kappa * 210e9 / 2.6 * area;
          s.rotary_inertia  = 7850. * moment_of_inertia;
        }
      return s;
    }
  };

  /// 31 supports, Euler beam: deflections (mm) and support forces (kN) from an independent solution.
  void static_loads(tread::tests::Check &check, const Rail &rail54, const Rail &rail60)
  {
    struct Static
    {
      const Rail *rail;
      double      x, deflection, forces[4];
      int         first; // support of the first force; the others follow
    };
    for (const Static &s : {Static{&rail54, 0., 1.1116, {48.35, 29.80, 8.32, -.77}, 0},
                            Static{&rail54, .3, 1.1260, {42.35, 17.71, 2.36, -1.97}, 1},
                            Static{&rail60, 0., 1.0423, {45.33, 29.46, 9.70, .13}, 0},
                            Static{&rail60, .3, 1.0524, {40.27, 18.59, 3.66, -1.52}, 1}})
      {
        const auto        beam     = track(s.rail->section(0., true), layers(), 31, .05);
        const auto        response = beam.respond({{s.x, wheel_load}});
        const std::string name     = s.rail->name + (s.first == 0 ? " over a sleeper" : " at mid-span");
        check.absolute(name + ": deflection (mm)", 1e3 * response.deflection(s.x).real(), s.deflection, 6e-5);
        double sum = 0.;
        for (unsigned int i = 0; i < 31; ++i)
          sum += response.pad_force(i).real();
        check.relative(name + ": supports carry the load", sum, wheel_load, 1e-10);
        for (unsigned int i = 0; i < 4; ++i)
          check.absolute(name + ": support " + std::to_string(s.first + i) + " (kN)",
                         1e-3 * response.ballast_force(15 + s.first + i).real(), s.forces[i], 6e-3);
      }
  }

  /// Close supports are a Winkler foundation: the error falls with (spacing/L)^4.
  void close_supports(tread::tests::Check &check, const Rail &rail)
  {
    const double        u = foundation_modulus(1300e6, 45e6, spacing), a = .05;
    const Zimmermann    winkler = zimmermann(210e9 * rail.moment_of_inertia, u, wheel_load);
    SupportLayers       soft;
    std::vector<double> x;
    soft.pad_stiffness = u * a;
    for (int i = -200; i <= 200; ++i)
      x.push_back(a * i);
    const SupportedBeam beam(rail.section(0., true), soft, x, -10.025, 10.025, a);
    const auto          response = beam.respond({{0., wheel_load}});
    for (const double at : {0., .43, 1.2})
      check.relative("close supports: deflection at " + std::to_string(at).substr(0, 4) + " m (mm)",
                     1e3 * response.deflection(at).real(), 1e3 * winkler.deflection(at), 3e-5);
  }

  /// Two stiff supports, load in the middle, ends that do not turn: w = F L^3/(192 E I) + F L/(4 kGA).
  void clamped_timoshenko_beam(tread::tests::Check &check, const Rail &rail)
  {
    SupportLayers stiff;
    stiff.pad_stiffness   = 1e15;
    const BeamSection   s = rail.section(.4);
    const SupportedBeam beam(s, stiff, {0., spacing}, 0., spacing, .1);
    const double        bend  = wheel_load * std::pow(spacing, 3) / (192. * s.bending_stiffness);
    const double        shear = wheel_load * spacing / (4. * s.shear_stiffness);
    check.relative("clamped Timoshenko beam: deflection (um)",
                   1e6 * beam.respond({{.5 * spacing, wheel_load}}).deflection(.5 * spacing).real(),
                   1e6 * (bend + shear), 1e-6);
  }

  /// Closed form against printed figures (Hz), and as the resonance of a beam on stiff supports.
  void pinned_pinned_frequencies(tread::tests::Check &check, const Rail &rail54, const Rail &rail60)
  {
    struct Pinned
    {
      const Rail *rail;
      double      kappa, frequency;
    };
    for (const Pinned &p : {Pinned{&rail60, .40, 1067.}, Pinned{&rail60, .393, 1064.},
                            Pinned{&rail60, .34, 1033.}, Pinned{&rail54, .40, 1015.}})
      {
        const std::string name = p.rail->name + ", kappa " + std::to_string(p.kappa).substr(0, 5);
        const double f = timoshenko_frequency(p.rail->section(p.kappa), spacing) / (2. * std::numbers::pi);
        check.absolute(name + ": pinned-pinned (Hz)", f, p.frequency, .6);
        SupportLayers stiff;
        stiff.pad_stiffness = 1e14;
        const auto beam     = track(p.rail->section(p.kappa), stiff, 5, .0125);
        // The response changes its sign through infinity at the resonance.
        double low = .97 * f, high = 1.03 * f;
        for (unsigned int i = 0; i < 40; ++i)
          {
            const double middle = .5 * (low + high);
            const auto   r      = beam.respond({{.3, 1.}}, 2. * std::numbers::pi * middle);
            (r.deflection(.3).real() > 0. ? low : high) = middle;
          }
        // Lumped inertia in elements of 1/48 spacing: (k h)^2/12 = 3.6e-4 at most.
        check.relative(name + ": resonance of the beam (Hz)", low, f, 4e-4);
      }
    check.absolute("60E1, Euler without rotary inertia: pinned-pinned (Hz)",
                   timoshenko_frequency(rail60.section(0., true), spacing) / (2. * std::numbers::pi), 1420.,
                   1.);
  }

  /// The power that a force puts in is what dampers take; a track of 101 spans has no reflections at 1 kHz.
  /// @param pad_radius 0: pads that are points; else they hold the slope of the rail as well, m
  void response_at_1_kHz(tread::tests::Check &check, const Rail &rail60, const double pad_radius)
  {
    const double  omega   = 2. * std::numbers::pi * 1000.;
    SupportLayers l       = layers();
    l.pad_radius          = pad_radius;
    const auto beam       = track(rail60.section(.4), l, 101, .0125);
    const auto response   = beam.respond({{.3, 1.}}, omega);
    double     dissipated = 0.;
    for (unsigned int i = 0; i < 101; ++i)
      {
        const auto rail = response.deflection(beam.supports[i]);
        const auto sleeper =
          response.ballast_force(i) / std::complex<double>(l.ballast_stiffness, omega * l.ballast_damping);
        dissipated += .5 * omega * omega *
                      (l.pad_damping * (std::norm(rail - sleeper) +
                                        std::norm(pad_radius * response.rotation(beam.supports[i]))) +
                       l.ballast_damping * std::norm(sleeper));
      }
    check.relative("1 kHz: dissipated over injected power", dissipated,
                   -.5 * omega * response.deflection(.3).imag(), 1e-8);
    const auto twice_as_long = track(rail60.section(.4), l, 201, .0125);
    const auto longer        = twice_as_long.respond({{.3, 1.}}, omega);
    check.relative("1 kHz: receptance of a track twice as long (nm/N)", 1e9 * std::abs(longer.deflection(.3)),
                   1e9 * std::abs(response.deflection(.3)), 1e-3);
    check.relative("reciprocity (nm/N)", 1e9 * std::abs(beam.respond({{1.13, 1.}}, omega).deflection(.3)),
                   1e9 * std::abs(response.deflection(1.13)), 1e-9);
  }
} // namespace reference_track


TREAD_TEST(reference_track)(tread::tests::Check &check, const tread::tests::Arguments &)
{
  const Rail rail54{"54E1", 2337.9e-8, 69.77e-4}, rail60{"60E1", 3038.3e-8, 76.70e-4};
  static_loads(check, rail54, rail60);
  close_supports(check, rail54);
  clamped_timoshenko_beam(check, rail60);
  pinned_pinned_frequencies(check, rail54, rail60);
  response_at_1_kHz(check, rail60, 0.);
  response_at_1_kHz(check, rail60, .04);

  // A support without ballast and sleeper mass carries nothing: the beam without it.
  {
    SupportLayers alike = layers(), empty = layers();
    alike.pad_radius = empty.pad_radius = 0.;
    empty.ballast_stiffness = empty.sleeper_mass = 0.;
    std::vector<double>        places            = positions(9);
    std::vector<SupportLayers> each(9, alike);
    each[4]                  = empty;
    const BeamSection   rail = rail60.section(.4);
    const SupportedBeam one(rail, each, places, -2.7, 2.7, .05);
    places.erase(places.begin() + 4);
    const SupportedBeam other(rail, alike, places, -2.7, 2.7, .05);
    const auto          a = one.respond({{.1, wheel_load}}), b = other.respond({{.1, wheel_load}});
    for (const double x : {-1., 0., .1, .7})
      check.relative("an empty support, deflection at " + std::to_string(x), a.deflection(x).real(),
                     b.deflection(x).real(), 1e-9);
    check.below("an empty support carries", std::abs(a.ballast_force(4)), 1e-6);
  }
}
