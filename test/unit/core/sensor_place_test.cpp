#include "grasp_affordances/localizer.h"
#include "simulation/placement.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"
#include "support/points.h"
#include "support/shells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// Clouds that are no range images: in the frame of a robot's base, merged, or of an object model. What is decided there
// must not depend on where the origin happens to be.
namespace grasp_affordances::test
{
namespace
{

/// Where a robot's base stands, in the frame of a scene: its origin is in the middle of the table's top, z points up.
const std::vector<std::pair<std::string, Eigen::Vector3d>> kBases{{"on the camera's side", {0.0, -0.6, 0.0}},
                                                                  {"there, on the floor", {0.0, -0.6, -0.75}},
                                                                  {"beside the table", {0.8, 0.0, 0.0}},
                                                                  {"opposite", {0.0, 0.9, 0.0}}};

/// A scene of the library as its camera sees it, as points without rows.
struct SeenScene
{
  explicit SeenScene(const std::string& name)
      : view(makeScene(name, 1)),
        points(unorganized(DepthCamera().capture(view.scene, view.T_scene_camera, 1).cloud)),
        handles(Localizer().localize(points).handles.size())
  {
  }

  /// In the frame of a base, with the place of the sensor.
  Cloud seenBy(const Eigen::Vector3d& base) const
  {
    return moved(points, Eigen::Translation3d(-base) * view.T_scene_camera);
  }

