#include "nodelets/selection/hand_pose_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace grasp_affordances
{
namespace
{

const Eigen::Isometry3d kNoTool = Eigen::Isometry3d::Identity();

/// A hand that approaches an upright handle at the origin in the direction of `angle` from x, at a height.
GraspPose handAt(double angle, double along, double score)
{
  GraspPose hand;
  hand.pose.linear() = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  hand.pose.translation().z() = along;
  hand.score = score;
  return hand;
}

GraspHandle handleWith(const std::vector<GraspPose>& hands)
{
  GraspHandle handle;
  handle.hand_poses = hands;
  return handle;
}

/// Where the chosen hand comes from, rad.
double approachOf(const GraspHandle& handle, std::size_t index)
{
  const Eigen::Vector3d approach = handle.hand_poses.at(index).pose.linear().col(0);
  return std::atan2(approach.y(), approach.x());
}

TEST(HandPoseChoice, TheFirstChoiceIsTheBestPose)
{
  HandPoseChoice choice;
  EXPECT_EQ(choice.follow(GraspHandle(), kNoTool), std::nullopt);
  EXPECT_EQ(choice.follow(handleWith({handAt(0.5, 0.0, 0.9), handAt(0.0, 0.0, 0.8)}), kNoTool), 0U);
}

TEST(HandPoseChoice, IsFollowedWhenScoresChangeTheOrder)
{
  HandPoseChoice choice;
  choice.follow(handleWith({handAt(0.0, 0.0, 0.9), handAt(0.5, 0.0, 0.8), handAt(0.0, 0.03, 0.7)}), kNoTool);
  const GraspHandle next = handleWith({handAt(0.52, 0.0, 0.9), handAt(0.01, 0.03, 0.85), handAt(0.02, 0.001, 0.8)});
  EXPECT_EQ(choice.follow(next, kNoTool), 2U);
}

TEST(HandPoseChoice, FollowsAHandThatTurnsSlowly)
{
  HandPoseChoice choice;
  choice.follow(handleWith({handAt(0.0, 0.0, 0.9)}), kNoTool);
  for (double turn = 0.1; turn < 3.0; turn += 0.1) {
    const GraspHandle handle = handleWith({handAt(turn + 0.52, 0.0, 0.9), handAt(turn, 0.0, 0.8)});
    ASSERT_EQ(choice.follow(handle, kNoTool), 1U) << "turned by " << turn << " rad";
  }
}

TEST(HandPoseChoice, ComesBackToAPoseThatWasMissing)
{
  HandPoseChoice choice;
  choice.follow(handleWith({handAt(0.0, 0.0, 0.9)}), kNoTool);
  EXPECT_EQ(choice.follow(handleWith({handAt(1.04, 0.0, 0.9), handAt(0.52, 0.0, 0.8)}), kNoTool), 1U);
  EXPECT_EQ(choice.follow(GraspHandle(), kNoTool), std::nullopt);
  EXPECT_EQ(choice.follow(handleWith({handAt(0.52, 0.0, 0.9), handAt(0.0, 0.0, 0.8)}), kNoTool), 1U);
}

TEST(HandPoseChoice, IsFollowedWhenTheAxisTurnsOver)
{
  HandPoseChoice choice;
  choice.follow(handleWith({handAt(0.0, 0.03, 0.9), handAt(0.0, -0.03, 0.8)}), kNoTool);
  GraspHandle over = handleWith({handAt(0.0, -0.03, 0.9), handAt(0.0, 0.03, 0.8)});
  over.axis = -Eigen::Vector3d::UnitZ();
  EXPECT_EQ(choice.follow(over, kNoTool), 1U);
}

TEST(HandPoseChoice, StepsGoOnceAroundAndBack)
{
  std::vector<GraspPose> hands;
  for (int i = 0; i < 12; ++i) {
    for (const double along : {-0.02, 0.02}) {
      hands.push_back(handAt(0.5235987755982988 * i, along, 0.9 - 0.01 * ((5 * i) % 12)));
    }
  }
  std::sort(hands.begin(), hands.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  const GraspHandle handle = handleWith(hands);

  HandPoseChoice choice;
  const std::size_t first = choice.follow(handle, kNoTool).value();
  std::set<std::size_t> seen{first};
  for (std::size_t i = 1; i < hands.size(); ++i) {
    const std::size_t before = choice.follow(handle, kNoTool).value();
    const std::size_t chosen = choice.step(handle, kNoTool, false).value();
    EXPECT_TRUE(seen.insert(chosen).second) << "step " << i << " comes back to pose " << chosen;
    const double turn = std::remainder(approachOf(handle, chosen) - approachOf(handle, before), 2.0 * M_PI);
    EXPECT_GT(turn, -0.01) << "step " << i;
    EXPECT_LT(turn, 0.53) << "step " << i;
    EXPECT_EQ(choice.follow(handle, kNoTool), chosen);
  }
  EXPECT_EQ(choice.step(handle, kNoTool, false), first);
  choice.step(handle, kNoTool, true);
  EXPECT_EQ(choice.step(handle, kNoTool, false), first);
}

TEST(HandPoseChoice, StepsGoOnceAroundAHandleWithoutANormal)
{
  GraspHandle handle = handleWith({handAt(2.0, 0.0, 0.9), handAt(0.0, 0.0, 0.8), handAt(-2.0, 0.0, 0.7)});
  handle.normal.setConstant(std::nan(""));
  HandPoseChoice choice;
  EXPECT_EQ(choice.follow(handle, kNoTool), 0U);
  EXPECT_EQ(choice.step(handle, kNoTool, false), 2U) << "from 2 rad on to 4.28";
  EXPECT_EQ(choice.step(handle, kNoTool, false), 1U);
  EXPECT_EQ(choice.step(handle, kNoTool, false), 0U);
  EXPECT_EQ(choice.step(handle, kNoTool, true), 1U);
}

TEST(HandPoseChoice, ATurnedToolChangesNothing)
{
  HandPosesConfig config;
  config.tool_x = -0.1;
  config.tool_yaw = 1.5;
  config.tool_roll = 0.7;
  const Eigen::Isometry3d T_hand_tool = toolInHand(config);
  GraspHandle handle = handleWith({handAt(0.0, 0.0, 0.9), handAt(0.5, 0.0, 0.8), handAt(-0.5, 0.0, 0.7)});
  for (GraspPose& hand : handle.hand_poses) {
    hand.pose = hand.pose * T_hand_tool;
  }
  HandPoseChoice choice;
  EXPECT_EQ(choice.follow(handle, T_hand_tool), 0U);
  EXPECT_EQ(choice.step(handle, T_hand_tool, false), 1U);
  EXPECT_EQ(choice.step(handle, T_hand_tool, false), 2U);
}

TEST(ToolInHand, TurnsAboutFixedAxesInTheOrderXYZ)
{
  HandPosesConfig config;
  config.tool_x = 0.1;
  config.tool_roll = M_PI / 2;   // y to z
  config.tool_pitch = M_PI / 2;  // z to x
  config.tool_yaw = M_PI / 2;    // x to y
  const Eigen::Vector3d turned = toolInHand(config) * Eigen::Vector3d::UnitY();
  EXPECT_LT((turned - Eigen::Vector3d(0.1, 1.0, 0.0)).norm(), 1e-12) << turned.transpose();
}

}  // namespace
}  // namespace grasp_affordances
