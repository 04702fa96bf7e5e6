// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_went_wrong_h
#define tread_base_went_wrong_h

#include <stdexcept>

namespace tread
{
  /// A run that goes wrong: what, where and when in one line. All ranks notice it in the same step, so that
  /// they can still write together what was computed until then.
  class WentWrong : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
} // namespace tread

#endif
