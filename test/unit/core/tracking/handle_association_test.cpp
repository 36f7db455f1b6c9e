#include "grasp_affordances/handle_tracker.h"
#include "support/tracked_handles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

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

}  // namespace
}  // namespace grasp_affordances::test
