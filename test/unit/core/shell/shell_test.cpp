#include "core/shell/shell.h"

#include "support/bars.h"
#include "support/points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

namespace grasp_affordances::test
{
namespace
{

ShellConfig withoutRecentering()
{
  ShellConfig config = localizerShell();
  config.recenter = false;
  return config;
}

class BothPresets : public testing::TestWithParam<std::string>
{
protected:
  ShellConfig config() const { return presetConfig(GetParam()).shell; }
};

TEST_P(BothPresets, FindABar)
{
  const ShellSearchResult found = searchShell(bar(0.012, 0.06), 0.0118, config());
  ASSERT_EQ(found.status, ShellSearchResult::found);
  EXPECT_GE(found.inner_radius, 0.012);
  EXPECT_LE(found.inner_radius, 0.013 + 1e-9);  // one step up, where all points are inside
  EXPECT_EQ(found.points_in_gap, 0U);
}

TEST_P(BothPresets, RefuseAWallNearerThanTheFinger)
{
  const double radius = 0.012;
  const auto blocked = searchShell(bar(radius, 0.06) + wall(radius + 0.007), radius, config());
  EXPECT_NE(blocked.status, ShellSearchResult::found);
  const auto clear = searchShell(bar(radius, 0.06) + wall(radius + 0.009), radius, config());
  EXPECT_EQ(clear.status, ShellSearchResult::found);
  EXPECT_LE(clear.inner_radius, radius + 0.001 + 1e-9);
}

TEST_P(BothPresets, RefuseACylinderThatIsTooLarge)
{
  EXPECT_EQ(searchShell(bar(0.0255, 0.06), 0.0248, config()).status, ShellSearchResult::found);
  EXPECT_EQ(searchShell(bar(0.027, 0.06), 0.027, config()).status, ShellSearchResult::none);
  EXPECT_EQ(searchShell(bar(0.027, 0.06), 0.024, config()).status, ShellSearchResult::none) << "fitted too small";
}

TEST_P(BothPresets, RefuseTooFewPoints)
{
  Points sparse = bar(0.012, 0.04);
  sparse.resize(20);
  EXPECT_NE(searchShell(sparse, 0.0121, config()).status, ShellSearchResult::found);
  EXPECT_NE(searchShell({}, 0.0121, config()).status, ShellSearchResult::found);
}

TEST_P(BothPresets, FindTheSameInAnImageAndInATree)
{
  const BarImage bar(0.012, 0.045, [](double y) { return y > 0.02 && y < 0.03 ? std::nan("") : 0.0; });
  const auto in_image = bar.search(config());
  const auto in_tree = bar.search(*makeTreeSearch(bar.image().cloud()), config());
  ASSERT_EQ(in_image.status, ShellSearchResult::found);
  EXPECT_EQ(in_tree.status, ShellSearchResult::found);
  EXPECT_EQ(in_tree.points_inside, in_image.points_inside);
  EXPECT_EQ(in_tree.points_in_gap, in_image.points_in_gap);
  EXPECT_NEAR(in_tree.inner_radius, in_image.inner_radius, 1e-12);
  EXPECT_NEAR(in_tree.length, in_image.length, 1e-12);
  EXPECT_LT((in_tree.centroid - in_image.centroid).norm(), 1e-12);
}

TEST(ShellSearch, AsksForMorePointsOverALongerExtent)
{
  const ShellConfig config = localizerShell();
  Points sparse = bar(0.012, 0.1);
  sparse.resize(100);  // 30 over the clearance length of 3 cm, where 40 are asked for
  EXPECT_NE(searchShell(sparse, 0.0121, config).status, ShellSearchResult::found);
}

INSTANTIATE_TEST_SUITE_P(ShellSearch, BothPresets, testing::Values("paper", "localizer"),
                         [](const testing::TestParamInfo<std::string>& info) { return info.param; });

TEST(ShellSearch, NeedsNoMoreThanTheLeastNumberOfPointsInside)
{
  const Points points = bar(0.012, 0.06);
  ShellConfig config = paperShell();
  const auto any = searchShell(points, 0.0125, config);
  ASSERT_EQ(any.status, ShellSearchResult::found);
  config.min_points_inside = static_cast<int>(any.points_inside);
  const auto enough = searchShell(points, 0.0125, config);
  EXPECT_EQ(enough.status, ShellSearchResult::found);
  EXPECT_EQ(enough.points_inside, any.points_inside);
  ++config.min_points_inside;
  EXPECT_NE(searchShell(points, 0.0125, config).status, ShellSearchResult::found) << "all are inside already";
}

TEST(ShellSearch, ToleratesFewerPointsInTheGapThanBlockIt)
{
  Points points = bar(0.012, 0.06);
  for (int i = 0; i < 4; ++i) {
    points.emplace_back(0, -0.016, 0.001 * i);
  }
  const auto four = searchShell(points, 0.0121, paperShell());
  EXPECT_EQ(four.status, ShellSearchResult::found);
  EXPECT_EQ(four.points_in_gap, 4U);
  points.emplace_back(0, -0.016, -0.001);
  const auto five = searchShell(points, 0.0121, paperShell());
  EXPECT_GT(five.inner_radius, 0.0155) << "grown until the five points are inside";
}

/// A flat arc of a thick bar, and a fitted axis that is too near to it: the shell leaves out what the bar hides.
TEST(ShellSearch, RecentersOnTheWholeSurface)
{
  constexpr double kRadius = 0.024, kOffset = 0.008;
  Random random(2);
  const Points arc = transformed(cylinderPoints(kRadius, 2.0, 0.08, 3000, random, 0.0003), Eigen::Matrix3d::Identity(),
                                 {0.0, kOffset, 0.0});
  const Cloud cloud = cloudOf(arc);
  const auto search = makeTreeSearch(cloud);
  const auto fixed =
      ShellSearch().search({*search, nullptr, nullptr, kSpacing}, fittedCylinder(0.019), kHand, withoutRecentering());
  ASSERT_EQ(fixed.status, ShellSearchResult::found);
  EXPECT_LT(fixed.centroid.head<2>().norm(), 1e-12);
  const auto recentered =
      ShellSearch().search({*search, nullptr, nullptr, kSpacing}, fittedCylinder(0.019), kHand, localizerShell());
  ASSERT_EQ(recentered.status, ShellSearchResult::found);
  EXPECT_NEAR(recentered.centroid.y(), kOffset, 0.001);
  EXPECT_NEAR(recentered.inner_radius, kRadius, 0.0015);
}

/// Some points stand off from a bar so far that only the largest shell encloses them.
TEST(ShellSearch, TriesTheLargestShellThatTheHandCanEncloseAfterRecentering)
{
  for (const double capture_radius : {0.026, 0.029, 0.035, 0.045, 0.048}) {
    for (int steps = 1; steps <= 6; ++steps) {
      const HandGeometry hand{capture_radius, kHand.finger_thickness};
      const double radius = capture_radius - 0.0005 - 0.001 * steps;
      Points points = bar(radius, 0.06);
      Random random(4);
      points = points + cylinderPoints(capture_radius - 0.0005, M_PI, 0.06, 120, random);
      const Cloud cloud = cloudOf(points);
      const auto search = makeTreeSearch(cloud);
      ShellConfig config = localizerShell();
      config.min_fill = 0.0;
      // Without rounding trouble of its own: the first search ends at the capture radius exactly.
      const FittedCylinder cylinder{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), capture_radius};
      const auto found = ShellSearch().search({*search, nullptr, nullptr, kSpacing}, cylinder, hand, config);
      ASSERT_EQ(found.status, ShellSearchResult::found) << capture_radius << ", " << steps;
      EXPECT_NEAR(found.inner_radius, capture_radius, 1e-9);
      EXPECT_LE(found.inner_radius, capture_radius);
    }
  }
}

/// The smallest radius that is a whole number of steps below the capture radius is zero then, but for rounding.
TEST(ShellSearch, HasNoNegativeRadiusAboutAThread)
{
  Random random(1);
  Points thread;
  for (int i = 0; i < 200; ++i) {
    thread.emplace_back(random.uniform(-1e-20, 1e-20), random.uniform(-1e-20, 1e-20), random.uniform(-0.02, 0.02));
  }
  ShellConfig config = localizerShell();
  config.measure_length = false;
  ASSERT_TRUE(config.recenter);
  const ShellSearchResult result = searchShell(thread, 0.0, config);
  ASSERT_EQ(result.status, ShellSearchResult::found);
  EXPECT_GE(result.inner_radius, 0.0);
  EXPECT_LE(result.inner_radius, 2 * config.radius_step);
}

/// A wall that was not measured but is taken to go on behind the bar counts against the gap, not as points in it.
TEST(ShellSearch, HiddenSurfacesBlockTheGap)
{
  const Cloud cloud = cloudOf(bar(0.012, 0.06));
  const auto search = makeTreeSearch(cloud);
  for (const double distance : {0.019, 0.022}) {
    const Cloud hidden = cloudOf(wall(distance));
    const auto hidden_search = makeTreeSearch(hidden);
    const auto found = ShellSearch().search({*search, hidden_search.get(), nullptr, kSpacing}, fittedCylinder(0.0118),
                                            kHand, localizerShell());
    EXPECT_EQ(found.status == ShellSearchResult::found, distance > 0.0205) << distance;
    EXPECT_EQ(found.points_in_gap, 0U);
  }
}

TEST(ShellSearch, IsTheSameAgainWithTheMemoryOfOthers)
{
  const BarImage thick(0.02, 0.045, [](double) { return 0.0; }), slim(0.012, 0.03, [](double) { return 0.0; });
  ShellSearch search;
  for (const ShellConfig& config : {localizerShell(), paperShell()}) {
    for (const BarImage* bar : {&thick, &slim, &thick}) {
      const auto alone = bar->search(config);
      const auto after = bar->search(search, config);
      ASSERT_EQ(alone.status, ShellSearchResult::found);
      EXPECT_EQ(after.centroid, alone.centroid);
      EXPECT_EQ(after.points_inside, alone.points_inside);
    }
  }
}

TEST(ShellSearch, CountsArePointsOfTheCloudOverTheLength)
{
  const Points points = bar(0.012, 0.08) + wall(0.03);
  for (const ShellConfig& config : {paperShell(), localizerShell()}) {
    const auto found = searchShell(points, 0.0105, config);
    ASSERT_EQ(found.status, ShellSearchResult::found);
    std::uint32_t inside = 0, in_gap = 0;
    for (const Eigen::Vector3d& exact : points) {
      const Eigen::Vector3d p = exact.cast<float>().cast<double>();
      const double radial = p.head<2>().norm();
      if (std::abs(p.z() - found.centroid.z()) <= found.length / 2) {
        inside += radial <= found.inner_radius ? 1 : 0;
        in_gap += radial > found.inner_radius && radial <= found.inner_radius + kHand.finger_thickness ? 1 : 0;
      }
    }
    EXPECT_EQ(found.points_inside, inside);
    EXPECT_EQ(found.points_in_gap, in_gap);
  }
}

TEST(PointThresholds, FollowTheDensityOfPoints)
{
  const ShellConfig config = localizerShell();
  const PointThresholds reference = pointThresholds(config, config.reference_spacing);
  EXPECT_DOUBLE_EQ(reference.gap_points_to_block, config.gap_points_to_block);
  EXPECT_DOUBLE_EQ(reference.min_points_inside, config.min_points_inside);
  EXPECT_DOUBLE_EQ(pointThresholds(config, config.reference_spacing / 2).min_points_inside,
                   4.0 * config.min_points_inside);
  EXPECT_DOUBLE_EQ(pointThresholds(config, 1.0).gap_points_to_block, 2.0) << "one point is never evidence";
  EXPECT_DOUBLE_EQ(pointThresholds(config, 0.0).min_points_inside, config.min_points_inside) << "unknown density";
  EXPECT_DOUBLE_EQ(pointThresholds(paperShell(), 0.003).min_points_inside, 40.0);
}

}  // namespace
}  // namespace grasp_affordances::test
