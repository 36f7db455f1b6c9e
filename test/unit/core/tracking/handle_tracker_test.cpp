#include "grasp_affordances/handle_tracker.h"

#include "support/tracked_handles.h"

#include <gtest/gtest.h>

#include <vector>

namespace grasp_affordances::test
{
namespace
{

TEST(HandleTracker, ReportsTheFirstCloudAtOnceAndLaterHandlesAfterMinHits)
{
  HandleTracker tracker;
  EXPECT_EQ(ids(tracker.update({kBar}, 0.0)), Ids{1});
  EXPECT_EQ(ids(tracker.update({kBar, kPole}, 0.1)), Ids{1});
  const Handles known = tracker.update({kPole, kBar}, 0.2);
  EXPECT_EQ(ids(known), (Ids{1, 2}));
  EXPECT_EQ(known[0].hits, 3U);
  EXPECT_EQ(known[1].hits, 2U);
}

TEST(HandleTracker, AHandleThatIsFoundOnceByMistakeIsNeverReported)
{
  HandleTracker tracker;
  tracker.update({kBar}, 0.0);
  tracker.update({kBar, kPole}, 0.1);
  for (int i = 2; i < 40; ++i) {
    EXPECT_EQ(ids(tracker.update({kBar}, kPeriod * i)), Ids{1});
  }
}

TEST(HandleTracker, AHandleThatIsNotFoundIsReportedUntilItsLifetime)
{
  TrackingConfig config;
  config.lifetime = 0.5;
  HandleTracker tracker(config);
  tracker.update({kBar, kPole}, 10.0);
  for (const double seconds : {0.1, 0.25, 0.5}) {
    const Handles known = tracker.update({kPole}, 10.0 + seconds);
    ASSERT_EQ(ids(known), (Ids{1, 2})) << seconds;
    EXPECT_NEAR(known[0].unseen_for, seconds, 1e-9);
    EXPECT_TRUE(known[0].shells.empty());
    EXPECT_EQ(known[0].hits, 1U);
    EXPECT_EQ(known[0].centroid, kBar.centroid);
    EXPECT_EQ(known[0].hand_poses.size(), 1U);
    EXPECT_EQ(known[1].unseen_for, 0.0);
    EXPECT_EQ(known[1].shells.size(), 3U);
  }
  EXPECT_EQ(ids(tracker.update({kPole}, 10.6)), Ids{2});
}

TEST(HandleTracker, AHandleThatComesBackHasItsIdAgainForAWhile)
{
  HandleTracker tracker;
  tracker.update({kBar, kPole}, 0.0);
  int i = 1;
  const auto miss_for = [&](int clouds) {
    for (const int end = i + clouds; i < end; ++i) {
      tracker.update({kPole}, kPeriod * i);
    }
  };
  miss_for(30);
  EXPECT_EQ(ids(tracker.update({kPole}, kPeriod * i++)), Ids{2});
  EXPECT_EQ(ids(tracker.update({kBar, kPole}, kPeriod * i++)), (Ids{1, 2}));
  miss_for(60);
  tracker.update({kBar, kPole}, kPeriod * i++);
  EXPECT_EQ(ids(tracker.update({kBar, kPole}, kPeriod * i++)), (Ids{2, 3}));
}

TEST(HandleTracker, WithoutALifetimeAHandleGoesWithTheFirstCloudThatLacksIt)
{
  TrackingConfig config;
  config.lifetime = 0.0;
  HandleTracker tracker(config);
  tracker.update({kBar, kPole}, 0.0);
  EXPECT_EQ(ids(tracker.update({kBar, kPole}, 0.1)), (Ids{1, 2}));
  EXPECT_EQ(ids(tracker.update({kPole}, 0.2)), Ids{2});
}

TEST(HandleTracker, IdsAreNeverUsedAgain)
{
  HandleTracker tracker;
  EXPECT_EQ(ids(tracker.update({kBar, kPole}, 5.0)), (Ids{1, 2}));
  tracker.reset();
  EXPECT_EQ(ids(tracker.update({kBar}, 5.1)), Ids{3});
  // Time goes back.
  EXPECT_EQ(ids(tracker.update({kBar, kPole}, 1.0)), (Ids{4, 5}));
  EXPECT_EQ(ids(tracker.update({kPole, kBar}, 1.1)), (Ids{4, 5}));
}

TEST(HandleTracker, AfterALongGapWhatIsWhereItWasKeepsItsIdAndTheRestIsReportedAnew)
{
  HandleTracker tracker;
  for (int i = 0; i < 20; ++i) {
    tracker.update({kBar}, kPeriod * i);
  }
  const GraspHandle moved = straight(kBar.centroid + Vector3d(0.0, 0.01, 0.0), kBar.axis);
  const Handles known = tracker.update({moved, kPole}, 100.0);
  EXPECT_EQ(ids(known), (Ids{1, 2}));
  EXPECT_LT((known[0].centroid - moved.centroid).norm(), 1e-6) << "what was known so long ago still counts";
  EXPECT_EQ(ids(tracker.update({kPole}, 200.0)), Ids{2});
}

TEST(HandleTracker, AfterALongGapWhatWasFoundTooSeldomIsReportedAtOnceToo)
{
  TrackingConfig config;
  config.min_hits = 3;
  HandleTracker tracker(config);
  tracker.update({kBar}, 0.0);
  EXPECT_EQ(ids(tracker.update({kBar, kPole}, 0.1)), Ids{1});
  EXPECT_EQ(ids(tracker.update({kBar, kPole}, 5.0)), (Ids{1, 2}));
}

TEST(HandleTracker, CloudsWithTheSameStampAreAveraged)
{
  HandleTracker tracker;
  tracker.update({straight({0.0, 0.0, 0.8}, Vector3d::UnitX())}, 1.0);
  const Handles known = tracker.update({straight({0.0, 0.002, 0.8}, Vector3d::UnitX())}, 1.0);
  ASSERT_EQ(ids(known), Ids{1});
  EXPECT_NEAR(known[0].centroid.y(), 0.001, 1e-9);
}

TEST(HandleTracker, WithoutTrackingHandlesPassThrough)
{
  TrackingConfig config;
  config.track = false;
  HandleTracker tracker(config);
  Handles found{kBar, kPole};
  found[0].id = 1;
  found[1].id = 2;
  for (int i = 0; i < 2; ++i) {
    const Handles known = tracker.update(found, kPeriod * i);
    EXPECT_EQ(ids(known), (Ids{1, 2}));
    EXPECT_EQ(known[1].hits, 1U);
  }
  EXPECT_TRUE(tracker.update({}, 0.2).empty());
}

TEST(HandleTracker, GoesOnWithOtherParameters)
{
  HandleTracker tracker;
  tracker.update({kBar}, 0.0);
  TrackingConfig config;
  config.min_hits = 1;
  tracker.configure(config);
  EXPECT_EQ(ids(tracker.update({kBar, kPole}, 0.1)), (Ids{1, 2}));
  config.track = false;
  tracker.configure(config);
  config.track = true;
  tracker.configure(config);
  EXPECT_EQ(ids(tracker.update({kBar}, 0.2)), Ids{3});
}

TEST(HandleTracker, SameInputGivesSameOutput)
{
  const auto run = [] {
    Noise noise(23);
    HandleTracker tracker;
    std::vector<double> numbers;
    for (int i = 0; i < 50; ++i) {
      Handles found;
      for (int k = 0; k < 6; ++k) {
        found.push_back(noisy(straight({0.0, 0.025 * k, 0.8}, Vector3d::UnitX()), noise, 0.005));
      }
      for (const GraspHandle& handle : tracker.update(found, kPeriod * i)) {
        numbers.insert(numbers.end(), {static_cast<double>(handle.id), handle.centroid.x(), handle.axis.y(),
                                       handle.length, handle.radius});
      }
    }
    return numbers;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace grasp_affordances::test
