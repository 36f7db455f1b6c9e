#include "core/neighborhoods/occlusion.h"

#include "core/neighborhoods/window_search.h"
#include "core/shell/free_space.h"
#include "support/points.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <string>

namespace grasp_affordances::test
{
namespace
{

constexpr double kFocalLength = 525.0;

/// A range image of what `depth(x/z, y/z)` says, 320 x 240, optical frame; NaN stays unmeasured.
template <typename Depth>
Cloud renderDepth(Depth&& depth)
{
  Cloud cloud;
  cloud.reset(320, 240);
  for (std::uint32_t v = 0, i = 0; v < cloud.height; ++v) {
    for (std::uint32_t u = 0; u < cloud.width; ++u, ++i) {
      const double sx = (u - 159.5) / kFocalLength, sy = (v - 119.5) / kFocalLength;
      const double z = depth(sx, sy);
      cloud.set(i, static_cast<float>(sx * z), static_cast<float>(sy * z), static_cast<float>(z));
    }
  }
  cloud.intrinsics = PinholeIntrinsics{kFocalLength, kFocalLength, 159.5, 119.5};
  return cloud;
}

bool occludedAt(const Cloud& cloud, const Eigen::Vector3d& point, std::size_t max_in_front, double min_distance)
{
  std::string warning;
  const auto image = RangeImage::create(cloud, warning);
  const auto pixel = image->pixel(point);
  const Neighborhood neighborhood = bruteForceNeighborhood(cloud, cloud.point(*pixel), 0.026F);
  return occluded(*image, neighborhood, max_in_front, min_distance);
}

TEST(Occlusion, IsSomethingNearerWithinTheProjectedSphere)
{
  // A wall at 1.2 m; in front of it, at 0.8 m, everything to the right of x/z = 0.05.
  const Cloud cloud = renderDepth([](double sx, double) { return sx > 0.05 ? 0.8 : 1.2; });
  // The sphere's silhouette reaches 0.026 / 1.2 = 0.0217 to either side.
  EXPECT_TRUE(occludedAt(cloud, {0.04 * 1.2, 0, 1.2}, 20, 0.0));
  EXPECT_FALSE(occludedAt(cloud, {0.025 * 1.2, 0, 1.2}, 20, 0.0));
  EXPECT_FALSE(occludedAt(cloud, {0.09 * 0.8, 0, 0.8}, 20, 0.0)) << "the foreground itself";
}

TEST(Occlusion, NeedsMoreThanTheAllowedPoints)
{
  // A speck of 5 x 4 pixels in front.
  const auto speck = [](double sx, double sy) {
    return std::abs(sx - 0.5 / kFocalLength) < 2.2 / kFocalLength && std::abs(sy) < 1.8 / kFocalLength ? 0.8 : 1.2;
  };
  const Cloud cloud = renderDepth(speck);
  EXPECT_FALSE(occludedAt(cloud, {0.02, 0, 1.2}, 20, 0.0));
  EXPECT_TRUE(occludedAt(cloud, {0.02, 0, 1.2}, 19, 0.0));
}

TEST(Occlusion, IsNeverThatOfANeighborhoodByItself)
{
  for (int i = 0; i < 100; ++i) {
    // A small ball, all of it in the neighborhood, somewhere in the picture.
    const double x = -0.1 + 0.002 * i, z = 0.7 + 0.003 * i, r = 0.01;
    const Cloud cloud = renderDepth([&](double sx, double sy) {
      const double a = sx * sx + sy * sy + 1, b = sx * x + z, c = x * x + z * z - r * r;
      const double discriminant = b * b - a * c;
      return discriminant < 0 ? std::nan("") : (b - std::sqrt(discriminant)) / a;
    });
    EXPECT_FALSE(occludedAt(cloud, {x, 0, z}, 0, 0.0)) << i;
  }
}

TEST(Occlusion, OfASlopingPlaneByItselfDependsOnTheDistanceAsked)
{
  // A plane that slopes by 50 degrees: z = 1 + x tan(50), seen along rays x = s z.
  const double slope = std::tan(50 * M_PI / 180);
  const Cloud cloud = renderDepth([&](double sx, double) { return 1.0 / (1.0 - slope * sx); });
  EXPECT_TRUE(occludedAt(cloud, {0, 0, 1}, 20, 0.0)) << "the paper's filter";
  EXPECT_FALSE(occludedAt(cloud, {0, 0, 1}, 20, 0.05));
}

TEST(Occlusion, SeesTheShadowsBetweenForegroundObjects)
{
  for (const char* name : {"shadow", "shadow_removed"}) {
    const Cloud cloud = captureStrip(name, 1).cloud;
    std::string warning;
    const auto image = RangeImage::create(cloud, warning);
    ASSERT_TRUE(image) << warning;
    int judged = 0, rejected = 0;
    for (std::size_t i = 0; i < cloud.size(); i += 37) {
      if (cloud.measured(i) && cloud.z[i] > 1.0F) {
        const Neighborhood neighborhood = bruteForceNeighborhood(cloud, cloud.point(i), 0.026F);
        ++judged;
        rejected += occluded(*image, neighborhood, 20, 0.0) ? 1 : 0;
      }
    }
    ASSERT_GT(judged, 20) << name;
    EXPECT_EQ(rejected, std::string(name) == "shadow" ? judged : 0) << name;
  }
}

ShellSearchResult shellAt(const Eigen::Vector3d& centroid)
{
  ShellSearchResult shell;
  shell.status = ShellSearchResult::found;
  shell.centroid = centroid;
  shell.inner_radius = 0.012;
  shell.length = 0.03;
  return shell;
}

double freeShareAt(const Cloud& cloud, const Eigen::Vector3d& centroid)
{
  std::string warning;
  const auto image = RangeImage::create(cloud, warning);
  return observedFreeShare(*image, shellAt(centroid), Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitZ(), 0.008);
}

TEST(OcclusionFilter, SaysTheSameBeforeTheNeighborhoodIsGathered)
{
  const Cloud cloud = captureScene("cleaning2", 1).cloud;
  std::string warning;
  const auto image = RangeImage::create(cloud, warning);
  const WindowSearch search(*image, cloud.size());
  int hidden = 0, visible = 0;
  for (std::uint64_t draw = 0; draw < 600; ++draw) {
    const std::uint32_t point = randomIndex(randomBits(1, draw), static_cast<std::uint32_t>(cloud.size()));
    if (!cloud.measured(point)) {
      continue;
    }
    for (const double min_distance : {0.0, 0.01, 0.05}) {
      Neighborhood neighborhood;
      const SphereView gathered = search.gather(cloud.point(point), 0.026F, false, neighborhood);
      const bool expected = occluded(*image, neighborhood, 20, min_distance);
      (expected ? hidden : visible) += 1;
      EXPECT_EQ(occluded(*image, gathered, 20, min_distance), expected) << point << ", " << min_distance;
      EXPECT_EQ(occluded(*image, search.look(cloud.point(point), 0.026F), 20, min_distance), expected)
          << point << ", " << min_distance;
    }
  }
  EXPECT_GT(hidden, 100);
  EXPECT_GT(visible, 100);
}

TEST(ObservedFreeSpace, IsWhatTheSensorSawThrough)
{
  const Cloud wall = renderDepth([](double, double) { return 1.0; });
  EXPECT_DOUBLE_EQ(freeShareAt(wall, {0, 0, 0.7}), 1.0);
  EXPECT_DOUBLE_EQ(freeShareAt(wall, {0, 0, 1.3}), 0.0);
  EXPECT_NEAR(freeShareAt(wall, {0, 0, 1.0}), 0.5, 0.05);
  EXPECT_DOUBLE_EQ(freeShareAt(wall, {5, 0, 0.7}), 0.0) << "outside the image";
  const Cloud nothing = renderDepth([](double sx, double sy) { return sx > 0.25 && sy > 0.1 ? 1.0 : std::nan(""); });
  Cloud unmeasured = nothing;
  unmeasured.set(0, static_cast<float>(-159.5 / kFocalLength), static_cast<float>(-119.5 / kFocalLength), 1.0F);
  EXPECT_DOUBLE_EQ(freeShareAt(unmeasured, {0, 0, 0.7}), 0.0) << "not measured is not free";
}

TEST(ObservedFreeSpace, OfAFreeStandingBarIsAboveOneHalf)
{
  // A bar of radius 1.2 cm along y at 0.7 m, and a wall far behind it.
  const Cloud cloud = renderDepth([](double sx, double) {
    const double a = 1 + sx * sx, b = 0.7, c = 0.7 * 0.7 - 0.012 * 0.012;
    const double discriminant = b * b - a * c;
    return discriminant < 0 ? 2.0 : (b - std::sqrt(discriminant)) / a;
  });
  const double share = freeShareAt(cloud, {0, 0, 0.7});
  EXPECT_GT(share, 0.5);
  EXPECT_LT(share, 0.8);
}

}  // namespace
}  // namespace grasp_affordances::test
