#pragma once

#include "grasp_affordances/Handle.h"

#include <moveit_msgs/Grasp.h>

#include <geometry_msgs/Vector3.h>

#include <string>
#include <vector>

namespace grasp_affordances
{

/// What a grasp needs to know of a gripper and of how it moves.
struct GraspParameters
{
  std::vector<std::string> gripper_joints;
  std::vector<double> open_positions;    ///< of those joints, rad or m
  std::vector<double> closed_positions;  ///< likewise
  double open_width = 0.0;        ///< m, between the fingers at the open positions, none at the closed ones; 0: unknown
  double posture_duration = 0.5;  ///< s, that the gripper has to take a posture
  double approach_x = 1.0;        ///< direction of approach in the frame of the hand poses: of the hand its x
  double approach_y = 0.0;
  double approach_z = 0.0;
  double approach_desired_distance = 0.08;  ///< m
  double approach_min_distance = 0.05;      ///< m
  std::string retreat_frame;                ///< of the direction of retreat; empty: back along the approach
  double retreat_x = 0.0;                   ///< in that frame
  double retreat_y = 0.0;
  double retreat_z = 1.0;
  double retreat_desired_distance = 0.1;  ///< m
  double retreat_min_distance = 0.05;     ///< m
  double max_contact_force = 0.0;         ///< N; 0: no limit
};

/// @throw ParameterError where the lists are not of one length, holding a name and positions that are finite, or a
/// direction has no length, or a least distance is greater than the desired one.
void validate(const GraspParameters& parameters);

/// One grasp for each hand pose of the handle, in their order, named HANDLE/POSE after the handle's id and the place of
/// the pose, from 1; its quality is the handle's score times the pose's. The gripper opens as far as a pose needs where
/// the opening at its open positions is known, else fully; a pose that needs more than that gives no grasp. The
/// direction of approach is given in the frame of the handle.
/// @param parameters  valid
std::vector<moveit_msgs::Grasp> graspsOf(const Handle& handle, const GraspParameters& parameters);

}  // namespace grasp_affordances
