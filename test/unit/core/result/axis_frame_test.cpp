#include "core/result/axis_frame.h"

#include "support/points.h"

#include <gtest/gtest.h>

namespace grasp_affordances::test
{
namespace
{

constexpr double kRounding = 1e-12;

void expectRotation(const Eigen::Matrix3d& rotation)
{
  EXPECT_LT((rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm(), kRounding);
  EXPECT_NEAR(rotation.determinant(), 1.0, kRounding) << "right-handed";
}

TEST(AxisFrame, IsOrthonormalAndRightHandedAboutAnyAxis)
{
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d axis = random.direction();
    const AcrossAxis across = acrossAxis(axis);
    Eigen::Matrix3d columns;
    columns << across.first, across.second, axis;
    expectRotation(columns);
    const Eigen::Matrix3d rotation = rotationAlong(axis, across.first);
    EXPECT_EQ(rotation, columns);
  }
}

TEST(AxisFrame, NormalIsTheDirectionAcrossTheAxisNearestToAVector)
{
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d axis = random.direction(), vector = 0.3 * random.direction();
    const auto normal = directionAcross(axis, vector, 1e-6);
    ASSERT_TRUE(normal);
    EXPECT_NEAR(normal->norm(), 1.0, kRounding);
    EXPECT_NEAR(normal->dot(axis), 0.0, kRounding);
    EXPECT_NEAR(normal->dot(vector), axis.cross(vector).norm(), kRounding);
    EXPECT_EQ(normalAcross(axis, vector, 1e-6), *normal);
  }
}

TEST(AxisFrame, OfAVectorAlongTheAxisThereIsNoNormalButSomeIsGivenWhereAskedFor)
{
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitY(), vector(0.0, 5.0, 1e-4);
  EXPECT_FALSE(directionAcross(axis, vector, 1e-4));
  EXPECT_TRUE(directionAcross(axis, vector, 0.9e-4));
  const Eigen::Vector3d normal = normalAcross(axis, vector, 1e-4);
  EXPECT_NEAR(normal.norm(), 1.0, kRounding);
  EXPECT_NEAR(normal.dot(axis), 0.0, kRounding);
}

TEST(AxisFrame, AnUnknownNormalIsReplacedByAnyAcrossTheAxis)
{
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d axis = random.direction();
    const Eigen::Vector3d normal = normalAcross(axis, random.direction(), 1e-6);
    EXPECT_TRUE(isKnown(normal));
    EXPECT_EQ(normalOrAny(axis, normal), normal);
    EXPECT_FALSE(isKnown(unknownNormal()));
    expectRotation(rotationAlong(axis, normalOrAny(axis, unknownNormal())));
  }
}

TEST(AxisFrame, MovesWithItsPointsAndDirections)
{
  Random random(3);
  const Eigen::Vector3d origin = random.direction(), axis = random.direction();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = random.rotation();
  T.translation() = random.direction();
  const AcrossAxis across = acrossAxis(axis);
  const AxisFrame frame = axisFrame(origin, axis, across), moved = transformed(frame, T);
  EXPECT_EQ(asVector(frame.origin), origin);
  EXPECT_EQ(asVector(frame.second), across.second);
  EXPECT_LT((asVector(moved.origin) - T * origin).norm(), kRounding);
  EXPECT_LT((asVector(moved.axis) - T.linear() * axis).norm(), kRounding);
  EXPECT_LT((asVector(moved.first) - T.linear() * across.first).norm(), kRounding);
  EXPECT_LT((asVector(moved.second) - T.linear() * across.second).norm(), kRounding);
}

}  // namespace
}  // namespace grasp_affordances::test
