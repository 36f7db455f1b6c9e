#include "core/hand_poses/hand_pose_search.h"

#include "simulation/tableware.h"
#include "support/hand_poses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

TEST(HandPoses, FrontOfAFreeBarIsOpenToAHand)
{
  const Cloud cloud = capture(barInFrontOfWall(0.5));
  const GraspHandle handle = barHandle();
  const Config config;
  const std::vector<GraspPose> hands = search(cloud, config, handle);
  ASSERT_GE(hands.size(), 7U);
  const GraspPose& best = hands.front();
  EXPECT_LT((approach(best) - Vector::UnitZ()).norm(), 1e-12) << "from the sensor's side";
  EXPECT_EQ(best.observed_free, 1.0);
  EXPECT_NEAR(best.score, 1.0, 1e-12);
  for (const GraspPose& hand : hands) {
    EXPECT_EQ(hand.pose.linear().col(2), handle.axis) << "z along the axis";
    EXPECT_LT((hand.pose.linear().transpose() * hand.pose.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(hand.pose.linear().determinant(), 1.0, 1e-12);
    EXPECT_EQ(hand.pose.translation(), handle.centroid);
    EXPECT_EQ(hand.width, 2 * handle.inner_radius);
  }
  // The wall is far enough away for a hand that comes between it and the bar, on both sides.
  for (const int i : {1, 2, 3, 9, 10, 11}) {
    EXPECT_TRUE(findApproach(hands, handFrom(handle, i * M_PI / 6).linear().col(0), handle.centroid)) << i;
  }
}

TEST(HandPoses, KeepWithinTheConeOfApproach)
{
  TableTop top;
  add(top.scene, Pose::Identity(), MountedBar());
  const Cloud cloud = capture(top.scene, top.T_scene_camera);
  const GraspHandle handle =
      top.inCamera(handleAt(Vector(0.0, 0.0, 0.07), Vector::UnitX(), Vector(0.0, -0.5, 0.37), 0.0135, 0.05));
  Config config;
  config.hand_poses.approach_z = -0.5;  // from above: z of the scene points up; need not be a unit vector
  for (const double max_angle : {0.0, 0.6, 1.2}) {
    config.hand_poses.max_approach_angle = max_angle;
    const auto hands = search(cloud, config, handle, top.T_scene_camera);
    ASSERT_GT(hands.size(), 0U) << max_angle;
    for (const GraspPose& hand : hands) {
      const Vector in_scene = top.T_scene_camera.linear() * approach(hand);
      EXPECT_LE(std::acos(std::min(1.0, -in_scene.z())), max_angle + 1e-4) << max_angle;
    }
    EXPECT_NEAR((top.T_scene_camera.linear() * approach(hands.front())).z(), -1.0, 1e-9) << "straight from above";
  }
  // From below, no hand.
  config.hand_poses.approach_z = 1.0;
  EXPECT_EQ(search(cloud, config, handle, top.T_scene_camera).size(), 0U);
  // All of a ring about the direction itself are at right angles to it.
  config.hand_poses.approach_z = -1.0;
  config.hand_poses.max_approach_angle = 1.5;
  const GraspHandle upright = top.inCamera(handleAt(Vector(0, 0, 0.25), Vector::UnitZ(), -Vector::UnitY(), 0.01, 0.05));
  EXPECT_EQ(search(cloud, config, upright, top.T_scene_camera).size(), 0U);
  config.hand_poses.max_approach_angle = 1.6;
  EXPECT_GT(search(cloud, config, upright, top.T_scene_camera).size(), 0U);
}

TEST(HandPoses, AreThoseOfTheTool)
{
  const Cloud cloud = capture(barInFrontOfWall(0.5));
  Config config;
  const auto hands = search(cloud, config, barHandle());
  config.hand_poses.tool_x = -0.18;
  config.hand_poses.tool_y = 0.01;
  config.hand_poses.tool_z = 0.02;
  config.hand_poses.tool_roll = 0.3;
  config.hand_poses.tool_pitch = -0.4;
  config.hand_poses.tool_yaw = 1.2;
  const auto tools = search(cloud, config, barHandle());
  // Roll, pitch and yaw about fixed axes, as in URDF: the columns of Rz(yaw) Ry(pitch) Rx(roll), written out.
  const double cr = std::cos(0.3), sr = std::sin(0.3), cp = std::cos(-0.4), sp = std::sin(-0.4), cy = std::cos(1.2),
               sy = std::sin(1.2);
  Pose T_hand_tool = at(-0.18, 0.01, 0.02);
  T_hand_tool.linear() << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,                      //
      -sp, cp * sr, cp * cr;
  ASSERT_EQ(tools.size(), hands.size());
  for (std::size_t i = 0; i < hands.size(); ++i) {
    EXPECT_LT((tools[i].pose.matrix() - (hands[i].pose * T_hand_tool).matrix()).norm(), 1e-12);
    EXPECT_EQ(tools[i].score, hands[i].score);
    EXPECT_EQ(tools[i].width, hands[i].width);
  }
}

TEST(HandPoses, OfLongHandlesAreAtSeveralPlaces)
{
  const Cloud cloud = capture(barInFrontOfWall(0.5));
  Config config;
  const auto offsetsOn = [&](double length) {
    GraspHandle handle = barHandle();
    handle.length = length;
    // Against the axis.
    handle.polyline = {handle.centroid + length / 2 * handle.axis, handle.centroid - length / 2 * handle.axis};
    std::vector<double> offsets;
    for (const GraspPose& hand : search(cloud, config, handle)) {
      EXPECT_EQ(hand.pose.linear().col(2), handle.axis);
      if (approach(hand).z() > 0.999) {
        EXPECT_LT((hand.pose.translation() - handle.centroid).tail<2>().norm(), 1e-12);
        offsets.push_back(hand.pose.translation().x());
      }
    }
    EXPECT_NEAR(offsets.front(), 0.0, 1e-12) << "the middle is best";
    std::sort(offsets.begin(), offsets.end());
    return offsets;
  };
  const auto expect = [](const std::vector<double>& actual, const std::vector<double>& expected) {
    ASSERT_EQ(actual.size(), expected.size());
    for (std::size_t i = 0; i < actual.size(); ++i) {
      EXPECT_NEAR(actual[i], expected[i], 1e-9) << i;
    }
  };
  config.hand.palm_width = 0.03;
  expect(offsetsOn(0.05), {0.0});
  expect(offsetsOn(0.07), {-0.02, 0.0, 0.02});
  expect(offsetsOn(0.09), {-0.03, -0.015, 0.0, 0.015, 0.03});
  expect(offsetsOn(0.25), {-0.11, -0.055, 0.0, 0.055, 0.11});
}

TEST(HandPoses, OfABentHandleFollowIt)
{
  // An arc of 180 degrees about the line of sight, and its axis as a polyline of 13 points.
  constexpr double kArc = 0.06;
  Scene arc;
  arc.beginObject("arc");
  arc.add(TorusArc{kArc, 0.008, M_PI / 2}, at(0.0, 0.0, 0.8));
  arc.beginObject("wall");
  arc.add(Box{{4.0, 4.0, 0.1}}, at(0.0, 0.0, 1.5));
  GraspHandle handle = handleAt(Vector(kArc, 0.0, 0.8), Vector::UnitY(), -Vector::UnitZ(), 0.012, M_PI * kArc);
  handle.polyline.clear();
  for (int i = 0; i <= 12; ++i) {
    const double angle = M_PI / 2 - M_PI * i / 12;  // against the axis
    handle.polyline.emplace_back(kArc * std::cos(angle), kArc * std::sin(angle), 0.8);
  }
  Config config;
  const auto hands = search(capture(arc), config, handle);
  std::vector<Vector> places;
  for (const GraspPose& hand : hands) {
    const Vector p = hand.pose.translation() - Vector(0.0, 0.0, 0.8);
    EXPECT_NEAR(p.norm(), kArc, 0.001) << "on the arc";
    const Vector tangent = Vector::UnitZ().cross(p).normalized();
    EXPECT_LT(std::acos(std::min(1.0, hand.pose.linear().col(2).dot(tangent))), 0.05) << "along it, one way";
    EXPECT_NEAR(hand.pose.linear().col(0).dot(hand.pose.linear().col(2)), 0.0, 1e-12);
    if (std::none_of(places.begin(), places.end(), [&](const Vector& place) { return (place - p).norm() < 1e-9; })) {
      places.push_back(p);
    }
  }
  EXPECT_EQ(places.size(), 5U);
  EXPECT_LT((hands.front().pose.translation() - handle.centroid).norm(), 1e-12);
}

TEST(HandPoses, AreNoWiderThanTheHandOpens)
{
  const Cloud cloud = capture(barInFrontOfWall(0.5));
  Config config;
  GraspHandle handle = barHandle();
  handle.inner_radius = 2 * config.hand.capture_radius;
  const auto hands = search(cloud, config, handle);
  ASSERT_GT(hands.size(), 0U);
  EXPECT_EQ(hands.front().width, 2 * config.hand.capture_radius);
}

TEST(HandPoses, NoneIfNoneAreAskedForAndOldOnesAreGone)
{
  const Cloud cloud = capture(barInFrontOfWall(0.5));
  Config config;
  config.hand_poses.count = 0;
  GraspHandle handle = barHandle();
  handle.hand_poses.resize(3);
  EXPECT_EQ(search(cloud, config, handle).size(), 0U);
  config.hand_poses.count = 1;
  EXPECT_EQ(search(cloud, config, handle).size(), 1U);
}

}  // namespace
}  // namespace grasp_affordances::test
