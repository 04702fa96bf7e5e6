// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_file_text_h
#define tread_base_file_text_h

#include <boost/crc.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

namespace tread
{
  /// All bytes of a file; none if it cannot be read, or is a folder.
  inline std::string text_of_file(const std::string &path)
  {
    std::error_code cannot_tell;
    if (std::filesystem::is_directory(path, cannot_tell))
      return "";
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  /// CRC-32 of a text.
  inline std::uint32_t checksum(const std::string &text)
  {
    boost::crc_32_type crc;
    crc.process_bytes(text.data(), text.size());
    return crc.checksum();
  }
} // namespace tread

#endif
