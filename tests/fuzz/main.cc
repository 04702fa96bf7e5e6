// SPDX-License-Identifier: LGPL-2.1-or-later
// Gives a reader its examples, then mutations of them for a number of executions:
//
//     fuzz_readers READER EXECUTIONS [SEED]      fuzz_readers READER FILE
//
// The same seed gives the same files. Whatever is neither reading nor an InputError ends the process.
#include <deal.II/base/mpi.h>

#include "mutate.h"
#include "readers.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

using namespace tread::fuzz;

namespace
{
  std::string content_of(const std::filesystem::path &file)
  {
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
      throw std::runtime_error("cannot read '" + file.string() + "'");
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }

  /// In the order of their names, which folders do not have on all systems.
  std::vector<std::string> examples_of(const Reader &reader)
  {
    std::vector<std::filesystem::path> files;
    for (const auto &entry : std::filesystem::directory_iterator(TREAD_FUZZ_CORPUS "/" + reader.name))
      files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<std::string> contents;
    for (const std::filesystem::path &file : files)
      contents.push_back(content_of(file));
    return contents;
  }

  void fuzz(const Reader &reader, const unsigned long executions, const unsigned long seed)
  {
    const std::vector<std::string> examples = examples_of(reader);
    const auto                     start    = std::chrono::steady_clock::now();
    unsigned long                  n_read   = 0;
    for (const std::string &example : examples)
      n_read += accepts(reader, example);
    if (n_read == 0)
      throw std::runtime_error(reader.name + ": none of the examples is read");
    Random                   random(seed);
    std::vector<std::string> kept = examples; // and mutations of them that were read
    for (unsigned long i = 0; i < executions; ++i)
      {
        const std::string content = mutated(kept[random() % kept.size()], examples, random);
        if (!accepts(reader, content))
          continue;
        ++n_read;
        constexpr std::size_t most = 200;
        if (kept.size() < most)
          kept.push_back(content);
        else if (const std::size_t place = random() % kept.size(); place >= examples.size())
          kept[place] = content;
      }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::fprintf(stderr,
                 "%-12s %8lu executions, seed %lu, %.1f s: %lu read, the others refused in one line\n",
                 reader.name.c_str(), examples.size() + executions, seed, seconds.count(), n_read);
  }

  int run(const int argc, char **argv)
  {
    if (argc != 3 && argc != 4)
      throw std::runtime_error("fuzz_readers READER EXECUTIONS [SEED], or fuzz_readers READER FILE");
    const Reader       &reader = reader_named(argv[1]);
    char               *end;
    const unsigned long executions = std::strtoul(argv[2], &end, 10);
    if (*end == 0)
      fuzz(reader, executions, argc == 4 ? std::strtoul(argv[3], nullptr, 10) : 1);
    else
      std::fprintf(stderr, "%s\n", accepts(reader, content_of(argv[2])) ? "read" : "refused");
    return 0;
  }
} // namespace


int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  try
    {
      return run(argc, argv);
    }
  catch (const std::exception &error)
    {
      std::fprintf(stderr, "fuzz_readers: %s\n", error.what());
      return 1;
    }
}
