#include "simulation/counter_random.h"
#include "simulation/polynomial_roots.h"
#include "simulation/primitive.h"
#include "simulation/ray_caster.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace grasp_affordances
{
namespace
{

const double kPi = std::acos(-1.0);

// Implicit functions of the solids: at most 0 inside, 0 on the surface, and near it a distance up to a factor close
// to 1.

double implicit(const Box& box, const Eigen::Vector3d& p)
{
  return (p.cwiseAbs() - 0.5 * box.size).maxCoeff();
}

double implicit(const Sphere& sphere, const Eigen::Vector3d& p)
{
  return p.norm() - sphere.radius;
}

double implicit(const Frustum& f, const Eigen::Vector3d& p)
{
  const double radius = f.bottom_radius + (f.top_radius - f.bottom_radius) * (p.z() / f.height + 0.5);
  const double from_axis = p.head<2>().norm();
  const double solid = std::max(std::abs(p.z()) - 0.5 * f.height, from_axis - radius);
  return f.wall == 0.0 ? solid : std::max(solid, radius - f.wall - from_axis);
}

double implicit(const Cylinder& c, const Eigen::Vector3d& p)
{
  return implicit(Frustum{c.radius, c.radius, c.height, c.wall}, p);
}

double implicit(const TorusArc& arc, const Eigen::Vector3d& p)
{
  const double from_axis = p.head<2>().norm();
  const double from_tube = std::hypot(from_axis - arc.major_radius, p.z()) - arc.tube_radius;
  return std::max(from_tube, from_axis * (std::abs(std::atan2(p.y(), p.x())) - arc.half_angle));
}

double implicit(const Primitive& primitive, const Eigen::Vector3d& p)
{
  return std::visit([&](const auto& solid) { return implicit(solid, p); }, primitive);
}

Eigen::Vector3d randomInBall(std::mt19937& engine, double radius)
{
  std::uniform_real_distribution<double> coordinate(-radius, radius);
  Eigen::Vector3d p;
  do
    p = Eigen::Vector3d(coordinate(engine), coordinate(engine), coordinate(engine));
  while (p.norm() > radius);
  return p;
}

/// First sign change of the implicit function between t_min and t_max, by marching and bisection.
double marchedIntersection(const Primitive& primitive, const Ray& ray, double t_min, double t_max, int steps)
{
  const auto inside = [&](double t) { return implicit(primitive, ray.origin + t * ray.direction) <= 0.0; };
  double before = t_min;
  const bool first = inside(before);
  for (int i = 1; i <= steps; ++i) {
    double after = t_min + (t_max - t_min) * i / steps;
    if (inside(after) == first) {
      before = after;
      continue;
    }
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = 0.5 * (before + after);
      (inside(middle) == first ? before : after) = middle;
    }
    return after;
  }
  return kNoIntersection;
}

class PrimitiveTest : public testing::TestWithParam<std::pair<const char*, Primitive>>
{
};

// Every sign change that marching sees must be found. Marching can step over a piece inside that is shorter than its
// step: there, an earlier intersection must lie on the surface.
TEST_P(PrimitiveTest, IntersectionsMatchMarchingAlongTheImplicitFunction)
{
  const Primitive primitive = GetParam().second;
  const double reach = boundingRadius(primitive);
  std::mt19937 engine(1);
  int hits = 0, misses = 0, stepped_over = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    // From far away, from nearby and from inside; towards the solid; directions of any length.
    const double distance = reach * (trial % 3 == 0 ? 1.0 : trial % 3 == 1 ? 3.0 : 30.0);
    Ray ray;
    ray.origin = randomInBall(engine, distance);
    ray.direction = (0.3 + trial % 5) * (randomInBall(engine, 1.5 * reach) - ray.origin);
    const double t_max = 1.01 * (ray.origin.norm() + reach) / ray.direction.norm();
    const double t_min = std::max(0.0, (ray.origin.norm() - 1.01 * reach) / ray.direction.norm());
    const double expected = marchedIntersection(primitive, ray, t_min, t_max, 2000);
    const double actual = intersect(primitive, ray);

    SCOPED_TRACE("trial " + std::to_string(trial));
    ASSERT_FALSE(std::isnan(actual));
    const double tolerance = 1e-9 / ray.direction.norm();
    ASSERT_LE(actual, expected + tolerance);
    if (actual == kNoIntersection) {
      ++misses;
      continue;
    }
    ++hits;
    ASSERT_GT(actual, 0.0);
    ASSERT_NEAR(implicit(primitive, ray.origin + actual * ray.direction), 0.0, 1e-12 * (1.0 + distance));
    if (actual < expected - tolerance)
      ++stepped_over;
  }
  EXPECT_GT(hits, 50);
  EXPECT_GT(misses, 50);
  EXPECT_LT(stepped_over, 30);
}

