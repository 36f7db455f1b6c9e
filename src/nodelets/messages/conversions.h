#pragma once

#include "grasp_affordances/CylindricalShellArray.h"
#include "grasp_affordances/HandleArray.h"
#include "grasp_affordances/LocalizationStatistics.h"
#include "grasp_affordances/cloud.h"
#include "grasp_affordances/config.h"
#include "grasp_affordances/localization.h"

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseArray.h>
#include <sensor_msgs/CameraInfo.h>
#include <std_msgs/Header.h>

#include <cstdint>
#include <vector>

namespace grasp_affordances
{

/// Origin in the middle of the shell's axis, z along the axis, x along the outward normal or, where that is not known,
/// any direction at right angles to the axis.
geometry_msgs::Pose poseMessage(const Shell& shell);

/// All shells of a localization, in their order, under the header of the cloud.
CylindricalShellArray shellsMessage(const Localization& localization, const std_msgs::Header& header);

/// z along the axis, x along the normal, both unit and at right angles. Where the normal is not known (NaN), x is any
/// direction at right angles to the axis.
geometry_msgs::Pose poseMessage(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis,
                                const Eigen::Vector3d& normal);
geometry_msgs::Pose poseMessage(const Eigen::Isometry3d& pose);

Handle handleMessage(const GraspHandle& handle, const std_msgs::Header& header);
HandleArray handlesMessage(const std::vector<GraspHandle>& handles, const std_msgs::Header& header);

/// The hand poses of all handles, one handle after the other.
geometry_msgs::PoseArray handPosesMessage(const std::vector<GraspHandle>& handles, const std_msgs::Header& header);

/// All but the latency and the counters of clouds, which are the node's.
LocalizationStatistics statisticsMessage(const Localization& localization, const Config& config,
                                         const std_msgs::Header& header);

/// Intrinsics of the rectified image (the camera's P) in the pixels of a cloud of width x height: those of the region
/// of interest, after binning.
/// @throw std::invalid_argument, with the reason, for a camera that is not calibrated or has another image size.
PinholeIntrinsics intrinsicsFromCameraInfo(const sensor_msgs::CameraInfo& camera, std::uint32_t width,
                                           std::uint32_t height);

}  // namespace grasp_affordances
