#pragma once

#include "grasp_affordances/config.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <limits>
#include <vector>

namespace grasp_affordances
{

/// Points joined by straight segments; at least two, of which none is the same as the next. Metres.
using Polyline = std::vector<Eigen::Vector3d>;

/// Sum of the segments' lengths (m).
double lengthOf(const Polyline& polyline);

/// A pose of a hand that is open around a handle, ready to close: origin on the handle's axis, x forward along the
/// approach, z along the axis, y the direction in which fingers and thumb oppose. Seen along x the hand comes from -x.
/// For a symmetric hand z and -z, a turn about x by pi, are the same grasp: z is along the handle's axis, and the same
/// way along a bent one in all its poses.
///
/// With a tool (HandPosesConfig::tool_x, ...) it is the tool's pose then: T_cloud_tool = T_cloud_hand * T_hand_tool,
/// where T_hand_tool is turned by roll, pitch and yaw about the hand's fixed x, y and z and is at (tool_x, tool_y,
/// tool_z). The hand's own pose is T_cloud_tool * T_hand_tool^-1.
struct GraspPose
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of the tool, m, in the cloud's frame
  double width = 0.0;  ///< m, opening between fingers and thumb that clears the surface: twice a shell's inner radius
  double observed_free = std::numeric_limits<double>::quiet_NaN();  ///< share of the approach corridor that a sensor
                                                                    ///< saw through; NaN without a range image
  double score = 0.0;                                               ///< in [0, 1], the best first
};

/// What a hand can close around as one thing: shells that share an axis, straight or bent. Metres, in the cloud's
/// frame.
struct GraspHandle
{
  std::uint32_t id = 0;                                ///< from 1: by score in one localization, or a tracker's
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< on the axis, in the middle of the length
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();     ///< unit, at the centroid; its largest component is positive
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();   ///< unit, at right angles to the axis, towards the sensor's side
  double radius = 0.0;                                 ///< of the fitted surface, at the centroid
  double inner_radius = 0.0;                           ///< of the shell that holds the surface there
  double length = 0.0;                                 ///< along the axis
  Polyline polyline;                                   ///< the axis: two points or, of a bent one, more
  std::vector<std::uint32_t> shells;                   ///< indices into Localization::shells, ascending
  double score = 0.0;                                  ///< in [0, 1]: see HandleFinder
  double agreement = 0.0;             ///< in [0, 1]: of the samples drawn on it, those that ended as one of its shells
  double clearance = 0.0;             ///< in [0, 1]: 1 for gaps without a point, 0 where they nearly block
  double observed_free = 0.0;         ///< share of the gaps that the sensor saw through; NaN without a range image
  std::vector<GraspPose> hand_poses;  ///< the best first

  // Of a tracker: how well it is known.
  std::uint32_t hits = 1;   ///< clouds that it was found in
  double unseen_for = 0.0;  ///< s, since it was found last
};

/// The handle in the frame that T leads to.
GraspHandle transformed(GraspHandle handle, const Eigen::Isometry3d& T);

/// The tool's frame in the hand's, T_hand_tool: the tool_x, ... of `config`.
Eigen::Isometry3d toolInHand(const HandPosesConfig& config);

/// The pose of the hand itself, in the frame of the grasp's pose, which is that of the tool that `config` gives.
Eigen::Isometry3d poseOfHand(const GraspPose& grasp, const HandPosesConfig& config);

}  // namespace grasp_affordances
