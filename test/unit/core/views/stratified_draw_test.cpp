#include "core/views/stratified_draw.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <set>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

TEST(StratifiedDraw, SpreadsEvenlyOverTheCandidates)
{
  std::vector<std::uint32_t> measured(1000), candidates;
  std::iota(measured.begin(), measured.end(), 0U);
  for (std::uint32_t i = 0; i < 1000; i += 2) {
    candidates.push_back(i);
  }
  SamplingConfig config;
  config.samples = 100;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const std::uint32_t point = drawStratified(measured, candidates, config, i);
    EXPECT_EQ(point % 2, 0U);
    EXPECT_EQ(point / 10, i) << "the i-th of equal parts";
  }
}

TEST(StratifiedDraw, DrawsEachOfFewCandidatesOnceAndTheRestAnywhere)
{
  std::vector<std::uint32_t> measured(1000);
  std::iota(measured.begin(), measured.end(), 0U);
  const std::vector<std::uint32_t> candidates = {7, 300, 42};
  SamplingConfig config;
  config.samples = 500;
  std::set<std::uint32_t> others;
  for (std::uint64_t i = 0; i < 500; ++i) {
    const std::uint32_t point = drawStratified(measured, candidates, config, i);
    if (i < 3) {
      EXPECT_EQ(point, candidates[i]);
    } else {
      others.insert(point);
    }
  }
  // Of 497 draws from 1000, 392 are different on average, with a standard deviation of about 9.
  EXPECT_NEAR(static_cast<double>(others.size()), 392.0, 45.0);
}

TEST(StratifiedDraw, DependsOnTheSeed)
{
  std::vector<std::uint32_t> measured(1000);
  std::iota(measured.begin(), measured.end(), 0U);
  SamplingConfig one, other;
  other.seed = 2;
  int equal = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    EXPECT_EQ(drawStratified(measured, {}, one, i), drawStratified(measured, {}, one, i));
    equal += drawStratified(measured, {}, one, i) == drawStratified(measured, {}, other, i) ? 1 : 0;
  }
  EXPECT_LT(equal, 10);
}

}  // namespace
}  // namespace grasp_affordances::test
