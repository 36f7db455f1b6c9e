#include "grasp_affordances/localizer.h"
#include "support/points.h"
#include "support/seen_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

using Pose = Eigen::Isometry3d;

std::uint32_t count(const Localization& result, Outcome outcome)
{
  return result.counts[static_cast<std::size_t>(outcome)];
}

/// A post between two walls, and a board that hides a part of it from the camera.
View post(bool board)
{
  View view;
  view.scene.beginObject("walls");
  view.scene.add(Box{{0.1, 4.0, 4.0}}, Pose(Eigen::Translation3d(1.5, 0.0, 0.15)));
  view.scene.add(Box{{0.1, 4.0, 4.0}}, Pose(Eigen::Translation3d(-1.5, 0.0, 0.15)));
  view.scene.beginObject("post");
  view.scene.add(Cylinder{0.02, 0.3}, Pose(Eigen::Translation3d(0.0, 0.0, 0.15)));
  if (board) {
    view.scene.beginObject("board");
    view.scene.add(Box{{0.01, 0.4, 0.2}}, Pose(Eigen::Translation3d(-0.2, 0.2, 0.1)));
  }
  // From -x, 1 m away, level.
  view.T_scene_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  view.T_scene_camera.translation() << -1.0, 0.0, 0.15;
  return view;
}

/// Samples are drawn evenly: what their shares tell is of the surface, not of places that were looked at closely.
Config aroundPost()
{
  Config config;
  config.sampling.samples = 4000;
  config.sampling.importance = false;
  config.workspace.min_x = config.workspace.min_y = -0.03;
  config.workspace.max_x = config.workspace.max_y = 0.03;
  return config;
}

TEST(SeveralViews, KeepANeighborhoodThatOneOfThemSeesUnoccluded)
{
  const SeenScene around(post(true), {0.0, 180.0}), twice(post(true), {0.0, 0.0});
  const Localization one = localizeViews(aroundPost(), around.views(1));
  ASSERT_GT(count(one, Outcome::occluded), 300U) << "the board hides a part of what is sampled";
  EXPECT_LT(10 * count(localizeViews(aroundPost(), around.views(2)), Outcome::occluded), count(one, Outcome::occluded));
  EXPECT_GT(2 * count(localizeViews(aroundPost(), twice.views(2)), Outcome::occluded), count(one, Outcome::occluded))
      << "what both see occluded is rejected";
}

TEST(SeveralViews, SeeFreeSpaceFromAnySide)
{
  const SeenScene scene(post(false), {0.0, 180.0});
  const auto largestFree = [](const Localization& result) {
    double largest = 0.0;
    for (const Shell& shell : result.shells) {
      largest = std::max(largest, shell.observed_free);
    }
    return largest;
  };
  EXPECT_LT(largestFree(localizeViews(aroundPost(), scene.views(1))), 0.8) << "an object shadows the gap behind itself";
  EXPECT_GT(largestFree(localizeViews(aroundPost(), scene.views(2))), 0.95);
}

TEST(SeveralViews, PlaceAnAxisBetterFromBothSides)
{
  const SeenScene scene(post(false), {0.0, 180.0});
  const auto distances = [](const Localization& result) {
    std::vector<double> values;
    for (const Shell& shell : result.shells) {
      values.push_back(shell.centroid.head<2>().norm());
    }
    return values;
  };
  const std::vector<double> one = distances(localizeViews(aroundPost(), scene.views(1)));
  const std::vector<double> two = distances(localizeViews(aroundPost(), scene.views(2)));
  EXPECT_GT(two.size(), one.size() / 2) << "points seen from behind are no concave surface";
  EXPECT_LT(quantile(two, 0.5), 0.5 * quantile(one, 0.5));
  EXPECT_LT(quantile(two, 0.95), 0.002);
}

TEST(SeveralViews, CountWhatAnotherSawInTheGap)
{
  // A board close behind the post, which only the second camera sees.
  View view = post(false);
  view.scene.beginObject("back");
  view.scene.add(Box{{0.01, 0.035, 0.3}}, Pose(Eigen::Translation3d(0.029, 0.0, 0.15)));
  Config config = aroundPost();
  config.shell.continue_surfaces = false;
  const SeenScene scene(view, {0.0, 90.0});
  EXPECT_GT(localizeViews(config, scene.views(1)).shells.size(), 100U);
  EXPECT_LT(localizeViews(config, scene.views(2)).shells.size(), 10U);
}

TEST(SeveralViews, FindANeckThatHasLittleToSpare)
{
  View view = post(false);
  view.scene.beginObject("collars");
  for (const double z : {0.065, 0.235}) {
    view.scene.add(Cylinder{0.035, 0.13}, Pose(Eigen::Translation3d(0.0, 0.0, z)));  // which leaves 4 cm free
  }
  const SeenScene scene(view, {0.0, 120.0, -120.0});
  Config config = aroundPost();
  config.shell.straighten = false;
  const std::size_t before = localizeViews(config, scene.views(3)).shells.size();
  config.shell.straighten = true;
  const Localization straight = localizeViews(config, scene.views(3));
  EXPECT_GT(straight.shells.size(), before + before / 2 + 50);
  for (const Shell& shell : straight.shells) {
    EXPECT_LT((shell.centroid - Eigen::Vector3d(0.0, 0.0, 0.15)).norm(), 0.01);
    EXPECT_LT(lineAngle(shell.axis, Eigen::Vector3d::UnitZ()), 0.25);
    EXPECT_NEAR(shell.axis.dot(shell.normal), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace grasp_affordances::test
