// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_profile_names_h
#define tread_geometry_profile_names_h

#include <string>

namespace tread
{
  /// What to do about a name of a rail that is known but not one of RailProfile's: a former name, another
  /// spelling, or a rail whose head is not public. Empty if the name says nothing.
  std::string advice_on_rail(const std::string &name);

  /// The same of a wheel's tread that is not one of tread_offset().
  std::string advice_on_tread(const std::string &name);

  /// Why a tread cannot be used, and what can: for a name that is no file advice_on_tread() too.
  /// @param why what is wrong with the file that it names
  std::string refused_tread(const std::string &tread, const std::string &why);
} // namespace tread

#endif
