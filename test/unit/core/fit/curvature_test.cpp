#include "core/fit/curvature.h"

#include "support/points.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

constexpr std::size_t kPoints = 50;
const Eigen::Vector3d kSensor = Eigen::Vector3d::Zero();

/// The quadric sum of x_i^2 / s_i = 1, in metres.
Quadric centralQuadric(const Eigen::Vector3d& squared_semi_axes)
{
  Quadric quadric;
  quadric.A = squared_semi_axes.cwiseInverse().asDiagonal();
  quadric.c = -1.0;
  return quadric;
}

TEST(PrincipalCurvature, OfAnEllipsoidAtItsPoles)
{
  const double a = 0.5, b = 0.8, c = 1.1;
  const Quadric ellipsoid = centralQuadric({a * a, b * b, c * c});
  const PrincipalCurvature at_x = principalCurvature(ellipsoid, {a, 0, 0});
  EXPECT_NEAR(at_x.value, a / (b * b), 1e-12);  // along y; a / c^2 along z
  EXPECT_LT(lineAngle(at_x.axis, Eigen::Vector3d::UnitZ()), 1e-9);
  const PrincipalCurvature at_z = principalCurvature(ellipsoid, {0, 0, c});
  EXPECT_NEAR(at_z.value, c / (a * a), 1e-12);
  EXPECT_LT(lineAngle(at_z.axis, Eigen::Vector3d::UnitY()), 1e-9);
}

TEST(PrincipalCurvature, OfASaddleHasTheSignOfTheStrongerBend)
{
  Quadric saddle;  // z = x^2 / (2 * 0.02) - y^2 / (2 * 0.05), gradient upwards
  saddle.A.diagonal() << -1 / 0.04, 1 / 0.1, 0.0;
  saddle.b.z() = 1.0;
  const PrincipalCurvature up = principalCurvature(saddle, Eigen::Vector3d::Zero());
  EXPECT_NEAR(up.value, -50.0, 1e-9);
  EXPECT_LT(lineAngle(up.axis, Eigen::Vector3d::UnitY()), 1e-9);
  saddle.A = -saddle.A;
  saddle.b = -saddle.b;
  EXPECT_NEAR(principalCurvature(saddle, Eigen::Vector3d::Zero()).value, 50.0, 1e-9);
}

TEST(PrincipalCurvature, OfASphereIsItsInverseRadius)
{
  const Quadric sphere = centralQuadric(Eigen::Vector3d::Constant(0.03 * 0.03));
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d x = 0.03 * random.direction();
    const PrincipalCurvature curvature = principalCurvature(sphere, x);
    EXPECT_NEAR(curvature.value, 1 / 0.03, 1e-9);
    EXPECT_NEAR(curvature.axis.dot(x), 0.0, 1e-12);
  }
}

/// The principal curvature at a surface's top, the origin, of the quadric fitted to points around it.
PrincipalCurvature fittedCurvature(Points points, double noise, const Eigen::Matrix3d& rotation, Random& random)
{
  const Eigen::Vector3d place(0.1, -0.2, 0.8);
  for (Eigen::Vector3d& p : points) {
    p += noise * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  }
  const auto fit = fitTaubin(neighborhoodOf(transformed(points, rotation, place), place, 0.026));
  EXPECT_TRUE(fit);
  PrincipalCurvature curvature = principalCurvature(fit->quadric, fit->quadric.toLocal(place));
  // Positive is what bends away from +z, as the surfaces below do.
  const bool upwards = fit->quadric.gradient(fit->quadric.toLocal(place)).dot(rotation.col(2)) > 0.0;
  curvature.value *= (upwards ? 1.0 : -1.0) / fit->quadric.scale;
  return curvature;
}

