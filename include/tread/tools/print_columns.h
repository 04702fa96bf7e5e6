// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tools_print_columns_h
#define tread_tools_print_columns_h

#include <ostream>

namespace tread
{
  /// All tables that the program writes and what their columns mean, as JSON: an array of file and columns,
  /// each with name (as in the heading), unit and meaning.
  void print_columns(std::ostream &out);
} // namespace tread

#endif
