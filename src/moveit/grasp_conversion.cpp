#include "moveit/grasp_conversion.h"

#include "grasp_affordances/config.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace grasp_affordances
{
namespace
{

void check(bool valid, const std::string& message)
{
  if (!valid) {
    throw ParameterError(message);
  }
}

void checkPositions(const std::string& name, const std::vector<double>& positions, std::size_t joints)
{
  check(positions.size() == joints, "parameter ~" + name + " has " + std::to_string(positions.size()) +
                                        " positions; it must have one for each of the " + std::to_string(joints) +
                                        " gripper_joints");
  check(std::all_of(positions.begin(), positions.end(), [](double p) { return std::isfinite(p); }),
        "parameter ~" + name + " must hold finite numbers");
}

trajectory_msgs::JointTrajectory posture(const GraspParameters& parameters, double openness)
{
  trajectory_msgs::JointTrajectory trajectory;
  trajectory.joint_names = parameters.gripper_joints;
  trajectory.points.resize(1);
  trajectory.points[0].time_from_start = ros::Duration(parameters.posture_duration);
  for (std::size_t i = 0; i < parameters.gripper_joints.size(); ++i) {
    const double open = parameters.open_positions[i], closed = parameters.closed_positions[i];
    trajectory.points[0].positions.push_back(closed + openness * (open - closed));
  }
  return trajectory;
}

moveit_msgs::GripperTranslation translation(const std_msgs::Header& header, const Eigen::Vector3d& direction,
                                            double desired, double least)
{
  const Eigen::Vector3d unit = direction.normalized();
  moveit_msgs::GripperTranslation message;
  message.direction.header = header;
  message.direction.vector.x = unit.x();
  message.direction.vector.y = unit.y();
  message.direction.vector.z = unit.z();
  message.desired_distance = static_cast<float>(desired);
  message.min_distance = static_cast<float>(least);
  return message;
}

/// Of the gripper's opening, in [0, 1].
double opennessFor(double width, const GraspParameters& parameters)
{
  return parameters.open_width > 0.0 ? width / parameters.open_width : 1.0;
}

moveit_msgs::Grasp graspOf(const HandPose& hand, const std_msgs::Header& header, const GraspParameters& parameters)
{
  const geometry_msgs::Quaternion& q = hand.pose.orientation;
  const Eigen::Vector3d approach = Eigen::Quaterniond(q.w, q.x, q.y, q.z) *
                                   Eigen::Vector3d(parameters.approach_x, parameters.approach_y, parameters.approach_z);
  moveit_msgs::Grasp grasp;
  grasp.pre_grasp_posture = posture(parameters, opennessFor(hand.width, parameters));
  grasp.grasp_posture = posture(parameters, 0.0);
  grasp.grasp_pose.header = header;
  grasp.grasp_pose.pose = hand.pose;
  grasp.pre_grasp_approach =
      translation(header, approach, parameters.approach_desired_distance, parameters.approach_min_distance);
  if (parameters.retreat_frame.empty()) {
    grasp.post_grasp_retreat =
        translation(header, -approach, parameters.retreat_desired_distance, parameters.retreat_min_distance);
  } else {
    std_msgs::Header retreat_header = header;
    retreat_header.frame_id = parameters.retreat_frame;
    grasp.post_grasp_retreat =
        translation(retreat_header, {parameters.retreat_x, parameters.retreat_y, parameters.retreat_z},
                    parameters.retreat_desired_distance, parameters.retreat_min_distance);
  }
  grasp.post_place_retreat =
      translation(header, -approach, parameters.retreat_desired_distance, parameters.retreat_min_distance);
  grasp.max_contact_force = static_cast<float>(parameters.max_contact_force);
  return grasp;
}

}  // namespace

void validate(const GraspParameters& p)
{
  check(!p.gripper_joints.empty(),
        "parameter ~gripper_joints is not given; it must hold the names of the gripper's joints");
  check(std::none_of(p.gripper_joints.begin(), p.gripper_joints.end(), [](const auto& name) { return name.empty(); }),
        "parameter ~gripper_joints must not hold an empty name");
  checkPositions("open_positions", p.open_positions, p.gripper_joints.size());
  checkPositions("closed_positions", p.closed_positions, p.gripper_joints.size());
  check(Eigen::Vector3d(p.approach_x, p.approach_y, p.approach_z).norm() > 1e-6,
        "parameters ~approach_x, ~approach_y and ~approach_z are all zero; they must be a direction");
  check(p.retreat_frame.empty() || Eigen::Vector3d(p.retreat_x, p.retreat_y, p.retreat_z).norm() > 1e-6,
        "parameters ~retreat_x, ~retreat_y and ~retreat_z are all zero; they must be a direction");
  check(p.approach_min_distance <= p.approach_desired_distance,
        "parameter ~approach_min_distance must not be greater than ~approach_desired_distance");
  check(p.retreat_min_distance <= p.retreat_desired_distance,
        "parameter ~retreat_min_distance must not be greater than ~retreat_desired_distance");
}

std::vector<moveit_msgs::Grasp> graspsOf(const Handle& handle, const GraspParameters& parameters)
{
  std::vector<moveit_msgs::Grasp> grasps;
  for (std::size_t i = 0; i < handle.hand_poses.size(); ++i) {
    if (opennessFor(handle.hand_poses[i].width, parameters) <= 1.0) {
      grasps.push_back(graspOf(handle.hand_poses[i], handle.header, parameters));
      grasps.back().id = std::to_string(handle.id) + "/" + std::to_string(i + 1);
      grasps.back().grasp_quality = handle.score * handle.hand_poses[i].score;
    }
  }
  return grasps;
}

}  // namespace grasp_affordances
