#include "evaluation/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace grasp_affordances
{

void forEachInParallel(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& job)
{
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        job(i);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        failure = failure ? failure : std::current_exception();
        next = count;
      }
    }
  };
  const std::size_t wanted = threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::thread> team;
  for (std::size_t i = 1; i < std::min(wanted, count); ++i) {
    team.emplace_back(work);
  }
  work();
  for (std::thread& member : team) {
    member.join();
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

}  // namespace grasp_affordances
