#pragma once

#include "grasp_affordances/config.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <limits>
#include <vector>

namespace grasp_affordances
{

/// Points (m) joined by straight segments. There are at least two, and no point is the same as the next.
using Polyline = std::vector<Eigen::Vector3d>;

/// Sum of the segments' lengths (m).
double lengthOf(const Polyline& polyline);

/// A pose of a hand that is open around a handle, ready to close.
///
/// The hand's frame has its origin on the handle's axis, x forward along the approach, z along the axis, and y in the
/// direction in which fingers and thumb oppose each other. The hand moves towards +x. For a symmetric hand the pose
/// turned by pi about x, with -z for z, is the same grasp. In all poses of a handle z points the same way along its
/// axis, even where the axis is bent.
///
/// `pose` is that of the tool (HandPosesConfig::tool_x, ...): T_cloud_tool = T_cloud_hand * T_hand_tool. T_hand_tool
/// has the translation (tool_x, tool_y, tool_z) and the rotation by roll, pitch and yaw about the hand's fixed x, y and
/// z. Without a tool it is the identity. poseOfHand() gives the pose of the hand itself.
struct GraspPose
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of the tool, m, in the cloud's frame
  double width = 0.0;  ///< m, between the open fingers and thumb: twice the inner radius, which clears the surface
  double observed_free = std::numeric_limits<double>::quiet_NaN();  ///< in [0, 1], share of the approach corridor that
                                                                    ///< a sensor saw through; NaN without a range image
  double score = 0.0;                                               ///< in [0, 1]: 1 is best
};

/// A part of an object that a hand can close around: shells that share an axis, straight or bent. Lengths in metres, in
/// the cloud's frame.
struct GraspHandle
{
  std::uint32_t id = 0;                                ///< from 1: rank by score in one localization, or a tracker's id
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< on the axis, in the middle of the length
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();     ///< unit, at the centroid; its largest component is positive
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();   ///< unit, at right angles to the axis, towards the sensor's
                                                       ///< side; NaN where the sensor's place is not known
  double radius = 0.0;                                 ///< m, of the fitted surface, at the centroid
  double inner_radius = 0.0;                           ///< m, of the shell that holds the surface there
  double length = 0.0;                                 ///< m, along the axis
  Polyline polyline;                                   ///< the axis: two points, or more where it is bent
  std::vector<std::uint32_t> shells;                   ///< indices into Localization::shells, ascending
  double score = 0.0;                                  ///< in [0, 1]: 1 is best; docs/handles.md defines it
  double agreement = 0.0;             ///< in [0, 1]: share of the samples drawn on it that ended as its shells
  double clearance = 0.0;             ///< in [0, 1]: 1 for gaps without a point, 0 for nearly blocked ones
  double observed_free = 0.0;         ///< in [0, 1]: share of the gaps that the sensor saw through; NaN without a
                                      ///< range image
  std::vector<GraspPose> hand_poses;  ///< the best first

  // Set by HandleTracker: how well the handle is known.
  std::uint32_t hits = 1;   ///< number of clouds in which it was found
  double unseen_for = 0.0;  ///< s, since it was found last
};

/// The handle in the frame that T leads to. Its axis points the other way where its largest component would be
/// negative.
GraspHandle transformed(GraspHandle handle, const Eigen::Isometry3d& T);

/// T_hand_tool, the pose of the tool in the hand's frame, from the tool_x, ... of `config`.
Eigen::Isometry3d toolInHand(const HandPosesConfig& config);

/// The pose of the hand itself, in the same frame as the pose of the tool that `grasp` holds.
/// @param config  that the grasp was found with
Eigen::Isometry3d poseOfHand(const GraspPose& grasp, const HandPosesConfig& config);

}  // namespace grasp_affordances
