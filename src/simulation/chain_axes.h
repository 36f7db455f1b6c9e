#pragma once

#include "simulation/grip_axis.h"
#include "simulation/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace grasp_affordances
{

/// A part with one of its axes.
struct PartAxis
{
  std::size_t part;
  GripAxis axis;
  bool reversed;                ///< to be passed from its end to its start
  Eigen::Vector3d first, last;  ///< ends of the axis in the scene's frame, in the order in which they are passed
};

/// The ways to pass along a part: one for each of its axes, or the one through all parts of its chain, where each part
/// has the axis and direction that start nearest to the end of the one before. None for a part that has no axis or is
/// not the first of its chain by index.
std::vector<std::vector<PartAxis>> axisAlternatives(const Scene& scene, std::size_t part);

}  // namespace grasp_affordances