INSTANTIATE_TEST_SUITE_P(Solids, PrimitiveTest,
                         testing::Values(std::pair<const char*, Primitive>("Box", Box{{0.1, 0.2, 0.04}}),
                                         std::pair<const char*, Primitive>("Sphere", Sphere{0.05}),
                                         std::pair<const char*, Primitive>("Cylinder", Cylinder{0.03, 0.1}),
                                         std::pair<const char*, Primitive>("Tube", Cylinder{0.04, 0.1, 0.005}),
                                         std::pair<const char*, Primitive>("Frustum", Frustum{0.035, 0.015, 0.025}),
                                         std::pair<const char*, Primitive>("FlatFrustum", Frustum{0.01, 0.09, 0.01}),
                                         std::pair<const char*, Primitive>("SteepFrustum", Frustum{0.02, 0.021, 0.2}),
                                         std::pair<const char*, Primitive>("Bowl", Frustum{0.04, 0.08, 0.06, 0.004}),
                                         std::pair<const char*, Primitive>("Handle", TorusArc{0.036, 0.008, 1.4}),
                                         std::pair<const char*, Primitive>("LongArc", TorusArc{0.036, 0.008, 2.5}),
                                         std::pair<const char*, Primitive>("ThickArc", TorusArc{0.036, 0.035, 0.3}),
                                         std::pair<const char*, Primitive>("Ring", TorusArc{0.1, 0.002, kPi}),
                                         std::pair<const char*, Primitive>("Torus", TorusArc{0.05, 0.02, kPi})),
                         [](const auto& info) { return info.param.first; });

