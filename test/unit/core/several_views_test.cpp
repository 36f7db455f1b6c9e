#include "grasp_affordances/localizer.h"
#include "support/points.h"
#include "support/scenes.h"
#include "support/seen_scenes.h"
#include "support/shells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

using Pose = Eigen::Isometry3d;

Pose somePose()
{
  return Eigen::Translation3d(0.3, -0.2, 0.9) * Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, 2.0, -0.5).normalized());
}

TEST(SeveralViews, OneViewIsTheCloudAloneBroughtToTheCommonFrame)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  const Config config;
  Localizer localizer(config);
  const Localization alone = localizer.localize(cloud);
  ASSERT_GT(alone.shells.size(), 100U);
  EXPECT_TRUE(std::isnan(alone.view_disagreement));

  const Pose T = somePose();
  const Localization posed = localizeViews(config, {{&cloud, T}});
  EXPECT_EQ(posed.counts, alone.counts);
  ASSERT_EQ(posed.shells.size(), alone.shells.size());
  for (std::size_t i = 0; i < alone.shells.size(); ++i) {
    const Shell &shell = posed.shells[i], &expected = alone.shells[i];
    EXPECT_LT((shell.centroid - T * expected.centroid).norm(), 1e-12);
    EXPECT_LT(lineAngle(shell.axis, T.linear() * expected.axis), 1e-12);
    EXPECT_GT(shell.axis.maxCoeff(), -shell.axis.minCoeff()) << "largest component positive";
    EXPECT_LT((shell.normal - T.linear() * expected.normal).norm(), 1e-12);
    EXPECT_EQ(shell.inner_radius, expected.inner_radius);
    EXPECT_EQ(shell.point_index, expected.point_index);
  }
}

TEST(SeveralViews, LeaveNothingBehindForTheNextCloud)
{
  const SeenScene scene(makeScene("table", 1), {0.0, 90.0});
  Config config;
  config.sampling.samples = 500;
  Localizer localizer(config);
  const Localization before = localizer.localize(scene.frames[0].cloud);
  Localization both, after;
  localizer.localize(scene.views(2), both);
  localizer.localize(scene.frames[0].cloud, after);
  EXPECT_NE(both.counts, before.counts);
  EXPECT_EQ(after.counts, before.counts);
  ASSERT_EQ(after.shells.size(), before.shells.size());
  for (std::size_t i = 0; i < after.shells.size(); ++i) {
    EXPECT_TRUE(same(after.shells[i], before.shells[i])) << i;
  }
}

TEST(SeveralViews, GiveTheSameWithAnyNumberOfThreads)
{
  const SeenScene scene(makeScene("table", 1), {0.0, 60.0, -60.0});
  Config config;
  config.sampling.samples = 1000;
  config.threads = 1;
  const Localization reference = localizeViews(config, scene.views(3));
  ASSERT_GT(reference.shells.size(), 10U);
  for (const int threads : {2, 5}) {
    config.threads = threads;
    const Localization result = localizeViews(config, scene.views(3));
    ASSERT_EQ(result.counts, reference.counts) << threads;
    for (std::size_t i = 0; i < result.shells.size(); ++i) {
      EXPECT_TRUE(same(result.shells[i], reference.shells[i])) << threads << " threads, shell " << i;
    }
  }
}

TEST(SeveralViews, SampleAllCloudsAndCountTheirPointsOneAfterTheOther)
{
  const SeenScene scene(makeScene("table", 1), {0.0, 180.0});
  const Localization result = localizeViews(Config(), scene.views(2));
  const std::size_t first = scene.frames[0].cloud.size();
  std::size_t of_first = 0;
  for (const Shell& shell : result.shells) {
    const std::size_t view = shell.point_index < first ? 0 : 1;
    of_first += view == 0 ? 1 : 0;
    const Cloud& cloud = scene.frames[view].cloud;
    const Eigen::Vector3d sampled =
        scene.T_scene_camera[view] * cloud.point(shell.point_index - view * first).cast<double>();
    EXPECT_LT((sampled - shell.centroid).norm(), 0.1);
    EXPECT_GT(shell.normal.dot(scene.T_scene_camera[view].translation() - shell.centroid), 0.0)
        << "the normal points to the sensor that saw the sample";
  }
  EXPECT_GT(of_first, 20U);
  EXPECT_GT(result.shells.size() - of_first, 20U);
}

