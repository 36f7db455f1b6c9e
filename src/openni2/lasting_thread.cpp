#include "openni2/lasting_thread.h"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace grasp_affordances
{

struct LastingThread::Work
{
  std::function<void()> function;
  std::mutex mutex;  // guards done
  std::condition_variable changed;
  bool done = false;
};

/// A thread and the work that it is given. Never destroyed: its thread may outlive all that has a destructor.
struct LastingThread::Worker
{
  std::mutex mutex;  // guards work
  std::condition_variable changed;
  std::shared_ptr<Work> work;

  /// Those that wait for work.
  struct Waiting
  {
    std::mutex mutex;
    std::vector<Worker*> workers;
  };

  static Waiting& waiting()
  {
    static auto* const all = new Waiting;
    return *all;
  }

  static Worker& get()
  {
    {
      const std::lock_guard<std::mutex> lock(waiting().mutex);
      if (!waiting().workers.empty()) {
        Worker& worker = *waiting().workers.back();
        waiting().workers.pop_back();
        return worker;
      }
    }
    auto* const worker = new Worker;
    std::thread([worker] { worker->run(); }).detach();
    return *worker;
  }

  void give(std::shared_ptr<Work> new_work)
  {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      work = std::move(new_work);
    }
    changed.notify_one();
  }

  void run()
  {
    while (true) {
      std::shared_ptr<Work> current;
      {
        std::unique_lock<std::mutex> lock(mutex);
        changed.wait(lock, [this] { return work != nullptr; });
        current = std::exchange(work, nullptr);
      }
      current->function();
      current->function = nullptr;
      {
        const std::lock_guard<std::mutex> lock(waiting().mutex);
        waiting().workers.push_back(this);
      }
      {
        const std::lock_guard<std::mutex> lock(current->mutex);
        current->done = true;
      }
      current->changed.notify_all();
    }
  }
};

LastingThread::LastingThread(std::function<void()> work) : work_(std::make_shared<Work>())
{
  work_->function = std::move(work);
  Worker::get().give(work_);
}

void LastingThread::join()
{
  if (!work_) {
    return;
  }
  {
    std::unique_lock<std::mutex> lock(work_->mutex);
    work_->changed.wait(lock, [this] { return work_->done; });
  }
  work_.reset();
}

}  // namespace grasp_affordances
