#include "core/views/point_screen.h"

#include "core/parallel/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

constexpr std::uint32_t kWidth = 320, kHeight = 240;
const PinholeIntrinsics kCamera{280.0, 280.0, 159.5, 119.5};
const HandGeometry kHand{0.026, 0.008};

Cloud imageOf(const std::function<double(double slope_x, double slope_y)>& depth)
{
  Cloud cloud;
  cloud.reset(kWidth, kHeight);
  cloud.intrinsics = kCamera;
  for (std::uint32_t v = 0; v < kHeight; ++v) {
    for (std::uint32_t u = 0; u < kWidth; ++u) {
      const double x = (u - kCamera.cx) / kCamera.fx, y = (v - kCamera.cy) / kCamera.fy, z = depth(x, y);
      cloud.set(v * kWidth + u, static_cast<float>(x * z), static_cast<float>(y * z), static_cast<float>(z));
    }
  }
  return cloud;
}

std::size_t screened(const Cloud& cloud)
{
  std::string warning;
  return screenPoints(*RangeImage::create(cloud, warning), kHand, cloud.size(), 1).size();
}

/// A bar of some width, `distance` before a wall at 1 m, upright or leaning.
Cloud barBeforeWall(double width, double distance, double lean)
{
  return imageOf([=](double x, double y) {
    const double z = 1.0 - distance;
    const bool on_bar = std::abs((x * z) * std::cos(lean) + (y * z) * std::sin(lean)) < width / 2 && std::abs(y) < 0.3;
    return on_bar ? z : 1.0;
  });
}

TEST(Screen, KeepsWhatAHandCanReachAround)
{
  for (const double lean : {0.0, 0.4, 0.8, 1.2, M_PI / 2}) {
    for (const double width : {0.012, 0.03, 0.048}) {
      const Cloud cloud = barBeforeWall(width, 0.03, lean);
      std::string warning;
      const auto image = RangeImage::create(cloud, warning);
      std::size_t kept = 0, on_bar = 0;
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        if (std::abs(cloud.y[i]) < 0.15F && std::abs(cloud.x[i]) < 0.15F && cloud.z[i] < 0.98F) {
          ++on_bar;
          kept += fallsAwayOnBothSides(*image, i, kHand) ? 1 : 0;
        }
      }
      ASSERT_GT(on_bar, 100U);
      // Of the widest, seen across its corners by the nearest of four directions, some is lost.
      const double least = width < 0.04 ? 1.0 : 0.9;
      EXPECT_GE(static_cast<double>(kept), least * static_cast<double>(on_bar)) << lean << ", " << width;
    }
  }
}

TEST(Screen, DropsPlanesHollowsAndWhatIsTooWide)
{
  EXPECT_EQ(screened(imageOf([](double, double) { return 1.0; })), 0U);
  EXPECT_EQ(screened(imageOf([](double, double y) { return 1.0 / (0.9 + 0.8 * y); })), 0U);  // a table
  EXPECT_EQ(screened(imageOf([](double x, double) { return 1.0 - std::abs(x); })), 0U);      // an inside corner
  EXPECT_EQ(screened(imageOf([](double x, double) { return std::abs(x) < 0.036 ? 0.97 : 1.0; })), 0U);  // 7 cm wide
  EXPECT_EQ(screened(barBeforeWall(0.02, 0.005, 0.0)), 0U);  // too close to the wall for a finger
}

TEST(Screen, CountsWhatIsNotMeasuredAsFallenAway)
{
  const Cloud cloud = imageOf([](double x, double) { return std::abs(x) < 0.02 ? 1.0 : std::nan(""); });
  std::string warning;
  EXPECT_TRUE(fallsAwayOnBothSides(*RangeImage::create(cloud, warning), 120 * kWidth + 160, kHand));
}

TEST(Screen, StopsWhereThereAreEnoughAndSpreadsThemEvenly)
{
  const Cloud cloud = barBeforeWall(0.04, 0.03, 0.0);
  std::string warning;
  const auto image = RangeImage::create(cloud, warning);
  const auto all = screenPoints(*image, kHand, cloud.size(), 1);
  const auto some = screenPoints(*image, kHand, all.size() / 4, 1);
  EXPECT_GE(some.size(), all.size() / 4);
  EXPECT_LT(some.size(), all.size() / 2);
  const auto upperHalf = [](const std::vector<std::uint32_t>& points) {
    return std::count_if(points.begin(), points.end(), [](std::uint32_t i) { return i / kWidth < kHeight / 2; });
  };
  EXPECT_NEAR(static_cast<double>(upperHalf(some)) / some.size(), static_cast<double>(upperHalf(all)) / all.size(),
              0.05);
  EXPECT_NE(screenPoints(*image, kHand, all.size() / 4, 2), some) << "another seed, other points";
  EXPECT_EQ(std::set<std::uint32_t>(all.begin(), all.end()).size(), all.size());
}