  View view;
  Cloud points;
  std::size_t handles;  // that are found in the camera's frame, where the sensor's place is known
};

std::uint32_t count(const Localization& result, Outcome outcome)
{
  return result.counts[static_cast<std::size_t>(outcome)];
}

bool isNaN(const Eigen::Vector3d& vector)
{
  return vector.array().isNaN().all();
}

/// Expects that nothing was judged by where the sensor is.
void expectUnsided(const Localization& result)
{
  EXPECT_EQ(count(result, Outcome::concave), 0U);
  EXPECT_EQ(count(result, Outcome::occluded), 0U);
  for (const Shell& shell : result.shells) {
    EXPECT_TRUE(isNaN(shell.normal));
    EXPECT_TRUE(shell.centroid.allFinite());
    EXPECT_NEAR(shell.axis.norm(), 1.0, 1e-9);
  }
  for (const GraspHandle& handle : result.handles) {
    EXPECT_TRUE(isNaN(handle.normal));
    EXPECT_TRUE(handle.centroid.allFinite());
    EXPECT_TRUE(std::isfinite(handle.radius));
    EXPECT_TRUE(handle.score > 0.0 && handle.score <= 1.0) << handle.score;
    for (const GraspPose& hand : handle.hand_poses) {
      EXPECT_TRUE(hand.pose.matrix().allFinite());
      EXPECT_NEAR(hand.pose.linear().determinant(), 1.0, 1e-9);
      EXPECT_TRUE(hand.score >= 0.0 && hand.score <= 1.0) << hand.score;
    }
  }
}

/// The warning about the sensor's place, which comes once.
void expectToldOnce(const Localization& result)
{
  std::size_t told = 0;
  for (const std::string& warning : result.warnings) {
    if (warning.find("the place of the sensor is not known") != std::string::npos) {
      ++told;
      for (const char* part : {"concave", "normals", "~sensor_frame", "--viewpoint", "VIEWPOINT", "sensor_origin"}) {
        EXPECT_NE(warning.find(part), std::string::npos) << part << ": " << warning;
      }
    }
  }
  EXPECT_EQ(told, 1U);
}

class SensorPlace : public testing::TestWithParam<const char*>
{
};

TEST_P(SensorPlace, GivenFindsTheSameHandlesInEveryFrame)
{
  const SeenScene scene(GetParam());
  ASSERT_GE(scene.handles, 3U);
  for (const auto& [place, base] : kBases) {
    SCOPED_TRACE(place);
    const Cloud cloud = scene.seenBy(base);
    const Localization result = Localizer().localize(cloud);
    EXPECT_EQ(result.handles.size(), scene.handles);
    EXPECT_GT(count(result, Outcome::concave), 0U);
    EXPECT_EQ(result.warnings.size(), 1U) << "that it is not organized";
    for (const GraspHandle& handle : result.handles) {
      EXPECT_GT(handle.normal.dot(cloud.sensor_origin->cast<double>() - handle.centroid), 0.0);
    }
  }
}

TEST_P(SensorPlace, UnknownFindsTheHandlesInEveryFrame)
{
  const SeenScene scene(GetParam());
  for (const auto& [place, base] : kBases) {
    SCOPED_TRACE(place);
    Cloud cloud = scene.seenBy(base);
    cloud.sensor_origin.reset();
    const Localization result = Localizer().localize(cloud);
    EXPECT_GE(result.handles.size(), scene.handles);
    expectUnsided(result);
    expectToldOnce(result);
    std::size_t hand_poses = 0;
    for (const GraspHandle& handle : result.handles) {
      hand_poses += handle.hand_poses.size();
    }
    EXPECT_GT(hand_poses, 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SensorPlace, testing::Values("table", "mugs"),
                         [](const testing::TestParamInfo<const char*>& info) { return std::string(info.param); });

/// Coordinates on a grid are moved along it without rounding.
TEST(UnknownSensorPlace, GivesTheSameCountsWhereverTheOriginIs)
{
  constexpr double kGrid = 0x1p-16;  // m
  const SeenScene scene("table");
  Cloud here = scene.seenBy(Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < here.size(); ++i) {
    const Eigen::Vector3d point = (here.point(i).cast<double>() / kGrid).array().round() * kGrid;
    const Eigen::Vector3f rounded = point.cast<float>();
    here.set(i, rounded.x(), rounded.y(), rounded.z());
  }
  Cloud there = moved(here, Eigen::Isometry3d(Eigen::Translation3d(0.25, -1.5, 0.75)));
  here.sensor_origin.reset();
  there.sensor_origin.reset();
  Config config;
  config.sampling.importance = false;           // it draws neighbors, and curvature is taken at some of them,
  config.estimation.curvature_points = 10'000;  // whose order may depend on the search tree
  const Localization at_home = Localizer(config).localize(here), elsewhere = Localizer(config).localize(there);
  EXPECT_EQ(elsewhere.counts, at_home.counts);
  EXPECT_GT(at_home.shells.size(), 20U);
  EXPECT_EQ(elsewhere.handles.size(), at_home.handles.size());
}

TEST(UnknownSensorPlace, OfAnObjectModelThatIsCentredOnTheOrigin)
{
  Random random(5);
  const Cloud with_sensor_inside = cloudOf(cylinderPoints(0.012, 2.0 * M_PI, 0.12, 8000, random, 0.0002));
  EXPECT_TRUE(Localizer().localize(with_sensor_inside).handles.empty()) << "all of it is concave from there";
  Cloud model = with_sensor_inside;
  model.sensor_origin.reset();
  const Localization result = Localizer().localize(model);
  expectUnsided(result);
  expectToldOnce(result);
  ASSERT_FALSE(result.handles.empty());
  const GraspHandle& handle = result.handles.front();
  EXPECT_LT(lineAngle(handle.axis, Eigen::Vector3d::UnitZ()), 0.05);
  EXPECT_LT(handle.centroid.head<2>().norm(), 0.002);
  EXPECT_NEAR(handle.radius, 0.012, 0.001);
}

TEST(UnknownSensorPlace, IsOneThatIsNotFinite)
{
  Cloud cloud = SeenScene("table").seenBy({0.8, 0.0, 0.0});
  Config config;
  config.sampling.samples = 500;
  cloud.sensor_origin.reset();
  const Localization expected = Localizer(config).localize(cloud);
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    cloud.sensor_origin = Eigen::Vector3f(0.0F, value, 0.0F);
    const Localization result = Localizer(config).localize(cloud);
    EXPECT_EQ(result.counts, expected.counts);
    EXPECT_EQ(result.warnings, expected.warnings);
    expectUnsided(result);
  }
}

/// Concavity and normals are all that is left out: the variations and the paper's preset go on, too.
TEST(UnknownSensorPlace, IsToldByEveryEstimator)
{
  Cloud cloud = SeenScene("table").seenBy({0.0, 0.9, 0.0});
  cloud.sensor_origin.reset();
  for (const Estimator estimator : {Estimator::taubin, Estimator::pca, Estimator::normals}) {
    Config config;
    config.estimation.estimator = estimator;
    config.sampling.samples = 500;
    const Localization result = Localizer(config).localize(cloud);
    EXPECT_GT(result.shells.size(), 0U);
    expectUnsided(result);
    expectToldOnce(result);
  }
}

TEST(KnownSensorPlace, OfARangeImageIsItsOrigin)
{
  const View view = makeScene("table", 1);
  Cloud cloud = DepthCamera().capture(view.scene, view.T_scene_camera, 1).cloud;
  Config config;
  config.sampling.samples = 500;
  const Localization expected = Localizer(config).localize(cloud);
  cloud.sensor_origin = Eigen::Vector3f(0.5F, 5.0F, 3.0F);
  const Localization result = Localizer(config).localize(cloud);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_EQ(result.counts, expected.counts);
  ASSERT_EQ(result.shells.size(), expected.shells.size());
  for (std::size_t i = 0; i < result.shells.size(); ++i) {
    EXPECT_TRUE(same(result.shells[i], expected.shells[i])) << i;
  }
}

}  // namespace
}  // namespace grasp_affordances::test
