#pragma once

#include <functional>
#include <memory>

namespace grasp_affordances
{

/// Runs one piece of work in a thread that calls OpenNI2 and lasts until the process ends. When the work is done, the
/// thread waits, and does the next piece of work that asks for a thread.
///
/// OpenNI2 keeps a log of errors for each thread that has called it. Whenever another thread calls it, it asks with
/// pthread_kill() whether those threads still exist. That crashes once the memory of a thread that has ended is
/// unmapped: so it was where drivers were loaded and unloaded again and again on a busy machine.
///
/// Many threads may have one each.
class LastingThread
{
public:
  LastingThread() = default;  ///< no work

  /// @param work  must not throw
  explicit LastingThread(std::function<void()> work);
  LastingThread(LastingThread&&) noexcept = default;
  LastingThread& operator=(LastingThread&&) noexcept = default;
  ~LastingThread() = default;

  /// Returns when the work is done. To be called before the object goes, unless there is no work.
  void join();

private:
  struct Work;
  struct Worker;
  std::shared_ptr<Work> work_;
};

}  // namespace grasp_affordances
