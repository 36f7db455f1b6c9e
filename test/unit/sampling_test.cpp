#include "grasp_affordances/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>
#include <string>

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

TEST(SamplePoint, SpreadsEvenlyOverTheCandidates)
{
  std::vector<std::uint32_t> measured(1000), candidates;
  std::iota(measured.begin(), measured.end(), 0U);
  for (std::uint32_t i = 0; i < 1000; i += 2) {
    candidates.push_back(i);
  }
  SamplingConfig config;
  config.samples = 100;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const std::uint32_t point = samplePoint(measured, candidates, config, i);
    EXPECT_EQ(point % 2, 0U);
    EXPECT_EQ(point / 10, i) << "the i-th of equal parts";
  }
}

TEST(SamplePoint, DrawsEachOfFewCandidatesOnceAndTheRestAnywhere)
{
  std::vector<std::uint32_t> measured(1000);
  std::iota(measured.begin(), measured.end(), 0U);
  const std::vector<std::uint32_t> candidates = {7, 300, 42};
  SamplingConfig config;
  config.samples = 500;
  std::set<std::uint32_t> others;
  for (std::uint64_t i = 0; i < 500; ++i) {
    const std::uint32_t point = samplePoint(measured, candidates, config, i);
    if (i < 3) {
      EXPECT_EQ(point, candidates[i]);
    } else {
      others.insert(point);
    }
  }
  // Of 497 draws from 1000, 392 are different on average, with a standard deviation of about 9.
  EXPECT_NEAR(static_cast<double>(others.size()), 392.0, 45.0);
}

TEST(SamplePoint, DependsOnTheSeed)
{
  std::vector<std::uint32_t> measured(1000);
  std::iota(measured.begin(), measured.end(), 0U);
  SamplingConfig one, other;
  other.seed = 2;
  int equal = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    EXPECT_EQ(samplePoint(measured, {}, one, i), samplePoint(measured, {}, one, i));
    equal += samplePoint(measured, {}, one, i) == samplePoint(measured, {}, other, i) ? 1 : 0;
  }
  EXPECT_LT(equal, 10);
}

}  // namespace
}  // namespace grasp_affordances::test
