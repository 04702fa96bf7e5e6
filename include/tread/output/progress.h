// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_output_progress_h
#define tread_output_progress_h

#include <chrono>
#include <string>

namespace tread
{
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
