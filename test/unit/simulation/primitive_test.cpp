#include "simulation/primitive.h"
#include "simulation/polynomial_roots.h"
#include "simulation/scene.h"
#include "support/implicit_solids.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

using test::implicit;

const double kPi = std::acos(-1.0);

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

// What is between two crossings is inside on every other stretch, and all of a line's material between the first and
// the last.
TEST_P(PrimitiveTest, ContainsChangesAtEveryCrossing)
{
  const Primitive primitive = GetParam().second;
  const double reach = boundingRadius(primitive);
  std::mt19937 engine(2);
  int crossed = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Eigen::Vector3d origin = randomInBall(engine, trial % 2 == 0 ? reach : 4.0 * reach);
    const Eigen::Vector3d direction = (randomInBall(engine, reach) - origin).normalized();
    bool inside = contains(primitive, origin);
    double before = 0.0;
    SCOPED_TRACE("trial " + std::to_string(trial));
    for (int crossing = 0; crossing < 12; ++crossing) {
      // Starting again a nanometre behind a crossing skips slivers that are thinner.
      constexpr double sliver = 1e-9;
      const double after = before + intersect(primitive, {origin + before * direction, direction});
      const double middle = after == kNoIntersection ? before + 3.0 * reach : 0.5 * (before + after);
      if (after - before > 3.0 * sliver) {
        ASSERT_EQ(contains(primitive, origin + middle * direction), inside) << "crossing " << crossing;
      }
      if (after == kNoIntersection)
        break;
      ++crossed;
      before = after + sliver;
      inside = contains(primitive, origin + before * direction);
    }
  }
  EXPECT_GT(crossed, 200);
}

TEST_P(PrimitiveTest, ContainsWhatTheImplicitFunctionSays)
{
  const Primitive primitive = GetParam().second;
  std::mt19937 engine(3);
  std::size_t inside = 0;
  constexpr std::size_t points = 20000;
  for (std::size_t i = 0; i < points; ++i) {
    const Eigen::Vector3d p = randomInBall(engine, 1.1 * boundingRadius(primitive));
    const double value = implicit(primitive, p);
    if (std::abs(value) < 1e-12)
      continue;
    ASSERT_EQ(contains(primitive, p), value < 0.0) << "point " << i;
    inside += value < 0.0 ? 1 : 0;
  }
  EXPECT_GT(inside, points / 1000);
  EXPECT_LT(inside, points);
}

TEST_P(PrimitiveTest, BoundsHoldIt)
{
  const Primitive primitive = GetParam().second;
  const Eigen::AlignedBox3d box = boundingBox(primitive);
  const double reach = boundingRadius(primitive);
  Eigen::AlignedBox3d tightest;
  std::mt19937 engine(4);
  for (int i = 0; i < 100000; ++i) {
    const Eigen::Vector3d p = randomInBall(engine, 1.5 * reach);
    if (implicit(primitive, p) > 0.0)
      continue;
    ASSERT_LE(p.norm(), reach);
    ASSERT_TRUE(box.contains(p));
    tightest.extend(p);
  }
  // Random points come close to all sides.
  EXPECT_LT((box.sizes() - tightest.sizes()).maxCoeff(), 0.3 * reach);
}

TEST_P(PrimitiveTest, RowsOfRaysMeetWhatSingleRaysMeet)
{
  const Primitive primitive = GetParam().second;
  const double reach = boundingRadius(primitive);
  const Eigen::Vector3d origin(0.3 * reach, 0.2 * reach, -4.0 * reach);
  const Eigen::Vector3d first(-0.4, -0.1, 1.0);
  const Eigen::Vector3d step(0.01, 0.001, 0.0);
  std::array<double, 80> t;
  intersect(primitive, origin, first, step, t.size(), t.data());
  for (std::size_t i = 0; i < t.size(); ++i)
    EXPECT_EQ(t[i], intersect(primitive, {origin, first + static_cast<double>(i) * step}));
}

