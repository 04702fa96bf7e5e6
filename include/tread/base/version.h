// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_version_h
#define tread_base_version_h

#include <string>

namespace tread
{
  /// Version of the project and, where known, the commit it was built from.
  std::string version();
} // namespace tread

#endif
