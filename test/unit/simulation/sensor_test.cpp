#include "simulation/sensor.h"
#include "simulation/counter_random.h"
#include "simulation/projector_shadow.h"
#include "simulation/ray_caster.h"
#include "simulation/scene_library.h"
#include "simulation/sensor_noise.h"
#include "simulation/visible_surfaces.h"
#include "support/implicit_solids.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

const double kPi = std::acos(-1.0);
constexpr double kDegree = 0.017453292519943295;

XtionModel exactModel()
{
  XtionModel model;
  model.exact = true;
  return model;
}

Frame capture(const View& view, std::uint64_t seed, const XtionModel& model = XtionModel())
{
  return Xtion(model).capture(view.scene, view.T_scene_camera, seed);
}

Eigen::Isometry3d at(double x, double y, double z)
{
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

/// A plane through (0, 0, depth) in the camera's frame, faced to the camera and then turned about an axis.
View wall(double depth, double angle = 0.0, const Eigen::Vector3d& axis = Eigen::Vector3d::UnitY(),
          Surface surface = Surface::diffuse)
{
  View view;
  view.scene.add(
      HalfSpace{},
      at(0.0, 0.0, depth) * Eigen::AngleAxisd(angle, axis) * Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX()), surface);
  return view;
}

std::size_t measured(const Frame& frame)
{
  return static_cast<std::size_t>(
      std::count_if(frame.depth.begin(), frame.depth.end(), [](std::uint16_t depth) { return depth != 0; }));
}

double measuredShare(const Frame& frame)
{
  return static_cast<double>(measured(frame)) / static_cast<double>(frame.depth.size());
}

/// What of a frame is a part.
double shareOfPart(const Frame& frame, std::int32_t part)
{
  return static_cast<double>(std::count(frame.parts.begin(), frame.parts.end(), part)) /
         static_cast<double>(frame.parts.size());
}

double focalBaseline(const XtionModel& model = XtionModel())
{
  return model.intrinsics.fx * model.baseline;
}

TEST(CounterRandom, GivesTheSameNumbersOnEveryPlatform)
{
  CounterRandom random(1, RandomStream::disparity, 2);
  EXPECT_EQ(random.bits(), 0xaef714253055051cu);
  EXPECT_EQ(random.normal(), -34806 * 0x1p-16);
  EXPECT_NE(CounterRandom(1, RandomStream::placement, 2).bits(), CounterRandom(1, RandomStream::disparity, 2).bits());
}

TEST(CounterRandom, NormalNumbersHaveTheirMoments)
{
  constexpr int n = 1000000;
  double sum = 0.0, squares = 0.0, neighbors = 0.0, previous = 0.0;
  for (int i = 0; i < n; ++i) {
    const double x = CounterRandom(7, RandomStream::disparity, i).normal();
    sum += x;
    squares += x * x;
    neighbors += x * previous;
    previous = x;
  }
  const double standard_error = 1.0 / std::sqrt(n);
  EXPECT_NEAR(sum / n, 0.0, 5.0 * standard_error);
  EXPECT_NEAR(squares / n, 1.0, 5.0 * std::sqrt(2.0) * standard_error);
  EXPECT_NEAR(neighbors / n, 0.0, 5.0 * standard_error);
}

TEST(RayCaster, FindsWhatAllPartsOneByOneGive)
{
  const View view = makeScene("table", 3);
  const RayCaster caster(view.scene, view.T_scene_camera);
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> slope(-0.7, 0.7);
  for (int trial = 0; trial < 20000; ++trial) {
    const Eigen::Vector3d direction(slope(engine), slope(engine), 1.0);
    Hit nearest{kNoIntersection, nullptr};
    for (const Part& part : view.scene.parts()) {
      const Eigen::Isometry3d T_shape_camera = part.T_scene_shape.inverse() * view.T_scene_camera;
      const double t = intersect(part.shape, {T_shape_camera.translation(), T_shape_camera.linear() * direction});
      if (t < nearest.t)
        nearest = {t, &part};
    }
    const std::optional<Hit> hit = caster.cast(direction);
    ASSERT_EQ(hit.has_value(), nearest.part != nullptr);
    if (hit) {
      ASSERT_EQ(hit->part, nearest.part);
      ASSERT_NEAR(hit->t, nearest.t, 1e-12);
    }
  }
}