TEST(PrimitiveEdgeCases, RaysAlongAxesPlanesAndGenerators)
{
  const auto expectHit = [](const Primitive& solid, const Eigen::Vector3d& from, const Eigen::Vector3d& along,
                            double t) {
    if (t == kNoIntersection)
      EXPECT_EQ(intersect(solid, {from, along}), kNoIntersection);
    else
      EXPECT_NEAR(intersect(solid, {from, along}), t, 1e-14);
  };
  const Cylinder tube{0.04, 0.1, 0.005};
  expectHit(tube, {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, kNoIntersection);  // through the bore
  expectHit(tube, {0.037, 0.0, 1.0}, {0.0, 0.0, -1.0}, 0.95);           // onto the rim
  expectHit(tube, {0.041, 0.0, 1.0}, {0.0, 0.0, -1.0}, kNoIntersection);
  expectHit(tube, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.035);    // from the bore
  expectHit(tube, {0.037, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.003);  // from inside the wall
  expectHit(tube, {0.037, 0.0, 0.0}, {-2.0, 0.0, 0.0}, 0.001);

  // The generator through (0.02, 0, -0.01) and (0.01, 0, 0.01), moved inwards by 5 mm: in through the bottom.
  const Frustum frustum{0.02, 0.01, 0.02};
  expectHit(frustum, {0.02, 0.0, -0.02}, {-0.01, 0.0, 0.02}, 0.5);
  expectHit(frustum, {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, 0.99);

  const TorusArc torus{0.05, 0.01, kPi};
  expectHit(torus, {1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}, 0.94);
  expectHit(torus, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0.04);
  expectHit(torus, {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, kNoIntersection);
  const TorusArc half{0.05, 0.01, 0.5 * kPi};
  expectHit(half, {-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 1.04);
  expectHit(half, {-1.0, 0.05, 0.0}, {1.0, 0.0, 0.0}, 1.0);  // onto a flat end

  const Box box{{0.2, 0.2, 0.2}};
  expectHit(box, {0.0, 0.0, 0.0}, {0.0, 0.0, 4.0}, 0.025);
  expectHit(box, {0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}, kNoIntersection);  // behind the ray's start
}

TEST(PrimitiveValidation, RefusesDimensionsThatDescribeNoSolid)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Scene scene;
  for (const Primitive& bad : {Primitive(Box{{0.1, 0.0, 0.1}}), Primitive(Sphere{-1.0}), Primitive(Cylinder{0.04, nan}),
                               Primitive(Cylinder{0.04, 0.1, 0.04}), Primitive(Frustum{0.04, 0.004, 0.1, 0.005}),
                               Primitive(TorusArc{0.01, 0.02, 1.0}), Primitive(TorusArc{0.05, 0.01, 4.0})})
    EXPECT_THROW(scene.add(bad, Eigen::Isometry3d::Identity()), std::invalid_argument);
  EXPECT_TRUE(scene.parts().empty());
}

// The error of a root is the rounding of the polynomial's terms over its slope there.
TEST(PolynomialRoots, AreFoundToRoundingOverSlope)
{
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> root(-1.0, 1.0);
  for (int trial = 0; trial < 10000; ++trial) {
    std::array<double, 4> r{root(engine), root(engine), root(engine), 0.0};
    r[3] = -(r[0] + r[1] + r[2]);
    std::sort(r.begin(), r.end());
    double p = 0.0, q = 0.0;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < i; ++j) {
        p += r[i] * r[j];
        for (int k = 0; k < j; ++k)
          q -= r[i] * r[j] * r[k];
      }
    }
    const QuarticRoots found = depressedQuarticRoots(p, q, r[0] * r[1] * r[2] * r[3], -4.0, 4.0);
    ASSERT_EQ(found.count, 4u) << "trial " << trial;
    for (int i = 0; i < 4; ++i) {
      double slope = 1.0;
      for (int j = 0; j < 4; ++j)
        slope *= j == i ? 1.0 : std::abs(r[i] - r[j]);
      ASSERT_NEAR(found.values[i], r[i], std::min(1e-3, 1e-13 / slope)) << "trial " << trial;
    }
  }
  EXPECT_EQ(depressedQuarticRoots(0.0, 0.0, 1.0, -2.0, 2.0).count, 0u);
  EXPECT_EQ(depressedQuarticRoots(0.0, 0.0, -1.0, 0.0, 2.0).count, 1u);
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

Frame capture(const View& view, std::uint64_t seed, bool exact = false)
{
  XtionModel model;
  model.exact = exact;
  return Xtion(model).capture(view.scene, view.T_scene_camera, seed);
}

/// A view of a wall at right angles to the optical axis, in the camera's own frame.
View wallAt(double depth)
{
  View view;
  view.scene.add(Box{{20.0, 20.0, 0.1}}, Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, depth + 0.05)));
  return view;
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

TEST(Xtion, ExactPointsLieOnTheSurfaces)
{
  const View view = makeScene("table", 4);
  const Frame frame = capture(view, 4, true);
  std::vector<std::size_t> points_on(view.scene.parts().size(), 0);
  for (std::size_t i = 0; i < frame.cloud.size(); ++i) {
    if (!frame.cloud.measured(i))
      continue;
    const Eigen::Vector3d point = view.T_scene_camera * frame.cloud.point(i).cast<double>();
    double nearest = 1.0;
    bool label_fits = false;
    for (std::size_t k = 0; k < view.scene.parts().size(); ++k) {
      const Part& part = view.scene.parts()[k];
      const double distance = implicit(part.shape, part.T_scene_shape.inverse() * point);
      ASSERT_GT(distance, -1e-6) << "inside part " << k;
      nearest = std::min(nearest, distance);
      if (distance < 1e-6) {
        label_fits = label_fits || part.label == frame.labels[i];
        ++points_on[k];
      }
    }
    ASSERT_LT(nearest, 1e-6) << "pixel " << i;
    ASSERT_TRUE(label_fits) << "pixel " << i;
  }
  // Every part but the mug's floor, which its wall hides.
  EXPECT_EQ(std::count_if(points_on.begin(), points_on.end(), [](std::size_t n) { return n > 100; }),
            static_cast<std::ptrdiff_t>(points_on.size()) - 1);
}

TEST(Xtion, PointsReprojectOntoTheirPixels)
{
  const Frame frame = capture(makeScene("table", 5), 5);
  ASSERT_EQ(frame.cloud.width, 640u);
  ASSERT_EQ(frame.cloud.height, 480u);
  ASSERT_TRUE(frame.cloud.intrinsics);
  const PinholeIntrinsics& camera = *frame.cloud.intrinsics;
  std::size_t measured = 0;
  for (std::size_t i = 0; i < frame.cloud.size(); ++i) {
    if (!frame.cloud.measured(i)) {
      ASSERT_EQ(frame.labels[i], 0u);
      continue;
    }
    ++measured;
    const Eigen::Vector3d p = frame.cloud.point(i).cast<double>();
    ASSERT_NEAR(camera.fx * p.x() / p.z() + camera.cx, static_cast<double>(i % 640), 1e-3);
    ASSERT_NEAR(camera.fy * p.y() / p.z() + camera.cy, static_cast<double>(i / 640), 1e-3);
  }
  EXPECT_GT(measured, 200000u);
}

// A wall so slanted that it recedes from 0.6 to 4.5 m, with its disparities spread evenly over the steps. The squared
// error is then that of the noise and of rounding disparity (as disparity_step^2 / 12) and depth (as depth_step^2 /
// 12).
TEST(Xtion, DepthErrorGrowsWithTheSquareOfDepthAsTheModelSays)
{
  View view;
  Eigen::Isometry3d T_scene_wall = Eigen::Isometry3d::Identity();
  T_scene_wall.linear() =
      (Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(-0.90, Eigen::Vector3d::UnitY()))
          .toRotationMatrix();
  T_scene_wall.translation() = Eigen::Vector3d(0.0, 0.0, 1.1);
  view.scene.add(Box{{20.0, 20.0, 1e-6}}, T_scene_wall);
  const XtionModel model;
  const double focal_baseline = model.intrinsics.fx * model.baseline;
  const double disparity_variance = std::pow(model.disparity_noise, 2) + std::pow(model.disparity_step, 2) / 12.0;
  const Frame noisy = capture(view, 1);
  const Frame exact = capture(view, 1, true);

  const std::vector<double> depths = {0.6, 0.8, 1.2, 1.8, 2.7, 4.5};
  for (std::size_t bin = 0; bin + 1 < depths.size(); ++bin) {
    double errors = 0.0, squared_errors = 0.0, biases = 0.0, variances = 0.0, squared_variances = 0.0;
    int n = 0;
    for (std::size_t i = 0; i < exact.cloud.size(); ++i) {
      const double z = exact.cloud.z[i];
      if (!(z >= depths[bin] && z < depths[bin + 1]))
        continue;
      ASSERT_TRUE(noisy.cloud.measured(i));
      const double error = noisy.cloud.z[i] - z;
      errors += error;
      squared_errors += error * error;
      const double disparity = focal_baseline / z;
      const double from_disparity = std::pow(z / disparity, 2) * disparity_variance;
      const double variance = from_disparity + model.depth_step * model.depth_step / 12.0;
      biases += from_disparity / z;  // of 1 / disparity, to second order
      variances += variance;
      squared_variances += variance * variance;
      ++n;
    }
    SCOPED_TRACE("depths from " + std::to_string(depths[bin]) + " m");
    ASSERT_GT(n, 10000);
    // Five standard deviations. A square's is at most sqrt(2) times the variance, as the errors' tails are short.
    // Rounding to depth steps errs alike in all points of a disparity step: that is averaged over the disparity steps
    // in the bin only.
    const double steps = focal_baseline * (1.0 / depths[bin] - 1.0 / depths[bin + 1]) / model.disparity_step;
    const double rounding = model.depth_step / std::sqrt(12.0);
    EXPECT_NEAR(squared_errors, variances,
                5.0 * (std::sqrt(2.0 * squared_variances) + n * rounding * rounding / std::sqrt(steps)));
    EXPECT_NEAR(errors, biases, 5.0 * (std::sqrt(variances) + n * rounding / std::sqrt(steps)));
  }
}

TEST(Xtion, NoiseOfNeighborsIsUncorrelated)
{
  const Frame frame = capture(wallAt(2.0), 1);
  const auto& z = frame.cloud.z;
  const auto noise = [&](std::size_t i) { return z[i] - 2.0; };
  double sum = 0.0, squares = 0.0, beside = 0.0, below = 0.0;
  const std::size_t n = z.size() - 640;
  for (std::size_t i = 0; i < n; ++i) {
    sum += noise(i);
    squares += noise(i) * noise(i);
    beside += noise(i) * noise(i + 1);
    below += noise(i) * noise(i + 640);
  }
  const double mean = sum / n;
  const double variance = squares / n - mean * mean;
  ASSERT_GT(variance, 0.0);
  EXPECT_NEAR((beside / n - mean * mean) / variance, 0.0, 5.0 / std::sqrt(n));
  EXPECT_NEAR((below / n - mean * mean) / variance, 0.0, 5.0 / std::sqrt(n));
}

TEST(Xtion, DepthComesInMillimetresFromWholeDisparitySteps)
{
  const XtionModel model;
  const double focal_baseline = model.intrinsics.fx * model.baseline;
  for (const double depth : {0.7, 1.3, 3.1}) {
    const Frame frame = capture(wallAt(depth), 1);
    std::vector<float> values(frame.cloud.z);
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    // Noise of at most 6 standard deviations (0.3 px) to either side and half a step.
    EXPECT_GE(values.size(), 2u);
    EXPECT_LE(values.size(), 6u);
    for (const float z : values) {
      const double step = std::round(focal_baseline / z / model.disparity_step) * model.disparity_step;
      EXPECT_NEAR(z, std::round(focal_baseline / step / model.depth_step) * model.depth_step, 1e-6);
      EXPECT_NEAR(focal_baseline / depth, step, 0.3 + 0.5 * model.disparity_step);
    }
  }
}

TEST(Xtion, MeasuresOnlyWithinItsRange)
{
  const auto measured = [](const Frame& frame) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < frame.cloud.size(); ++i)
      n += frame.cloud.measured(i);
    return n;
  };
  EXPECT_EQ(measured(capture(wallAt(0.45), 1)), 0u);
  EXPECT_EQ(measured(capture(wallAt(0.55), 1)), 640u * 480u);
  EXPECT_EQ(measured(capture(wallAt(4.5), 1)), 640u * 480u);
  EXPECT_EQ(measured(capture(wallAt(6.0), 1)), 0u);
  EXPECT_EQ(measured(capture(View{}, 1)), 0u);
}

