#include "simulation/driver_filters.h"
#include "simulation/sensor.h"
#include "simulation/sensor_model.h"
#include "simulation/sensor_noise.h"
#include "support/sensor_views.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

using namespace test;

constexpr double kNear = 0.7, kFar = 1.0;  // m

/// A plate before a wall; its left edge is in the middle of the picture, or its right one.
View plate(bool left_edge)
{
  View view = wall(kFar);
  view.scene.add(Box{{0.2, 0.2, 0.001}}, at(left_edge ? 0.1 : -0.1, 0.0, kNear + 0.0005));
  return view;
}

/// Without errors at random.
SensorModel calm(SensorModel model)
{
  model.disparity_noise = 0.0;
  model.disparity_step = 0.001;
  model.axial_constant = model.axial_linear = model.axial_quadratic = 0.0;
  model.edge_jitter = 0.0;
  model.edge_loss = 0.0;
  return model;
}

/// Mean number of pixels per row, about the middle of the picture, that the condition holds for.
template <typename Condition>
double perRow(const Frame& frame, Condition&& condition)
{
  const int width = static_cast<int>(frame.cloud.width), height = static_cast<int>(frame.cloud.height);
  int count = 0;
  for (int row = height / 2 - 20; row < height / 2 + 20; ++row) {
    for (int column = width / 2 - 60; column < width / 2 + 60; ++column)
      count += condition(frame.depth[static_cast<std::size_t>(row) * width + column]) ? 1 : 0;
  }
  return count / 40.0;
}

bool missing(std::uint16_t depth)
{
  return depth == 0;
}

bool between(std::uint16_t depth)
{
  return depth > 710 && depth < 990;
}

TEST(SensorEffects, RegisteredDepthHasASecondShadow)
{
  const SensorModel model = calm(sensorModel("kinect_v1"));
  const double disparities = model.intrinsics.fx * (kFar - kNear) / (kNear * kFar);
  // The color camera stands between depth camera and projector. What is near grows by half a pixel on either side.
  EXPECT_NEAR(perRow(capture(plate(true), 1, model), missing), disparities * 0.05, 1.5);
  EXPECT_NEAR(perRow(capture(plate(false), 1, model), missing), disparities * 0.025, 1.5);
}

TEST(SensorEffects, RegisteredPointsLieOnTheSurfaces)
{
  for (const std::string name : {"kinect_v1", "realsense_d400", "realsense_sr300"}) {
    SensorModel model = calm(sensorModel(name));
    model.edge_ramp = 1;
    model.flying_share = 0.0;
    const Frame frame = capture(plate(true), 1, model);
    std::size_t on_plate = 0;
    for (std::size_t i = 0; i < frame.cloud.size(); ++i) {
      ASSERT_EQ(frame.cloud.measured(i), frame.depth[i] != 0);
      ASSERT_EQ(frame.cloud.measured(i), frame.parts[i] >= 0);
      if (!frame.cloud.measured(i))
        continue;
      ASSERT_NEAR(frame.cloud.z[i], frame.parts[i] == 1 ? kNear : kFar, 0.0015);
      if (frame.parts[i] != 1)
        continue;
      // Within a pixel of either camera of where it is.
      ASSERT_NEAR(frame.cloud.x[i], 0.1, 0.1 + 0.0035);
      ASSERT_NEAR(frame.cloud.y[i], 0.0, 0.1 + 0.0035);
      ++on_plate;
    }
    EXPECT_GT(static_cast<double>(on_plate), 0.98 * std::pow(0.2 * model.intrinsics.fx / kNear, 2)) << name;
  }
}

TEST(SensorEffects, EdgesAreRampsOfTheGivenWidth)
{
  for (const std::uint32_t ramp : {1U, 4U, 9U}) {
    SensorModel model = calm(SensorModel());
    model.edge_ramp = ramp;
    EXPECT_NEAR(perRow(capture(plate(false), 1, model), between), ramp - 1.0, 0.01);
  }
}