/// One of each kind, on a table before a wall.
View allKinds()
{
  View view;
  Scene& scene = view.scene;
  scene.add(HalfSpace{}, at(0.0, 0.0, 1.6) * Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX()));
  scene.add(Box{{2.0, 0.03, 1.0}}, at(0.0, 0.25, 1.0));
  const Eigen::AngleAxisd z_up(0.5 * kPi, Eigen::Vector3d::UnitX());
  double x = -0.4;
  for (const Primitive& shape :
       {Primitive(Sphere{0.05}), Primitive(Cylinder{0.04, 0.1, 0.005}), Primitive(Frustum{0.04, 0.02, 0.1}),
        Primitive(TorusArc{0.04, 0.008, 1.4}), Primitive(Ellipsoid{{0.04, 0.03, 0.05}}), Primitive(Capsule{0.02, 0.06}),
        Primitive(EllipticCylinder{0.03, 0.02, 0.08}),
        Primitive(Revolution{{{-0.06, 0.03}, {0.0, 0.033}, {0.03, 0.012}, {0.06, 0.013}}})}) {
    scene.add(shape, at(x, 0.1, 0.9) * z_up * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()));
    x += 0.11;
  }
  scene.add(Sphere{0.1}, at(0.0, -0.1, 0.8), Surface::transparent);
  scene.add(Sphere{0.1}, at(0.6, -0.3, 2.0), Surface::transparent);  // behind the wall
  return view;
}

TEST(VisibleSurfaces, AreThoseOfAllPartsOneByOne)
{
  const View view = allKinds();
  const XtionModel model;
  // The camera is elsewhere, and rolled.
  const Eigen::Isometry3d T_scene_camera =
      at(0.02, -0.05, 0.1) * Eigen::AngleAxisd(0.2, Eigen::Vector3d(0.2, 0.1, 1.0).normalized());
  const VisibleSurfaces visible =
      findVisibleSurfaces(view.scene, T_scene_camera, model.intrinsics, model.width, model.height);
  std::vector<std::size_t> seen(view.scene.parts().size(), 0);
  for (std::size_t pixel = 0; pixel < visible.opaque.depth.size(); ++pixel) {
    const std::size_t u = pixel % model.width, v = pixel / model.width;
    const Eigen::Vector3d direction((static_cast<double>(u) - model.intrinsics.cx) / model.intrinsics.fx,
                                    (static_cast<double>(v) - model.intrinsics.cy) / model.intrinsics.fy, 1.0);
    double nearest[2] = {kNoIntersection, kNoIntersection};
    std::int32_t part[2] = {-1, -1};
    for (std::size_t k = 0; k < view.scene.parts().size(); ++k) {
      const Part& candidate = view.scene.parts()[k];
      const Eigen::Isometry3d T_shape_camera = candidate.T_scene_shape.inverse() * T_scene_camera;
      const double t = intersect(candidate.shape, {T_shape_camera.translation(), T_shape_camera.linear() * direction});
      const int layer = candidate.surface == Surface::transparent ? 1 : 0;
      if (t < nearest[layer]) {
        nearest[layer] = t;
        part[layer] = static_cast<std::int32_t>(k);
      }
    }
    for (const int layer : {0, 1}) {
      const SurfaceImage& image = layer == 0 ? visible.opaque : visible.transparent;
      if (part[layer] < 0) {
        ASSERT_EQ(image.part[pixel], -1) << "pixel " << pixel;
        ASSERT_EQ(image.depth[pixel], std::numeric_limits<float>::infinity());
        continue;
      }
      ASSERT_NEAR(image.depth[pixel], nearest[layer], 2e-7 * nearest[layer]) << "pixel " << pixel;
      ASSERT_EQ(image.part[pixel], part[layer]) << "pixel " << pixel;
      ++seen[part[layer]];
    }
  }
  for (std::size_t k = 0; k < seen.size(); ++k)
    EXPECT_GT(seen[k], 300u) << "part " << k;
}

