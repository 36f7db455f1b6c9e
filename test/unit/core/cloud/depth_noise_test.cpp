#include "core/cloud/depth_noise.h"

#include "simulation/sensor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace grasp_affordances::test
{
namespace
{

TEST(DepthNoise, GrowsWithTheSquareOfDepthFromAConstantPart)
{
  EXPECT_DOUBLE_EQ(depthNoise(0.0), 0.0008);
  EXPECT_DOUBLE_EQ(depthNoise(1.0), 0.0024);
  EXPECT_DOUBLE_EQ(depthNoise(2.0) - depthNoise(0.0), 4.0 * (depthNoise(1.0) - depthNoise(0.0)));
}

TEST(DepthNoise, IsFourCentimetresAtFiveMetres)
{
  EXPECT_NEAR(depthNoise(5.0) - depthNoise(0.0), 0.04, 1e-12) << "Khoshelham and Oude Elberink";
}

TEST(DepthNoise, GrowsAsThatOfTheSimulatedSensor)
{
  const SensorModel model;
  const double step = model.disparity_step, noise = model.disparity_noise;
  const double disparity = std::sqrt(noise * noise + step * step / 12.0);
  for (const double depth : {0.6, 1.0, 3.0}) {
    const double simulated = depth * depth / (model.intrinsics.fx * model.projector_x) * disparity;
    EXPECT_NEAR(depthNoise(depth) - depthNoise(0.0), simulated, 0.05 * simulated);
  }
}

}  // namespace
}  // namespace grasp_affordances::test
