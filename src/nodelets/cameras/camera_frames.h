#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>
#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace grasp_affordances
{

/// The cameras of an Xtion. Their frames are those of openni2_launch: CAMERA_link, CAMERA_depth_frame and
/// CAMERA_rgb_frame have x forward, y left, z up; CAMERA_depth_optical_frame and CAMERA_rgb_optical_frame have x right,
/// y down, z forward.
enum class XtionCamera
{
  depth,
  rgb
};

/// Pose of a camera's optical frame in CAMERA_link.
Eigen::Isometry3d opticalPoseInLink(XtionCamera camera);

std::string opticalFrame(const std::string& prefix, XtionCamera camera);

/// From CAMERA_link to a camera's frame, and from there to its optical frame.
std::vector<geometry_msgs::TransformStamped> opticalTransforms(const std::string& prefix, XtionCamera camera,
                                                               const ros::Time& stamp);

geometry_msgs::TransformStamped transformMessage(const std::string& parent, const Eigen::Isometry3d& T_parent_child,
                                                 const std::string& child, const ros::Time& stamp);

}  // namespace grasp_affordances
