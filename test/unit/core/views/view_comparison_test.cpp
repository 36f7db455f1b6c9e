#include "core/views/view_comparison.h"

#include "simulation/camera_orbit.h"
#include "simulation/placement.h"
#include "simulation/scene_library.h"
#include "simulation/sensor.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances
{
namespace
{

const std::vector<std::string> kPaperScenes = {"mugs",       "cleaning1", "kitchen1", "cleaning2", "household1",
                                               "household2", "kitchen2",  "kitchen3", "luggage",   "cleaning3"};

SensorModel exactModel()
{
  SensorModel model;
  model.exact = true;
  return model;
}

/// A wall that faces the camera, at a depth (m).
Cloud wall(float depth)
{
  const PinholeIntrinsics camera = SensorModel().intrinsics;
  Cloud cloud;
  cloud.reset(640, 480);
  for (std::uint32_t v = 0; v < cloud.height; ++v) {
    for (std::uint32_t u = 0; u < cloud.width; ++u) {
      cloud.set(std::size_t{v} * cloud.width + u, static_cast<float>((u - camera.cx) / camera.fx) * depth,
                static_cast<float>((v - camera.cy) / camera.fy) * depth, depth);
    }
  }
  return cloud;
}

/// One scene by two cameras, and their true relative pose.
class TwoViews
{
public:
  /// @param angle rad, by which the second camera is turned about the vertical
  TwoViews(const View& view, double angle, const SensorModel& model = SensorModel())
      : first_(view),
        second_(viewFromAside(view, angle)),
        frames_{DepthCamera(model).capture(view.scene, first_.T_scene_camera, 1),
                DepthCamera(model).capture(view.scene, second_.T_scene_camera, 2)}
  {
    for (int i = 0; i < 2; ++i) {
      std::string warning;
      images_[i] = RangeImage::create(frames_[i].cloud, warning);
    }
  }

  /// What is reported where the second camera is thought to be moved so in the scene.
  double disagreement(ViewAgreement& agreement, const Eigen::Isometry3d& error = Eigen::Isometry3d::Identity()) const
  {
    return agreement.disagreement(*images_[0], *images_[1],
                                  first_.T_scene_camera.inverse() * error * second_.T_scene_camera);
  }

  double disagreement(const Eigen::Isometry3d& error = Eigen::Isometry3d::Identity()) const
  {
    ViewAgreement agreement;
    return disagreement(agreement, error);
  }

  /// The same for ViewComparison, which is to call the views 2 and 5.
  std::vector<ComparedView> compared(const Eigen::Isometry3d& error = Eigen::Isometry3d::Identity()) const
  {
    return {{2, &*images_[0], first_.T_scene_camera}, {5, &*images_[1], error * second_.T_scene_camera}};
  }

  /// About an axis through a point that both cameras have in front of them.
  Eigen::Isometry3d turn(double angle, const Eigen::Vector3d& axis) const
  {
    const Eigen::Translation3d T_scene_middle(first_.T_scene_camera * Eigen::Vector3d(0.0, 0.0, 0.8));
    return T_scene_middle * turned(angle, axis) * T_scene_middle.inverse();
  }

private:
  View first_, second_;
  Frame frames_[2];
  std::optional<RangeImage> images_[2];
};

/// Seen from 0.8 m, from 40 degrees above the horizontal.
View viewOf(const Scene& scene)
{
  const Eigen::Vector3d middle(0.0, 0.0, 0.05);
  return {scene, lookAt(middle + 0.8 * Eigen::Vector3d(0.0, -std::cos(40 * kDegree), std::sin(40 * kDegree)), middle)};
}

Scene plane()
{
  Scene scene;
  scene.beginObject("table");
  scene.add(Box{{3.0, 3.0, 0.1}}, at(0, 0, -0.05));
  return scene;
}

View boxesOnPlane()
{
  Scene scene = plane();
  scene.beginObject("boxes");
  scene.add(Box{{0.15, 0.10, 0.12}}, upright(-0.12, 0.05, 0.5) * at(0, 0, 0.06));
  scene.add(Box{{0.08, 0.20, 0.16}}, upright(0.14, 0.0, -0.3) * at(0, 0, 0.08));
  scene.add(Box{{0.10, 0.10, 0.06}}, upright(0.0, -0.15, 0.8) * at(0, 0, 0.03));
  return viewOf(scene);
}

TEST(ViewAgreementTest, measuresTheErrorOfAPoseExactly)
{
  const TwoViews views(boxesOnPlane(), 35 * kDegree, exactModel());
  EXPECT_LT(views.disagreement(), 0.0005);
  for (const Eigen::Vector3d& direction : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1),
                                           Eigen::Vector3d(0.6, -0.64, 0.48)}) {
    for (const double error : {-0.03, 0.01, 0.03}) {
      SCOPED_TRACE(testing::Message() << direction.transpose() << " times " << error);
      EXPECT_NEAR(views.disagreement(Eigen::Isometry3d(Eigen::Translation3d(error * direction))), std::abs(error),
                  0.001);
    }
  }
}

