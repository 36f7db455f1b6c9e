#include "grasp_affordances/localizer.h"
#include "support/hand_poses.h"
#include "support/points.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

TEST(HandPoses, OfUnorganizedCloudsDependOnPointsAloneAndNotOnTheirOrder)
{
  Cloud cloud = unorganized(captureScene("table", 1).cloud);
  Config config;
  config.hand_poses.min_observed_free = 1.0;
  const Localization found = Localizer(config).localize(cloud);
  ASSERT_GT(found.handles.size(), 0U);
  std::vector<std::vector<GraspPose>> expected;
  std::size_t poses = 0;
  Moment in_order({{&cloud, Pose::Identity()}}, config);
  for (const GraspHandle& handle : found.handles) {
    expected.push_back(in_order.search(config, handle));
    poses += expected.back().size();
    for (const GraspPose& hand : expected.back()) {
      EXPECT_TRUE(std::isnan(hand.observed_free));
      EXPECT_GE(hand.score, 0.0);
    }
  }
  ASSERT_GT(poses, 0U);
  Random random(5);
  for (std::size_t i = cloud.size() - 1; i > 0; --i) {
    const auto j = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(i + 1)));
    std::swap(cloud.x[i], cloud.x[j]);
    std::swap(cloud.y[i], cloud.y[j]);
    std::swap(cloud.z[i], cloud.z[j]);
  }
  Moment shuffled({{&cloud, Pose::Identity()}}, config);
  for (std::size_t i = 0; i < found.handles.size(); ++i) {
    EXPECT_TRUE(sameBytes(shuffled.search(config, found.handles[i]), expected[i])) << "handle " << i;
  }
}

TEST(HandPoses, AreTheSameForAnyNumberOfThreadsAndWhateverCameBefore)
{
  const Cloud cloud = captureScene("table", 1).cloud, other = captureScene("mugs", 2).cloud;
  Config config;
  config.threads = 1;
  const Localization reference = Localizer(config).localize(cloud);
  std::size_t poses = 0;
  for (const int threads : {1, 2, 5}) {
    config.threads = threads;
    Localizer localizer(config);
    localizer.localize(other);
    const Localization result = localizer.localize(cloud);
    ASSERT_EQ(result.handles.size(), reference.handles.size());
    for (std::size_t i = 0; i < result.handles.size(); ++i) {
      EXPECT_TRUE(sameBytes(result.handles[i].hand_poses, reference.handles[i].hand_poses)) << threads << ", " << i;
      poses += result.handles[i].hand_poses.size();
    }
  }
  EXPECT_GT(poses, 0U);
}

TEST(HandPoses, MoveWithTheCommonFrame)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  const Config config;
  const Pose T = at(0.3, -0.2, 0.9) * turned(0.8, Vector(1.0, 2.0, -0.5).normalized());
  for (const GraspHandle& handle : Localizer(config).localize(cloud).handles) {
    const GraspHandle moved = transformed(handle, T);
    const bool flipped = moved.axis.dot(T.linear() * handle.axis) < 0.0;  // its other direction may stand for it now
    const auto hands = search(cloud, config, handle);
    const auto posed = search({{&cloud, T}}, config, moved);
    ASSERT_EQ(posed.size(), hands.size());
    for (const GraspPose& hand : hands) {
      const auto found = findApproach(posed, T.linear() * approach(hand), T * hand.pose.translation());
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->score, hand.score, 0.02) << flipped;
    }
  }
}

}  // namespace
}  // namespace grasp_affordances::test
