#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace grasp_affordances
{

/// The interface of TbbTeam, with threads of the standard library. They are started anew for each forEach(). For
/// ThreadSanitizer, which does not understand TBB, and for long jobs.
class StdTeam
{
public:
  /// `threads`: 0 for one per core; 1 runs everything on the caller's thread.
  explicit StdTeam(int threads)
      : threads_(threads > 0 ? static_cast<std::size_t>(threads) : std::max(1U, std::thread::hardware_concurrency()))
  {
  }

  std::size_t size() const { return threads_; }

  /// Calls task(i, member) for every i < count, in no particular order; no two calls at a time have the same
  /// member < size(). After a call has thrown, no further calls begin. @throw what that call threw
  template <typename Task>
  void forEach(std::size_t count, Task&& task)
  {
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex mutex;
    const auto work = [&](std::size_t member) {
      for (std::size_t i = next++; i < count; i = next++) {
        try {
          task(i, member);
        } catch (...) {
          const std::lock_guard<std::mutex> lock(mutex);
          failure = failure ? failure : std::current_exception();
          next = count;
        }
      }
    };
    std::vector<std::thread> others;
    for (std::size_t member = 1; member < std::min(threads_, count); ++member) {
      others.emplace_back(work, member);
    }
    work(0);
    for (std::thread& other : others) {
      other.join();
    }
    if (failure) {
      std::rethrow_exception(failure);
    }
  }

private:
  std::size_t threads_;
};

}  // namespace grasp_affordances
