// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/spectrum.h>

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>

namespace tread
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    // What tells an oscillation from its surroundings; the same numbers stand in the header.

    /// The least share of the largest amplitude that is still an oscillation.
    constexpr double least_of_largest = 0.05;
    /// By how much it must stand above the side lobes of larger ones.
    constexpr double above_side_lobes = 1.5;
    /// The share of it below which the spectrum must fall between it and any larger value.
    constexpr double deepest_saddle = 0.7;

    /// The share of the largest envelope below which noise begins, so that no decay is taken from it: of an
    /// oscillation that is 5 % of the largest, side lobes of the others are not much less.
    constexpr double noise = 0.02;
    /// An envelope is averaged over at least so many samples, and a decay is taken from at least this share
    /// of the average's length: shorter ones say nothing about a slope.
    constexpr std::size_t least_span = 8, spans_in_fit = 4;
    /// Samples without which a spectrum is not computed.
    constexpr std::size_t least_samples = 8;
    /// Width of a line at half its height over the inverse of the record (Harris 1978, table 1: 6 dB).
    constexpr double width_of_hann = 2., width_of_rectangle = 1.21;

    /// The middle of sample i of n, so that no sample has the weight zero.
    double hann(const std::size_t i, const std::size_t n)
    {
      const double s = std::sin(pi * (i + 0.5) / n);
      return s * s;
    }

    /// Slope of ln|envelope| of the oscillation at a frequency. The envelope is that of the values shifted to
    /// frequency 0 and averaged with a Hann window, whose zeros lie at frequency 0 and at the nearest other
    /// oscillation; the average of an exponential decays as the exponential does.
    double decay_rate(const std::vector<double> &values,
                      const double               interval,
                      const double               frequency,
                      const double               distance)
    {
      const double      nan  = std::numeric_limits<double>::quiet_NaN();
      const std::size_t n    = values.size(),
                        span = std::lround(2. / (std::min(frequency, distance) * interval));
      if (span < least_span || 2 * span > n)
        return nan;
      std::vector<std::complex<double>> shifted(n);
      for (std::size_t i = 0; i < n; ++i)
        shifted[i] = values[i] * std::polar(1., -2. * pi * frequency * interval * i);
      std::vector<double> weight(span), envelope(n - span + 1);
      for (std::size_t k = 0; k < span; ++k)
        weight[k] = hann(k, span);
      for (std::size_t i = 0; i < envelope.size(); ++i)
        envelope[i] = std::abs(
          std::inner_product(weight.begin(), weight.end(), shifted.begin() + i, std::complex<double>()));

      // Half a window after the largest value the onset has left the average.
      const std::size_t largest = std::max_element(envelope.begin(), envelope.end()) - envelope.begin(),
                        begin   = largest + span / 2;
      std::size_t end           = begin;
      while (end < envelope.size() && envelope[end] > noise * envelope[largest])
        ++end;
      if (end < begin + span / spans_in_fit)
        return nan;
      double sum = 0., sum_t = 0., sum_y = 0., sum_tt = 0., sum_ty = 0.;
      for (std::size_t i = begin; i < end; ++i)
        {
          const double t = interval * (i - begin), y = std::log(envelope[i]);
          sum += 1.;
          sum_t += t;
          sum_y += y;
          sum_tt += t * t;
          sum_ty += t * y;
        }
      return -(sum * sum_ty - sum_t * sum_y) / (sum * sum_tt - sum_t * sum_t);
    }
  } // namespace


  Window window_of(const std::string &name)
  {
    if (name == "rectangular")
      return Window::rectangular;
    if (name == "Hann")
      return Window::hann;
    throw std::invalid_argument("there is no window '" + name + "'; allowed: rectangular, Hann");
  }


  double AmplitudeSpectrum::side_lobes(const double distance) const
  {
    const double bins = distance * record;
    if (bins <= (window == Window::hann ? 2. : 1.))
      return 1.;
    return 1. / (pi * bins * (window == Window::hann ? bins * bins - 1. : 1.));
  }


  AmplitudeSpectrum amplitude_spectrum(const std::vector<double> &values,
                                       const double               interval,
                                       const Window               window,
                                       const unsigned int         zero_padding)
  {
    const std::size_t n = values.size();
    if (n < least_samples || !(interval > 0.) || zero_padding < 1)
      throw std::invalid_argument("a spectrum needs at least " + std::to_string(least_samples) + " samples");
    std::size_t length = 1; // a power of two is fastest
    while (length < n * zero_padding)
      length *= 2;

    std::vector<double> weight(n, 1.);
    if (window == Window::hann)
      for (std::size_t i = 0; i < n; ++i)
        weight[i] = hann(i, n);
    const double total = std::accumulate(weight.begin(), weight.end(), 0.);
    const double mean  = std::inner_product(weight.begin(), weight.end(), values.begin(), 0.) / total;

    const std::unique_ptr<double, decltype(&fftw_free)>       input(fftw_alloc_real(length), fftw_free);
    const std::unique_ptr<fftw_complex, decltype(&fftw_free)> output(fftw_alloc_complex(length / 2 + 1),
                                                                     fftw_free);
    const fftw_plan plan = fftw_plan_dft_r2c_1d(length, input.get(), output.get(), FFTW_ESTIMATE);
    std::fill_n(input.get(), length, 0.);
    for (std::size_t i = 0; i < n; ++i)
      input.get()[i] = weight[i] * (values[i] - mean);
    fftw_execute(plan);
    fftw_destroy_plan(plan);

    AmplitudeSpectrum result;
    result.window     = window;
    result.record     = n * interval;
    result.resolution = (window == Window::hann ? width_of_hann : width_of_rectangle) / result.record;
    result.interval   = 1. / (length * interval);
    result.amplitude.resize(length / 2 + 1);
    for (std::size_t i = 0; i < result.amplitude.size(); ++i)
      {
        // Both ends of the spectrum stand for themselves only, the others for their negative frequency too.
        const double sides  = i == 0 || i + 1 == result.amplitude.size() ? 1. : 2.;
        result.amplitude[i] = sides * std::hypot(output.get()[i][0], output.get()[i][1]) / total;
      }
    return result;
  }


  std::vector<Oscillation> dominant_oscillations(const std::vector<double> &values,
                                                 const double               interval,
                                                 const AmplitudeSpectrum   &spectrum,
                                                 const unsigned int         max_number)
  {
    const std::vector<double> &a            = spectrum.amplitude;
    const auto                 stands_alone = [&](const std::size_t i) {
      for (const int step : {-1, 1})
        {
          double lowest = a[i];
          for (std::size_t j = i; j > 0 && j + 1 < a.size() && a[j] <= a[i];)
            lowest = std::min(lowest, a[j += step]);
          if (lowest > deepest_saddle * a[i])
            return false;
        }
      return true;
    };
    std::vector<Oscillation> found;
    for (std::size_t i = 1; i + 1 < a.size(); ++i)
      if (a[i] > a[i - 1] && a[i] >= a[i + 1] && a[i - 1] > 0. && a[i + 1] > 0. && stands_alone(i))
        {
          const double left = std::log(a[i - 1]), middle = std::log(a[i]), right = std::log(a[i + 1]),
                       shift = 0.5 * (left - right) / (left - 2. * middle + right);
          found.push_back(
            {spectrum.interval * (i + shift), std::exp(middle - 0.25 * (left - right) * shift), 0.});
        }
    std::sort(found.begin(), found.end(), [](const Oscillation &one, const Oscillation &other) {
      return one.amplitude > other.amplitude;
    });
    std::vector<Oscillation> kept;
    for (const Oscillation &line : found)
      {
        double lobes = least_of_largest * found.front().amplitude;
        for (const Oscillation &larger : kept)
          {
            const double distance = std::abs(line.frequency - larger.frequency);
            lobes += above_side_lobes * larger.amplitude * spectrum.side_lobes(distance);
            if (distance < spectrum.resolution)
              lobes = line.amplitude;
          }
        if (line.amplitude > lobes && line.frequency > spectrum.resolution && kept.size() < max_number)
          kept.push_back(line);
      }
    for (Oscillation &line : kept)
      {
        double distance = std::numeric_limits<double>::max();
        for (const Oscillation &other : kept)
          if (&other != &line)
            distance = std::min(distance, std::abs(other.frequency - line.frequency));
        line.decay_rate = decay_rate(values, interval, line.frequency, distance);
      }
    return kept;
  }
} // namespace tread
