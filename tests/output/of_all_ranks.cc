// SPDX-License-Identifier: LGPL-2.1-or-later
// A file with what all ranks have, in more messages than one: its size, its checksum and its bytes. A file
// that cannot be written is told on rank 0, and no rank waits for it.
#include <tread/base/file_text.h>
#include <tread/output/run_folder.h>

#include <deal.II/base/mpi.h>

#include "check.h"
#include "temporary_folder.h"
#include <sys/resource.h>

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>

using namespace tread;

namespace output_of_all_ranks
{
  /// None on rank 0, three messages on rank 1, a whole one on rank 2.
  std::string bytes_of(const unsigned int rank)
  {
    const std::size_t sizes[] = {0, 37'000'001, std::size_t(1) << 24};
    std::string       bytes(sizes[rank % 3], '\0');
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = static_cast<char>(i ^ ((i >> 8) * (rank + 7)) ^ (i >> 16) ^ (i >> 24));
    return bytes;
  }
} // namespace output_of_all_ranks


TREAD_TEST(output_of_all_ranks)(tests::Check &check, const tests::Arguments &)
{
  const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
                     n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const tests::TemporaryFolder temporary;
  const std::string path = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, temporary.path, 0) + "/run";
  const RunFolder   folder(path, MPI_COMM_WORLD);

  std::string expected = "what is alike\n";
  for (unsigned int r = 0; r < n_ranks; ++r)
    expected += bytes_of(r);
  folder.write_of_all("all", "word-1", "what is alike\n", bytes_of(rank));
  const std::string gathered = folder.gather(bytes_of(rank));
  if (rank == 0)
    {
      const std::string  file = text_of_file(path + "/all");
      const std::size_t  end  = file.find('\n');
      std::istringstream head(file.substr(0, end));
      std::string        word;
      std::size_t        size = 0;
      unsigned int       sum  = 0;
      head >> word >> size >> sum;
      check.that("the word", word == "word-1");
      check.absolute("size, bytes", size, expected.size(), 0.);
      check.absolute("checksum", sum, checksum(expected), 0.);
      check.that("the bytes", file.substr(end + 1) == expected);
      check.that("gathered", gathered == expected.substr(expected.find('\n') + 1));
    }
  else
    check.that("gathered on rank 0 alone", gathered.empty());

  // No folder, and a disk that is full: here no file may be larger than that. What comes next finds no
  // message left.
  constexpr rlim_t room = 1 << 20; // bytes
  rlimit           before;
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{room, before.rlim_max};
  for (const char *const name : {"no such folder/all", "too large"})
    {
      const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
      setrlimit(RLIMIT_FSIZE, &small);
      bool failed = false;
      try
        {
          folder.write_of_all(name, "word-1", std::string(2 * room, 'x'), bytes_of(rank));
        }
      catch (const std::runtime_error &)
        {
          failed = true;
        }
      setrlimit(RLIMIT_FSIZE, &before);
      std::signal(SIGXFSZ, old_handler);
      check.that(std::string(name) + ": told on rank 0", failed == (rank == 0));
      if (rank == 0)
        check.that(std::string(name) + ": nothing of it stays",
                   !std::filesystem::exists(path + "/" + name + ".part"));
      const std::string of_all = folder.gather(std::string(1, static_cast<char>('a' + rank)));
      check.that(std::string(name) + ": the next ones are whole",
                 of_all == (rank == 0 ? std::string("abc").substr(0, n_ranks) : ""));
    }
}