TEST(SeveralViews, SampleAlsoThoseThatAreNoRangeImages)
{
  SeenScene scene(makeScene("table", 1), {0.0, 180.0});
  scene.frames[1].cloud = unorganized(scene.frames[1].cloud);
  const Localization result = localizeViews(Config(), scene.views(2));
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_EQ(result.warnings[0].rfind("view 2: ", 0), 0U) << result.warnings[0];
  const std::size_t first = scene.frames[0].cloud.size();
  const auto of_first = std::count_if(result.shells.begin(), result.shells.end(),
                                      [&](const Shell& shell) { return shell.point_index < first; });
  EXPECT_GT(of_first, 10);
  EXPECT_GT(result.shells.size() - of_first, 10U);
}

/// Each view has a sensor of its own.
TEST(SeveralViews, HaveNormalsWhereTheSensorIsKnown)
{
  SeenScene scene(makeScene("table", 1), {0.0, 180.0});
  scene.frames[1].cloud = unorganized(scene.frames[1].cloud);
  scene.frames[1].cloud.sensor_origin.reset();
  const Localization result = localizeViews(Config(), scene.views(2));
  ASSERT_EQ(result.warnings.size(), 2U);
  EXPECT_EQ(result.warnings[1].rfind("view 2: the place of the sensor is not known", 0), 0U) << result.warnings[1];
  const std::size_t first = scene.frames[0].cloud.size();
  std::size_t without = 0;
  for (const Shell& shell : result.shells) {
    EXPECT_EQ(shell.normal.allFinite(), shell.point_index < first);
    without += shell.normal.allFinite() ? 0 : 1;
  }
  EXPECT_GT(without, 10U);
  EXPECT_LT(without, result.shells.size());
  for (const GraspHandle& handle : result.handles) {
    const bool any_known = std::any_of(handle.shells.begin(), handle.shells.end(),
                                       [&](std::uint32_t i) { return result.shells[i].normal.allFinite(); });
    EXPECT_EQ(handle.normal.allFinite(), any_known);
    EXPECT_TRUE(!any_known || std::abs(handle.normal.norm() - 1.0) < 1e-9);
    for (const GraspPose& hand : handle.hand_poses) {
      EXPECT_TRUE(hand.pose.matrix().allFinite());
    }
  }
}

class EverySplit : public testing::TestWithParam<std::tuple<Estimator, NeighborhoodKind>>
{
};

/// A cloud without pixels, cut at random into three, each of which is given in a frame of its own: the union is the
/// cloud, up to rounding.
TEST_P(EverySplit, IsTheWholeCloud)
{
  Random random(7);
  Points points = cylinderPoints(0.02, M_PI, 0.15, 6000, random, 0.0003);
  const Points bar = cylinderPoints(0.012, M_PI, 0.15, 6000, random, 0.0003);
  for (const Eigen::Vector3d& p : bar) {
    points.emplace_back(p.z() + 0.02, p.y(), p.x() + 0.14);
  }
  for (Eigen::Vector3d& p : points) {
    p += Eigen::Vector3d(0.0, 0.6, 0.0);
  }
  std::vector<Points> parts(3);
  for (const Eigen::Vector3d& p : points) {
    parts[static_cast<std::size_t>(random.uniform(0.0, 3.0))].push_back(p);
  }
  Points in_turn;
  std::vector<Cloud> clouds;
  std::vector<PosedCloud> views;
  const std::vector<Pose> poses = {Pose::Identity(), somePose(),
                                   somePose().inverse() * Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitY())};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    in_turn.insert(in_turn.end(), parts[i].begin(), parts[i].end());
    clouds.push_back(moved(cloudOf(parts[i]), poses[i].inverse()));
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    views.push_back({&clouds[i], poses[i]});
  }

  Config config;
  std::tie(config.estimation.estimator, config.neighborhood.kind) = GetParam();
  config.sampling.samples = 300;
  config.sampling.importance = false;  // it goes by places, which are counted from the first sample on
  const Localization whole = Localizer(config).localize(cloudOf(in_turn));
  const Localization joined = localizeViews(config, views);
  ASSERT_GT(whole.shells.size(), 50U);
  EXPECT_EQ(joined.points, whole.points);

  std::vector<double> angles;
  for (const Shell& shell : whole.shells) {
    const auto twin = std::find_if(joined.shells.begin(), joined.shells.end(),
                                   [&](const Shell& other) { return other.point_index == shell.point_index; });
    if (twin != joined.shells.end()) {
      angles.push_back(lineAngle(twin->axis, shell.axis));
    }
  }
  EXPECT_GE(angles.size(), 0.9 * static_cast<double>(whole.shells.size()));
  // Exactly the same points decide on the axis of PCA. Curvature is taken at others of them, normals are those of each
  // cloud for itself, and where points stand for a nearly round patch a single one may turn the axis.
  const bool same_points =
      config.estimation.estimator == Estimator::pca && config.neighborhood.kind == NeighborhoodKind::radius;
  EXPECT_LT(quantile(angles, 0.5), same_points ? 1e-6 : 0.01);
  EXPECT_LT(quantile(angles, 0.8), same_points ? 1e-6 : 0.1);
}

