#include "core/cloud/usable_cloud.h"

#include "core/neighborhoods/neighborhoods.h"
#include "core/parallel/thread_team.h"
#include "grasp_affordances/localizer.h"
#include "support/points.h"
#include "support/table.h"
#include "support/usable_clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

constexpr int kWidth = 640, kHeight = 480;

std::size_t measuredNear(const Cloud& cloud, std::size_t pixel)
{
  while (!cloud.measured(pixel)) {
    ++pixel;
  }
  return pixel;
}

/// Changes the depth of some measured points, drawn at random, and so puts most of them off their rays.
void spoilDepths(Cloud& cloud, int draws)
{
  Random random(11);
  for (int i = 0; i < draws; ++i) {
    const auto point = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(cloud.size())));
    cloud.z[point] *= static_cast<float>(random.uniform(0.3, 0.8));
  }
}

/// Replaces each depth by the median of those around it, and x and y stay, as a filter of z does.
Cloud medianFiltered(const Cloud& cloud)
{
  constexpr int kHalf = 2;  // pixels
  Cloud filtered = cloud;
  std::vector<float> depths;
  for (int v = kHalf; v < kHeight - kHalf; ++v) {
    for (int u = kHalf; u < kWidth - kHalf; ++u) {
      const auto at = [&](int column, int row) { return static_cast<std::size_t>(row * kWidth + column); };
      depths.clear();
      for (int row = v - kHalf; row <= v + kHalf; ++row) {
        for (int column = u - kHalf; column <= u + kHalf; ++column) {
          if (cloud.measured(at(column, row))) {
            depths.push_back(cloud.z[at(column, row)]);
          }
        }
      }
      if (cloud.measured(at(u, v))) {
        const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
        std::nth_element(depths.begin(), middle, depths.end());
        filtered.z[at(u, v)] = *middle;
      }
    }
  }
  return filtered;
}

/// Each point where the sensor sees it, at the pixel where a lens with this distortion shows it.
Cloud distorted(const Cloud& cloud, double k1)
{
  Cloud result = cloud;
  const PinholeIntrinsics& camera = *cloud.intrinsics;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector2d shown((static_cast<double>(i % kWidth) - camera.cx) / camera.fx,
                                (static_cast<double>(i / kWidth) - camera.cy) / camera.fy);
    Eigen::Vector2d ray = shown;
    for (int iteration = 0; iteration < 20; ++iteration) {
      ray = shown / (1.0 + k1 * ray.squaredNorm());
    }
    result.set(i, static_cast<float>(ray.x()) * cloud.z[i], static_cast<float>(ray.y()) * cloud.z[i], cloud.z[i]);
  }
  return result;
}

/// The same points, stored column by column.
Cloud byColumns(const Cloud& cloud)
{
  Cloud result = cloud;
  for (std::size_t u = 0; u < kWidth; ++u) {
    for (std::size_t v = 0; v < kHeight; ++v) {
      const std::size_t to = u * kHeight + v, from = v * kWidth + u;
      result.x[to] = cloud.x[from];
      result.y[to] = cloud.y[from];
      result.z[to] = cloud.z[from];
    }
  }
  return result;
}

std::vector<std::uint32_t> indicesOf(const Neighborhood& neighborhood)
{
  return {neighborhood.index(), neighborhood.index() + neighborhood.size()};
}

/// Window and tree agree about the points that are used.
void expectSameNeighborhoods(const UsableCloud& usable, std::size_t beside)
{
  const Cloud& cloud = usable.cloud();
  const auto window = makeWindowSearch(*usable.image(), measuredPoints(cloud)), tree = makeTreeSearch(cloud);
  Neighborhood in_window, in_tree;
  std::vector<std::size_t> places = {measuredNear(cloud, beside)};
  for (std::size_t i = 0; i < cloud.size(); i += 20011) {
    places.push_back(measuredNear(cloud, i));
  }
  for (const std::size_t place : places) {
    window->withinRadius(cloud.point(place), 0.03F, in_window);
    tree->withinRadius(cloud.point(place), 0.03F, in_tree);
    EXPECT_EQ(indicesOf(in_window), indicesOf(in_tree)) << place;
    window->nearest(cloud.point(place), 300, in_window);
    tree->nearest(cloud.point(place), 300, in_tree);
    EXPECT_EQ(indicesOf(in_window), indicesOf(in_tree)) << place;
  }
}

