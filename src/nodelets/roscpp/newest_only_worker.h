#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace grasp_affordances
{

/// Works on items one at a time, in a thread of its own, and always on the newest: an item that is handed in while the
/// worker is busy replaces the one that waits. Nothing queues. Every method may be called from any thread but the
/// worker's own.
template <typename Item>
class NewestOnlyWorker
{
public:
  /// Calls `work` for the items; it must not throw.
  explicit NewestOnlyWorker(std::function<void(Item)> work) : work_(std::move(work)), thread_([this] { run(); }) {}
  ~NewestOnlyWorker() { stop(); }

  NewestOnlyWorker(const NewestOnlyWorker&) = delete;
  NewestOnlyWorker& operator=(const NewestOnlyWorker&) = delete;

  /// Hands an item in and returns at once. Returns whether an item that waited was dropped for it. After stop() items
  /// are ignored.
  bool put(Item item)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopping_) {
      return false;
    }
    const bool dropped = waiting_.has_value();
    waiting_ = std::move(item);
    changed_.notify_one();
    return dropped;
  }

  /// Returns when the item under work is finished; one that waits is discarded.
  void stop()
  {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stopping_ = true;
      waiting_.reset();
    }
    changed_.notify_one();
    const std::lock_guard<std::mutex> lock(join_mutex_);
    if (thread_.joinable()) {
      thread_.join();
    }
  }

private:
  void run()
  {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return stopping_ || waiting_; });
      if (stopping_) {
        return;
      }
      Item item = std::move(*waiting_);
      waiting_.reset();
      lock.unlock();
      work_(std::move(item));
      lock.lock();
    }
  }

  const std::function<void(Item)> work_;
  std::mutex mutex_;  // guards waiting_ and stopping_
  std::mutex join_mutex_;
  std::condition_variable changed_;
  std::optional<Item> waiting_;
  bool stopping_ = false;
  std::thread thread_;  // last: it starts when the rest exists
};

}  // namespace grasp_affordances
