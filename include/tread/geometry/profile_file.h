// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_profile_file_h
#define tread_geometry_profile_file_h

#include <string>
#include <vector>

namespace tread
{
  /// A point of a profile as its file has it.
  struct ProfilePoint
  {
    double       y, z; ///< m; along the rail and up where the profile is one along the rail
    unsigned int line; ///< in the file
  };

  /// Whose profile a file should have.
  enum class ProfileBody
  {
    rail,
    wheel,
    along_rail
  };

  /// The points of a file: two columns, .prr and .prw of Simpack, .ban and .whl of MiniProf.
  /// @throws std::runtime_error, one line with file, line and cause
  std::vector<ProfilePoint> read_profile_points(const std::string &file, const ProfileBody body);

  /// @throws std::runtime_error that begins with the file and, where it is not 0, the line.
  [[noreturn]] void refuse_profile(const std::string &file, const unsigned int line, const std::string &what);
} // namespace tread

#endif
