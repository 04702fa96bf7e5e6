// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_output_summary_keys_h
#define tread_output_summary_keys_h

#include <tread/output/columns.h>

#include <string>

namespace tread
{
  /// All keys that summary.json can have, with units and meanings, in the order in which they are written:
  /// the second of several wheels and the first cell stand for others, the largest pressure and Hertz for all
  /// figures that are compared and their sources. The keys of a patch are in scene/wheelset_summary.h.
  TableDescription keys_of_summary();

  /// Have a further key known: for a constant beside what sets it, before main() begins. @returns true
  bool know_summary_key(const std::string &key, const std::string &about);

  /// Of a key in the summary, whatever number its name has; empty: it is none.
  std::string about_summary_key(const std::string &key);
} // namespace tread

#endif
