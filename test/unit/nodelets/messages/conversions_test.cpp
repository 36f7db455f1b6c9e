#include "nodelets/messages/conversions.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <stdexcept>

namespace grasp_affordances
{
namespace
{

Shell tiltedShell()
{
  Shell shell;
  shell.centroid = {0.1, -0.2, 0.7};
  shell.axis = Eigen::Vector3d(0.2, 0.9, 0.3).normalized();
  shell.normal = shell.axis.cross(Eigen::Vector3d(1.0, 0.1, 0.0)).normalized();
  shell.inner_radius = 0.021;
  shell.thickness = 0.008;
  shell.length = 0.045;
  shell.curvature = std::nan("");
  shell.observed_free = 0.4;
  shell.points_inside = 321;
  shell.points_in_gap = 2;
  shell.point_index = 123456;
  return shell;
}

TEST(PoseMessage, OriginOnTheAxisZAlongTheAxisXAlongTheNormal)
{
  const Shell shell = tiltedShell();
  const geometry_msgs::Pose pose = poseMessage(shell);
  const Eigen::Quaterniond orientation(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);

  EXPECT_NEAR(orientation.norm(), 1.0, 1e-12);
  EXPECT_TRUE((orientation * Eigen::Vector3d::UnitZ()).isApprox(shell.axis, 1e-12));
  EXPECT_TRUE((orientation * Eigen::Vector3d::UnitX()).isApprox(shell.normal, 1e-12));
  EXPECT_EQ(pose.position.x, 0.1);
  EXPECT_EQ(pose.position.y, -0.2);
  EXPECT_EQ(pose.position.z, 0.7);
}

TEST(PoseMessage, WithoutANormalIsAPoseNevertheless)
{
  Shell shell = tiltedShell();
  shell.normal.setConstant(std::nan(""));
  const geometry_msgs::Pose pose = poseMessage(shell);
  const Eigen::Quaterniond orientation(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
  EXPECT_NEAR(orientation.norm(), 1.0, 1e-12);
  EXPECT_TRUE((orientation * Eigen::Vector3d::UnitZ()).isApprox(shell.axis, 1e-12));

  GraspHandle handle;
  handle.axis = shell.axis;
  handle.normal = shell.normal;
  const Handle message = handleMessage(handle, std_msgs::Header());
  EXPECT_EQ(message.pose.orientation, pose.orientation);
  EXPECT_TRUE(std::isnan(message.normal.x) && std::isnan(message.normal.y) && std::isnan(message.normal.z));
}

TEST(ShellsMessage, CarriesEveryFieldUnderTheHeaderOfTheCloud)
{
  Localization localization;
  localization.shells = {Shell(), tiltedShell()};
  std_msgs::Header header;
  header.frame_id = "optical";
  header.stamp = ros::Time(12, 34);

  const CylindricalShellArray message = shellsMessage(localization, header);
  EXPECT_EQ(message.header.frame_id, "optical");
  EXPECT_EQ(message.header.stamp, ros::Time(12, 34));
  ASSERT_EQ(message.shells.size(), 2U);
  const Shell shell = tiltedShell();
  const CylindricalShell& sent = message.shells[1];
  EXPECT_EQ(Eigen::Vector3d(sent.centroid.x, sent.centroid.y, sent.centroid.z), shell.centroid);
  EXPECT_EQ(Eigen::Vector3d(sent.axis.x, sent.axis.y, sent.axis.z), shell.axis);
  EXPECT_EQ(Eigen::Vector3d(sent.normal.x, sent.normal.y, sent.normal.z), shell.normal);
  EXPECT_EQ(sent.inner_radius, 0.021);
  EXPECT_EQ(sent.thickness, 0.008);
  EXPECT_EQ(sent.length, 0.045);
  EXPECT_TRUE(std::isnan(sent.curvature));
  EXPECT_EQ(sent.observed_free, 0.4);
  EXPECT_EQ(sent.points_inside, 321U);
  EXPECT_EQ(sent.points_in_gap, 2U);
  EXPECT_EQ(sent.point_index, 123456U);
}

TEST(StatisticsMessage, NamesEveryOutcome)
{
  Localization localization;
  for (std::size_t outcome = 0; outcome < kOutcomes; ++outcome) {
    localization.counts[outcome] = 10 + static_cast<std::uint32_t>(outcome);
  }
  localization.sampled = 165;
  localization.points = 1000;
  localization.view_disagreement = 0.004;
  localization.threads = 3;
  localization.milliseconds.total = 1.5;
  localization.milliseconds.preparation = 0.1;
  localization.milliseconds.neighborhoods = 0.2;
  localization.milliseconds.occlusion = 0.3;
  localization.milliseconds.fit = 0.5;
  localization.milliseconds.shell = 0.4;
  localization.warnings = {"a warning"};
  Config config = presetConfig("paper");
  config.estimation.estimator = Estimator::normals;
  config.sampling.seed = 7;

  const LocalizationStatistics message = statisticsMessage(localization, config, std_msgs::Header());
  EXPECT_EQ(message.preset, "paper");
  EXPECT_EQ(message.estimator, "normals");
  EXPECT_EQ(message.seed, 7U);
  EXPECT_EQ(message.threads, 3U);
  EXPECT_EQ(message.points, 1000U);
  EXPECT_EQ(message.view_disagreement, 0.004);
  EXPECT_EQ(message.sampled, 165U);
  EXPECT_EQ(message.too_few_points, 10U);
  EXPECT_EQ(message.degenerate, 11U);
  EXPECT_EQ(message.occluded, 12U);
  EXPECT_EQ(message.low_curvature, 13U);
  EXPECT_EQ(message.concave, 14U);
  EXPECT_EQ(message.no_shell, 15U);
  EXPECT_EQ(message.too_short, 16U);
  EXPECT_EQ(message.unobserved_gap, 17U);
  EXPECT_EQ(message.uncovered, 18U);
  EXPECT_EQ(message.out_of_time, 19U);
  EXPECT_EQ(message.shells, 20U);
  EXPECT_NE(message.explanation.find("of 165 samples 19"), std::string::npos) << message.explanation;
  EXPECT_EQ(message.milliseconds_total, 1.5);
  EXPECT_EQ(message.milliseconds_preparation, 0.1);
  EXPECT_EQ(message.milliseconds_neighborhoods, 0.2);
  EXPECT_EQ(message.milliseconds_occlusion, 0.3);
  EXPECT_EQ(message.milliseconds_fit, 0.5);
  EXPECT_EQ(message.milliseconds_shell, 0.4);
  ASSERT_EQ(message.warnings.size(), 1U);
  EXPECT_EQ(message.warnings[0], "a warning");
}

sensor_msgs::CameraInfo xtion()
{
  sensor_msgs::CameraInfo camera;
  camera.width = 640;
  camera.height = 480;
  camera.P = {570.0, 0.0, 314.0, 0.0, 0.0, 571.0, 239.0, 0.0, 0.0, 0.0, 1.0, 0.0};
  return camera;
}

TEST(IntrinsicsFromCameraInfo, TakesTheProjectionMatrix)
{
  const PinholeIntrinsics intrinsics = intrinsicsFromCameraInfo(xtion(), 640, 480);
  EXPECT_EQ(intrinsics.fx, 570.0);
  EXPECT_EQ(intrinsics.fy, 571.0);
  EXPECT_EQ(intrinsics.cx, 314.0);
  EXPECT_EQ(intrinsics.cy, 239.0);
}

// A point must land on the pixel of the binned region that its full resolution pixel has become.
TEST(IntrinsicsFromCameraInfo, FollowsRegionOfInterestAndBinning)
{
  sensor_msgs::CameraInfo camera = xtion();
  camera.roi.x_offset = 100;
  camera.roi.y_offset = 40;
  camera.roi.width = 320;
  camera.roi.height = 240;
  camera.binning_x = 2;
  camera.binning_y = 4;
  const PinholeIntrinsics intrinsics = intrinsicsFromCameraInfo(camera, 160, 60);

  const double x = 0.1;
  const double y = 0.05;
  const double z = 0.8;
  const double u = 570.0 * x / z + 314.0;
  const double v = 571.0 * y / z + 239.0;
  EXPECT_NEAR(intrinsics.fx * x / z + intrinsics.cx, (u - 100.0) / 2.0, 1e-9);
  EXPECT_NEAR(intrinsics.fy * y / z + intrinsics.cy, (v - 40.0) / 4.0, 1e-9);
}

TEST(IntrinsicsFromCameraInfo, RefusesAnotherImageSize)
{
  sensor_msgs::CameraInfo camera = xtion();
  EXPECT_THROW(intrinsicsFromCameraInfo(camera, 320, 240), std::invalid_argument);
  camera.binning_x = 2;
  EXPECT_THROW(intrinsicsFromCameraInfo(camera, 640, 480), std::invalid_argument);
  EXPECT_NO_THROW(intrinsicsFromCameraInfo(camera, 320, 480));
}

TEST(IntrinsicsFromCameraInfo, RefusesAnUncalibratedCamera)
{
  sensor_msgs::CameraInfo camera = xtion();
  camera.P.fill(0.0);
  EXPECT_THROW(intrinsicsFromCameraInfo(camera, 640, 480), std::invalid_argument);
}

}  // namespace
}  // namespace grasp_affordances
