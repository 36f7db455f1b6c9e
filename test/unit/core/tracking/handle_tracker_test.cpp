#include "grasp_affordances/handle_tracker.h"

#include "core/tracking/assignment.h"
#include "core/tracking/axis_curve.h"
#include "grasp_affordances/localization.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

using Eigen::Vector3d;
using Handles = std::vector<GraspHandle>;

constexpr double kPeriod = 0.1;  // s
constexpr double kDegree = 3.14159265358979323846 / 180.0;

GraspHandle bent(std::vector<Vector3d> polyline, double radius = 0.01)
{
  GraspHandle handle;
  handle.polyline = std::move(polyline);
  const AxisCurve curve(handle.polyline);
  handle.length = curve.length();
  handle.centroid = curve.at(curve.length() / 2.0);
  handle.axis = withLargestComponentPositive(curve.direction(curve.length() / 2.0));
  handle.normal = handle.axis.unitOrthogonal();
  handle.radius = radius;
  handle.inner_radius = radius + 0.002;
  handle.score = 0.5;
  handle.observed_free = 0.8;
  handle.shells = {0, 1, 2};
  GraspPose hand;
  hand.pose.linear() << -handle.normal, handle.axis.cross(-handle.normal), handle.axis;
  hand.pose.translation() = handle.centroid;
  handle.hand_poses = {hand};
  return handle;
}

GraspHandle straight(const Vector3d& centroid, const Vector3d& axis, double length = 0.1, double radius = 0.01)
{
  const Vector3d half = length / 2.0 * axis.normalized();
  return bent({centroid - half, centroid + half}, radius);
}

Vector3d onArc(double radius, double angle)
{
  return {radius * std::cos(angle), radius * std::sin(angle), 0.8};
}

/// A part of a circle about (0, 0, 0.8).
GraspHandle arc(double radius, double from, double to)
{
  std::vector<Vector3d> points;
  for (int i = 0; i <= 12; ++i) {
    points.push_back(onArc(radius, from + (to - from) * i / 12.0));
  }
  return bent(points);
}

class Noise
{
public:
  explicit Noise(std::uint32_t seed) : generator_(seed) {}
  double operator()(double deviation) { return std::normal_distribution<double>(0.0, deviation)(generator_); }
  Vector3d vector(double deviation)
  {
    const double x = (*this)(deviation), y = (*this)(deviation), z = (*this)(deviation);
    return {x, y, z};
  }
  bool chance(double share) { return std::uniform_real_distribution<double>()(generator_) < share; }

private:
  std::mt19937 generator_;  // its numbers, unlike those of the distributions, are the same everywhere
};

/// Ends moved on their own; the polyline begins at either end.
GraspHandle noisy(const GraspHandle& handle, Noise& noise, double deviation)
{
  GraspHandle result =
      bent({handle.polyline.front() + noise.vector(deviation), handle.polyline.back() + noise.vector(deviation)},
           handle.radius + noise(0.001));
  if (noise.chance(0.5)) {
    std::reverse(result.polyline.begin(), result.polyline.end());
  }
  return result;
}

std::vector<std::uint32_t> ids(const Handles& handles)
{
  std::vector<std::uint32_t> result;
  for (const GraspHandle& handle : handles) {
    result.push_back(handle.id);
  }
  return result;
}

using Ids = std::vector<std::uint32_t>;

double angleBetween(const Vector3d& a, const Vector3d& b)
{
  return std::acos(std::min(1.0, std::abs(a.dot(b)) / (a.norm() * b.norm())));
}

double deviation(const std::vector<double>& values)
{
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) {
    sum += (value - mean) * (value - mean);
  }
  return std::sqrt(sum / static_cast<double>(values.size()));
}

const GraspHandle kBar = straight({0.0, 0.0, 0.8}, {1.0, 0.2, 0.0});
const GraspHandle kPole = straight({0.2, 0.1, 0.9}, {0.0, 0.0, 1.0}, 0.12, 0.015);

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

