// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/stop_signal.h>

#include <csignal>

namespace tread
{
  namespace
  {
    volatile std::sig_atomic_t signal_received = 0;

    void on_signal(const int number)
    {
      std::signal(number, SIG_DFL);
      signal_received = 1;
    }
  } // namespace


  void watch_stop_signals()
  {
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
  }


  bool stop_was_asked()
  {
    return signal_received != 0;
  }
} // namespace tread