/// z = -(k_x x^2 + k_y y^2) / 2 continued as the surface it belongs to: an ellipsoid with these curvatures at its pole,
/// or for curvatures of opposite sign the saddle itself.
Points surfaceWithCurvatures(double k_x, double k_y, Random& random)
{
  Points points;
  while (points.size() < 800) {
    const double x = random.uniform(-0.02, 0.02), y = random.uniform(-0.02, 0.02);
    const double sum = k_x * x * x + k_y * y * y;
    const double c = 0.02;  // m, semi-axis along z; a^2 = c / k_x, b^2 = c / k_y
    const double inside = 1.0 - sum / c;
    if (k_x * k_y < 0.0) {
      points.emplace_back(x, y, -sum / 2);
    } else if (inside > 0.0) {
      points.emplace_back(x, y, c * std::sqrt(inside) - c);
    }
  }
  return points;
}

TEST(FittedQuadric, HasTheCurvatureAndAxisOfTheSurface)
{
  struct Case
  {
    double k_x, k_y;  // 1/m
    double expected;
    bool axis_along_y;
  };
  Random random(21);
  for (const Case& surface : {Case{50, 50, 50, false}, Case{60, 20, 60, true}, Case{20, 60, 60, false},
                              Case{50, -20, 50, true}, Case{20, -50, -50, false}}) {
    for (const double noise : {0.0, 0.0003}) {
      const Eigen::Matrix3d rotation = random.rotation();
      const PrincipalCurvature curvature =
          fittedCurvature(surfaceWithCurvatures(surface.k_x, surface.k_y, random), noise, rotation, random);
      // As for the cylinder below, over a disc of 2 cm; a value that is the larger of two is biased by as much again.
      const double s = std::hypot(noise, 4e-8), w = 0.02;
      const double deviation = 3.5 * s / (w * w) * std::sqrt(45 / 800.0);
      EXPECT_NEAR(curvature.value, surface.expected, 5 * deviation)
          << surface.k_x << " " << surface.k_y << " " << noise;
      if (surface.k_x != surface.k_y) {
        const Eigen::Vector3d axis = rotation.col(surface.axis_along_y ? 1 : 0);
        EXPECT_LT(lineAngle(curvature.axis, axis), 4 * deviation / std::abs(surface.k_x - surface.k_y) + 1e-3);
      }
    }
  }
}

struct CylinderView
{
  Eigen::Vector3d axis;
  Neighborhood neighborhood;
};

/// The side of a cylinder that faces the sensor at the origin, 0.7 m away, or the inside of one.
CylinderView viewCylinder(double radius, double noise, bool inside, Random& random)
{
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(random.uniform(-1, 1), Eigen::Vector3d::UnitY()).toRotationMatrix();
  Eigen::Matrix3d to_sensor;  // the arc's middle, -y, becomes -z (towards the sensor) or +z
  to_sensor << 0, 0, 1, (inside ? 1 : -1), 0, 0, 0, (inside ? -1 : 1), 0;
  const Points points = cylinderPoints(radius, 2.0, 0.04, 900, random, noise);
  const Eigen::Matrix3d turn = rotation * to_sensor;
  const Eigen::Vector3d place = rotation * Eigen::Vector3d(0, 0, 0.7);
  const Eigen::Vector3d middle = turn * Eigen::Vector3d(0, -radius, 0) + place;
  return {turn * Eigen::Vector3d::UnitZ(), neighborhoodOf(transformed(points, turn, place), middle, 0.026)};
}

