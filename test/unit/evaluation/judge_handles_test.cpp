// How handles are judged and compared with the truth.
#include "core/result/polyline.h"
#include "evaluation/handle_errors.h"
#include "evaluation/judge.h"
#include "evaluation/labelled_cloud.h"
#include "support/points.h"
#include "support/polylines.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

using Labels = std::vector<std::uint32_t>;

const double kDegree = M_PI / 180.0;

GraspHandle handleAlong(const Polyline& polyline, double inner_radius)
{
  GraspHandle handle;
  handle.polyline = polyline;
  handle.inner_radius = inner_radius;
  return handle;
}

/// About the z axis, 4 cm long, with an inner radius of 2 cm.
GraspHandle straightHandle()
{
  return handleAlong({{0.0, 0.0, -0.02}, {0.0, 0.0, 0.02}}, 0.02);
}

Verdict verdictOn(const GraspHandle& handle, const Points& points, const Labels& labels)
{
  const Cloud cloud = cloudOf(points);
  return Judge(cloud, labels)(handle);
}

/// On a straight handle that holds one point per label.
Verdict verdictOn(const Labels& labels)
{
  Points points;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    points.emplace_back(0.001 * static_cast<double>(i), 0.01, 0.0);
  }
  return verdictOn(straightHandle(), points, labels);
}

TEST(JudgeHandles, ByTheSameRuleAsShells)
{
  EXPECT_EQ(verdictOn({1, 0}).kind, Verdict::right);
  EXPECT_EQ(verdictOn({1, 0, 0}).kind, Verdict::wrong);
  EXPECT_EQ(verdictOn({1, 2, 0, 0}).kind, Verdict::right) << "affordances count together";
  EXPECT_EQ(verdictOn({255, 255, 0}).kind, Verdict::not_counted);
  EXPECT_EQ(verdictOn({}).kind, Verdict::wrong);
  EXPECT_EQ(verdictOn({3, 7, 7, 0}).affordance, 7U);
  EXPECT_EQ(verdictOn({7, 0, 0}).affordance, 0U) << "a wrong handle finds nothing";
  EXPECT_EQ(verdictOn(GraspHandle(), {{0.0, 0.0, 0.0}}, {1}).kind, Verdict::wrong) << "without a polyline";
}

bool isWithin(const GraspHandle& handle, const Eigen::Vector3d& point)
{
  return verdictOn(handle, {point}, {1}).kind == Verdict::right;
}

TEST(JudgeHandles, TubeReachesTwoMillimetresBeyondTheInnerRadiusAndEndsFlat)
{
  const GraspHandle handle = straightHandle();
  EXPECT_TRUE(isWithin(handle, {0.0219, 0.0, 0.0199}));
  EXPECT_FALSE(isWithin(handle, {0.0221, 0.0, 0.0}));
  EXPECT_FALSE(isWithin(handle, {0.0, 0.0, 0.0201}));
  EXPECT_FALSE(isWithin(handle, {0.0, 0.0, -0.0201}));
}

TEST(JudgeHandles, TubeFollowsABentPolyline)
{
  const GraspHandle handle = handleAlong(halfCircle(0.05, 24), 0.01);
  const auto at = [](double degrees, double from_middle, double z) {
    return Eigen::Vector3d(from_middle * std::cos(degrees * kDegree), from_middle * std::sin(degrees * kDegree), z);
  };
  for (double degrees = 1.0; degrees < 180.0; degrees += 3.7) {
    EXPECT_TRUE(isWithin(handle, at(degrees, 0.0615, 0.0))) << degrees;
    EXPECT_TRUE(isWithin(handle, at(degrees, 0.05, 0.0119))) << degrees;
    EXPECT_FALSE(isWithin(handle, at(degrees, 0.0625, 0.0))) << degrees;
    EXPECT_FALSE(isWithin(handle, at(degrees, 0.0375, 0.0))) << degrees;
  }
  EXPECT_FALSE(isWithin(handle, {0.05, -0.003, 0.0})) << "beyond the start";
  EXPECT_FALSE(isWithin(handle, {-0.05, -0.003, 0.0})) << "beyond the end";
  EXPECT_FALSE(isWithin(handle, {0.0, 0.0, 0.0})) << "what the handle goes around";
}