TEST(HandleTracker, AHandleFoundInTwoPiecesOrShorterKeepsItsId)
{
  HandleTracker tracker;
  const Vector3d axis = Vector3d::UnitX();
  const auto piece = [&](double from, double to) { return straight({(from + to) / 2.0, 0.0, 0.8}, axis, to - from); };
  for (int i = 0; i < 60; ++i) {
    Handles found{piece(-0.08, 0.08)};
    if (i % 3 == 1) {
      found = {piece(-0.08, -0.03), piece(-0.01, 0.08)};
      found.back().shells = {5, 9};
    } else if (i % 3 == 2) {
      found = {piece(0.03, 0.08)};
    }
    const Handles& known = tracker.update(found, kPeriod * i);
    ASSERT_EQ(ids(known), Ids{1}) << "cloud " << i;
    EXPECT_GT(known[0].length, 0.08);
    EXPECT_LT(angleBetween(known[0].axis, axis), 1e-6);
    if (i % 3 == 1) {
      EXPECT_EQ(known[0].shells, (std::vector<std::uint32_t>{0, 1, 2, 5, 9}));
    }
  }
}

TEST(HandleTracker, PiecesThatStayApartAreHandlesOfTheirOwn)
{
  HandleTracker tracker;
  const GraspHandle whole = straight({0.0, 0.0, 0.8}, Vector3d::UnitX(), 0.2);
  const Handles halves{straight({-0.06, 0.0, 0.8}, Vector3d::UnitX(), 0.06),
                       straight({0.05, 0.0, 0.8}, Vector3d::UnitX(), 0.08)};
  tracker.update({whole}, 0.0);
  for (int i = 1; i < 10; ++i) {
    EXPECT_EQ(ids(tracker.update(halves, kPeriod * i)), Ids{1});
  }
  Handles known;
  for (int i = 10; i < 250; ++i) {
    known = tracker.update(halves, kPeriod * i);
  }
  ASSERT_EQ(ids(known), (Ids{1, 2}));
  EXPECT_NEAR(known[0].centroid.x(), 0.05, 0.002);
  EXPECT_NEAR(known[0].length, 0.08, 0.002);
  EXPECT_NEAR(known[1].centroid.x(), -0.06, 0.002);
}

TEST(HandleTracker, NeighborsDoNotSwap)
{
  Noise noise(5);
  HandleTracker tracker;
  const Handles truth{straight({0.0, 0.0, 0.8}, Vector3d::UnitX()), straight({0.0, 0.022, 0.8}, Vector3d::UnitX())};
  tracker.update(truth, 0.0);
  for (int i = 1; i < 300; ++i) {
    Handles found;
    for (const GraspHandle& handle : truth) {
      if (!noise.chance(0.3)) {
        found.insert(noise.chance(0.5) ? found.begin() : found.end(), noisy(handle, noise, 0.003));
      }
    }
    const Handles& known = tracker.update(found, kPeriod * i);
    for (const GraspHandle& handle : known) {
      ASSERT_LE(handle.id, 2U) << "cloud " << i;
      ASSERT_LT((handle.centroid - truth[handle.id - 1].centroid).norm(), 0.01) << "cloud " << i;
    }
  }
}

TEST(HandleTracker, ARowThatMovesByMoreThanHalfItsSpacingKeepsItsOrder)
{
  TrackingConfig config;
  config.smoothing_time = 0.0;
  HandleTracker tracker(config);
  for (int i = 0; i < 20; ++i) {
    Handles found;
    for (int k = 0; k < 4; ++k) {
      found.push_back(straight({0.0, 0.03 * k + 0.018 * i, 0.8}, Vector3d::UnitX()));
    }
    const Handles known = tracker.update(found, kPeriod * i);
    ASSERT_EQ(ids(known), (Ids{1, 2, 3, 4})) << "cloud " << i;
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR(known[k].centroid.y(), 0.03 * k + 0.018 * i, 1e-9);
    }
  }
}

