#pragma once

#include "moveit/grasp_conversion.h"
#include "nodelets/parameters/parameter_reader.h"

namespace grasp_affordances
{

/// Everything that the node moveit_grasps is told by private parameters.
struct GraspPlannerParameters
{
  GraspParameters grasp;
  bool only_selected = false;  ///< of the handle that is selected, instead of all
};

/// Reads the node's private parameters. Every name must be known.
/// @throw ParameterError with name, value and allowed values.
GraspPlannerParameters graspPlannerParameters(ParameterReader read);

}  // namespace grasp_affordances
