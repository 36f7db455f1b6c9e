#include "core/tracking/axis_curve.h"

#include <gtest/gtest.h>

namespace grasp_affordances::test
{
namespace
{

using Eigen::Vector3d;

TEST(AxisCurve, WaysAndFeet)
{
  const AxisCurve curve({{0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {3.0, 4.0, 0.0}});
  EXPECT_DOUBLE_EQ(curve.length(), 7.0);
  EXPECT_LT((curve.at(5.0) - Vector3d(3.0, 2.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((curve.at(-1.0) - Vector3d(-1.0, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((curve.at(8.0) - Vector3d(3.0, 5.0, 0.0)).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(curve.foot({1.0, 1.0, 0.0}).s, 1.0);
  EXPECT_DOUBLE_EQ(curve.foot({1.0, 1.0, 0.0}).distance, 1.0);
  EXPECT_DOUBLE_EQ(curve.foot({-2.0, 0.0, 0.0}).s, -2.0);
  EXPECT_DOUBLE_EQ(curve.foot({-2.0, 0.0, 0.0}).distance, 2.0);
  EXPECT_DOUBLE_EQ(curve.foot({4.0, -1.0, 0.0}).s, 3.0);  // outside the bend
}

}  // namespace
}  // namespace grasp_affordances::test
