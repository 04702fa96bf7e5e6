// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tests_temporary_folder_h
#define tread_tests_temporary_folder_h

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace tread::tests
{
  /// A folder of this process that is there as long as the object.
  struct TemporaryFolder
  {
    const std::string path =
      (std::filesystem::temp_directory_path() / ("tread-test-" + std::to_string(getpid()))).string();

    TemporaryFolder()
    {
      std::filesystem::create_directories(path);
    }
    ~TemporaryFolder()
    {
      std::filesystem::remove_all(path);
    }

    /// @returns where it is
    std::string write(const std::string &name, const std::string &text) const
    {
      std::ofstream(path + "/" + name) << text;
      return path + "/" + name;
    }
  };
} // namespace tread::tests

#endif
