#include "grasp_affordances/handle.h"

#include "grasp_affordances/localization.h"

namespace grasp_affordances
{

GraspHandle transformed(GraspHandle handle, const Eigen::Isometry3d& T)
{
  handle.centroid = T * handle.centroid;
  handle.axis = withLargestComponentPositive(T.linear() * handle.axis);
  handle.normal = T.linear() * handle.normal;
  for (Eigen::Vector3d& point : handle.polyline) {
    point = T * point;
  }
  for (GraspPose& hand : handle.hand_poses) {
    hand.pose = T * hand.pose;
  }
  return handle;
}

Eigen::Isometry3d toolInHand(const HandPosesConfig& config)
{
  return Eigen::Translation3d(config.tool_x, config.tool_y, config.tool_z) *
         Eigen::AngleAxisd(config.tool_yaw, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(config.tool_pitch, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(config.tool_roll, Eigen::Vector3d::UnitX());
}

Eigen::Isometry3d poseOfHand(const GraspPose& grasp, const HandPosesConfig& config)
{
  return grasp.pose * toolInHand(config).inverse();
}

}  // namespace grasp_affordances
