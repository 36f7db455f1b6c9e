#include "moveit/grasp_conversion.h"
#include "grasp_affordances/config.h"
#include "moveit/grasp_parameters.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace grasp_affordances
{
namespace
{

GraspParameters twoFingers()
{
  GraspParameters parameters;
  parameters.gripper_joints = {"left", "right"};
  parameters.open_positions = {0.04, -0.04};
  parameters.closed_positions = {0.0, 0.01};
  return parameters;
}

/// With hand poses of these widths, all of which approach along y.
Handle handleWith(const std::vector<double>& widths)
{
  Handle handle;
  handle.header.frame_id = "optical";
  handle.header.stamp = ros::Time(12, 34);
  handle.id = 3;
  handle.score = 0.5;
  for (const double width : widths) {
    HandPose hand;
    hand.pose.position.x = 0.1;
    hand.pose.position.z = 0.8;
    hand.pose.orientation.z = hand.pose.orientation.w = std::sqrt(0.5);
    hand.width = width;
    hand.score = 0.8;
    handle.hand_poses.push_back(hand);
  }
  return handle;
}

void expectDirection(const moveit_msgs::GripperTranslation& translation, const std::string& frame, double x, double y,
                     double z)
{
  EXPECT_EQ(translation.direction.header.frame_id, frame);
  EXPECT_NEAR(translation.direction.vector.x, x, 1e-12);
  EXPECT_NEAR(translation.direction.vector.y, y, 1e-12);
  EXPECT_NEAR(translation.direction.vector.z, z, 1e-12);
}

TEST(GraspsOf, AHandPoseBecomesAGrasp)
{
  GraspParameters parameters = twoFingers();
  parameters.max_contact_force = 20.0;
  const Handle handle = handleWith({0.05, 0.06});
  const std::vector<moveit_msgs::Grasp> grasps = graspsOf(handle, parameters);
  ASSERT_EQ(grasps.size(), 2U);
  EXPECT_EQ(grasps[0].id, "3/1");
  EXPECT_EQ(grasps[1].id, "3/2");
  const moveit_msgs::Grasp& grasp = grasps[0];
  EXPECT_EQ(grasp.grasp_pose.header, handle.header);
  EXPECT_EQ(grasp.grasp_pose.pose, handle.hand_poses[0].pose);
  EXPECT_NEAR(grasp.grasp_quality, 0.4, 1e-12);
  EXPECT_EQ(grasp.max_contact_force, 20.0F);

  expectDirection(grasp.pre_grasp_approach, "optical", 0.0, 1.0, 0.0);
  expectDirection(grasp.post_grasp_retreat, "optical", 0.0, -1.0, 0.0);
  expectDirection(grasp.post_place_retreat, "optical", 0.0, -1.0, 0.0);
  EXPECT_EQ(grasp.pre_grasp_approach.desired_distance, 0.08F);
  EXPECT_EQ(grasp.pre_grasp_approach.min_distance, 0.05F);
  EXPECT_EQ(grasp.pre_grasp_approach.direction.header.stamp, handle.header.stamp);
}

TEST(GraspsOf, TheGripperOpensFullyWhereItsOpeningIsUnknown)
{
  const std::vector<moveit_msgs::Grasp> grasps = graspsOf(handleWith({0.5}), twoFingers());
  ASSERT_EQ(grasps.size(), 1U);
  EXPECT_EQ(grasps[0].pre_grasp_posture.joint_names, (std::vector<std::string>{"left", "right"}));
  ASSERT_EQ(grasps[0].pre_grasp_posture.points.size(), 1U);
  EXPECT_EQ(grasps[0].pre_grasp_posture.points[0].positions, (std::vector<double>{0.04, -0.04}));
  ASSERT_EQ(grasps[0].grasp_posture.points.size(), 1U);
  EXPECT_EQ(grasps[0].grasp_posture.points[0].positions, (std::vector<double>{0.0, 0.01}));
  EXPECT_GT(grasps[0].grasp_posture.points[0].time_from_start, ros::Duration(0));
}

TEST(GraspsOf, TheGripperOpensAsFarAsAPoseNeedsAndNoFurtherThanItCan)
{
  GraspParameters parameters = twoFingers();
  parameters.open_width = 0.08;
  const std::vector<moveit_msgs::Grasp> grasps = graspsOf(handleWith({0.081, 0.08, 0.04}), parameters);
  ASSERT_EQ(grasps.size(), 2U) << "one pose is too wide for this gripper";
  EXPECT_EQ(grasps[0].id, "3/2");
  const std::vector<double> full = grasps[0].pre_grasp_posture.points[0].positions;
  EXPECT_NEAR(full[0], 0.04, 1e-12);
  EXPECT_NEAR(full[1], -0.04, 1e-12);
  const std::vector<double> half = grasps[1].pre_grasp_posture.points[0].positions;
  EXPECT_NEAR(half[0], 0.02, 1e-12);
  EXPECT_NEAR(half[1], -0.015, 1e-12);
}

TEST(GraspsOf, ATurnedToolApproachesAlongAnotherOfItsAxesAndRetreatsUpwards)
{
  GraspParameters parameters = twoFingers();
  parameters.approach_x = 0.0;
  parameters.approach_z = 0.5;
  parameters.retreat_frame = "base_link";
  parameters.retreat_z = 0.2;
  const moveit_msgs::Grasp grasp = graspsOf(handleWith({0.05}), parameters).at(0);
  expectDirection(grasp.pre_grasp_approach, "optical", 0.0, 0.0, 1.0);
  expectDirection(grasp.post_grasp_retreat, "base_link", 0.0, 0.0, 1.0);
}

TEST(GraspsOf, AHandleThatCannotBeApproachedGivesNone)
{
  EXPECT_TRUE(graspsOf(handleWith({}), twoFingers()).empty());
}

TEST(GraspParameters, AreRefusedWithTheNameOfWhatIsWrong)
{
  const std::vector<std::pair<std::string, std::function<void(GraspParameters&)>>> mistakes{
      {"~gripper_joints", [](GraspParameters& p) { p.gripper_joints.clear(); }},
      {"~gripper_joints", [](GraspParameters& p) { p.gripper_joints[0] = ""; }},
      {"~open_positions", [](GraspParameters& p) { p.open_positions.pop_back(); }},
      {"~closed_positions", [](GraspParameters& p) { p.closed_positions[0] = std::nan(""); }},
      {"~approach_x", [](GraspParameters& p) { p.approach_x = 0.0; }},
      {"~approach_min_distance", [](GraspParameters& p) { p.approach_min_distance = 0.2; }},
      {"~retreat_min_distance", [](GraspParameters& p) { p.retreat_min_distance = 0.2; }},
      {"~retreat_x", [](GraspParameters& p) { p.retreat_frame = "base_link", p.retreat_z = 0.0; }}};
  EXPECT_NO_THROW(validate(twoFingers()));
  for (const auto& [name, mistake] : mistakes) {
    GraspParameters parameters = twoFingers();
    mistake(parameters);
    try {
      validate(parameters);
      ADD_FAILURE() << name << " was accepted";
    } catch (const ParameterError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace grasp_affordances