TEST(JudgeHandles, BoundedSearchAgreesWithLookingAtEachPointAndWithShells)
{
  Random random(2);
  const PinholeIntrinsics k{130.0, 130.0, 79.5, 59.5};
  Cloud cloud;
  cloud.reset(160, 120);
  cloud.intrinsics = k;
  Labels labels(cloud.size());
  for (std::uint32_t v = 0, i = 0; v < cloud.height; ++v) {
    for (std::uint32_t u = 0; u < cloud.width; ++u, ++i) {
      const double z = random.uniform(0.0, 1.0) < 0.1 ? std::nan("") : random.uniform(0.6, 0.7);
      cloud.set(i, static_cast<float>((u - k.cx) / k.fx * z), static_cast<float>((v - k.cy) / k.fy * z),
                static_cast<float>(z));
      labels[i] = random.uniform(0.0, 1.0) < 0.5 ? 0 : static_cast<std::uint32_t>(random.uniform(1.0, 4.0));
    }
  }
  const Cloud points = unorganized(cloud);
  const Judge bounded(cloud, labels), brute(points, labels);
  int right = 0, wrong = 0;
  for (int i = 0; i < 300; ++i) {
    Shell shell;
    shell.centroid = {random.uniform(-0.3, 0.3), random.uniform(-0.2, 0.2), random.uniform(0.5, 0.8)};
    shell.axis = random.direction();
    shell.inner_radius = random.uniform(0.005, 0.03);
    shell.length = random.uniform(0.01, 0.1);
    const Eigen::Vector3d half = shell.length / 2 * shell.axis;
    GraspHandle handle = handleAlong({shell.centroid - half, shell.centroid + half}, shell.inner_radius);
    ASSERT_EQ(bounded(handle).affordance, bounded(shell).affordance) << "two points are a shell, " << i;
    handle.polyline.push_back(handle.polyline.back() + 0.05 * random.direction());
    const Verdict expected = brute(handle);
    ASSERT_EQ(bounded(handle).kind, expected.kind) << i;
    ASSERT_EQ(bounded(handle).affordance, expected.affordance) << i;
    right += expected.kind == Verdict::right ? 1 : 0;
    wrong += expected.kind == Verdict::wrong ? 1 : 0;
  }
  EXPECT_GT(right, 50);
  EXPECT_GT(wrong, 50);
}

TEST(HandleErrors, OnABarAreOffsetTiltAndDifferenceOfRadii)
{
  Affordance bar;
  bar.axis = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.05}, {0.0, 0.0, 0.1}};
  bar.radii = {0.01, 0.01, 0.01};
  GraspHandle handle;
  handle.centroid = {0.003, 0.004, 0.06};
  handle.axis = Eigen::AngleAxisd(7.0 * kDegree, Eigen::Vector3d::UnitX()) * -Eigen::Vector3d::UnitZ();
  handle.radius = 0.0085;
  const HandleErrors errors = handleErrors(handle, bar);
  EXPECT_NEAR(errors.center, 0.005, 1e-12);
  EXPECT_NEAR(errors.axis, 7.0 * kDegree, 1e-9) << "a line has no sign";
  EXPECT_NEAR(errors.radius, -0.0015, 1e-12);
}

TEST(HandleErrors, OnABowAndAConeAreThoseOfTheNearestPlace)
{
  Affordance bow;
  bow.axis = halfCircle(0.04, 30);
  bow.radii.assign(bow.axis.size(), 0.008);
  GraspHandle handle;
  const double angle = 57.0 * kDegree;
  handle.centroid = {0.042 * std::cos(angle), 0.042 * std::sin(angle), 0.0};
  handle.axis = {-std::sin(angle), std::cos(angle), 0.0};
  handle.radius = 0.009;
  const HandleErrors on_bow = handleErrors(handle, bow);
  EXPECT_NEAR(on_bow.center, 0.002, 6e-5) << "a chord of 6 degrees is 0.05 mm inside";
  EXPECT_LT(on_bow.axis, 0.05 * kDegree);
  EXPECT_NEAR(on_bow.radius, 0.001, 1e-12);

  Affordance cone;
  cone.radius = 0.02;
  cone.axis = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.1}};
  cone.radii = {0.02, 0.01};
  handle.centroid = {0.0, 0.0, 0.03};
  handle.axis = Eigen::Vector3d::UnitZ();
  handle.radius = 0.018;
  EXPECT_NEAR(handleErrors(handle, cone).radius, 0.001, 1e-12) << "17 mm there, not 20";
}

TEST(HandleErrors, OnABallHaveNoDirection)
{
  Affordance ball;
  ball.radius = 0.02;
  ball.axis = {{0.0, 0.0, -0.02}, {0.0, 0.0, 0.02}};
  ball.radii = {0.0, 0.0};
  ball.ball_center = Eigen::Vector3d::Zero();
  GraspHandle handle;
  handle.centroid = {0.01, 0.003, 0.0};
  handle.axis = Eigen::Vector3d::UnitX();
  handle.radius = 0.019;
  const HandleErrors errors = handleErrors(handle, ball);
  EXPECT_NEAR(errors.center, 0.003, 1e-12) << "at right angles to the handle's axis";
  EXPECT_TRUE(std::isnan(errors.axis));
  EXPECT_NEAR(errors.radius, -0.001, 1e-12);
}

TEST(HandleErrors, AreNotKnownWithoutAnAxis)
{
  const HandleErrors errors = handleErrors(GraspHandle(), Affordance());
  EXPECT_TRUE(std::isnan(errors.center) && std::isnan(errors.axis) && std::isnan(errors.radius));
}

TEST(RenderedFrame, TruthIsInTheFrameOfTheCloud)
{
  const LabelledCloud labelled = renderedFrame("", "mugs", 1, GraspDefinition(), {0.7, 0.0}).load();
  int near = 0, far = 0;
  for (std::size_t i = 0; i < labelled.cloud.size(); ++i) {
    for (const Affordance& each : labelled.affordances) {
      if (labelled.labels[i] == each.label) {
        const PolylinePlace place = nearestPlace(each.axis, labelled.cloud.point(i).cast<double>());
        const double radius = each.radii[place.segment];
        ++(std::abs(place.offset.norm() - radius) < 0.006 ? near : far);
      }
    }
  }
  EXPECT_GT(near, 500);
  EXPECT_LT(far, near / 50) << "the points of a surface are its radius from its axis";
}

}  // namespace
}  // namespace grasp_affordances::test
