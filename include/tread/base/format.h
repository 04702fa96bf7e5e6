// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_format_h
#define tread_base_format_h

#include <cstdio>
#include <string>

namespace tread
{
  /// Text after printf's pattern.
  template <typename... T>
  std::string format(const char *pattern, const T... values)
  {
    const int   length = std::snprintf(nullptr, 0, pattern, values...);
    std::string text(length > 0 ? length : 0, ' ');
    std::snprintf(text.data(), text.size() + 1, pattern, values...);
    return text;
  }

  /// A number with six digits, as messages show it.
  inline std::string text_of(const double value)
  {
    return format("%g", value);
  }

  /// The same of a length in m, shown in mm.
  inline std::string text_in_mm(const double length)
  {
    return text_of(1e3 * length);
  }
} // namespace tread

#endif
