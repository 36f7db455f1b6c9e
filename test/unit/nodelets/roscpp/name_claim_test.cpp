#include "nodelets/roscpp/name_claim.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>

namespace grasp_affordances::test
{
namespace
{

constexpr std::chrono::milliseconds kMoment{50};

TEST(NameClaim, WaitsForTheEndOfTheOneBefore)
{
  auto first = std::make_unique<NameClaim>();
  first->claim("/localizer");
  std::atomic<bool> ended{false};
  std::thread unloading([&] {
    std::this_thread::sleep_for(kMoment);
    ended = true;
    first.reset();
  });
  NameClaim second;
  second.claim("/localizer");
  EXPECT_TRUE(ended);
  unloading.join();
}

TEST(NameClaim, GivesUpAndLeavesTheNameToWhoHasIt)
{
  NameClaim first;
  first.claim("/localizer");
  {
    NameClaim second(kMoment);
    EXPECT_THROW(second.claim("/localizer"), std::runtime_error);
  }
  NameClaim third(kMoment);
  EXPECT_THROW(third.claim("/localizer"), std::runtime_error);
}

TEST(NameClaim, IsOfOneName)
{
  NameClaim first;
  first.claim("/localizer");
  NameClaim second(kMoment);
  EXPECT_NO_THROW(second.claim("/camera/localizer"));
}

TEST(NameClaim, EndsWithItsHolder)
{
  for (int i = 0; i < 3; ++i) {
    NameClaim claim(kMoment);
    EXPECT_NO_THROW(claim.claim("/localizer"));
  }
}

}  // namespace
}  // namespace grasp_affordances::test
