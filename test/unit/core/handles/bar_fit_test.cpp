#include "core/handles/bar_fit.h"

#include "core/fit/circle.h"
#include "support/points.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

using Eigen::Vector3d;

constexpr double kNoise = 0.001;  // m
constexpr double kLength = 0.06;  // m

/// Of no weight.
BarPrior noPrior()
{
  return {1e3, 1e3, 1e3, 1e3};
}

/// Points on an arc of a cone about z, in the middle of which it has a given radius.
Points conePoints(double radius, double taper, double arc, std::size_t count, Random& random, double noise = 0.0)
{
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = random.uniform(-arc / 2, arc / 2), z = random.uniform(-kLength / 2, kLength / 2);
    const double r = radius + taper * z + noise * random.normal();
    points.emplace_back(r * std::sin(angle), -r * std::cos(angle), z);
  }
  return points;
}

/// The fit repeated from its own result, as the distance of points is taken at right angles to the axis of the start.
std::optional<FittedBar> repeatedFit(const Points& points, FittedBar bar, const BarPrior& prior, double noise)
{
  for (int i = 0; i < 4; ++i) {
    const auto fitted = fitBar(points, bar, prior, noise);
    if (!fitted) {
      return std::nullopt;
    }
    bar = *fitted;
  }
  return bar;
}

/// m, of a point from a line.
double distanceFromLine(const Vector3d& point, const Vector3d& origin, const Vector3d& axis)
{
  return (point - origin).cross(axis).norm();
}

class EveryArc : public testing::TestWithParam<double>
{
};

TEST_P(EveryArc, OfExactPointsIsRecovered)
{
  Random random(1);
  for (const double radius : {0.005, 0.01, 0.025}) {
    for (const double taper : {0.0, 0.08, -0.05}) {
      const Eigen::Matrix3d rotation = random.rotation();
      const Vector3d middle = Vector3d(0.1, -0.2, 0.8), axis = rotation.col(2);
      const Points points = transformed(conePoints(radius, taper, GetParam(), 500, random), rotation, middle);
      FittedBar start;
      start.origin = middle + 0.001 * random.direction();
      start.axis = (axis + 0.05 * random.direction()).normalized();
      start.radius = 1.1 * radius;
      const auto bar = repeatedFit(points, start, noPrior(), kNoise);
      const std::string what = "radius " + std::to_string(radius) + ", taper " + std::to_string(taper);
      ASSERT_TRUE(bar) << what;
      const double along = (bar->origin - middle).dot(axis);
      EXPECT_LT(lineAngle(bar->axis, axis), 1e-6) << what;
      EXPECT_LT(distanceFromLine(bar->origin, middle, axis), 1e-6) << what;
      EXPECT_NEAR(bar->radius, radius + taper * along, 1e-6) << what;
      EXPECT_NEAR(bar->taper, taper, 1e-6) << what;
      EXPECT_NEAR(bar->axis.norm(), 1.0, 1e-12) << what;
      EXPECT_NEAR((bar->origin - start.origin).dot(start.axis), 0.0, kLength / 20) << "at the start's height";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BarFit, EveryArc, testing::Values(2.0 * M_PI, M_PI, M_PI / 2),
                         [](const testing::TestParamInfo<double>& info) {
                           return std::to_string(std::lround(info.param * 180.0 / M_PI)) + "_degrees";
                         });

/// Mean radii (m) of many fits to noisy points on an arc.
struct MeanRadii
{
  double bar = 0.0, algebraic = 0.0;
};

MeanRadii meanRadii(double radius, double arc)
{
  constexpr int kDraws = 200;
  MeanRadii mean;
  for (std::uint64_t draw = 1; draw <= kDraws; ++draw) {
    Random random(draw);
    const Points points = conePoints(radius, 0.0, arc, 300, random, kNoise);
    FittedBar start;
    start.origin = Vector3d(0.001, 0.001, 0.0);
    start.radius = radius + 0.002;
    const auto bar = fitBar(points, start, BarPrior(), kNoise);
    const auto circle =
        fitCircle(neighborhoodOf(points, {0.0, -radius, 0.0}, 0.1), Vector3d::UnitX(), Vector3d::UnitY());
    EXPECT_TRUE(bar && circle) << "draw " << draw;
    mean.bar += bar ? bar->radius / kDraws : 0.0;
    mean.algebraic += circle ? circle->radius / kDraws : 0.0;
  }
  return mean;
}

TEST(BarFit, IsNotBiasedByNoiseAsTheAlgebraicCircleIs)
{
  constexpr double kRadius = 0.01;
  const MeanRadii of_half = meanRadii(kRadius, M_PI), of_quarter = meanRadii(kRadius, M_PI / 2);
  EXPECT_NEAR(of_half.bar, kRadius, 0.0003);
  EXPECT_LT(std::abs(of_half.bar - kRadius), std::abs(of_half.algebraic - kRadius));
  EXPECT_NEAR(of_quarter.bar, kRadius, 0.0005);
  EXPECT_LT(of_quarter.algebraic, kRadius - 0.003) << "algebraic, on a short arc";
}

TEST(BarFit, IsNotMovedByWhatIsNotOfTheBar)
{
  constexpr double kRadius = 0.01;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const double arc : {2.0 * M_PI, M_PI}) {
      Random random(seed);
      const Points bar_points = conePoints(kRadius, 0.0, arc, 450, random);
      Points points = bar_points;
      while (points.size() < 500) {
        const Vector3d stray(random.uniform(-0.025, 0.025), random.uniform(-0.025, 0.025), random.uniform(-0.03, 0.03));
        if (std::abs(stray.head<2>().norm() - kRadius) > 0.006) {
          points.push_back(stray);
        }
      }
      FittedBar start;
      start.origin = Vector3d(0.001, 0.0005, 0.0);
      start.radius = kRadius + 0.001;
      const auto bar = fitBar(points, start, BarPrior(), kNoise);
      ASSERT_TRUE(bar);
      const std::string what = "seed " + std::to_string(seed) + ", arc " + std::to_string(arc);
      EXPECT_NEAR(bar->radius, kRadius, 1e-5) << what;
      EXPECT_LT(lineAngle(bar->axis, Vector3d::UnitZ()), 1e-3) << what;
      EXPECT_LT(distanceFromLine(bar->origin, Vector3d::Zero(), Vector3d::UnitZ()), 1e-5) << what;
    }
  }
}

