#include "core/tracking/axis_curve.h"
#include "grasp_affordances/handle_tracker.h"
#include "support/tracked_handles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

double deviation(const std::vector<double>& values)
{
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) {
    sum += (value - mean) * (value - mean);
  }
  return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(HandleTracker, KeepsIdsThroughNoiseAndDropoutsAndSmoothsThem)
{
  Noise noise(7);
  HandleTracker tracker;
  const std::vector<GraspHandle> truth{kBar, kPole, straight({0.0, 0.05, 0.8}, {1.0, 0.2, 0.0})};
  tracker.update(truth, 0.0);
  std::vector<std::vector<double>> places(3), turns(3), radii(3);
  std::vector<double> raw_places;
  for (int i = 1; i <= 200; ++i) {
    Handles found;
    for (const GraspHandle& handle : truth) {
      if (!noise.chance(0.2)) {
        found.push_back(noisy(handle, noise, 0.004));
        raw_places.push_back((found.back().centroid - handle.centroid).x());
      }
    }
    if (!found.empty()) {
      std::rotate(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(i % found.size()), found.end());
    }
    const Handles& known = tracker.update(found, kPeriod * i);
    ASSERT_EQ(ids(known), (Ids{1, 2, 3})) << "cloud " << i;
    for (std::size_t k = 0; k < 3 && i > 10; ++k) {
      places[k].push_back((known[k].centroid - truth[k].centroid).x());
      turns[k].push_back(angleBetween(known[k].axis, truth[k].axis));
      radii[k].push_back(known[k].radius);
    }
  }
  // A weight of 1 - exp(-0.1 / 1.0) = 0.095 leaves sqrt(0.095 / 1.905) = 0.22 of the noise; with a fifth of the clouds
  // missing a little more.
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LT(deviation(places[k]), 0.35 * deviation(raw_places)) << k;
    EXPECT_LT(*std::max_element(turns[k].begin(), turns[k].end()), 6.0 * kDegree) << k;
    EXPECT_LT(deviation(radii[k]), 0.0005) << k;
  }
}

TEST(HandleTracker, TheFirstCloudsAreAveragedInFull)
{
  TrackingConfig config;
  config.smoothing_time = 60.0;
  HandleTracker tracker(config);
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < 10; ++i) {
    const Vector3d offset(0.0, 0.0005 * i, -0.0003 * i);
    sum += offset;
    const GraspHandle known = tracker.update({straight(offset, Vector3d::UnitX())}, kPeriod * i).front();
    EXPECT_LT((known.centroid - sum / (i + 1)).norm(), 1e-9) << i;
  }
}

TEST(HandleTracker, SmoothsByTimeNotByClouds)
{
  const auto after_half_a_second = [](int clouds_per_second) {
    HandleTracker tracker;
    double y = 0.0;
    for (int i = 0; i < 10 * clouds_per_second + clouds_per_second / 2; ++i) {
      const double moved = i < 10 * clouds_per_second ? 0.0 : 0.01;
      const GraspHandle found = straight({0.0, moved, 0.8}, Vector3d::UnitX());
      y = tracker.update({found}, static_cast<double>(i) / clouds_per_second).front().centroid.y();
    }
    return y;
  };
  const double expected = 0.01 * (1.0 - std::exp(-0.5 / TrackingConfig().smoothing_time));
  EXPECT_NEAR(after_half_a_second(10), expected, 1e-6);
  EXPECT_NEAR(after_half_a_second(30), expected, 1e-6);
}

TEST(HandleTracker, WithoutSmoothingTheNewestIsReported)
{
  TrackingConfig config;
  config.smoothing_time = 0.0;
  HandleTracker tracker(config);
  Noise noise(3);
  for (int i = 0; i < 5; ++i) {
    const GraspHandle found = noisy(kBar, noise, 0.003);
    const GraspHandle known = tracker.update({found}, kPeriod * i).front();
    EXPECT_EQ(known.id, 1U);
    EXPECT_LT((known.centroid - found.centroid).norm(), 1e-9);
    EXPECT_LT((known.axis - found.axis).norm(), 1e-9);
    EXPECT_NEAR(known.length, found.length, 1e-9);
    EXPECT_EQ(known.radius, found.radius);
  }
}

TEST(HandleTracker, AxesHaveNoSign)
{
  // Near the diagonal the largest component is now x, now y, with different signs.
  Noise noise(11);
  HandleTracker tracker;
  const Vector3d diagonal = Vector3d(1.0, -1.0, 0.0).normalized();
  int flips = 0;
  Vector3d last = diagonal;
  for (int i = 0; i < 50; ++i) {
    const GraspHandle found = straight({0.0, 0.0, 0.8}, diagonal + noise.vector(0.02));
    flips += found.axis.dot(last) < 0.0 ? 1 : 0;
    last = found.axis;
    const Handles& known = tracker.update({found}, kPeriod * i);
    ASSERT_EQ(ids(known), Ids{1});
    EXPECT_LT(angleBetween(known[0].axis, diagonal), 4.0 * kDegree) << i;
    EXPECT_NEAR(known[0].length, 0.1, 0.001);
    EXPECT_EQ(known[0].axis, withLargestComponentPositive(known[0].axis));
  }
  EXPECT_GT(flips, 10);
}

