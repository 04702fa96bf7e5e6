// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_format_h
#define tread_base_format_h

#include <cstdio>
#include <string>

namespace tread
{
  /// Text after printf's pattern, of at most 511 characters.
  template <typename... T>
  std::string format(const char *pattern, const T... values)
  {
    char text[512];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
  }
} // namespace tread

#endif