TEST(WindowedNoise, IsCorrelatedWithinItsWindowAlone)
{
  constexpr int width = 640, height = 480;
  const std::vector<float> noise = windowedNoise(3, RandomStream::disparity, width, height, 9, 3);
  const auto correlation = [&](int columns, int rows) {
    double sum = 0.0;
    for (int row = 0; row + rows < height; ++row) {
      for (int column = 0; column + columns < width; ++column)
        sum += noise[row * width + column] * noise[(row + rows) * width + column + columns];
    }
    return sum / ((width - columns) * (height - rows));
  };
  // So many numbers are as good as independent: windows of which each shares its noise with a part of the others.
  const double standard_error = std::sqrt(6.04 * 2.11 / (width * height));
  for (const int columns : {0, 1, 2, 4, 8, 9, 12, 40}) {
    for (const int rows : {0, 1, 2, 3, 10}) {
      const double shared = std::max(0.0, 1.0 - columns / 9.0) * std::max(0.0, 1.0 - rows / 3.0);
      EXPECT_NEAR(correlation(columns, rows), shared, 5.0 * std::sqrt(2.0) * standard_error)
          << columns << " columns, " << rows << " rows";
    }
  }
}

TEST(PatchNoise, HasUnitVarianceEverywhereAndPatchesOfItsSize)
{
  constexpr int n = 40000;
  const double patch = 6.0;
  for (const auto& [column, row] : {std::pair(0u, 0u), std::pair(3u, 3u), std::pair(2u, 5u)}) {
    double squares = 0.0, near = 0.0, far = 0.0;
    for (int seed = 0; seed < n; ++seed) {
      const PatchNoise noise(seed, RandomStream::reflection, patch);
      const double here = noise(column, row);
      squares += here * here;
      near += here * noise(column + 1, row);
      far += here * noise(column + 12, row);
    }
    EXPECT_NEAR(squares / n, 1.0, 5.0 * std::sqrt(2.0 / n));
    EXPECT_GT(near / n, 0.9);
    EXPECT_NEAR(far / n, 0.0, 5.0 / std::sqrt(n));
  }
}

TEST(ProjectorShadow, OfAPlateIsAsWideAsTheDifferenceOfDisparities)
{
  constexpr int width = 200;
  for (const float difference : {0.0F, 0.9F, 1.4F, 7.0F, 21.7F, 40.0F}) {
    std::vector<float> disparity(width, 30.0F);
    std::fill(disparity.begin() + 100, disparity.begin() + 150, 30.0F + difference);
    std::vector<std::uint8_t> shadowed(width);
    findProjectorShadow(disparity.data(), disparity.data(), width, shadowed.data());
    // Left of the plate, from its edge half a pixel beyond its first column.
    for (int u = 0; u < width; ++u) {
      const bool expected = difference >= 1.0F && u < 100 && static_cast<float>(u) >= 99.5F - difference;
      EXPECT_EQ(shadowed[u], expected ? 1 : 0) << "column " << u << ", difference " << difference;
    }
  }
}

// A pole that is slimmer than the displacement of its shadow: the wall between both is lit. And a step without
// surface, as of glass, throws none.
TEST(ProjectorShadow, OfASlimPoleIsApartFromIt)
{
  constexpr int width = 200;
  std::vector<float> disparity(width, 30.0F);
  std::fill(disparity.begin() + 100, disparity.begin() + 105, 50.0F);
  std::vector<std::uint8_t> shadowed(width);
  findProjectorShadow(disparity.data(), disparity.data(), width, shadowed.data());
  for (int u = 0; u < width; ++u)
    EXPECT_EQ(shadowed[u], u >= 80 && u < 85 ? 1 : 0) << "column " << u;

  const std::vector<float> behind(width, 30.0F);
  findProjectorShadow(disparity.data(), behind.data(), width, shadowed.data());
  EXPECT_EQ(std::count(shadowed.begin(), shadowed.end(), 1), 0);
}