TEST(BarFit, NeedsSixPointsNearIt)
{
  Random random(1);
  FittedBar start;
  start.radius = 0.01;
  const Points enough = conePoints(0.01, 0.0, 2.0 * M_PI, 6, random);
  EXPECT_TRUE(fitBar(enough, start, BarPrior(), kNoise));
  EXPECT_FALSE(fitBar(Points(enough.begin(), enough.end() - 1), start, BarPrior(), kNoise));
  EXPECT_FALSE(fitBar({}, start, BarPrior(), kNoise));
  EXPECT_FALSE(fitBar(conePoints(0.1, 0.0, 2.0 * M_PI, 100, random), start, BarPrior(), kNoise)) << "all are far";
  EXPECT_FALSE(fitBar(Points(100, start.origin), start, BarPrior(), kNoise)) << "on the axis they say nothing";
}

TEST(BarFit, KeepsToThePriorWherePointsSayNothing)
{
  Random random(1);
  FittedBar start;
  start.origin = Vector3d(0.1, -0.2, 0.8);
  start.axis = Vector3d(0.3, 0.9, 0.2).normalized();
  start.radius = 0.01;
  start.taper = 0.03;
  Points ring;  // tells neither tilt nor taper
  const Vector3d first = start.axis.unitOrthogonal(), second = start.axis.cross(first);
  for (int i = 0; i < 100; ++i) {
    const double angle = random.uniform(0.0, 2.0 * M_PI);
    ring.push_back(start.origin + 0.012 * (std::cos(angle) * first + std::sin(angle) * second));
  }
  const auto bar = fitBar(ring, start, BarPrior(), kNoise);
  ASSERT_TRUE(bar);
  EXPECT_NEAR(bar->radius, 0.012, 1e-6);
  EXPECT_LT(lineAngle(bar->axis, start.axis), 1e-9);
  EXPECT_NEAR(bar->taper, start.taper, 1e-9);
}

/// Along one line on the surface, at a distance that radius and place may explain: each by its share of the variance.
TEST(BarFit, SharesWhatIsNotKnownAsThePriorTells)
{
  FittedBar start;
  start.radius = 0.01;
  constexpr double kOff = 0.001;  // m
  Points line;
  for (int i = -300; i <= 300; ++i) {
    line.emplace_back(start.radius + kOff, 0.0, 1e-4 * i);
  }
  for (const auto& [radius, place] : {std::pair(0.01, 0.01), std::pair(0.002, 0.02), std::pair(0.02, 0.005)}) {
    BarPrior prior;
    prior.radius = radius;
    prior.place = place;
    const auto bar = fitBar(line, start, prior, kNoise);
    ASSERT_TRUE(bar);
    const double share = radius * radius / (radius * radius + place * place);
    EXPECT_NEAR(bar->radius - start.radius, share * kOff, 0.01 * kOff);
    EXPECT_NEAR(bar->origin.x(), (1.0 - share) * kOff, 0.01 * kOff);
    EXPECT_NEAR(bar->origin.y(), 0.0, 1e-9);
  }
}

TEST(BarFit, IsTheSameInAnyFrame)
{
  Random random(1);
  const Points points = conePoints(0.01, 0.05, M_PI, 300, random, kNoise);
  FittedBar start;
  start.radius = 0.012;
  const auto expected = fitBar(points, start, BarPrior(), kNoise);
  ASSERT_TRUE(expected);
  for (int i = 0; i < 10; ++i) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = random.rotation();
    T.translation() = random.direction();
    FittedBar moved = start;
    moved.origin = T * start.origin;
    moved.axis = T.linear() * start.axis;
    const auto bar = fitBar(transformed(points, T.linear(), T.translation()), moved, BarPrior(), kNoise);
    ASSERT_TRUE(bar);
    EXPECT_NEAR(bar->radius, expected->radius, 1e-9);
    EXPECT_NEAR(bar->taper, expected->taper, 1e-8);
    EXPECT_LT((bar->origin - T * expected->origin).norm(), 1e-9);
    EXPECT_LT((bar->axis - T.linear() * expected->axis).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace grasp_affordances::test
