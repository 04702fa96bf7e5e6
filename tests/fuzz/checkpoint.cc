// SPDX-License-Identifier: LGPL-2.1-or-later
// Resumes a small run from checkpoints that were forged, with a checksum that is right:
//
//     fuzz_checkpoint EXECUTIONS [SEED]       fuzz_checkpoint FILE
//
// Each of them must be refused, go wrong in one line, or roll on. Anything else ends the process; the
// checkpoint is then in the folder that is printed at the start.
#include <tread/scene/scene.h>
#include <tread/simulation/simulation.h>

#include <deal.II/base/mpi.h>

#include "mutate.h"
#include <boost/crc.hpp>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <thread>

using namespace tread;
using fuzz::Random;

namespace
{
  constexpr unsigned int longest_seconds = 120;

  const std::vector<std::string> settings{"Rail/Shape=block",
                                          "Rail/Crown radius (mm)=300",
                                          "Rail/Block width (mm)=60",
                                          "Rail/Block height (mm)=150",
                                          "Rail/Begin (mm)=-450",
                                          "Rail/Length (mm)=900",
                                          "Rail/Yield stress (MPa)=400",
                                          "Rail/Tangent modulus (GPa)=20",
                                          "Mesh/Finest cell (mm)=2.5",
                                          "Mesh/Fine half width (mm)=0",
                                          "Mesh/Coarsest cell (mm)=60",
                                          "Mesh/Fine layers=2",
                                          "Track/Foundation=two-layer",
                                          "Track/Sleeper spacing (m)=0.3",
                                          "Track/Pad width (mm)=50",
                                          "Motion/Rolled distance (mm)=10",
                                          "Motion/Traction coefficient=0.1",
                                          "Output/Write volume=false",
                                          "Output/History interval (mm)=1",
                                          "Output/Cells=-5,0,3",
                                          "Time stepping/Levels=2"};

  std::string content_of(const std::filesystem::path &file)
  {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }

  void write(const std::filesystem::path &file, const std::string &content)
  {
    if (!(std::ofstream(file, std::ios::binary) << content))
      throw std::runtime_error("cannot write " + file.string());
  }

  /// Roll until the first row of the history is written, then as with Ctrl-C. That signal stays: all later
  /// runs of the process roll ten steps.
  void roll_and_interrupt(const Scene &scene, const std::filesystem::path &folder)
  {
    std::thread ctrl_c([&] {
      const std::filesystem::path history = folder / "history.csv";
      while (std::count(std::istreambuf_iterator<char>(std::ifstream(history).rdbuf()), {}, '\n') < 3)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      std::raise(SIGINT);
    });
    run(scene, MPI_COMM_WORLD, folder, false);
    ctrl_c.join();
  }

  /// A checkpoint in parts: what stands before the state, and the groups of values of the state.
  struct Content
  {
    std::string              texts;  ///< parameters, progress of the tables and window, each with its size
    std::vector<std::string> groups; ///< each with its number and size of values

    explicit Content(const std::string &file)
    {
      const std::string all   = file.substr(file.find('\n') + 1);
      std::size_t       begin = 0;
      for (unsigned int text = 0; text < 3; ++text)
        {
          std::uint64_t size;
          std::memcpy(&size, all.data() + begin, sizeof size);
          begin += sizeof size + size;
        }
      texts = all.substr(0, begin);
      begin += sizeof(std::uint64_t); // size of the only part
      while (begin < all.size())
        {
          std::uint64_t head[2];
          std::memcpy(head, all.data() + begin, sizeof head);
          const std::size_t length = sizeof head + head[0] * head[1];
          groups.push_back(all.substr(begin, length));
          begin += length;
        }
    }

    std::string file(const std::string &layout) const
    {
      std::string state;
      for (const std::string &group : groups)
        state += group;
      const std::uint64_t size = state.size();
      const std::string all = texts + std::string(reinterpret_cast<const char *>(&size), sizeof size) + state;
      boost::crc_32_type crc;
      crc.process_bytes(all.data(), all.size());
      std::ostringstream text;
      text << layout << ' ' << all.size() << ' ' << crc.checksum() << '\n' << all;
      return text.str();
    }
  };

  template <typename T>
  void put(std::string &bytes, const std::size_t place, const T value)
  {
    if (place + sizeof value <= bytes.size())
      std::memcpy(bytes.data() + place, &value, sizeof value);
  }

