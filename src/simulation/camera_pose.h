#pragma once

#include "simulation/scene.h"

#include <optional>

namespace grasp_affordances
{

/// Where the camera of a scene stands. What is not set stays as the scene has it.
struct CameraPose
{
  std::optional<double> tilt;      ///< rad, by which the camera looks down: 0 to 75 degrees
  std::optional<double> distance;  ///< m, from the point looked at: 0.4 to 1.5
};

/// The view with its camera moved in the vertical plane of its line of sight. The point looked at stays in the middle
/// of the picture: the point of the line of sight nearest to the middle of the things.
/// @throw std::invalid_argument if a tilt or distance is set and the camera looks along the vertical
View posed(View view, const CameraPose& pose);

}  // namespace grasp_affordances
