#include "nodelets/roscpp/rate_limiter.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace grasp_affordances
{
namespace
{

constexpr std::int64_t kSecond = 1'000'000'000;

/// How many of 300 frames at 30 Hz pass.
int passed(RateLimiter limiter)
{
  int count = 0;
  for (std::int64_t i = 0; i < 300; ++i) {
    count += limiter.passes(1'600'000'000 * kSecond + i * kSecond / 30) ? 1 : 0;
  }
  return count;
}

TEST(RateLimiter, KeepsTheRateOnAverage)
{
  EXPECT_EQ(passed(RateLimiter(0.0)), 300);
  EXPECT_EQ(passed(RateLimiter(60.0)), 300);
  EXPECT_NEAR(passed(RateLimiter(20.0)), 200, 1);
  EXPECT_NEAR(passed(RateLimiter(10.0)), 100, 1);
  EXPECT_NEAR(passed(RateLimiter(0.5)), 5, 1);
  EXPECT_EQ(passed(RateLimiter(1e-12)), 1);
}

TEST(RateLimiter, StampsThatGoBackBeginAnew)
{
  RateLimiter limiter(1.0);
  EXPECT_TRUE(limiter.passes(100 * kSecond));
  EXPECT_FALSE(limiter.passes(100 * kSecond + kSecond / 2));
  EXPECT_TRUE(limiter.passes(5 * kSecond));
  EXPECT_FALSE(limiter.passes(5 * kSecond + kSecond / 2));
  EXPECT_TRUE(limiter.passes(6 * kSecond));
}

}  // namespace
}  // namespace grasp_affordances