TEST(HandleTracker, ABlobMayHaveAnyAxis)
{
  Noise noise(13);
  HandleTracker tracker;
  const Vector3d centre(0.1, 0.0, 0.8);
  for (int i = 0; i < 100; ++i) {
    const Handles& known =
        tracker.update({straight(centre + noise.vector(0.003), noise.vector(1.0), 0.035, 0.022)}, kPeriod * i);
    ASSERT_EQ(ids(known), Ids{1}) << "cloud " << i;
    EXPECT_LT((known[0].centroid - centre).norm(), 0.01);
    EXPECT_NEAR(known[0].length, 0.035, 1e-6);
  }
}

TEST(HandleTracker, ABentHandleKeepsItsShape)
{
  Noise noise(17);
  HandleTracker tracker;
  const double radius = 0.05;
  for (int i = 0; i < 100; ++i) {
    // Now and then a half of it is missing.
    const double to = (i % 4 == 3 ? 60.0 : 150.0) * kDegree + noise(0.05);
    GraspHandle found = arc(radius + noise(0.001), noise(0.05), to);
    if (noise.chance(0.5)) {
      std::reverse(found.polyline.begin(), found.polyline.end());
    }
    const Handles& known = tracker.update({found}, kPeriod * i);
    ASSERT_EQ(ids(known), Ids{1}) << "cloud " << i;
    ASSERT_GT(known[0].polyline.size(), 2U);
    for (const Vector3d& point : known[0].polyline) {
      const double from_centre = (point - Vector3d(0.0, 0.0, 0.8)).norm();
      EXPECT_NEAR(from_centre, radius, 0.004) << "cloud " << i;
      EXPECT_NEAR(point.z(), 0.8, 1e-9);
    }
    EXPECT_GT(known[0].length, radius * 90.0 * kDegree);
    for (const GraspPose& hand : known[0].hand_poses) {
      const AxisCurve curve(known[0]);
      const AxisCurve::Foot foot = curve.foot(hand.pose.translation());
      EXPECT_LT(foot.distance, 1e-3) << "cloud " << i;
      EXPECT_LT(angleBetween(hand.pose.linear().col(2), curve.direction(foot.s)), 16.0 * kDegree)
          << "cloud " << i;  // the found one turns by 12.5 at each point
    }
  }
}

TEST(HandleTracker, HandPosesMoveWithTheAxis)
{
  Noise noise(19);
  HandleTracker tracker;
  for (int i = 0; i < 30; ++i) {
    const Handles& known = tracker.update({noisy(kBar, noise, 0.004)}, kPeriod * i);
    ASSERT_EQ(known[0].hand_poses.size(), 1U);
    const Eigen::Isometry3d& hand = known[0].hand_poses[0].pose;
    EXPECT_LT((hand.linear() * hand.linear().transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-9);
    EXPECT_NEAR(hand.linear().determinant(), 1.0, 1e-9);
    EXPECT_LT(angleBetween(hand.linear().col(2), known[0].axis), 1e-6);
    EXPECT_LT(AxisCurve(known[0]).foot(hand.translation()).distance, 1e-9);
    EXPECT_NEAR(known[0].normal.dot(known[0].axis), 0.0, 1e-9);
    EXPECT_NEAR(known[0].normal.norm(), 1.0, 1e-9);
  }
}

/// Where the sensor's place is not known, normals are NaN.
TEST(HandleTracker, ANormalIsKnownWhereTheLastCloudHadOne)
{
  GraspHandle without = kBar;
  without.normal.setConstant(std::nan(""));
  HandleTracker tracker;
  for (int i = 0; i < 12; ++i) {
    const bool has_normal = i >= 4 && i < 8;
    const Handles& known = tracker.update({has_normal ? kBar : without}, kPeriod * i);
    ASSERT_EQ(ids(known), (Ids{1})) << "cloud " << i;
    EXPECT_TRUE(known[0].centroid.allFinite() && known[0].axis.allFinite());
    EXPECT_TRUE(known[0].hand_poses.at(0).pose.matrix().allFinite());
    if (has_normal) {
      EXPECT_LT((known[0].normal - kBar.normal).norm(), 1e-6) << "cloud " << i;
    } else {
      EXPECT_TRUE(known[0].normal.array().isNaN().all()) << "cloud " << i;
    }
  }
}

}  // namespace
}  // namespace grasp_affordances::test
