// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/dynamic_force.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>

namespace tread
{
  namespace
  {
    template <typename... T>
    std::string format(const char *pattern, const T... values)
    {
      char text[256];
      std::snprintf(text, sizeof text, pattern, values...);
      return text;
    }

    /// Where the rows of a history belong: the middle of their intervals.
    struct Intervals
    {
      double              length, speed; ///< usual length, m; m/s
      std::vector<double> middle;        ///< m

      Intervals(const ForceHistory &history)
      {
        const std::vector<double> &x = history.position;
        if (x.size() < 16)
          throw std::invalid_argument(
            format("%s has %zu rows; a dynamic force needs at least 16", history.name.c_str(), x.size()));
        for (std::size_t i = 1; i < x.size(); ++i)
          if (!(x[i] > x[i - 1]) || !(history.time[i] > history.time[i - 1]))
            throw std::invalid_argument(
              format("%s: time or position goes back in row %zu", history.name.c_str(), i + 1));
        std::vector<double> lengths(x.size() - 1);
        for (std::size_t i = 0; i < lengths.size(); ++i)
          lengths[i] = x[i + 1] - x[i];
        std::nth_element(lengths.begin(), lengths.begin() + lengths.size() / 2, lengths.end());
        length = lengths[lengths.size() / 2];
        speed  = (x.back() - x.front()) / (history.time.back() - history.time.front());
        middle.push_back(x[0] - 0.5 * length);
        for (std::size_t i = 1; i < x.size(); ++i)
          middle.push_back(0.5 * (x[i - 1] + x[i]));
        if (x.back() - x[x.size() - 2] < 0.5 * length)
          middle.pop_back(); // the last row ends with the run
      }
    };

    double interpolated(const std::vector<double> &x, const std::vector<double> &y, const double at)
    {
      const std::size_t i =
        std::clamp<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin(), 1, x.size() - 1);
      const double share = std::clamp((at - x[i - 1]) / (x[i] - x[i - 1]), 0., 1.);
      return (1. - share) * y[i - 1] + share * y[i];
    }
  } // namespace


  DynamicForces dynamic_forces(const ForceHistory &run,
                               const ForceHistory &smooth_twin,
                               const Window        window,
                               const double        from,
                               const double        to)
  {
    const Intervals of_run(run), of_twin(smooth_twin);
    if (std::abs(of_run.speed / of_twin.speed - 1.) > 1e-3)
      throw std::invalid_argument(format("%s rolls at %.4g km/h, its smooth twin %s at %.4g km/h",
                                         run.name.c_str(), 3.6 * of_run.speed, smooth_twin.name.c_str(),
                                         3.6 * of_twin.speed));
    if (std::abs(of_run.length / of_twin.length - 1.) > 0.02)
      throw std::invalid_argument(format("%s has a row every %.4g mm, its smooth twin %s every %.4g mm: set "
                                         "'Output/History interval (mm)' alike",
                                         run.name.c_str(), 1e3 * of_run.length, smooth_twin.name.c_str(),
                                         1e3 * of_twin.length));
    // Equally spaced from a row of the run on.
    const std::vector<double> &rows = of_run.middle;
    const auto   first = std::lower_bound(rows.begin(), rows.end(), std::max(from, of_twin.middle.front()));
    const double begin = first == rows.end() ? rows.back() : *first,
                 end   = std::min({to, rows.back(), of_twin.middle.back()});
    const std::size_t n =
      end < begin ? 0 : static_cast<std::size_t>((end - begin) / of_run.length + 1e-6) + 1;
    if (n < 16)
      throw std::invalid_argument(
        format("%s and its smooth twin %s have %zu intervals in common; a dynamic force needs "
               "at least 16",
               run.name.c_str(), smooth_twin.name.c_str(), n));

    DynamicForces result;
    result.speed    = of_run.speed;
    result.interval = of_run.length / of_run.speed;
    for (std::size_t i = 0; i < n; ++i)
      {
        result.position.push_back(begin + i * of_run.length);
        result.time.push_back(run.time.front() + (result.position[i] - run.position.front()) / result.speed);
      }
    for (std::size_t column = 0; column < run.columns.size(); ++column)
      {
        const auto twin =
          std::find(smooth_twin.columns.begin(), smooth_twin.columns.end(), run.columns[column]);
        if (twin == smooth_twin.columns.end())
          throw std::invalid_argument(smooth_twin.name + " has no column '" + run.columns[column] +
                                      "', which " + run.name + " has");
        const auto with_defect = [&](const double x) {
          return interpolated(of_run.middle, run.force[column], x);
        };
        const auto smooth = [&](const double x) {
          return interpolated(of_twin.middle, smooth_twin.force[twin - smooth_twin.columns.begin()], x);
        };
        DynamicForce force;
        force.column      = run.columns[column];
        force.smooth_mean = 0.;
        for (const double x : result.position)
          {
            force.values.push_back(with_defect(x) - smooth(x));
            force.smooth_mean += smooth(x) / n;
          }
        const std::size_t largest =
          std::max_element(force.values.begin(), force.values.end(),
                           [](const double a, const double b) { return std::abs(a) < std::abs(b); }) -
          force.values.begin();
        force.peak          = force.values[largest];
        force.peak_time     = result.time[largest];
        force.peak_position = result.position[largest];
        force.force_at_peak = with_defect(force.peak_position);
        force.spectrum      = amplitude_spectrum(force.values, result.interval, window);
        force.oscillations  = dominant_oscillations(force.values, result.interval, force.spectrum, 5);
        result.forces.push_back(force);
      }
    return result;
  }
} // namespace tread