/// Bars and boards at random before a wall, with pixels that were not measured.
Cloud clutter(std::uint64_t seed)
{
  const auto draw = [seed](std::uint64_t i, std::uint64_t stream) {
    return static_cast<double>(randomBits(seed, i, stream) >> 11U) * 0x1p-53;
  };
  std::uint64_t pixel = 0;
  return imageOf([&](double x, double y) {
    double z = 1.2 + 0.3 * x;
    for (std::uint64_t bar = 0; bar < 10; ++bar) {
      const double lean = M_PI * draw(bar, 0), offset = draw(bar, 1) - 0.5, width = 0.01 + 0.05 * draw(bar, 2);
      const bool on_bar = std::abs(x * std::cos(lean) + y * std::sin(lean) - offset) < width / 2;
      z = on_bar ? std::min(z, 0.3 + draw(bar, 3)) : z;
    }
    return draw(pixel++, 4) < 0.02 ? std::nan("") : z;
  });
}

/// The definition: looks at every pitch, in one of eight directions. @return distance in pixels, or empty
std::optional<float> plainDistanceToEdge(const Cloud& cloud, std::size_t pixel, double spacing, float du, float dv,
                                         float farthest)
{
  const float gap = 0.75F * static_cast<float>(kHand.finger_thickness) / static_cast<float>(spacing);
  const float pitch = std::max(1.0F, 0.5F * gap);
  const std::size_t column = pixel % cloud.width, row = pixel / cloud.width;
  std::optional<float> edge;
  for (float s = pitch; s <= farthest + gap + pitch; s += pitch) {
    const float u = std::floor(static_cast<float>(column) + s * du + 0.5F);
    const float v = std::floor(static_cast<float>(row) + s * dv + 0.5F);
    if (u < 0.0F || v < 0.0F || u >= kWidth || v >= kHeight) {
      return std::nullopt;
    }
    const float z = cloud.z[static_cast<std::size_t>(v) * kWidth + static_cast<std::size_t>(u)];
    if (z <= cloud.z[pixel] + static_cast<float>(kHand.finger_thickness)) {
      edge.reset();
      continue;
    }
    edge = edge ? edge : s - pitch;
    if (s - *edge >= gap) {
      return edge;
    }
  }
  return std::nullopt;
}

bool plainFallsAway(const RangeImage& image, std::size_t pixel)
{
  const Cloud& cloud = image.cloud();
  const double spacing = image.spacing(cloud.z[pixel]);
  const float span = 2.0F * static_cast<float>(kHand.capture_radius) / static_cast<float>(spacing) + 2.0F;
  constexpr float kDiagonal = 0.70710678F;
  for (const auto& [du, dv] : {std::pair(1.0F, 0.0F), std::pair(kDiagonal, kDiagonal), std::pair(0.0F, 1.0F),
                               std::pair(-kDiagonal, kDiagonal)}) {
    const auto ahead = plainDistanceToEdge(cloud, pixel, spacing, du, dv, span);
    if (!ahead || *ahead > span) {
      continue;
    }
    const auto behind = plainDistanceToEdge(cloud, pixel, spacing, -du, -dv, span - *ahead);
    if (behind && *behind <= span - *ahead) {
      return true;
    }
  }
  return false;
}

TEST(Screen, KeepsThePointsOfTheDefinition)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Cloud cloud = clutter(seed);
    std::string warning;
    const auto image = RangeImage::create(cloud, warning);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t v = 0; v < kHeight; v += 2) {
      for (std::uint32_t u = 0; u < kWidth; u += 2) {
        if (cloud.measured(v * kWidth + u) && plainFallsAway(*image, v * kWidth + u)) {
          expected.push_back(v * kWidth + u);
        }
      }
    }
    ASSERT_GT(expected.size(), 1000U) << "seed " << seed;
    auto kept = screenPoints(*image, kHand, cloud.size(), 1);
    std::sort(kept.begin(), kept.end());
    EXPECT_EQ(kept, expected) << "seed " << seed;
  }
}

TEST(Screen, DoesNotDependOnThreadsNorOnTheImageBefore)
{
  std::string warning;
  for (const int threads : {1, 2, 5}) {
    ThreadTeam team(threads);
    PointScreen screen;
    for (const std::uint64_t seed : {1, 2, 3}) {
      const Cloud cloud = clutter(seed);
      const auto image = RangeImage::create(cloud, warning);
      const auto all = screenPoints(*image, kHand, cloud.size(), 1);
      for (const std::size_t enough : {std::size_t{0}, std::size_t{1}, all.size() / 3, all.size()}) {
        screen.update(*image, kHand, enough, 1, team);
        const auto& some = screen.points();
        ASSERT_GE(some.size(), enough);
        EXPECT_EQ(some, screenPoints(*image, kHand, enough, 1)) << threads << " threads, " << enough << " points";
        EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin())) << "the first of all";
      }
    }
  }
}

}  // namespace
}  // namespace grasp_affordances::test
