#include "nodelets/roscpp/callback_gate.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <thread>

namespace grasp_affordances::test
{
namespace
{

TEST(CallbackGate, LetsCallsThroughUntilItIsClosed)
{
  CallbackGate gate;
  int calls = 0;
  const std::function<void(int)> add = gate.guarded([&calls](int n) { calls += n; });
  const std::function<bool()> answer = gate.guarded([] { return true; });
  add(2);
  EXPECT_TRUE(answer());
  gate.close();
  add(3);
  EXPECT_EQ(calls, 2);
  EXPECT_FALSE(answer());
}

TEST(CallbackGate, MayBeGoneBeforeItsCallbacks)
{
  int calls = 0;
  std::function<void()> count;
  {
    const CallbackGate gate;
    count = gate.guarded([&calls] { ++calls; });
  }
  count();
  EXPECT_EQ(calls, 0);
}

TEST(CallbackGate, ClosesWhenCallsUnderWayHaveEnded)
{
  CallbackGate gate;
  std::promise<void> begun, end;
  std::atomic<bool> ended{false};
  const std::function<void()> work = gate.guarded([&] {
    begun.set_value();
    end.get_future().wait();
    ended = true;
  });
  std::thread caller(work);
  begun.get_future().wait();
  auto closed = std::async(std::launch::async, [&] {
    gate.close();
    return ended.load();
  });
  EXPECT_EQ(closed.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout);
  end.set_value();
  EXPECT_TRUE(closed.get());
  caller.join();
}

}  // namespace
}  // namespace grasp_affordances::test