INSTANTIATE_TEST_SUITE_P(
    Solids, PrimitiveTest,
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
                    std::pair<const char*, Primitive>("Torus", TorusArc{0.05, 0.02, kPi}),
                    std::pair<const char*, Primitive>("Ellipsoid", Ellipsoid{{0.04, 0.03, 0.05}}),
                    std::pair<const char*, Primitive>("Capsule", Capsule{0.02, 0.06}),
                    std::pair<const char*, Primitive>("EllipticCylinder", EllipticCylinder{0.03, 0.02, 0.08}),
                    std::pair<const char*, Primitive>("RoundedBox", RoundedBox{{0.04, 0.028, 0.1}, 0.006}),
                    std::pair<const char*, Primitive>("SharpBox", RoundedBox{{0.04, 0.028, 0.1}, 0.0}),
                    std::pair<const char*, Primitive>("Stadium", RoundedBox{{0.04, 0.028, 0.1}, 0.014}),
                    std::pair<const char*, Primitive>("Oval", Oval{0.02, 0.014, 0.1, 0.7}),
                    std::pair<const char*, Primitive>("WideningOval", Oval{0.012, 0.02, 0.06, 2.5}),
                    std::pair<const char*, Primitive>(
                        "Bottle", Revolution{{{-0.08, 0.03}, {0.02, 0.033}, {0.05, 0.012}, {0.08, 0.013}}}),
                    std::pair<const char*, Primitive>(
                        "Spindle", Revolution{{{-0.06, 0.0}, {0.01, 0.02}, {0.02, 0.008}, {0.03, 0.02}, {0.05, 0.0}}}),
                    std::pair<const char*, Primitive>("Cone", Revolution{{{0.0, 0.03}, {0.07, 0.0}}})),
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

  const HalfSpace ground;
  expectHit(ground, {3.0, 4.0, 0.5}, {1.0, 0.0, -0.25}, 2.0);
  expectHit(ground, {3.0, 4.0, 0.5}, {1.0, 0.0, 0.25}, kNoIntersection);
  expectHit(ground, {3.0, 4.0, 0.5}, {1.0, 0.0, 0.0}, kNoIntersection);
  expectHit(ground, {0.0, 0.0, -0.5}, {0.0, 0.0, 1.0}, 0.5);  // from below
  EXPECT_TRUE(contains(ground, {100.0, -100.0, -0.001}));
  EXPECT_FALSE(contains(ground, {100.0, -100.0, 0.001}));
  EXPECT_EQ(boundingRadius(ground), kNoIntersection);

  expectHit(Capsule{0.02, 0.06}, {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, 0.95);
  expectHit(EllipticCylinder{0.03, 0.02, 0.08}, {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, 0.96);
  expectHit(EllipticCylinder{0.03, 0.02, 0.08}, {0.031, 0.0, 1.0}, {0.0, 0.0, -1.0}, kNoIntersection);
  const RoundedBox rounded{{0.04, 0.028, 0.1}, 0.006};
  expectHit(rounded, {1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}, 0.98);
  expectHit(rounded, {1.0, 0.0079, 0.0}, {-1.0, 0.0, 0.0}, 0.98);
  expectHit(rounded, {1.0, 0.0116, 0.0}, {-1.0, 0.0, 0.0}, 0.9812);  // a corner: 3.6 of 6 mm up, 4.8 mm out
  expectHit(rounded, {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, 0.95);
  expectHit(rounded, {0.0195, 0.0135, 1.0}, {0.0, 0.0, -1.0}, kNoIntersection);  // past a corner
  expectHit(Oval{0.02, 0.014, 0.1, 0.5}, {1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}, 0.985);
  expectHit(Oval{0.02, 0.014, 0.1, 0.5}, {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, 0.95);

  // Through both pieces, along the plane in which they meet, and past the waist between two bulges.
  const Revolution hourglass{{{-0.05, 0.03}, {0.0, 0.01}, {0.05, 0.03}}};
  expectHit(hourglass, {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, 0.95);
  expectHit(hourglass, {0.0, 0.0, 0.04}, {0.0, 0.0, -1.0}, 0.09);
  expectHit(hourglass, {1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}, 0.99);
  expectHit(hourglass, {0.02, 0.0, 0.0}, {0.0, 0.0, 1.0}, 0.025);
}

TEST(PrimitiveValidation, RefusesDimensionsThatDescribeNoSolid)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Scene scene;
  for (const Primitive& bad : {Primitive(Box{{0.1, 0.0, 0.1}}),
                               Primitive(Sphere{-1.0}),
                               Primitive(Cylinder{0.04, nan}),
                               Primitive(Cylinder{0.04, 0.1, 0.04}),
                               Primitive(Frustum{0.04, 0.004, 0.1, 0.005}),
                               Primitive(TorusArc{0.01, 0.02, 1.0}),
                               Primitive(TorusArc{0.05, 0.01, 4.0}),
                               Primitive(Ellipsoid{{0.1, 0.1, 0.0}}),
                               Primitive(Capsule{0.02, 0.0}),
                               Primitive(EllipticCylinder{0.02, -0.01, 0.1}),
                               Primitive(RoundedBox{{0.04, 0.028, 0.1}, 0.015}),
                               Primitive(RoundedBox{{0.04, 0.028, 0.1}, -0.001}),
                               Primitive(Oval{0.02, 0.014, 0.1, 0.0}),
                               Primitive(Oval{0.02, nan, 0.1}),
                               Primitive(Revolution{}),
                               Primitive(Revolution{{{0.0, 0.01}}}),
                               Primitive(Revolution{{{0.0, 0.0}, {0.1, 0.0}}}),
                               Primitive(Revolution{{{0.0, 0.01}, {0.0, 0.02}}}),
                               Primitive(Revolution{{{0.0, 0.01}, {0.1, 0.0}, {0.2, 0.01}}}),
                               Primitive(Revolution{{{0.0, 0.01}, {nan, 0.01}}})})
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

}  // namespace
}  // namespace grasp_affordances
