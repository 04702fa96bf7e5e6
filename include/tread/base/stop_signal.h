// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_stop_signal_h
#define tread_base_stop_signal_h

namespace tread
{
  /// From now on the first Ctrl-C or SIGTERM asks the program to stop; the second one ends it at once.
  void watch_stop_signals();

  /// Whether this process was asked to stop.
  bool stop_was_asked();
} // namespace tread

#endif
