#include "core/handles/handle_finder.h"

#include "grasp_affordances/localizer.h"
#include "simulation/camera_orbit.h"
#include "support/found_handles.h"
#include "support/points.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

TEST(HandleFinder, FindsAStraightBarAsOneHandle)
{
  Localizer localizer(plainConfig());
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    MountedBar bar;
    bar.radius = 0.009 + 0.002 * static_cast<double>(seed);
    const double yaw = 0.05 * static_cast<double>(seed) - 0.15;  // the posts hide nothing of it
    const View view = barView(bar, yaw);
    const Localization result = localizer.localize(capture(view, seed));
    const std::string what = "seed " + std::to_string(seed);
    expectSound(result, localizer.config(), what);
    const Handles handles = inScene(result, view);
    ASSERT_EQ(handles.size(), 1U) << what;
    const GraspHandle& handle = handles[0];
    const Vector3d axis(std::cos(yaw), std::sin(yaw), 0.0), middle(0.0, 0.0, bar.axis_height);
    EXPECT_EQ(handle.polyline.size(), 2U) << what;
    EXPECT_LT(lineAngle(handle.axis, axis), 3.0 * kDegree) << what;
    EXPECT_NEAR(handle.radius, bar.radius, 0.002) << what;
    EXPECT_LT((handle.centroid - middle).cross(axis).norm(), 0.003) << what;
    const double one = (handle.polyline.front() - middle).dot(axis),
                 other = (handle.polyline.back() - middle).dot(axis);
    EXPECT_NEAR(std::max(one, other), bar.length / 2, 0.015) << what;
    EXPECT_NEAR(std::min(one, other), -bar.length / 2, 0.015) << what;
  }
}

TEST(HandleFinder, FollowsTheHandleOfAMug)
{
  Localizer localizer(plainConfig());
  const Mug mug;
  const View view = mugView(mug);
  const Vector3d center(mug.radius + mug.handle_clearance + mug.handle_tube_radius - mug.handle_radius, 0.0,
                        mug.height / 2);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Localization result = localizer.localize(capture(view, seed));
    const std::string what = "seed " + std::to_string(seed);
    expectSound(result, localizer.config(), what);
    const Handles handles = inScene(result, view);
    ASSERT_EQ(handles.size(), 1U) << what;
    const GraspHandle& handle = handles[0];
    EXPECT_GT(handle.polyline.size(), 2U) << what;
    EXPECT_NEAR(handle.radius, mug.handle_tube_radius, 0.0015) << what;
    EXPECT_GT(handle.length, mug.handle_radius) << what;
    for (const Vector3d& point : handle.polyline) {
      const Vector3d offset = point - center;
      EXPECT_LT(std::hypot(std::hypot(offset.x(), offset.z()) - mug.handle_radius, offset.y()), 0.003)
          << what << ", at " << offset.transpose();
    }
  }
}

TEST(HandleFinder, FindsASphereAsOneHandleAtMost)
{
  Localizer localizer(plainConfig());
  constexpr double kRadius = 0.022;
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Scene scene;
    scene.beginObject("ball in the air");
    scene.add(Sphere{kRadius}, at(0.0, 0.0, 0.1));
    const View view = onTable(std::move(scene), {0.0, -0.6, 0.4}, {0.0, 0.0, 0.1});
    const Localization result = localizer.localize(capture(view, seed));
    expectSound(result, localizer.config(), "seed " + std::to_string(seed));
    EXPECT_LE(result.handles.size(), 1U) << "seed " << seed;
    for (const GraspHandle& handle : inScene(result, view)) {
      ++found;
      EXPECT_LT((handle.centroid - Vector3d(0.0, 0.0, 0.1)).norm(), 0.01) << "seed " << seed;
    }
  }
  EXPECT_GT(found, 0U);
}

