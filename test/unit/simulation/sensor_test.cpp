#include "simulation/sensor.h"
#include "simulation/scene_library.h"
#include "support/implicit_solids.h"
#include "support/sensor_views.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace grasp_affordances
{
namespace
{

using namespace test;

TEST(DepthCamera, ShadowOfAPlateBeforeAWallIsOnItsLeft)
{
  const SensorModel model;
  for (const double far : {1.0, 1.5}) {
    constexpr double near = 0.7;
    View view = wall(far);
    view.scene.add(Box{{0.2, 0.2, 0.001}}, at(0.1, 0.0, near + 0.0005));
    const Frame frame = capture(view, 1, model);
    // The plate's left edge is in the middle of the picture.
    const double width = focalBaseline(model) * (1.0 / near - 1.0 / far);
    for (int row = 200; row < 280; ++row) {
      const auto missing = [&](int from, int to) {
        const auto first = frame.depth.begin() + row * 640;
        return std::count(first + from, first + to, 0);
      };
      // The shadow has two edges, at each of which up to two pixels jitter and one next to it is lost.
      EXPECT_NEAR(static_cast<double>(missing(200, 330)), width, 6.0) << "row " << row;
      EXPECT_LE(missing(470, 600), 6) << "row " << row;
    }
    std::size_t lost = 0;
    for (int row = 200; row < 280; ++row)
      lost += std::count(frame.depth.begin() + row * 640 + 200, frame.depth.begin() + row * 640 + 330, 0);
    EXPECT_NEAR(static_cast<double>(lost) / 80.0, width, 2.0);
  }
}

TEST(DepthCamera, ExactPointsLieOnTheSurfaces)
{
  const View view = allKinds();
  const Frame frame = capture(view, 4, exactModel());
  std::vector<std::size_t> points_on(view.scene.parts().size(), 0);
  for (std::size_t i = 0; i < frame.cloud.size(); ++i) {
    ASSERT_TRUE(frame.cloud.measured(i));
    const Eigen::Vector3d point = view.T_scene_camera * frame.cloud.point(i).cast<double>();
    for (std::size_t k = 0; k < view.scene.parts().size(); ++k) {
      const Part& part = view.scene.parts()[k];
      const double distance = test::implicit(part.shape, part.T_scene_shape.inverse() * point);
      ASSERT_GT(distance, -1e-6) << "inside part " << k;
      if (static_cast<std::size_t>(frame.parts[i]) == k) {
        ASSERT_LT(distance, 1e-6) << "pixel " << i;
      }
    }
    ASSERT_EQ(frame.surface_depth[i], frame.cloud.z[i]);
    ++points_on[frame.parts[i]];
  }
  points_on.pop_back();  // behind the wall
  EXPECT_GT(*std::min_element(points_on.begin(), points_on.end()), 300u);
}

// Disparity is off by the noise and half a step, depth by half a millimetre more; next to depth edges the point where
// the surface was hit is up to 2 px away along rows and columns.
TEST(DepthCamera, PointsLieOnTheSurfacesWithinTheModelsBound)
{
  const View view = makeScene("table", 4);
  const SensorModel model;
  const Frame frame = capture(view, 4, model);
  SensorModel exact_model = exactModel();
  exact_model.min_depth *= 0.9;
  const Frame exact = capture(view, 4, exact_model);
  const double largest_error =
      std::sqrt(3.0 * model.window_width * model.window_height) * model.disparity_noise + 0.5 * model.disparity_step;
  std::size_t jittered = 0;
  for (std::size_t i = 0; i < frame.cloud.size(); ++i) {
    if (!frame.cloud.measured(i))
      continue;
    const double truth = frame.surface_depth[i];
    const double low = focalBaseline(model) / (focalBaseline(model) / truth + largest_error);
    const double high = focalBaseline(model) / (focalBaseline(model) / truth - largest_error);
    ASSERT_GE(frame.cloud.z[i], low - 0.000501);
    ASSERT_LE(frame.cloud.z[i], high + 0.000501);

    if (frame.surface_depth[i] == exact.surface_depth[i]) {
      ASSERT_EQ(frame.parts[i], exact.parts[i]);
      continue;
    }
    ++jittered;
    bool found = false;
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) {
        const std::size_t k = i + dy * 640 + dx;
        found = found || (k < exact.parts.size() && exact.parts[k] == frame.parts[i] &&
                          exact.surface_depth[k] == frame.surface_depth[i]);
      }
    }
    ASSERT_TRUE(found) << "pixel " << i;
  }
  EXPECT_GT(jittered, 500u);
  EXPECT_LT(jittered, frame.cloud.size() / 50);
}

