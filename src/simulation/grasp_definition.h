#pragma once

#include <cstdint>

namespace grasp_affordances
{

/// What counts as an enveloping grasp affordance (paper, section V: "Methods and Results").
struct GraspDefinition
{
  double capture_radius = 0.026;  ///< m; the surface's radius is less
  double clearance = 0.008;       ///< m; free all around the surface, on its hidden sides too
  double min_length = 0.03;       ///< m; along the axis
};

constexpr std::uint32_t kNotGraspable = 0;
constexpr std::uint32_t kDoubtful = 255;  ///< affordances have the labels from 1 to 254

}  // namespace grasp_affordances
