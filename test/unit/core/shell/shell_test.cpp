#include "core/shell/shell.h"
#include "core/shell/free_space.h"
#include "support/points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>

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
  return ShellSearch().search({*search, nullptr, nullptr, kSpacing}, fittedCylinder(fitted_radius), kHand, config);
}

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

/// A wall that was not measured but is taken to go on behind the bar counts against the gap, not as points in it.
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

/// An image of an upright bar at a depth of 0.8 m before a wall, and what of it an obstacle or a hole hides.
class BarImage
{
public:
  /// `hidden(y)`: depth (m; NaN: not measured) of what hides the bar at a height (m), or 0 for nothing.
  template <typename Hidden>
  BarImage(double radius, double half_length, Hidden&& hidden) : cylinder_{{0, 0, kDepth}, {0, 1, 0}, 0.9 * radius}
  {
    cloud_.reset(320, 240);
    cloud_.intrinsics = PinholeIntrinsics{480.0, 480.0, 159.5, 119.5};
    for (std::uint32_t v = 0; v < cloud_.height; ++v) {
      for (std::uint32_t u = 0; u < cloud_.width; ++u) {
        const double slope_x = (u - 159.5) / 480.0, slope_y = (v - 119.5) / 480.0;
        const double x = slope_x * kDepth, y = slope_y * kDepth;
        double z = 1.2;
        if (std::abs(x) < radius && std::abs(y) < half_length) {
          z = hidden(y) == 0.0 ? kDepth - std::sqrt(radius * radius - x * x) : hidden(y);
        }
        cloud_.set(v * cloud_.width + u, static_cast<float>(slope_x * z), static_cast<float>(slope_y * z),
                   static_cast<float>(z));
      }
    }
    std::string warning;
    image_ = RangeImage::create(cloud_, warning);
    search_ = makeWindowSearch(*image_, cloud_.size());
  }
  BarImage(const BarImage&) = delete;
  BarImage& operator=(const BarImage&) = delete;

  ShellSearchResult search(const ShellConfig& config) const { return search(*search_, config); }
  ShellSearchResult search(const NeighborhoodSearch& search, const ShellConfig& config) const
  {
    return ShellSearch().search({search, nullptr, &*image_, image_->spacing(kDepth)}, cylinder_, kHand, config);
  }
  ShellSearchResult search(ShellSearch& search, const ShellConfig& config) const
  {
    return search.search({*search_, nullptr, &*image_, image_->spacing(kDepth)}, cylinder_, kHand, config);
  }
  const RangeImage& image() const { return *image_; }

private:
  static constexpr double kDepth = 0.8;

  FittedCylinder cylinder_;
  Cloud cloud_;
  std::optional<RangeImage> image_;
  std::unique_ptr<NeighborhoodSearch> search_;
};

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

TEST(MeasuredLength, GoesOnBehindWhatHidesTheSurface)
{
  for (const double hidden_by : {0.6, std::nan("")}) {
    const BarImage bar(0.012, 0.045, [&](double y) { return y > 0.008 && y < 0.022 ? hidden_by : 0.0; });
    const auto found = bar.search(localizerShell());
    ASSERT_EQ(found.status, ShellSearchResult::found);
    EXPECT_NEAR(found.length, 0.09, 0.008) << "hidden by something at " << hidden_by;
  }
  // Where the sensor sees through, the bar ends.
  const BarImage broken(0.012, 0.045, [](double y) { return y > 0.008 && y < 0.022 ? 1.2 : 0.0; });
  const auto found = broken.search(localizerShell());
  ASSERT_EQ(found.status, ShellSearchResult::found);
  EXPECT_NEAR(found.length, 0.053, 0.008);
}

TEST(MeasuredLength, MakesAllowanceForTheErrorOfDepth)
{
  // A bar half of which is slimmer than the shell around the other half by 4 mm: filled only within the depth's error.
  Points points = transformed(bar(0.008, 0.03), Eigen::Matrix3d::Identity(), {0.0, 0.0, 0.8 + 0.015}) +
                  transformed(bar(0.012, 0.03), Eigen::Matrix3d::Identity(), {0.0, 0.0, 0.8 - 0.015});
  const Cloud cloud = cloudOf(points);
  const auto search = makeTreeSearch(cloud);
  const BarImage any(0.012, 0.045, [](double) { return 0.0; });
  ShellConfig config = localizerShell();
  config.recenter = false;
  config.min_fill = 0.8;
  const FittedCylinder cylinder{{0.0, 0.0, 0.8}, Eigen::Vector3d::UnitZ(), 0.0125};
  for (const double depth_error : {0.0, 0.01}) {
    config.depth_error = depth_error;
    const auto found = ShellSearch().search({*search, nullptr, &any.image(), kSpacing}, cylinder, kHand, config);
    EXPECT_EQ(found.status == ShellSearchResult::found && found.length > 0.05, depth_error > 0.0) << found.length;
  }
}

TEST(SilhouetteCoverage, IsTheShareThatShowsSurfaceInsideTheShell)
{
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitY(), normal = -Eigen::Vector3d::UnitZ();
  ShellSearchResult shell;
  shell.centroid = {0.0, 0.0, 0.8};
  shell.inner_radius = 0.013;
  shell.length = 0.04;
  const auto coverage = [&](const BarImage& bar) { return silhouetteCoverage(bar.image(), shell, axis, normal); };
  EXPECT_GT(coverage(BarImage(0.0129, 0.03, [](double) { return 0.0; })), 0.95);
  EXPECT_NEAR(coverage(BarImage(0.0065, 0.03, [](double) { return 0.0; })), 0.5, 0.1) << "half as wide";
  const auto upper_half = [](double y) { return y < 0.0; };
  EXPECT_NEAR(coverage(BarImage(0.0129, 0.03, [&](double y) { return upper_half(y) ? 1.2 : 0.0; })), 0.5, 0.1);
  EXPECT_GT(coverage(BarImage(0.0129, 0.03, [&](double y) { return upper_half(y) ? 0.5 : 0.0; })), 0.95) << "hidden";
  EXPECT_GT(coverage(BarImage(0.0129, 0.03, [&](double y) { return upper_half(y) ? std::nan("") : 0.0; })), 0.95);
  EXPECT_EQ(coverage(BarImage(0.0129, 0.03, [](double) { return std::nan(""); })), 0.0);
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
