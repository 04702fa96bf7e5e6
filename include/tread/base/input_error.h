// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_input_error_h
#define tread_base_input_error_h

#include <stdexcept>
#include <string>

namespace tread
{
  /// A parameter, option, file or folder of the user's that cannot be used; what() is one line for them.
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// @throws InputError with this line unless the condition holds.
  inline void require(const bool holds, const std::string &line)
  {
    if (!holds)
      throw InputError(line);
  }
} // namespace tread

#endif
