#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>
#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace grasp_affordances
{

/// The two cameras of an Xtion. The frames have the names and axes of openni2_launch. CAMERA_link, CAMERA_depth_frame
/// and CAMERA_rgb_frame: x forward, y left, z up. CAMERA_depth_optical_frame and CAMERA_rgb_optical_frame: x right,
/// y down, z forward.
enum class XtionCamera
{
  depth,
  rgb
};

/// Pose of a camera's optical frame in CAMERA_link.
Eigen::Isometry3d opticalPoseInLink(XtionCamera camera);

/// Name of a camera's optical frame. @param prefix CAMERA in the names above.
std::string opticalFrame(const std::string& prefix, XtionCamera camera);

/// Two transforms: from CAMERA_link to the camera's frame, and from there to its optical frame.
std::vector<geometry_msgs::TransformStamped> opticalTransforms(const std::string& prefix, XtionCamera camera,
                                                               const ros::Time& stamp);

geometry_msgs::TransformStamped transformMessage(const std::string& parent, const Eigen::Isometry3d& T_parent_child,
                                                 const std::string& child, const ros::Time& stamp);

}  // namespace grasp_affordances
