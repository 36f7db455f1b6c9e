#include "nodelets/cameras/camera_frames.h"

namespace grasp_affordances
{
namespace
{

/// As in openni2_launch: the depth camera is 2 cm to the right of the device's middle, the color camera 4.5 cm.
Eigen::Isometry3d linkToCamera(XtionCamera camera)
{
  return Eigen::Isometry3d(Eigen::Translation3d(0.0, camera == XtionCamera::depth ? -0.02 : -0.045, 0.0));
}

Eigen::Isometry3d cameraToOptical()
{
  return Eigen::Isometry3d(Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5));
}

std::string frameName(const std::string& prefix, XtionCamera camera, const std::string& ending)
{
  return prefix + (camera == XtionCamera::depth ? "_depth" : "_rgb") + ending;
}

}  // namespace

Eigen::Isometry3d opticalPoseInLink(XtionCamera camera)
{
  return linkToCamera(camera) * cameraToOptical();
}

std::string opticalFrame(const std::string& prefix, XtionCamera camera)
{
  return frameName(prefix, camera, "_optical_frame");
}

std::vector<geometry_msgs::TransformStamped> opticalTransforms(const std::string& prefix, XtionCamera camera,
                                                               const ros::Time& stamp)
{
  const std::string camera_frame = frameName(prefix, camera, "_frame");
  return {transformMessage(prefix + "_link", linkToCamera(camera), camera_frame, stamp),
          transformMessage(camera_frame, cameraToOptical(), opticalFrame(prefix, camera), stamp)};
}

geometry_msgs::TransformStamped transformMessage(const std::string& parent, const Eigen::Isometry3d& T_parent_child,
                                                 const std::string& child, const ros::Time& stamp)
{
  const Eigen::Vector3d translation = T_parent_child.translation();
  const Eigen::Quaterniond rotation(T_parent_child.linear());
  geometry_msgs::TransformStamped message;
  message.header.frame_id = parent;
  message.header.stamp = stamp;
  message.child_frame_id = child;
  message.transform.translation.x = translation.x();
  message.transform.translation.y = translation.y();
  message.transform.translation.z = translation.z();
  message.transform.rotation.x = rotation.x();
  message.transform.rotation.y = rotation.y();
  message.transform.rotation.z = rotation.z();
  message.transform.rotation.w = rotation.w();
  return message;
}

}  // namespace grasp_affordances
