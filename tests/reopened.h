// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tests_reopened_h
#define tread_tests_reopened_h

#include <tread/base/archive.h>
#include <tread/base/gathered.h>

namespace tread::tests
{
  /// What all ranks of a communicator have stored, in the bytes that a file would hold.
  inline std::string parts_of(const Archive &archive, const MPI_Comm comm)
  {
    const std::string       own = archive.stored();
    const std::vector<char> all = gathered(std::vector<char>(own.begin(), own.end()), comm);
    return std::string(all.begin(), all.end());
  }
} // namespace tread::tests

#endif
