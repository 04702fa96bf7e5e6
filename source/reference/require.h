// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_require_h
#define tread_reference_require_h

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace tread::reference
{
  /// Throw std::invalid_argument "name = value: allowed is ..." unless holds.
  inline void require(const bool         holds,
                      const std::string &name,
                      const double       value,
                      const std::string &allowed)
  {
    if (holds)
      return;
    char number[40];
    std::snprintf(number, sizeof(number), "%g", value);
    throw std::invalid_argument(name + " = " + number + ": allowed is " + allowed);
  }

  /// A finite number > 0.
  inline void require_positive(const std::string &name, const double value, const std::string &unit)
  {
    require(std::isfinite(value) && value > 0., name, value,
            "a number > 0" + (unit.empty() ? "" : " " + unit));
  }

  inline void require_finite(const std::string &name, const double value)
  {
    require(std::isfinite(value), name, value, "a finite number");
  }
} // namespace tread::reference

#endif
