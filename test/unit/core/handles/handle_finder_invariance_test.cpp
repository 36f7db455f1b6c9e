#include "core/handles/handle_finder.h"

#include "core/parallel/thread_team.h"
#include "core/views/prepared_views.h"
#include "grasp_affordances/localizer.h"
#include "support/found_handles.h"
#include "support/points.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

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
      samples.push_back(views.drawAnywhere(config.sampling, i));
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
  std::vector<PreparedViews::MeasuredPoint> samples;
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

}  // namespace
}  // namespace grasp_affordances::test
