#include "core/parallel/cancellation.h"

#include "grasp_affordances/localizer.h"
#include "support/scenes.h"
#include "support/shells.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>

namespace grasp_affordances::test
{
namespace
{

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

const Cloud& table()
{
  static const Cloud cloud = captureScene("table", 1).cloud;
  return cloud;
}

/// True from its nth call on, from whatever threads.
std::function<bool()> fromCall(int n, std::atomic<int>& calls)
{
  return [n, &calls] { return ++calls >= n; };
}

TEST(Cancellation, IsNeverWantedWhereNobodyCan)
{
  EXPECT_FALSE(Cancellation().wanted());
  EXPECT_NO_THROW(Cancellation().check());
  EXPECT_THROW(Cancellation([] { return true; }).check(), Cancelled);
}

/// Samples that were left out because of it would else pass for examined.
TEST(Cancellation, IsHeardAlsoWhereItIsWantedForAMomentOnly)
{
  constexpr int kSteps = 20;
  const Cloud& cloud = table();
  Config config;
  config.threads = 1;
  Localizer localizer(config);
  int calls = 0, chosen = 0;
  localizer.cancelWhen([&] { return ++calls == chosen; });
  const Localization expected = localizer.localize(cloud);
  const int all = calls;
  for (int step = 0; step <= kSteps; ++step) {
    calls = 0;
    chosen = 1 + (all - 1) * step / kSteps;
    EXPECT_THROW(localizer.localize(cloud), Cancelled) << chosen << " of " << all;
  }
  chosen = 0;
  EXPECT_EQ(localizer.localize(cloud).counts, expected.counts);
}

/// Wherever it is wanted. What comes after it knows nothing of it.
TEST(Cancellation, EndsALocalizationInEveryStageAndLeavesNoTrace)
{
  constexpr int kSteps = 8;
  const Cloud& cloud = table();
  for (const Estimator estimator : {Estimator::taubin, Estimator::normals}) {
    for (const int threads : {1, 3}) {
      Config config;
      config.estimation.estimator = estimator;
      config.threads = threads;
      const Localization expected = Localizer(config).localize(cloud);
      ASSERT_FALSE(expected.handles.empty());

      Localizer localizer(config);
      std::atomic<int> calls{0};
      localizer.cancelWhen(fromCall(1'000'000'000, calls));
      localizer.localize(cloud);
      const int all = calls;
      ASSERT_GT(all, 100);
      for (int step = 0; step <= kSteps; ++step) {
        calls = 0;
        localizer.cancelWhen(fromCall(1 + (all - 1) * step / kSteps, calls));
        if (threads == 1) {
          EXPECT_THROW(localizer.localize(cloud), Cancelled) << step;
        } else {
          try {  // how often it is asked depends on how threads share the work
            localizer.localize(cloud);
          } catch (const Cancelled&) {
          }
        }
      }
      localizer.cancelWhen([] { return false; });
      const Localization after = localizer.localize(cloud);
      EXPECT_EQ(after.counts, expected.counts);
      ASSERT_EQ(after.shells.size(), expected.shells.size());
      for (std::size_t i = 0; i < after.shells.size(); ++i) {
        ASSERT_TRUE(same(after.shells[i], expected.shells[i])) << i;
      }
      ASSERT_EQ(after.handles.size(), expected.handles.size());
      for (std::size_t i = 0; i < after.handles.size(); ++i) {
        EXPECT_EQ(after.handles[i].shells, expected.handles[i].shells) << i;
        EXPECT_EQ(after.handles[i].hand_poses.size(), expected.handles[i].hand_poses.size()) << i;
      }
    }
  }
}

/// With a million samples a localization takes some ten seconds. It is told after 50 ms.
TEST(Cancellation, IsHeardWithinAFractionOfASecond)
{
  const Cloud& cloud = table();
  Config config;
  config.sampling.samples = 1'000'000;
  for (const Estimator estimator : {Estimator::taubin, Estimator::normals}) {
    config.estimation.estimator = estimator;
    Localizer localizer(config);
    const Clock::time_point start = Clock::now();
    localizer.cancelWhen([start] { return secondsSince(start) > 0.05; });
    EXPECT_THROW(localizer.localize(cloud), Cancelled);
    EXPECT_LT(secondsSince(start), 1.0);
  }
}

}  // namespace
}  // namespace grasp_affordances::test
