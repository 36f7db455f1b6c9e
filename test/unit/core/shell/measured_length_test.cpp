#include "core/shell/shell.h"
#include "support/bars.h"
#include "support/points.h"

#include <gtest/gtest.h>

#include <cmath>

namespace grasp_affordances::test
{
namespace
{

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

}  // namespace
}  // namespace grasp_affordances::test