TEST(DepthCamera, CloudIsWhatDepthImageProcMakesOfTheDepthImage)
{
  const Frame frame = capture(makeScene("table", 5), 5);
  ASSERT_EQ(frame.cloud.width, 640u);
  ASSERT_EQ(frame.cloud.height, 480u);
  ASSERT_TRUE(frame.cloud.intrinsics);
  const PinholeIntrinsics& camera = *frame.cloud.intrinsics;
  // As OpenNI2 reports it.
  EXPECT_NEAR(2.0 * std::atan(320.0 / camera.fx), 1.0144686, 1e-4);
  EXPECT_NEAR(2.0 * std::atan(240.0 / camera.fy), 0.7898090, 1e-4);
  for (std::size_t i = 0; i < frame.cloud.size(); ++i) {
    ASSERT_EQ(frame.cloud.measured(i), frame.depth[i] != 0);
    ASSERT_EQ(frame.parts[i] >= 0, frame.depth[i] != 0);
    ASSERT_EQ(std::isfinite(frame.surface_depth[i]), frame.depth[i] != 0);
    if (frame.depth[i] == 0)
      continue;
    const Eigen::Vector3d p = frame.cloud.point(i).cast<double>();
    ASSERT_EQ(frame.cloud.z[i], static_cast<float>(frame.depth[i]) * 0.001F);
    const std::size_t u = i % 640, v = i / 640;
    ASSERT_NEAR(camera.fx * p.x() / p.z() + camera.cx, static_cast<double>(u), 1e-3);
    ASSERT_NEAR(camera.fy * p.y() / p.z() + camera.cy, static_cast<double>(v), 1e-3);
  }
  EXPECT_GT(measured(frame), 250000u);
}

/// Errors of depth, measured minus true; 0 where nothing was measured.
std::vector<double> errors(const Frame& frame)
{
  std::vector<double> errors(frame.depth.size(), 0.0);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (frame.depth[i] != 0)
      errors[i] = frame.cloud.z[i] - frame.surface_depth[i];
  }
  return errors;
}

// Walls slanted by 8 degrees, so that their disparities spread evenly over many steps and rounding to steps has its
// mean variance, q^2 / 12; rounding to millimetres has 1 mm^2 / 12.
TEST(DepthCamera, NoiseGrowsWithTheSquareOfDepth)
{
  const SensorModel model;
  const double disparity_variance = std::pow(model.disparity_noise, 2) + std::pow(model.disparity_step, 2) / 12.0;
  for (const double depth : {0.7, 1.0, 1.4, 2.0}) {
    const Frame frame = capture(wall(depth, 8.0 * kDegree), 1, model);
    ASSERT_GT(measuredShare(frame), 0.999);
    const std::vector<double> error = errors(frame);
    double sum = 0.0, squares = 0.0, n = 0.0;
    for (std::size_t i = 0; i < error.size(); ++i) {
      const double z = frame.surface_depth[i];
      if (!(std::abs(z - depth) < 0.05 * depth))
        continue;
      const double scaled = error[i] * std::pow(depth / z, 2);
      sum += scaled;
      squares += scaled * scaled;
      n += 1.0;
    }
    ASSERT_GT(n, 100000.0);
    const double expected = std::pow(depth * depth / focalBaseline(model), 2) * disparity_variance + 1e-6 / 12.0;
    // Neighbouring pixels share their noise: of 16.6 (6.04 x 2.75, the sums of their squared correlations), one counts.
    const double standard_error = std::sqrt(2.0 * 16.6 / n) * expected;
    EXPECT_NEAR(squares / n, expected, 5.0 * standard_error + 0.01 * expected) << "at " << depth << " m";
    EXPECT_NEAR(sum / n, 0.0, 5.0 * std::sqrt(36.0 * expected / n) + 0.02 * std::sqrt(expected))
        << "at " << depth << " m";
  }
}

