// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_output_progress_h
#define tread_output_progress_h

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace tread
{
  /// Time left until a measure that swings while it falls has reached a limit: its peaks fall at the mean
  /// rate since they were e times as large, or from the beginning on.
  class TimeLeft
  {
  public:
    /// @param limit above 0
    explicit TimeLeft(const double limit)
      : limit(limit)
    {
    }

    /// The measure now, s after some beginning. One that has grown tenfold begins anew.
    void add(const double seconds, const double measure);

    /// Seconds; nothing as long as it does not fall, or of fewer than four measures.
    std::optional<double> seconds() const;

  private:
    struct Sample
    {
      double seconds, logarithm;
    };
    double              limit, now = 0.;
    std::vector<Sample> latest; ///< measures
    std::vector<Sample> peaks;  ///< the largest of the latest, with its time
  };


  /// Lines on the terminal, from rank 0 only: the last one is rewritten in place on a terminal,
  /// and repeated every few seconds in a log file.
  class Progress
  {
  public:
    explicit Progress(const bool speaks);

    /// A line that stays.
    void say(const std::string &line);

    /// Whether it is time to show the state again.
    bool due() const;

    /// A line that the next one replaces.
    void show(const std::string &line);

    double seconds() const;

  private:
    bool                                  speaks, terminal, pending = false;
    std::chrono::steady_clock::time_point start, last;
  };
} // namespace tread

#endif
