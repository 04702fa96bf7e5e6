// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/dynamic_force.h>
#include <tread/base/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace tread
{
  namespace
  {
    /// Rows or intervals without which there is no spectrum worth the name: twice what it needs at least.
    constexpr int least_rows = 16;
    /// Largest relative difference of the speeds of a run and its smooth twin: over a section of 1 m they are
    /// then apart by 1 mm, much less than a patch.
    constexpr double same_speed = 1e-3;
    /// Of an interval: a section that is shorter by rounding alone still has its last interval.
    constexpr double       of_intervals   = 1e-6;
    constexpr unsigned int n_oscillations = 5; ///< kept of a spectrum

    /// When the rows of a history belong: the middle of their intervals.
    struct Intervals
    {
      double              length, speed; ///< mean length, s; m/s
      std::vector<double> middle;        ///< s

      Intervals(const ForceHistory &history)
      {
        const std::vector<double> &x = history.position, &t = history.time;
        if (t.size() < least_rows)
          throw std::invalid_argument(format("%s has %zu rows; a dynamic force needs at least %d",
                                             history.name.c_str(), t.size(), least_rows));
        for (std::size_t i = 1; i < t.size(); ++i)
          if (!(x[i] > x[i - 1]) || !(t[i] > t[i - 1]))
            throw std::invalid_argument(
              format("%s: time or position goes back in row %zu", history.name.c_str(), i + 1));
        const std::size_t n = t.size() - 2; // the last row ends with the run
        length              = (t[n] - t[0]) / n;
        speed               = (x.back() - x.front()) / (t.back() - t.front());
        middle.push_back(t[0] - 0.5 * length);
        for (std::size_t i = 1; i < t.size(); ++i)
          middle.push_back(0.5 * (t[i - 1] + t[i]));
        if (t.back() - t[n] < 0.5 * length)
          middle.pop_back();
      }

      double position(const ForceHistory &history, const double time) const
      {
        return history.position.front() + speed * (time - history.time.front());
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
    if (std::abs(of_run.speed / of_twin.speed - 1.) > same_speed)
      throw std::invalid_argument(format("%s rolls at %.4g km/h, its smooth twin %s at %.4g km/h",
                                         run.name.c_str(), 3.6 * of_run.speed, smooth_twin.name.c_str(),
                                         3.6 * of_twin.speed));
    // The section of the run.
    const auto at = [&](const double time) {
      return of_run.position(run, time);
    };
    const auto after     = std::partition_point(of_run.middle.begin(), of_run.middle.end(),
                                                [&](const double time) { return at(time) < from; }),
               before    = std::partition_point(after, of_run.middle.end(),
                                                [&](const double time) { return at(time) <= to; });
    const auto too_short = [&](const std::size_t n) {
      return std::invalid_argument(
        format("%s has %zu intervals in the section; a dynamic force needs at least %d", run.name.c_str(), n,
               least_rows));
    };
    if (before - after < least_rows)
      throw too_short(before - after);
    double begin = *after, end = *(before - 1);
    // One interval may be missing at either end.
    const double missing = std::max(of_run.length, of_twin.length);
    if (of_twin.middle.front() > begin + missing || of_twin.middle.back() < end - missing)
      throw std::invalid_argument(
        format("the smooth twin %s, from %.2f to %.2f mm, does not cover %s from %.2f to %.2f mm",
               smooth_twin.name.c_str(), 1e3 * of_twin.position(smooth_twin, of_twin.middle.front()),
               1e3 * of_twin.position(smooth_twin, of_twin.middle.back()), run.name.c_str(), 1e3 * at(begin),
               1e3 * at(end)));
    // Equally spaced from a row of the run on.
    begin = *std::partition_point(after, before - 1,
                                  [&](const double time) { return time < of_twin.middle.front(); });
    end   = std::min(end, of_twin.middle.back());
    const std::size_t n =
      static_cast<std::size_t>(std::max(0., end - begin) / of_run.length + of_intervals) + 1;
    if (n < least_rows)
      throw too_short(n);

    DynamicForces result;
    result.speed    = of_run.speed;
    result.interval = of_run.length;
    for (std::size_t i = 0; i < n; ++i)
      {
        result.time.push_back(begin + i * of_run.length);
        result.position.push_back(at(result.time[i]));
      }
    for (std::size_t column = 0; column < run.columns.size(); ++column)
      {
        const auto twin =
          std::find(smooth_twin.columns.begin(), smooth_twin.columns.end(), run.columns[column]);
        if (twin == smooth_twin.columns.end())
          throw std::invalid_argument(smooth_twin.name + " has no column '" + run.columns[column] +
                                      "', which " + run.name + " has");
        const auto with_defect = [&](const double time) {
          return interpolated(of_run.middle, run.force[column], time);
        };
        const auto smooth = [&](const double time) {
          return interpolated(of_twin.middle, smooth_twin.force[twin - smooth_twin.columns.begin()], time);
        };
        DynamicForce force;
        force.column      = run.columns[column];
        force.smooth_mean = 0.;
        for (const double time : result.time)
          {
            force.values.push_back(with_defect(time) - smooth(time));
            force.smooth_mean += smooth(time) / n;
          }
        const auto by_size = [](const double a, const double b) {
          return std::abs(a) < std::abs(b);
        };
        const auto        begin = force.values.begin(), end = force.values.end();
        const std::size_t upmost  = std::max_element(begin, end) - begin,
                          lowest  = std::min_element(begin, end) - begin,
                          largest = by_size(force.values[upmost], force.values[lowest]) ? lowest : upmost;
        force.increase            = force.values[upmost];
        force.decrease            = force.values[lowest];
        force.increase_position   = result.position[upmost];
        force.decrease_position   = result.position[lowest];
        force.at_the_end          = std::abs(*std::max_element(end - (n + 9) / 10, end, by_size));
        force.peak                = force.values[largest];
        force.peak_time           = result.time[largest];
        force.peak_position       = result.position[largest];
        force.force_at_peak       = with_defect(force.peak_time);
        force.spectrum            = amplitude_spectrum(force.values, result.interval, window);
        force.oscillations =
          dominant_oscillations(force.values, result.interval, force.spectrum, n_oscillations);
        result.forces.push_back(force);
      }
    return result;
  }
} // namespace tread