INSTANTIATE_TEST_SUITE_P(Variations, EverySplit,
                         testing::Combine(testing::Values(Estimator::taubin, Estimator::pca, Estimator::normals),
                                          testing::Values(NeighborhoodKind::radius, NeighborhoodKind::knn)));

TEST(SeveralViews, GoOnWithoutThoseThatMeasuredNothing)
{
  const Cloud cloud = captureScene("table", 1).cloud;
  Cloud nothing;
  nothing.reset(640, 480);
  Config config;
  config.sampling.samples = 300;
  const Localization alone = Localizer(config).localize(cloud);
  for (const bool nothing_first : {false, true}) {
    std::vector<PosedCloud> views = {{&cloud, Pose::Identity()}, {&nothing, somePose()}};
    if (nothing_first) {
      std::swap(views[0], views[1]);
    }
    const Localization result = localizeViews(config, views);
    EXPECT_EQ(result.counts, alone.counts);
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_NE(result.warnings[0].find(nothing_first ? "view 1" : "view 2"), std::string::npos) << result.warnings[0];
    ASSERT_EQ(result.shells.size(), alone.shells.size());
    for (std::size_t i = 0; i < result.shells.size(); ++i) {
      EXPECT_EQ(result.shells[i].point_index, alone.shells[i].point_index + (nothing_first ? 640 * 480 : 0));
    }
  }
  Pose nowhere = Pose::Identity();
  config.neighborhood.kind = NeighborhoodKind::knn;
  for (const double far : {std::nan(""), HUGE_VAL, 1e308}) {
    nowhere.translation() = Eigen::Vector3d(far, far, far);
    const Localization posed = localizeViews(config, {{&cloud, Pose::Identity()}, {&cloud, nowhere}});
    EXPECT_EQ(posed.counts, Localizer(config).localize(cloud).counts);
    ASSERT_EQ(posed.warnings.size(), 1U);
    EXPECT_EQ(posed.warnings[0], "view 2: its pose is not finite in single precision");
  }

  const Localization none = localizeViews(config, {{&nothing, Pose::Identity()}, {&nothing, somePose()}});
  EXPECT_EQ(none.sampled, 0U);
  EXPECT_EQ(none.warnings.size(), 2U);
  EXPECT_EQ(localizeViews(config, {}).sampled, 0U);
}

TEST(SeveralViews, SayByHowMuchTheirPosesAreWrong)
{
  const SeenScene scene(makeScene("kitchen1", 1), {0.0, 30.0, -30.0});
  Config config;
  config.sampling.samples = 10;
  std::vector<PosedCloud> views = scene.views(3);
  const Localization right = localizeViews(config, views);
  EXPECT_LT(right.view_disagreement, 0.005);
  EXPECT_TRUE(right.warnings.empty());

  views[1].T_common_cloud.translation().x() += 0.03;
  const Localization wrong = localizeViews(config, views);
  EXPECT_NEAR(wrong.view_disagreement, 0.03, 0.012);
  ASSERT_EQ(wrong.warnings.size(), 2U);
  EXPECT_EQ(wrong.warnings[0].rfind("views 1 and 2 place the same surfaces", 0), 0U) << wrong.warnings[0];
  EXPECT_EQ(wrong.warnings[1].rfind("views 2 and 3 place the same surfaces", 0), 0U) << wrong.warnings[1];
}

}  // namespace
}  // namespace grasp_affordances::test