TEST(UsableCloud, IsTheCloudItselfWhereThatIsARangeImage)
{
  for (const Cloud& cloud : {table(), withoutIntrinsics(table())}) {
    UsableCloud usable;
    usable.update(cloud);
    EXPECT_EQ(&usable.cloud(), &cloud);
    EXPECT_EQ(usable.leftOut(), 0U);
    EXPECT_TRUE(usable.warnings().empty());
    std::string warning;
    const auto expected = RangeImage::create(cloud, warning);
    ASSERT_TRUE(expected && usable.image());
    EXPECT_EQ(usable.image()->margin(), expected->margin());
    EXPECT_EQ(usable.image()->intrinsics().fx, expected->intrinsics().fx);
    EXPECT_EQ(usable.image()->intrinsics().cy, expected->intrinsics().cy);
  }
}

struct BadPoint
{
  const char* name;
  void (*spoil)(Cloud& cloud, std::size_t point);
};

constexpr BadPoint kBadPoints[] = {
    {"8 pixels off", [](Cloud& cloud, std::size_t i) { cloud.x[i] += 8.0F * cloud.z[i] / 575.8F; }},
    {"4.1 pixels off", [](Cloud& cloud, std::size_t i) { cloud.y[i] -= 4.1F * cloud.z[i] / 575.8F; }},
    {"behind the sensor", [](Cloud& cloud, std::size_t i) { cloud.z[i] = -cloud.z[i]; }},
    {"beside the sensor", [](Cloud& cloud, std::size_t i) { cloud.z[i] = 1e-5F; }},
    {"at no depth", [](Cloud& cloud, std::size_t i) { cloud.z[i] = 0.0F; }},
    {"far away", [](Cloud& cloud, std::size_t i) { cloud.x[i] = 1e18F; }},
};

TEST(UsableCloud, LeavesOutOneBadPointOfARangeImage)
{
  for (const BadPoint& kind : kBadPoints) {
    for (Cloud cloud : {table(), withoutIntrinsics(table())}) {
      const std::size_t bad = measuredNear(cloud, 240 * kWidth + 320), measured = measuredPoints(cloud);
      kind.spoil(cloud, bad);
      UsableCloud usable;
      usable.update(cloud);
      ASSERT_TRUE(usable.image()) << kind.name << ": " << usable.whyNoImage();
      EXPECT_LT(usable.image()->margin(), 0.1) << kind.name;
      EXPECT_EQ(&usable.image()->cloud(), &usable.cloud());
      EXPECT_EQ(usable.leftOut(), 1U) << kind.name;
      EXPECT_FALSE(usable.cloud().measured(bad)) << kind.name;
      EXPECT_EQ(measuredPoints(usable.cloud()), measured - 1) << kind.name;
      ASSERT_EQ(usable.warnings().size(), 1U) << kind.name;
      EXPECT_EQ(usable.warnings()[0].find("1 of " + std::to_string(measured) + " points"), 0U) << usable.warnings()[0];
      expectSameNeighborhoods(usable, bad);
      EXPECT_TRUE(cloud.measured(bad)) << "the cloud itself stays as it is";
    }
  }
}

/// The result is that of the cloud with NaN in place of the bad points.
TEST(UsableCloud, LosesNoHandleToBadPoints)
{
  const Cloud clean = table();
  Cloud spoiled = clean;
  spoilDepths(spoiled, 320);
  UsableCloud usable;
  usable.update(spoiled);
  ASSERT_TRUE(usable.image()) << usable.whyNoImage();
  EXPECT_GT(usable.leftOut(), 200U);
  Localizer localizer;
  const Localization result = localizer.localize(spoiled);
  EXPECT_EQ(result.points, measuredPoints(clean) - usable.leftOut());
  EXPECT_EQ(result.handles.size(), localizer.localize(clean).handles.size());
  expectSame(result, localizer.localize(usable.cloud()), "as without the bad points");
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_EQ(result.warnings[0].find(std::to_string(usable.leftOut()) + " of "), 0U) << result.warnings[0];
  EXPECT_NE(result.warnings[0].find("left out"), std::string::npos) << result.warnings[0];
}

