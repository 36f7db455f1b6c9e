#pragma once

#include "grasp_affordances/localization.h"

#include "simulation/placement.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"
#include "simulation/tableware.h"
#include "support/same_bits.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{

using Eigen::Vector3d;
using Pose = Eigen::Isometry3d;
using Handles = std::vector<GraspHandle>;

inline Config plainConfig()
{
  Config config;
  config.hand_poses.count = 0;
  return config;
}

/// All of a handle but its id and shells, to the last bit.
inline bool sameShape(const GraspHandle& a, const GraspHandle& b)
{
  return a.centroid == b.centroid && a.axis == b.axis && a.normal == b.normal && a.radius == b.radius &&
         a.inner_radius == b.inner_radius && a.length == b.length && a.polyline == b.polyline && a.score == b.score &&
         a.agreement == b.agreement && a.clearance == b.clearance && sameBits(a.observed_free, b.observed_free);
}

inline void expectSame(const Handles& a, const Handles& b, const std::string& what)
{
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_TRUE(sameShape(a[i], b[i])) << what << ", handle " << i;
    EXPECT_EQ(a[i].id, b[i].id) << what;
    EXPECT_EQ(a[i].shells, b[i].shells) << what;
  }
}

inline void expectSound(const Localization& result, const Config& config, const std::string& what)
{
  std::vector<bool> used(result.shells.size());
  for (std::size_t i = 0; i < result.handles.size(); ++i) {
    const GraspHandle& handle = result.handles[i];
    EXPECT_EQ(handle.id, i + 1) << what;
    EXPECT_TRUE(i == 0 || handle.score <= result.handles[i - 1].score) << what << ": the best first";
    EXPECT_GE(handle.score, config.handles.min_score) << what;
    EXPECT_LE(handle.score, 1.0) << what;
    for (const double share : {handle.agreement, handle.clearance}) {
      EXPECT_TRUE(share >= 0.0 && share <= 1.0) << what << ": " << share;
    }
    EXPECT_TRUE(std::isnan(handle.observed_free) || (handle.observed_free >= 0.0 && handle.observed_free <= 1.0));
    EXPECT_GE(handle.shells.size(), static_cast<std::size_t>(config.handles.min_support)) << what;
    EXPECT_TRUE(std::is_sorted(handle.shells.begin(), handle.shells.end())) << what;
    for (const std::uint32_t shell : handle.shells) {
      ASSERT_LT(shell, result.shells.size()) << what;
      EXPECT_FALSE(used[shell]) << what << ": a shell is of one handle";
      used[shell] = true;
    }
    EXPECT_NEAR(handle.axis.norm(), 1.0, 1e-9) << what;
    EXPECT_NEAR(handle.normal.norm(), 1.0, 1e-9) << what;
    EXPECT_NEAR(handle.axis.dot(handle.normal), 0.0, 1e-9) << what;
    EXPECT_GT(handle.axis.maxCoeff(), -handle.axis.minCoeff()) << what << ": largest component positive";
    EXPECT_GT(handle.radius, 0.0) << what;
    EXPECT_LE(handle.inner_radius, config.hand.capture_radius) << what;
    EXPECT_EQ(handle.hits, 1U) << what;
    EXPECT_EQ(handle.unseen_for, 0.0) << what;
    ASSERT_GE(handle.polyline.size(), 2U) << what;
    double length = 0.0;
    for (std::size_t p = 1; p < handle.polyline.size(); ++p) {
      length += (handle.polyline[p] - handle.polyline[p - 1]).norm();
    }
    EXPECT_NEAR(handle.length, length, 1e-12) << what;
  }
}

/// On a table, from a height of about 40 cm.
inline View onTable(Scene scene, const Vector3d& eye, const Vector3d& target)
{
  View view;
  view.scene = std::move(scene);
  view.scene.beginObject("table");
  view.scene.add(HalfSpace{}, Pose::Identity());
  view.T_scene_camera = lookAt(eye, target);
  return view;
}

inline View barView(const MountedBar& bar = MountedBar(), double yaw = 0.1)
{
  Scene scene;
  add(scene, upright(0.0, 0.0, yaw), bar);
  return onTable(std::move(scene), {0.0, -0.6, 0.45}, {0.0, 0.0, bar.axis_height});
}

inline View mugView(const Mug& mug = Mug())
{
  Scene scene;
  add(scene, Pose::Identity(), mug);
  return onTable(std::move(scene), {0.25, -0.6, 0.3}, {0.05, 0.0, 0.05});
}

inline Cloud capture(const View& view, std::uint64_t seed)
{
  return DepthCamera().capture(view.scene, view.T_scene_camera, seed).cloud;
}

/// In the frame of the scene.
inline Handles inScene(const Localization& result, const View& view)
{
  Handles handles = result.handles;
  for (GraspHandle& handle : handles) {
    handle = transformed(std::move(handle), view.T_scene_camera);
  }
  return handles;
}

}  // namespace grasp_affordances::test