TEST(SensorEffects, FlyingPixelsAreNextToEdges)
{
  SensorModel model = calm(SensorModel());
  for (const double share : {0.0, 0.3, 1.0}) {
    model.flying_share = share;
    EXPECT_NEAR(perRow(capture(plate(false), 1, model), between), 2.0 * share * 280.0 / 300.0, 0.3) << share;
  }
}

TEST(SensorEffects, LossAtEdgesIsTheGivenShare)
{
  SensorModel model = calm(SensorModel());
  for (const double share : {0.0, 0.2, 1.0}) {
    model.edge_loss = share;
    EXPECT_NEAR(perRow(capture(plate(false), 1, model), missing), 2.0 * share, 0.35) << share;
  }
}

TEST(SensorEffects, TimeOfFlightHasNoShadowAndItsLawOfNoise)
{
  SensorModel model = sensorModel("kinect_v2");
  EXPECT_EQ(perRow(capture(plate(true), 1, calm(model)), missing), 0.0);
  for (const double depth : {0.8, 1.5, 3.0}) {
    const Frame frame = capture(wall(depth), 1, model);
    double squares = 0.0;
    for (std::size_t i = 0; i < frame.depth.size(); ++i)
      squares += std::pow(frame.cloud.z[i] - frame.surface_depth[i], 2);
    const double expected = 0.0015 - 0.0005 * depth + 0.0003 * depth * depth;
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(frame.depth.size())),
                std::hypot(expected, 0.001 / std::sqrt(12)), 0.02 * expected);
  }
}

MeasuredImage row(const std::vector<std::uint16_t>& depth)
{
  MeasuredImage image(static_cast<std::uint32_t>(depth.size()), 1);
  image.depth = depth;
  for (std::size_t i = 0; i < depth.size(); ++i)
    image.parts[i] = depth[i] == 0 ? -1 : static_cast<std::int32_t>(i);
  return image;
}

TEST(DriverFilters, HolesUpToAWidthAreFilledWithWhatIsFarther)
{
  MeasuredImage image = row({0, 500, 0, 0, 700, 0, 0, 0, 600, 0});
  fillHoles(0, image);
  EXPECT_EQ(image.depth[2], 0);
  fillHoles(2, image);
  EXPECT_EQ(image.depth, (std::vector<std::uint16_t>{0, 500, 700, 700, 700, 0, 0, 0, 600, 0}));
  EXPECT_EQ(image.parts[2], 4);
}

TEST(DriverFilters, SmoothingKeepsEdges)
{
  MeasuredImage image = row({500, 502, 504, 700, 703, 0});
  smoothDepth(1, 20.0, image);
  EXPECT_EQ(image.depth, (std::vector<std::uint16_t>{501, 502, 503, 702, 702, 0}));
  smoothDepth(2, 65000.0, image);
  EXPECT_EQ(image.depth[2], (501 + 502 + 503 + 702 + 702 + 2) / 5);
}

TEST(SensorNoise, DeviatesAreExceededByTheirShare)
{
  EXPECT_EQ(exceededBy(0.5), 0.0);
  EXPECT_EQ(exceededBy(0.31), 0.5);
  EXPECT_EQ(exceededBy(0.0968), 1.3);
  EXPECT_EQ(exceededBy(0.841), -1.0);
  EXPECT_EQ(exceededBy(0.0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(exceededBy(1.0), -std::numeric_limits<double>::infinity());
}

TEST(KnownSensors, SeedDeterminesTheFrameWhateverTheNumberOfThreads)
{
  const View view = allKinds();
  for (const std::string& name : sensorNames()) {
    const SensorModel model = sensorModel(name);
    const Frame frame = capture(view, 1, model);
    EXPECT_GT(measuredShare(frame), 0.1) << name;  // the wall is beyond the range of some
    EXPECT_EQ(frame.depth == capture(view, 2, model).depth, model.exact) << name;
    for (const std::size_t threads : {1, 5}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      const Frame other = capture(view, 1, model);
      EXPECT_EQ(frame.depth, other.depth) << name << ", " << threads << " threads";
      EXPECT_EQ(frame.parts, other.parts) << name << ", " << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace grasp_affordances
