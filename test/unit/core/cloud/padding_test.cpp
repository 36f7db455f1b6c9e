#include "core/cloud/padding.h"

#include "core/cloud/usable_cloud.h"
#include "grasp_affordances/localizer.h"
#include "support/points.h"
#include "support/table.h"
#include "support/usable_clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

/// The result is that of the cloud with NaN in place of the padding, which is named once.
TEST(UsableCloud, LeavesOutPadding)
{
  const Cloud image = table(), robot = moved(image, robotPose());
  const std::size_t holes = image.size() - measuredPoints(image);
  ASSERT_GT(holes, 1000U);
  const Eigen::Vector3f place = robotPose().translation().cast<float>();
  const std::pair<Cloud, Cloud> cases[] = {{image, padded(image, {0.1F, 0.2F, 0.3F})},
                                           {withoutIntrinsics(image), withoutIntrinsics(padded(image, place))},
                                           {robot, padded(robot, place)},
                                           {unorganized(robot), unorganized(padded(robot, place))}};
  Localizer localizer;
  int number = 0;
  for (const auto& [with_nan, with_padding] : cases) {
    const std::string what = "case " + std::to_string(number++);
    const Localization expected = localizer.localize(with_nan), result = localizer.localize(with_padding);
    expectSame(result, expected, what);
    ASSERT_EQ(result.warnings.size(), expected.warnings.size() + 1) << what;
    EXPECT_EQ(result.warnings[0].find(std::to_string(holes) + " points coincide at ("), 0U) << result.warnings[0];
    EXPECT_NE(result.warnings[0].find("padding"), std::string::npos) << result.warnings[0];
  }
  const Localization robot_result = localizer.localize(cases[2].second);
  EXPECT_NE(robot_result.warnings[0].find("(0.3, -0.2, 1) m"), std::string::npos) << robot_result.warnings[0];
}

TEST(UsableCloud, LeavesOutPaddingOfSeveralViews)
{
  const Cloud clean = table(), with_padding = padded(clean, {0.0F, 0.0F, 2.0F});
  const Eigen::Isometry3d aside = robotPose();
  Localizer localizer;
  Localization expected, result;
  localizer.localize({{&clean, Eigen::Isometry3d::Identity()}, {&clean, aside}}, expected);
  localizer.localize({{&clean, Eigen::Isometry3d::Identity()}, {&with_padding, aside}}, result);
  expectSame(result, expected, "two views");
  ASSERT_EQ(result.warnings.size(), expected.warnings.size() + 1);
  EXPECT_EQ(result.warnings[0].find("view 2: "), 0U) << result.warnings[0];
  EXPECT_NE(result.warnings[0].find("coincide"), std::string::npos) << result.warnings[0];
}

/// Points all over a box, and some at places of their own, in any order.
Cloud scattered(const std::vector<std::pair<Eigen::Vector3d, std::size_t>>& places)
{
  Random random(9);
  Points points;
  for (int i = 0; i < 5000; ++i) {
    points.push_back(Eigen::Vector3d(0.0, 0.0, 1.0) + random.uniform(0.0, 0.5) * random.direction());
  }
  for (const auto& [place, count] : places) {
    points.insert(points.end(), count, place);
  }
  for (std::size_t i = points.size() - 1; i > 0; --i) {
    std::swap(points[i], points[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(i + 1)))]);
  }
  return cloudOf(points);
}

TEST(Padding, IsAtLeastAHundredPointsAtOnePlace)
{
  Padding padding;
  padding.find(scattered({{{0.1, 0.2, 1.0}, 99}, {{0.0, -0.0, 1.0}, 99}}));
  EXPECT_EQ(padding.places(), 0U);
  EXPECT_TRUE(padding.points().empty());

  const Cloud cloud = scattered({{{0.1, 0.2, 1.0}, 99}, {{0.3, 0.2, 1.0}, 100}, {{0.4, 0.0, 2.0}, 2000}});
  padding.find(cloud);
  EXPECT_EQ(padding.places(), 2U);
  EXPECT_EQ(padding.pointsAtLargestPlace(), 2000U);
  EXPECT_EQ(padding.largestPlace(), Eigen::Vector3f(0.4F, 0.0F, 2.0F));
  EXPECT_EQ(padding.points().size(), 2100U);
  EXPECT_TRUE(std::is_sorted(padding.points().begin(), padding.points().end()));
  for (const std::uint32_t point : padding.points()) {
    const Eigen::Vector3f place = cloud.point(point);
    EXPECT_TRUE(place == Eigen::Vector3f(0.3F, 0.2F, 1.0F) || place == Eigen::Vector3f(0.4F, 0.0F, 2.0F));
  }

  Cloud signs = scattered({{{0.0, 0.2, 1.0}, 100}});  // zeros of both signs are one place
  for (std::size_t i = 0; i < signs.size(); i += 2) {
    signs.x[i] = signs.x[i] == 0.0F ? -0.0F : signs.x[i];
  }
  padding.find(signs);
  EXPECT_EQ(padding.points().size(), 100U);
  padding.find(cloudOf({}));
  EXPECT_EQ(padding.places(), 0U);
}

TEST(UsableCloud, NamesTheLargestOfSeveralPlacesOfPadding)
{
  const Cloud cloud = scattered({{{0.5, 0.25, 1.0}, 700}, {{0.25, 0.0, 2.0}, 200}, {{0.0, 0.0, 3.0}, 150}});
  UsableCloud usable;
  usable.update(cloud);
  EXPECT_EQ(usable.leftOut(), 1050U);
  EXPECT_EQ(measuredPoints(usable.cloud()), 5000U);
  ASSERT_EQ(usable.warnings().size(), 1U);
  EXPECT_EQ(usable.warnings()[0].find("700 points coincide at (0.5, 0.25, 1) m, and 350 points at 2 other places: "),
            0U)
      << usable.warnings()[0];
}

TEST(UsableCloud, OfNothingButPaddingIsNothing)
{
  const Cloud two_places = cloudOf([] {
    Points points(500, Eigen::Vector3d(0.1, 0.0, 1.0));
    points.insert(points.end(), 500, Eigen::Vector3d(0.0, 0.1, 1.0));
    return points;
  }());
  const Localization result = Localizer().localize(two_places);
  EXPECT_EQ(result.points, 0U);
  EXPECT_EQ(result.sampled, 0U);
  EXPECT_EQ(result.nothing_sampled, NothingSampled::points_coincide);
  EXPECT_EQ(result.warnings.size(), 2U);
}

}  // namespace
}  // namespace grasp_affordances::test
