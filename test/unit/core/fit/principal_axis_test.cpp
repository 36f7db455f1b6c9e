#include "core/fit/principal_axis.h"

#include "core/fit/covariance.h"
#include "support/points.h"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>

namespace grasp_affordances::test
{
namespace
{

constexpr double kNoise = 0.0005;  // m

Normals normalsOf(const Cloud& cloud, float radius)
{
  Normals normals;
  normals.reset(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (const auto normal = planeNormal(bruteForceNeighborhood(cloud, cloud.point(i), radius))) {
      normals.set(i, *normal);
    }
  }
  return normals;
}

TEST(PointsAxis, IsTheLongDirectionOfABar)
{
  Random random(1);
  const Eigen::Matrix3d rotation = random.rotation();
  const Eigen::Vector3d place(0.1, 0.2, 0.9);
  const Neighborhood neighborhood =
      neighborhoodOf(transformed(cylinderPoints(0.008, M_PI, 0.05, 600, random, kNoise), rotation, place), place, 0.05);
  const auto axis = pointsAxis(neighborhood);
  ASSERT_TRUE(axis);
  // Over a length L the axis of n points with a spread s across is known to about sqrt(12 / n) s / L.
  EXPECT_LT(lineAngle(*axis, rotation.col(2)), 4 * std::sqrt(12.0 / 600) * 0.006 / 0.05);
}

TEST(NormalsAxis, IsTheDirectionThatNormalsAvoid)
{
  Random random(2);
  const Points points = cylinderPoints(0.02, M_PI, 0.06, 700, random, kNoise);
  const Cloud cloud = cloudOf(points);
  const auto axis = normalsAxis(bruteForceNeighborhood(cloud, {0, -0.02F, 0}, 0.026F), normalsOf(cloud, 0.008F));
  ASSERT_TRUE(axis);
  EXPECT_LT(lineAngle(*axis, Eigen::Vector3d::UnitZ()), 0.1);
}

TEST(PlaneNormal, IsExactOnAPlane)
{
  Random random(3);
  Points points;
  const Eigen::Matrix3d rotation = random.rotation();
  for (int i = 0; i < 100; ++i) {
    points.push_back(rotation * Eigen::Vector3d(random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), 0));
  }
  const auto normal = planeNormal(neighborhoodOf(points, Eigen::Vector3d::Zero(), 0.03));
  ASSERT_TRUE(normal);
  EXPECT_LT(lineAngle(*normal, rotation.col(2)), 1e-5);
}

TEST(DistinctEigenvector, AgreesWithTheFullDecomposition)
{
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Matrix3d rotation = random.rotation();
    const double scale = std::pow(10.0, random.uniform(-8, 4)), ratio = std::pow(10.0, random.uniform(-9, 0));
    const Eigen::Vector3d values =
        scale * (i % 2 == 0 ? Eigen::Vector3d(ratio * 0.5, ratio, 1.0) : Eigen::Vector3d(0.1, 1.0 - 0.9 * ratio, 1.0));
    const Eigen::Matrix3d product = rotation * values.asDiagonal() * rotation.transpose();
    const Eigen::Matrix3d matrix = 0.5 * (product + product.transpose());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(matrix);
    const Eigen::Vector2d gaps = eigen.eigenvalues().tail<2>() - eigen.eigenvalues().head<2>();
    for (const Extreme extreme : {Extreme::smallest, Extreme::largest}) {
      const auto vector = distinctEigenvector(matrix, extreme);
      ASSERT_TRUE(vector) << values.transpose();
      EXPECT_NEAR(vector->norm(), 1.0, 1e-15);
      // Rounding turns an eigenvector by about its size over the gap to the next eigenvalue.
      const double gap = extreme == Extreme::smallest ? gaps[0] : gaps[1];
      const Eigen::Vector3d expected = eigen.eigenvectors().col(extreme == Extreme::smallest ? 0 : 2);
      EXPECT_LT(lineAngle(*vector, expected), 100 * std::numeric_limits<double>::epsilon() * values[2] / gap)
          << values.transpose();
    }
  }
}

TEST(DegenerateNeighborhood, HasNoAxis)
{
  Points same(20, Eigen::Vector3d(0, 0, 1)), line;
  for (int i = 0; i < 20; ++i) {
    line.emplace_back(0x1p-10 * i, 0, 1);
  }
  EXPECT_FALSE(pointsAxis(neighborhoodOf(same, {0, 0, 1}, 0.03)));
  EXPECT_FALSE(pointsAxis(neighborhoodOf({}, {0, 0, 1}, 0.03)));
  EXPECT_FALSE(planeNormal(neighborhoodOf(line, {0, 0, 1}, 0.03)));
  EXPECT_TRUE(pointsAxis(neighborhoodOf(line, {0, 0, 1}, 0.03)));

  Normals same_direction;
  same_direction.reset(20);
  for (std::size_t i = 0; i < 20; ++i) {
    same_direction.set(i, Eigen::Vector3d::UnitZ());
  }
  EXPECT_FALSE(normalsAxis(neighborhoodOf(line, {0, 0, 1}, 0.03), same_direction)) << "a plane has no axis";
  Normals none;
  none.reset(20);
  EXPECT_FALSE(normalsAxis(neighborhoodOf(line, {0, 0, 1}, 0.03), none));
}

}  // namespace
}  // namespace grasp_affordances::test