TEST(UsableCloud, TakesAFilterOfDepthsForARangeImage)
{
  for (const Cloud& cloud : {medianFiltered(table()), withoutIntrinsics(medianFiltered(table()))}) {
    UsableCloud usable;
    usable.update(cloud);
    ASSERT_TRUE(usable.image()) << usable.whyNoImage();
    EXPECT_GT(usable.leftOut(), 0U);
    expectSameNeighborhoods(usable, 0);
  }
}

TEST(UsableCloud, IsTheSameForAnyTeam)
{
  Cloud cloud = withoutIntrinsics(padded(table(), {0.1F, 0.2F, 0.3F}));
  spoilDepths(cloud, 100);
  ThreadTeam three(3);
  UsableCloud alone, shared;
  alone.update(cloud);
  shared.update(cloud, &three);
  ASSERT_TRUE(alone.image() && shared.image()) << alone.whyNoImage();
  EXPECT_EQ(alone.leftOut(), shared.leftOut());
  EXPECT_EQ(alone.warnings(), shared.warnings());
  EXPECT_EQ(alone.image()->margin(), shared.image()->margin());
  EXPECT_EQ(alone.image()->intrinsics().fx, shared.image()->intrinsics().fx);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ASSERT_EQ(alone.cloud().measured(i), shared.cloud().measured(i)) << i;
  }
}

TEST(UsableCloud, TellsWhyThereIsNoRangeImage)
{
  const Cloud cloud = table();
  Cloud behind = cloud, spoiled = cloud, elsewhere = cloud, narrow = byColumns(cloud);
  std::swap(narrow.width, narrow.height);
  spoilDepths(spoiled, 9000);
  Random random(5);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    behind.z[i] = -cloud.z[i];
    const double x = random.uniform(-1.0, 1.0), y = random.uniform(-1.0, 1.0);
    elsewhere.set(i, static_cast<float>(x), static_cast<float>(y), static_cast<float>(random.uniform(0.5, 2.0)));
  }
  const Eigen::Isometry3d aside(Eigen::Translation3d(0.02, 0.0, 0.0));
  const Eigen::Isometry3d turned(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()));
  const std::pair<Cloud, std::string> cases[] = {{moved(cloud, robotPose()), "moved out of its optical frame"},
                                                 {moved(cloud, aside), "moved out of its optical frame"},
                                                 {moved(cloud, turned), "moved out of its optical frame"},
                                                 {behind, "moved out of its optical frame"},
                                                 {distorted(cloud, -0.2), "lens distortion"},
                                                 {distorted(cloud, 0.3), "lens distortion"},
                                                 {byColumns(cloud), "columns are stored one after the other"},
                                                 {narrow, "columns are stored one after the other"},
                                                 {spoiled, "too many of them"},
                                                 {elsewhere, "no camera measured it"}};
  for (const auto& [with_intrinsics, reason] : cases) {
    for (const Cloud& unusable : {with_intrinsics, withoutIntrinsics(with_intrinsics)}) {
      UsableCloud usable;
      usable.update(unusable);
      EXPECT_FALSE(usable.image()) << reason;
      EXPECT_NE(usable.whyNoImage().find(reason), std::string::npos) << reason << ": " << usable.whyNoImage();
      EXPECT_EQ(&usable.cloud(), &unusable) << reason;
      EXPECT_TRUE(usable.warnings().empty()) << reason;
    }
  }
}

/// A little of a lens puts points in the corners of the image off. They are left out, for the right reason.
TEST(UsableCloud, NamesTheLensWhereOnlyCornersAreOff)
{
  const Cloud cloud = distorted(table(), -0.055);
  UsableCloud usable;
  usable.update(cloud);
  ASSERT_TRUE(usable.image()) << usable.whyNoImage();
  ASSERT_GT(usable.leftOut(), 500U);
  EXPECT_NE(usable.warnings().back().find("lens distortion"), std::string::npos) << usable.warnings().back();
}