TEST(HandleTracker, HandlesThatPassEachOtherKeepTheirIds)
{
  // In opposite directions, one above the other by 6 cm.
  HandleTracker tracker;
  for (int i = 0; i <= 40; ++i) {
    const double x = 0.005 * (i - 20);
    const Handles known = tracker.update(
        {straight({x, 0.0, 0.8}, Vector3d::UnitY()), straight({-x, 0.0, 0.86}, Vector3d::UnitY(), 0.1, 0.015)},
        kPeriod * i);
    ASSERT_EQ(ids(known), (Ids{1, 2}));
    EXPECT_NEAR(known[0].centroid.z(), 0.8, 1e-9);
    EXPECT_NEAR(known[1].centroid.z(), 0.86, 1e-9);
  }
}

TEST(HandleTracker, FollowsAHandleThatIsMoved)
{
  HandleTracker tracker;
  Handles known;
  for (int i = 0; i < 100; ++i) {
    const double x = 0.02 * std::min(i, 30);
    known = tracker.update({straight({x, 0.0, 0.8}, Vector3d::UnitY())}, kPeriod * i);
    ASSERT_EQ(ids(known), Ids{1}) << "cloud " << i;
  }
  EXPECT_NEAR(known[0].centroid.x(), 0.6, 0.002);
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

/// The cheapest of all assignments.
double cheapest(const Eigen::MatrixXd& costs, double alone, Eigen::Index row, std::vector<bool>& taken)
{
  if (row == costs.rows()) {
    return 0.0;
  }
  double best = alone + cheapest(costs, alone, row + 1, taken);
  for (Eigen::Index column = 0; column < costs.cols(); ++column) {
    if (!taken[column]) {
      taken[column] = true;
      best = std::min(best, costs(row, column) + cheapest(costs, alone, row + 1, taken));
      taken[column] = false;
    }
  }
  return best;
}

TEST(CheapestAssignment, IsAsCheapAsTheBestOfAll)
{
  std::mt19937 generator(29);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Index rows = i % 6, columns = i / 6 % 6;
    Eigen::MatrixXd costs(rows, columns);
    for (Eigen::Index k = 0; k < costs.size(); ++k) {
      const double cost = uniform(generator);
      // Of few values, so that several assignments cost the same.
      costs(k) = cost > 0.8 ? std::numeric_limits<double>::infinity() : std::floor(8.0 * cost) / 4.0;
    }
    double sum = 0.0;
    std::set<Eigen::Index> used;
    const std::vector<std::optional<Eigen::Index>> assigned = cheapestAssignment(costs, 1.0);
    ASSERT_EQ(assigned.size(), static_cast<std::size_t>(rows));
    for (Eigen::Index row = 0; row < rows; ++row) {
      sum += assigned[row] ? costs(row, *assigned[row]) : 1.0;
      EXPECT_TRUE(!assigned[row] || used.insert(*assigned[row]).second);
    }
    std::vector<bool> taken(columns, false);
    EXPECT_NEAR(sum, cheapest(costs, 1.0, 0, taken), 1e-12) << costs;
  }
}

TEST(AxisCurve, WaysAndFeet)
{
  const AxisCurve curve({{0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {3.0, 4.0, 0.0}});
  EXPECT_DOUBLE_EQ(curve.length(), 7.0);
  EXPECT_LT((curve.at(5.0) - Vector3d(3.0, 2.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((curve.at(-1.0) - Vector3d(-1.0, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((curve.at(8.0) - Vector3d(3.0, 5.0, 0.0)).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(curve.foot({1.0, 1.0, 0.0}).s, 1.0);
  EXPECT_DOUBLE_EQ(curve.foot({1.0, 1.0, 0.0}).distance, 1.0);
  EXPECT_DOUBLE_EQ(curve.foot({-2.0, 0.0, 0.0}).s, -2.0);
  EXPECT_DOUBLE_EQ(curve.foot({-2.0, 0.0, 0.0}).distance, 2.0);
  EXPECT_DOUBLE_EQ(curve.foot({4.0, -1.0, 0.0}).s, 3.0);  // outside the bend
}

}  // namespace
}  // namespace grasp_affordances::test