TEST(ViewAgreementTest, takesForRightWhatASinglePlaneDoesNotTell)
{
  for (const bool exact : {true, false}) {
    SCOPED_TRACE(exact ? "exact" : "with noise");
    const TwoViews views(viewOf(plane()), 40 * kDegree, exact ? exactModel() : SensorModel());
    EXPECT_LT(views.disagreement(), 0.002);
    EXPECT_LT(views.disagreement(at(0.03, 0, 0)), 0.002);
    EXPECT_LT(views.disagreement(at(0, 0.03, 0)), 0.002);
    EXPECT_LT(views.disagreement(views.turn(3 * kDegree, Eigen::Vector3d::UnitZ())), 0.002);
    EXPECT_NEAR(views.disagreement(at(0, 0, 0.03)), 0.03, 0.001);
    EXPECT_NEAR(views.disagreement(at(0.03, 0, -0.02)), 0.02, 0.001);
  }
}

TEST(ViewAgreementTest, isNotANumberForViewsWithNothingInCommon)
{
  const TwoViews views(boxesOnPlane(), 35 * kDegree);
  EXPECT_TRUE(std::isnan(views.disagreement(at(0, 0, 0.5)))) << "surfaces 50 cm apart are not the same";
  EXPECT_TRUE(std::isnan(views.disagreement(at(10, 0, 0))));
  EXPECT_TRUE(std::isnan(views.disagreement(turned(kPi, Eigen::Vector3d::UnitX())))) << "seen from opposite sides";
  EXPECT_TRUE(std::isnan(views.disagreement(at(std::numeric_limits<double>::quiet_NaN(), 0, 0))));
}

/// As of things beyond the range in which elements of surfaces are compared.
TEST(ViewAgreementTest, isNotANumberForViewsWithoutASurface)
{
  const Cloud far = wall(6.0F);
  std::string warning;
  const auto image = RangeImage::create(far, warning);
  ASSERT_TRUE(image) << warning;
  ViewAgreement agreement;
  EXPECT_TRUE(std::isnan(agreement.disagreement(*image, *image, Eigen::Isometry3d::Identity())));
}

TEST(ViewAgreementTest, dependsOnTheViewsAlone)
{
  const TwoViews views(boxesOnPlane(), 35 * kDegree), others(viewOf(plane()), 60 * kDegree);
  const double expected = views.disagreement(at(0.02, 0, 0));
  ViewAgreement agreement;
  others.disagreement(agreement);
  EXPECT_EQ(views.disagreement(agreement, at(0.02, 0, 0)), expected);
  EXPECT_EQ(views.disagreement(agreement, at(0.02, 0, 0)), expected);
}

TEST(ViewComparisonTest, warnsOfPairsWhosePosesAreWrong)
{
  const TwoViews views(boxesOnPlane(), 35 * kDegree);
  const Eigen::Isometry3d error = at(0.03, 0, 0);
  ThreadTeam team(2);
  ViewComparison comparison;
  comparison.compare(views.compared(error), team);
  EXPECT_NEAR(comparison.disagreement(), views.disagreement(error), 1e-6);
  ASSERT_EQ(comparison.warnings().size(), 1U);
  EXPECT_EQ(comparison.warnings()[0].rfind("views 2 and 5 place the same surfaces ", 0), 0U)
      << comparison.warnings()[0];

  comparison.compare(views.compared(), team);
  EXPECT_LT(comparison.disagreement(), 0.005);
  EXPECT_TRUE(comparison.warnings().empty()) << "of the views before";
}

TEST(ViewComparisonTest, leavesOutViewsWithoutARangeImage)
{
  const TwoViews views(boxesOnPlane(), 35 * kDegree);
  ThreadTeam team(1);
  ViewComparison comparison;
  std::vector<ComparedView> compared = views.compared();
  comparison.compare(compared, team);
  const double expected = comparison.disagreement();
  compared.insert(compared.begin(), {1, nullptr, Eigen::Isometry3d::Identity()});
  comparison.compare(compared, team);
  EXPECT_EQ(comparison.disagreement(), expected);
  compared.pop_back();
  comparison.compare(compared, team);
  EXPECT_TRUE(std::isnan(comparison.disagreement()));
  comparison.compare({}, team);
  EXPECT_TRUE(std::isnan(comparison.disagreement()));
}

/// The sensor's noise, objects of which the views show different sides, and little else that two views share.
class SceneAgreementTest : public testing::TestWithParam<std::string>
{
};

TEST_P(SceneAgreementTest, tellsAWrongPoseFromATrueOne)
{
  ViewAgreement agreement;
  const View view = makeScene(GetParam(), 1);
  // The farther apart the cameras, the less surface they share: most of it is the table at 90 degrees.
  for (const auto& [degrees, largest_of_true_pose] : {std::make_pair(30.0, 0.005), {60.0, 0.005}, {90.0, 0.010}}) {
    const TwoViews views(view, degrees * kDegree);
    SCOPED_TRACE(testing::Message() << degrees << " degrees");
    EXPECT_LT(views.disagreement(agreement), largest_of_true_pose);
    for (const double sign : {-1.0, 1.0}) {
      for (int axis = 0; axis < 3; ++axis) {
        SCOPED_TRACE(testing::Message() << (sign > 0 ? '+' : '-') << "xyz"[axis]);
        const Eigen::Vector3d direction = sign * Eigen::Vector3d::Unit(axis);
        EXPECT_GT(views.disagreement(agreement, Eigen::Isometry3d(Eigen::Translation3d(0.03 * direction))), 0.017);
        EXPECT_GT(views.disagreement(agreement, views.turn(3.0 * kDegree, direction)), 0.008);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Paper, SceneAgreementTest, testing::ValuesIn(kPaperScenes),
                         [](const testing::TestParamInfo<std::string>& scene) { return scene.param; });

}  // namespace
}  // namespace grasp_affordances
