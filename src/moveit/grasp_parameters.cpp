#include "moveit/grasp_parameters.h"

namespace grasp_affordances
{

GraspPlannerParameters graspPlannerParameters(ParameterReader read)
{
  const Range<double> distance{0.0, 1.0}, component{-1.0, 1.0};
  GraspPlannerParameters result;
  GraspParameters& grasp = result.grasp;
  read("gripper_joints", grasp.gripper_joints, "a list of names");
  read("open_positions", grasp.open_positions, "a list of numbers");
  read("closed_positions", grasp.closed_positions, "a list of numbers");
  read("open_width", grasp.open_width, distance, "m", "");
  read("posture_duration", grasp.posture_duration, Range<double>{0.0, 60.0}, "s", "");
  read("approach_x", grasp.approach_x, component, "", "");
  read("approach_y", grasp.approach_y, component, "", "");
  read("approach_z", grasp.approach_z, component, "", "");
  read("approach_desired_distance", grasp.approach_desired_distance, distance, "m", "");
  read("approach_min_distance", grasp.approach_min_distance, distance, "m", "");
  read("retreat_frame", grasp.retreat_frame, "the name of a frame");
  read("retreat_x", grasp.retreat_x, component, "", "");
  read("retreat_y", grasp.retreat_y, component, "", "");
  read("retreat_z", grasp.retreat_z, component, "", "");
  read("retreat_desired_distance", grasp.retreat_desired_distance, distance, "m", "");
  read("retreat_min_distance", grasp.retreat_min_distance, distance, "m", "");
  read("max_contact_force", grasp.max_contact_force, Range<double>{0.0, 1000.0}, "N", "");
  read("only_selected", result.only_selected, "");
  read.refuseRemaining();
  validate(grasp);
  return result;
}

}  // namespace grasp_affordances