/// Before a far wall a shift moves hardly any point off its pixel, but for those of what stands near: the very thing to
/// grasp. It must not be taken for bad points.
TEST(UsableCloud, KeepsWhatStandsNearInACloudThatWasMovedALittle)
{
  Cloud cloud;
  cloud.reset(kWidth, kHeight);
  cloud.intrinsics = PinholeIntrinsics{575.8, 575.8, 319.5, 239.5};
  Random random(3);
  std::size_t near = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const bool is_near = std::abs(u - 300) < 22 && std::abs(v - 200) < 28;
      const double depth = (is_near ? 0.8 : 3.0) + 0.002 * random.normal();
      near += is_near ? 1 : 0;
      cloud.set(static_cast<std::size_t>(v * kWidth + u), static_cast<float>((u - 319.5) / 575.8 * depth),
                static_cast<float>((v - 239.5) / 575.8 * depth), static_cast<float>(depth));
    }
  }
  ASSERT_LT(static_cast<double>(near), UsableCloud::kMostStrays * kWidth * kHeight);
  const Cloud shifted = moved(cloud, Eigen::Isometry3d(Eigen::Translation3d(0.015, 0.0, 0.0)));
  UsableCloud usable;
  usable.update(cloud);
  EXPECT_TRUE(usable.image());
  usable.update(shifted);
  EXPECT_FALSE(usable.image());
  EXPECT_EQ(usable.leftOut(), 0U);
  EXPECT_NE(usable.whyNoImage().find("moved out of its optical frame"), std::string::npos) << usable.whyNoImage();
}

bool isWarned(const Cloud& cloud, const std::string& part)
{
  const Localization result = Localizer().localize(cloud);
  return std::any_of(result.warnings.begin(), result.warnings.end(),
                     [&](const std::string& warning) { return warning.find(part) != std::string::npos; });
}

TEST(Localizer, SuspectsMillimetres)
{
  const auto isSuspected = [](const Cloud& cloud) { return isWarned(cloud, "are they in millimetres?"); };
  Cloud cloud = table();
  EXPECT_FALSE(isSuspected(cloud));
  for (std::vector<float>* coordinates : {&cloud.x, &cloud.y, &cloud.z}) {
    for (float& value : *coordinates) {
      value *= 1000.0F;
    }
  }
  EXPECT_TRUE(isSuspected(cloud));
  Cloud points = unorganized(cloud);
  EXPECT_TRUE(isSuspected(points));
  points.sensor_origin.reset();
  EXPECT_TRUE(isSuspected(points));
  // A wall far away behind a near object, which is a quarter of the points, is no reason.
  for (std::size_t i = 0; i < cloud.size(); i += 4) {
    cloud.set(i, cloud.x[i] / 1000.0F, cloud.y[i] / 1000.0F, cloud.z[i] / 1000.0F);
  }
  EXPECT_FALSE(isSuspected(cloud));
}

/// Far from the origin of a map is not far from the sensor, nor from one another.
TEST(Localizer, SuspectsNoUnitOfACloudInTheFrameOfAMap)
{
  Cloud cloud = moved(unorganized(table()), Eigen::Isometry3d(Eigen::Translation3d(4000.0, 3000.0, 0.0)));
  EXPECT_FALSE(isWarned(cloud, "millimetres?"));
  cloud.sensor_origin.reset();
  EXPECT_FALSE(isWarned(cloud, "millimetres?"));
}

TEST(Localizer, WarnsWhereSinglePrecisionIsTooCoarseForTheHand)
{
  const auto at = [](double x) {
    return moved(unorganized(table()), Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0)));
  };
  EXPECT_FALSE(isWarned(table(), "single precision"));
  EXPECT_FALSE(isWarned(at(5000.0), "single precision"));
  EXPECT_TRUE(isWarned(at(500000.0), "steps of 31.2 mm in single precision"));
}

}  // namespace
}  // namespace grasp_affordances::test