// Surfaces do not shade themselves, however slanted, up to the slope at which they turn away from the projector.
TEST(ProjectorShadow, IsNotOnSlantedPlanes)
{
  constexpr int width = 100;
  for (const float slope : {-3.0F, -0.95F, -0.3F, 0.3F, 0.95F}) {
    std::vector<float> disparity(width);
    for (int u = 0; u < width; ++u)
      disparity[u] = 350.0F + slope * static_cast<float>(u - 50);
    std::vector<std::uint8_t> shadowed(width);
    findProjectorShadow(disparity.data(), disparity.data(), width, shadowed.data());
    EXPECT_EQ(std::count(shadowed.begin(), shadowed.end(), 1), 0) << "slope " << slope;
  }
}

TEST(Xtion, ShadowOfAPlateBeforeAWallIsOnItsLeft)
{
  const XtionModel model;
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

TEST(Xtion, ExactPointsLieOnTheSurfaces)
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
TEST(Xtion, PointsLieOnTheSurfacesWithinTheModelsBound)
{
  const View view = makeScene("table", 4);
  const XtionModel model;
  const Frame frame = capture(view, 4, model);
  XtionModel exact_model = exactModel();
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

TEST(Xtion, CloudIsWhatDepthImageProcMakesOfTheDepthImage)
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
TEST(Xtion, NoiseGrowsWithTheSquareOfDepth)
{
  const XtionModel model;
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

TEST(Xtion, NoiseOfNeighborsIsCorrelatedAndThatOfFarPixelsIsNot)
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

TEST(Xtion, DepthComesInMillimetresFromWholeDisparitySteps)
{
  const XtionModel model;
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

TEST(Xtion, RefusesAModelThatMeasuresNothing)
{
  const auto constructionWith = [](auto XtionModel::*member, auto value) {
    XtionModel model;
    model.*member = value;
    return [model] { Xtion sensor(model); };
  };
  for (const auto size :
       {&XtionModel::width, &XtionModel::height, &XtionModel::window_width, &XtionModel::window_height}) {
    EXPECT_THROW(constructionWith(size, 0)(), std::invalid_argument);
    EXPECT_NO_THROW(constructionWith(size, 1)());
  }
  for (const double step : {0.0, -0.125, std::nan("")})
    EXPECT_THROW(constructionWith(&XtionModel::disparity_step, step)(), std::invalid_argument);
  for (const double depth : {0.0, XtionModel().max_depth, std::nan("")})
    EXPECT_THROW(constructionWith(&XtionModel::min_depth, depth)(), std::invalid_argument);
  for (const double depth : {XtionModel().min_depth, 65.1, std::nan("")})
    EXPECT_THROW(constructionWith(&XtionModel::max_depth, depth)(), std::invalid_argument);
  EXPECT_NO_THROW(constructionWith(&XtionModel::max_depth, 65.0)());
}

TEST(Xtion, MeasuresOnlyWithinItsRange)
{
  EXPECT_EQ(measured(capture(wall(0.45), 1)), 0u);
  EXPECT_EQ(measured(capture(wall(0.55), 1)), 640u * 480u);
  EXPECT_EQ(measured(capture(wall(4.0), 1)), 640u * 480u);
  EXPECT_EQ(measured(capture(wall(7.0), 1)), 0u);
  EXPECT_EQ(measured(capture(View{}, 1)), 0u);
}

TEST(Xtion, LosesSurfacesAtGrazingAngles)
{
  constexpr int bins = 90;
  std::vector<double> pixels(bins, 0.0), found(bins, 0.0);
  for (const double tilt : {55.0, 65.0, 75.0, 80.0, 85.0}) {
    const Frame frame = capture(wall(1.0, tilt * kDegree, Eigen::Vector3d::UnitX()), 1);
    const Eigen::Vector3d normal(0.0, std::sin(tilt * kDegree), -std::cos(tilt * kDegree));
    const XtionModel model;
    for (std::size_t i = 0; i < frame.depth.size(); ++i) {
      const std::size_t u = i % 640, v = i / 640;
      const Eigen::Vector3d ray((static_cast<double>(u) - model.intrinsics.cx) / model.intrinsics.fx,
                                (static_cast<double>(v) - model.intrinsics.cy) / model.intrinsics.fy, 1.0);
      const double depth = normal.z() / normal.dot(ray);
      if (!(depth > 0.6 && depth < 3.0))
        continue;
      const double incidence = std::acos(std::abs(normal.dot(ray)) / ray.norm()) / kDegree;
      pixels[static_cast<int>(incidence)] += 1.0;
      found[static_cast<int>(incidence)] += frame.depth[i] != 0 ? 1.0 : 0.0;
    }
  }
  for (int angle = 0; angle < bins; ++angle) {
    if (pixels[angle] < 3000.0)
      continue;
    const double share = found[angle] / pixels[angle];
    SCOPED_TRACE(std::to_string(angle) + " degrees");
    if (angle < 65) {
      EXPECT_EQ(share, 1.0);
    } else if (angle < 70) {
      EXPECT_GT(share, 0.95);
    } else if (angle == 75 || angle == 76) {
      EXPECT_NEAR(share, 0.5, 0.25);
    } else if (angle >= 84) {
      EXPECT_LT(share, 0.01);
    }
  }
  EXPECT_GT(pixels[60], 3000.0);
  EXPECT_GT(pixels[75], 3000.0);
  EXPECT_GT(pixels[85], 3000.0);
}

TEST(Xtion, DarkSurfacesFadeWithDistanceAndSlant)
{
  const auto share = [](double depth, double tilt) {
    return measuredShare(capture(wall(depth, tilt * kDegree, Eigen::Vector3d::UnitX(), Surface::dark), 1));
  };
  EXPECT_GT(share(0.6, 0.0), 0.99);
  EXPECT_NEAR(share(1.1, 0.0), 0.45, 0.15);  // half of it in the middle, less towards the borders
  EXPECT_LT(share(2.0, 0.0), 0.1);
  EXPECT_LT(share(0.9, 50.0), share(0.9, 0.0) - 0.2);
}

TEST(Xtion, ShinySurfacesHaveAHoleWhereTheyMirrorTheProjector)
{
  const Frame frame = capture(wall(1.0, 0.0, Eigen::Vector3d::UnitY(), Surface::shiny), 1);
  // The mirror's normal is half-way between camera and projector: 3.75 cm to the right.
  const auto shareWithin = [&](double least, double most) {
    double pixels = 0.0, found = 0.0;
    for (std::size_t i = 0; i < frame.depth.size(); ++i) {
      const std::size_t u = i % 640, v = i / 640;
      const double x = (static_cast<double>(u) - 319.5) / 575.8 - 0.0375;
      const double y = (static_cast<double>(v) - 239.5) / 575.8;
      const double sine = std::hypot(x, y) / std::hypot(x, y, 1.0);
      if (sine < least || sine >= most)
        continue;
      pixels += 1.0;
      found += frame.depth[i] != 0 ? 1.0 : 0.0;
    }
    return found / pixels;
  };
  EXPECT_LT(shareWithin(0.0, 0.08), 0.05);
  EXPECT_NEAR(shareWithin(0.3, 0.6), 0.9, 0.04);
}

TEST(Xtion, SeesThroughTransparentSurfaces)
{
  View view = wall(1.2);
  view.scene.add(Box{{2.0, 2.0, 0.005}}, at(0.0, 0.0, 0.8), Surface::transparent);
  const Frame frame = capture(view, 1);
  EXPECT_NEAR(shareOfPart(frame, 0), 0.73, 0.08);
  EXPECT_NEAR(shareOfPart(frame, 1), 0.07, 0.04);
  EXPECT_EQ(shareOfPart(capture(view, 1, exactModel()), 1), 1.0);
}

TEST(Xtion, AbsorbingSurfacesHideWhatIsBehindThem)
{
  View view = wall(1.2);
  view.scene.add(Box{{2.0, 2.0, 0.005}}, at(0.0, 0.0, 0.8), Surface::absorbing);
  for (const XtionModel& model : {XtionModel(), exactModel()})
    EXPECT_EQ(measured(capture(view, 1, model)), 0u);
}

TEST(Xtion, SeedDeterminesTheFrameWhateverTheNumberOfThreads)
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
