// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/progress.h>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace tread
{
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
