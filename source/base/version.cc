// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/version.h>

namespace tread
{
  std::string version()
  {
    const std::string commit = TREAD_COMMIT;
    return std::string(TREAD_VERSION) + (commit.empty() ? "" : " (" + commit + ")");
  }
} // namespace tread
