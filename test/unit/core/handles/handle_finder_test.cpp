#include "core/handles/handle_finder.h"

#include "grasp_affordances/localizer.h"

#include "core/parallel/thread_team.h"
#include "core/views/prepared_views.h"
#include "simulation/camera_orbit.h"
#include "simulation/placement.h"
#include "simulation/sensor.h"
#include "simulation/tableware.h"
#include "support/points.h"
#include "support/same_bits.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

using Eigen::Vector3d;
using Pose = Eigen::Isometry3d;
using Handles = std::vector<GraspHandle>;

Config plainConfig()
{
  Config config;
  config.hand_poses.count = 0;
  return config;
}

/// All of a handle but its id and shells, to the last bit.
bool sameShape(const GraspHandle& a, const GraspHandle& b)
{
  return a.centroid == b.centroid && a.axis == b.axis && a.normal == b.normal && a.radius == b.radius &&
         a.inner_radius == b.inner_radius && a.length == b.length && a.polyline == b.polyline && a.score == b.score &&
         a.agreement == b.agreement && a.clearance == b.clearance && sameBits(a.observed_free, b.observed_free);
}

void expectSame(const Handles& a, const Handles& b, const std::string& what)
{
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_TRUE(sameShape(a[i], b[i])) << what << ", handle " << i;
    EXPECT_EQ(a[i].id, b[i].id) << what;
    EXPECT_EQ(a[i].shells, b[i].shells) << what;
  }
}

void expectSound(const Localization& result, const Config& config, const std::string& what)
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
View onTable(Scene scene, const Vector3d& eye, const Vector3d& target)
{
  View view;
  view.scene = std::move(scene);
  view.scene.beginObject("table");
  view.scene.add(HalfSpace{}, Pose::Identity());
  view.T_scene_camera = lookAt(eye, target);
  return view;
}

View barView(const MountedBar& bar = MountedBar(), double yaw = 0.1)
{
  Scene scene;
  add(scene, upright(0.0, 0.0, yaw), bar);
  return onTable(std::move(scene), {0.0, -0.6, 0.45}, {0.0, 0.0, bar.axis_height});
}

View mugView(const Mug& mug = Mug())
{
  Scene scene;
  add(scene, Pose::Identity(), mug);
  return onTable(std::move(scene), {0.25, -0.6, 0.3}, {0.05, 0.0, 0.05});
}

Cloud capture(const View& view, std::uint64_t seed)
{
  return Xtion().capture(view.scene, view.T_scene_camera, seed).cloud;
}

/// In the frame of the scene.
Handles inScene(const Localization& result, const View& view)
{
  Handles handles = result.handles;
  for (GraspHandle& handle : handles) {
    handle = transformed(std::move(handle), view.T_scene_camera);
  }
  return handles;
}

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

/// Clouds with the samples and shells of a localization without importance sampling, to group in other orders.
struct Moment
{
  Moment(const std::vector<PosedCloud>& clouds, Config new_config) : config(std::move(new_config))
  {
    config.sampling.importance = false;
    Localizer(config).localize(clouds, result);
    ThreadTeam team(1);
    views.update(clouds, config, Pose::Identity(), team);
    for (std::uint32_t i = 0; i < result.sampled; ++i) {
      samples.push_back(views.samplePoint(config.sampling, i));
    }
  }

  // cppcheck-suppress passedByValue; it is moved
  explicit Moment(const Cloud& cloud, Config new_config = plainConfig())
      : Moment(std::vector<PosedCloud>{{&cloud, Pose::Identity()}}, std::move(new_config))
  {
  }

  void find(const std::vector<Shell>& shells, Handles& handles)
  {
    finder.find(views, config, {samples.data(), samples.size(), shells}, handles);
  }

  Handles find(const std::vector<Shell>& shells)
  {
    Handles handles;
    find(shells, handles);
    return handles;
  }

  Config config;
  Localization result;
  PreparedViews views;
  std::vector<PreparedViews::SamplePoint> samples;
  HandleFinder finder;
};

TEST(HandleFinder, DoesNotDependOnTheOrderOfTheShells)
{
  std::mt19937 shuffler(1);
  Config low = plainConfig();
  low.handles.min_score = 0.0;
  low.handles.min_support = 1;
  for (const Cloud& cloud :
       {capture(mugView(), 1), captureScene("table", 1).cloud, captureScene("cleaning2", 2).cloud}) {
    Moment moment(cloud, low);
    const std::vector<Shell>& shells = moment.result.shells;
    const Handles expected = moment.find(shells);
    ASSERT_FALSE(expected.empty());
    expectSame(expected, moment.result.handles, "as the localizer");
    for (int shuffle = 0; shuffle < 5; ++shuffle) {
      std::vector<std::uint32_t> order(shells.size());
      std::iota(order.begin(), order.end(), 0U);
      std::shuffle(order.begin(), order.end(), shuffler);
      std::vector<Shell> shuffled;
      for (const std::uint32_t i : order) {
        shuffled.push_back(shells[i]);
      }
      Handles handles = moment.find(shuffled);
      ASSERT_EQ(handles.size(), expected.size());
      for (GraspHandle& handle : handles) {
        EXPECT_TRUE(std::is_sorted(handle.shells.begin(), handle.shells.end()));
        for (std::uint32_t& shell : handle.shells) {
          shell = order[shell];
        }
        std::sort(handle.shells.begin(), handle.shells.end());
      }
      expectSame(handles, expected, "shuffle " + std::to_string(shuffle));
    }
  }
}

