#pragma once

#include <cstdint>

namespace grasp_affordances
{

/// Definition of an enveloping grasp affordance (paper, section V: "Methods and Results").
struct GraspDefinition
{
  double capture_radius = 0.026;  ///< m; upper limit of the surface's radius
  double clearance = 0.008;       ///< m; free space required all around the surface, also on its hidden sides
  double min_length = 0.03;       ///< m; least length along the axis
};

constexpr std::uint32_t kNotGraspable = 0;
constexpr std::uint32_t kDoubtful = 255;  ///< affordances have the labels from 1 to 254

}  // namespace grasp_affordances