TEST(MedianCurvature, OfACylinderIsItsInverseRadiusAboutItsAxis)
{
  Random random(4);
  CurvatureScratch scratch;
  for (const double radius : {0.01, 0.02, 0.04}) {
    for (const double noise : {0.0, 0.0005}) {
      const CylinderView view = viewCylinder(radius, noise, false, random);
      const auto fit = fitTaubin(view.neighborhood);
      ASSERT_TRUE(fit);
      const auto curvature = medianCurvature(fit->quadric, view.neighborhood, {kSensor}, {kPoints, 1}, scratch);
      ASSERT_TRUE(curvature);
      // A parabola k x^2 / 2 through n points with noise s over [-w, w] knows k to s / w^2 sqrt(45 / n); a conic, whose
      // term in x^4 is as free and correlated with x^2 by 0.958, to 3.5 times that. A twist t x y over [-w, w] x [-l,
      // l] is known to 3 s / (w l sqrt(n)) and turns the axis by t / k. Rounded coordinates are noise of 4e-8 m.
      const double w = std::min(0.84 * radius, 0.024), l = 0.02;
      const auto n = static_cast<double>(view.neighborhood.size());
      const double s = std::hypot(noise, 4e-8);
      const double curvature_deviation = 3.5 * s / (w * w) * std::sqrt(45 / n);
      const double axis_deviation = 3.5 * 3 * s / (w * l * std::sqrt(n)) * radius;
      EXPECT_NEAR(curvature->median, 1 / radius, 4 * curvature_deviation) << "radius " << radius << " noise " << noise;
      EXPECT_LT(lineAngle(curvature->axis, view.axis), 4 * axis_deviation) << "radius " << radius << " noise " << noise;
      EXPECT_FALSE(curvature->concave);
    }
  }
}

TEST(MedianCurvature, TellsTheInsideOfACylinderFromItsOutside)
{
  Random random(9);
  CurvatureScratch scratch;
  for (const double noise : {0.0, 0.0005}) {
    const CylinderView view = viewCylinder(0.03, noise, true, random);
    const auto fit = fitTaubin(view.neighborhood);
    ASSERT_TRUE(fit);
    const auto curvature = medianCurvature(fit->quadric, view.neighborhood, {kSensor}, {kPoints, 1}, scratch);
    ASSERT_TRUE(curvature);
    EXPECT_TRUE(curvature->concave);
    EXPECT_NEAR(curvature->median, 1 / 0.03, 0.1 / 0.03);

    const auto from_anywhere = medianCurvature(fit->quadric, view.neighborhood, {std::nullopt}, {kPoints, 1}, scratch);
    ASSERT_TRUE(from_anywhere);
    EXPECT_FALSE(from_anywhere->concave);
    EXPECT_EQ(from_anywhere->median, curvature->median);
    EXPECT_EQ(from_anywhere->axis, curvature->axis);
  }
}

TEST(MedianCurvature, OfANoisyPlaneIsLow)
{
  CurvatureScratch scratch;
  std::vector<double> medians;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    Points points;
    for (int i = 0; i < 800; ++i) {
      points.emplace_back(random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03), 0.8 + 0.0008 * random.normal());
    }
    const Neighborhood neighborhood = neighborhoodOf(points, {0, 0, 0.8}, 0.026);
    const auto fit = fitTaubin(neighborhood);
    ASSERT_TRUE(fit) << seed;
    const auto curvature = medianCurvature(fit->quadric, neighborhood, {kSensor}, {kPoints, seed}, scratch);
    ASSERT_TRUE(curvature) << seed;
    medians.push_back(curvature->median);
  }
  // Below what a hand with a capture radius of 4.8 cm asks for.
  EXPECT_LT(*std::max_element(medians.begin(), medians.end()), 1 / 0.048);
}

TEST(MedianCurvature, IsEmptyWhereNoPointStaysInTheNeighborhood)
{
  Random random(1);
  const Neighborhood neighborhood = neighborhoodOf(cylinderPoints(0.02, 1.0, 0.02, 100, random), {0, -0.02, 0}, 0.026);
  Quadric far_plane;  // x = 10, in local units
  far_plane.b.x() = 1.0;
  far_plane.c = -10.0;
  far_plane.origin = neighborhood.center.cast<double>();
  far_plane.scale = neighborhood.radius;
  CurvatureScratch scratch;
  EXPECT_FALSE(medianCurvature(far_plane, neighborhood, {kSensor}, {kPoints, 0}, scratch));
  const Quadric nothing;  // without gradient
  EXPECT_FALSE(medianCurvature(nothing, neighborhood, {kSensor}, {kPoints, 0}, scratch));
}

}  // namespace
}  // namespace grasp_affordances::test