bool identical(const Frame& a, const Frame& b)
{
  const auto same = [](const auto& u, const auto& v) {
    return u.size() == v.size() && std::memcmp(u.data(), v.data(), u.size() * sizeof(u[0])) == 0;
  };
  return same(a.cloud.x, b.cloud.x) && same(a.cloud.y, b.cloud.y) && same(a.cloud.z, b.cloud.z) &&
         same(a.labels, b.labels);
}

TEST(SceneLibrary, SeedDeterminesSceneAndNoise)
{
  for (const NamedScene& scene : sceneLibrary()) {
    const Frame frame = capture(makeScene(scene.name, 1), 1);
    EXPECT_TRUE(identical(frame, capture(makeScene(scene.name, 1), 1))) << scene.name;
    EXPECT_FALSE(identical(frame, capture(makeScene(scene.name, 1), 2))) << scene.name;
    EXPECT_FALSE(identical(frame, capture(makeScene(scene.name, 2), 1))) << scene.name;
  }
}

TEST(SceneLibrary, RefusesAnUnknownName)
{
  EXPECT_THROW(makeScene("tables", 1), std::invalid_argument);
}

TEST(SceneLibrary, EveryAffordanceOfTheTableIsWellVisible)
{
  for (std::uint64_t seed = 0; seed <= 20; ++seed) {
    const Frame frame = capture(makeScene("table", seed), seed);
    for (const std::uint32_t label : {1u, 2u, 3u})
      EXPECT_GE(std::count(frame.labels.begin(), frame.labels.end(), label), 800)
          << "label " << label << ", seed " << seed;
    EXPECT_LE(*std::max_element(frame.labels.begin(), frame.labels.end()), 3u);
  }
}

