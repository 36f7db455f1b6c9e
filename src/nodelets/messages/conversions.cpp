#include "nodelets/messages/conversions.h"

#include "core/result/axis_frame.h"
#include "grasp_affordances/parameters.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace grasp_affordances
{
namespace
{

template <typename Xyz>
Xyz xyzMessage(const Eigen::Vector3d& v)
{
  Xyz message;
  message.x = v.x();
  message.y = v.y();
  message.z = v.z();
  return message;
}

CylindricalShell shellMessage(const Shell& shell)
{
  CylindricalShell message;
  message.pose = poseMessage(shell);
  message.centroid = xyzMessage<geometry_msgs::Point>(shell.centroid);
  message.axis = xyzMessage<geometry_msgs::Vector3>(shell.axis);
  message.normal = xyzMessage<geometry_msgs::Vector3>(shell.normal);
  message.inner_radius = shell.inner_radius;
  message.thickness = shell.thickness;
  message.length = shell.length;
  message.curvature = shell.curvature;
  message.points_inside = shell.points_inside;
  message.points_in_gap = shell.points_in_gap;
  message.observed_free = shell.observed_free;
  message.point_index = shell.point_index;
  return message;
}

std::string sizeText(std::uint32_t width, std::uint32_t height)
{
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

geometry_msgs::Pose poseMessage(const Shell& shell)
{
  return poseMessage(shell.centroid, shell.axis, shell.normal);
}

geometry_msgs::Pose poseMessage(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis,
                                const Eigen::Vector3d& normal)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotationAlong(axis, normalOrAny(axis, normal));
  pose.translation() = origin;
  return poseMessage(pose);
}

geometry_msgs::Pose poseMessage(const Eigen::Isometry3d& pose)
{
  const Eigen::Quaterniond orientation = Eigen::Quaterniond(pose.linear()).normalized();
  geometry_msgs::Pose message;
  message.position = xyzMessage<geometry_msgs::Point>(pose.translation());
  message.orientation.x = orientation.x();
  message.orientation.y = orientation.y();
  message.orientation.z = orientation.z();
  message.orientation.w = orientation.w();
  return message;
}

Handle handleMessage(const GraspHandle& handle, const std_msgs::Header& header)
{
  Handle message;
  message.header = header;
  message.id = handle.id;
  message.pose = poseMessage(handle.centroid, handle.axis, handle.normal);
  message.centroid = xyzMessage<geometry_msgs::Point>(handle.centroid);
  message.axis = xyzMessage<geometry_msgs::Vector3>(handle.axis);
  message.normal = xyzMessage<geometry_msgs::Vector3>(handle.normal);
  message.radius = handle.radius;
  message.inner_radius = handle.inner_radius;
  message.length = handle.length;
  for (const Eigen::Vector3d& point : handle.polyline) {
    message.polyline.push_back(xyzMessage<geometry_msgs::Point>(point));
  }
  message.shells = handle.shells;
  message.score = handle.score;
  message.agreement = handle.agreement;
  message.clearance = handle.clearance;
  message.observed_free = handle.observed_free;
  for (const GraspPose& hand : handle.hand_poses) {
    message.hand_poses.emplace_back();
    message.hand_poses.back().pose = poseMessage(hand.pose);
    message.hand_poses.back().width = hand.width;
    message.hand_poses.back().observed_free = hand.observed_free;
    message.hand_poses.back().score = hand.score;
  }
  message.hits = handle.hits;
  message.unseen_for = handle.unseen_for;
  return message;
}

HandleArray handlesMessage(const std::vector<GraspHandle>& handles, const std_msgs::Header& header)
{
  HandleArray message;
  message.header = header;
  message.handles.reserve(handles.size());
  for (const GraspHandle& handle : handles) {
    message.handles.push_back(handleMessage(handle, header));
  }
  return message;
}

geometry_msgs::PoseArray handPosesMessage(const std::vector<GraspHandle>& handles, const std_msgs::Header& header)
{
  geometry_msgs::PoseArray message;
  message.header = header;
  for (const GraspHandle& handle : handles) {
    for (const GraspPose& hand : handle.hand_poses) {
      message.poses.push_back(poseMessage(hand.pose));
    }
  }
  return message;
}

CylindricalShellArray shellsMessage(const Localization& localization, const std_msgs::Header& header)
{
  CylindricalShellArray message;
  message.header = header;
  message.shells.reserve(localization.shells.size());
  for (const Shell& shell : localization.shells) {
    message.shells.push_back(shellMessage(shell));
  }
  return message;
}

LocalizationStatistics statisticsMessage(const Localization& localization, const Config& config,
                                         const std_msgs::Header& header)
{
  const auto count = [&](Outcome outcome) { return localization.counts[static_cast<std::size_t>(outcome)]; };

  LocalizationStatistics message;
  message.header = header;
  message.preset = config.preset;
  message.estimator = enumWord(config.estimation.estimator);
  message.seed = config.sampling.seed;
  message.threads = localization.threads;
  message.points = localization.points;
  message.view_disagreement = localization.view_disagreement;
  message.warnings = localization.warnings;

  message.sampled = localization.sampled;
  message.too_few_points = count(Outcome::too_few_points);
  message.degenerate = count(Outcome::degenerate);
  message.occluded = count(Outcome::occluded);
  message.low_curvature = count(Outcome::low_curvature);
  message.concave = count(Outcome::concave);
  message.no_shell = count(Outcome::no_shell);
  message.too_short = count(Outcome::too_short);
  message.unobserved_gap = count(Outcome::unobserved_gap);
  message.uncovered = count(Outcome::uncovered);
  message.out_of_time = count(Outcome::out_of_time);
  message.shells = count(Outcome::shell);
  message.handles = static_cast<std::uint32_t>(localization.handles.size());
  message.explanation = explainNothing(localization, config);

  message.milliseconds_total = localization.milliseconds.total;
  message.milliseconds_preparation = localization.milliseconds.preparation;
  message.milliseconds_neighborhoods = localization.milliseconds.neighborhoods;
  message.milliseconds_occlusion = localization.milliseconds.occlusion;
  message.milliseconds_fit = localization.milliseconds.fit;
  message.milliseconds_shell = localization.milliseconds.shell;
  message.milliseconds_handles = localization.milliseconds.handles;
  message.milliseconds_hand_poses = localization.milliseconds.hand_poses;
  return message;
}

PinholeIntrinsics intrinsicsFromCameraInfo(const sensor_msgs::CameraInfo& camera, std::uint32_t width,
                                           std::uint32_t height)
{
  // A region of interest of size 0 and a binning of 0 stand for the full image and for none.
  const sensor_msgs::RegionOfInterest& region = camera.roi;
  const std::uint32_t binning_x = std::max(camera.binning_x, 1U);
  const std::uint32_t binning_y = std::max(camera.binning_y, 1U);
  const std::uint32_t image_width = (region.width > 0 ? region.width : camera.width) / binning_x;
  const std::uint32_t image_height = (region.height > 0 ? region.height : camera.height) / binning_y;
  if (image_width != width || image_height != height) {
    throw std::invalid_argument("its image is " + sizeText(image_width, image_height) + ", the cloud " +
                                sizeText(width, height));
  }
  if (!(camera.P[0] > 0.0 && camera.P[5] > 0.0)) {
    throw std::invalid_argument("it is not calibrated: no positive focal lengths in its P");
  }

  PinholeIntrinsics intrinsics;
  intrinsics.fx = camera.P[0] / binning_x;
  intrinsics.fy = camera.P[5] / binning_y;
  intrinsics.cx = (camera.P[2] - region.x_offset) / binning_x;
  intrinsics.cy = (camera.P[6] - region.y_offset) / binning_y;
  return intrinsics;
}

}  // namespace grasp_affordances
