#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace grasp_affordances
{

/// A bounded number of TBB's threads.
class TbbTeam
{
public:
  /// `threads`: 0 for one per core; 1 runs everything on the caller's thread.
  explicit TbbTeam(int threads) : threads_(threads > 0 ? threads : coreCount()), arena_(threads_)
  {
    if (threads_ > coreCount()) {
      oversubscription_.emplace(tbb::global_control::max_allowed_parallelism, threads_);
    }
  }

  std::size_t size() const { return static_cast<std::size_t>(threads_); }

  /// Calls task(i, member) for every i < count, in no particular order. No two calls at a time have the same
  /// member < size(), so that a member can own working memory. A call should take some microseconds at least, since
  /// handing it out to a thread costs time, too.
  template <typename Task>
  void forEach(std::size_t count, Task&& task)
  {
    if (threads_ == 1) {
      for (std::size_t i = 0; i < count; ++i) {
        task(i, std::size_t{0});
      }
      return;
    }
    arena_.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
        const auto member = static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          task(i, member);
        }
      });
    });
  }

private:
  static int coreCount() { return std::max(1, tbb::this_task_arena::max_concurrency()); }

  int threads_;
  std::optional<tbb::global_control> oversubscription_;  // TBB has a thread per core, unless told otherwise
  tbb::task_arena arena_;
};

}  // namespace grasp_affordances
