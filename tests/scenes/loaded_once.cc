// SPDX-License-Identifier: LGPL-2.1-or-later
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

// Nine tenths of a start of the program are taken by the dynamic linker, which looks up the symbols of some
// two hundred libraries. Preloaded into the program, this begins its main function many times instead of
// once, each time in a copy of the process as it is before main() (fork): what follows is the same as in a
// process of its own. loaded_once.py asks it to.
//
// A request on the standard input is a line for each word: the file for the standard output, that for the
// standard error, the number of arguments, and the arguments, in each of which the bytes are written as two
// hexadecimal digits. The answer on the standard output is the exit code, or less than 0 the signal that
// ended it.

namespace
{
  using Main = int (*)(int, char **, char **);
  Main program;

  std::string from_hexadecimal(const std::string &digits)
  {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
      bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
    return bytes;
  }

  std::string next_word()
  {
    std::string line;
    if (!std::getline(std::cin, line))
      std::exit(0);
    return line;
  }

  void write_into(const std::string &file, const int stream)
  {
    const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (opened < 0 || dup2(opened, stream) < 0)
      _exit(127);
    close(opened);
  }

  int many_times(int, char **words, char **environment)
  {
    // What is started ends with the test that asked for it, however that ends.
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    while (true)
      {
        const std::string output = from_hexadecimal(next_word()), error = from_hexadecimal(next_word());
        std::vector<std::string> arguments = {words[0]};
        for (int rest = std::stoi(next_word()); rest > 0; --rest)
          arguments.push_back(from_hexadecimal(next_word()));
        const pid_t child = fork();
        if (child == 0)
          {
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            const int nothing = open("/dev/null", O_RDONLY);
            dup2(nothing, 0);
            write_into(output, 1);
            write_into(error, 2);
            std::vector<char *> pointers;
            for (std::string &argument : arguments)
              pointers.push_back(argument.data());
            pointers.push_back(nullptr);
            std::exit(program(static_cast<int>(arguments.size()), pointers.data(), environment));
          }
        int status = 0;
        waitpid(child, &status, 0);
        std::cout << (WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status)) << std::endl;
      }
  }
} // namespace

extern "C" int __libc_start_main(Main   main,
                                 int    argc,
                                 char **argv,
                                 void (*init)(),
                                 void (*fini)(),
                                 void (*rtld_fini)(),
                                 void *stack_end)
{
  using Start       = int (*)(Main, int, char **, void (*)(), void (*)(), void (*)(), void *);
  const Start start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
  program           = main;
  unsetenv("LD_PRELOAD");
  return start(many_times, argc, argv, init, fini, rtld_fini, stack_end);
}
