#include "grasp_affordances/localizer.h"
#include "grasp_affordances/point_cloud2.h"
#include "support/allocations.h"
#include "support/points.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

// What a sender may ask for is bounded before anything is allocated for it.
namespace grasp_affordances::test
{
namespace
{

/// Three coordinates at the same place: the smallest points that there are.
PointCloud2Layout layoutOf(std::uint32_t width, std::uint32_t height)
{
  PointCloud2Layout layout;
  layout.width = width;
  layout.height = height;
  layout.point_step = sizeof(float);
  layout.row_step = width * layout.point_step;
  layout.x = layout.y = layout.z = {true, 7, 1, 0};
  layout.data_size = std::size_t{height} * layout.row_step;
  return layout;
}

std::string refusal(const PointCloud2Layout& layout)
{
  Cloud cloud;
  largest_allocation = 0;
  try {
    cloudFromLayout(layout, cloud);
  } catch (const CloudError& error) {
    EXPECT_LT(largest_allocation, 1000U);
    return error.what();
  }
  return "";
}

TEST(Limits, MorePointsThanAllowedAreRefusedBeforeTheyAreAllocated)
{
  EXPECT_EQ(refusal(layoutOf(kMostPoints + 1, 1)),
            "the cloud has 16777217 points, more than the 16777216 that are allowed");
  EXPECT_NE(refusal(layoutOf(1, 250000000)).find("250000000 points"), std::string::npos);
  EXPECT_NE(refusal(layoutOf(1U << 14U, 1U << 16U)).find("1073741824 points"), std::string::npos);
}

TEST(Limits, AsManyPointsAsAllowedAreRead)
{
  const PointCloud2Layout layout = layoutOf(kMostPoints, 1);
  const std::vector<std::uint8_t> data(layout.data_size, 0);
  PointCloud2Layout with_data = layout;
  with_data.data = data.data();
  Cloud cloud;
  cloudFromLayout(with_data, cloud);
  EXPECT_EQ(cloud.size(), kMostPoints);
}

/// Each thread has working memory for whole rows and columns of an image.
TEST(Limits, TheSideOfAnImageDoesNotDecideOnMemory)
{
  constexpr std::uint32_t kRows = 400000;
  Cloud cloud;
  cloud.sensor_origin = Eigen::Vector3f::Zero();
  cloud.reset(2, kRows);
  cloud.intrinsics = PinholeIntrinsics{1000.0, kRows, 0.5, kRows / 2.0};
  for (std::uint32_t v = 0; v < kRows; ++v) {
    for (std::uint32_t u = 0; u < 2; ++u) {
      cloud.set(2 * v + u, static_cast<float>((u - cloud.intrinsics->cx) / cloud.intrinsics->fx),
                static_cast<float>((v - cloud.intrinsics->cy) / cloud.intrinsics->fy), 1.0F);
    }
  }
  Config config;
  config.threads = 1;
  config.sampling.samples = 3;
  largest_allocation = 0;
  const Localization result = Localizer(config).localize(cloud);
  EXPECT_LT(largest_allocation, 100 * cloud.size());
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_EQ(result.warnings[0].find("the organized cloud of 2x400000 points is no image: a side is longer than 16384"),
            0U)
      << result.warnings[0];
  EXPECT_EQ(result.sampled, 3U);
}

/// The time for a sample grows with its neighborhood. A budget is looked at for each of them, not only where a block of
/// 64 begins.
TEST(Limits, ABudgetEndsTheWorkOnAFewHugeNeighborhoods)
{
  Random random(1);
  Points points;
  for (int i = 0; i < 30000; ++i) {
    points.push_back(Eigen::Vector3d(0.0, 0.0, 1.0) + 0.01 * random.uniform(0.0, 1.0) * random.direction());
  }
  const Cloud cloud = cloudOf(points);
  Config config;
  config.threads = 1;
  config.sampling.samples = 64;
  config.sampling.importance = false;
  Localizer localizer(config);
  const Localization whole = localizer.localize(cloud);
  const auto out_of_time = static_cast<std::size_t>(Outcome::out_of_time);
  ASSERT_EQ(whole.counts[out_of_time], 0U);
  // Preparation may take as long as the whole, on a machine that is busy with other things: then all samples are left
  // out.
  std::uint32_t left_out = 0;
  for (int attempt = 0; attempt < 5 && (left_out == 0 || left_out == 64); ++attempt) {
    left_out = 0;
    for (double budget = whole.milliseconds.total; left_out == 0; budget *= 0.9) {
      config.sampling.time_budget_ms = budget;
      localizer.configure(config);
      left_out = localizer.localize(cloud).counts[out_of_time];
    }
  }
  EXPECT_LT(left_out, 64U);
}

}  // namespace
}  // namespace grasp_affordances::test
