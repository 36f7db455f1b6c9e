#include "core/parallel/std_team.h"
#include "core/parallel/tbb_team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <thread>
#include <vector>

namespace grasp_affordances
{
namespace
{

template <typename Team>
class ThreadTeams : public testing::Test
{
};

#ifdef GRASP_AFFORDANCES_STD_THREADS
using Teams = testing::Types<StdTeam>;  // TBB is what ThreadSanitizer does not understand
#else
using Teams = testing::Types<StdTeam, TbbTeam>;
#endif
TYPED_TEST_SUITE(ThreadTeams, Teams);

TYPED_TEST(ThreadTeams, EveryIndexComesExactlyOnce)
{
  for (const int threads : {1, 2, 5}) {
    TypeParam team(threads);
    for (const std::size_t count : {0, 1, 2, 3, 7, 10000}) {
      std::vector<std::atomic<int>> calls(count);
      team.forEach(count, [&](std::size_t i, std::size_t /*member*/) { ++calls.at(i); });
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ(calls[i], 1) << "index " << i << " of " << count << ", " << threads << " threads";
      }
    }
  }
}

TYPED_TEST(ThreadTeams, NoTwoCallsAtATimeHaveTheSameMember)
{
  constexpr int kThreads = 4;
  TypeParam team(kThreads);
  ASSERT_EQ(team.size(), std::size_t{kThreads});
  std::vector<std::atomic<bool>> busy(team.size());
  std::vector<int> calls(team.size());  // not atomic: for ThreadSanitizer
  std::atomic<int> shared{0};
  for (int repetition = 0; repetition < 5; ++repetition) {
    team.forEach(500, [&](std::size_t /*i*/, std::size_t member) {
      ASSERT_LT(member, busy.size());
      shared += busy[member].exchange(true) ? 1 : 0;
      ++calls[member];
      std::this_thread::yield();
      busy[member] = false;
    });
  }
  EXPECT_EQ(shared, 0);
  int sum = 0;
  for (const int count : calls) {
    sum += count;
  }
  EXPECT_EQ(sum, 5 * 500);
}

TYPED_TEST(ThreadTeams, OneMemberIsTheCallersThread)
{
  TypeParam team(1);
  const std::thread::id caller = std::this_thread::get_id();
  std::vector<std::size_t> order;
  team.forEach(4, [&](std::size_t i, std::size_t member) {
    EXPECT_EQ(member, 0u);
    EXPECT_EQ(std::this_thread::get_id(), caller);
    order.push_back(i);
  });
  EXPECT_EQ(order.size(), 4u);
}

TYPED_TEST(ThreadTeams, ZeroThreadsMeansOnePerCore)
{
  EXPECT_EQ(TypeParam(0).size(), std::thread::hardware_concurrency());
}

TYPED_TEST(ThreadTeams, WhatACallThrowsReachesTheCaller)
{
  for (const int threads : {1, 2}) {
    TypeParam team(threads);
    const auto fail = [](std::size_t i, std::size_t /*member*/) {
      if (i == 5) {
        throw std::runtime_error("five");
      }
    };
    EXPECT_THROW(team.forEach(100, fail), std::runtime_error) << threads << " threads";
    std::atomic<int> calls{0};
    team.forEach(10, [&](std::size_t /*i*/, std::size_t /*member*/) { ++calls; });
    EXPECT_EQ(calls, 10) << "after a failure";
  }
}

TEST(StdTeam, RunsAsManyCallsAtATimeAsItHasMembers)
{
  constexpr int kThreads = 3;  // more than the cores of a small machine
  StdTeam team(kThreads);
  std::atomic<int> arrived{0};
  team.forEach(kThreads, [&](std::size_t /*i*/, std::size_t /*member*/) {
    ++arrived;
    while (arrived < kThreads) {
      std::this_thread::yield();
    }
  });
  EXPECT_EQ(arrived, kThreads);
}

}  // namespace
}  // namespace grasp_affordances