TEST(HandleFinder, LeavesNothingOfHandlesThatWereThereBefore)
{
  const Cloud table = captureScene("table", 1).cloud, mug = capture(mugView(), 1);
  Moment of_table(table), of_mug(mug);
  Handles handles = of_table.find(of_table.result.shells);
  ASSERT_GT(handles.size(), of_mug.result.handles.size());
  for (GraspHandle& handle : handles) {
    handle.hand_poses.resize(3);
    handle.hits = 7;
    handle.unseen_for = 0.5;
  }
  of_mug.find(of_mug.result.shells, handles);
  expectSame(handles, of_mug.result.handles, "into used memory");
  for (const GraspHandle& handle : handles) {
    EXPECT_EQ(handle.hits, 1U);
    EXPECT_EQ(handle.unseen_for, 0.0);
    EXPECT_TRUE(handle.hand_poses.empty());
  }
  of_mug.find({}, handles);
  EXPECT_TRUE(handles.empty());
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

TEST(HandleFinder, FindsTheSameWithAnyNumberOfThreads)
{
  const Cloud cloud = captureScene("cleaning2", 1).cloud;
  Config config = plainConfig();
  config.threads = 1;
  const Localization one = Localizer(config).localize(cloud);
  ASSERT_FALSE(one.handles.empty());
  config.threads = 2;
  Localizer localizer(config);
  for (int run = 0; run < 3; ++run) {
    expectSame(localizer.localize(cloud).handles, one.handles, "run " + std::to_string(run));
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
  Cloud cloud = capture(view, 1);
  cloud.width *= cloud.height;
  cloud.height = 1;
  cloud.intrinsics.reset();
  Config config = plainConfig();
  config.sampling.samples = 6000;
  const Localization result = Localizer(config).localize(cloud);
  expectSound(result, config, "unorganized");
  ASSERT_FALSE(result.handles.empty());
  const GraspHandle handle = inScene(result, view)[0];
  EXPECT_TRUE(std::isnan(handle.observed_free));
  EXPECT_LT(lineAngle(handle.axis, {std::cos(0.1), std::sin(0.1), 0.0}), 3.0 * kDegree);
}

/// How handles may differ where they were found in another frame.
struct Tolerance
{
  double radius, place;  // m
  double angle;          // rad
};

void expectSameInFrame(const Pose& T, const View& view, const Tolerance& tolerance, const std::string& what)
{
  const Cloud cloud = capture(view, 1);
  const Localization alone = Localizer(plainConfig()).localize(cloud);
  ASSERT_FALSE(alone.handles.empty()) << what;
  Localization posed;
  Localizer(plainConfig()).localize({{&cloud, T}}, posed);
  ASSERT_EQ(posed.handles.size(), alone.handles.size()) << what;
  for (std::size_t i = 0; i < alone.handles.size(); ++i) {
    const GraspHandle &handle = posed.handles[i], &expected = alone.handles[i];
    EXPECT_EQ(handle.shells, expected.shells) << what;
    EXPECT_NEAR(handle.radius, expected.radius, tolerance.radius) << what;
    EXPECT_LT((handle.centroid - T * expected.centroid).norm(), tolerance.place) << what;
    EXPECT_LT(lineAngle(handle.axis, T.linear() * expected.axis), tolerance.angle) << what;
    EXPECT_NEAR(handle.score, expected.score, 0.02) << what;
  }
}

/// The common frame may be far from the sensors. Which shells are nodes of a bent axis depends on the frame a little.
TEST(HandleFinder, FindsTheSameInAnyCommonFrame)
{
  for (const double away : {0.0, 3.0}) {
    const std::string what = std::to_string(away) + " m away";
    const Pose T_common_scene = at(away, -away, 0.4);
    const View bar = barView(), mug = mugView();
    expectSameInFrame(T_common_scene * bar.T_scene_camera, bar, {1e-6, 1e-6, 1e-6}, "bar, " + what);
    expectSameInFrame(T_common_scene * mug.T_scene_camera, mug, {0.001, 0.004, 5.0 * kDegree}, "mug, " + what);
  }
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
