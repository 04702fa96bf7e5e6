// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_reference_all_cores_h
#define tread_reference_all_cores_h

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace tread::reference
{
  /// Do something for each number from 0 to n - 1, each on the thread that is free next.
  /// @param n_threads 0: as many as there are cores; where fewer can be started, these do it
  /// @param make_task gives each thread what it calls with its numbers, with what belongs to this thread
  /// alone. Neither may throw.
  template <typename MakeTask>
  void on_all_cores(const std::size_t n, const unsigned int n_threads, const MakeTask &make_task)
  {
    const std::size_t most =
      std::min<std::size_t>(n, n_threads > 0 ? n_threads : std::max(1u, std::thread::hardware_concurrency()));
    std::atomic<std::size_t> next{0};
    const auto               work = [&]() noexcept {
      const auto task = make_task();
      for (std::size_t k = next++; k < n; k = next++)
        task(k);
    };
    std::vector<std::thread> helpers;
    try
      {
        while (helpers.size() + 1 < most)
          helpers.emplace_back(work);
      }
    catch (const std::exception &)
      {
        // The threads that there are do it.
      }
    work();
    for (std::thread &helper : helpers)
      helper.join();
  }
} // namespace tread::reference

#endif
