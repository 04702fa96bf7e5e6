// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_registry_h
#define tread_base_registry_h

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace tread
{
  /// The entry of this name. @param what the entries are
  /// @throws std::invalid_argument if there is none
  template <typename Entry>
  const Entry &entry_named(const std::vector<Entry> &entries,
                           const std::string        &name,
                           const std::string        &what)
  {
    const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const Entry &entry) { return entry.name == name; });
    if (found == entries.end())
      throw std::invalid_argument("there is no " + what + " '" + name + "'");
    return *found;
  }
} // namespace tread

#endif
