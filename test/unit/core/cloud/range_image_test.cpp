#include "core/cloud/range_image.h"

#include "core/parallel/thread_team.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>

namespace grasp_affordances::test
{
namespace
{

TEST(RangeImage, EstimatesTheIntrinsics)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  ASSERT_TRUE(cloud.intrinsics);
  const auto fit = estimateIntrinsics(cloud);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->intrinsics.fx, cloud.intrinsics->fx, 1e-2);
  EXPECT_NEAR(fit->intrinsics.fy, cloud.intrinsics->fy, 1e-2);
  EXPECT_NEAR(fit->intrinsics.cx, cloud.intrinsics->cx, 1e-2);
  EXPECT_NEAR(fit->intrinsics.cy, cloud.intrinsics->cy, 1e-2);
  EXPECT_LT(fit->max_residual, 1e-2);
}

TEST(RangeImage, IsTheSameForAnyTeam)
{
  Cloud cloud = captureScene("table", 1).cloud;
  cloud.intrinsics.reset();
  ThreadTeam three(3);
  const auto alone = estimateIntrinsics(cloud), shared = estimateIntrinsics(cloud, &three);
  ASSERT_TRUE(alone && shared);
  EXPECT_EQ(alone->intrinsics.fx, shared->intrinsics.fx);
  EXPECT_EQ(alone->intrinsics.fy, shared->intrinsics.fy);
  EXPECT_EQ(alone->intrinsics.cx, shared->intrinsics.cx);
  EXPECT_EQ(alone->intrinsics.cy, shared->intrinsics.cy);
  EXPECT_EQ(alone->max_residual, shared->max_residual);
  cloud.z.back() = -1.0F;
  EXPECT_FALSE(estimateIntrinsics(cloud, &three));
  EXPECT_FALSE(checkIntrinsics(cloud, alone->intrinsics, &three));
}

TEST(RangeImage, ReplacesIntrinsicsThatDoNotFit)
{
  Cloud cloud = captureScene("table", 1).cloud;
  cloud.intrinsics->fx *= 1.1;
  std::string warning;
  const auto image = RangeImage::create(cloud, warning);
  ASSERT_TRUE(image);
  EXPECT_NE(warning.find("estimated"), std::string::npos) << warning;
  EXPECT_NEAR(image->intrinsics().fx, SensorModel().intrinsics.fx, 1e-2);
}

TEST(RangeImage, ReplacesIntrinsicsThatAreNotFinite)
{
  Cloud cloud = captureScene("table", 1).cloud;
  cloud.intrinsics->cx = std::nan("");
  std::string warning;
  const auto image = RangeImage::create(cloud, warning);
  ASSERT_TRUE(image);
  EXPECT_NE(warning.find("estimated"), std::string::npos) << warning;
  EXPECT_NEAR(image->intrinsics().cx, SensorModel().intrinsics.cx, 1e-2);
}

TEST(RangeImage, RefusesACloudThatWasMoved)
{
  Cloud cloud = captureScene("table", 1).cloud;
  const Eigen::Matrix3f rotation = Eigen::AngleAxisf(0.5F, Eigen::Vector3f::UnitX()).toRotationMatrix();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f p = rotation * cloud.point(i) + Eigen::Vector3f(0.1F, 0.0F, 0.5F);
    cloud.set(i, p.x(), p.y(), p.z());
  }
  std::string warning;
  EXPECT_FALSE(RangeImage::create(cloud, warning));
  EXPECT_NE(warning.find("optical frame"), std::string::npos) << warning;
}

TEST(RangeImage, RefusesPointsBehindTheSensor)
{
  Cloud cloud = captureScene("table", 1).cloud;
  for (float& z : cloud.z) {
    z = -z;
  }
  std::string warning;
  EXPECT_FALSE(RangeImage::create(cloud, warning));
  EXPECT_FALSE(warning.empty());
}

TEST(RangeImage, FindsThePixelOfAPoint)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  std::string warning;
  const auto image = RangeImage::create(cloud, warning);
  ASSERT_TRUE(image);
  for (std::size_t i = 0; i < cloud.size(); i += 997) {
    if (cloud.measured(i)) {
      EXPECT_EQ(image->pixel(cloud.point(i).cast<double>()), i);
    }
  }
  EXPECT_FALSE(image->pixel({0, 0, -1}));
  EXPECT_FALSE(image->pixel({10, 0, 1}));
  EXPECT_NEAR(image->spacing(1.05), 1.05 / SensorModel().intrinsics.fx, 1e-6);
}

}  // namespace
}  // namespace grasp_affordances::test
