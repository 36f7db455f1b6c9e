#include "grasp_affordances/shell.h"

#include "support/points.h"

#include <gtest/gtest.h>

namespace grasp_affordances::test
{
namespace
{

constexpr double kSpacing = 0.0015;  // m
const HandGeometry kHand{0.026, 0.008};

ShellConfig paperShell()
{
  return presetConfig("paper").shell;
}

ShellConfig localizerShell()
{
  return presetConfig("localizer").shell;
}

FittedCylinder fittedCylinder(double radius)
{
  return {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), radius};
}

/// A bar about the z axis, as long as it is asked for, seen from one side.
Points bar(double radius, double length, std::uint64_t seed = 1)
{
  Random random(seed);
  const double area = M_PI * radius * length;
  return cylinderPoints(radius, M_PI, length, static_cast<std::size_t>(area / (kSpacing * kSpacing)), random);
}

/// A wall at a distance from the axis, parallel to it.
Points wall(double distance)
{
  Points points;
  for (double x = -0.05; x < 0.05; x += kSpacing) {
    for (double z = -0.06; z < 0.06; z += kSpacing) {
      points.emplace_back(x, -distance, z);
    }
  }
  return points;
}

Points operator+(Points a, const Points& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

ShellSearchResult searchShell(const Points& points, double fitted_radius, const ShellConfig& config)
{
  const Cloud cloud = cloudOf(points);
  const auto search = makeTreeSearch(cloud);
  return ShellSearch().search(*search, fittedCylinder(fitted_radius), kHand, config, kSpacing);
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
  EXPECT_NEAR(found.inner_radius, 0.0128, 1e-9);  // one step up, where all points are inside
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

TEST(ShellSearch, AsksForMorePointsOverALongerExtent)
{
  const ShellConfig config = localizerShell();
  Points sparse = bar(0.012, 0.1);
  sparse.resize(100);  // 30 over the clearance length of 3 cm, where 40 are asked for
  EXPECT_NE(searchShell(sparse, 0.0121, config).status, ShellSearchResult::found);
}

INSTANTIATE_TEST_SUITE_P(ShellSearch, BothPresets, testing::Values("paper", "localizer"),
                         [](const testing::TestParamInfo<std::string>& info) { return info.param; });

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

TEST(MeasuredLength, IsThatOfTheBar)
{
  for (const double length : {0.035, 0.05, 0.09}) {
    Points points = bar(0.012, length);
    const Eigen::Vector3d shift(0, 0, 0.01);  // the sample is not in the bar's middle
    const auto found = searchShell(transformed(points, Eigen::Matrix3d::Identity(), shift), 0.0121, localizerShell());
    ASSERT_EQ(found.status, ShellSearchResult::found) << length;
    EXPECT_NEAR(found.length, length, 2 * kSpacing);
    EXPECT_NEAR(found.centroid.z(), shift.z(), kSpacing);
  }
  EXPECT_EQ(searchShell(bar(0.012, 0.026), 0.0121, localizerShell()).status, ShellSearchResult::too_short);
}

TEST(MeasuredLength, EndsWhereTheBarMeetsAWall)
{
  Points points = bar(0.012, 0.12);
  for (double x = -0.04; x < 0.04; x += kSpacing) {
    for (double y = -0.04; y < 0.04; y += kSpacing) {
      points.emplace_back(x, y, 0.02);
    }
  }
  const auto found = searchShell(points, 0.0121, localizerShell());
  ASSERT_EQ(found.status, ShellSearchResult::found);
  const double end = found.centroid.z() + found.length / 2;
  EXPECT_LE(end, 0.02 + kSpacing);
  EXPECT_GE(end, 0.02 - 0.003 - kSpacing) << "by at most one slice too short";
}

TEST(MeasuredLength, IsNotBeyondTheLongestThatIsMeasured)
{
  const ShellConfig config = localizerShell();
  const auto found = searchShell(bar(0.012, 0.2), 0.0121, config);
  ASSERT_EQ(found.status, ShellSearchResult::found);
  EXPECT_NEAR(found.length, config.max_length, 1e-12);
}

TEST(MeasuredLength, IsThatOverWhichTheSurfaceFillsTheShell)
{
  // A slim cone: any part of it fits into some shell.
  Points cone;
  Random random(3);
  for (int i = 0; i < 6000; ++i) {
    const double z = random.uniform(0.0, 0.09), angle = random.uniform(0, 2 * M_PI);
    cone.emplace_back(0.36 * z * std::cos(angle), 0.36 * z * std::sin(angle), z - 0.04);
  }
  ShellConfig config = localizerShell();
  EXPECT_EQ(searchShell(cone, 0.01, config).status, ShellSearchResult::too_short);
  config.min_fill = 0.0;
  EXPECT_EQ(searchShell(cone, 0.01, config).status, ShellSearchResult::found);
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