TEST(DepthCamera, NoiseOfNeighborsIsCorrelatedAndThatOfFarPixelsIsNot)
{
  const std::vector<double> error = errors(capture(wall(2.0, 8.0 * kDegree), 1));
  const auto covariance = [&](std::size_t apart) {
    double sum = 0.0;
    for (std::size_t i = 0; i + apart < error.size(); ++i)
      sum += error[i] * error[i + apart];
    return sum / static_cast<double>(error.size() - apart);
  };
  // Rounding, a quarter of the variance, is independent.
  EXPECT_GT(covariance(1) / covariance(0), 0.5);
  EXPECT_GT(covariance(640) / covariance(0), 0.3);
  EXPECT_NEAR(covariance(50) / covariance(0), 0.0, 0.05);
  EXPECT_NEAR(covariance(20 * 640 + 30) / covariance(0), 0.0, 0.05);
}

TEST(DepthCamera, DepthComesInMillimetresFromWholeDisparitySteps)
{
  const SensorModel model;
  for (const double depth : {0.7, 1.3, 3.1}) {
    const Frame frame = capture(wall(depth), 1, model);
    std::vector<std::uint16_t> values(frame.depth);
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    EXPECT_GE(values.size(), 2u);
    EXPECT_LE(values.size(), 8u);
    for (const std::uint16_t millimetres : values) {
      const double step =
          std::round(1000.0 * focalBaseline(model) / millimetres / model.disparity_step) * model.disparity_step;
      EXPECT_EQ(millimetres, std::round(1000.0 * focalBaseline(model) / step));
    }
    EXPECT_NEAR(model.depthQuantum(depth),
                focalBaseline(model) / (focalBaseline(model) / depth - model.disparity_step) - depth,
                0.02 * model.depthQuantum(depth));
  }
}

TEST(DepthCamera, RefusesAModelThatMeasuresNothing)
{
  const auto constructionWith = [](auto SensorModel::*member, auto value) {
    SensorModel model;
    model.*member = value;
    return [model] { DepthCamera sensor(model); };
  };
  for (const auto size :
       {&SensorModel::width, &SensorModel::height, &SensorModel::window_width, &SensorModel::window_height}) {
    EXPECT_THROW(constructionWith(size, 0)(), std::invalid_argument);
    EXPECT_NO_THROW(constructionWith(size, 1)());
  }
  for (const double step : {0.0, -0.125, std::nan("")})
    EXPECT_THROW(constructionWith(&SensorModel::disparity_step, step)(), std::invalid_argument);
  for (const double depth : {0.0, SensorModel().max_depth, std::nan("")})
    EXPECT_THROW(constructionWith(&SensorModel::min_depth, depth)(), std::invalid_argument);
  for (const double depth : {SensorModel().min_depth, 65.1, std::nan("")})
    EXPECT_THROW(constructionWith(&SensorModel::max_depth, depth)(), std::invalid_argument);
  EXPECT_NO_THROW(constructionWith(&SensorModel::max_depth, 65.0)());
}

TEST(DepthCamera, MeasuresOnlyWithinItsRange)
{
  EXPECT_EQ(measured(capture(wall(0.45), 1)), 0u);
  EXPECT_EQ(measured(capture(wall(0.55), 1)), 640u * 480u);
  EXPECT_EQ(measured(capture(wall(4.0), 1)), 640u * 480u);
  EXPECT_EQ(measured(capture(wall(7.0), 1)), 0u);
  EXPECT_EQ(measured(capture(View{}, 1)), 0u);
}

TEST(DepthCamera, SeedDeterminesTheFrameWhateverTheNumberOfThreads)
{
  View view = allKinds();
  const Frame frame = capture(view, 1);
  const auto same = [&](const Frame& other) {
    const auto bytes = [](const auto& u, const auto& v) {
      return u.size() == v.size() && std::memcmp(u.data(), v.data(), u.size() * sizeof(u[0])) == 0;
    };
    return bytes(frame.cloud.x, other.cloud.x) && bytes(frame.cloud.y, other.cloud.y) &&
           bytes(frame.cloud.z, other.cloud.z) && bytes(frame.depth, other.depth) && bytes(frame.parts, other.parts) &&
           bytes(frame.surface_depth, other.surface_depth);
  };
  EXPECT_FALSE(same(capture(view, 2)));
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_TRUE(same(capture(view, 1))) << threads << " threads";
  }
}

}  // namespace
}  // namespace grasp_affordances
