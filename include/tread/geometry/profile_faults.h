// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_profile_faults_h
#define tread_geometry_profile_faults_h

#include <tread/geometry/profile_file.h>

#include <utility>

namespace tread
{
  /// Refuse points that stand off the line of their neighbours: one or two beside each other, by more than
  /// the noise around them and by 10 um at least, where the line goes on behind them as before.
  void refuse_spikes(const std::string &file, const std::vector<ProfilePoint> &points);

  /// Leave out points that stand back on the line by a few hundredths of a millimetre.
  /// @param refuses whether others that turn back are refused, or stay
  /// @param remarks gets a line for each that is left out
  std::vector<ProfilePoint> without_turns_back(const std::string        &file,
                                               std::vector<ProfilePoint> points,
                                               const bool                refuses,
                                               std::vector<std::string> &remarks);

  /// Standard deviation of independent errors of the points within half_width of y = 0, and the usual
  /// distance of these points (m). Of every point the distance is taken from the cubic through two neighbours
  /// at each side; half of these distances lie below 0.94 of the standard deviation.
  std::pair<double, double> noise_and_spacing(const std::vector<ProfilePoint> &points,
                                              const double                     half_width);
} // namespace tread

#endif
