// SPDX-License-Identifier: LGPL-2.1-or-later
// The readers under libFuzzer of LLVM, which keeps what reaches new code. The environment variable
// TREAD_READER names the reader.
#include <deal.II/base/mpi.h>

#include "mutate.h"
#include "readers.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <optional>

using namespace tread::fuzz;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t *data, std::size_t size, std::size_t most);

namespace
{
  const Reader &chosen()
  {
    const char *const    name   = std::getenv("TREAD_READER");
    static const Reader &reader = reader_named(name ? name : "");
    return reader;
  }
} // namespace

extern "C" int LLVMFuzzerInitialize(int *argc, char ***argv)
{
  static dealii::Utilities::MPI::MPI_InitFinalize mpi(*argc, *argv, 1);
  chosen();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  accepts(chosen(), std::string(reinterpret_cast<const char *>(data), size));
  return 0;
}

/// Half of the mutations are libFuzzer's own, the others know numbers, words and lines.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t      *data,
                                               const std::size_t  size,
                                               const std::size_t  most,
                                               const unsigned int seed)
{
  if (seed % 2 == 0)
    return LLVMFuzzerMutate(data, size, most);
  Random            random(seed);
  const std::string content(reinterpret_cast<const char *>(data), size);
  const std::string changed = mutated(content, {content}, random);
  const std::size_t length  = std::min(changed.size(), most);
  std::memcpy(data, changed.data(), length);
  return length;
}
