// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tests_receptance_h
#define tread_tests_receptance_h

#include <deal.II/base/numbers.h>

#include "track_rail.h"

#include <complex>

namespace tread::tests
{
  /// Receptance over frequency: displacement over force, m/N.
  struct Receptance
  {
    double                            lowest, step; ///< Hz
    std::vector<std::complex<double>> values;

    double frequency(const unsigned int line) const
    {
      return lowest + step * line;
    }

    /// Frequency (Hz) of the largest (sign 1) or smallest (-1) amplitude in a band, by a parabola through
    /// three lines of its logarithm.
    double extreme(const double from, const double to, const double sign) const
    {
      const auto value = [&](const unsigned int k) {
        return sign * std::log(std::abs(values[k]));
      };
      unsigned int best = 0;
      for (unsigned int k = 1; k + 1 < values.size(); ++k)
        if (frequency(k) >= from && frequency(k) <= to && (best == 0 || value(k) > value(best)))
          best = k;
      const double left = value(best - 1), middle = value(best), right = value(best + 1);
      return frequency(best) + .5 * step * (left - right) / (left - 2. * middle + right);
    }

    /// Root mean square of the difference over that of the reference, in a band.
    double deviation(const Receptance &reference, const double from, const double to) const
    {
      double difference = 0., scale = 0.;
      for (unsigned int k = 0; k < values.size(); ++k)
        if (frequency(k) >= from && frequency(k) <= to)
          {
            difference += std::norm(values[k] - reference.values[k]);
            scale += std::norm(reference.values[k]);
          }
      return std::sqrt(difference / scale);
    }
  };

  /// The lines of frequency to be evaluated, and a decay (1/s). Force and displacement are multiplied by
  /// exp(-decay t), so that the record is not truncated at its end, and the beam is evaluated at the complex
  /// frequency omega - i decay, which is exactly equivalent.
  struct Lines
  {
    double       lowest, step; ///< Hz
    unsigned int n;
    double       decay; ///< 1/s
  };

  /// A blow of 0.4 ms, a raised cosine, on a patch in the time domain, and the mean displacement of
  /// the same patch.
  inline Receptance by_hammer(TrackRail              &rail,
                              const TrackRail::Patch &patch,
                              const double            duration,
                              const Lines            &lines)
  {
    constexpr double  pulse = 0.4e-3, blow = 1e3; // s, N
    ExplicitDynamics &dynamics = *rail.dynamics;
    dynamics.start();
    std::vector<std::complex<double>> force(lines.n, 0.), displacement(lines.n, 0.), turn(lines.n),
      phase(lines.n, 1.);
    Receptance result{lines.lowest, lines.step, {}};
    for (unsigned int k = 0; k < lines.n; ++k)
      turn[k] = std::exp(std::complex<double>(-lines.decay, -2. * dealii::numbers::PI * result.frequency(k)) *
                         dynamics.state.time_step);
    const double steps_per_sample = 1u << dynamics.max_level();
    while (dynamics.state.time < duration)
      {
        const double s = dynamics.state.time / pulse;
        const double f = s < 1. ? 0.5 * (1. - std::cos(2. * dealii::numbers::PI * s)) * blow : 0.;
        if (s < 1.1)
          rail.load(patch, f);
        const double u = dynamics.synchronised() ? steps_per_sample * rail.displacement(patch) : 0.;
        for (unsigned int k = 0; k < lines.n; ++k)
          {
            force[k] += f * phase[k];
            displacement[k] += u * phase[k];
            phase[k] *= turn[k];
          }
        dynamics.step();
      }
    for (unsigned int k = 0; k < lines.n; ++k)
      result.values.push_back(displacement[k] / force[k]);
    return result;
  }

  /// Compliance of a section between its mean position and the points of the pad, m/N: bending and
  /// indentation of foot and web, which a beam does not have. It acts in series with the pad. Measured at
  /// rest. @param rail on three supports, loaded along its whole length
  inline double foot_compliance(const RailForTrack &three_spans, const TrackParameters &track)
  {
    DynamicsParameters parameters;
    parameters.gravity = 0.;
    TrackRail rail(MPI_COMM_SELF, three_spans, 3, track, parameters, {});
    rail.load(rail.sections(0., rail.end), 1e5);
    rail.dynamics->relax(1e-6, 100000, {});
    return (rail.displacement(rail.sections(0.)) + rail.supports->rail_displacement(1)) /
           rail.supports->force(1, Supports::pad);
  }

  /// Supports whose pads are in series with a compliance (m/N), which is small beside theirs: stiffness and
  /// damping of the pad at low frequencies.
  inline reference::SupportLayers softened(reference::SupportLayers layers, const double compliance)
  {
    const double share = 1. / (1. + compliance * layers.pad_stiffness);
    layers.pad_stiffness *= share;
    layers.pad_damping *= share * share;
    return layers;
  }

  /// The same of a beam.
  inline Receptance by_beam(const reference::SupportedBeam                    &beam,
                            const std::vector<reference::SupportedBeam::Load> &loads,
                            const Lines                                       &lines)
  {
    Receptance result{lines.lowest, lines.step, {}};
    for (unsigned int k = 0; k < lines.n; ++k)
      {
        const auto response =
          beam.respond(loads, {2. * dealii::numbers::PI * result.frequency(k), -lines.decay});
        std::complex<double> mean = 0.;
        for (const auto &load : loads)
          mean += load.force * response.deflection(load.x);
        result.values.push_back(mean);
      }
    return result;
  }

  /// Share of the vibration's energy (velocity squared) at the struck section, in a band, that would not be
  /// there if the rail went on.
  inline double reflected(const Receptance &r, const Receptance &endless, const double from, const double to)
  {
    double difference = 0., scale = 0.;
    for (unsigned int k = 0; k < r.values.size(); ++k)
      if (const double f = r.frequency(k); f >= from && f <= to)
        {
          difference += f * f * std::norm(r.values[k] - endless.values[k]);
          scale += f * f * std::norm(endless.values[k]);
        }
    return difference / scale;
  }
} // namespace tread::tests

#endif
