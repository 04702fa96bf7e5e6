// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tests_fuzz_mutate_h
#define tread_tests_fuzz_mutate_h

#include <random>
#include <string>
#include <vector>

namespace tread::fuzz
{
  using Random = std::mt19937;

  /// The content with some of the changes that files suffer: bytes, numbers, words and lines that are wrong,
  /// missing, doubled or taken from another file. The same from the same state of random.
  /// @param others files of the same kind @pre not empty
  std::string mutated(std::string content, const std::vector<std::string> &others, Random &random);
} // namespace tread::fuzz

#endif
