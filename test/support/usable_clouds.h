#pragma once

#include "grasp_affordances/cloud.h"
#include "grasp_affordances/localization.h"
#include "support/shells.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <string>

namespace grasp_affordances::test
{

inline Cloud withoutIntrinsics(Cloud cloud)
{
  cloud.intrinsics.reset();
  return cloud;
}

inline Eigen::Isometry3d robotPose()
{
  return Eigen::Translation3d(0.3, -0.2, 1.0) * Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitX());
}

/// Puts a place where nothing was measured, as zeros that were transformed.
inline Cloud padded(Cloud cloud, const Eigen::Vector3f& place)
{
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!cloud.measured(i)) {
      cloud.set(i, place.x(), place.y(), place.z());
    }
  }
  return cloud;
}

inline void expectSame(const Localization& result, const Localization& expected, const std::string& what)
{
  EXPECT_EQ(result.points, expected.points) << what;
  EXPECT_EQ(result.counts, expected.counts) << what;
  EXPECT_EQ(result.handles.size(), expected.handles.size()) << what;
  ASSERT_EQ(result.shells.size(), expected.shells.size()) << what;
  for (std::size_t i = 0; i < result.shells.size(); ++i) {
    ASSERT_TRUE(same(result.shells[i], expected.shells[i])) << what;
  }
}

}  // namespace grasp_affordances::test
