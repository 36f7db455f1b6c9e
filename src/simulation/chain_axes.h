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
  bool reversed;                ///< the axis is traversed from its end to its start
  Eigen::Vector3d first, last;  ///< ends of the axis in the scene's frame, in the order of traversal
};

/// The paths along a part. A part without a chain has one path for each of its axes. A chain has one path through all
/// of its parts: each part contributes the axis and direction that start nearest to the end of the part before. That
/// path belongs to the chain's part with the least index; its other parts have none. A part without an axis has none.
std::vector<std::vector<PartAxis>> axisAlternatives(const Scene& scene, std::size_t part);

}  // namespace grasp_affordances
