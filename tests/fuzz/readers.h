// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tests_fuzz_readers_h
#define tread_tests_fuzz_readers_h

#include <string>
#include <vector>

namespace tread::fuzz
{
  /// One of the program's readers of files.
  struct Reader
  {
    std::string name;   ///< also of the folder of its examples
    std::string ending; ///< of its files, by which formats are told apart
    void (*read)(const std::string &file);
  };

  const std::vector<Reader> &readers();

  /// @throws std::runtime_error that lists the names if there is none of this one
  const Reader &reader_named(const std::string &name);

  /// Give a reader a file with this content. It must read it or refuse it with an InputError of one line:
  /// anything else is printed, and ends the process by abort(). @returns whether it was read
  bool accepts(const Reader &reader, const std::string &content);

  /// The file that the readers of this process are given; its folder goes with the process unless it aborts.
  std::string file_given_to(const Reader &reader);
} // namespace tread::fuzz

#endif
