// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/progress.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace tread
{
  void TimeLeft::add(const double seconds, const double measure)
  {
    now = seconds;
    if (!(measure > 0.))
      return;
    constexpr double      anew      = 2.3; // logarithm of 10
    constexpr std::size_t swings    = 12;  // measures in which it swings at least once
    const double          logarithm = std::log(measure);
    if (!peaks.empty() && logarithm > peaks.back().logarithm + anew)
      {
        latest.clear();
        peaks.clear();
      }
    latest.push_back({seconds, logarithm});
    if (latest.size() > swings)
      latest.erase(latest.begin());
    peaks.push_back(*std::max_element(latest.begin(), latest.end(), [](const Sample &a, const Sample &b) {
      return a.logarithm < b.logarithm;
    }));
  }


  std::optional<double> TimeLeft::seconds() const
  {
    constexpr std::size_t least = 4;
    if (peaks.size() < least)
      return {};
    const Sample &last  = peaks.back();
    const auto    since = std::find_if(peaks.rbegin(), peaks.rend(), [&](const Sample &before) {
      return before.logarithm >= last.logarithm + 1.;
    });
    const Sample &then  = since == peaks.rend() ? peaks.front() : *since;
    const double  rate  = (then.logarithm - last.logarithm) / (last.seconds - then.seconds);
    if (!(rate > 0.) || !std::isfinite(rate))
      return {};
    return std::max(0., last.seconds + (last.logarithm - std::log(limit)) / rate - now);
  }


  Progress::Progress(const bool speaks)
    : speaks(speaks)
    , terminal(isatty(fileno(stdout)) &&
               std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) // mpirun gives a terminal to log files, too
    , start(std::chrono::steady_clock::now())
    , last(start)
  {
  }


  void Progress::say(const std::string &line)
  {
    if (!speaks)
      return;
    std::printf("%s%s\n", pending ? "\n" : "", line.c_str());
    std::fflush(stdout);
    pending = false;
  }


  bool Progress::due() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - last).count() >
           (terminal ? 0.5 : 5.);
  }


  void Progress::show(const std::string &line)
  {
    last = std::chrono::steady_clock::now();
    if (!speaks)
      return;
    if (terminal)
      std::printf("\r%-110s", line.c_str());
    else
      std::printf("%s\n", line.c_str());
    std::fflush(stdout);
    pending = terminal;
  }


  double Progress::seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
} // namespace tread
