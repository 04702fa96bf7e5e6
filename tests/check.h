// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_tests_check_h
#define tread_tests_check_h

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace tread::tests
{
  /// The text of the exception that a call ends with, "" if it does not; other types of exceptions go on.
  template <typename Exception, typename Call>
  std::string complaint(const Call &call)
  {
    try
      {
        call();
      }
    catch (const Exception &error)
      {
        return error.what();
      }
    return "";
  }

  /// Counts and prints comparisons: computed, reference, error, allowed, PASS or FAIL.
  class Check
  {
  public:
    /// |computed - reference| <= allowed * |reference|.
    bool relative(const std::string &what,
                  const double       computed,
                  const double       reference,
                  const double       allowed)
    {
      return line(what, computed, reference, std::abs(computed - reference) / std::abs(reference), allowed);
    }

    /// |computed - reference| <= allowed, in the unit named in what.
    bool absolute(const std::string &what,
                  const double       computed,
                  const double       reference,
                  const double       allowed)
    {
      return line(what, computed, reference, std::abs(computed - reference), allowed);
    }

    /// |computed| <= allowed.
    bool below(const std::string &what, const double computed, const double allowed)
    {
      return line(what, computed, 0., std::abs(computed), allowed);
    }

    /// A statement that must hold.
    bool that(const std::string &what, const bool holds)
    {
      return line(what, holds ? 1. : 0., 1., holds ? 0. : 1., 0.);
    }

    /// An invalid argument must be refused in one line with these words.
    template <typename Call>
    bool refuses(const std::string &what, const std::string &words, const Call &call)
    {
      const std::string text = complaint<std::invalid_argument>(call);
      return that(what + ": \"" + text + "\"", text.find(words) != std::string::npos && !text.empty() &&
                                                 text.find('\n') == std::string::npos);
    }

    /// Prints how many comparisons there were; 1 if any failed or there was none, otherwise 0.
    int exit_code() const
    {
      std::printf("%u comparisons, %u failed\n", n_lines, n_failed);
      return (n_failed == 0 && n_lines > 0) ? 0 : 1;
    }

    /// What failed first.
    const std::string &first_failure() const
    {
      return failed_first;
    }

  private:
    bool line(const std::string &what,
              const double       computed,
              const double       reference,
              const double       error,
              const double       allowed)
    {
      const bool pass = error <= allowed; // false for NaN
      ++n_lines;
      if (!pass && n_failed++ == 0)
        failed_first = what;
      std::printf("%-52s computed %15.8g  reference %15.8g  error %9.2e  allowed %9.2e  %s\n", what.c_str(),
                  computed, reference, error, allowed, pass ? "PASS" : "FAIL");
      return pass;
    }

    unsigned int n_lines  = 0;
    unsigned int n_failed = 0;
    std::string  failed_first;
  };

  /// What stands on the command line behind the test's name: the parts of it that are wanted.
  using Arguments = std::vector<std::string>;

  using Test = void (*)(Check &, const Arguments &);

  /// The tests of a program by their names.
  inline std::map<std::string, Test> &all_tests()
  {
    static std::map<std::string, Test> tests;
    return tests;
  }

  /// Makes a test known to main.cc.
  struct Registered
  {
    Registered(const std::string &name, const Test test)
    {
      if (!all_tests().emplace(name, test).second)
        std::fprintf(stderr, "two tests have the name %s\n", name.c_str()), std::abort();
    }
  };
} // namespace tread::tests

/// TREAD_TEST(contact_bars)(Check &check, const Arguments &arguments) {...}: a test, which knows what stands
/// in the file's namespace contact_bars. Files of a floor can be compiled as one therefore.
#define TREAD_TEST(name)                                                                                     \
  namespace name                                                                                             \
  {                                                                                                          \
    void                           run_test(tread::tests::Check &, const tread::tests::Arguments &);         \
    const tread::tests::Registered registered(#name, run_test);                                              \
  }                                                                                                          \
  void name::run_test

#endif
