// SPDX-License-Identifier: LGPL-2.1-or-later
// Spectra of signals that are known.
#include <tread/analysis/spectrum.h>

#include "check.h"

#include <cmath>
#include <functional>
#include <stdexcept>

using namespace tread;

namespace analysis_spectrum
{
  constexpr double pi = 3.14159265358979323846;

  std::vector<double> sampled(const std::size_t                    n,
                              const double                         interval,
                              const std::function<double(double)> &signal)
  {
    std::vector<double> values(n);
    for (std::size_t i = 0; i < n; ++i)
      values[i] = signal(interval * i);
    return values;
  }
} // namespace analysis_spectrum

TREAD_TEST(analysis_spectrum)(tests::Check &check, const tests::Arguments &)
{
  const double dt = 2.3e-5;

  for (const Window window : {Window::rectangular, Window::hann})
    {
      const std::string name = window == Window::hann ? "Hann: " : "rectangular: ";

      // 40 whole periods without padding: every value is exact. A mean is no line.
      const auto              whole = sampled(2048, dt, [&](const double t) {
        return 100. + 7. * std::sin(2. * pi * 40. / (2048 * dt) * t + 0.3);
      });
      const AmplitudeSpectrum exact = amplitude_spectrum(whole, dt, window, 1);
      check.relative(name + "amplitude of a sine of whole periods", exact.amplitude[40], 7., 1e-10);
      check.below(name + "mean", exact.amplitude[0], 1e-10);
      check.relative(name + "highest frequency over half the sampling rate",
                     exact.interval * (exact.amplitude.size() - 1) * 2. * dt, 1., 1e-12);
      check.relative(name + "distance of the values x record", exact.interval * exact.record, 1., 1e-12);

      // Alternating samples are the highest frequency, which has no negative twin.
      const auto alternating =
        sampled(2048, 1., [](const double t) { return std::fmod(t, 2.) < 1. ? 3. : -3.; });
      check.relative(name + "amplitude at half the sampling rate",
                     amplitude_spectrum(alternating, 1., window, 1).amplitude.back(), 3., 1e-10);

      // Two lines a resolution apart meet at half their height; the side lobes do not exceed their bound, and
      // reach it within their own width.
      const auto high =
        sampled(2048, 1., [](const double t) { return 7. * std::sin(2. * pi * 400. / 2048. * t); });
      const AmplitudeSpectrum fine = amplitude_spectrum(high, 1., window, 64);
      const auto              at   = [&](const double bins) {
        return fine.amplitude[std::lround((400. + bins) * 64.)] / 7.;
      };
      check.absolute(name + "half a resolution beside a line", at(0.5 * fine.resolution * fine.record), 0.5,
                     0.02);
      double over_bound = 0.;
      for (double bins = window == Window::hann ? 2.1 : 1.1; bins < 100.; bins += 1. / 64.)
        over_bound = std::max(over_bound, at(bins) / fine.side_lobes(bins / fine.record));
      check.absolute(name + "side lobes over their bound", over_bound, 1., 0.03);

      // Two steady sines, no whole number of periods.
      const auto              two      = sampled(4000, dt, [](const double t) {
        return 30. * std::cos(2. * pi * 297. * t) + 12. * std::sin(2. * pi * 1061. * t);
      });
      const AmplitudeSpectrum spectrum = amplitude_spectrum(two, dt, window);
      const auto              lines    = dominant_oscillations(two, dt, spectrum, 5);
      check.absolute(name + "number of lines", lines.size(), 2., 0.);
      if (lines.size() == 2)
        {
          // The rectangular window's lines reach into each other: side lobes fall like 1/(pi distance x
          // record). They move the weaker line as well.
          const bool   hann = window == Window::hann;
          const double leak = 1. / (pi * (1061. - 297.) * spectrum.record);
          check.absolute(name + "first frequency, Hz", lines[0].frequency, 297., hann ? 1e-3 : 8e-3);
          check.absolute(name + "second frequency, Hz", lines[1].frequency, 1061., hann ? 1e-3 : 0.07);
          check.relative(name + "first amplitude", lines[0].amplitude, 30., hann ? 1e-3 : 12. / 30. * leak);
          check.relative(name + "second amplitude", lines[1].amplitude, 12., hann ? 1e-3 : 30. / 12. * leak);
          check.below(name + "decrement of a steady sine", lines[0].logarithmic_decrement(), 1e-3);
        }
    }

  // A blow: silence, then two vibrations that die out, with the frequencies and about the decay of the
  // thesis's figure 4.3.7: four or five waves of the first, three of the second.
  const double begin = 5e-3, decrement_1 = 0.4, decrement_2 = 0.6;
  const auto   blow   = sampled(2200, dt, [&](const double t) {
    const double s = t - begin;
    return s < 0. ? 0.
                      : 40. * std::exp(-decrement_1 * 297. * s) * std::sin(2. * pi * 297. * s) +
                      30. * std::exp(-decrement_2 * 1061. * s) * std::sin(2. * pi * 1061. * s);
  });
  const auto decaying = dominant_oscillations(blow, dt, amplitude_spectrum(blow, dt, Window::rectangular), 5);
  check.absolute("blow: number of lines", decaying.size(), 2., 0.);
  if (decaying.size() == 2)
    {
      // The top of a decaying line lies beside its frequency, by a share of about (decrement/2 pi)^2: 0.4 and
      // 0.9 %.
      check.relative("blow: first frequency, Hz", decaying[0].frequency, 297., 0.02);
      check.relative("blow: second frequency, Hz", decaying[1].frequency, 1061., 0.02);
      check.relative("blow: first decrement", decaying[0].logarithmic_decrement(), decrement_1, 0.015);
      check.relative("blow: second decrement", decaying[1].logarithmic_decrement(), decrement_2, 0.10);
    }
  // Alone, each is found as exactly as the fit is.
  const auto alone  = sampled(2200, dt, [&](const double t) {
    return t < begin ? 0.
                      : std::exp(-decrement_1 * 297. * (t - begin)) * std::sin(2. * pi * 297. * (t - begin));
  });
  const auto single = dominant_oscillations(alone, dt, amplitude_spectrum(alone, dt, Window::rectangular), 5);
  check.absolute("one decaying vibration: number of lines", single.size(), 1., 0.);
  check.relative("one decaying vibration: decrement", single.at(0).logarithmic_decrement(), decrement_1,
                 0.01);

  const auto refused = [](const auto &call) {
    return !tests::complaint<std::invalid_argument>(call).empty();
  };
  check.that("too few samples are refused", refused([&]() {
               amplitude_spectrum({1., 2., 3.}, dt, Window::hann);
             }));
  check.that("an unknown window is refused", refused([]() { window_of("Hamming"); }));
}
