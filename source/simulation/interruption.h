// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_simulation_interruption_h
#define tread_simulation_interruption_h

#include <exception>

namespace tread
{
  /// Ctrl-C before anything was computed that could be kept.
  class Interruption : public std::exception
  {
  };
} // namespace tread

#endif
