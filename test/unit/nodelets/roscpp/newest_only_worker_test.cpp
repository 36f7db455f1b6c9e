#include "nodelets/roscpp/newest_only_worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <thread>
#include <vector>

namespace grasp_affordances
{
namespace
{

TEST(NewestOnlyWorker, ReplacesWhatWaitsAndReportsTheDrop)
{
  std::promise<void> started;
  std::promise<void> release;
  std::promise<void> last_done;
  std::vector<int> worked;
  NewestOnlyWorker<int> worker([&](int item) {
    worked.push_back(item);
    if (item == 1) {
      started.set_value();
      release.get_future().wait();
    } else {
      last_done.set_value();
    }
  });

  EXPECT_FALSE(worker.put(1));
  started.get_future().wait();
  EXPECT_FALSE(worker.put(2)) << "1 is under work and does not wait";
  EXPECT_TRUE(worker.put(3));
  EXPECT_TRUE(worker.put(4));
  release.set_value();
  last_done.get_future().wait();
  worker.stop();
  EXPECT_EQ(worked, (std::vector<int>{1, 4}));
}

TEST(NewestOnlyWorker, StopFinishesTheItemUnderWorkAndDiscardsTheOneThatWaits)
{
  std::promise<void> started;
  std::atomic<int> finished{0};
  NewestOnlyWorker<int> worker([&](int item) {
    if (item == 1) {
      started.set_value();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    finished = item;
  });
  worker.put(1);
  started.get_future().wait();
  worker.put(2);
  worker.stop();
  EXPECT_EQ(finished, 1);
  EXPECT_FALSE(worker.put(3)) << "ignored, so nothing is dropped";
  worker.stop();
  EXPECT_EQ(finished, 1);
}

TEST(NewestOnlyWorker, HandsItemsOverWithoutKeepingThem)
{
  std::promise<long> owners;
  NewestOnlyWorker<std::shared_ptr<int>> worker(
      [&](const std::shared_ptr<int>& item) { owners.set_value(item.use_count()); });
  worker.put(std::make_shared<int>(1));
  EXPECT_EQ(owners.get_future().get(), 1);
}

// Every item is worked on, dropped, or discarded by stop(), whatever the interleaving.
TEST(NewestOnlyWorker, AccountsForEveryItemOfManyThreads)
{
  constexpr int kThreads = 4;
  constexpr int kItems = 2000;
  std::atomic<int> worked{0};
  std::atomic<int> dropped{0};
  NewestOnlyWorker<int> worker([&](int) { ++worked; });
  worker.put(0);
  while (worked == 0) {
    std::this_thread::yield();
  }
  std::vector<std::thread> producers;
  for (int t = 0; t < kThreads; ++t) {
    producers.emplace_back([&] {
      for (int i = 0; i < kItems; ++i) {
        dropped += worker.put(i) ? 1 : 0;
      }
    });
  }
  for (std::thread& producer : producers) {
    producer.join();
  }
  worker.stop();
  EXPECT_GE(worked + dropped, kThreads * kItems) << "of one more, the first; one may have been discarded";
  EXPECT_LE(worked + dropped, kThreads * kItems + 1);
}

}  // namespace
}  // namespace grasp_affordances
