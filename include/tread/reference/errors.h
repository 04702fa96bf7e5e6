// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_errors_h
#define tread_reference_errors_h

#include <stdexcept>
#include <string>

namespace tread::reference
{
  /// Contact reaches the border of the grid, so that a larger one may have an answer.
  struct ReachesBorder : std::runtime_error
  {
    ReachesBorder()
      : std::runtime_error("contact reaches the border of the grid")
    {
    }
  };

  /// Friction falls with slip so steeply that no steady state is found on the elements at hand.
  struct FrictionTooSteep : std::runtime_error
  {
    explicit FrictionTooSteep(const std::string &reason)
      : std::runtime_error("friction falls with slip too steeply for a steady state on these elements (" +
                           reason + "): a longer memory, or a law that falls over higher slip speeds, helps")
    {
    }
  };
} // namespace tread::reference

#endif
