#include "openni2/lasting_thread.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <thread>

namespace grasp_affordances
{
namespace
{

std::thread::id threadOfWork()
{
  std::thread::id id;
  LastingThread thread([&id] { id = std::this_thread::get_id(); });
  thread.join();
  return id;
}

TEST(LastingThread, DoesItsWorkInAnotherThread)
{
  EXPECT_NE(threadOfWork(), std::thread::id());
  EXPECT_NE(threadOfWork(), std::this_thread::get_id());
}

TEST(LastingThread, DoesTheNextWorkToo)
{
  const std::thread::id first = threadOfWork();
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(threadOfWork(), first);
  }
}

TEST(LastingThread, TwoWorkAtOnce)
{
  std::mutex mutex;
  std::condition_variable changed;
  int arrived = 0;
  std::thread::id ids[2];
  const auto meet = [&](std::thread::id& id) {
    std::unique_lock<std::mutex> lock(mutex);
    id = std::this_thread::get_id();
    ++arrived;
    changed.notify_all();
    changed.wait(lock, [&] { return arrived == 2; });
  };
  LastingThread first([&] { meet(ids[0]); });
  LastingThread second([&] { meet(ids[1]); });
  first.join();
  second.join();
  EXPECT_NE(ids[0], ids[1]);
}

TEST(LastingThread, WithoutWorkThereIsNothingToWaitFor)
{
  LastingThread thread;
  thread.join();
  thread = LastingThread([] {});
  thread.join();
  thread.join();
}

}  // namespace
}  // namespace grasp_affordances