  /// Change one group, in its head, its values or the number of them, or its place among the others.
  void forge(std::vector<std::string> &groups, Random &random)
  {
    const std::array<double, 9> odd{
      {0., -1., 1e-300, 1e300, -1e300, std::nan(""), 1e9, std::numeric_limits<double>::infinity(), 1.}};
    const std::array<std::uint32_t, 6> counts{{0, 1, 77, 0x7fffffff, 0xffffffff, 0x80000000}};
    constexpr std::size_t              head  = 2 * sizeof(std::uint64_t);
    const std::size_t                  k     = random() % groups.size();
    std::string                       &group = groups[k];
    std::uint64_t                      number, size;
    std::memcpy(&number, group.data(), sizeof number);
    std::memcpy(&size, group.data() + sizeof number, sizeof size);
    const std::size_t values = group.size() - head;
    switch (random() % 8)
      {
      case 0: // a number of values that are not there
        put(group, 8 * (random() % 2),
            std::uint64_t(counts[random() % counts.size()]) << (random() % 2 ? 32 : 0));
        break;
      case 1: // fewer values
        if (number > 0)
          {
            put(group, 0, number - 1);
            group.resize(group.size() - size);
          }
        break;
      case 2: // more values
        put(group, 0, number + 1);
        group += size > 0 && values >= size ? group.substr(head, size) : std::string(size, '\1');
        break;
      case 3:
      case 4:
        if (values >= sizeof(double))
          put(group, head + 8 * (random() % (values / 8)), odd[random() % odd.size()]);
        break;
      case 5:
        if (values >= 4)
          put(group, head + 4 * (random() % (values / 4)), counts[random() % counts.size()]);
        break;
      case 6:
        if (values > 0)
          group[head + random() % values] = static_cast<char>(random() % 256);
        break;
      default:
        std::swap(groups[k], groups[random() % groups.size()]);
      }
  }

  /// Roll on from the files of a folder. @returns what became of it, in a word
  std::string resume(const Scene &scene, const std::filesystem::path &folder)
  {
    alarm(longest_seconds);
    std::string outcome = "rolled on", said;
    try
      {
        run(scene, MPI_COMM_WORLD, folder, true);
      }
    catch (const InputError &error)
      {
        outcome = "refused";
        said    = error.what();
      }
    catch (const std::runtime_error &error)
      {
        outcome = "went wrong";
        said    = error.what();
      }
    alarm(0);
    if (said.find('\n') != said.npos)
      throw std::logic_error("more than one line: " + said);
    return outcome;
  }

  int run(const int argc, char **argv)
  {
    if (argc != 2 && argc != 3)
      throw std::runtime_error("fuzz_checkpoint EXECUTIONS [SEED], or fuzz_checkpoint FILE");
    char               *end;
    const unsigned long executions = std::strtoul(argv[1], &end, 10);
    const unsigned long seed       = argc == 3 ? std::strtoul(argv[2], nullptr, 10) : 1;

    const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("tread-fuzz-checkpoint-" + std::to_string(getpid()));
    std::fprintf(stderr, "folder %s\n", folder.c_str());
    Scene scene;
    scene.read("", settings);
    roll_and_interrupt(scene, folder);
    std::map<std::filesystem::path, std::string> files;
    for (const auto &entry : std::filesystem::directory_iterator(folder))
      files[entry.path()] = content_of(entry.path());
    std::string name;
    std::ifstream(folder / "checkpoint.last") >> name;
    const std::string good   = files.at(folder / name);
    const std::string layout = good.substr(0, good.find(' '));
    if (resume(scene, folder) != "rolled on")
      throw std::runtime_error("the run cannot be resumed from its own checkpoint");

    Random                               random(seed);
    std::map<std::string, unsigned long> outcomes;
    const auto                           attempt = [&](const std::string &checkpoint) {
      for (const auto &[path, content] : files)
        write(path, content);
      write(folder / name, checkpoint);
      ++outcomes[resume(scene, folder)];
    };
    if (*end != 0)
      attempt(content_of(argv[1]));
    else
      for (unsigned long i = 0; i < executions; ++i)
        {
          Content forged(good);
          forge(forged.groups, random);
          attempt(forged.file(layout));
        }
    std::fprintf(stderr, "checkpoint   %8lu executions, seed %lu:", executions, seed);
    for (const auto &[outcome, n] : outcomes)
      std::fprintf(stderr, " %lu %s", n, outcome.c_str());
    std::fprintf(stderr, "\n");
    std::filesystem::remove_all(folder);
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
      std::fprintf(stderr, "FINDING or failure: %s: %s\n", typeid(error).name(), error.what());
      return 1;
    }
}