TEST(HandleFinder, KeepsToTheLeastSupportAndScore)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  Config config = plainConfig();
  config.handles.min_score = 0.0;
  config.handles.min_support = 1;
  const Localization all = Localizer(config).localize(cloud);
  expectSound(all, config, "all");
  std::size_t members = 0;
  for (const GraspHandle& handle : all.handles) {
    members += handle.shells.size();
  }
  EXPECT_EQ(members, all.shells.size()) << "each shell is of a handle";
  for (const int support : {2, 10, 40}) {
    for (const double score : {0.3, 0.62, 0.9, 1.0}) {
      config.handles.min_support = support;
      config.handles.min_score = score;
      Handles expected = all.handles;
      expected.erase(std::remove_if(expected.begin(), expected.end(),
                                    [&](const GraspHandle& handle) {
                                      return handle.shells.size() < static_cast<std::size_t>(support) ||
                                             handle.score < score;
                                    }),
                     expected.end());
      for (std::size_t i = 0; i < expected.size(); ++i) {
        expected[i].id = static_cast<std::uint32_t>(i + 1);
      }
      const std::string what = std::to_string(support) + " shells, score " + std::to_string(score);
      expectSame(Localizer(config).localize(cloud).handles, expected, what);
    }
  }
}

/// Score by its definition.
TEST(HandleFinder, ScoresAsItsDocumentationSays)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  Config config = plainConfig();
  config.handles.min_score = 0.0;
  const Localization result = Localizer(config).localize(cloud);
  ASSERT_GE(result.handles.size(), 3U);
  for (const GraspHandle& handle : result.handles) {
    double clearance = 0.0, observed = 0.0;
    const auto count = static_cast<double>(handle.shells.size());
    for (const std::uint32_t i : handle.shells) {
      const Shell& shell = result.shells[i];
      const double blocking =
          config.shell.gap_points_to_block * std::max(1.0, shell.length / config.shell.clearance_length);
      clearance += (1.0 - std::min(1.0, shell.points_in_gap / blocking)) / count;
      observed += shell.observed_free / count;
    }
    EXPECT_NEAR(handle.clearance, clearance, 1e-9);
    EXPECT_NEAR(handle.observed_free, observed, 1e-9);
    const double score = count / (count + 5.0) * std::sqrt(std::min(1.0, handle.agreement / 0.3)) * clearance *
                         std::min(1.0, 2.0 * observed) *
                         std::min(1.0, handle.length / (2.0 * config.shell.clearance_length));
    EXPECT_NEAR(handle.score, std::pow(score, 0.2), 1e-9);
  }
}

TEST(HandleFinder, FindsHandlesWithoutARangeImage)
{
  const View view = barView();
  const Cloud cloud = unorganized(capture(view, 1));
  Config config = plainConfig();
  config.sampling.samples = 6000;
  const Localization result = Localizer(config).localize(cloud);
  expectSound(result, config, "unorganized");
  ASSERT_FALSE(result.handles.empty());
  const GraspHandle handle = inScene(result, view)[0];
  EXPECT_TRUE(std::isnan(handle.observed_free));
  EXPECT_LT(lineAngle(handle.axis, {std::cos(0.1), std::sin(0.1), 0.0}), 3.0 * kDegree);
}

TEST(HandleFinder, FindsABarInSeveralViewsAsOneHandle)
{
  const MountedBar bar;
  const View view = barView(bar, 0.0);
  std::vector<Cloud> clouds;
  std::vector<Pose> poses;
  for (const double turn : {-0.5, 0.0, 0.6}) {
    const View turned = viewFromAside(view, turn);
    clouds.push_back(capture(turned, 1 + clouds.size()));
    poses.push_back(turned.T_scene_camera);
  }
  const std::vector<PosedCloud> posed = {{&clouds[0], poses[0]}, {&clouds[1], poses[1]}, {&clouds[2], poses[2]}};
  Config config = plainConfig();
  config.threads = 1;
  Localization result;
  Localizer(config).localize(posed, result);
  expectSound(result, config, "three views");
  ASSERT_EQ(result.handles.size(), 1U);
  const GraspHandle& handle = result.handles[0];
  EXPECT_LT(lineAngle(handle.axis, Vector3d::UnitX()), 3.0 * kDegree);
  EXPECT_NEAR(handle.radius, bar.radius, 0.002);
  EXPECT_LT((handle.centroid - Vector3d(0.0, 0.0, bar.axis_height)).norm(), 0.015);
  EXPECT_NEAR(handle.length, bar.length, 0.03);
  config.threads = 2;
  Localization again;
  Localizer(config).localize(posed, again);
  expectSame(again.handles, result.handles, "two threads");
}

}  // namespace
}  // namespace grasp_affordances::test