TEST(SceneLibrary, NothingOnTheTableHidesAnAffordance)
{
  for (std::uint64_t seed = 0; seed <= 20; ++seed) {
    const View view = makeScene("table", seed);
    const Frame whole = capture(view, seed, true);
    // A mug, a bottle or a bar with its posts: parts that follow one another and stand close to the one with the label.
    for (const std::uint32_t label : {1u, 2u, 3u}) {
      const auto labelled = std::find_if(view.scene.parts().begin(), view.scene.parts().end(),
                                         [&](const Part& part) { return part.label == label; });
      ASSERT_NE(labelled, view.scene.parts().end());
      View alone;
      alone.T_scene_camera = view.T_scene_camera;
      for (const Part& part : view.scene.parts()) {
        const Eigen::Vector3d apart = part.T_scene_shape.translation() - labelled->T_scene_shape.translation();
        if (apart.head<2>().norm() < 0.11)
          alone.scene.add(part.shape, part.T_scene_shape, part.label);
      }
      const Frame frame = capture(alone, seed, true);
      EXPECT_EQ(std::count(frame.labels.begin(), frame.labels.end(), label),
                std::count(whole.labels.begin(), whole.labels.end(), label))
          << "label " << label << ", seed " << seed;
    }
  }
}

TEST(SceneLibrary, StripBetweenThePlatesIsTheSameWithoutThem)
{
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Frame with = capture(makeScene("shadow", seed), seed);
    const Frame without = capture(makeScene("shadow_removed", seed), seed);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    int n = 0;
    for (std::size_t i = 0; i < with.cloud.size(); ++i) {
      ASSERT_EQ(with.labels[i], 0u);
      ASSERT_TRUE(with.cloud.measured(i));
      if (!without.cloud.measured(i)) {
        ASSERT_NEAR(with.cloud.z[i], 0.605, 0.009);  // the plates are 1 cm thick
        continue;
      }
      ASSERT_EQ(with.cloud.point(i), without.cloud.point(i));
      ASSERT_NEAR(with.cloud.z[i], 1.2, 0.02);
      const Eigen::Vector3d p = with.cloud.point(i).cast<double>() * (1.2 / with.cloud.z[i]);
      sum += p;
      squares += p * p.transpose();
      ++n;
    }
    // A strip of even width has the variance width^2 / 12 across.
    ASSERT_GT(n, 1000);
    const Eigen::Matrix2d covariance = (squares / n - sum / n * (sum / n).transpose()).topLeftCorner<2, 2>();
    const double width = std::sqrt(12.0 * Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance).eigenvalues()[0]);
    EXPECT_GT(width, 0.01);
    EXPECT_LT(width, 0.02);
  }
}

}  // namespace
}  // namespace grasp_affordances
