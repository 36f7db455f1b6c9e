#include "simulation/camera_orbit.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>

namespace grasp_affordances
{
namespace
{

constexpr double kAmplitude = 0.1;  // rad
constexpr double kPeriod = 8.0;     // s
constexpr double kDistance = 0.75;  // m, of the wall

/// A slanted view of a wall; the camera's axes and those of the scene have nothing in common.
View viewOfWall()
{
  View view;
  const Eigen::Isometry3d T_scene_wall =
      Eigen::Translation3d(0.3, -0.2, 0.5) * Eigen::AngleAxisd(1.1, Eigen::Vector3d(1.0, 2.0, -0.5).normalized());
  view.scene.beginObject("wall");
  view.scene.add(Box{{2.0, 2.0, 0.2}}, T_scene_wall * Eigen::Translation3d(0.0, 0.0, -0.1));
  view.T_scene_camera = T_scene_wall * Eigen::AngleAxisd(std::acos(-1.0) + 0.4, Eigen::Vector3d::UnitX()) *
                        Eigen::Translation3d(0.0, 0.0, -kDistance);
  return view;
}

TEST(CameraOrbit, KeepsThePointLookedAtInTheMiddleAtTheSameDistance)
{
  const View view = viewOfWall();
  const CameraOrbit orbit(view, kAmplitude, kPeriod);
  const Eigen::Vector3d in_camera(0.0, 0.0, kDistance);
  const Eigen::Vector3d target = view.T_scene_camera * in_camera;
  for (double time = 0.0; time < kPeriod; time += 0.3) {
    EXPECT_NEAR((orbit.pose(time) * in_camera - target).norm(), 0.0, 1e-12) << "at " << time;
  }
}

TEST(CameraOrbit, LineOfSightDescribesACone)
{
  const View view = viewOfWall();
  const CameraOrbit orbit(view, kAmplitude, kPeriod);
  const Eigen::Matrix3d R_camera_scene = view.T_scene_camera.linear().transpose();
  const auto lineOfSight = [&](double time) -> Eigen::Vector3d {
    return R_camera_scene * orbit.pose(time).linear() * Eigen::Vector3d::UnitZ();
  };
  for (double time = 0.0; time < kPeriod; time += 0.3) {
    EXPECT_NEAR(std::acos(lineOfSight(time).z()), kAmplitude, 1e-12) << "at " << time;
  }
  // Half a turn later it is on the other side.
  EXPECT_NEAR((lineOfSight(1.0) + lineOfSight(1.0 + 0.5 * kPeriod)).head<2>().norm(), 0.0, 1e-12);
}

TEST(CameraOrbit, IsPeriodicAndSmoothAlsoFarFromTheStartOfTheEpoch)
{
  const CameraOrbit orbit(viewOfWall(), kAmplitude, kPeriod);
  const double epoch = 213000000.0 * kPeriod;  // 2024, of which a double resolves 0.24 us
  constexpr double step = 1.0 / 30.0;
  // On a circle of radius distance * sin(amplitude), at constant speed.
  const double arc = 2.0 * std::acos(-1.0) * kDistance * std::sin(kAmplitude) * step / kPeriod;
  for (double time = 0.0; time < 2.0 * kPeriod; time += step) {
    const Eigen::Vector3d here = orbit.pose(epoch + time).translation();
    EXPECT_NEAR((here - orbit.pose(time).translation()).norm(), 0.0, 1e-6) << "at " << time;
    EXPECT_NEAR((orbit.pose(epoch + time + step).translation() - here).norm(), arc, 1e-6) << "at " << time;
  }
}

TEST(CameraOrbit, StandsStillWithoutAmplitude)
{
  const View view = viewOfWall();
  EXPECT_TRUE(CameraOrbit(view, 0.0, kPeriod).pose(3.0).isApprox(view.T_scene_camera, 1e-15));
}

TEST(CameraOrbit, CirclesAboutAPointInTheVoidWhereNothingIsLookedAt)
{
  const CameraOrbit orbit(View(), kAmplitude, kPeriod);
  EXPECT_NEAR((orbit.pose(2.0) * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitZ()).norm(), 0.0, 1e-12);
}

TEST(ViewFromAside, TurnsTheCameraAboutTheVerticalThroughThePointLookedAt)
{
  const View view = viewOfWall();
  const View aside = viewFromAside(view, 1.2);
  const Eigen::Vector3d in_camera(0.0, 0.0, kDistance);
  EXPECT_NEAR((aside.T_scene_camera * in_camera - view.T_scene_camera * in_camera).norm(), 0.0, 1e-12);
  EXPECT_NEAR(aside.T_scene_camera.translation().z(), view.T_scene_camera.translation().z(), 1e-12);
  const Eigen::AngleAxisd turn(
      Eigen::Matrix3d(aside.T_scene_camera.linear() * view.T_scene_camera.linear().transpose()));
  EXPECT_NEAR(turn.angle(), 1.2, 1e-12);
  EXPECT_NEAR((turn.axis() - Eigen::Vector3d::UnitZ()).norm(), 0.0, 1e-12);
  EXPECT_EQ(aside.scene.parts().size(), view.scene.parts().size());
}

}  // namespace
}  // namespace grasp_affordances
