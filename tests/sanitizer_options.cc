// SPDX-License-Identifier: LGPL-2.1-or-later
// What the sanitizers ask for by these names, in all programs that are built with them. What the environment
// says (ASAN_OPTIONS, UBSAN_OPTIONS, LSAN_OPTIONS) comes after it.

extern "C" const char *__asan_default_options()
{
  // More memory than that at once, or in all, is a finding.
  return "max_allocation_size_mb=500:hard_rss_limit_mb=3000:allocator_may_return_null=0:handle_abort=0";
}

extern "C" const char *__ubsan_default_options()
{
  return "print_stacktrace=1";
}

extern "C" const char *__lsan_default_options()
{
  return "print_suppressions=0";
}

/// Memory that libraries keep until the process ends, by the name of the library. Nothing of this project may
/// stand here.
extern "C" const char *__lsan_default_suppressions()
{
  return
    // Open MPI: tables of components, variables and names of processes.
    "leak:libopen-pal\n"
    "leak:libopen-rte\n"
    "leak:libmpi\n"
    "leak:mca_\n"
    // What Open MPI starts its ranks and finds the processor with.
    "leak:libpmix\n"
    "leak:libhwloc\n"
    "leak:libevent\n"
    // Network libraries that Open MPI asks for cards.
    "leak:libucs\n"
    "leak:libucp\n"
    "leak:libfabric\n"
    // Texts that Open MPI has printed into new memory (asprintf), which this project never does: the C
    // library between them has no frame pointers, so that the stack ends there.
    "leak:__vasprintf_internal\n";
}

/// Libraries stay loaded: those that Open MPI unloads would have no name in the report.
extern "C" int dlclose(void *)
{
  return 0;
}
