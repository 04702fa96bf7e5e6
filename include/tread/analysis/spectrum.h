// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_spectrum_h
#define tread_analysis_spectrum_h

#include <string>
#include <vector>

namespace tread
{
  /// Weight of the samples of a record before its transform (Harris 1978).
  enum class Window
  {
    rectangular, ///< for a transient that begins and ends within the record
    hann         ///< for a vibration that goes on beyond both ends
  };

  /// @throws std::invalid_argument with one line
  Window window_of(const std::string &name);

  /// One-sided amplitude spectrum: a sine within the whole record shows its amplitude.
  struct AmplitudeSpectrum
  {
    Window window;
    double record;     ///< length of the record, s
    double resolution; ///< frequencies nearer than this are one: width of a line at half its height, Hz
    double interval;   ///< between the values, finer than the resolution by zero padding, Hz
    std::vector<double> amplitude; ///< at 0, interval, 2 interval, ...; unit of the samples

    /// Bound of a line's side lobes at a distance from it (Hz), share of the line's height; 1 within its main
    /// lobe.
    double side_lobes(const double distance) const;
  };

  /// The mean of the record is taken off before the transform.
  /// @param values at equal distances, at least 8; @param interval between them, s > 0
  /// @param zero_padding length of what is transformed over that of the record, >= 1
  AmplitudeSpectrum amplitude_spectrum(const std::vector<double> &values,
                                       const double               interval,
                                       const Window               window,
                                       const unsigned int         zero_padding = 8);

  /// A line of a spectrum.
  struct Oscillation
  {
    double frequency; ///< Hz
    double amplitude; ///< unit of the samples; of a decaying oscillation the mean over the record
    /// Decay of the envelope ~ exp(-decay_rate t), 1/s; NaN where the record is too short to tell.
    double decay_rate;

    /// Natural logarithm of the ratio of two successive peaks.
    double logarithmic_decrement() const
    {
      return decay_rate / frequency;
    }
  };

  /// The local maxima of the spectrum by a parabola through three logarithms, the largest first: those of at
  /// least 5 % of the largest that stand 1.5 times above the side lobes of larger ones, no nearer to them
  /// than the resolution, and between which and any larger value the spectrum falls below 70 % of them.
  std::vector<Oscillation> dominant_oscillations(const std::vector<double> &values,
                                                 const double               interval,
                                                 const AmplitudeSpectrum   &spectrum,
                                                 const unsigned int         max_number);
} // namespace tread

#endif
