// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_dynamic_force_h
#define tread_analysis_dynamic_force_h

#include <tread/analysis/spectrum.h>

#include <string>
#include <vector>

namespace tread
{
  /// The forces in the history.csv of a run. Each row is the mean since the previous row.
  struct ForceHistory
  {
    std::string                      name;     ///< of the run, for messages
    std::vector<double>              time;     ///< s, of each row
    std::vector<double>              position; ///< of the wheel, m
    std::vector<std::string>         columns;  ///< those whose name ends with _N
    std::vector<std::vector<double>> force;    ///< N, [column][row]
  };

  /// The contribution of a defect to the force of one column.
  struct DynamicForce
  {
    std::string              column;
    std::vector<double>      values;                   ///< run minus smooth twin, N, at DynamicForces::time
    double                   peak;                     ///< the value of largest size, N
    double                   peak_time, peak_position; ///< s, m
    double                   force_at_peak;            ///< of the run, N
    double                   increase, decrease;       ///< largest and least value, N
    double                   increase_position, decrease_position; ///< m
    double                   at_the_end;  ///< largest size in the last tenth of the section, N
    double                   smooth_mean; ///< of the smooth twin over the section, N
    AmplitudeSpectrum        spectrum;
    std::vector<Oscillation> oscillations; ///< at most five
  };

  struct DynamicForces
  {
    double                    speed, interval; ///< m/s; s between the values
    std::vector<double>       time, position;  ///< middle of the intervals, equally spaced, s and m
    std::vector<DynamicForce> forces;
  };

  /// The forces of a run minus those of its smooth twin at equal times, which removes the effects of the
  /// mesh, the sleeper spacing and the start. Rows of the two lie at slightly different times if their time
  /// steps differ, so the twin is interpolated linearly in time, and so is the run between its own rows,
  /// which are not exactly equally spaced.
  /// @param from, to section of the position, m
  /// @throws std::invalid_argument with one line, if the twin rolled at another speed or does not cover the
  /// run
  DynamicForces dynamic_forces(const ForceHistory &run,
                               const ForceHistory &smooth_twin,
                               const Window        window,
                               const double        from,
                               const double        to);
} // namespace tread

#endif
