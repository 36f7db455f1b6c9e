#include "core/parallel/time_budget.h"

#include "grasp_affordances/localizer.h"
#include "support/scenes.h"
#include "support/shells.h"

#include <gtest/gtest.h>

#include <numeric>

namespace grasp_affordances::test
{
namespace
{

std::uint32_t outOfTime(const Localization& result)
{
  return result.counts[static_cast<std::size_t>(Outcome::out_of_time)];
}

Config budgetOf(double milliseconds, int threads)
{
  Config config;
  config.sampling.time_budget_ms = milliseconds;
  config.threads = threads;
  return config;
}

TEST(TimeBudget, NoneIsNeverSpentAndATinyOneIsAtOnce)
{
  EXPECT_FALSE(TimeBudget(0.0).spent());
  EXPECT_FALSE(TimeBudget(60000.0).spent());
  const TimeBudget tiny(1e-6);
  EXPECT_TRUE(tiny.spent());
}

/// Preparation alone takes longer than a microsecond: no sample is examined.
TEST(TimeBudget, ATinyOneLeavesSamplesOutAndTheCountsAddUp)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  for (const int threads : {1, 3}) {
    const Localization result = Localizer(budgetOf(1e-3, threads)).localize(cloud);
    EXPECT_EQ(result.sampled, 2000U);
    EXPECT_EQ(std::accumulate(result.counts.begin(), result.counts.end(), 0U), result.sampled);
    EXPECT_EQ(outOfTime(result), result.sampled);
    EXPECT_TRUE(result.shells.empty());
    EXPECT_TRUE(result.handles.empty());
  }
}

/// What was examined in time ends as it does without a budget.
TEST(TimeBudget, LeavesTheResultsOfTheFirstSamples)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  Config config = budgetOf(0.0, 1);
  config.sampling.importance = false;
  Localizer localizer(config);
  const Localization whole = localizer.localize(cloud);
  Localization part = whole;
  for (config.sampling.time_budget_ms = whole.milliseconds.total; outOfTime(part) == 0;
       config.sampling.time_budget_ms *= 0.8) {
    localizer.configure(config);
    part = localizer.localize(cloud);
    EXPECT_EQ(part.sampled, whole.sampled);
    EXPECT_EQ(std::accumulate(part.counts.begin(), part.counts.end(), 0U), part.sampled);
  }
  ASSERT_LE(part.shells.size(), whole.shells.size());
  for (std::size_t i = 0; i < part.shells.size(); ++i) {  // one thread examines samples in their order
    ASSERT_TRUE(same(part.shells[i], whole.shells[i])) << i;
  }
}

TEST(TimeBudget, ALargeOneChangesNothing)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  for (const int threads : {1, 3}) {
    const Localization without = Localizer(budgetOf(0.0, threads)).localize(cloud);
    const Localization with = Localizer(budgetOf(60000.0, threads)).localize(cloud);
    EXPECT_EQ(with.counts, without.counts);
    ASSERT_EQ(with.shells.size(), without.shells.size());
    for (std::size_t i = 0; i < with.shells.size(); ++i) {
      ASSERT_TRUE(same(with.shells[i], without.shells[i])) << i;
    }
    ASSERT_EQ(with.handles.size(), without.handles.size());
    for (std::size_t i = 0; i < with.handles.size(); ++i) {
      EXPECT_EQ(with.handles[i].shells, without.handles[i].shells) << i;
      EXPECT_EQ(with.handles[i].centroid, without.handles[i].centroid) << i;
    }
  }
}

}  // namespace
}  // namespace grasp_affordances::test
